#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>

#include "petrous/Core/Error.h"
#include "petrous/Core/GridGeometry.h"

namespace petrous::volume
{

/// Voxels of one type on a grid, the first axis fastest.
///
/// The memory is shared, never copied: it may belong to this volume, to a mapped file, or to a VTK
/// or ITK object kept alive by the deleter of `data`. Share as shared_ptr<const Volume<T>>.
template <class T>
class Volume
{
public:
  using Value = T;

  /// Allocates geometry.voxelCount() voxels, not initialised.
  explicit Volume(const core::GridGeometry& geometry)
    : m_geometry(geometry)
    , m_data(new T[geometry.voxelCount()], std::default_delete<T[]>())
  {
  }

  Volume(const core::GridGeometry& geometry, T fill)
    : Volume(geometry)
  {
    std::fill_n(data(), size(), fill);
  }

  /// Adopts memory of at least geometry.voxelCount() voxels.
  Volume(const core::GridGeometry& geometry, std::shared_ptr<T> data)
    : m_geometry(geometry)
    , m_data(std::move(data))
  {
    if (!m_data)
      throw core::InvalidParameter("volume: no voxel memory given");
  }

  const core::GridGeometry& geometry() const noexcept { return m_geometry; }
  std::size_t size() const noexcept { return m_geometry.voxelCount(); }
  std::size_t bytes() const noexcept { return size() * sizeof(T); }
  T* data() noexcept { return m_data.get(); }
  const T* data() const noexcept { return m_data.get(); }
  T& at(int i, int j, int k) noexcept { return m_data.get()[m_geometry.linearIndex(i, j, k)]; }
  const T& at(int i, int j, int k) const noexcept
  {
    return m_data.get()[m_geometry.linearIndex(i, j, k)];
  }

private:
  core::GridGeometry m_geometry;
  std::shared_ptr<T> m_data;
};

/// Zero-initialised voxels that take memory only where other values are written.
template <class T>
std::shared_ptr<Volume<T>> makeZeroVolume(const core::GridGeometry& geometry)
{
  std::shared_ptr<T> memory(static_cast<T*>(std::calloc(geometry.voxelCount(), sizeof(T))),
                            [](T* data) { std::free(data); });
  if (!memory)
    throw std::bad_alloc();
  return std::make_shared<Volume<T>>(geometry, std::move(memory));
}

} // namespace petrous::volume
