#include "petrous/Presenters/BoxHandles.h"

#include <algorithm>
#include <cmath>

namespace petrous::presenters
{

namespace
{

constexpr double kOnFace = 1e-6;   // mm, of a slice in a face
constexpr double kCrossing = 0.05; // sine of the angle from which on a ray crosses a line

// The corner of a polygon, and to which face the edge belongs that begins there.
struct Corner
{
  Eigen::Vector2d at;
  std::size_t axis;
  bool isUpper;
};

// What of a convex polygon lies where `height` is not negative (Sutherland and Hodgman).
template <class Height>
std::vector<Corner> clipped(const std::vector<Corner>& polygon, const Height& height,
                            std::size_t axis, bool isUpper)
{
  std::vector<Corner> left;
  for (std::size_t n = 0; n < polygon.size(); ++n)
  {
    const Corner& a = polygon[n];
    const Corner& b = polygon[(n + 1) % polygon.size()];
    const double from = height(a.at);
    const double to = height(b.at);
    const auto crossing = [&]() -> Eigen::Vector2d
    { return a.at + from / (from - to) * (b.at - a.at); };
    if (from >= 0.0)
    {
      left.push_back(a);
      if (to < 0.0)
        left.push_back({crossing(), axis, isUpper});
    }
    else if (to >= 0.0)
      left.push_back({crossing(), a.axis, a.isUpper});
  }
  return left;
}

double distanceToSegment(const Eigen::Vector2d& point, const Eigen::Vector2d& from,
                         const Eigen::Vector2d& to)
{
  const Eigen::Vector2d along = to - from;
  const double squared = along.squaredNorm();
  const double share =
      squared > 0.0 ? std::clamp(along.dot(point - from) / squared, 0.0, 1.0) : 0.0;
  return (from + share * along - point).norm();
}

} // namespace

bool BoxFaces::any() const noexcept
{
  const auto isSet = [](bool face) { return face; };
  return std::any_of(lower.begin(), lower.end(), isSet) ||
         std::any_of(upper.begin(), upper.end(), isSet);
}

Eigen::AlignedBox3d moved(const Eigen::AlignedBox3d& box, const BoxFaces& faces,
                          const Eigen::Vector3d& step, const Eigen::AlignedBox3d& bounds,
                          const Eigen::Vector3d& least)
{
  Eigen::AlignedBox3d result = box;
  for (std::size_t n = 0; n < 3; ++n)
  {
    const auto axis = static_cast<Eigen::Index>(n);
    const double first = bounds.min()[axis];
    const double last = bounds.max()[axis];
    double& lower = result.min()[axis];
    double& upper = result.max()[axis];
    if (faces.lower[n] && faces.upper[n])
    {
      const double by =
          std::clamp(step[axis], std::min(0.0, first - lower), std::max(0.0, last - upper));
      lower += by;
      upper += by;
    }
    else if (faces.lower[n])
      lower = std::max(first, std::min(lower + step[axis], upper - least[axis]));
    else if (faces.upper[n])
      upper = std::min(last, std::max(upper + step[axis], lower + least[axis]));
  }
  return result;
}

BoxInSlice::BoxInSlice(const HandledBox& box, const SliceGeometry& slice)
{
  const Eigen::Affine3d boxFromPatient = box.patientFromBox.inverse();
  const Eigen::Vector3d origin = boxFromPatient * slice.patientFromPixel(0.0, 0.0);
  const Eigen::Vector3d column = boxFromPatient * slice.patientFromPixel(1.0, 0.0) - origin;
  const Eigen::Vector3d row = boxFromPatient * slice.patientFromPixel(0.0, 1.0) - origin;
  Eigen::Index across = 0;
  (boxFromPatient.linear() * slice.axes().next).cwiseAbs().maxCoeff(&across);
  m_across = static_cast<std::size_t>(across);
  const Eigen::Index i = (across + 1) % 3;
  const Eigen::Index j = (across + 2) % 3;

  Eigen::Matrix2d fromPixel;
  fromPixel << column[i], row[i], column[j], row[j];
  const Eigen::Matrix2d toPixel = fromPixel.inverse();
  const Eigen::Vector3d& low = box.box.min();
  const Eigen::Vector3d& high = box.box.max();
  const auto corner = [&](double a, double b) -> Eigen::Vector2d
  { return toPixel * Eigen::Vector2d(a - origin[i], b - origin[j]); };
  const auto first = static_cast<std::size_t>(i);
  const auto second = static_cast<std::size_t>(j);
  const std::vector<Corner> whole{{corner(low[i], low[j]), second, false},
                                  {corner(high[i], low[j]), first, true},
                                  {corner(high[i], high[j]), second, true},
                                  {corner(low[i], high[j]), first, false}};

  const auto depth = [&](const Eigen::Vector2d& pixel)
  { return origin[across] + pixel[0] * column[across] + pixel[1] * row[across]; };
  std::vector<Corner> section = clipped(
      whole, [&](const Eigen::Vector2d& pixel) { return depth(pixel) - low[across] + kOnFace; },
      m_across, false);
  section = clipped(
      section, [&](const Eigen::Vector2d& pixel) { return high[across] + kOnFace - depth(pixel); },
      m_across, true);
  m_isSection = section.size() > 2;
  const std::vector<Corner>& shown = m_isSection ? section : whole;
  for (std::size_t n = 0; n < shown.size(); ++n)
    m_edges.push_back(
        {shown[n].at, shown[(n + 1) % shown.size()].at, shown[n].axis, shown[n].isUpper});
}

BoxFaces BoxInSlice::facesAt(const Eigen::Vector2d& pixel, double reach) const
{
  BoxFaces faces;
  std::array<double, 3> nearest{reach, reach, reach};
  for (const Edge& edge : m_edges)
  {
    const double away = distanceToSegment(pixel, edge.from, edge.to);
    if (away >= nearest[edge.axis])
      continue;
    nearest[edge.axis] = away;
    faces.lower[edge.axis] = !edge.isUpper;
    faces.upper[edge.axis] = edge.isUpper;
  }
  return faces;
}

bool BoxInSlice::contains(const Eigen::Vector2d& pixel) const
{
  bool isLeft = false;
  bool isRight = false;
  for (const Edge& edge : m_edges)
  {
    const Eigen::Vector2d along = edge.to - edge.from;
    const Eigen::Vector2d off = pixel - edge.from;
    const double side = along[0] * off[1] - along[1] * off[0];
    isLeft = isLeft || side > 0.0;
    isRight = isRight || side < 0.0;
  }
  return !(isLeft && isRight);
}

BoxFaces BoxInSlice::insideFaces() const noexcept
{
  BoxFaces faces;
  for (std::size_t axis = 0; axis < 3; ++axis)
    faces.lower[axis] = faces.upper[axis] = axis != m_across;
  return faces;
}

std::array<FaceHandle, 6> faceHandles(const HandledBox& box)
{
  std::array<FaceHandle, 6> handles;
  for (std::size_t n = 0; n < handles.size(); ++n)
  {
    FaceHandle& handle = handles[n];
    handle.axis = n / 2;
    handle.isUpper = n % 2 == 1;
    const auto axis = static_cast<Eigen::Index>(handle.axis);
    Eigen::Vector3d middle = box.box.center();
    middle[axis] = handle.isUpper ? box.box.max()[axis] : box.box.min()[axis];
    handle.at = box.patientFromBox * middle;
    handle.normal = (handle.isUpper ? 1.0 : -1.0) * box.patientFromBox.linear().col(axis);
  }
  return handles;
}

// The foot of the common perpendicular.
std::optional<double> closestAlong(const Eigen::Vector3d& point, const Eigen::Vector3d& direction,
                                   const interaction::PickRay& ray)
{
  const double cosine = direction.dot(ray.direction);
  const double squaredSine = 1.0 - cosine * cosine;
  if (!(squaredSine > kCrossing * kCrossing))
    return std::nullopt;
  const Eigen::Vector3d off = ray.origin - point;
  return (direction.dot(off) - cosine * ray.direction.dot(off)) / squaredSine;
}

CropFrame::CropFrame(const core::GridGeometry& grid)
  : m_grid(grid)
{
  // Of the image's axes, in one of six orders, those closest to the patient's.
  std::array<Eigen::Index, 3> order{0, 1, 2};
  std::array<Eigen::Index, 3> best = order;
  double most = -1.0;
  do
  {
    double along = 1.0;
    for (std::size_t n = 0; n < 3; ++n)
      along *= std::abs(grid.direction()(static_cast<Eigen::Index>(n), order[n]));
    if (along <= most)
      continue;
    most = along;
    best = order;
  } while (std::next_permutation(order.begin(), order.end()));

  m_patientFromBox = Eigen::Affine3d::Identity();
  for (std::size_t n = 0; n < 3; ++n)
  {
    const auto axis = static_cast<Eigen::Index>(n);
    const Eigen::Vector3d along = grid.direction().col(best[n]);
    m_patientFromBox.linear().col(axis) = along[axis] < 0.0 ? Eigen::Vector3d(-along) : along;
    const double spacing = grid.spacing()[best[n]];
    m_least[axis] = spacing * std::ceil(kMinWidth / spacing - 1e-9);
  }
  m_bounds = box(std::nullopt).box;
  m_least = m_least.cwiseMin(m_bounds.sizes());
}

HandledBox CropFrame::box(const std::optional<core::IndexBox>& crop) const
{
  const core::IndexBox whole = m_grid.fullBox();
  core::IndexBox shown = crop ? crop->intersected(whole) : whole;
  if (shown.empty())
    shown = whole; // as it is drawn
  const auto at = [this](int i, int j, int k) -> Eigen::Vector3d {
    return m_patientFromBox.linear().inverse() * m_grid.patientFromVoxel(Eigen::Vector3d(i, j, k));
  };
  HandledBox result;
  result.patientFromBox = m_patientFromBox;
  result.box.extend(at(shown.lower[0], shown.lower[1], shown.lower[2]));
  result.box.extend(at(shown.upper[0] - 1, shown.upper[1] - 1, shown.upper[2] - 1));
  return result;
}

std::optional<core::IndexBox> CropFrame::crop(const Eigen::AlignedBox3d& box) const
{
  const Eigen::Vector3d a = m_grid.voxelFromPatient(m_patientFromBox * box.min());
  const Eigen::Vector3d b = m_grid.voxelFromPatient(m_patientFromBox * box.max());
  core::IndexBox result;
  for (std::size_t n = 0; n < 3; ++n)
  {
    const auto axis = static_cast<Eigen::Index>(n);
    const double last = m_grid.dims()[n] - 1.0;
    const auto nearest = [last](double voxel)
    { return static_cast<int>(std::lround(std::clamp(voxel, 0.0, last))); };
    result.lower[n] = nearest(std::min(a[axis], b[axis]));
    result.upper[n] = nearest(std::max(a[axis], b[axis])) + 1;
  }
  return result == m_grid.fullBox() ? std::nullopt : std::optional(result);
}

std::optional<core::IndexBox> CropFrame::dragged(const std::optional<core::IndexBox>& crop,
                                                 const BoxFaces& faces, const Eigen::Vector3d& from,
                                                 const Eigen::Vector3d& to) const
{
  const Eigen::Vector3d step = m_patientFromBox.linear().inverse() * (to - from);
  return this->crop(moved(box(crop).box, faces, step, m_bounds, m_least));
}

} // namespace petrous::presenters
