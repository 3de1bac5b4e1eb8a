#include "petrous/Presenters/RegionText.h"

#include "petrous/Core/NumberText.h"
#include "petrous/Core/PositionText.h"

namespace petrous::presenters
{

namespace
{

constexpr double kAir = -400.0; // HU; air is below, as the contours of a border to air have it
constexpr double kPerCubicCentimetre = 1e3;

} // namespace

std::string seedText(const volume::IntensityVolume& image, const Eigen::Vector3d& seed,
                     const std::string& unit)
{
  const auto surroundings = segmentation::surroundingsOf(image, seed);
  if (!surroundings || !surroundings->isBorder)
    return {};
  const std::string place = core::positionText(seed);
  const std::string darker = core::fixedText(surroundings->darker, 0);
  const std::string brighter = core::fixedText(surroundings->brighter, 0);
  if (!surroundings->inside)
    return "The seed at " + place + " lies on a border of tissues of about " + darker + " and " +
           brighter + unit +
           ", and a range around it may be neither's; set it inside the structure.";
  return "The seed at " + place + " lies on a border of tissues of about " + darker + " and " +
         brighter + unit + ", and a range around it may be neither's; " +
         core::positionText(*surroundings->inside) + " lies inside.";
}

std::vector<std::string> regionTexts(const segmentation::Mask& region,
                                     const volume::ValueRange& range, const std::string& unit,
                                     const std::optional<double>& iso)
{
  const segmentation::RegionDoubts doubts = segmentation::doubtsOf(
      region, range, iso ? std::optional(volume::ValueRange{kAir, *iso}) : std::nullopt);
  std::vector<std::string> texts;
  if (doubts.spans)
    texts.push_back("The range of " + core::fixedText(doubts.spans->min, 0) + " to " +
                    core::fixedText(doubts.spans->max, 0) + unit +
                    " reaches from air to bone: it is that of no tissue.");
  if (doubts.volume)
    texts.push_back(
        "The region has " + core::fixedText(*doubts.volume / kPerCubicCentimetre, 0) +
        " cm³, and hardly a structure of the skull base more than " +
        core::fixedText(segmentation::RegionDoubts::kMostVolume / kPerCubicCentimetre, 0) +
        " cm³: it may have run into what surrounds it.");
  if (doubts.faces)
    texts.push_back("The region reaches " + std::to_string(*doubts.faces) +
                    " of the 6 faces of the image: it may have run into what surrounds it.");
  return texts;
}

void addDoubts(scene::LabelPart& part, const std::string& name,
               const std::vector<std::string>& doubts)
{
  for (const std::string& text : doubts)
    part.notes.push_back("'" + name + "': " + text);
}

} // namespace petrous::presenters
