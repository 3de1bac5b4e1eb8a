#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "petrous/Presenters/PlaneSamples.h"
#include "petrous/Presenters/SliceGeometry.h"
#include "petrous/Presenters/SliceOverlay.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/CutMask.h"

namespace petrous::presenters
{

/// What a picture of a slice is drawn of.
struct SliceSamples
{
  PlaneSamples ct;
  std::optional<PlaneSamples> mr; ///< of an overlay
};

/// Draws slices of a case's CT with its structures and what was removed. CPU only.
///
/// The CT is grey, sampled trilinearly; nothing is drawn outside the hull of its voxel centres.
/// Visible structures are tinted, with an outline in their full colour; of a mesh its exact section
/// (MeshSection.h), unless a label has its name. Where less than half is left the picture is red
/// and hatched, with an outline.
class SlicePresenter
{
public:
  /// Copies what a slice shows of the case; voxels are shared. Loads the CT, label maps if a
  /// structure is visible, and visible meshes.
  explicit SlicePresenter(const scene::Case& value)
    : SlicePresenter(value, value.dissection.sharedMask())
  {
  }
  /// With the mask of another copy of the case, which is the one that is drilled.
  SlicePresenter(const scene::Case& value, std::shared_ptr<const volume::CutMask> mask);

  /// `overlay`: an MR shown with the CT; contours of bone and skin are drawn on top of everything.
  /// `slab`: of CT and MR; structures and what was removed are those of the slice itself.
  SlicePixels draw(const SliceGeometry& slice, const GreyWindow& window,
                   const SliceOverlay* overlay = nullptr, const Slab& slab = {}) const;
  /// Of samples that were taken before, of the same slice and overlay.
  SlicePixels draw(const SliceGeometry& slice, const GreyWindow& window,
                   const SliceOverlay* overlay, const SliceSamples& samples) const;
  SliceSamples sample(const SliceGeometry& slice, const SliceOverlay* overlay,
                      const Slab& slab) const;
  const std::shared_ptr<const volume::IntensityVolume>& image() const noexcept { return m_ct; }

  /// Whether both draw the same: a transfer function, say, is not seen in slices.
  bool drawsAs(const SlicePresenter& other) const;

  static constexpr std::array<std::uint8_t, 3> kOutside{11, 13, 16};

private:
  struct Layer
  {
    std::shared_ptr<const volume::LabelMap> labels;
    std::vector<std::array<float, 3>> colors; ///< 0 to 255, by index
    std::vector<bool> shown;                  ///< by index
  };
  struct Mesh
  {
    std::shared_ptr<const core::TriangleMesh> mesh;
    std::array<float, 3> color; ///< 0 to 255
  };
  void drawLayer(const Layer& layer, const SliceGeometry& slice, SlicePixels& pixels) const;
  void drawCut(const SliceGeometry& slice, SlicePixels& pixels) const;

  std::shared_ptr<const volume::IntensityVolume> m_ct;
  EdgeLevels m_edges;
  std::shared_ptr<const volume::CutMask> m_mask;
  std::vector<Layer> m_layers;
  std::vector<Mesh> m_meshes;
};

/// Voxels that are being segmented, drawn over a slice as a visible structure is.
struct DraftLayer
{
  core::GridGeometry geometry;
  std::function<std::uint16_t(const core::Index3&)> indexAt; ///< of a voxel of the grid; 0: none
  std::vector<std::array<float, 3>> colors;                  ///< 0 to 255, by index
  std::uint16_t hatched = 0;                                 ///< this index is; 0: none

  void paint(const SliceGeometry& slice, SlicePixels& pixels) const;
};

} // namespace petrous::presenters
