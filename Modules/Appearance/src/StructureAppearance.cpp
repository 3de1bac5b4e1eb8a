#include "petrous/Appearance/StructureAppearance.h"

#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

#include "petrous/Appearance/OwnPresets.h"
#include "petrous/Appearance/StructureProperties.h"
#include "petrous/Core/Error.h"

namespace petrous::appearance
{

namespace
{

// Calls `action` with each flag and its name.
template <class Action>
void forEachFlag(const Action& action)
{
  for (const StructureProperty& property : kStructureProperties)
    if (property.storage == StructureProperty::Storage::InFlags)
      action(std::get<StructureProperty::Flag>(property.member), std::string(property.key));
}

} // namespace

void setFlags(StructureAppearance& look, const std::string& flags)
{
  StructureAppearance result = look;
  forEachFlag([&result](auto flag, const std::string&) { result.*flag = false; });
  std::istringstream list(flags);
  for (std::string word; std::getline(list, word, ',');)
  {
    bool isKnown = word == "none";
    std::string names;
    forEachFlag(
        [&](auto flag, const std::string& name)
        {
          names += (names.empty() ? "" : ", ") + name;
          if (word == name)
            isKnown = result.*flag = true;
        });
    if (!isKnown)
      throw core::InvalidParameter("flag '" + word + "' is unknown; use " + names + " or none");
  }
  look = result;
}

void changeFlags(StructureAppearance& look, const std::string& flags)
{
  const auto isSigned = [](const std::string& word)
  { return word.size() > 1 && (word.front() == '+' || word.front() == '-'); };
  std::vector<std::string> words;
  std::istringstream list(flags);
  for (std::string word; std::getline(list, word, ',');)
    words.push_back(word);
  const auto signs = std::count_if(words.begin(), words.end(), isSigned);
  if (signs == 0)
    return setFlags(look, flags);
  if (signs != static_cast<std::ptrdiff_t>(words.size()))
    throw core::InvalidParameter("flags '" + flags +
                                 "': give all of them a sign (+touchable,-drillable), or none");
  StructureAppearance result = look;
  for (const std::string& word : words)
  {
    StructureAppearance named;
    setFlags(named, word.substr(1)); // throws where it is unknown
    forEachFlag(
        [&](auto flag, const std::string&)
        {
          if (named.*flag)
            result.*flag = word.front() == '+';
        });
  }
  look = result;
}

std::string flagsOf(const StructureAppearance& look)
{
  std::string flags;
  forEachFlag(
      [&](auto flag, const std::string& name)
      {
        if (look.*flag)
          flags += (flags.empty() ? "" : ",") + name;
      });
  return flags.empty() ? "none" : flags;
}

void setColor(StructureAppearance& look, const std::array<float, 3>& color)
{
  if (std::any_of(color.begin(), color.end(), [](float x) { return !(x >= 0.0F && x <= 1.0F); }))
    throw core::InvalidParameter("colour: red, green and blue must lie in 0 to 1");
  if (look.transfer && color != look.color) // else rounding alone would change its points
  {
    const auto brightness = [](const std::array<float, 3>& c)
    { return 0.299F * c[0] + 0.587F * c[1] + 0.114F * c[2]; };
    const float before = brightness(look.color);
    std::vector<ControlPoint> points = look.transfer->points();
    for (ControlPoint& point : points)
    {
      const float share = before > 0.0F ? brightness(point.color) / before : 1.0F;
      for (std::size_t c = 0; c < 3; ++c)
        point.color[c] = std::min(color[c] * share, 1.0F);
    }
    look.transfer = TransferFunction(std::move(points));
  }
  look.color = color;
}

void makeUntouchable(StructureAppearance& look)
{
  const StructureAppearance plain;
  look.touchable = look.drillable = false;
  look.tissue = plain.tissue;
  look.stiffness = plain.stiffness;
  look.warning = plain.warning;
}

void applyPreset(StructureAppearance& look, const StructureAppearance& preset)
{
  StructureAppearance result = preset;
  result.shown = look.shown;
  result.touchable = look.touchable;
  result.drillable = look.drillable;
  result.sourceImage = look.sourceImage;
  look = std::move(result);
}

void applySoftTissuePreset(StructureAppearance& look, const StructureAppearance& preset)
{
  applyPreset(look, preset);
  makeUntouchable(look);
  if (look.relative || preset.sourceImage == OwnPresets::kOfCt)
    look.sourceImage.clear();
}

} // namespace petrous::appearance
