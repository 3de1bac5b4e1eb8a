#pragma once

#include <array>
#include <optional>
#include <string>

#include "petrous/Presenters/SliceGeometry.h"
#include "petrous/Scene/Description.h"
#include "petrous/Scene/ViewState.h"

namespace petrous::scene
{
struct Case;
struct ImagePart;
} // namespace petrous::scene

namespace petrous::presenters
{

/// The planes of three slices that are perpendicular to each other and meet in the crosshair; a
/// value type. Each was turned from the standard slice of its place.
///
/// Petrous planes stand upright at 45 degrees to the sagittal and the coronal plane, about the
/// patient's inferior-superior axis (LPS z), by the side of the ear:
///
///   Stenvers  parallel to the long axis of the petrous pyramid, which runs from posterolateral to
///             anteromedial (in place of the coronal slice)
///   Poeschl   perpendicular to it, parallel to the superior semicircular canal, from anterolateral
///             to posteromedial (in place of the sagittal slice)
///
/// The axial slice stays. How the head lay in the scanner is not corrected.
class SlicePlanes
{
public:
  enum class Kind
  {
    Standard,
    Petrous,
    Tool, ///< one across the tool's axis, two along it
    Free
  };

  SlicePlanes() = default;                      ///< axial, coronal, sagittal
  static SlicePlanes petrous(scene::Side side); ///< left, or else right
  /// The standard planes after the smallest rotation that brings the patient axis nearest to `axis`
  /// onto it; turned about the axis they stay as upright as can be. `before`: the planes so far; if
  /// they are a tool's, the same slice stays across the tool as long as its axis is within 60
  /// degrees. Zero or not finite: as before.
  static SlicePlanes alongTool(const Eigen::Vector3d& axis, const SlicePlanes& before);
  /// As saved; what is not saved, or not perpendicular, is standard.
  static SlicePlanes from(const scene::ViewState::Slices& slices);
  void store(scene::ViewState::Slices& slices) const;

  Kind kind() const noexcept { return m_kind; }
  bool isStandard() const noexcept { return m_kind == Kind::Standard; }
  const SliceAxes& axes(SliceOrientation slice) const
  {
    return m_axes[static_cast<std::size_t>(slice)];
  }
  bool isTurned(SliceOrientation slice) const; ///< from the standard one
  /// "Axial", "Pöschl", "Stenvers", "Across the tool", "Along the tool", "Coronal, turned 12°".
  std::string name(SliceOrientation slice) const;

  /// Turns the other two about the normal of a slice, clockwise in its picture; degrees.
  void turnOthers(SliceOrientation slice, double degrees);
  /// Tilts a slice, and with it the plane that stays perpendicular: its picture's lower edge comes
  /// towards the viewer by `down` degrees, its right edge by `right`.
  void tilt(SliceOrientation slice, double right, double down);

private:
  void turn(SliceOrientation slice, const Eigen::Matrix3d& rotation);

  Kind m_kind = Kind::Standard;
  SliceOrientation m_across = SliceOrientation::Axial; // the tool
  std::array<SliceAxes, 3> m_axes{axesOf(SliceOrientation::Axial),
                                  axesOf(SliceOrientation::Coronal),
                                  axesOf(SliceOrientation::Sagittal)};
};

/// A plane given by its normal (not zero; patient LPS): the nearest standard slice, turned by the
/// smallest rotation. Throws InvalidParameter unless it is finite and longer than 0.
struct ObliquePlane
{
  SliceOrientation orientation;
  SliceAxes axes;
};
ObliquePlane planeWithNormal(const Eigen::Vector3d& normal);

/// Whether an image states where in the patient it lies: not if its file left a side open, if its
/// axes were corrected, or if its first voxel is in the middle of the scanner (x and y 0), where
/// exports without a header put it.
bool statesPlace(const scene::ImagePart& image);

/// The side that the case is described with; if none or both, left where the middle of its CT is
/// left of the midline (LPS x > 0), else right. Of a CT that does not state its place it is the
/// side on which it opens into air (volume::openSide), which loads it; nullopt if it does not: the
/// user has to say.
std::optional<scene::Side> earOf(const scene::Case& value);

} // namespace petrous::presenters
