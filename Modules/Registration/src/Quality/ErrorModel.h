#pragma once

#include <vector>

#include "petrous/Registration/Register.h"

namespace petrous::registration
{

/// Error at a point from the spread of repeated fits about the fit.
///
/// The displacements are modelled as normally distributed with their second moments about zero (so
/// a fit that deviates from the mean of its repeats is charged that deviation); the length of such
/// a vector approximately follows a scaled chi-square distribution (Satterthwaite 1946), whose
/// percentiles are given (core::lengthQuantile). Fits that ended elsewhere (further than `stray`
/// mm) are excluded here: the verdict counts them. Two calibrated constants, inflation and floor,
/// are applied: see Documentation/adr.
///
/// The maximum error is the 99.9th percentile of that distribution, or the largest deviation of the
/// repeats if greater: a bound exceeded by one fit in a thousand, while one in twenty exceeds the
/// p95. The moments of all six parameters, with both constants, are stated too, unless every fit
/// ended elsewhere: from them follows the error at any other point.
LocalError localError(const core::RigidTransform& mrFromCt,
                      const std::vector<core::RigidTransform>& repeats,
                      const Eigen::Vector3d& ctPoint, double voxel, double stray);

/// The same if the surroundings of the point are displaced by `offset` mm from the rest, with an
/// error of their own (RMS length, mm): the point is taken to lie with them, and the error includes
/// the offset. The spread is left out: it does not describe the part.
LocalError withDisplaced(LocalError error, double offset, double spread);

/// Fraction of the repeats that ended further than `stray` mm from the fit at the point.
double strayShare(const core::RigidTransform& mrFromCt,
                  const std::vector<core::RigidTransform>& repeats, const Eigen::Vector3d& ctPoint,
                  double stray);

} // namespace petrous::registration
