#include "petrous/Volume/CutMask.h"

#include <algorithm>
#include <utility>

namespace petrous::volume
{

namespace
{
constexpr double kFull = CutMask::kUntouched;
} // namespace

CutMask::CutMask(const core::GridGeometry& geometry)
  : m_geometry(geometry)
{
  for (std::size_t a = 0; a < 3; ++a)
    m_brickDims[a] = (geometry.dims()[a] + kBrickEdge - 1) / kBrickEdge;
  const std::size_t count = static_cast<std::size_t>(m_brickDims[0]) *
                            static_cast<std::size_t>(m_brickDims[1]) *
                            static_cast<std::size_t>(m_brickDims[2]);
  m_bricks.resize(count);
  m_isDirty.resize(count, false);
}

core::IndexBox CutMask::brickBox(std::size_t brick) const noexcept
{
  const auto nx = static_cast<std::size_t>(m_brickDims[0]);
  const auto ny = static_cast<std::size_t>(m_brickDims[1]);
  const core::Index3 position{static_cast<int>(brick % nx), static_cast<int>(brick / nx % ny),
                              static_cast<int>(brick / nx / ny)};
  core::IndexBox box;
  for (std::size_t a = 0; a < 3; ++a)
  {
    box.lower[a] = position[a] * kBrickEdge;
    box.upper[a] = std::min(box.lower[a] + kBrickEdge, m_geometry.dims()[a]);
  }
  return box;
}

core::IndexBox CutMask::bricksCovering(const core::IndexBox& voxels) const noexcept
{
  const core::IndexBox inside = voxels.intersected(m_geometry.fullBox());
  if (inside.empty())
    return {};
  core::IndexBox bricks;
  for (std::size_t a = 0; a < 3; ++a)
  {
    bricks.lower[a] = inside.lower[a] / kBrickEdge;
    bricks.upper[a] = (inside.upper[a] - 1) / kBrickEdge + 1;
  }
  return bricks;
}

void CutMask::setBrick(std::size_t index, BrickVersion version)
{
  if (!m_isDirty[index])
  {
    m_dirty.push_back(index); // first: if it throws, nothing has changed
    m_isDirty[index] = true;
  }
  m_bricks[index] = std::move(version);
}

double CutMask::sample(const Eigen::Vector3d& voxel) const noexcept
{
  const TrilinearCell cell(voxel, m_geometry.dims());
  const auto brickOf = [this](const core::Index3& v) {
    return brickIndex({v[0] / kBrickEdge, v[1] / kBrickEdge, v[2] / kBrickEdge});
  };
  const std::size_t first = brickOf(cell.lower);
  if (first == brickOf(cell.upper))
  {
    const Brick* brick = m_bricks[first].get();
    if (!brick)
      return 1.0;
    return cell.interpolate([brick](int i, int j, int k)
                            { return static_cast<double>((*brick)[offsetInBrick(i, j, k)]); }) /
           kFull;
  }
  return cell.interpolate([this](int i, int j, int k)
                          { return static_cast<double>(at(i, j, k)); }) /
         kFull;
}

bool CutMask::untouched() const noexcept
{
  return std::none_of(m_bricks.begin(), m_bricks.end(),
                      [](const BrickVersion& version) { return version != nullptr; });
}

bool CutMask::untouched(const core::IndexBox& voxels) const noexcept
{
  const core::IndexBox bricks = bricksCovering(voxels);
  for (int k = bricks.lower[2]; k < bricks.upper[2]; ++k)
    for (int j = bricks.lower[1]; j < bricks.upper[1]; ++j)
      for (int i = bricks.lower[0]; i < bricks.upper[0]; ++i)
        if (m_bricks[brickIndex({i, j, k})])
          return false;
  return true;
}

std::vector<std::size_t> CutMask::cutBricks() const
{
  std::vector<std::size_t> bricks;
  for (std::size_t n = 0; n < m_bricks.size(); ++n)
    if (m_bricks[n])
      bricks.push_back(n);
  return bricks;
}

std::size_t CutMask::residentBytes() const noexcept
{
  const auto made = std::count_if(m_bricks.begin(), m_bricks.end(),
                                  [](const BrickVersion& version) { return version != nullptr; });
  return static_cast<std::size_t>(made) * sizeof(Brick) + m_bricks.size() * sizeof(BrickVersion);
}

std::vector<std::size_t> CutMask::takeDirty()
{
  for (const std::size_t index : m_dirty)
    m_isDirty[index] = false;
  return std::exchange(m_dirty, {});
}

core::IndexBox CutMask::boxOf(const std::vector<std::size_t>& bricks) const noexcept
{
  core::IndexBox box;
  for (const std::size_t brick : bricks)
    box = box.united(brickBox(brick));
  if (box.empty())
    return box;
  for (std::size_t a = 0; a < 3; ++a)
  {
    --box.lower[a];
    ++box.upper[a];
  }
  return box.intersected(m_geometry.fullBox());
}

Volume<std::uint16_t> CutMask::dense() const
{
  Volume<std::uint16_t> result(m_geometry, kUntouched);
  for (std::size_t index = 0; index < m_bricks.size(); ++index)
  {
    if (!m_bricks[index])
      continue;
    const core::IndexBox box = brickBox(index);
    for (int k = box.lower[2]; k < box.upper[2]; ++k)
      for (int j = box.lower[1]; j < box.upper[1]; ++j)
      {
        const std::uint16_t* from = m_bricks[index]->data() + offsetInBrick(box.lower[0], j, k);
        std::copy(from, from + (box.upper[0] - box.lower[0]), &result.at(box.lower[0], j, k));
      }
  }
  return result;
}

} // namespace petrous::volume
