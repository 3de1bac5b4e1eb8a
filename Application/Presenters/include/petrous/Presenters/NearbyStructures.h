#pragma once

#include <future>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "petrous/Dissection/RemovedVolume.h"
#include "petrous/Presenters/StructureSurfaces.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// A structure as the burr sees it.
struct NearbyStructure
{
  enum class State
  {
    Clear,
    Warned, ///< the burr is nearer than the structure's warning distance
    Touched ///< the burr reaches it; never of a lumen without a warning distance
  };

  std::string name;
  std::array<float, 3> color{}; ///< RGB, 0 to 1
  double distance = 0.0;        ///< mm from the burr's ball to its surface; 0: it is touched
  SurfaceUncertainty uncertainty;
  double warning = 0.0; ///< mm; 0: none
  State state = State::Clear;
  double injured = 0.0; ///< mm^3 taken of it, by the open stroke too as far as that is known
};

/// "facial nerve 1.8 mm ± 0.3", "facial nerve touched", with "; registration's error unknown" where
/// the number leaves something out.
std::string toString(const NearbyStructure& structure);

/// What the surgeon must see now, a line for each structure that is touched, injured or within its
/// warning distance, the worst first and at most kMaxWarnings of them; empty: nothing.
std::string warningsOf(const std::vector<NearbyStructure>& structures);
constexpr std::size_t kMaxWarnings = 3;

/// "0.72 mm³", "under 0.01 mm³".
std::string cubicMillimetres(double volume);

/// What the strokes that are done, and `open`, have taken of each structure, mm^3. Lumens are left
/// out: an air cell is opened, not injured.
std::map<std::string, double> injuredVolumes(const scene::Case& value,
                                             const dissection::RemovedVolume& open = {});

/// How far a burr is from the structures of a case that are shown, as often as a picture is drawn.
///
/// The structures are measured in a thread of their own; until that is done there is no answer. Not
/// for more than one thread; the case may change meanwhile, but for its labels and meshes.
class NearbyStructures
{
public:
  explicit NearbyStructures(const scene::Case& value);
  ~NearbyStructures();

  /// Whether the structures are measured, or that has failed.
  bool ready() const;

  /// Structures of the case that are shown, the nearest first; those that are injured however far.
  /// Empty until `ready`. Throws what stood in the way of measuring.
  ///
  /// value   the same case, as it is now: looks, strokes
  /// center  of the burr, patient LPS mm; `radius` mm
  /// reach   mm; what is farther is left out, unless it is within its warning distance
  /// open    what the open stroke has taken so far
  std::vector<NearbyStructure> around(const scene::Case& value, const Eigen::Vector3d& center,
                                      double radius, double reach,
                                      const dissection::RemovedVolume& open = {});

  /// See StructureSurfaces.
  StructureSurfaces& surfaces() const; ///< waits for them

private:
  std::shared_ptr<core::CancelToken> m_stop;
  std::shared_future<std::shared_ptr<StructureSurfaces>> m_surfaces;
};

} // namespace petrous::presenters
