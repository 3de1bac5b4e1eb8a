#include "petrous/Presenters/SceneAssembly.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "petrous/Appearance/AppearanceMaterial.h"
#include "petrous/Presenters/BoneThickness.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Scene/CaseField.h"
#include "petrous/Scene/Placement.h"

namespace petrous::presenters
{

namespace
{

using appearance::IntensitySource;
using appearance::Material;
using appearance::StructureAppearance;

using Structures = std::vector<const scene::StructurePart*>;

bool sameVoxels(const std::vector<volume::LabelSource>& a,
                const std::vector<volume::LabelSource>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& x, const auto& y)
                    {
                      return x.labels == y.labels && x.segment == y.segment &&
                             x.material == y.material && x.solid == y.solid;
                    });
}

constexpr IntensitySource kOthers[] = {IntensitySource::Second, IntensitySource::Third};
static_assert(std::size(kOthers) == kMrsOfPicture);

using Images = std::vector<const scene::ImagePart*>;

bool readsMr(const StructureAppearance& look)
{
  return appearance::materialOf(look).source != IntensitySource::Ct;
}

// Were it shown. `why`: it cannot be drawn.
struct SoftTissue
{
  std::optional<Material> material;
  std::string why;
};

// Of one in the values of an MR it is left open whether that MR is drawn.
SoftTissue softTissueOf(const scene::Case& value)
{
  const StructureAppearance& look = value.softTissue;
  if (!look.transfer || look.transfer->points().size() < 2)
    return {{}, "it has no transfer function of several points, and one colour would fill air too"};
  if (look.relative && !look.sourceImage.empty())
    return {{},
            "presets are made for CT; it is drawn once it has points in values of '" +
                look.sourceImage + "'"};
  if (look.relative && value.ct.modality == scene::Modality::Mr)
    return {{}, "presets are made for CT; it is drawn once it has points in values of the MR"};
  const scene::ImagePart* mr = scene::findMr(value, look.sourceImage);
  if (!look.sourceImage.empty() && !(mr && mr->registered))
    return {{}, "'" + look.sourceImage + "' is not registered with the CT"};
  auto material = softTissueMaterial(look, softTissueScale(value));
  std::string why = material ? "" : "it is transparent at every intensity";
  if (material && look.sourceImage.empty())
  {
    const auto& points = material->transfer.points();
    const auto seen = std::find_if(points.begin(), points.end(),
                                   [](const auto& point) { return point.opacity > 0.0F; });
    if (seen != points.end() && seen->value >= value.iso)
      return {{},
              "its values begin where soft tissue ends, at the surface threshold; it is a function "
              "of bone"};
  }
  return {std::move(material), std::move(why)};
}

// Whether bone or a structure draws values of an MR.
bool isRead(const scene::Case& value, const Structures& structures, const scene::ImagePart& mr)
{
  const auto asks = [&mr](const StructureAppearance& look)
  { return look.sourceImage == mr.name && readsMr(look); };
  return mr.registered && ((value.boneLook.shown && asks(value.boneLook)) ||
                           std::any_of(structures.begin(), structures.end(),
                                       [&asks](const auto* structure)
                                       { return structure->look.solid && asks(structure->look); }));
}

// The MRs that a picture shows, at most as many as a ray samples.
Images drawnImages(const scene::Case& value, const Structures& structures)
{
  Images images;
  for (const scene::ImagePart& mr : value.mr)
    if (images.size() < kMrsOfPicture && isRead(value, structures, mr))
      images.push_back(&mr);
  const SoftTissue soft = softTissueOf(value);
  const scene::ImagePart* own = scene::findMr(value, value.softTissue.sourceImage);
  if (value.softTissue.shown && soft.material && soft.material->source != IntensitySource::Ct &&
      images.size() < kMrsOfPicture && std::find(images.begin(), images.end(), own) == images.end())
    images.push_back(own);
  return images;
}

// nullopt: that MR is not drawn.
std::optional<IntensitySource> sourceOf(const StructureAppearance& look, const Images& images)
{
  for (std::size_t n = 0; n < images.size(); ++n)
    if (images[n]->name == look.sourceImage)
      return kOthers[n];
  return std::nullopt;
}

// The values of an MR that is not drawn must not be read from the CT, nor from another MR.
SoftTissue drawnSoftTissue(const scene::Case& value, const Images& images)
{
  SoftTissue soft = softTissueOf(value);
  if (!soft.material || soft.material->source == IntensitySource::Ct)
    return soft;
  if (const auto source = sourceOf(value.softTissue, images))
    soft.material->source = *source;
  else if (images.size() == kMrsOfPicture)
    return {{},
            "it reads '" + value.softTissue.sourceImage + "', but bone or structures read '" +
                images[0]->name + "' and '" + images[1]->name + "', and a picture shows two MRs"};
  return soft;
}

// Values for an image that is not drawn must not be read from the CT.
Material drawn(StructureAppearance look, const volume::IntensityScale& scale, const Images& images)
{
  const std::optional<IntensitySource> source =
      readsMr(look) ? sourceOf(look, images) : IntensitySource::Ct;
  if (!source)
  {
    look.sourceImage.clear();
    look.transfer.reset();
  }
  Material material = materialOf(look, scale);
  material.source = source.value_or(IntensitySource::Ct);
  return material;
}

std::vector<Material> materialsOf(const scene::Case& value, const Structures& structures,
                                  const Images& images)
{
  const volume::IntensityScale scale = value.intensityScale();
  std::vector<Material> materials{drawn(value.boneLook, scale, images)};
  for (const auto* structure : structures)
  {
    const StructureAppearance& look = structure->look;
    materials.push_back(look.solid ? drawn(look, scale, images)
                                   : lumenMaterial(look, materials.front(), scale));
  }
  return materials;
}

// Those that are seen, without reading their voxels.
Structures shownStructures(const scene::Case& value)
{
  Structures structures;
  for (const scene::LabelPart& part : value.labels)
    for (const scene::StructurePart& structure : part.structures)
      if (structure.look.shown && scene::placementOf(value, part).missing.empty())
        structures.push_back(&structure);
  return structures;
}

} // namespace

void SceneAssembly::showThickness(const std::string& structure)
{
  if (structure != m_thicknessOver)
    m_thickness = nullptr;
  m_thicknessOver = structure;
}

void SceneAssembly::renamed(const std::string& from, const std::string& to)
{
  if (m_thicknessOver == from)
    m_thicknessOver = to;
}

void SceneAssembly::takeThickness(const SceneAssembly& other)
{
  if (other.m_thicknessOver == m_thicknessOver)
    return;
  m_thicknessOver = other.m_thicknessOver;
  m_thickness = other.m_thickness;
}

rendering::SceneContents SceneAssembly::contents(const scene::Case& value,
                                                 const core::Progress& progress)
{
  rendering::SceneContents contents;
  contents.ct = value.ct.volume.get();
  contents.iso = value.iso;
  contents.mask = value.dissection.sharedMask();

  auto shown = scene::labelSources(value, [](const auto& look) { return look.shown; });
  if (!sameVoxels(shown.sources, m_sources))
  {
    m_sources.clear(); // what follows may throw
    m_labels = nullptr;
    m_labels = scene::labelField(value, shown, progress);
    m_sources = std::move(shown.sources);
  }
  contents.labels = m_labels;
  const Images images = drawnImages(value, shown.structures);
  if (!images.empty())
    contents.second = {images[0]->volume.get(), images[0]->mrFromCt};
  if (images.size() > 1)
    contents.third = {images[1]->volume.get(), images[1]->mrFromCt};
  contents.boneShown = value.boneLook.shown;
  contents.materials = materialsOf(value, shown.structures, images);
  if (value.softTissue.shown)
    contents.softTissue = drawnSoftTissue(value, images).material;

  if (!m_thicknessOver.empty() && !m_thickness)
    m_thickness = boneThickness(value, m_thicknessOver, progress);
  contents.thickness = {m_thickness, kFarthestThickness};
  const GreyWindow grey = displayOf(value).bone;
  contents.section = rendering::SectionWindow{grey.width, grey.level};

  for (const auto& mesh : value.meshes)
    if (mesh.look.shown && !scene::findStructure(value, mesh.name))
      if (auto placed = scene::meshOnCt(value, mesh))
        contents.meshes.push_back({mesh.name, std::move(placed), mesh.look,
                                   contents.mask && !contents.mask->untouched() &&
                                       scene::untouchable(value, mesh).empty()});
  return contents;
}

std::string softTissueMissing(const scene::Case& value)
{
  return drawnSoftTissue(value, drawnImages(value, shownStructures(value))).why;
}

bool drawsSoftFace(const scene::Case& value, const Eigen::Vector3d& patient)
{
  if (!value.softTissue.shown)
    return false;
  if (const auto mask = value.dissection.sharedMask();
      mask && mask->sample(value.ct.geometry.voxelFromPatient(patient)) <= 0.5)
    return false;
  const Images images = drawnImages(value, shownStructures(value));
  const std::optional<Material> material = drawnSoftTissue(value, images).material;
  if (!material)
    return false;
  std::shared_ptr<const volume::IntensityVolume> image = value.ct.volume.peek();
  Eigen::Vector3d at = patient;
  for (std::size_t n = 0; n < images.size(); ++n)
    if (material->source == kOthers[n])
    {
      image = images[n]->volume.peek();
      at = images[n]->mrFromCt * patient;
    }
  if (!image)
    return false;
  const double intensity = image->sample(image->geometry().voxelFromPatient(at));
  return material->transfer.at(intensity).extinction > rendering::optics::kSoftInSection;
}

std::vector<std::string> drawnMrs(const scene::Case& value)
{
  std::vector<std::string> names;
  for (const scene::ImagePart* image : drawnImages(value, shownStructures(value)))
    names.push_back(image->name);
  return names;
}

std::string mrMissing(const scene::Case& value, const std::string& mr)
{
  const Structures structures = shownStructures(value);
  const Images images = drawnImages(value, structures);
  const scene::ImagePart* part = scene::findMr(value, mr);
  if (!part || images.size() < kMrsOfPicture || !isRead(value, structures, *part) ||
      std::find(images.begin(), images.end(), part) != images.end())
    return {};
  return "'" + mr + "' is not drawn, and what reads it has one colour: a picture shows two MRs, '" +
         images[0]->name + "' and '" + images[1]->name + "'";
}

} // namespace petrous::presenters
