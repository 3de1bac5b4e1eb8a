#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::presenters
{

/// What structures are, as the list of a case has them one below the other.
enum class StructureKind
{
  Bone,       ///< the primary image itself, or its tissue where that is an MR
  SoftTissue, ///< what is neither bone nor a structure
  Nerve,
  Vessel,
  Ossicle,
  InnerEar,
  Dura,
  Lumen,
  Other,
  Mesh
};

/// A row of the list of a case.
struct StructureRow
{
  std::string part; ///< as WorkstationModel::lookOf; bone is "ct", soft tissue scene::kSoftTissue
  StructureKind kind = StructureKind::Other;
  double volume = 0.0; ///< mm^3, of a structure; 0: not known
  appearance::StructureAppearance look;
  std::string missing;       ///< why it has no place on the primary image; usually empty
  std::string outdated = {}; ///< why its error is not known any more (scene::outdatedReading)
};

StructureKind kindOf(const appearance::StructureAppearance& look);

/// Bone, and all structures and meshes by kind, each kind in the case's order.
std::vector<StructureRow> structureRows(const scene::Case& value);

/// `change` for each of the parts, in one step.
void changeLooks(
    WorkstationModel& model, const std::vector<std::string>& parts,
    const std::function<void(const std::string& part, appearance::StructureAppearance&)>& change);

/// Shows some structures alone, and again what was shown before. Bone stays as it is, unless it is
/// one of them.
class OnlyThese
{
public:
  /// The model must outlive this.
  explicit OnlyThese(WorkstationModel& model);

  /// Whether they, and no others, are shown since `toggle`.
  bool isOn(const std::vector<std::string>& parts) const;
  /// Shows these alone; if they are it already, what was shown before others were shown alone.
  void toggle(const std::vector<std::string>& parts);
  void renamed(const std::string& from, const std::string& to); ///< a part has another name

private:
  using Shown = std::vector<std::pair<std::string, bool>>;
  Shown shown() const;
  Shown alone(const std::vector<std::string>& parts) const;
  void show(const Shown& shown, const std::string& what);

  WorkstationModel& m_model;
  std::uint64_t m_case = 0; // WorkstationModel::shownAs
  Shown m_before;
  std::optional<Shown> m_now; // as it was left; anything else: the user went on
};

} // namespace petrous::presenters
