#pragma once

#include <string>
#include <vector>

#include "petrous/Presenters/SliceOverlay.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// The case's intensity scale; calibrated (Hounsfield units) if dense bone is where it is in HU,
/// which the histogram of any other image does not show (volume::suggestScale).
volume::IntensityScale calibratedScale(const scene::Case& value);

/// To which presets of soft tissue are mapped: Hounsfield units where the case's scale is
/// calibrated, whatever the threshold of bone; else by Case::softTissueValues, so that the default
/// look begins where air ends, and where they are not known the case's scale.
volume::IntensityScale softTissueScale(const scene::Case& value);

/// Of that, what is an estimate, for the user; empty where it is not used: in Hounsfield units, of
/// an MR, or of a transfer function with values of its own.
std::string softTissueEstimate(const scene::Case& value);

/// "CT", or "MR": what a user calls the primary image.
const char* primaryName(const scene::Case& value);

/// How intensities of a case's CT are displayed: in Hounsfield units if it is calibrated, else in
/// its own (cone beam, micro-CT), with equivalent ranges.
struct IntensityDisplay
{
  bool hounsfield = true;
  double unit = 1.0; ///< equivalent of 1 HU in the image's own units; > 0
  int decimals = 0;  ///< that distinguish neighbouring units
  GreyWindow bone;   ///< -1300 to 2700 HU
  GreyWindow soft{400.0, 40.0};
  GreyWindow temporal{2800.0, 600.0};
  double least = -500.0; ///< of the thresholds offered
  double most = 2500.0;
  double step = 1.0; ///< of the thresholds offered; a round number

  std::string suffix() const { return hounsfield ? " HU" : ""; }
  std::string number(double value) const; ///< "300", "0.0312"
  std::string text(double value) const;   ///< "300 HU", "0.0312"
};

/// Windows and thresholds of an uncalibrated image lie within its range, on the line through the
/// surface of bone (300 HU) and dense bone (1800 HU). The case's own threshold is always within the
/// range offered. Never throws.
IntensityDisplay displayOf(const scene::Case& value);

/// Of an MR beside the primary image: in its own values, which have no unit. Windows are not set.
IntensityDisplay displayOf(const scene::ImagePart& mr);

/// A grey window that is offered by name.
struct NamedWindow
{
  std::string name; ///< English
  GreyWindow window;
};
/// "Bone", "Temporal bone" and "Soft tissue" of a CT; "All tissue" and "Dark half" of an MR.
std::vector<NamedWindow> greyWindows(const scene::Case& value);
/// Of an MR, from the window that was suggested for it.
std::vector<NamedWindow> mrWindows(const GreyWindow& suggested);

/// Values at a point (patient LPS mm) of the images that slices show: "300 HU" of the primary image
/// alone, "T2 412" of an MR, "CT 300 HU  T2 412" of both; "–" outside of a named image.
/// `overlay`: that of `shown.mr`, or nullptr.
std::string shownValues(const scene::Case& value, const ShownImages& shown,
                        const SliceOverlay* overlay, const Eigen::Vector3d& patient);

} // namespace petrous::presenters
