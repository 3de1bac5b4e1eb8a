#pragma once

#include <vector>

#include "petrous/Registration/Register.h"

namespace petrous::registration
{

/// The error at a point from the spread of repeated fits about the fit.
///
/// The displacements are taken for draws of a normal distribution with their second moments about
/// zero (a fit that lies aside of its repeats is counted as wrong by that much); the length of such
/// a vector is close to a scaled chi-square (Satterthwaite 1946), whose percentiles are stated.
/// Fits that ended elsewhere (further than `stray` mm) are left out here: the verdict counts them.
/// Two calibrated constants, the inflation and the floor, are added: see Documentation/adr.
///
/// The largest error is the 99.9th percentile of that distribution, or the furthest of the repeats
/// where that is more: a bound that one fit in a thousand may pass, where the p95 is passed by one
/// in twenty.
LocalError localError(const core::RigidTransform& mrFromCt,
                      const std::vector<core::RigidTransform>& repeats,
                      const Eigen::Vector3d& ctPoint, double voxel, double stray);

/// The same where the point's surroundings lie `offset` mm beside the rest, with an error of their
/// own (root mean square length, mm): the point is where they are, and the error counts from there.
LocalError withDisplaced(LocalError error, double offset, double spread);

/// Share of the repeats that ended further than `stray` mm from the fit at the point.
double strayShare(const core::RigidTransform& mrFromCt,
                  const std::vector<core::RigidTransform>& repeats, const Eigen::Vector3d& ctPoint,
                  double stray);

} // namespace petrous::registration
