#pragma once

#include <array>
#include <memory>
#include <string>

#include "petrous/Core/RigidTransform.h"
#include "petrous/Presenters/SliceGeometry.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/IntensityHistogram.h"

namespace petrous::presenters
{

/// Grey-level window: black at level - width/2, white at level + width/2, in the image's unit.
struct GreyWindow
{
  double width = 4000.0; ///< the bone window, HU
  double level = 700.0;
};

/// An RGB image, 8 bits per channel, rows from the top.
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

/// How an MR is shown together with the CT.
enum class OverlayMode
{
  Blend,  ///< alpha-blended; the MR tinted warm while both are visible
  Edges,  ///< the MR alone, with the CT's contours of bone and skin
  Checker ///< checkerboard of CT and MR, fixed in the patient
};
const char* nameOf(OverlayMode mode); ///< "blend", ...

/// An MR overlay on CT slices; a value type. Shares the voxels.
struct SliceOverlay
{
  std::shared_ptr<const volume::IntensityVolume> mr;
  core::RigidTransform mrFromCt; ///< patient points, LPS mm
  bool registered = false;       ///< if false, a viewer states so beside the picture
  GreyWindow window;             ///< in the MR's own values
  OverlayMode mode = OverlayMode::Blend;
  double opacity = 0.5; ///< of the MR in Blend, 0 to 1
};

/// The images of which slices show intensities; contours of one do not count.
struct ShownImages
{
  bool ct = true;
  std::string mr; ///< its name; empty: none

  bool operator==(const ShownImages& other) const { return ct == other.ct && mr == other.mr; }
};

/// Loads the MR's voxels and scans them for the grey window.
SliceOverlay overlayOf(const scene::ImagePart& mr);

/// From the 2nd to the 99.5th percentile of the non-background values: an MR has no units.
GreyWindow suggestMrWindow(const volume::IntensityHistogram& histogram);

/// CT values at which contours are drawn over an MR.
struct EdgeLevels
{
  float bone;  ///< HU, the case's threshold
  float skin;  ///< between air and soft tissue
  float slope; ///< per mm: below this CT gradient a contour would follow noise
};
EdgeLevels edgeLevels(const volume::IntensityScale& scale);

/// Side of the checkerboard's squares, mm: a round number, about 40 pixels.
double checkerSide(double mmPerPixel);

constexpr std::array<std::uint8_t, 3> kBoneEdge{255, 208, 64};
constexpr std::array<std::uint8_t, 3> kSkinEdge{86, 214, 255};

} // namespace petrous::presenters
