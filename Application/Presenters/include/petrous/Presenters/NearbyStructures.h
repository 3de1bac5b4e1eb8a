#pragma once

#include <future>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "petrous/Dissection/RemovedVolume.h"
#include "petrous/Presenters/MeasuredTool.h"
#include "petrous/Presenters/StructureSurfaces.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// A structure near the tool.
struct NearbyStructure
{
  enum class State
  {
    Clear,
    Warned, ///< the tool may be nearer than the structure's warning distance: its distance less
            ///< `unsure` is
    Touched ///< the tool touches it; never for a lumen without a warning distance
  };

  std::string name;
  std::array<float, 3> color{}; ///< RGB, 0 to 1
  double distance = 0.0; ///< mm from the burr's sphere, or the nearest point of an instrument, to
                         ///< its surface; 0: touched
  double sampling = 0.0; ///< mm by which an instrument may be nearer between its points
  SurfaceUncertainty uncertainty;
  double warning = 0.0; ///< warning distance, mm; 0: none
  State state = State::Clear;
  double injured = 0.0; ///< volume removed from it, mm^3, including the open stroke as far as known

  /// mm by which it may be nearer: the uncertainty of the surface, and the instrument's sampling.
  double unsure() const { return uncertainty.millimetres() + sampling; }
};

/// "facial nerve 1.8 mm ± 0.3", "facial nerve touched", of a structure drawn on an MR with
/// "; registration 0.4 mm (p95)", or "; registration's error unknown" if the uncertainty is
/// incomplete.
std::string toString(const NearbyStructure& structure);

/// What the surgeon must see now: a line for each structure that is touched, injured or within its
/// warning distance, worst first, at most kMaxWarnings; empty: nothing.
std::string warningsOf(const std::vector<NearbyStructure>& structures);
constexpr std::size_t kMaxWarnings = 3;

/// Names of structures that ought to be measured and are not.
struct UnmeasuredStructures
{
  std::vector<std::string> pending; ///< still being measured
  std::vector<std::string> failed;
};

/// A line for each of both kinds, with at most kMaxWarnings names: "no warnings of facial nerve
/// yet: still being measured", "no warnings of carotid: cannot be measured"; empty: all are
/// measured.
std::string toString(const UnmeasuredStructures& structures);

/// Whether any of its structures is such that warningsOf could name it, as they are shown and
/// warned of now; else nobody needs to measure for warnings.
bool canBeWarnedOf(const scene::Case& value);

/// "0.72 mm³", "under 0.01 mm³".
std::string cubicMillimetres(double volume);

/// What the finished strokes, and `open`, have removed of each structure, mm^3. Lumens are left
/// out: an air cell is opened, not injured.
std::map<std::string, double> injuredVolumes(const scene::Case& value,
                                             const dissection::RemovedVolume& open = {});

/// What is near the tool, as measured once for all who show it.
struct ToolSurroundings
{
  std::vector<NearbyStructure> structures; ///< nearest first; empty unless isMeasured
  bool isWide = false;       ///< all that are near are among them; else only what is warned of
  bool isMeasured = false;   ///< false: the distance fields are being computed, or that failed
  bool isInstrument = false; ///< the tool is
  std::string unmeasured;    ///< UnmeasuredStructures in words: to be shown beside them
  std::string fault;         ///< why they cannot be measured; empty: they can
};

/// Distances of a tool from the structures of a case that are visible or have a warning distance,
/// fast enough for every frame.
///
/// The structures' distance fields are computed in a separate thread; until then there is no
/// result. One that is shown or gets a warning distance later is computed in such a thread, too,
/// and left out until then; one that cannot be computed is left out, and the others are not. Not
/// thread-safe; the case may change meanwhile, except its labels and meshes.
class NearbyStructures
{
public:
  explicit NearbyStructures(const scene::Case& value);
  ~NearbyStructures();

  /// Whether the distance fields have been computed, or that has failed.
  bool ready() const;

  /// Visible structures of the case, nearest first; injured ones at any distance, and hidden ones
  /// that are warned of, touched or injured and have a warning distance. Empty until `ready`.
  /// Throws where the case's labels cannot be read.
  ///
  /// value   the same case in its current state: appearances, strokes
  /// pose    of the tool, X_PT
  /// reach   mm; structures farther away are omitted unless within their warning distance; 0: no
  ///         more is measured than warningsOf needs, which is the same then as at any reach
  /// open    what the open stroke has removed so far
  std::vector<NearbyStructure> around(const scene::Case& value, const MeasuredTool& tool,
                                      const haptics::Pose& pose, double reach,
                                      const dissection::RemovedVolume& open = {});

  /// The same of a burr of that radius, mm, at `center`, patient LPS mm.
  std::vector<NearbyStructure> around(const scene::Case& value, const Eigen::Vector3d& center,
                                      double radius, double reach,
                                      const dissection::RemovedVolume& open = {});

  /// What the last `around` left out.
  const UnmeasuredStructures& unmeasured() const noexcept { return m_unmeasured; }

  /// The distance fields.
  StructureSurfaces& surfaces() const; ///< waits until they are computed

private:
  // By structure; nullptr: has failed.
  using Measured =
      std::vector<std::pair<std::size_t, std::shared_ptr<const volume::SurfaceDistance>>>;

  void measureLater(const scene::Case& value);

  std::shared_ptr<core::CancelToken> m_stop;
  std::shared_future<std::shared_ptr<StructureSurfaces>> m_surfaces;
  std::shared_future<Measured> m_later; // not valid: nothing is being measured
  std::set<std::size_t> m_failed;       // structures
  UnmeasuredStructures m_unmeasured;
};

} // namespace petrous::presenters
