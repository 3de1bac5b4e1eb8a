#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "petrous/Presenters/SliceGeometry.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/CutMask.h"

namespace petrous::presenters
{

/// Grey from intensity: black at level - width/2, white at level + width/2, HU.
struct GreyWindow
{
  double width = 4000.0; ///< the bone window
  double level = 700.0;
};

/// An RGB picture, 8 bits a channel, rows from the top.
struct SlicePixels
{
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

  std::array<std::uint8_t, 3> at(int column, int row) const
  {
    const std::size_t first = 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                   static_cast<std::size_t>(column));
    return {rgb[first], rgb[first + 1], rgb[first + 2]};
  }
};

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

  SlicePixels draw(const SliceGeometry& slice, const GreyWindow& window) const;

  static constexpr std::array<std::uint8_t, 3> kOutside{11, 13, 16};

private:
  struct Layer
  {
    std::shared_ptr<const volume::LabelMap> labels;
    std::vector<std::array<float, 3>> colors; ///< 0 to 255, by index
    std::vector<bool> shown;                  ///< by index
  };
  template <class T>
  void drawGrey(const volume::Volume<T>& ct, const SliceGeometry& slice, const GreyWindow& window,
                SlicePixels& pixels) const;
  void drawLayer(const Layer& layer, const SliceGeometry& slice, SlicePixels& pixels) const;
  void drawCut(const SliceGeometry& slice, SlicePixels& pixels) const;

  std::shared_ptr<const volume::IntensityVolume> m_ct;
  std::shared_ptr<const volume::CutMask> m_mask;
  std::vector<Layer> m_layers;
};

} // namespace petrous::presenters
