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
  T2,       ///< fluid bright, fat middling (FIESTA, CISS)
  Diffusion ///< brain bright; fluid and fat dark
};

/// What an MR scanner would see of the head in a CT, 0 (nothing) to about 1, on the CT's grid.
///
/// HU are turned into tissue (air and cortical bone dark, and whatever lies between the two, which
/// partial volume would make pass for soft tissue); soft tissue is first freed of the CT's noise,
/// so that the noise of one image is not found again in the other, and given a pattern of its own
/// (grey and white matter, muscle) of which the CT knows nothing. NaN and padding are air.
volume::Volume<float> mrContrastOf(const volume::IntensityVolume& ct, MrContrast contrast,
                                   std::uint64_t seed);

/// A part of the patient that lies elsewhere in the MR than the rest: what lands within `radius` mm
/// of `center` (CT patient point) comes from `shift` mm away, falling off to nothing over `edge`
/// mm.
struct LocalShift
{
  Vector3d center{0.0, 0.0, 0.0};
  double radius = 18.0; ///< mm, to the middle of the edge
  Vector3d shift{0.0, 0.0, 0.0};
  double edge = 2.0; ///< mm
};

/// How the scanner samples it.
struct MrAcquisition
{
  Vector3d spacing{1.0, 1.0, 1.0}; ///< mm; the third is the slice's thickness, a box profile
  /// What it covers: a box along its own axes, mm, about a CT patient point.
  Vector3d extent{180.0, 200.0, 120.0};
  Vector3d center{0.0, 0.0, 0.0};
  /// Its axes in the CT's patient frame: a tilted or oblique acquisition. Right-handed.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  core::RigidTransform mrFromCt; ///< how the patient lay in the other scanner
  double noise = 0.03;           ///< Rician: standard deviation of both channels, of about 1
  double bias = 0.2;             ///< share by which the coil's sensitivity varies over the extent
  double distortion = 0.0;       ///< mm at most, along the second axis (phase encoding, as in DWI)
  std::optional<LocalShift> local; ///< instead of the distortion: such a part
  std::uint64_t seed = 1;
};

/// The acquisition's image, 1000 times the contrast, with the truth: mrFromCt, and the distortion
/// or the displaced part where there is one. Each voxel is the mean of cubic (Keys) samples over
/// its box, so no interpolation that a registration uses is favoured. Air beyond the contrast's
/// grid. The same for the same seed whatever the number of threads.
struct SimulatedMr
{
  std::shared_ptr<const volume::IntensityVolume> volume;
  std::function<Vector3d(const Vector3d&)> truth; ///< CT patient point -> MR patient point
};
SimulatedMr acquireMr(const volume::Volume<float>& contrast, const MrAcquisition& acquisition);

} // namespace petrous::registration
