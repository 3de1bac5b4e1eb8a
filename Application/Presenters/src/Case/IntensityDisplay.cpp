#include "petrous/Presenters/IntensityDisplay.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "petrous/Appearance/AppearanceMaterial.h"
#include "petrous/Core/NumberText.h"

namespace petrous::presenters
{

namespace
{

constexpr double kSteps = 1000.0;       // minimum number of threshold steps over the range
constexpr double kUsualLeast = -1000.0; // HU, minimum of typical CT values
constexpr double kUsualSpan = 4000.0;   // HU, their range

double roundStep(double largest)
{
  const double power = std::pow(10.0, std::floor(std::log10(largest)));
  return power * (largest >= 5.0 * power ? 5.0 : largest >= 2.0 * power ? 2.0 : 1.0);
}

int decimalsFor(double step)
{
  return std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
}

// Clipped to the image's range; the full range if nothing remains.
GreyWindow windowOf(double black, double white, const volume::ValueRange& range)
{
  black = std::max(black, range.min);
  white = std::min(white, range.max);
  if (!(white > black))
  {
    black = range.min;
    white = range.max;
  }
  return {white - black, 0.5 * (white + black)};
}

} // namespace

std::string IntensityDisplay::number(double value) const
{
  const std::string text = core::fixedText(value, decimals);
  return text.find_first_not_of("-0.") == std::string::npos ? core::fixedText(0.0, decimals) : text;
}

std::string IntensityDisplay::text(double value) const
{
  return number(value) + suffix();
}

volume::IntensityScale calibratedScale(const scene::Case& value)
{
  volume::IntensityScale scale = value.intensityScale();
  scale.calibrated =
      value.ct.modality != scene::Modality::Mr && scale.dense == volume::IntensityScale{}.dense;
  return scale;
}

volume::IntensityScale softTissueScale(const scene::Case& value)
{
  const volume::IntensityScale scale = calibratedScale(value);
  if (scale.calibrated)
    return {};
  const auto& soft = value.softTissueValues;
  return soft && soft->foot < soft->peak ? volume::scaleThrough(*soft) : scale;
}

std::string softTissueEstimate(const scene::Case& value)
{
  const appearance::StructureAppearance& look = value.softTissue;
  if (value.ct.modality == scene::Modality::Mr || !look.transfer || !look.relative ||
      !look.sourceImage.empty() || calibratedScale(value).calibrated)
    return {};
  const auto& soft = softTissueScale(value).soft;
  if (!soft)
    return "It is not known where the values of air end: those of soft tissue follow the scale of "
           "bone, and may be air";
  const IntensityDisplay display = displayOf(value);
  return "Estimated from the image's histogram: air ends at " + display.number(soft->foot) +
         ", and most of soft tissue is at " + display.number(soft->peak);
}

const char* primaryName(const scene::Case& value)
{
  return value.ct.modality == scene::Modality::Mr ? "MR" : "CT";
}

IntensityDisplay displayOf(const scene::Case& value)
{
  IntensityDisplay display;
  const volume::IntensityScale scale = calibratedScale(value);
  const volume::ValueRange& range = value.ct.range;
  display.hounsfield = scale.calibrated;
  if (!scale.calibrated && range.max > range.min)
  {
    // A threshold above dense bone does not define the scale: map the typical CT range to the
    // image's.
    const double whole = (range.max - range.min) / kUsualSpan;
    const auto at = [&](double hounsfield)
    {
      return scale.dense > scale.iso ? appearance::onScale(hounsfield, scale)
                                     : range.min + whole * (hounsfield - kUsualLeast);
    };
    display.unit = at(1.0) - at(0.0);
    display.bone = windowOf(at(-1300.0), at(2700.0), range);
    display.soft = windowOf(at(-160.0), at(240.0), range);
    display.temporal = windowOf(at(-800.0), at(2000.0), range);
    if (value.ct.modality == scene::Modality::Mr && scale.dense > scale.iso)
    {
      // From what is as dark below the surface as tissue is bright above it, to the 99th percentile
      // of tissue (volume::suggestMrScale); the narrow one leaves out the bright half.
      const double reach = scale.dense - scale.iso;
      display.bone = windowOf(scale.iso - reach, scale.dense, range);
      display.soft = windowOf(scale.iso - reach, scale.iso + 0.5 * reach, range);
    }
    display.least = range.min;
    display.most = range.max;
    display.step = roundStep((range.max - range.min) / kSteps);
    display.decimals = decimalsFor(display.step);
  }
  display.least = std::min(display.least, value.iso);
  display.most = std::max(display.most, value.iso);
  return display;
}

IntensityDisplay displayOf(const scene::ImagePart& mr)
{
  IntensityDisplay display;
  display.hounsfield = false;
  if (!(mr.range.max > mr.range.min))
    return display;
  display.unit = (mr.range.max - mr.range.min) / kUsualSpan;
  display.least = mr.range.min;
  display.most = mr.range.max;
  display.step = roundStep((mr.range.max - mr.range.min) / kSteps);
  display.decimals = decimalsFor(display.step);
  return display;
}

std::vector<NamedWindow> greyWindows(const scene::Case& value)
{
  const IntensityDisplay display = displayOf(value);
  if (value.ct.modality == scene::Modality::Mr)
    return {{"All tissue", display.bone}, {"Dark half", display.soft}};
  return {
      {"Bone", display.bone}, {"Temporal bone", display.temporal}, {"Soft tissue", display.soft}};
}

std::vector<NamedWindow> mrWindows(const GreyWindow& suggested)
{
  const double black = suggested.level - 0.5 * suggested.width;
  return {{"All tissue", suggested},
          {"Dark half", {0.5 * suggested.width, black + 0.25 * suggested.width}}};
}

std::string shownValues(const scene::Case& value, const ShownImages& shown,
                        const SliceOverlay* overlay, const Eigen::Vector3d& patient)
{
  const auto sample = [](const volume::IntensityVolume& image,
                         const Eigen::Vector3d& at) -> std::optional<double>
  {
    const Eigen::Vector3d voxel = image.geometry().voxelFromPatient(at);
    return image.geometry().hullContains(voxel) ? std::optional<double>(image.sample(voxel))
                                                : std::nullopt;
  };
  const scene::ImagePart* mr = scene::findMr(value, shown.mr);
  const bool hasMr = mr && overlay && overlay->mr;
  const auto entry = [](const std::string& name, const std::optional<double>& number,
                        const IntensityDisplay& display)
  { return name + " " + (number ? display.text(*number) : "–"); };
  std::string text;
  if (const auto image = shown.ct || !hasMr ? value.ct.volume.get() : nullptr)
  {
    const auto number = sample(*image, patient);
    if (hasMr)
      text = entry(primaryName(value), number, displayOf(value)) + "  ";
    else if (number)
      text = displayOf(value).text(*number);
  }
  if (hasMr)
    text += entry(mr->name, sample(*overlay->mr, overlay->mrFromCt * patient), displayOf(*mr));
  return text;
}

} // namespace petrous::presenters
