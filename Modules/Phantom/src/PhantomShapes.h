#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Geometry>

/// Signed distances (mm; negative inside) to implicit shapes in patient LPS, and their combination.
/// Each is close to the true distance near its surface, with a gradient of at most about 1 outside
/// and 2 inside, so that blocks of space can be skipped by the value at their centre.
namespace petrous::phantom::shapes
{

using Point = Eigen::Vector3d;
using Box = Eigen::AlignedBox3d;

struct Shape
{
  std::function<double(const Point&)> distance;
  Box box; ///< contains {distance <= 0}

  double operator()(const Point& p) const { return distance(p); }
};

/// A point of a tube's centre line and the tube's radius there, mm.
struct Knot
{
  Point center;
  double radius;
};

Box everywhere();

Shape sphere(const Point& center, double radius);

/// Half axes along the columns of `axes`. First-order distance (exact on the surface).
Shape ellipsoid(const Point& center, const Eigen::Vector3d& radii,
                const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity());

/// A cone with rounded ends.
Shape capsule(const Knot& a, const Knot& b);

/// Round tube along a polyline with rounded ends, radius linear along each segment.
Shape tube(const std::vector<Knot>& knots);

/// Catmull-Rom curve through the knots, sampled about every `step` mm (coarser where it is wide).
std::vector<Knot> spline(const std::vector<Knot>& knots, double step = 0.3);

/// Full torus; the axis is a unit vector.
Shape torus(const Point& center, const Eigen::Vector3d& axis, double ring, double radius);

/// Elliptic disc with rounded rim: half axes along u and v (unit, perpendicular), half thickness.
Shape disc(const Point& center, const Eigen::Vector3d& u, const Eigen::Vector3d& v, double halfU,
           double halfV, double halfThickness);

/// {normal . p < offset}; the normal is a unit vector.
Shape halfSpace(const Eigen::Vector3d& normal, double offset);

Shape merge(std::vector<Shape> parts);
Shape common(std::vector<Shape> parts);
Shape without(const Shape& a, const Shape& b);
Shape complement(const Shape& a);
Shape grown(const Shape& a, double by); ///< shrunk if `by` is negative

/// Union and intersection whose crease is rounded over about `k` mm.
Shape blend(std::vector<Shape> parts, double k);
Shape blendCommon(const Shape& a, const Shape& b, double k);
double smoothMin(double a, double b, double k);

/// Uniform in [0, 1) from a seed and a counter.
double uniform(std::uint64_t seed, std::uint64_t counter) noexcept;

/// The same shape, caching its last value per thread: for a shape shared by several layers that
/// evaluate the same point in turn.
Shape remembered(const Shape& a);

/// Smooth noise of mean 0 and standard deviation about 1, grain about 1.2 mm: trabecular bone.
double mottling(const Point& p) noexcept;

} // namespace petrous::phantom::shapes
