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

/// A CT and an MR with known correspondence of points.
struct RegistrationPair
{
  std::string name;
  std::shared_ptr<const volume::IntensityVolume> ct, mr;
  /// CT patient point -> MR patient point, LPS mm; empty if the two have no common content.
  std::function<Vector3d(const Vector3d&)> truth;
  std::vector<Vector3d> targets; ///< CT patient points to be evaluated: the middle ears
  bool exact = true;             ///< false: nominal truth; judge by another program's optimum
};

/// Distances from the ground truth, mm.
struct PairError
{
  double target = 0.0; ///< mean over the targets
  double cornerMean = 0.0, cornerMax = 0.0;
};

/// Corners of a volume: centres of its eight outermost voxels, patient LPS mm.
std::array<Vector3d, 8> cornersOf(const core::GridGeometry& grid);

/// Error of a registration at the targets and at the corners of the CT.
PairError errorOf(const RegistrationPair& pair, const core::RigidTransform& mrFromCt);

/// The largest distance between two registrations at the targets, mm.
double distanceAtTargets(const RegistrationPair& pair, const core::RigidTransform& a,
                         const core::RigidTransform& b);

/// The same pair with the MR header moved: MR point p becomes move * p. The voxels are shared.
RegistrationPair displaced(const RegistrationPair& pair, const core::RigidTransform& move);

/// A motion about `center`: `millimetres` in a random direction, and `degrees` about a random axis.
/// Deterministic for a seed on every machine.
core::RigidTransform randomMotion(const Vector3d& center, double millimetres, double degrees,
                                  std::uint64_t seed);

} // namespace petrous::registration
