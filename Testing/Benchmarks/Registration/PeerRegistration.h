#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "RegistrationPair.h"

namespace petrous::registration
{

/// What another program made of a pair.
struct PeerFit
{
  core::RigidTransform mrFromCt;
  double seconds = 0.0;          ///< wall time: of the whole process, or of the call
  double processorSeconds = 0.0; ///< user and system time of the same
};

/// The program with its version, "elastix 5.0.1"; nothing where it is not installed.
std::optional<std::string> elastixVersion();

/// How much work elastix does; by default that of its manual's rigid mutual information set.
struct ElastixSchedule
{
  int resolutions = 4;
  int iterations = 500; ///< of each resolution
  int bins = 32;

  std::string name() const; ///< "4 x 500, 32 bins"
};

/// Its own time against error: from a fifth of its default's iterations to four times as many.
const std::vector<ElastixSchedule>& elastixSchedules();

/// Uncompressed MetaImage, F.mhd with F.raw beside it: what elastix reads fastest, and what ours is
/// given, too. Throws Error (Internal) where it cannot be written.
void writeMetaImage(const std::filesystem::path& path, const volume::IntensityVolume& image);

/// Runs elastix in a process of its own, from the headers: adaptive stochastic gradient descent,
/// Mattes' metric, 4096 samples an iteration. The times are those of the process, reading its files
/// included. Nothing where it fails. Throws Error (Internal) when its files cannot be written.
std::optional<PeerFit> runElastix(const RegistrationPair& pair, const std::filesystem::path& work,
                                  int threads, const ElastixSchedule& schedule = {});

/// The 4x4 of an Euler transform in elastix's TransformParameters: T(p) = R (p - c) + c + t with
/// R = Rz Rx Ry. Throws Error (BadInput) where the text has no such transform.
core::RigidTransform elastixTransform(const std::string& parameters);

/// ITK's own v4 framework as its examples use it: Mattes' metric of 32 bins on 10 % of the voxels
/// (at most 200,000), regular step gradient descent with scales from physical shift, 3 levels of
/// 200 iterations, from the headers.
/// Nothing where it throws (no overlap).
std::optional<PeerFit> runItk(const RegistrationPair& pair);

std::string itkVersion(); ///< "ITK 5.2.1 v4"

} // namespace petrous::registration
