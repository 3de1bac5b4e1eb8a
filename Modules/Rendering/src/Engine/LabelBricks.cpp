#include "LabelBricks.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace petrous::rendering
{

namespace
{

// A support that ends on a brick's face is 0 there. Rounding must not make it reach across.
constexpr double kRounding = 1e-6; // CT voxels

class Marker
{
public:
  Marker(const core::GridGeometry& labels, const core::GridGeometry& ct, const core::Index3& bricks,
         int edge)
    : m_linear(ct.voxelFromPatientLinear() * labels.patientFromVoxelLinear())
    , m_offset(ct.voxelFromPatient(labels.origin()))
    , m_bricks(bricks)
    , m_edge(edge)
    , m_marks(static_cast<std::size_t>(bricks[0]) * static_cast<std::size_t>(bricks[1]) *
              static_cast<std::size_t>(bricks[2]))
  {
    for (std::atomic<std::uint8_t>& mark : m_marks)
      mark.store(0, std::memory_order_relaxed);
    // In a rotated grid a long run is split; its bounding box could span the whole volume.
    Eigen::Vector3d aside = m_linear.col(0).cwiseAbs();
    Eigen::Index along = 0;
    aside.maxCoeff(&along);
    aside[along] = 0.0;
    m_longestRun = static_cast<int>(std::clamp(0.5 * edge / (aside.maxCoeff() + 1e-12), 1.0, 1e6));
  }

  /// Label voxels [first, last) of a row.
  void mark(int first, int last, int j, int k)
  {
    for (int i = first; i < last; i += m_longestRun)
      markBox(i, std::min(i + m_longestRun, last) - 1, j, k);
  }

  std::vector<std::uint8_t> take() const
  {
    std::vector<std::uint8_t> result(m_marks.size());
    std::transform(m_marks.begin(), m_marks.end(), result.begin(),
                   [](const std::atomic<std::uint8_t>& mark)
                   { return mark.load(std::memory_order_relaxed); });
    return result;
  }

private:
  void markBox(int first, int last, int j, int k)
  {
    const Eigen::Vector3d center =
        m_linear * Eigen::Vector3d(0.5 * (first + last), j, k) + m_offset;
    const Eigen::Vector3d half =
        m_linear.cwiseAbs() * Eigen::Vector3d(0.5 * (last - first) + 1.0, 1.0, 1.0);
    core::IndexBox box;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const auto axis = static_cast<Eigen::Index>(a);
      const double low = (center[axis] - half[axis] + kRounding) / m_edge;
      const double high = (center[axis] + half[axis] - kRounding) / m_edge;
      if (!(high > 0.0) || !(low < m_bricks[a]))
        return;
      box.lower[a] = std::max(static_cast<int>(std::floor(low)), 0);
      box.upper[a] = static_cast<int>(std::min(std::ceil(high), 1.0 * m_bricks[a]));
    }
    for (int z = box.lower[2]; z < box.upper[2]; ++z)
      for (int y = box.lower[1]; y < box.upper[1]; ++y)
      {
        std::atomic<std::uint8_t>* row =
            &m_marks[static_cast<std::size_t>(m_bricks[0]) *
                     (static_cast<std::size_t>(y) +
                      static_cast<std::size_t>(m_bricks[1]) * static_cast<std::size_t>(z))];
        for (int x = box.lower[0]; x < box.upper[0]; ++x)
          if (row[x].load(std::memory_order_relaxed) == 0) // avoids cache-line contention
            row[x].store(1, std::memory_order_relaxed);
      }
  }

  Eigen::Matrix3d m_linear; // CT voxels per label voxel
  Eigen::Vector3d m_offset;
  core::Index3 m_bricks;
  int m_edge;
  int m_longestRun = 1;
  std::vector<std::atomic<std::uint8_t>> m_marks;
};

// The first voxel from `i` on that may differ from 0: most of an occupancy is 0.
int beyondZeros(const float* row, int i, int end)
{
  constexpr int kRun = 16;
  static constexpr std::array<float, kRun> kZeros{};
  while (i + kRun <= end && std::memcmp(row + i, kZeros.data(), sizeof kZeros) == 0)
    i += kRun;
  return i;
}

} // namespace

std::vector<std::uint8_t> solidBricks(const volume::Volume<float>& occupancy,
                                      const core::GridGeometry& ct, const core::Index3& bricks,
                                      int edge)
{
  const core::Index3& dims = occupancy.geometry().dims();
  Marker marker(occupancy.geometry(), ct, bricks, edge);
  tbb::parallel_for(tbb::blocked_range<int>(0, dims[2]),
                    [&](const tbb::blocked_range<int>& slices)
                    {
                      for (int k = slices.begin(); k < slices.end(); ++k)
                        for (int j = 0; j < dims[1]; ++j)
                        {
                          const float* row = &occupancy.at(0, j, k);
                          for (int i = 0; i < dims[0]; ++i)
                          {
                            i = beyondZeros(row, i, dims[0]);
                            const int first = i;
                            while (i < dims[0] && row[i] > kSolidOccupancy)
                              ++i;
                            if (i > first)
                              marker.mark(first, i, j, k);
                          }
                        }
                    });
  return marker.take();
}

} // namespace petrous::rendering
