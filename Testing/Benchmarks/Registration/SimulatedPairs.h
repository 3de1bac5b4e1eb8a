#pragma once

#include <memory>
#include <string>
#include <vector>

#include "SimulatedMr.h"

namespace petrous::registration
{

/// A head whose CT is at hand, with what an MR scanner would see of it.
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
  std::vector<Vector3d> ears; ///< the middle ears in it, CT patient LPS mm
};

/// A pair drawn from a body.
struct PairRecipe
{
  std::size_t contrast = 0;
  MrAcquisition acquisition;
  std::optional<Vector3d> ctExtent; ///< mm; the CT is cut to this box; none: all of it
  Vector3d ctCenter{0.0, 0.0, 0.0}; ///< of that box
};

/// Its target is the ear, its truth exact.
RegistrationPair simulatePair(const SimulationBody& body, std::size_t ear,
                              const PairRecipe& recipe);

/// An everyday examination of a body: most of the head with voxels of 1.2 x 1.2 x 3 mm, or what
/// the body has, a motion of 8 mm and 6 degrees; contrast and all else from the seed.
PairRecipe usualRecipe(const SimulationBody& body, std::size_t ear, std::uint64_t seed);

/// The volume's part within the box, voxels copied. Throws InvalidParameter where there is none.
std::shared_ptr<const volume::IntensityVolume>
croppedTo(const volume::IntensityVolume& image, const Vector3d& center, const Vector3d& extent);

/// A copy in floats whose voxels are value(i, j, k, value before).
std::shared_ptr<const volume::IntensityVolume>
changed(const volume::IntensityVolume& image,
        const std::function<float(int, int, int, float)>& value);

/// The voxels in the opposite order along an axis. With `header` the direction turns with them, and
/// the image shows what it showed before; without, it shows a mirrored patient.
std::shared_ptr<const volume::IntensityVolume> flipped(const volume::IntensityVolume& image,
                                                       int axis, bool header);

/// The same voxels on another grid of the same dims.
std::shared_ptr<const volume::IntensityVolume> relaid(const volume::IntensityVolume& image,
                                                      const core::GridGeometry& grid);

} // namespace petrous::registration
