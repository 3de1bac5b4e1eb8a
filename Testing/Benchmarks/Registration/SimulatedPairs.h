#pragma once

#include <memory>
#include <string>
#include <vector>

#include "SimulatedMr.h"

namespace petrous::registration
{

/// A head with a CT, and its simulated MR contrasts.
struct SimulationBody
{
  struct Contrast
  {
    std::string name; ///< "T1", "T2", ...
    std::shared_ptr<const volume::Volume<float>> image;
  };

  std::string name;
  std::shared_ptr<const volume::IntensityVolume> ct;
  std::vector<Contrast> contrasts;
  std::vector<Vector3d> ears; ///< middle ears in it, CT patient LPS mm
};

/// Parameters of a pair simulated from a body.
struct PairRecipe
{
  std::size_t contrast = 0;
  MrAcquisition acquisition;
  std::optional<Vector3d> ctExtent; ///< mm; the CT is cropped to this box; nullopt: not cropped
  Vector3d ctCenter{0.0, 0.0, 0.0}; ///< of that box
};

/// The ear is the target; the truth is exact.
RegistrationPair simulatePair(const SimulationBody& body, std::size_t ear,
                              const PairRecipe& recipe);

/// A typical examination of a body: most of the head with voxels of 1.2 x 1.2 x 3 mm, limited to
/// the body's extent, a motion of 8 mm and 6 degrees; contrast and everything else from the seed.
PairRecipe usualRecipe(const SimulationBody& body, std::size_t ear, std::uint64_t seed);

/// Crops the volume to the box, copying voxels. Throws InvalidParameter if nothing remains.
std::shared_ptr<const volume::IntensityVolume>
croppedTo(const volume::IntensityVolume& image, const Vector3d& center, const Vector3d& extent);

/// A float copy whose voxels are value(i, j, k, old value).
std::shared_ptr<const volume::IntensityVolume>
changed(const volume::IntensityVolume& image,
        const std::function<float(int, int, int, float)>& value);

/// Reverses the voxel order along an axis. With `header` the direction is flipped as well, so the
/// image is geometrically unchanged; without, it shows a mirrored patient.
std::shared_ptr<const volume::IntensityVolume> flipped(const volume::IntensityVolume& image,
                                                       int axis, bool header);

/// The same voxels on another grid of equal dims.
std::shared_ptr<const volume::IntensityVolume> relaid(const volume::IntensityVolume& image,
                                                      const core::GridGeometry& grid);

} // namespace petrous::registration
