#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "RegistrationPair.h"

namespace petrous::registration
{

/// Another program's result for a pair.
struct PeerFit
{
  core::RigidTransform mrFromCt;
  double seconds = 0.0;          ///< wall time of the process or of the call
  double processorSeconds = 0.0; ///< user and system time of the same
};

/// Name and version, "elastix 5.0.1"; nullopt if not installed.
std::optional<std::string> elastixVersion();

/// elastix parameters; the default is the rigid mutual information set of its manual.
struct ElastixSchedule
{
  int resolutions = 4;
  int iterations = 500; ///< per resolution
  int bins = 32;

  std::string name() const; ///< "4 x 500, 32 bins"
};

/// Schedules for its error over time: from a fifth of the default's iterations to four times as
/// many.
const std::vector<ElastixSchedule>& elastixSchedules();

/// Uncompressed MetaImage, F.mhd with F.raw beside it: the fastest format for elastix, and the
/// input of ours as well. Throws Error (Internal) if it cannot be written.
void writeMetaImage(const std::filesystem::path& path, const volume::IntensityVolume& image);

/// Runs elastix in a separate process, starting from the headers: adaptive stochastic gradient
/// descent, Mattes metric, 4096 samples per iteration. Times are those of the process, including
/// file input. nullopt if it fails. Throws Error (Internal) if its files cannot be written.
std::optional<PeerFit> runElastix(const RegistrationPair& pair, const std::filesystem::path& work,
                                  int threads, const ElastixSchedule& schedule = {});

/// The 4x4 matrix of an Euler transform in elastix's TransformParameters: T(p) = R (p - c) + c + t
/// with R = Rz Rx Ry. Throws Error (BadInput) if the text has no such transform.
core::RigidTransform elastixTransform(const std::string& parameters);

/// ITK's v4 framework as in its examples: Mattes metric with 32 bins on 10 % of the voxels (at most
/// 200,000), regular step gradient descent with scales from physical shift, 3 levels of 200
/// iterations, starting from the headers. nullopt if it throws (no overlap).
std::optional<PeerFit> runItk(const RegistrationPair& pair);

std::string itkVersion(); ///< "ITK 5.2.1 v4"

} // namespace petrous::registration
