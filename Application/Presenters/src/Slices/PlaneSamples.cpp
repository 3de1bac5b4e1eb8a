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
constexpr double kAligned = 1e-10; // of a step along an axis of the grid, across it

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

// A projection of one row of pixels, sample by sample.
class RowProjection
{
public:
  RowProjection(Projection projection, int width)
    : m_projection(projection)
    , m_values(static_cast<std::size_t>(width))
    , m_weights(static_cast<std::size_t>(width), 0.0)
    , m_touched(static_cast<std::size_t>(width), 0)
  {
  }

  void add(std::size_t column, double value, double weight)
  {
    m_touched[column] = 1;
    if (std::isnan(value))
      return;
    double& sum = m_values[column];
    const bool isFirst = m_weights[column] == 0.0;
    switch (m_projection)
    {
    case Projection::Maximum:
      sum = isFirst ? value : std::max(sum, value);
      break;
    case Projection::Minimum:
      sum = isFirst ? value : std::min(sum, value);
      break;
    case Projection::Mean:
      sum = isFirst ? weight * value : sum + weight * value;
      break;
    }
    m_weights[column] += weight;
  }

  void write(float* out) const
  {
    for (std::size_t column = 0; column < m_values.size(); ++column)
      if (m_weights[column] > 0.0)
        out[column] = static_cast<float>(m_projection == Projection::Mean
                                             ? m_values[column] / m_weights[column]
                                             : m_values[column]);
      else if (m_touched[column])
        out[column] = -std::numeric_limits<float>::infinity();
  }

private:
  Projection m_projection;
  std::vector<double> m_values, m_weights;
  std::vector<char> m_touched;
};

// Columns along one axis of the grid: their cells and weights, which are those of every row.
class ColumnCells
{
public:
  ColumnCells(const VoxelPlane& plane, const core::Index3& dims, int width)
  {
    int axes = 0;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      if (plane.across[axis] != 0.0)
      {
        m_axis = static_cast<std::size_t>(axis);
        ++axes;
      }
    if (axes != 1)
      return;
    std::ptrdiff_t stride = 1;
    for (std::size_t a = 0; a < 3; ++a)
    {
      m_stride[a] = stride;
      m_count[a] = dims[a];
      stride *= dims[a];
    }
    const auto axis = static_cast<Eigen::Index>(m_axis);
    m_offset.resize(static_cast<std::size_t>(width));
    m_weight.resize(static_cast<std::size_t>(width));
    for (int column = 0; column < width; ++column)
    {
      const auto [cell, weight] = cellOf(plane.origin[axis] + column * plane.across[axis], m_axis);
      m_offset[static_cast<std::size_t>(column)] = cell * m_stride[m_axis];
      m_weight[static_cast<std::size_t>(column)] = weight;
    }
    m_up = m_count[m_axis] > 1 ? m_stride[m_axis] : 0;
  }

  explicit operator bool() const { return !m_offset.empty(); }

  /// body(column, value) for the columns from first to last of the row that starts at a voxel.
  template <class T, class Body>
  void forEach(const T* data, const Eigen::Vector3d& start, int first, int last,
               const Body& body) const
  {
    // The other two axes: one cell for the whole row; where a weight is 0, half of it is not read.
    const std::size_t b = (m_axis + 1) % 3;
    const std::size_t c = (m_axis + 2) % 3;
    const auto [cellB, y] = cellOf(start[static_cast<Eigen::Index>(b)], b);
    const auto [cellC, z] = cellOf(start[static_cast<Eigen::Index>(c)], c);
    const T* base = data + cellB * m_stride[b] + cellC * m_stride[c];
    const std::ptrdiff_t upB = m_count[b] > 1 ? m_stride[b] : 0;
    const std::ptrdiff_t upC = m_count[c] > 1 ? m_stride[c] : 0;
    const auto mix = [](double a, double e, double w) { return a + (e - a) * w; };
    const auto along = [this](const T* at, double x)
    {
      const auto low = static_cast<double>(at[0]);
      return low + (static_cast<double>(at[m_up]) - low) * x;
    };
    for (int column = first; column <= last; ++column)
    {
      const auto n = static_cast<std::size_t>(column);
      const T* at = base + m_offset[n];
      const double x = m_weight[n];
      double value = along(at, x);
      if (y != 0.0)
        value = mix(value, along(at + upB, x), y);
      if (z != 0.0)
      {
        double above = along(at + upC, x);
        if (y != 0.0)
          above = mix(above, along(at + upC + upB, x), y);
        value = mix(value, above, z);
      }
      body(n, value);
    }
  }

private:
  std::pair<int, double> cellOf(double voxel, std::size_t axis) const
  {
    // On a voxel but for rounding: on it, where half of the cell need not be read.
    if (const double whole = std::round(voxel); std::abs(voxel - whole) < kRounding)
      voxel = whole;
    const double x = std::clamp(voxel, 0.0, m_count[axis] - 1.0);
    const int cell = std::min(static_cast<int>(x), std::max(m_count[axis] - 2, 0));
    return {cell, x - cell};
  }

  std::size_t m_axis = 0;
  std::ptrdiff_t m_stride[3]{};
  int m_count[3]{};
  std::ptrdiff_t m_up = 0;
  std::vector<std::ptrdiff_t> m_offset;
  std::vector<double> m_weight;
};

// Of a plane that is aligned with the grid but for rounding, exactly aligned.
void snap(Eigen::Vector3d& step)
{
  const double largest = step.cwiseAbs().maxCoeff();
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    if (std::abs(step[axis]) < kAligned * largest)
      step[axis] = 0.0;
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

const char* nameOf(Projection projection)
{
  constexpr const char* names[] = {"mip", "minip", "mean"};
  return names[static_cast<std::size_t>(projection)];
}

std::optional<Projection> parseProjection(const std::string& name)
{
  for (const Projection projection : {Projection::Maximum, Projection::Minimum, Projection::Mean})
    if (name == nameOf(projection))
      return projection;
  return std::nullopt;
}

std::vector<SlabNode> slabNodes(const core::GridGeometry& image, const SliceGeometry& slice,
                                const core::RigidTransform& imageFromSlice, double thickness)
{
  if (!(thickness > 0.0))
    return {{0.0, 1.0}};
  const auto voxelAt = [&](double offset) {
    return image.voxelFromPatient(imageFromSlice * (slice.center() + offset * slice.axes().next));
  };
  const double half = 0.5 * thickness;
  const Eigen::Vector3d middle = voxelAt(0.0);
  Eigen::Vector3d step = voxelAt(1.0) - middle; // voxels per mm
  snap(step);
  Eigen::Index axis = 0;
  const double perMm = step.cwiseAbs().maxCoeff(&axis);
  std::vector<double> at{-half};
  if ((step.array() != 0.0).count() == 1)
  {
    const double low = middle[axis] - half * perMm;
    const double high = middle[axis] + half * perMm;
    for (double voxel = std::floor(low) + 1.0; voxel < high; voxel += 1.0)
      at.push_back((voxel - middle[axis]) / step[axis]);
    std::sort(at.begin(), at.end());
  }
  else
  {
    const int parts =
        std::max(2, static_cast<int>(std::ceil(2.0 * thickness * step.norm() - 1e-9)));
    for (int n = 1; n < parts; ++n)
      at.push_back(-half + n * thickness / parts);
  }
  at.push_back(half);
  std::vector<SlabNode> nodes;
  for (std::size_t n = 0; n < at.size(); ++n)
  {
    const double before = n > 0 ? at[n] - at[n - 1] : 0.0;
    const double after = n + 1 < at.size() ? at[n + 1] - at[n] : 0.0;
    nodes.push_back({at[n], 0.5 * (before + after) / thickness});
  }
  return nodes;
}

SlabSampling::SlabSampling(std::shared_ptr<const volume::IntensityVolume> image,
                           const SliceGeometry& slice, const Slab& slab,
                           const core::RigidTransform& imageFromSlice)
  : m_image(std::move(image))
  , m_slice(slice)
  , m_slab(slab)
  , m_imageFromSlice(imageFromSlice)
  , m_nodes(slabNodes(m_image->geometry(), slice, imageFromSlice, slab.thickness))
  , m_samples{slice.width(), slice.height(),
              std::vector<float>(static_cast<std::size_t>(slice.width()) *
                                     static_cast<std::size_t>(slice.height()),
                                 std::numeric_limits<float>::quiet_NaN())}
{
}

double SlabSampling::samplesPerRow() const
{
  return static_cast<double>(m_nodes.size()) * m_samples.width;
}

void SlabSampling::advance(int rows)
{
  const int width = m_samples.width;
  const int end = std::min(m_row + rows, m_samples.height);
  VoxelPlane plane(m_image->geometry(), m_slice, m_imageFromSlice);
  snap(plane.across);
  const Eigen::Vector3d normal = m_image->geometry().voxelFromPatientLinear() *
                                 (m_imageFromSlice.rotation() * m_slice.axes().next);
  m_image->visit(
      [&](const auto& voxels)
      {
        const ColumnCells cells(plane, voxels.geometry().dims(), width);
        const CellSampler sampler(voxels);
        const auto drawRow = [&](int row)
        {
          RowProjection projection(m_slab.projection, width);
          for (const SlabNode& node : m_nodes)
          {
            const Eigen::Vector3d start = plane.origin + row * plane.down + node.offset * normal;
            const auto [first, last] = insideColumns(plane, start, width);
            if (cells)
              cells.forEach(voxels.data(), start, first, last,
                            [&](std::size_t column, double value)
                            { projection.add(column, value, node.weight); });
            else
              for (int column = first; column <= last; ++column)
                projection.add(static_cast<std::size_t>(column),
                               sampler(start + column * plane.across), node.weight);
          }
          projection.write(
              &m_samples.values[static_cast<std::size_t>(row) * static_cast<std::size_t>(width)]);
        };
        tbb::parallel_for(m_row, end, drawRow);
      });
  m_row = end;
}

PlaneSamples sampleSlab(const volume::IntensityVolume& image, const SliceGeometry& slice,
                        const Slab& slab, const core::RigidTransform& imageFromSlice)
{
  if (!(slab.thickness > 0.0))
    return samplePlane(image, slice, imageFromSlice);
  const std::shared_ptr<const volume::IntensityVolume> shared(
      std::shared_ptr<const volume::IntensityVolume>(), &image); // not owned
  SlabSampling sampling(shared, slice, slab, imageFromSlice);
  sampling.advance(slice.height());
  return sampling.take();
}

double shownDepth(const volume::IntensityVolume& image, const SliceGeometry& slice,
                  const Slab& slab, const Eigen::Vector2d& pixel,
                  const core::RigidTransform& imageFromSlice)
{
  if (!(slab.thickness > 0.0) || slab.projection == Projection::Mean)
    return 0.0;
  const VoxelPlane plane(image.geometry(), slice, imageFromSlice);
  const Eigen::Vector3d start = plane.origin + pixel[0] * plane.across + pixel[1] * plane.down;
  const Eigen::Vector3d normal =
      image.geometry().voxelFromPatientLinear() * (imageFromSlice.rotation() * slice.axes().next);
  const double sign = slab.projection == Projection::Maximum ? 1.0 : -1.0;
  std::vector<SlabNode> nodes = slabNodes(image.geometry(), slice, imageFromSlice, slab.thickness);
  std::stable_sort(nodes.begin(), nodes.end(),
                   [](const SlabNode& a, const SlabNode& b)
                   { return std::abs(a.offset) < std::abs(b.offset); });
  std::optional<double> best;
  double depth = 0.0;
  image.visit(
      [&](const auto& voxels)
      {
        const CellSampler sample(voxels);
        const auto valueAt = [&](double offset)
        {
          const Eigen::Vector3d voxel = start + offset * normal;
          const bool isInside = (voxel.array() >= plane.lower.array()).all() &&
                                (voxel.array() <= plane.upper.array()).all();
          return isInside ? sign * sample(voxel) : std::numeric_limits<double>::quiet_NaN();
        };
        const auto exceeds = [&](double value)
        { return !best || value > *best + kRounding * (1.0 + std::abs(*best)); };
        for (const SlabNode& node : nodes)
          if (const double value = valueAt(node.offset); !std::isnan(value) && exceeds(value))
          {
            best = value;
            depth = node.offset;
          }
        const double middle = valueAt(0.0); // no node: as good as the best where all are alike
        if (best && middle >= *best - kRounding * (1.0 + std::abs(*best)))
          depth = 0.0;
      });
  return depth;
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
