#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "petrous/Core/RigidTransform.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::registration
{

using Eigen::Vector3d;

/// A CT and an MR of which it is known where a CT point lies in the MR.
struct RegistrationPair
{
  std::string name;
  std::shared_ptr<const volume::IntensityVolume> ct, mr;
  /// CT patient point -> MR patient point, LPS mm; empty where the two show nothing in common.
  std::function<Vector3d(const Vector3d&)> truth;
  std::vector<Vector3d> targets; ///< CT patient points that count: the middle ears
  bool exact = true; ///< false: the truth is nominal, judge by another program's optimum
};

/// Distances from the truth, mm.
struct PairError
{
  double target = 0.0; ///< mean over the targets
  double cornerMean = 0.0, cornerMax = 0.0;
};

/// The corners of a volume: the centres of its eight outermost voxels, patient LPS mm.
std::array<Vector3d, 8> cornersOf(const core::GridGeometry& grid);

/// Of a registration against the truth, at the targets and the corners of the CT.
PairError errorOf(const RegistrationPair& pair, const core::RigidTransform& mrFromCt);

/// The largest distance between two registrations at the targets, mm.
double distanceAtTargets(const RegistrationPair& pair, const core::RigidTransform& a,
                         const core::RigidTransform& b);

/// The same pair with the MR's header moved: MR point p is now at move * p. The voxels are shared.
RegistrationPair displaced(const RegistrationPair& pair, const core::RigidTransform& move);

/// A motion about `center`: `millimetres` in a random direction, and `degrees` about a random axis.
/// The same for the same seed on every machine.
core::RigidTransform randomMotion(const Vector3d& center, double millimetres, double degrees,
                                  std::uint64_t seed);

} // namespace petrous::registration
