#include "SceneCheck.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "RayShader.h"
#include "petrous/Rendering/RenderingError.h"

namespace petrous::rendering
{

namespace
{

void require(bool holds, const std::string& what)
{
  if (!holds)
    throw RenderingError(RenderingError::Reason::BadContents, "picture: " + what);
}

void checkLabels(const volume::LabelField& labels)
{
  require(labels.occupancy && labels.index &&
              core::sameGrid(labels.occupancy->geometry(), labels.index->geometry()),
          "the structures need an occupancy and an index on one grid");
  require(!labels.borders || core::sameGrid(labels.borders->geometry(), labels.index->geometry()),
          "the structures' borders do not lie on their grid");
}

} // namespace

void checkContents(const SceneContents& contents)
{
  require(std::isfinite(contents.iso), "the surface's intensity is not a number");
  require(!contents.mask || contents.ct, "there is a mask but no CT");
  require(!contents.mask || core::sameGrid(contents.mask->geometry(), contents.ct->geometry()),
          "the mask does not lie on the CT's grid");
  require(!contents.labels || contents.ct, "there are structures but no CT");
  if (contents.labels)
    checkLabels(*contents.labels);
  const auto checkSource = [&contents](const appearance::Material& material)
  {
    require(material.source == appearance::IntensitySource::Ct ||
                otherImage(contents, material.source).volume,
            material.source == appearance::IntensitySource::Third
                ? "a material reads a third image, and there is none"
                : "a material reads a second image, and there is none");
  };
  std::for_each(contents.materials.begin(), contents.materials.end(), checkSource);
  if (contents.softTissue)
    checkSource(*contents.softTissue);
  require(!contents.section ||
              (contents.section->width > 0.0 && std::isfinite(contents.section->level)),
          "the sections' grey window must be wider than 0");
  require(!contents.thickness.distance || contents.thickness.farthest > 0.0,
          "the farthest thickness must be above 0 mm");
  require(std::all_of(contents.background.begin(), contents.background.end(),
                      [](double value) { return value >= 0.0 && value <= 1.0; }),
          "the background's red, green and blue must lie within 0 to 1");
}

void checkMaterials(const SceneContents& contents)
{
  if (!contents.labels)
    return;
  const std::size_t rows = std::max<std::size_t>(contents.materials.size(), 1);
  const volume::Volume<std::uint8_t>& index = *contents.labels->index;
  std::uint8_t largest = 0;
  for (const std::uint8_t *at = index.data(), *end = at + index.size(); at != end; ++at)
    largest = std::max(largest, *at); // vectorized, unlike max_element
  require(largest < rows, "structure " + std::to_string(int{largest}) +
                              " has no material; there are " + std::to_string(rows - 1) +
                              " beside bone's");
}

void checkPlaneCount(const SceneContents& contents)
{
  require(contents.clipping.size() <= kMaxPlanes, "at most " + std::to_string(kMaxPlanes) +
                                                      " clipping planes can be drawn, not " +
                                                      std::to_string(contents.clipping.size()));
}

} // namespace petrous::rendering
