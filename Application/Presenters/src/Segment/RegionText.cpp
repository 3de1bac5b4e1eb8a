#include "petrous/Presenters/RegionText.h"

#include <algorithm>
#include <iterator>

#include "petrous/Core/NumberText.h"
#include "petrous/Core/PositionText.h"
#include "petrous/Scene/GoneNames.h"

namespace petrous::presenters
{

namespace
{

constexpr double kAir = -400.0; // HU; air is below, as the contours of a border to air have it
constexpr double kPerCubicCentimetre = 1e3;
constexpr const char* kSeed = "The seed at ";
constexpr const char* kRange = "The range of ";
constexpr const char* kRegions[] = {"The region has ", "The region reaches "};

bool startsWith(const std::string& text, const std::string& words)
{
  return text.compare(0, words.size(), words) == 0;
}

} // namespace

std::string seedText(const std::optional<segmentation::SeedSurroundings>& surroundings,
                     const Eigen::Vector3d& seed, const std::string& unit)
{
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

std::string rangeText(const volume::ValueRange& range, const std::string& unit,
                      const std::optional<double>& iso)
{
  if (!iso || range.min >= kAir || range.max <= *iso)
    return {};
  return "The range of " + core::fixedText(range.min, 0) + " to " + core::fixedText(range.max, 0) +
         unit + " reaches from air to bone: it is that of no tissue.";
}

std::vector<std::string> regionTexts(const segmentation::Mask& region)
{
  const segmentation::RegionDoubts doubts = segmentation::doubtsOf(region);
  std::vector<std::string> texts;
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

StructureNotes notesOf(const scene::LabelPart& part, const std::string& structure)
{
  scene::Case alone; // of the file's other structures, and of what was left out, it has none
  alone.labels.push_back(part);
  auto& structures = alone.labels.front().structures;
  structures.erase(std::remove_if(structures.begin(), structures.end(),
                                  [&structure](const auto& one) { return one.name != structure; }),
                   structures.end());
  StructureNotes notes;
  for (const std::string& note : part.notes)
  {
    if (part.structures.size() > 1 && !scene::quotesOnlyParts(alone, note))
      continue;
    // Earlier versions named the structure before such a sentence.
    const std::string named = "'" + structure + "': ";
    const std::string text = startsWith(note, named) ? note.substr(named.size()) : note;
    const bool isOfRegion =
        std::any_of(std::begin(kRegions), std::end(kRegions),
                    [&text](const char* words) { return startsWith(text, words); });
    notes.isGrown =
        notes.isGrown || isOfRegion || startsWith(text, kSeed) || startsWith(text, kRange);
    if (!isOfRegion)
      notes.texts.push_back(text);
  }
  return notes;
}

} // namespace petrous::presenters
