#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "RegistrationPair.h"

namespace petrous::registration
{

/// What another program made of a pair.
struct PeerFit
{
  core::RigidTransform mrFromCt;
  double seconds = 0.0; ///< wall time: of the whole process, or of the call
};

/// The program with its version, "elastix 5.0.1"; nothing where it is not installed.
std::optional<std::string> elastixVersion();

/// Runs elastix in a process of its own, from the headers, with the rigid mutual information set of
/// its manual: adaptive stochastic gradient descent, Mattes' metric, 32 bins, 4 resolutions of 500
/// iterations of 4096 samples. The time is that of the process, reading its files included.
/// Nothing where it fails. Throws Error (Internal) when its files cannot be written.
std::optional<PeerFit> runElastix(const RegistrationPair& pair, const std::filesystem::path& work,
                                  int threads);

/// The 4x4 of an Euler transform in elastix's TransformParameters: T(p) = R (p - c) + c + t with
/// R = Rz Rx Ry. Throws Error (BadInput) where the text has no such transform.
core::RigidTransform elastixTransform(const std::string& parameters);

/// ITK's own v4 framework as its examples use it: Mattes' metric of 32 bins on 10 % of the voxels
/// (at most 200,000),
/// regular step gradient descent with scales from physical shift, 3 levels of 200 iterations, from
/// the headers. Nothing where it throws (no overlap).
std::optional<PeerFit> runItk(const RegistrationPair& pair);

std::string itkVersion(); ///< "ITK 5.2.1 v4"

} // namespace petrous::registration
