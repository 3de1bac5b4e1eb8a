#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "petrous/Core/PatientBox.h"
#include "petrous/Core/Progress.h"
#include "petrous/Volume/LabelField.h"

namespace petrous::volume
{

/// The smoothed union of structures (LabelField::occupancy) which is worked out only where it is asked
/// for: there it is that of makeLabelField to the last bit, elsewhere 0.
///
/// Which voxels are inside is found at once, in one look at the labels. A region costs the
/// smoothing of the part of the surface that lies within 131 cells along it (src/Labels/SurfaceNet.h).
/// Where regions have become so many that the whole would have cost less, the whole is made.
/// Structures of different grids are always made whole.
///
/// Whoever reads `occupancy` in one thread may not ask for more in another at the same time.
class RegionalUnion
{
public:
  /// Null when no source has a voxel. All sources count as solid. Throws as makeLabelField.
  static std::shared_ptr<RegionalUnion> make(const std::vector<LabelSource>& sources,
                                             const core::Progress& progress = {});

  /// The same memory always: it is filled where `prepare` asked for it.
  const std::shared_ptr<const Volume<float>>& occupancy() const noexcept { return m_readable; }

  /// Voxels of the occupancy's grid; the box may reach beyond it.
  void prepare(const core::IndexBox& voxels, const core::Progress& progress = {});

  /// What trilinear interpolation in these boxes asks for; at once, which costs less than one
  /// after the other.
  void prepare(const std::vector<core::PatientBox>& boxes, const core::Progress& progress = {});

  void prepareAll(const core::Progress& progress = {});

  /// Tiles of 16 voxels whose occupancies are known, and how many there are.
  std::size_t preparedTiles() const noexcept { return m_preparedTiles; }
  std::size_t tiles() const noexcept { return m_prepared.size(); }

private:
  RegionalUnion() = default;
  void prepareVoxels(const std::vector<core::IndexBox>& boxes, const core::Progress& progress);

  std::shared_ptr<const Volume<std::uint8_t>> m_inside; // null once the whole is made
  std::shared_ptr<Volume<float>> m_occupancy;
  std::shared_ptr<const Volume<float>> m_readable;
  core::Index3 m_tileDims{0, 0, 0};
  std::vector<bool> m_prepared;
  std::size_t m_preparedTiles = 0;
  std::size_t m_pointsRelaxed = 0;
};

} // namespace petrous::volume
