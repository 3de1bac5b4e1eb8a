#include "NotedProvenance.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include "petrous/Core/NumberText.h"

namespace petrous::scene
{

namespace
{

using Notes = std::vector<std::string>;

bool beginsWith(const std::string& text, std::string_view begin)
{
  return text.compare(0, begin.size(), begin) == 0;
}

bool contains(const std::string& text, std::string_view part)
{
  return text.find(part) != text.npos;
}

/// The number between `before` and `after` in a note; nullopt: it is another note.
std::optional<double> numberIn(const std::string& note, std::string_view before,
                               std::string_view after)
{
  const std::size_t at = note.find(before);
  if (at == note.npos)
    return std::nullopt;
  const std::size_t from = at + before.size();
  const std::size_t to = note.find(after, from);
  return to == note.npos ? std::nullopt : core::parseDouble(note.substr(from, to - from));
}

/// The number at `at`, which is then after it; 0: none.
int takeNumber(const std::string& text, std::size_t& at)
{
  int number = 0;
  const auto read = std::from_chars(text.data() + at, text.data() + text.size(), number);
  at = static_cast<std::size_t>(read.ptr - text.data());
  return read.ec == std::errc() ? number : 0;
}

/// "Repaired: slices 3, 7 to 9 of 60 were interpolated between neighbours, .."
void addSlices(const std::string& note, int slices, std::vector<volume::SliceRange>& ranges)
{
  constexpr std::string_view kOf = " of ", kTo = " to ", kAnd = ", ";
  const std::size_t of = note.find(kOf);
  if (of == note.npos || !contains(note, "interpolated between neighbours"))
    return;
  std::size_t at = of + kOf.size();
  if (takeNumber(note, at) != slices)
    return;
  for (const std::string_view begin : {"Repaired: slices ", "Repaired: slice "})
  {
    if (!beginsWith(note, begin))
      continue;
    for (at = begin.size(); at < of; at += kAnd.size())
    {
      const int first = takeNumber(note, at);
      int last = first;
      if (note.compare(at, kTo.size(), kTo) == 0)
      {
        at += kTo.size();
        last = takeNumber(note, at);
      }
      if (first < 1 || last < first || last > slices ||
          (!ranges.empty() && first - 1 <= ranges.back().last + 1))
        break;
      ranges.push_back({first - 1, last - 1});
    }
  }
}

std::optional<bool> notedAxes(const std::string& note)
{
  const std::string_view open = "does not say which side of the patient is left; its axes were "
                                "taken as ";
  const std::size_t at = note.find(open);
  return at == note.npos ? std::nullopt
                         : std::optional<bool>(note.compare(at + open.size(), 3, "RAS") == 0);
}

} // namespace

volume::ImageProvenance provenanceFromNotes(const Notes& notes, int slices)
{
  volume::ImageProvenance provenance;
  for (const std::string& note : notes)
  {
    addSlices(note, slices, provenance.interpolated);
    if (beginsWith(note, "Repaired: the gantry's tilt of "))
    {
      provenance.tilt = numberIn(note, "tilt of ", " degrees").value_or(0.0);
      provenance.shift = numberIn(note, "the last by ", " mm").value_or(0.0);
    }
    else if (beginsWith(note, "Repaired: slices were shifted sideways"))
      provenance.shift = numberIn(note, "by up to ", " mm").value_or(0.0);
    else if (beginsWith(note, "Compressed with loss"))
    {
      provenance.pixels.isLossy = true;
      const auto ratio = numberIn(note, ", to 1/", " of the size");
      if (ratio && *ratio > 0.0)
        provenance.pixels.lossyRatio = ratio;
    }
    else if (beginsWith(note, "the face is masked"))
    {
      provenance.isFaceMasked = true;
      provenance.areEarsMasked = contains(note, ", with the auricles");
    }
    if (contains(note, "cropped to a region"))
      provenance.isCropped = true;
    if (contains(note, ": it may name the patient; look at the image before it is handed on."))
      provenance.pixels.burnedIn =
          std::max(provenance.pixels.burnedIn,
                   beginsWith(note, "The header states text in the pixels (Burned In Annotation)")
                       ? volume::BurnedInText::Stated
                       : volume::BurnedInText::Suspected);
    if (const auto assumed = notedAxes(note))
      provenance.assumedRas = assumed;
  }
  return provenance;
}

LabelProvenance labelProvenanceFromNotes(const Notes& notes)
{
  LabelProvenance provenance;
  for (const std::string& note : notes)
  {
    if (const auto assumed = notedAxes(note))
      provenance.assumedRas = assumed;
    if (beginsWith(note, "its frame of reference could not be compared with the "))
      provenance.isFrameAssumed = true;
  }
  return provenance;
}

} // namespace petrous::scene
