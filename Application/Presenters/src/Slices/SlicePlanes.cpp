#include "petrous/Presenters/SlicePlanes.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <Eigen/Geometry>

#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/TissueExtent.h"

namespace petrous::presenters
{

namespace
{

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kSame = 1e-6;       // of unit vectors
constexpr double kStaysAcross = 0.5; // cosine of the angle between a tool and the slice across it
constexpr SliceOrientation kSlices[] = {SliceOrientation::Axial, SliceOrientation::Coronal,
                                        SliceOrientation::Sagittal};
constexpr const char* kPetrous = "petrous";
constexpr const char* kFree = "free";
constexpr const char* kTool[] = {"tool-axial", "tool-coronal", "tool-sagittal"}; // across it

SliceAxes rotated(const SliceAxes& axes, const Eigen::Matrix3d& rotation)
{
  return {(rotation * axes.right).normalized(), (rotation * axes.down).normalized(),
          (rotation * axes.next).normalized()};
}

// Whichever way, the plane is the same.
double along(const Eigen::Vector3d& unit, SliceOrientation slice)
{
  return std::abs(unit.dot(axesOf(slice).next));
}

SliceOrientation nearest(const Eigen::Vector3d& unit)
{
  SliceOrientation best = SliceOrientation::Axial;
  for (const SliceOrientation slice : kSlices)
    if (along(unit, slice) > along(unit, best))
      best = slice;
  return best;
}

// The smallest rotation of a slice's normal onto the axis, or against it.
Eigen::Matrix3d onto(const Eigen::Vector3d& unit, SliceOrientation slice)
{
  const Eigen::Vector3d next = axesOf(slice).next;
  return Eigen::Quaterniond::FromTwoVectors(next,
                                            unit.dot(next) < 0.0 ? Eigen::Vector3d(-unit) : unit)
      .toRotationMatrix();
}

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b)) / kDegree;
}

} // namespace

SlicePlanes SlicePlanes::petrous(scene::Side side)
{
  SlicePlanes planes;
  planes.m_kind = Kind::Petrous;
  const double degrees = side == scene::Side::Left ? 45.0 : -45.0;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(degrees * kDegree, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  planes.turn(SliceOrientation::Coronal, turn);
  planes.turn(SliceOrientation::Sagittal, turn);
  return planes;
}

SlicePlanes SlicePlanes::alongTool(const Eigen::Vector3d& axis, const SlicePlanes& before)
{
  if (!axis.allFinite() || axis.norm() < kSame)
    return before;
  const Eigen::Vector3d unit = axis.normalized();
  SliceOrientation across = nearest(unit);
  if (before.m_kind == Kind::Tool)
    across = along(unit, before.m_across) > kStaysAcross ? before.m_across : across;
  SlicePlanes planes;
  planes.m_kind = Kind::Tool;
  planes.m_across = across;
  const Eigen::Matrix3d rotation = onto(unit, across);
  for (const SliceOrientation slice : kSlices)
    planes.turn(slice, rotation);
  return planes;
}

SlicePlanes SlicePlanes::from(const scene::ViewState::Slices& slices)
{
  SlicePlanes planes;
  if (!slices.turned)
    return planes;
  for (std::size_t n = 0; n < std::size(kSlices); ++n)
  {
    const auto& saved = slices.turned->planes[n];
    const SliceAxes usual = axesOf(kSlices[n]);
    // Left-handed where the standard slice is.
    const double hand = usual.right.cross(usual.down).dot(usual.next);
    planes.m_axes[n] = {saved.right.normalized(), saved.down.normalized(),
                        hand * saved.right.cross(saved.down).normalized()};
  }
  planes.m_kind = slices.turned->kind == kPetrous ? Kind::Petrous : Kind::Free;
  for (std::size_t n = 0; n < std::size(kTool); ++n)
    if (slices.turned->kind == kTool[n])
    {
      planes.m_kind = Kind::Tool;
      planes.m_across = kSlices[n];
    }
  return planes;
}

void SlicePlanes::store(scene::ViewState::Slices& slices) const
{
  slices.turned.reset();
  if (isStandard())
    return;
  slices.turned.emplace();
  slices.turned->kind = m_kind == Kind::Petrous ? kPetrous
                        : m_kind == Kind::Tool  ? kTool[static_cast<std::size_t>(m_across)]
                                                : kFree;
  for (std::size_t n = 0; n < m_axes.size(); ++n)
    slices.turned->planes[n] = {m_axes[n].right, m_axes[n].down};
}

bool SlicePlanes::isTurned(SliceOrientation slice) const
{
  const SliceAxes usual = axesOf(slice);
  return (axes(slice).right - usual.right).norm() + (axes(slice).down - usual.down).norm() > kSame;
}

std::string SlicePlanes::name(SliceOrientation slice) const
{
  const std::string usual = nameOf(slice);
  switch (m_kind)
  {
  case Kind::Standard:
    return usual;
  case Kind::Petrous:
    return slice == SliceOrientation::Coronal    ? "Stenvers"
           : slice == SliceOrientation::Sagittal ? "P\xc3\xb6schl"
                                                 : usual;
  case Kind::Tool:
    return slice == m_across ? "Across the tool" : "Along the tool";
  case Kind::Free:
    break;
  }
  if (!isTurned(slice))
    return usual;
  const double degrees = std::max(angleBetween(axesOf(slice).next, axes(slice).next),
                                  angleBetween(axesOf(slice).right, axes(slice).right));
  return usual + ", turned " + core::fixedText(degrees, 0) + "\xc2\xb0";
}

void SlicePlanes::turn(SliceOrientation slice, const Eigen::Matrix3d& rotation)
{
  SliceAxes& axes = m_axes[static_cast<std::size_t>(slice)];
  axes = rotated(axes, rotation);
}

void SlicePlanes::turnOthers(SliceOrientation slice, double degrees)
{
  // Clockwise in the picture takes right to down.
  const SliceAxes fixed = axes(slice);
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(degrees * kDegree, fixed.right.cross(fixed.down)).toRotationMatrix();
  for (const SliceOrientation other : kSlices)
    if (other != slice)
      turn(other, rotation);
  m_kind = Kind::Free;
}

void SlicePlanes::tilt(SliceOrientation slice, double right, double down)
{
  const SliceAxes from = axes(slice);
  const Eigen::Matrix3d rotation = (Eigen::AngleAxisd(right * kDegree, from.down) *
                                    Eigen::AngleAxisd(-down * kDegree, from.right))
                                       .toRotationMatrix();
  for (const SliceOrientation one : kSlices)
    turn(one, rotation);
  m_kind = Kind::Free;
}

ObliquePlane planeWithNormal(const Eigen::Vector3d& normal)
{
  if (!normal.allFinite() || !(normal.norm() > 0.0))
    throw core::InvalidParameter("plane: the normal must be finite and longer than 0");
  const Eigen::Vector3d unit = normal.stableNormalized();
  const SliceOrientation slice = nearest(unit);
  return {slice, rotated(axesOf(slice), onto(unit, slice))};
}

bool statesPlace(const scene::ImagePart& image)
{
  const Eigen::Vector3d& origin = image.geometry.origin();
  return (origin.x() != 0.0 || origin.y() != 0.0) && !image.provenance.assumedRas &&
         image.provenance.axes.isIdentity();
}

std::optional<scene::Side> earOf(const scene::Case& value)
{
  constexpr double kAir = -500.0; // HU
  const scene::Side side = value.description.side;
  if (side == scene::Side::Left || side == scene::Side::Right)
    return side;
  if (statesPlace(value.ct))
    return value.ct.geometry.center().x() > 0.0 ? scene::Side::Left : scene::Side::Right;
  const auto image = value.ct.volume.get();
  const double air =
      calibratedScale(value).calibrated ? kAir : 0.5 * (value.ct.range.min + value.iso);
  const int open = image ? volume::openSide(*image, air) : 0;
  if (open == 0)
    return std::nullopt;
  return open > 0 ? scene::Side::Left : scene::Side::Right;
}

} // namespace petrous::presenters
