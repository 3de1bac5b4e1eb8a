#pragma once

#include <optional>
#include <vector>

#include "petrous/Registration/Fit.h"

#include "LevelImage.h"

namespace petrous::registration
{

/// One image through the pyramid, coarsest first.
struct Pyramid
{
  std::vector<LevelImage> levels;
  std::vector<core::IndexBox> content; ///< of each level: where samples are drawn

  const LevelImage& finest() const { return levels.back(); }
};

/// Both images as every step of a registration reads them. The fixed one is that with the smaller
/// field, or the CT where a region of it was chosen.
struct ImagePair
{
  Pyramid fixed;
  Pyramid moving;
  bool fixedIsCt = true;
  std::vector<double> scales; ///< mm a voxel of each level, coarsest first

  std::size_t levels() const { return scales.size(); }

  /// X_MC from a pose that takes fixed to moving points, and back.
  core::RigidTransform mrFromCt(const core::RigidTransform& movingFromFixed) const;
  core::RigidTransform movingFromFixed(const core::RigidTransform& mrFromCt) const;

  /// The same images with their roles swapped.
  ImagePair swapped() &&;
};

/// Throws InvalidParameter as fitRigid does.
ImagePair makePair(const volume::IntensityVolume& ct, const volume::IntensityVolume& mr,
                   const std::optional<core::PatientBox>& region, int levels,
                   const core::Progress& progress);

} // namespace petrous::registration
