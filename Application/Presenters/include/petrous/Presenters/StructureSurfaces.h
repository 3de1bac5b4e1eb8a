#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "petrous/Core/Progress.h"
#include "petrous/Presenters/SurfaceUncertainty.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

struct NearStructure
{
  std::string name;
  double distance = 0.0; ///< mm to its surface, negative within
};

/// The structures of a case, each whole and alone, to measure how far they are: what was drilled,
/// what lies before one and what it is to hand and drill play no part.
///
/// A surface is the 1/2 level of the structure's own smoothed union (SmoothedUnion.h), or of the
/// voxels of a mesh; distances hold for that surface to a hundredth of its voxel, at creases to a
/// tenth (volume::SurfaceDistance). A structure is measured when it is first asked for (some tenths
/// of a second where it is large). One thread.
class StructureSurfaces
{
public:
  static constexpr double kFar = 1000.0; ///< mm; nothing of a patient's head is farther

  /// Loads the labels of the case and looks through their voxels once. Of meshes those are taken
  /// that have voxels for touch already.
  explicit StructureSurfaces(const scene::Case& value);
  ~StructureSurfaces();

  std::size_t count() const noexcept { return m_structures.size(); }
  const std::string& name(std::size_t structure) const;
  double spacing(std::size_t structure) const; ///< mm, the least of its grid
  const SurfaceUncertainty& uncertainty(std::size_t structure) const;

  /// Measures it now; nothing happens a second time. Throws CancelledError.
  void measure(std::size_t structure, const core::Progress& progress = {});

  /// From a patient point to the structure's surface, mm, negative within; at most `most` to either
  /// side.
  double distance(std::size_t structure, const Eigen::Vector3d& patient, double most);

  /// The nearest of those structures for which `wanted`; nothing beyond `reach` mm.
  std::optional<NearStructure> nearest(const Eigen::Vector3d& patient, double reach,
                                       const std::function<bool(const std::string& name)>& wanted);

  /// Memory of the structures that were asked for, as "labels.distance.NAME".
  std::map<std::string, std::size_t> resources() const;

private:
  struct Structure;
  std::vector<std::unique_ptr<Structure>> m_structures;
};

} // namespace petrous::presenters
