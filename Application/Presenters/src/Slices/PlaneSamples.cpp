#include "petrous/Presenters/PlaneSamples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <tbb/parallel_for.h>

#include "petrous/Volume/Sampling.h"

namespace petrous::presenters
{

namespace
{
// Positions are computed from one corner of the picture; tolerance for pixels on the hull's border.
constexpr double kRounding = 1e-9; // voxels

// Voxel positions along a picture's columns and rows.
struct VoxelPlane
{
  Eigen::Vector3d origin, across, down;
  Eigen::Vector3d lower, upper; // of the image's domain

  VoxelPlane(const core::GridGeometry& grid, const SliceGeometry& slice,
             const core::RigidTransform& imageFromSlice)
  {
    const auto voxelAt = [&](double column, double row)
    { return grid.voxelFromPatient(imageFromSlice * slice.patientFromPixel(column, row)); };
    origin = voxelAt(0.0, 0.0);
    across = voxelAt(1.0, 0.0) - origin;
    down = voxelAt(0.0, 1.0) - origin;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
      const int count = grid.dims()[static_cast<std::size_t>(axis)];
      const double beyond = count == 1 ? 0.5 : kRounding;
      lower[axis] = -beyond;
      upper[axis] = count - 1.0 + beyond;
    }
  }
};

// The columns whose pixels are inside on every axis: first to last, none if last < first.
std::pair<int, int> insideColumns(const VoxelPlane& plane, const Eigen::Vector3d& start, int width)
{
  double first = 0.0;
  double last = width - 1.0;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
  {
    const double step = plane.across[axis];
    const double low = plane.lower[axis] - start[axis];
    const double high = plane.upper[axis] - start[axis];
    if (step == 0.0)
    {
      if (low > 0.0 || high < 0.0)
        return {0, -1};
      continue;
    }
    first = std::max(first, std::min(low / step, high / step));
    last = std::min(last, std::max(low / step, high / step));
  }
  return first > last
             ? std::pair(0, -1)
             : std::pair(static_cast<int>(std::ceil(first)), static_cast<int>(std::floor(last)));
}

// As volume::sampleTrilinear; the same cell, found with strides that are computed once for the
// million positions of a picture.
template <class T>
class CellSampler
{
public:
  explicit CellSampler(const volume::Volume<T>& image)
    : m_data(image.data())
  {
    std::ptrdiff_t stride = 1;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const int count = image.geometry().dims()[a];
      m_stride[a] = stride;
      m_lastCell[a] = std::max(count - 2, 0);
      m_lastVoxel[a] = count - 1.0;
      m_up[a] = count > 1 ? stride : 0;
      stride *= count;
    }
  }

  double operator()(const Eigen::Vector3d& voxel) const
  {
    const T* at = m_data;
    double weight[3];
    for (std::size_t a = 0; a < 3; ++a)
    {
      const double x = std::clamp(voxel[static_cast<Eigen::Index>(a)], 0.0, m_lastVoxel[a]);
      const int cell = std::min(static_cast<int>(x), m_lastCell[a]);
      weight[a] = x - cell;
      at += cell * m_stride[a];
    }
    const auto value = [at](std::ptrdiff_t step) { return static_cast<double>(at[step]); };
    return volume::interpolateCell<double>(
        value(0), value(m_up[0]), value(m_up[1]), value(m_up[1] + m_up[0]), value(m_up[2]),
        value(m_up[2] + m_up[0]), value(m_up[2] + m_up[1]), value(m_up[2] + m_up[1] + m_up[0]),
        weight[0], weight[1], weight[2]);
  }

private:
  const T* m_data;
  std::ptrdiff_t m_stride[3];
  std::ptrdiff_t m_up[3]; // to the next voxel, 0 at the last
  int m_lastCell[3];
  double m_lastVoxel[3];
};

template <class T>
void sampleRow(const CellSampler<T>& sample, const VoxelPlane& plane, int row, int width,
               float* out)
{
  const Eigen::Vector3d start = plane.origin + row * plane.down;
  const auto [first, last] = insideColumns(plane, start, width);
  for (int column = first; column <= last; ++column)
  {
    const auto value = static_cast<float>(sample(start + column * plane.across));
    out[column] = std::isnan(value) ? -std::numeric_limits<float>::infinity() : value;
  }
}

// One marching-squares cell of four pixels: corners in order, and the crossings on its sides.
class Cell
{
public:
  Cell(const PlaneSamples& samples, int column, int row)
    : m_column(static_cast<float>(column))
    , m_row(static_cast<float>(row))
    , m_values{samples.at(column, row), samples.at(column + 1, row),
               samples.at(column + 1, row + 1), samples.at(column, row + 1)}
  {
  }

  bool crosses(float level) const
  {
    const bool below = m_values[0] < level;
    return (m_values[1] < level) != below || (m_values[2] < level) != below ||
           (m_values[3] < level) != below;
  }
  bool finite() const
  {
    return std::all_of(std::begin(m_values), std::end(m_values),
                       [](float value) { return std::isfinite(value); });
  }
  float slope() const // of the bilinear surface at the cell's centre, per pixel
  {
    const float across = 0.5F * (m_values[1] + m_values[2] - m_values[0] - m_values[3]);
    const float down = 0.5F * (m_values[2] + m_values[3] - m_values[0] - m_values[1]);
    return std::hypot(across, down);
  }
  void march(float level, std::vector<ContourSegment>& out) const
  {
    Eigen::Vector2f crossings[4];
    int count = 0;
    for (int side = 0; side < 4; ++side)
      if ((m_values[side] < level) != (m_values[(side + 1) % 4] < level))
        crossings[count++] = crossing(side, level);
    if (count == 2)
      out.push_back({crossings[0], crossings[1]});
    if (count != 4)
      return;
    // A saddle: the centre belongs to one pair of opposite corners, which it joins.
    const float middle = 0.25F * (m_values[0] + m_values[1] + m_values[2] + m_values[3]);
    const int first = (middle < level) == (m_values[0] < level) ? 0 : 3;
    out.push_back({crossings[first], crossings[(first + 1) % 4]});
    out.push_back({crossings[(first + 2) % 4], crossings[(first + 3) % 4]});
  }

private:
  Eigen::Vector2f corner(int n) const
  {
    return {m_column + (n == 1 || n == 2 ? 1.0F : 0.0F), m_row + (n >= 2 ? 1.0F : 0.0F)};
  }
  Eigen::Vector2f crossing(int side, float level) const
  {
    const int next = (side + 1) % 4;
    const float share = (level - m_values[side]) / (m_values[next] - m_values[side]);
    return corner(side) + share * (corner(next) - corner(side));
  }

  float m_column, m_row;
  float m_values[4];
};

float distance(const Eigen::Vector2f& point, const ContourSegment& segment)
{
  const Eigen::Vector2f along = segment.b - segment.a;
  const float length = along.squaredNorm();
  const float share =
      length > 0.0F ? std::clamp((point - segment.a).dot(along) / length, 0.0F, 1.0F) : 0.0F;
  return (point - segment.a - share * along).norm();
}
} // namespace

PlaneSamples samplePlane(const volume::IntensityVolume& image, const SliceGeometry& slice,
                         const core::RigidTransform& imageFromSlice)
{
  const auto width = static_cast<std::size_t>(slice.width());
  PlaneSamples samples{slice.width(), slice.height(),
                       std::vector<float>(width * static_cast<std::size_t>(slice.height()),
                                          std::numeric_limits<float>::quiet_NaN())};
  const VoxelPlane plane(image.geometry(), slice, imageFromSlice);
  image.visit(
      [&](const auto& voxels)
      {
        const CellSampler sampler(voxels);
        tbb::parallel_for(0, slice.height(),
                          [&](int row)
                          {
                            sampleRow(sampler, plane, row, slice.width(),
                                      &samples.values[static_cast<std::size_t>(row) * width]);
                          });
      });
  return samples;
}

std::vector<ContourSegment> contours(const PlaneSamples& samples, float level, float minSlope)
{
  std::vector<ContourSegment> segments;
  for (int row = 0; row + 1 < samples.height; ++row)
    for (int column = 0; column + 1 < samples.width; ++column)
    {
      const Cell cell(samples, column, row);
      if (cell.crosses(level) && cell.finite() && cell.slope() >= minSlope)
        cell.march(level, segments);
    }
  return segments;
}

std::vector<float> coverage(const std::vector<ContourSegment>& segments, int columns, int rows,
                            float width)
{
  std::vector<float> covered(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  const float reach = 0.5F * width + 0.5F;
  for (const ContourSegment& segment : segments)
  {
    const Eigen::Vector2f low = segment.a.cwiseMin(segment.b).array() - reach;
    const Eigen::Vector2f high = segment.a.cwiseMax(segment.b).array() + reach;
    const int firstRow = std::max(static_cast<int>(std::ceil(low[1])), 0);
    const int lastRow = std::min(static_cast<int>(std::floor(high[1])), rows - 1);
    const int firstColumn = std::max(static_cast<int>(std::ceil(low[0])), 0);
    const int lastColumn = std::min(static_cast<int>(std::floor(high[0])), columns - 1);
    for (int row = firstRow; row <= lastRow; ++row)
      for (int column = firstColumn; column <= lastColumn; ++column)
      {
        const float share = std::clamp(
            reach - distance({static_cast<float>(column), static_cast<float>(row)}, segment), 0.0F,
            1.0F);
        float& pixel = covered[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                               static_cast<std::size_t>(column)];
        pixel = std::max(pixel, share);
      }
  }
  return covered;
}

} // namespace petrous::presenters
