#pragma once

#include "petrous/Volume/IntensityHistogram.h"

namespace petrous::volume
{

/// Where bone lies among an image's intensities.
struct IntensityScale
{
  double iso = 300.0;     ///< surface of bone: what corresponds to 300 HU
  double dense = 1800.0;  ///< dense cortical bone; always above iso
  bool calibrated = true; ///< the image is in Hounsfield units, and the values above hold
};

/// From the histogram alone, so that bone shows at once in cone-beam and micro-CT too.
///
/// Calibrated (300, 1800): air lies near -1000 and soft tissue, where there is a peak of it, near
/// 0 to 100; or there are negative values and one of the two is found. Else, with peaks of air and
/// soft tissue, those two points give gain and offset, for -1000 and 40 HU, and with them iso and
/// the least value of dense; iso keeps clear of the soft tissue's noise, and goes halfway to Otsu's
/// threshold where the file's numbers cut air off. Else iso is halfway between the two classes
/// that Otsu's threshold finds (IEEE Trans. SMC 9:62, 1979). dense is the 99th percentile above
/// iso.
///
/// No voxel at all: 300 and 1800, calibrated. Never throws; all values are finite.
IntensityScale suggestScale(const IntensityHistogram& histogram);

} // namespace petrous::volume
