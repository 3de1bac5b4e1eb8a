#pragma once

#include <optional>

#include "petrous/Volume/IntensityHistogram.h"

namespace petrous::volume
{

/// Of soft tissue in an image that is not in Hounsfield units; estimates.
struct SoftTissueValues
{
  /// Where the values of air end: the equivalent of -700 HU, or more where noise of air reaches
  /// beyond. Always below peak.
  double foot = 0.0;
  double peak = 0.0; ///< the equivalent of 40 HU
};

/// Bone intensities of an image.
struct IntensityScale
{
  double iso = 300.0;     ///< bone surface: the value corresponding to 300 HU
  double dense = 1800.0;  ///< dense cortical bone; always above iso
  bool calibrated = true; ///< in Hounsfield units, with the values above
  std::optional<SoftTissueValues> soft = std::nullopt; ///< not of Hounsfield units
  bool isOfPart = false; ///< calibrated, but judged without peaks of air and soft tissue
};

/// Estimated from the histogram alone, so that bone is visible at once in cone-beam and micro-CT
/// too.
///
/// Calibrated (300, 1800): air is near -1000 and soft tissue, if it has a peak, near 0 to 100; or
/// there are values of -100 or less and one of the two is found; or, as of a part of a head
/// (isOfPart), the highest peak above air (-800) is soft tissue's (10 to 90), some values are below
/// -30, few below -1150, the 99.9th percentile is bone (700 to 2600), and no peak of air is
/// elsewhere. Otherwise, given peaks of air and
/// soft tissue, these two points define gain and offset, for -1000 and 40 HU, and with them iso and
/// the minimum of dense; iso stays clear of the noise of soft tissue, and is moved halfway to
/// Otsu's threshold if the file's value range cuts off air. Otherwise iso is the midpoint of the
/// two classes of Otsu's threshold (IEEE Trans. SMC 9:62, 1979). dense is the 99th percentile above
/// iso.
///
/// soft: of such peaks, if the lower one is that of air: nothing but its noise lies below it, it is
/// narrower than what is above soft tissue, and that is as far from soft tissue and as wide as bone
/// is. So a region without air, fat beside muscle, and an image whose air is bright have none,
/// where there is cortical bone; nor has an MR. Of fat, muscle and spongy bone alone fat is taken
/// for air: nothing in the histogram tells that from air, muscle and bone on another scale.
///
/// Without voxels: 300 and 1800, calibrated. Never throws; all values are finite.
IntensityScale suggestScale(const IntensityHistogram& histogram);

/// The scale, not calibrated, on which these values are -700 and 40 HU.
IntensityScale scaleThrough(const SoftTissueValues& values) noexcept;

/// The surface of the patient in an MR, which shows cortical bone as dark as air: of the three
/// classes of Otsu's two thresholds (air and bone, tissue, bright fluid or fat), iso is the
/// midpoint of the means of the lower two, dense the 99th percentile above it. Where most of what
/// is above the noise of air (mrNoiseCeiling) is below that, few bright voxels have taken two of
/// the classes, and iso is the midpoint of the means of noise and of that part. Never calibrated.
/// Without voxels: iso 0, dense 1. Never throws; all values are finite, and dense is above iso.
IntensityScale suggestMrScale(const IntensityHistogram& histogram);

/// Where an MR's values are no longer the noise of air, which has a Rayleigh distribution there
/// (Gudbjartsson and Patz, Magn Reson Med 34:910, 1995): below the darkest tissue that stands out
/// of it. At most, and without a peak of noise, iso of suggestMrScale. Without voxels 0. Never
/// throws.
double mrNoiseCeiling(const IntensityHistogram& histogram);

} // namespace petrous::volume
