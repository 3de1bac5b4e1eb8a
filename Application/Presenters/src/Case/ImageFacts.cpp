#include "petrous/Presenters/ImageFacts.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "petrous/Imaging/ImageFile.h"

namespace petrous::presenters
{

namespace
{

using imaging::BurnedInText;
using Text = scene::ImageFacts::Text;
constexpr std::pair<BurnedInText, Text> kTexts[] = {{BurnedInText::None, Text::None},
                                                    {BurnedInText::Suspected, Text::Suspected},
                                                    {BurnedInText::Stated, Text::Stated}};

std::vector<int> notedSlices(const scene::ImagePart& image)
{
  // "Repaired: slices 3, 7 to 9 of 60 were interpolated between neighbours, ..."
  const std::string begins[] = {"Repaired: slices ", "Repaired: slice "};
  std::vector<int> found;
  for (const std::string& note : image.notes)
    for (const std::string& begin : begins)
    {
      const auto of = note.find(" of ");
      if (note.rfind(begin, 0) != 0 || of == std::string::npos ||
          note.find("interpolated between neighbours") == std::string::npos)
        continue;
      int count = 0;
      if (std::sscanf(note.c_str() + of, " of %d", &count) != 1 ||
          count != image.geometry.dims()[2])
        continue;
      for (std::size_t at = begin.size(); at < of;)
      {
        int first = 0;
        int last = 0;
        const int read = std::sscanf(note.c_str() + at, "%d to %d", &first, &last);
        if (read < 1)
          break;
        for (int n = std::max(first, 1); n <= std::min(read == 2 ? last : first, count); ++n)
          found.push_back(n - 1);
        const auto comma = note.find(", ", at);
        at = comma == std::string::npos ? of : comma + 2;
      }
    }
  return found;
}

} // namespace

scene::ImageFacts factsOf(const scene::ImagePart& image)
{
  if (image.facts)
    return *image.facts;
  scene::ImageFacts facts;
  facts.interpolated = notedSlices(image);
  facts.isSideAssumed = std::any_of(image.notes.begin(), image.notes.end(), imaging::isNoteOfSide);
  take(facts, imaging::pixelFaults(image.notes));
  return facts;
}

void take(scene::ImageFacts& facts, const imaging::PixelFaults& pixels)
{
  for (const auto& [stated, text] : kTexts)
    if (stated == pixels.burnedIn)
      facts.text = text;
  facts.isLossy = pixels.isLossy;
  facts.lossyRatio = pixels.lossyRatio;
}

imaging::PixelFaults pixelFaultsOf(const scene::ImageFacts& facts)
{
  imaging::PixelFaults pixels;
  for (const auto& [stated, text] : kTexts)
    if (text == facts.text)
      pixels.burnedIn = stated;
  pixels.isLossy = facts.isLossy;
  pixels.lossyRatio = facts.lossyRatio;
  return pixels;
}

} // namespace petrous::presenters
