#include "MacroCells.h"

#include <algorithm>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <vtkImageData.h>

namespace petrous::rendering
{

namespace
{

std::size_t cellIndex(const core::Index3& dims, int i, int j, int k)
{
  return static_cast<std::size_t>(i) +
         static_cast<std::size_t>(dims[0]) *
             (static_cast<std::size_t>(j) +
              static_cast<std::size_t>(dims[1]) * static_cast<std::size_t>(k));
}

// Voxels whose values meet in the cell: its own and the next on each axis.
core::IndexBox reach(const core::Index3& voxels, int i, int j, int k)
{
  constexpr int edge = MacroCells::kEdge;
  core::IndexBox box;
  const core::Index3 cell{i, j, k};
  for (std::size_t a = 0; a < 3; ++a)
  {
    box.lower[a] = cell[a] * edge;
    box.upper[a] = std::min((cell[a] + 1) * edge + 1, voxels[a]);
  }
  return box;
}

template <class Visit>
void forEachCell(const core::Index3& dims, const Visit& visit)
{
  tbb::parallel_for(tbb::blocked_range<int>(0, dims[2]),
                    [&](const tbb::blocked_range<int>& range)
                    {
                      for (int k = range.begin(); k < range.end(); ++k)
                        for (int j = 0; j < dims[1]; ++j)
                          for (int i = 0; i < dims[0]; ++i)
                            visit(i, j, k);
                    });
}

bool allCut(const volume::CutMask& mask, const core::IndexBox& box)
{
  const core::IndexBox bricks = mask.bricksCovering(box);
  for (int k = bricks.lower[2]; k < bricks.upper[2]; ++k)
    for (int j = bricks.lower[1]; j < bricks.upper[1]; ++j)
      for (int i = bricks.lower[0]; i < bricks.upper[0]; ++i)
        if (!mask.brick(mask.brickIndex({i, j, k})))
          return false;
  // Above half: 32768 of 65535 is the first value that lies in tissue.
  for (int k = box.lower[2]; k < box.upper[2]; ++k)
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
      for (int i = box.lower[0]; i < box.upper[0]; ++i)
        if (mask.at(i, j, k) > volume::CutMask::kUntouched / 2)
          return false;
  return true;
}

// Distances along one axis by a forward and a backward pass; three axes give the Chebyshev
// distance when each pass takes the whole neighbourhood of the plane before it.
void chamfer(std::uint8_t* cells, const core::Index3& dims)
{
  const auto relax = [&](int i, int j, int k, int sign)
  {
    std::uint8_t& own = cells[cellIndex(dims, i, j, k)];
    for (int dk = -1; dk <= 0; ++dk)
      for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di)
        {
          // The half of the neighbours that a raster scan has visited before.
          if (dk == 0 && (dj > 0 || (dj == 0 && di >= 0)))
            continue;
          const int x = i + sign * di;
          const int y = j + sign * dj;
          const int z = k + sign * dk;
          if (x < 0 || y < 0 || z < 0 || x >= dims[0] || y >= dims[1] || z >= dims[2])
            continue;
          const int through = cells[cellIndex(dims, x, y, z)] + 1;
          if (through < own)
            own = static_cast<std::uint8_t>(through);
        }
  };
  for (int k = 0; k < dims[2]; ++k)
    for (int j = 0; j < dims[1]; ++j)
      for (int i = 0; i < dims[0]; ++i)
        relax(i, j, k, 1);
  for (int k = dims[2] - 1; k >= 0; --k)
    for (int j = dims[1] - 1; j >= 0; --j)
      for (int i = dims[0] - 1; i >= 0; --i)
        relax(i, j, k, -1);
}

} // namespace

MacroCells::MacroCells(const volume::IntensityVolume& ct)
  : m_grid(ct.geometry())
  , m_distances(vtkSmartPointer<vtkImageData>::New())
{
  const core::Index3& voxels = m_grid.dims();
  for (std::size_t a = 0; a < 3; ++a)
    m_dims[a] = std::max((voxels[a] - 1 + kEdge - 1) / kEdge, 1);
  m_max.resize(cellIndex(m_dims, 0, 0, m_dims[2]));
  m_distances->SetDimensions(m_dims.data());
  m_distances->AllocateScalars(VTK_UNSIGNED_CHAR, 1);

  ct.visit(
      [&](const auto& volume)
      {
        forEachCell(m_dims,
                    [&](int i, int j, int k)
                    {
                      const core::IndexBox box = reach(voxels, i, j, k);
                      float largest = -std::numeric_limits<float>::infinity();
                      for (int z = box.lower[2]; z < box.upper[2]; ++z)
                        for (int y = box.lower[1]; y < box.upper[1]; ++y)
                        {
                          const auto* row = &volume.at(0, y, z);
                          for (int x = box.lower[0]; x < box.upper[0]; ++x)
                            largest =
                                std::max(largest, static_cast<float>(row[x])); // NaN never wins
                        }
                      m_max[cellIndex(m_dims, i, j, k)] = largest;
                    });
      });
}

void MacroCells::update(double iso, const volume::CutMask* mask)
{
  auto* cells = static_cast<std::uint8_t*>(m_distances->GetScalarPointer());
  forEachCell(m_dims,
              [&](int i, int j, int k)
              {
                const std::size_t index = cellIndex(m_dims, i, j, k);
                const bool empty = !(static_cast<double>(m_max[index]) > iso) ||
                                   (mask && allCut(*mask, reach(m_grid.dims(), i, j, k)));
                cells[index] = empty ? std::uint8_t{255} : std::uint8_t{0};
              });
  chamfer(cells, m_dims);
  m_distances->Modified();
}

vtkImageData* MacroCells::distances() const
{
  return m_distances;
}

std::size_t MacroCells::bytes() const
{
  return m_max.size() * (sizeof(float) + sizeof(std::uint8_t));
}

} // namespace petrous::rendering
