#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "MeshShares.h"
#include "OccupancyGrid.h"
#include "petrous/Appearance/Material.h"
#include "petrous/Volume/CutMask.h"
#include "petrous/Volume/IntensityVolume.h"
#include "petrous/Volume/LabelField.h"

namespace petrous::rendering
{

/// How much of each block of the CT's voxels is tissue, and what that stops of the light, averaged
/// over 2^3 blocks from level to level: what a cone of directions meets is looked up where a texel
/// is as wide as the cone. Plain data on the CPU.
///
/// A voxel stops the surface opacity of its material, times the share of the voxel in which f > 0:
///   1/2 + f / |grad f|, clamped to 0..1    where f changes sign to one of its six neighbours
///   1 or 0                                 elsewhere
/// A closed mesh stops its opacity times its share of a texel. Where both are, or several meshes,
/// the most counts: a mesh made of this CT lies where its bone does. Neither crop box nor clipping
/// planes are taken into account.
class OpacityPyramid
{
public:
  static constexpr double kEdge = 0.5;                              ///< mm, wanted of a texel
  static constexpr std::size_t kMostTexels = std::size_t{1} << 25U; ///< else texels are larger
  static constexpr double kWidest = 4.0; ///< mm, texels of the last level

  struct Mesh
  {
    std::shared_ptr<const MeshShares> shares;
    double opacity = 1.0;
    bool drilled = false; ///< the mask counts

    friend bool operator==(const Mesh& a, const Mesh& b) noexcept
    {
      return a.shares == b.shares && a.opacity == b.opacity && a.drilled == b.drilled;
    }
  };

  struct Scene
  {
    const volume::IntensityVolume& ct;
    const volume::LabelField* labels;
    const volume::CutMask* mask;
    const std::vector<appearance::Material>& materials;
    double iso;
    bool bone;
    const std::vector<Mesh>* meshes = nullptr; ///< null: none
  };

  /// Of 255.
  struct Texel
  {
    std::uint8_t tissue = 0;
    std::uint8_t stopped = 0;
  };
  struct Level
  {
    core::Index3 dims{};
    std::vector<Texel> texels; ///< first axis fastest
  };

  explicit OpacityPyramid(const core::GridGeometry& ct);

  /// `grid`: of the scene as it is.
  void rebuild(const Scene& scene, const OccupancyGrid& grid);

  /// The mask changed in a box of voxels. Returns the box of texels of the first level outside of
  /// which nothing changed; the result equals that of a rebuild.
  core::IndexBox maskChanged(const Scene& scene, const OccupancyGrid& grid,
                             const core::IndexBox& voxels);

  /// Of its texels; see meshShares.
  MeshShares sharesOf(const core::TriangleMesh& mesh) const
  {
    return meshShares(mesh, m_grid, m_factor);
  }

  /// The meshes changed in a box of texels of the first level, and nothing else did: tissue is not
  /// measured again, and the result equals that of a rebuild.
  void meshesChanged(const Scene& scene, const core::IndexBox& texels);

  /// The texels of a level that depend on a box of the first.
  static core::IndexBox boxAt(std::size_t level, const core::IndexBox& texels) noexcept;

  /// Texels of the first level outside of which nothing stops light. Grows with what changes, and
  /// is the smallest after a rebuild.
  const core::IndexBox& stopping() const noexcept { return m_stopping; }

  /// From the first on; each has half the texels of the one before along each axis.
  const std::vector<Level>& levels() const noexcept { return m_levels; }
  const core::Index3& factor() const noexcept { return m_factor; } ///< voxels of a texel
  std::size_t bytes() const noexcept;

  friend bool operator==(const Texel& a, const Texel& b) noexcept
  {
    return a.tissue == b.tissue && a.stopped == b.stopped;
  }

private:
  void update(const Scene& scene, const OccupancyGrid& grid, const core::IndexBox& texels);
  void keepTissue();
  void combine(const Scene& scene, const core::IndexBox& texels);
  void addMesh(const Mesh& mesh, const volume::CutMask* mask, const core::IndexBox& texels);
  core::IndexBox voxelsOf(const core::IndexBox& texels) const noexcept;
  core::IndexBox stoppingIn(const core::IndexBox& texels) const;
  void reduce(std::size_t level, const core::IndexBox& texels);

  core::GridGeometry m_grid;
  core::Index3 m_factor{1, 1, 1};
  std::vector<Level> m_levels;
  std::vector<Texel> m_tissue; // the first level without meshes; empty: there are none in it
  core::IndexBox m_stopping;
};

} // namespace petrous::rendering
