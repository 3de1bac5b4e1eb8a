#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "petrous/Presenters/SliceGeometry.h"
#include "petrous/Presenters/SliceOverlay.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/CutMask.h"

namespace petrous::presenters
{

/// Draws slices of a case's CT with its structures and what was cut. Only the CPU is used.
///
/// Grey is the CT, sampled trilinearly; outside the hull of its voxel centres nothing is drawn.
/// Structures that are shown are tinted, with an outline in their full colour. Where less than half
/// is left the picture is red and hatched.
class SlicePresenter
{
public:
  /// Takes what a slice shows of the case: its voxels are shared. Loads the CT, and label maps
  /// where a structure is shown.
  explicit SlicePresenter(const scene::Case& value);

  /// `overlay`: an MR that is seen with the CT; its contours of bone and skin lie on top of all.
  SlicePixels draw(const SliceGeometry& slice, const GreyWindow& window,
                   const SliceOverlay* overlay = nullptr) const;

  static constexpr std::array<std::uint8_t, 3> kOutside{11, 13, 16};

private:
  struct Layer
  {
    std::shared_ptr<const volume::LabelMap> labels;
    std::vector<std::array<float, 3>> colors; ///< 0 to 255, by index
    std::vector<bool> shown;                  ///< by index
  };
  void drawLayer(const Layer& layer, const SliceGeometry& slice, SlicePixels& pixels) const;
  void drawCut(const SliceGeometry& slice, SlicePixels& pixels) const;

  std::shared_ptr<const volume::IntensityVolume> m_ct;
  EdgeLevels m_edges;
  std::shared_ptr<const volume::CutMask> m_mask;
  std::vector<Layer> m_layers;
};

} // namespace petrous::presenters
