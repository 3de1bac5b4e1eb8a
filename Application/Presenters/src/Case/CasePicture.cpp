#include "petrous/Presenters/CasePicture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Core/HullClip.h"
#include "petrous/Library/Library.h"
#include "petrous/Presenters/LabelledPicture.h"
#include "petrous/Presenters/ProvenanceText.h"
#include "petrous/Presenters/SceneAssembly.h"
#include "petrous/Presenters/SlicePlanes.h"
#include "petrous/Rendering/OffscreenView.h"
#include "petrous/Volume/IntensityHistogram.h"
#include "petrous/Volume/LabelBorders.h"
#include "petrous/Volume/Sampling.h"
#include "petrous/Volume/TissueExtent.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::presenters
{

rendering::SceneContents sceneContents(const scene::Case& value, const core::Progress& progress)
{
  return SceneAssembly().contents(value, progress);
}

namespace
{

// Of a case without a side the renderer knows it by the place of the image, if that states one.
rendering::StandardView lateralView(const scene::Case& value)
{
  using rendering::StandardView;
  const bool isDescribed =
      value.description.side == scene::Side::Left || value.description.side == scene::Side::Right;
  if (!isDescribed && statesPlace(value.ct))
    return StandardView::Lateral;
  return earOf(value) == scene::Side::Left ? StandardView::Left : StandardView::Right;
}

} // namespace

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

} // namespace

void clip(rendering::SceneContents& contents, const scene::ViewState::Clipping& clipping,
          const core::GridGeometry& grid)
{
  contents.clipping.clear();
  for (const scene::ViewState::Clipping::Plane& plane : clipping.planes)
    contents.clipping.push_back({plane.point, plane.normal});
  contents.crop = cropOf(clipping, grid);
}

// As the renderer's rays are clipped (OpticalModel.h).
std::pair<double, double> shownPart(const interaction::PickRay& line,
                                    const scene::ViewState::Clipping& clipping,
                                    const core::GridGeometry& grid)
{
  constexpr double kParallel = 1e-14; // cosine below which a line is parallel to a plane
  constexpr std::pair<double, double> kNothing{1.0, 0.0};
  const core::GridGeometry box = grid.cropped(cropOf(clipping, grid).value_or(grid.fullBox()));
  if (std::any_of(box.dims().begin(), box.dims().end(), [](int voxels) { return voxels < 2; }))
    return kNothing; // without thickness
  const Eigen::Vector3d start = box.voxelFromPatient(line.origin);
  auto [first, last] = core::clipToHull(box, start, box.voxelFromPatient(line.at(1.0)) - start, 0.0,
                                        std::numeric_limits<double>::max());
  for (const scene::ViewState::Clipping::Plane& plane : clipping.planes)
  {
    const double height = plane.normal.dot(line.origin - plane.point);
    const double slope = plane.normal.dot(line.direction);
    if (std::abs(slope) < kParallel)
    {
      if (height < 0.0)
        return kNothing;
    }
    else if (slope > 0.0)
      first = std::max(first, -height / slope);
    else
      last = std::min(last, -height / slope);
  }
  return {first, last};
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
  const core::GridGeometry& grid = contents.ct->geometry();
  const core::GridGeometry box = grid.cropped(contents.crop.value_or(grid.fullBox()));
  const bool isShown = box.hullContains(box.voxelFromPatient(eye)) &&
                       std::all_of(contents.clipping.begin(), contents.clipping.end(),
                                   [&eye](const rendering::ClippingPlane& plane)
                                   { return plane.normal.dot(eye - plane.point) >= 0.0; });
  if (!isShown)
    return false;
  constexpr double kNoBone = 1e9; // HU, above all of it
  constexpr double kScale = 1000.0;
  std::vector<volume::TissueField::SolidUnion> solids;
  if (contents.labels)
    solids.push_back(contents.labels->occupancy);
  const volume::TissueField field(contents.ct, std::move(solids), contents.mask,
                                  {contents.boneShown ? contents.iso : kNoBone, kScale});
  if (!(field.value(eye) > 0.0))
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
