#include "petrous/Scene/ViewState.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>
#include <tuple>

#include "PlaceRange.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Scene/PlainText.h"

namespace petrous::scene
{

namespace
{

using Slices = ViewState::Slices;

template <class Names>
bool isOneOf(const std::string& word, const Names& names)
{
  return std::find(std::begin(names), std::end(names), word) != std::end(names);
}

void require(bool holds, const std::string& what)
{
  if (!holds)
    throw core::InvalidParameter("view: " + what);
}

bool isWithin(double value, double lower, double upper)
{
  return value >= lower && value <= upper;
}

void checkSlices(const Slices& slices)
{
  constexpr double kLargest = std::numeric_limits<float>::max(); // of an image's values
  require(slices.width > 0.0 && slices.width <= 2.0 * kLargest,
          "window_width, of the slices' grey window, must be above 0, to 6.8e38");
  require(isWithin(slices.level, -kLargest, kLargest),
          "window_level, of the slices' grey window, must be -3.4e38 to 3.4e38");
  require(isPlace(slices.crosshair), "crosshair_mm must lie within 10 km");
  if (slices.planes)
    for (const Slices::Plane& plane : *slices.planes)
    {
      require(isWithin(plane.zoom, 1.0, 1000.0), "the zoom of a slice must be 1 to 1000");
      require(isPlace(plane.offset), "offset_mm of a slice must lie within 10 km");
    }
  if (slices.turned)
  {
    constexpr std::string_view kKinds[] = {"petrous", "tool-axial", "tool-coronal", "tool-sagittal",
                                           "free"};
    require(
        isOneOf(slices.turned->kind, kKinds),
        "planes that were turned must be petrous, tool-axial, tool-coronal, tool-sagittal or free");
    for (const Slices::Turned::Axes& axes : slices.turned->planes)
      require(std::abs(axes.right.norm() - 1.0) < 1e-6 && std::abs(axes.down.norm() - 1.0) < 1e-6 &&
                  std::abs(axes.right.dot(axes.down)) < 1e-6,
              "the axes of a plane must have length 1 and be perpendicular to each other");
  }
  if (slices.slab)
  {
    constexpr std::string_view kProjections[] = {"mip", "minip", "mean"};
    require(isOneOf(slices.slab->projection, kProjections) && slices.slab->thickness > 0.0 &&
                slices.slab->thickness <= 1000.0,
            "a slab must be mip, minip or mean, above 0 to 1000 mm thick");
  }
  if (!slices.overlay)
    return;
  constexpr std::string_view kModes[] = {"blend", "edges", "checker"};
  require(!slices.overlay->mr.empty() && isOneOf(slices.overlay->mode, kModes) &&
              isWithin(slices.overlay->opacity, 0.0, 1.0),
          "the MR over the slices needs a name, the mode blend, edges or checker, and an opacity "
          "of 0 to 1");
}

void checkClipping(const ViewState::Clipping& clipping)
{
  require(clipping.planes.size() <= ViewState::kMaxClippingPlanes,
          "there are at most " + std::to_string(ViewState::kMaxClippingPlanes) +
              " clipping planes");
  for (const ViewState::Clipping::Plane& plane : clipping.planes)
    require(isPlace(plane.point) && std::abs(plane.normal.norm() - 1.0) < 1e-6,
            "point_mm of a clipping plane must lie within 10 km, and its normal have length 1");
  if (clipping.crop)
    for (std::size_t a = 0; a < 3; ++a)
      require(clipping.crop->lower[a] >= 0 && clipping.crop->lower[a] < clipping.crop->upper[a],
              "the box of voxels that are shown must not be empty");
}

void checkSaved(const ViewState::Saved& saved)
{
  if (saved.slices)
    checkSlices(*saved.slices);
  if (saved.clipping)
    checkClipping(*saved.clipping);
}

} // namespace

bool operator==(const Slices& a, const Slices& b)
{
  const auto equalPlanes = [](const auto& one, const auto& other)
  {
    return one.has_value() == other.has_value() &&
           (!one || std::equal(one->begin(), one->end(), other->begin(),
                               [](const Slices::Plane& p, const Slices::Plane& q)
                               { return p.zoom == q.zoom && p.offset == q.offset; }));
  };
  const auto equalOverlays = [](const auto& one, const auto& other)
  {
    return one.has_value() == other.has_value() &&
           (!one || std::tie(one->mr, one->mode, one->opacity) ==
                        std::tie(other->mr, other->mode, other->opacity));
  };
  const auto equalTurned = [](const auto& one, const auto& other)
  {
    return one.has_value() == other.has_value() &&
           (!one || (one->kind == other->kind &&
                     std::equal(one->planes.begin(), one->planes.end(), other->planes.begin(),
                                [](const auto& p, const auto& q)
                                { return p.right == q.right && p.down == q.down; })));
  };
  const auto equalSlabs = [](const auto& one, const auto& other)
  {
    return one.has_value() == other.has_value() &&
           (!one || std::tie(one->thickness, one->projection) ==
                        std::tie(other->thickness, other->projection));
  };
  return equalTurned(a.turned, b.turned) && equalSlabs(a.slab, b.slab) &&
         a.crosshair == b.crosshair && a.width == b.width && a.level == b.level &&
         equalPlanes(a.planes, b.planes) && equalOverlays(a.overlay, b.overlay);
}

bool operator==(const ViewState::Light& a, const ViewState::Light& b)
{
  return std::tie(a.falloff, a.wetness, a.shadows, a.exposure, a.toneCurve, a.edges, a.grain,
                  a.exitSurfaces) == std::tie(b.falloff, b.wetness, b.shadows, b.exposure,
                                              b.toneCurve, b.edges, b.grain, b.exitSurfaces);
}

bool operator==(const ViewState::Stereo& a, const ViewState::Stereo& b)
{
  return std::tie(a.mode, a.eyeSeparation, a.convergence) ==
         std::tie(b.mode, b.eyeSeparation, b.convergence);
}

bool operator==(const ViewState::Clipping& a, const ViewState::Clipping& b)
{
  const auto isSameBox = [](const auto& one, const auto& other)
  {
    return one.has_value() == other.has_value() &&
           (!one || (one->lower == other->lower && one->upper == other->upper));
  };
  return std::equal(a.planes.begin(), a.planes.end(), b.planes.begin(), b.planes.end(),
                    [](const auto& p, const auto& q)
                    { return p.point == q.point && p.normal == q.normal; }) &&
         isSameBox(a.crop, b.crop);
}

bool operator==(const ViewState::Handpiece& a, const ViewState::Handpiece& b)
{
  return a.turn == b.turn && a.tilt == b.tilt && a.isLeft == b.isLeft;
}

bool operator==(const ViewState::Tool& a, const ViewState::Tool& b)
{
  const auto all = [](const ViewState::Tool& tool)
  {
    return std::tie(tool.burr.kind, tool.burr.name, tool.burr.diameter, tool.burr.rpm, tool.thrust,
                    tool.byWheel);
  };
  return all(a) == all(b);
}

bool operator==(const ViewState::Instrument& a, const ViewState::Instrument& b)
{
  const auto mesh = a.mesh.peek();
  const bool isSame =
      a.object.empty() || b.object.empty() ? mesh && mesh == b.mesh.peek() : a.object == b.object;
  return isSame && std::tie(a.name, a.axis) == std::tie(b.name, b.axis);
}

void checkViewName(const std::string& name)
{
  require(!name.empty() && name.size() <= ViewState::kLongestName && core::isUtf8(name) &&
              !hasInvisible(name) && name.front() != ' ' && name.back() != ' ',
          "a name must be 1 to " + std::to_string(ViewState::kLongestName) +
              " bytes of UTF-8 without characters that are not seen and without spaces around it");
}

void checkView(const ViewState& view)
{
  require(view.saved.size() <= ViewState::kMaxSaved,
          "there are at most " + std::to_string(ViewState::kMaxSaved) + " saved views");
  for (const auto& [name, saved] : view.saved)
  {
    checkViewName(name);
    require(saved.camera.has_value(), "a saved view must have a camera");
    checkSaved(saved);
  }
  for (const auto& branch : view.branches)
    checkSaved(branch.second);
  if (view.slices)
    checkSlices(*view.slices);
  if (view.light)
    require(isWithin(view.light->falloff, 0.0, 1e4) && isWithin(view.light->wetness, 0.0, 1.0),
            "the light's falloff_mm must be 0 to 10000 mm, the wetness 0 to 1");
  constexpr double kMaxExposure = ViewState::Light::kMaxExposure;
  if (view.light)
    require(isWithin(view.light->exposure, -kMaxExposure, kMaxExposure),
            "the exposure_ev must be -4 to 4 EV");
  if (view.light)
    require(isWithin(view.light->edges, 0.0, 1.0), "the edges' emphasis must be 0 to 1");
  if (view.light)
    require(isWithin(view.light->grain, 0.0, 1.0), "the grain of cut bone must be 0 to 1");
  if (view.stereo)
  {
    constexpr std::string_view kModes[] = {"none", "side-by-side", "interleaved", "anaglyph",
                                           "quad-buffer"};
    require(isOneOf(view.stereo->mode, kModes), "the stereo mode is unknown");
    require(isWithin(view.stereo->eyeSeparation.value_or(0.0), 0.0, 200.0) &&
                isWithin(view.stereo->convergence.value_or(1.0), 1.0, 1e4),
            "eyes must be 0 to 200 mm apart, and converge at 1 to 10000 mm");
  }
  checkClipping(view.clipping);
  if (view.tool)
    require(isWithin(view.tool->burr.diameter, 0.01, 100.0) &&
                isWithin(view.tool->burr.rpm, 0.0, 1e6) && isWithin(view.tool->thrust, 0.0, 100.0),
            "a burr must be 0.01 to 100 mm wide and turn at 0 to 1000000 rpm, with a thrust of 0 "
            "to 100 N");
  if (view.handpiece)
    require(isWithin(view.handpiece->turn, -180.0, 180.0) &&
                isWithin(view.handpiece->tilt, 0.0, 90.0),
            "a handpiece must be turned by -180 to 180 and tilted by 0 to 90 degrees");
  if (view.instrument)
  {
    const std::string& axis = view.instrument->axis;
    require(axis.size() == 2 && axis[0] >= 'x' && axis[0] <= 'z' &&
                (axis[1] == '+' || axis[1] == '-'),
            "an instrument lies along x+, x-, y+, y-, z+ or z-");
    const std::string& name = view.instrument->name;
    require(name.size() <= InstrumentView::kLongestName && core::isUtf8(name) &&
                !hasInvisible(name),
            "the name of an instrument must be at most " +
                std::to_string(InstrumentView::kLongestName) +
                " bytes of UTF-8 without characters that are not seen");
  }
}

} // namespace petrous::scene
