#include "petrous/Scene/GoneNames.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace petrous::scene
{

namespace
{

// What notes quote that is no name: commands.
constexpr const char* kCommand = "petrous scan";

constexpr const char* kRemovedImage = "removed image";

void removeAll(std::string& text, const std::string& words)
{
  for (std::size_t at = text.find(words); at != text.npos; at = text.find(words, at))
    text.erase(at, words.size());
}

// The longest first: one name may be within another.
std::vector<std::string> quotedNames(const Case& value)
{
  std::vector<std::string> names = partNames(value);
  names.emplace_back(kCommand);
  std::sort(names.begin(), names.end(),
            [](const auto& a, const auto& b) { return a.size() > b.size(); });
  for (std::string& name : names)
    name = "'" + name + "'";
  return names;
}

bool quotesOnly(const std::vector<std::string>& names, std::string text)
{
  for (const std::string& name : names)
    removeAll(text, name);
  // A quotation begins where no word ends: the apostrophe of "patient's" and "files'" does not.
  for (std::size_t at = text.find('\''); at != text.npos; at = text.find('\'', at + 1))
    if (at == 0 || (std::isalnum(static_cast<unsigned char>(text[at - 1])) == 0 &&
                    static_cast<unsigned char>(text[at - 1]) < 0x80))
      return false;
  return true;
}

} // namespace

bool quotesOnlyParts(const Case& value, const std::string& text)
{
  return quotesOnly(quotedNames(value), text);
}

void forgetGoneReferences(Case& value)
{
  const auto isGone = [&value](const std::string& mr) { return !mr.empty() && !findMr(value, mr); };
  const auto showsCt = [&isGone](appearance::StructureAppearance& look)
  {
    if (isGone(look.sourceImage))
      look.sourceImage.clear();
  };
  showsCt(value.boneLook);
  if (isGone(value.softTissue.sourceImage))
    appearance::readPrimaryImage(value.softTissue);
  for (ImagePart& mr : value.mr)
    if (mr.registration && isGone(mr.registration->through))
      mr.registration->through.clear();
  for (LabelPart& part : value.labels)
    for (StructurePart& structure : part.structures)
      showsCt(structure.look);
  for (MeshPart& mesh : value.meshes)
    showsCt(mesh.look);
  if (auto& slices = value.view.slices; slices && slices->overlay && isGone(slices->overlay->mr))
    slices->overlay.reset();
}

void forgetGoneNames(Case& value)
{
  forgetGoneReferences(value);
  const std::vector<std::string> names = quotedNames(value);
  const auto clean = [&names](std::vector<std::string>& notes)
  {
    notes.erase(std::remove_if(notes.begin(), notes.end(),
                               [&names](const std::string& note)
                               { return !quotesOnly(names, note); }),
                notes.end());
  };
  clean(value.ct.notes);
  for (ImagePart& mr : value.mr)
  {
    clean(mr.notes);
    if (!mr.registration)
      continue;
    Registration& how = *mr.registration;
    if (!quotesOnly(names, how.text))
      how.text.clear();
    if (how.error && !quotesOnly(names, how.error->place))
      how.error->place = kUnnamedPlace;
  }
  const auto forgetGone = [&value](MrReadings& readings)
  {
    for (MrReading& reading : readings)
      if (reading.isGone || !findMr(value, reading.mr))
      {
        reading.mr = kRemovedImage;
        reading.isGone = true;
      }
  };
  // Where it was set counts (an empty image is the CT), its name does not.
  for (Measurement& measurement : value.measurements)
  {
    const auto forget = [&value](std::string& image)
    {
      if (!image.empty() && !findMr(value, image))
        image = kRemovedImage;
    };
    forget(measurement.image);
    std::for_each(measurement.images.begin(), measurement.images.end(), forget);
    forgetGone(measurement.readings);
    if (measurement.structureGone ||
        (!measurement.structure.empty() && !kindOfPart(value, measurement.structure)))
    {
      measurement.structure.clear();
      measurement.structureGone = false;
    }
  }
  for (LabelPart& part : value.labels)
  {
    clean(part.notes);
    for (StructurePart& structure : part.structures)
      forgetGone(structure.readings);
  }
  for (MeshPart& mesh : value.meshes)
    clean(mesh.notes);
}

} // namespace petrous::scene
