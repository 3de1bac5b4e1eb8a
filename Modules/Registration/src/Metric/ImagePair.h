#pragma once

#include <optional>
#include <vector>

#include "petrous/Registration/Fit.h"

#include "LevelImage.h"

namespace petrous::registration
{

/// Resolution pyramid of one image, coarsest first.
struct Pyramid
{
  std::vector<LevelImage> levels;
  std::vector<core::IndexBox> content; ///< per level: where samples are drawn

  const LevelImage& finest() const { return levels.back(); }
};

/// Both images as used by all steps of a registration. The fixed image is the one with the smaller
/// field of view, or the CT if a region of it is given.
struct ImagePair
{
  Pyramid fixed;
  Pyramid moving;
  bool fixedIsCt = true;
  std::vector<double> scales; ///< voxel size of each level, mm, coarsest first

  std::size_t levels() const { return scales.size(); }

  /// Converts between the pose from fixed to moving points and X_MC.
  core::RigidTransform mrFromCt(const core::RigidTransform& movingFromFixed) const;
  core::RigidTransform movingFromFixed(const core::RigidTransform& mrFromCt) const;

  /// The same images with swapped roles.
  ImagePair swapped() &&;
};

/// Throws InvalidParameter like fitRigid.
ImagePair makePair(const volume::IntensityVolume& ct, const volume::IntensityVolume& mr,
                   const std::optional<core::PatientBox>& region, int levels,
                   const core::Progress& progress);

} // namespace petrous::registration
