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

/// The smoothed union of structures (LabelField::occupancy), computed on demand by region: there
/// bit-identical to that of makeLabelField, elsewhere 0.
///
/// The inside voxels are found at once, in one pass over the labels. A region costs the smoothing
/// of the part of the surface within 131 cells along it (src/Labels/SurfaceNet.h). Once the regions
/// would cost more than the whole, the whole is computed. Structures of different grids are always
/// computed as a whole.
///
/// Not thread-safe: `prepare` must not run while another thread reads `occupancy`.
class RegionalUnion
{
public:
  /// Returns nullptr if no source has a voxel. All sources count as solid. Throws as
  /// makeLabelField.
  static std::shared_ptr<RegionalUnion> make(const std::vector<LabelSource>& sources,
                                             const core::Progress& progress = {});

  /// Always the same memory: `prepare` fills it in.
  const std::shared_ptr<const Volume<float>>& occupancy() const noexcept { return m_readable; }

  /// Voxels of the occupancy's grid; the box may extend beyond it.
  void prepare(const core::IndexBox& voxels, const core::Progress& progress = {});

  /// The support of trilinear interpolation in these boxes; cheaper in one call than one after the
  /// other.
  void prepare(const std::vector<core::PatientBox>& boxes, const core::Progress& progress = {});

  void prepareAll(const core::Progress& progress = {});

  bool isWhole() const noexcept { return !m_inside; } ///< nothing is left to prepare

  /// Tiles of 16 voxels whose occupancies have been computed, and their total number.
  std::size_t preparedTiles() const noexcept { return m_preparedTiles; }
  std::size_t tiles() const noexcept { return m_prepared.size(); }

private:
  RegionalUnion() = default;
  void prepareVoxels(const std::vector<core::IndexBox>& boxes, const core::Progress& progress);

  std::shared_ptr<const Volume<std::uint8_t>> m_inside; // nullptr once the whole is computed
  std::shared_ptr<Volume<float>> m_occupancy;
  std::shared_ptr<const Volume<float>> m_readable;
  core::Index3 m_tileDims{0, 0, 0};
  std::vector<bool> m_prepared;
  std::size_t m_preparedTiles = 0;
  std::size_t m_pointsRelaxed = 0;
};

} // namespace petrous::volume
