#include "petrous/Presenters/SlicePresenter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "OverlayPainter.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/MeshSection.h"
#include "petrous/Scene/Placement.h"

namespace petrous::presenters
{

namespace
{
std::array<float, 3> bytesOf(const std::array<float, 3>& color)
{
  return {255.0F * color[0], 255.0F * color[1], 255.0F * color[2]};
}

constexpr int kHatchPeriod = 7; // pixels
constexpr int kHatchWidth = 2;
constexpr std::array<float, 3> kCutColor{150.0F, 28.0F, 24.0F};
constexpr std::array<float, 3> kHatchColor{235.0F, 70.0F, 52.0F};
constexpr float kCutTint = 0.62F;

// Iterates over a picture's pixels with their continuous grid positions; body(pixel index, voxel).
template <class Body>
void forEachPixel(const SliceGeometry& slice, const core::GridGeometry& grid, const Body& body)
{
  const auto voxelAt = [&](double column, double row)
  { return grid.voxelFromPatient(slice.patientFromPixel(column, row)); };
  const Eigen::Vector3d origin = voxelAt(0.0, 0.0);
  const Eigen::Vector3d across = voxelAt(1.0, 0.0) - origin;
  const Eigen::Vector3d down = voxelAt(0.0, 1.0) - origin;
  std::size_t pixel = 0;
  for (int row = 0; row < slice.height(); ++row)
    for (int column = 0; column < slice.width(); ++column, ++pixel)
      body(pixel, Eigen::Vector3d(origin + column * across + row * down));
}

// Whether a neighbour of the pixel has another index. The picture's edge is no border.
bool isBorder(const std::vector<std::uint16_t>& found, const SliceGeometry& slice,
              std::size_t pixel)
{
  const auto width = static_cast<std::size_t>(slice.width());
  const std::size_t column = pixel % width;
  const std::uint16_t index = found[pixel];
  return (column > 0 && found[pixel - 1] != index) ||
         (column + 1 < width && found[pixel + 1] != index) ||
         (pixel >= width && found[pixel - width] != index) ||
         (pixel + width < found.size() && found[pixel + width] != index);
}

// Tints the voxels for which indexAt(voxel) is not 0, with an outline in their full colour; those
// of `hatched` with lines in it, too.
template <class IndexAt>
void tint(const SliceGeometry& slice, const core::GridGeometry& grid, const IndexAt& indexAt,
          const std::vector<std::array<float, 3>>& colors, SlicePixels& pixels,
          std::uint16_t hatched = 0)
{
  const core::Index3& dims = grid.dims();
  std::vector<std::uint16_t> found(pixels.rgb.size() / 3, 0);
  forEachPixel(slice, grid,
               [&](std::size_t pixel, const Eigen::Vector3d& voxel)
               {
                 core::Index3 nearest;
                 for (std::size_t a = 0; a < 3; ++a)
                 {
                   nearest[a] =
                       static_cast<int>(std::floor(voxel[static_cast<Eigen::Index>(a)] + 0.5));
                   if (nearest[a] < 0 || nearest[a] >= dims[a])
                     return;
                 }
                 found[pixel] = indexAt(nearest);
               });
  const int width = slice.width();
  for (int row = 0; row < slice.height(); ++row)
    for (int column = 0; column < width; ++column)
    {
      const std::size_t pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(column);
      const std::uint16_t index = found[pixel];
      if (index == 0)
        continue;
      const bool line = index == hatched && (column + row) % kHatchPeriod < kHatchWidth;
      blend(&pixels.rgb[3 * pixel], colors[index],
            line || isBorder(found, slice, pixel) ? kStructureOutline : kStructureTint);
    }
}
} // namespace

SlicePresenter::SlicePresenter(const scene::Case& value,
                               std::shared_ptr<const volume::CutMask> mask)
  : m_ct(value.ct.volume.get())
  , m_edges(edgeLevels(calibratedScale(value)))
  , m_mask(std::move(mask))
{
  for (const scene::LabelPart& part : value.labels)
  {
    Layer layer;
    for (const scene::StructurePart& structure : part.structures)
    {
      if (!structure.look.shown)
        continue;
      const std::size_t size = std::max<std::size_t>(layer.shown.size(), structure.index + 1U);
      layer.shown.resize(size, false);
      layer.colors.resize(size);
      layer.shown[structure.index] = true;
      layer.colors[structure.index] = bytesOf(structure.look.color);
    }
    if (layer.shown.empty())
      continue;
    layer.labels = scene::labelsOnCt(value, part);
    if (layer.labels)
      m_layers.push_back(std::move(layer));
  }
  for (const scene::MeshPart& part : value.meshes)
    if (part.look.shown && !scene::findStructure(value, part.name))
      if (auto mesh = scene::meshOnCt(value, part))
        m_meshes.push_back({std::move(mesh), bytesOf(part.look.color)});
}

bool SlicePresenter::drawsAs(const SlicePresenter& other) const
{
  const auto same = [](const Layer& a, const Layer& b)
  { return a.labels == b.labels && a.colors == b.colors && a.shown == b.shown; };
  const auto sameMesh = [](const Mesh& a, const Mesh& b)
  { return a.mesh == b.mesh && a.color == b.color; };
  return m_ct == other.m_ct && m_mask == other.m_mask && m_edges.bone == other.m_edges.bone &&
         m_edges.skin == other.m_edges.skin && m_edges.slope == other.m_edges.slope &&
         std::equal(m_layers.begin(), m_layers.end(), other.m_layers.begin(), other.m_layers.end(),
                    same) &&
         std::equal(m_meshes.begin(), m_meshes.end(), other.m_meshes.begin(), other.m_meshes.end(),
                    sameMesh);
}

SliceSamples SlicePresenter::sample(const SliceGeometry& slice, const SliceOverlay* overlay,
                                    const Slab& slab) const
{
  SliceSamples samples;
  if (m_ct)
    samples.ct = sampleSlab(*m_ct, slice, slab);
  if (overlay && overlay->mr)
    samples.mr = sampleSlab(*overlay->mr, slice, slab, overlay->mrFromCt);
  return samples;
}

SlicePixels SlicePresenter::draw(const SliceGeometry& slice, const GreyWindow& window,
                                 const SliceOverlay* overlay, const Slab& slab) const
{
  return draw(slice, window, overlay, sample(slice, overlay, slab));
}

SlicePixels SlicePresenter::draw(const SliceGeometry& slice, const GreyWindow& window,
                                 const SliceOverlay* overlay, const SliceSamples& samples) const
{
  SlicePixels pixels;
  pixels.width = slice.width();
  pixels.height = slice.height();
  const std::size_t count =
      static_cast<std::size_t>(slice.width()) * static_cast<std::size_t>(slice.height());
  pixels.rgb.resize(3 * count);
  for (std::size_t n = 0; n < pixels.rgb.size(); ++n)
    pixels.rgb[n] = kOutside[n % 3];
  if (!m_ct)
    return pixels;
  const PlaneSamples& ct = samples.ct;
  for (std::size_t n = 0; n < count; ++n)
    if (!std::isnan(ct.values[n]))
      std::fill_n(&pixels.rgb[3 * n], 3, greyOf(ct.values[n], window));
  if (overlay && samples.mr)
    paintOverlay(*overlay, slice, *samples.mr, pixels);
  for (const Layer& layer : m_layers)
    drawLayer(layer, slice, pixels);
  for (const Mesh& mesh : m_meshes)
    sectionOf(*mesh.mesh, slice).paint(mesh.color, pixels);
  if (m_mask && !m_mask->untouched())
    drawCut(slice, pixels);
  if (overlay && overlay->mr && overlay->mode == OverlayMode::Edges)
    paintEdges(ct, m_edges, slice.mmPerPixel(), pixels);
  return pixels;
}

void SlicePresenter::drawLayer(const Layer& layer, const SliceGeometry& slice,
                               SlicePixels& pixels) const
{
  const auto& voxels = *layer.labels->voxels;
  tint(
      slice, voxels.geometry(),
      [&](const core::Index3& at)
      {
        const std::uint16_t index = voxels.at(at[0], at[1], at[2]);
        return index < layer.shown.size() && layer.shown[index] ? index : std::uint16_t{0};
      },
      layer.colors, pixels);
}

void DraftLayer::paint(const SliceGeometry& slice, SlicePixels& pixels) const
{
  if (indexAt)
    tint(slice, geometry, indexAt, colors, pixels, hatched);
}

void SlicePresenter::drawCut(const SliceGeometry& slice, SlicePixels& pixels) const
{
  const core::GridGeometry& grid = m_mask->geometry();
  std::vector<std::uint16_t> cut(pixels.rgb.size() / 3, 0);
  forEachPixel(slice, grid,
               [&](std::size_t pixel, const Eigen::Vector3d& voxel)
               { cut[pixel] = grid.hullContains(voxel) && m_mask->sample(voxel) < 0.5; });
  const auto width = static_cast<std::size_t>(slice.width());
  for (std::size_t pixel = 0; pixel < cut.size(); ++pixel)
  {
    if (cut[pixel] == 0)
      continue;
    const bool hatch = static_cast<int>(pixel % width + pixel / width) % kHatchPeriod < kHatchWidth;
    if (isBorder(cut, slice, pixel))
      blend(&pixels.rgb[3 * pixel], kHatchColor, kStructureOutline);
    else
      blend(&pixels.rgb[3 * pixel], hatch ? kHatchColor : kCutColor, hatch ? 0.8F : kCutTint);
  }
}

} // namespace petrous::presenters
