#include "petrous/Presenters/ProvenanceText.h"

#include <cmath>

#include "petrous/Core/NumberText.h"
#include "petrous/Presenters/IntensityDisplay.h"

namespace petrous::presenters
{

namespace
{

using volume::ImageProvenance;

std::string slicesText(const std::vector<volume::SliceRange>& ranges, std::size_t most = 0)
{
  return (volume::sliceCount(ranges) == 1 ? "slice " : "slices ") + volume::toString(ranges, most);
}

// What repair did to the voxels. `most`: slice ranges that are named, 0: all.
std::vector<std::string> repairs(const scene::ImagePart& image, std::size_t most = 0)
{
  const ImageProvenance& provenance = image.provenance;
  std::vector<std::string> texts;
  if (!provenance.interpolated.empty())
    texts.push_back(slicesText(provenance.interpolated, most) + " of " +
                    std::to_string(image.geometry.dims()[2]) + " interpolated between neighbours");
  if (provenance.tilt != 0.0)
    texts.push_back("gantry tilt of " + core::fixedText(provenance.tilt, 1) +
                    " degrees undone, slices shifted by up to " +
                    core::fixedText(provenance.shift, 1) + " mm");
  else if (provenance.shift != 0.0)
    texts.push_back("slices shifted sideways by up to " + core::fixedText(provenance.shift, 2) +
                    " mm");
  return texts;
}

void addMasks(const ImageProvenance& provenance, std::vector<std::string>& texts)
{
  if (provenance.isFaceMasked)
    texts.emplace_back(provenance.areEarsMasked ? "face and auricles masked" : "face masked");
  if (provenance.isCropped)
    texts.emplace_back("cropped to a region");
}

void add(const std::vector<std::string>& more, std::vector<std::string>& texts)
{
  texts.insert(texts.end(), more.begin(), more.end());
}

std::string assumedSideText(bool assumedRas)
{
  return std::string("left and right taken as ") + (assumedRas ? "RAS" : "LPS") +
         " axes, as the file does not say which side of the patient is left";
}

} // namespace

const char* directionText(char letter)
{
  switch (letter)
  {
  case 'L':
    return "left";
  case 'R':
    return "right";
  case 'P':
    return "back";
  case 'A':
    return "front";
  case 'S':
    return "head";
  default:
    return "feet";
  }
}

std::string correctedAxesText(const core::AxesCorrection& axes)
{
  return "axes of the file corrected (" + axes.letters() +
         "): what it calls left, back and head is the patient's " + directionText(axes.letter(0)) +
         ", " + directionText(axes.letter(1)) + " and " + directionText(axes.letter(2));
}

std::vector<std::string> axesTexts(const std::optional<bool>& assumedRas,
                                   const core::AxesCorrection& axes)
{
  std::vector<std::string> texts;
  if (assumedRas)
    texts.push_back(assumedSideText(*assumedRas));
  if (!axes.isIdentity())
    texts.push_back(correctedAxesText(axes));
  return texts;
}

std::string interpolatedText(const scene::ImagePart& image)
{
  constexpr std::size_t kNamed = 4; // ranges
  return image.provenance.interpolated.empty()
             ? std::string()
             : slicesText(image.provenance.interpolated, kNamed) + " interpolated";
}

std::vector<std::string> interpolatedTexts(const scene::Case& value)
{
  std::vector<std::string> lines;
  const auto add = [&lines](const std::string& name, const scene::ImagePart& image)
  {
    if (const std::string text = interpolatedText(image); !text.empty())
      lines.push_back(name + ": " + text);
  };
  add(primaryName(value), value.ct);
  for (const scene::ImagePart& mr : value.mr)
    add(mr.name, mr);
  return lines;
}

bool showsInterpolated(const scene::ImagePart& image, const SliceGeometry& picture,
                       double thickness)
{
  constexpr double kAlong = 0.7; // cosine: a slice of the picture is one of the grid
  const core::GridGeometry& grid = image.geometry;
  if (std::abs(grid.direction().col(2).dot(picture.axes().next)) < kAlong)
    return false;
  const double slice = grid.voxelFromPatient(picture.center())[2];
  const double reach = 0.5 * thickness / grid.spacing()[2];
  const int last = static_cast<int>(std::lround(slice + reach));
  for (int k = static_cast<int>(std::lround(slice - reach)); k <= last; ++k)
    if (volume::contains(image.provenance.interpolated, k))
      return true;
  return false;
}

std::vector<std::string> provenanceTexts(const scene::ImagePart& image)
{
  const ImageProvenance& provenance = image.provenance;
  std::vector<std::string> texts = repairs(image);
  addMasks(provenance, texts);
  add(axesTexts(provenance.assumedRas, provenance.axes), texts);
  if (provenance.pixels.isLossy)
    texts.push_back(
        "compressed with loss" +
        (provenance.pixels.lossyRatio
             ? ", to 1/" + core::fixedText(*provenance.pixels.lossyRatio, 1) + " of the size"
             : std::string()));
  if (provenance.pixels.burnedIn != volume::BurnedInText::None)
    texts.push_back(provenance.pixels.burnedIn == volume::BurnedInText::Stated
                        ? "text in the pixels"
                        : "perhaps text in the pixels");
  return texts;
}

std::vector<std::string> provenanceTexts(const scene::LabelPart& part)
{
  std::vector<std::string> texts = axesTexts(part.provenance.assumedRas, part.provenance.axes);
  if (part.provenance.isFrameAssumed)
    texts.push_back("not known to be in the frame of reference of the image on which it is shown");
  return texts;
}

std::vector<std::string> assumedSideTexts(const scene::Case& value)
{
  std::vector<std::string> lines;
  const auto add = [&lines](const std::string& name, const auto& provenance)
  {
    for (const std::string& text : axesTexts(provenance.assumedRas, provenance.axes))
      lines.push_back(name + ": " + text);
  };
  add(primaryName(value), value.ct.provenance);
  for (const scene::ImagePart& mr : value.mr)
    add(mr.name, mr.provenance);
  for (const scene::LabelPart& part : value.labels)
    add(part.structures.size() == 1 ? part.structures.front().name : "structures", part.provenance);
  return lines;
}

std::string derivationText(const scene::ImagePart& image, bool onCt)
{
  constexpr std::size_t kLongest = 900; // of the 1024 of an ST (PS3.5 6.2)
  const auto textOf = [&](std::size_t most)
  {
    std::vector<std::string> texts = repairs(image, most);
    std::string text = onCt            ? "Resampled from an image of which: "
                       : texts.empty() ? ""
                                       : "Repaired: ";
    addMasks(image.provenance, texts);
    add(axesTexts(image.provenance.assumedRas, image.provenance.axes), texts);
    for (std::size_t n = 0; n < texts.size(); ++n)
      text += (n == 0 ? "" : "; ") + texts[n];
    return texts.empty() ? std::string() : text;
  };
  std::string text = textOf(0);
  for (std::size_t most = image.provenance.interpolated.size(); text.size() > kLongest && most > 1;)
    text = textOf(most /= 2);
  return text;
}

} // namespace petrous::presenters
