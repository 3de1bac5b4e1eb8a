#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/IntensityHistogram.h"
#include "petrous/Volume/LabelMap.h"

namespace petrous::presenters
{

/// Histograms of an image within each segment of a label map, by its index. The image is read at
/// the centres of the labels' voxels, trilinearly unless both have one grid, and rounded to its
/// voxel type; voxels beyond the image and padding do not count. `imageFromLabels` maps patient
/// points, LPS mm. In parallel. Throws CancelledError.
std::map<std::uint16_t, volume::IntensityHistogram>
histogramsWithin(const volume::LabelMap& labels, const volume::IntensityVolume& image,
                 const core::RigidTransform& imageFromLabels, const core::Progress& progress = {});

/// The histograms over which transfer functions are drawn, counted when they are needed: of each
/// image that is read, and of it within each structure that reads it.
class AppearanceHistograms
{
public:
  using Histogram = std::shared_ptr<const volume::IntensityHistogram>;

  /// Of an image of the case, "" the primary one; nullptr: not counted yet, or not readable.
  Histogram image(const std::string& name) const;
  /// Of the image that a structure reads, within it; nullptr: not counted yet, or it has no voxel
  /// in that image.
  Histogram within(const scene::Case& value, const std::string& structure) const;

  /// Counts what the case needs and is missing here, from a copy, in any thread; then call `take`.
  /// Empty: nothing is missing.
  std::function<AppearanceHistograms(const core::Progress&)>
  counting(const scene::Case& value) const;
  void take(AppearanceHistograms counted);

private:
  struct Whole
  {
    std::weak_ptr<const volume::IntensityVolume> volume; ///< of which it was counted
    Histogram histogram;
  };
  struct Within
  {
    std::weak_ptr<const volume::LabelMap> labels; ///< of which it was counted
    std::string image;
    core::RigidTransform imageFromCt;
    Histogram histogram;
  };
  bool isOf(const Within& counted, const scene::Case& value, const scene::LabelPart& part,
            const std::string& image) const;

  std::map<std::string, Whole> m_images;
  std::map<std::string, Within> m_within; ///< by the structure's name
};

} // namespace petrous::presenters
