#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Interaction/PickRay.h"
#include "petrous/Presenters/SliceGeometry.h"

namespace petrous::presenters
{

/// A box whose faces can be dragged.
struct HandledBox
{
  Eigen::AlignedBox3d box; ///< mm, along axes of its own
  /// To patient LPS mm; its axes are orthonormal, and may be left-handed.
  Eigen::Affine3d patientFromBox = Eigen::Affine3d::Identity();
};

/// Faces of a box, by its axes. Both faces of an axis: the box moves along it.
struct BoxFaces
{
  std::array<bool, 3> lower{}, upper{};
  bool any() const noexcept;
};

/// The box with its faces moved by `step`, all in its own coordinates. They stay within `bounds`
/// and `least` apart, as far as the bounds allow.
Eigen::AlignedBox3d moved(const Eigen::AlignedBox3d& box, const BoxFaces& faces,
                          const Eigen::Vector3d& step, const Eigen::AlignedBox3d& bounds,
                          const Eigen::Vector3d& least);

/// What a slice shows of a box: its section, or beside it the section of the box extended along
/// that axis which is closest to the slice's normal.
class BoxInSlice
{
public:
  BoxInSlice(const HandledBox& box, const SliceGeometry& slice);

  struct Edge
  {
    Eigen::Vector2d from, to; ///< pixels; an edge ends where the next one begins
    std::size_t axis = 0;     ///< of the face to which it belongs
    bool isUpper = false;
  };
  const std::vector<Edge>& edges() const noexcept { return m_edges; }
  bool isSection() const noexcept { return m_isSection; } ///< the slice cuts the box

  /// The faces within `reach` of a place, pixels: one at an edge, two at a corner.
  BoxFaces facesAt(const Eigen::Vector2d& pixel, double reach) const;
  bool contains(const Eigen::Vector2d& pixel) const;
  /// All faces of the axes along which the box moves within the slice.
  BoxFaces insideFaces() const noexcept;

private:
  std::vector<Edge> m_edges;
  std::size_t m_across = 0; ///< the axis closest to the slice's normal
  bool m_isSection = true;
};

/// The handle at the middle of a face.
struct FaceHandle
{
  std::size_t axis = 0;
  bool isUpper = false;
  Eigen::Vector3d at;     ///< patient LPS mm
  Eigen::Vector3d normal; ///< unit, outwards
};
std::array<FaceHandle, 6> faceHandles(const HandledBox& box);

/// How far along a line, mm from `point`, it comes closest to a ray; nullopt where the two are
/// within about 3 degrees of parallel. `direction`: unit.
std::optional<double> closestAlong(const Eigen::Vector3d& point, const Eigen::Vector3d& direction,
                                   const interaction::PickRay& ray);

/// The crop box of a view (ViewState::Clipping::crop) in mm along the axes of the image, which grow
/// to the left, the back and the head, as closely as those axes do: for an image along the
/// patient's axes, LPS mm. Faces lie at voxel centres.
class CropFrame
{
public:
  static constexpr double kMinWidth = 5.0; ///< mm, or the image's where that is less

  explicit CropFrame(const core::GridGeometry& grid);

  const Eigen::AlignedBox3d& bounds() const noexcept { return m_bounds; } ///< of the image
  const Eigen::Vector3d& least() const noexcept { return m_least; } ///< kMinWidth in whole voxels
  HandledBox box(const std::optional<core::IndexBox>& crop) const;
  /// The voxels of a box, its faces at the nearest ones; nullopt: all of the image.
  std::optional<core::IndexBox> crop(const Eigen::AlignedBox3d& box) const;
  /// After dragging from one patient point to another, LPS mm.
  std::optional<core::IndexBox> dragged(const std::optional<core::IndexBox>& crop,
                                        const BoxFaces& faces, const Eigen::Vector3d& from,
                                        const Eigen::Vector3d& to) const;

private:
  core::GridGeometry m_grid;
  Eigen::Affine3d m_patientFromBox;
  Eigen::AlignedBox3d m_bounds;
  Eigen::Vector3d m_least;
};

} // namespace petrous::presenters
