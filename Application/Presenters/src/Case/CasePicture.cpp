#include "petrous/Presenters/CasePicture.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Library/Library.h"
#include "petrous/Presenters/LabelledPicture.h"
#include "petrous/Presenters/ProvenanceText.h"
#include "petrous/Presenters/SceneAssembly.h"
#include "petrous/Presenters/SlicePlanes.h"
#include "petrous/Rendering/OffscreenView.h"
#include "petrous/Rendering/SceneField.h"
#include "petrous/Volume/IntensityHistogram.h"
#include "petrous/Volume/LabelBorders.h"
#include "petrous/Volume/Sampling.h"
#include "petrous/Volume/TissueExtent.h"

namespace petrous::presenters
{

rendering::SceneContents sceneContents(const scene::Case& value, const core::Progress& progress)
{
  return SceneAssembly().contents(value, progress);
}

namespace
{

scene::Side sideOfCoordinates(const scene::Case& value)
{
  return value.ct.geometry.center().x() > 0.0 ? scene::Side::Left : scene::Side::Right;
}

// Of a case without a side the renderer knows it by the place of the image, if that states one.
// Where the ear is not known some camera is needed all the same.
rendering::StandardView lateralView(const scene::Case& value)
{
  using rendering::StandardView;
  const bool isDescribed =
      value.description.side == scene::Side::Left || value.description.side == scene::Side::Right;
  if (!isDescribed && statesPlace(value.ct))
    return StandardView::Lateral;
  return earOf(value).value_or(sideOfCoordinates(value)) == scene::Side::Left ? StandardView::Left
                                                                              : StandardView::Right;
}

} // namespace

std::optional<scene::Side> guessedEar(const scene::Case& value)
{
  return earOf(value) ? std::nullopt : std::optional(sideOfCoordinates(value));
}

core::CameraPose standardCamera(const scene::Case& value, rendering::StandardView view)
{
  if (view == rendering::StandardView::Lateral)
    view = lateralView(value);
  const auto extent = volume::tissueExtent(*value.ct.volume.get(), value.iso);
  return rendering::standardCamera(view, value.ct.geometry, extent.center, extent.radius);
}

core::CameraPose currentCamera(const scene::Case& value)
{
  return value.camera ? *value.camera : standardCamera(value, rendering::StandardView::Lateral);
}

namespace
{

// What a view shows of the grid; nullopt: all of it.
std::optional<core::IndexBox> cropOf(const scene::ViewState::Clipping& clipping,
                                     const core::GridGeometry& grid)
{
  const core::IndexBox whole = grid.fullBox();
  const core::IndexBox inside = clipping.crop ? clipping.crop->intersected(whole) : whole;
  return inside.empty() || inside == whole ? std::nullopt : std::optional(inside);
}

std::vector<rendering::ClippingPlane> planesOf(const scene::ViewState::Clipping& clipping)
{
  std::vector<rendering::ClippingPlane> planes;
  for (const scene::ViewState::Clipping::Plane& plane : clipping.planes)
    planes.push_back({plane.point, plane.normal});
  return planes;
}

} // namespace

void clip(rendering::SceneContents& contents, const scene::ViewState::Clipping& clipping,
          const core::GridGeometry& grid)
{
  contents.clipping = planesOf(clipping);
  contents.crop = cropOf(clipping, grid);
}

rendering::RaySpan shownPart(const interaction::PickRay& line,
                             const scene::ViewState::Clipping& clipping,
                             const core::GridGeometry& grid)
{
  return rendering::ClippedRegion(grid, cropOf(clipping, grid), planesOf(clipping))
      .clip({line.origin, line.direction});
}

void illuminate(rendering::SceneContents& contents,
                const std::optional<scene::ViewState::Light>& light)
{
  const scene::ViewState::Light given = light.value_or(scene::ViewState::Light());
  contents.light.falloff = given.falloff;
  contents.light.wetness = given.wetness;
  contents.light.setShadows(given.shadows);
  contents.light.exposure = given.exposure;
  contents.light.toneCurve = given.toneCurve;
  contents.light.edges = given.edges;
  contents.light.grain = given.grain;
  contents.light.exitSurfaces = given.exitSurfaces;
}

std::vector<std::string> clippingTexts(const scene::ViewState::Clipping& clipping,
                                       const core::GridGeometry& grid)
{
  std::vector<std::string> lines;
  if (!clipping.planes.empty())
    lines.push_back("Cut away for the view, not drilled");
  if (cropOf(clipping, grid))
    lines.push_back("Only a part of the image is shown");
  return lines;
}

bool isBuried(const core::CameraPose& camera, const rendering::SceneContents& contents)
{
  if (!contents.ct)
    return false;
  const Eigen::Vector3d& eye = camera.position;
  const rendering::ClippedRegion drawn(contents.ct->geometry(), contents.crop, contents.clipping);
  if (!drawn.contains(eye) || !(rendering::sceneField(contents).value(eye) > 0.0))
    return false;
  std::size_t row = 0; // of bone
  if (contents.labels && contents.labels->index)
  {
    const volume::LabelField& labels = *contents.labels;
    const Eigen::Vector3d voxel = labels.occupancy->geometry().voxelFromPatient(eye);
    if (labels.occupancy->geometry().hullContains(voxel) &&
        volume::sampleTrilinear(*labels.occupancy, voxel) > 0.5)
      row = volume::structureAt(*labels.index, labels.borders.get(),
                                labels.index->geometry().voxelFromPatient(eye))
                .index;
  }
  return row < contents.materials.size() && contents.materials[row].surfaceOpacity >= 1.0F;
}

std::vector<std::string> pictureNotes(const scene::Case& value)
{
  std::vector<std::string> lines = interpolatedTexts(value);
  for (std::string& line : clippingTexts(value.view.clipping, value.ct.geometry))
    lines.push_back(std::move(line));
  return lines;
}

std::vector<std::string> pictureLines(const scene::Case& value)
{
  std::vector<std::string> lines{sideText(value.description.side)};
  for (std::string& line : pictureNotes(value))
    lines.push_back(std::move(line));
  return lines;
}

namespace
{

// Whether a word of the name is one for what makes a patient known.
bool showsTheFace(const std::string& name)
{
  constexpr std::array<std::string_view, 6> kWords{"skin", "face",    "scalp",
                                                   "haut", "gesicht", "kopfhaut"};
  const std::string text = scene::lowerCase(name);
  const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c & 0x80) != 0; };
  for (auto from = text.begin(); from != text.end();)
  {
    from = std::find_if(from, text.end(), isLetter);
    const auto to = std::find_if_not(from, text.end(), isLetter);
    const std::string_view word(text.data() + (from - text.begin()),
                                static_cast<std::size_t>(to - from));
    if (std::find(kWords.begin(), kWords.end(), word) != kWords.end())
      return true;
    from = to;
  }
  return false;
}

} // namespace

scene::Case thumbnailCase(scene::Case value)
{
  if (value.ct.modality == scene::Modality::Mr)
    value.boneLook.shown = false;
  else
  {
    constexpr double kMargin = 100.0; // HU below the surface of bone; skin and muscle end there
    constexpr double kSpan = 1500.0;  // HU from that to dense bone
    const auto scale = volume::suggestScale(volume::IntensityHistogram(*value.ct.volume.get()));
    value.iso = std::max(value.iso, scale.iso - kMargin / kSpan * (scale.dense - scale.iso));
  }
  if (value.boneLook.transfer && !value.boneLook.relative)
  {
    value.boneLook.transfer.reset();
    value.boneLook.opacity = 1.0F;
  }
  value.softTissue.shown = false; // the face
  for (scene::LabelPart& part : value.labels)
    for (scene::StructurePart& structure : part.structures)
      structure.look.shown = structure.look.shown && !showsTheFace(structure.name);
  for (scene::MeshPart& mesh : value.meshes)
    mesh.look.shown = mesh.look.shown && !showsTheFace(mesh.name);
  return value;
}

std::vector<std::uint8_t> thumbnailOf(const scene::Case& value, const core::Progress& progress)
{
  const scene::Case shown = thumbnailCase(value);
  const rendering::SceneContents contents = sceneContents(shown, progress);
  if (!contents.boneShown && contents.meshes.empty() && contents.materials.size() < 2)
    return {};
  progress.check("drawing a thumbnail");
  rendering::ScenePicture picture;
  picture.setContents(contents);
  picture.setCamera(currentCamera(shown));
  rendering::OffscreenView view(library::kThumbnailWidth, library::kThumbnailHeight);
  return rendering::pngOf(view.render(picture));
}

bool storeThumbnail(library::Library& library, scene::Case& value, const core::Progress& progress)
{
  library.loadDissection(value);
  const auto png = thumbnailOf(value, progress);
  library.checkVoxels(value, progress);
  if (!png.empty())
    library.setThumbnail(value.name, png);
  return !png.empty();
}

} // namespace petrous::presenters
