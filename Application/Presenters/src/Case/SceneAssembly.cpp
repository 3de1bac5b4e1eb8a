#include "petrous/Presenters/SceneAssembly.h"

#include <algorithm>
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

bool readsSecond(const StructureAppearance& look)
{
  return appearance::materialOf(look).source == IntensitySource::Second;
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
  return {std::move(material), std::move(why)};
}

const scene::ImagePart* secondImage(const scene::Case& value, const Structures& structures)
{
  for (const scene::ImagePart& mr : value.mr)
  {
    const auto asks = [&mr](const StructureAppearance& look)
    { return look.sourceImage == mr.name && readsSecond(look); };
    const auto asksToo = [&asks](const auto* structure)
    { return structure->look.solid && asks(structure->look); };
    if (mr.registered && ((value.boneLook.shown && asks(value.boneLook)) ||
                          std::any_of(structures.begin(), structures.end(), asksToo)))
      return &mr;
  }
  const SoftTissue soft = softTissueOf(value);
  return value.softTissue.shown && soft.material && soft.material->source == IntensitySource::Second
             ? scene::findMr(value, value.softTissue.sourceImage)
             : nullptr;
}

// The values of an MR that is not drawn must not be read from the CT, nor from another MR.
SoftTissue drawnSoftTissue(const scene::Case& value, const scene::ImagePart* second)
{
  SoftTissue soft = softTissueOf(value);
  if (soft.material && soft.material->source == IntensitySource::Second && second &&
      second->name != value.softTissue.sourceImage)
    return {{},
            "it reads '" + value.softTissue.sourceImage + "', but bone or a structure reads '" +
                second->name + "', and a picture shows one MR"};
  return soft;
}

// Values for an image that is not drawn must not be read from the CT.
StructureAppearance drawn(StructureAppearance look, const scene::ImagePart* second)
{
  if (readsSecond(look) && !(second && look.sourceImage == second->name))
  {
    look.sourceImage.clear();
    look.transfer.reset();
  }
  return look;
}

std::vector<Material> materialsOf(const scene::Case& value, const Structures& structures,
                                  const scene::ImagePart* second)
{
  const volume::IntensityScale scale = value.intensityScale();
  std::vector<Material> materials{materialOf(drawn(value.boneLook, second), scale)};
  for (const auto* structure : structures)
  {
    const StructureAppearance& look = structure->look;
    materials.push_back(look.solid ? materialOf(drawn(look, second), scale)
                                   : lumenMaterial(look, materials.front(), scale));
  }
  return materials;
}

} // namespace

void SceneAssembly::showThickness(const std::string& structure)
{
  if (structure != m_thicknessOver)
    m_thickness = nullptr;
  m_thicknessOver = structure;
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
  const scene::ImagePart* second = secondImage(value, shown.structures);
  if (second)
    contents.second = {second->volume.get(), second->mrFromCt};
  contents.boneShown = value.boneLook.shown;
  contents.materials = materialsOf(value, shown.structures, second);
  if (value.softTissue.shown)
    contents.softTissue = drawnSoftTissue(value, second).material;

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
  Structures structures;
  for (const scene::LabelPart& part : value.labels)
    for (const scene::StructurePart& structure : part.structures)
      if (structure.look.shown && scene::placementOf(value, part).missing.empty())
        structures.push_back(&structure);
  return drawnSoftTissue(value, secondImage(value, structures)).why;
}

} // namespace petrous::presenters
