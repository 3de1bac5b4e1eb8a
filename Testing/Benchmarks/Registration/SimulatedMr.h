#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "RegistrationPair.h"
#include "petrous/Volume/Volume.h"

namespace petrous::registration
{

enum class MrContrast
{
  T1,       ///< fat bright, fluid dark
  T2,       ///< fluid bright, fat intermediate (FIESTA, CISS)
  Diffusion ///< brain bright; fluid and fat dark
};

/// Simulated MR contrast of the head in a CT, 0 (no signal) to about 1, on the CT's grid.
///
/// HU are mapped to tissue (air and cortical bone dark, as are values between the two, which
/// partial volume would otherwise turn into soft tissue). Soft tissue is denoised first, so that
/// the CT's noise does not reappear in the MR, and gets a texture (grey and white matter, muscle)
/// that is not in the CT. NaN and padding are air.
volume::Volume<float> mrContrastOf(const volume::IntensityVolume& ct, MrContrast contrast,
                                   std::uint64_t seed);

/// A part of the patient that is displaced in the MR: what appears within `radius` mm of `center`
/// (CT patient point) comes from `shift` mm away, with a transition to zero over `edge` mm.
struct LocalShift
{
  Vector3d center{0.0, 0.0, 0.0};
  double radius = 18.0; ///< mm, to the middle of the transition
  Vector3d shift{0.0, 0.0, 0.0};
  double edge = 2.0; ///< mm
};

/// Scanner sampling.
struct MrAcquisition
{
  Vector3d spacing{1.0, 1.0, 1.0}; ///< mm; the third is the slice thickness, with a box profile
  /// Coverage: a box along its own axes, mm, around a CT patient point.
  Vector3d extent{180.0, 200.0, 120.0};
  Vector3d center{0.0, 0.0, 0.0};
  /// Axes in the CT's patient frame: a tilted or oblique acquisition. Right-handed.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  core::RigidTransform mrFromCt; ///< patient motion between the scanners
  double noise = 0.03;     ///< Rician: standard deviation of both channels, relative to about 1
  double bias = 0.2;       ///< relative variation of the coil sensitivity over the extent
  double distortion = 0.0; ///< maximum, mm, along the second axis (phase encoding, as in DWI)
  std::optional<LocalShift> local; ///< a displaced part, instead of the distortion
  std::uint64_t seed = 1;
};

/// The acquired image, 1000 times the contrast, and its truth: mrFromCt with the distortion or the
/// displaced part, if any. Each voxel is the mean of cubic (Keys) samples over its box, which
/// favours no registration's interpolation. Air outside the contrast's grid. Deterministic for a
/// seed, regardless of the number of threads.
struct SimulatedMr
{
  std::shared_ptr<const volume::IntensityVolume> volume;
  std::function<Vector3d(const Vector3d&)> truth; ///< CT patient point -> MR patient point
};
SimulatedMr acquireMr(const volume::Volume<float>& contrast, const MrAcquisition& acquisition);

} // namespace petrous::registration
