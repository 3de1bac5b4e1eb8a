#pragma once

#include <string>

#include "petrous/Presenters/SliceOverlay.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// A case's image is in Hounsfield units where dense bone lies where it does in them: the histogram
/// of any other puts it elsewhere (volume::suggestScale).
volume::IntensityScale calibratedScale(const scene::Case& value);

/// How the numbers of a case's CT are shown: in Hounsfield units where it is calibrated, else in
/// its own (cone beam, micro-CT), with what corresponds to them.
struct IntensityDisplay
{
  bool hounsfield = true;
  double unit = 1.0; ///< what corresponds to 1 HU, of the image's own; > 0
  int decimals = 0;  ///< that tell neighbouring units apart
  GreyWindow bone;   ///< -1300 to 2700 HU
  GreyWindow soft{400.0, 40.0};
  double least = -500.0; ///< of the thresholds that are offered
  double most = 2500.0;
  double step = 1.0; ///< between them, a round number

  std::string suffix() const { return hounsfield ? " HU" : ""; }
  std::string number(double value) const; ///< "300", "0.0312"
  std::string text(double value) const;   ///< "300 HU", "0.0312"
};

/// Windows and thresholds of an image that is not calibrated lie within its range, on the line
/// through the surface of bone (300 HU) and dense bone (1800 HU). The case's own threshold is
/// always among those that are offered. Never throws.
IntensityDisplay displayOf(const scene::Case& value);

} // namespace petrous::presenters
