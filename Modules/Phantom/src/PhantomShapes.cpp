#include "PhantomShapes.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "petrous/Core/SplitMix64.h"

namespace petrous::phantom::shapes
{
namespace
{

double square(double x)
{
  return x * x;
}

/// A segment of a tube, prepared for evaluation.
struct Piece
{
  Point start;
  Eigen::Vector3d along;
  double inverseLength2;
  double radius;
  double widening;

  Piece(const Knot& a, const Knot& b)
    : start(a.center)
    , along(b.center - a.center)
    , inverseLength2(along.squaredNorm() > 0.0 ? 1.0 / along.squaredNorm() : 0.0)
    , radius(a.radius)
    , widening(b.radius - a.radius)
  {
  }

  double distance(const Point& p) const
  {
    const Eigen::Vector3d q = p - start;
    const double t = std::clamp(q.dot(along) * inverseLength2, 0.0, 1.0);
    return (q - t * along).norm() - (radius + t * widening);
  }
};

/// A run of tube segments with a bounding sphere, so that distant runs are skipped.
struct Run
{
  std::size_t first;
  std::size_t last;
  Point center;
  double reach;
};

} // namespace

Box everywhere()
{
  return {Point::Constant(-1e6), Point::Constant(1e6)};
}

Shape sphere(const Point& center, double radius)
{
  return {[=](const Point& p) { return (p - center).norm() - radius; },
          Box(center.array() - radius, center.array() + radius)};
}

Shape ellipsoid(const Point& center, const Eigen::Vector3d& radii, const Eigen::Matrix3d& axes)
{
  const double smallest = radii.minCoeff();
  const Eigen::Vector3d half = (axes.cwiseAbs2() * radii.cwiseAbs2()).cwiseSqrt();
  return {[=](const Point& p)
          {
            const Eigen::Vector3d q = (axes.transpose() * (p - center)).cwiseQuotient(radii);
            const double k0 = q.norm();
            const double k1 = q.cwiseQuotient(radii).norm();
            if (k1 < 1e-12)
              return -smallest;
            const double first = k0 * (k0 - 1.0) / k1;
            // deep inside, the first-order value overestimates the depth
            return k0 < 1.0 ? std::max(first, 2.0 * smallest * (k0 - 1.0)) : first;
          },
          Box(center - half, center + half)};
}

Shape capsule(const Knot& a, const Knot& b)
{
  return tube({a, b});
}

Shape tube(const std::vector<Knot>& knots)
{
  constexpr std::size_t kRun = 8;
  std::vector<Run> runs;
  Box box;
  for (const Knot& knot : knots)
  {
    box.extend(Point(knot.center.array() - knot.radius));
    box.extend(Point(knot.center.array() + knot.radius));
  }
  for (std::size_t first = 0; first + 1 < knots.size(); first += kRun)
  {
    Run run{first, std::min(first + kRun, knots.size() - 1), Point::Zero(), 0.0};
    run.center = 0.5 * (knots[run.first].center + knots[run.last].center);
    for (std::size_t i = run.first; i <= run.last; ++i)
      run.reach = std::max(run.reach, (knots[i].center - run.center).norm() + knots[i].radius);
    runs.push_back(run);
  }
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i)
    pieces.emplace_back(knots[i], knots[i + 1]);
  return {[pieces, runs](const Point& p)
          {
            // the run that seems nearest first: it rules out most others
            std::size_t near = 0;
            double least = std::numeric_limits<double>::max();
            for (std::size_t r = 0; r < runs.size(); ++r)
            {
              const double away = (p - runs[r].center).squaredNorm();
              if (away < least)
              {
                least = away;
                near = r;
              }
            }
            double best = std::numeric_limits<double>::max();
            const auto ask = [&](const Run& run)
            {
              for (std::size_t i = run.first; i < run.last; ++i)
                best = std::min(best, pieces[i].distance(p));
            };
            ask(runs[near]);
            for (std::size_t r = 0; r < runs.size(); ++r)
            {
              const double within = std::max(runs[r].reach + best, 0.0);
              if (r != near && (p - runs[r].center).squaredNorm() < within * within)
                ask(runs[r]);
            }
            return best;
          },
          box};
}

std::vector<Knot> spline(const std::vector<Knot>& knots, double step)
{
  std::vector<Knot> result;
  const auto last = static_cast<int>(knots.size()) - 1;
  const auto knot = [&](int i) { return knots[static_cast<std::size_t>(std::clamp(i, 0, last))]; };
  for (int i = 0; i < last; ++i)
  {
    const Knot a = knot(i - 1);
    const Knot b = knot(i);
    const Knot c = knot(i + 1);
    const Knot d = knot(i + 2);
    const double stride = step * std::max(1.0, b.radius / 1.5); // wide tubes have low curvature
    const int pieces =
        std::max(1, static_cast<int>(std::lround((c.center - b.center).norm() / stride)));
    for (int s = 0; s < pieces; ++s)
    {
      const double t = static_cast<double>(s) / pieces;
      const auto curve = [t](const auto& w, const auto& x, const auto& y, const auto& z)
      {
        return 0.5 * (2.0 * x + t * (y - w) + t * t * (2.0 * w - 5.0 * x + 4.0 * y - z) +
                      t * t * t * (3.0 * x - w - 3.0 * y + z));
      };
      result.push_back(
          {curve(a.center, b.center, c.center, d.center), b.radius + t * (c.radius - b.radius)});
    }
  }
  result.push_back(knots.back());
  return result;
}

Shape torus(const Point& center, const Eigen::Vector3d& axis, double ring, double radius)
{
  const double reach = ring + radius;
  return {[=](const Point& p)
          {
            const Eigen::Vector3d q = p - center;
            const double height = q.dot(axis);
            return std::hypot((q - height * axis).norm() - ring, height) - radius;
          },
          Box(center.array() - reach, center.array() + reach)};
}

Shape disc(const Point& center, const Eigen::Vector3d& u, const Eigen::Vector3d& v, double halfU,
           double halfV, double halfThickness)
{
  const Eigen::Vector3d w = u.cross(v);
  const Eigen::Vector3d half =
      halfU * u.cwiseAbs() + halfV * v.cwiseAbs() + halfThickness * w.cwiseAbs();
  return {[=](const Point& p)
          {
            const Eigen::Vector3d q = p - center;
            const Eigen::Vector2d e(q.dot(u) / halfU, q.dot(v) / halfV);
            const double k0 = e.norm();
            const double k1 = Eigen::Vector2d(e.x() / halfU, e.y() / halfV).norm();
            const double flat = k1 < 1e-12 ? -std::min(halfU, halfV) : k0 * (k0 - 1.0) / k1;
            const double high = std::abs(q.dot(w)) - halfThickness;
            return std::min(std::max(flat, high), 0.0) +
                   std::hypot(std::max(flat, 0.0), std::max(high, 0.0));
          },
          Box(center - half, center + half)};
}

Shape halfSpace(const Eigen::Vector3d& normal, double offset)
{
  return {[=](const Point& p) { return normal.dot(p) - offset; }, everywhere()};
}

Shape merge(std::vector<Shape> parts)
{
  Box box;
  for (const Shape& part : parts)
    box.extend(part.box);
  return {[parts = std::move(parts)](const Point& p)
          {
            double best = std::numeric_limits<double>::max();
            for (const Shape& part : parts)
              if (best > 1e100 ||
                  part.box.squaredExteriorDistance(p) < square(std::max(best, 0.0)) ||
                  part.box.contains(p))
                best = std::min(best, part(p));
            return best;
          },
          box};
}

Shape common(std::vector<Shape> parts)
{
  Box box = everywhere();
  for (const Shape& part : parts)
    box = box.intersection(part.box);
  return {[parts = std::move(parts)](const Point& p)
          {
            double worst = std::numeric_limits<double>::lowest();
            for (const Shape& part : parts)
              worst = std::max(worst, part(p));
            return worst;
          },
          box};
}

Shape without(const Shape& a, const Shape& b)
{
  return {[a, b](const Point& p) { return std::max(a(p), -b(p)); }, a.box};
}

Shape complement(const Shape& a)
{
  return {[a](const Point& p) { return -a(p); }, everywhere()};
}

Shape grown(const Shape& a, double by)
{
  Box box = a.box;
  box.min().array() -= std::max(by, 0.0);
  box.max().array() += std::max(by, 0.0);
  return {[a, by](const Point& p) { return a(p) - by; }, box};
}

double smoothMin(double a, double b, double k)
{
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - 0.25 * h * h * k;
}

Shape blend(std::vector<Shape> parts, double k)
{
  Box box;
  for (const Shape& part : parts)
    box.extend(part.box);
  box.min().array() -= k;
  box.max().array() += k;
  return {[parts = std::move(parts), k](const Point& p)
          {
            double value = parts.front()(p);
            for (std::size_t i = 1; i < parts.size(); ++i)
            {
              // a part has no effect farther than value + k beyond its box
              const double beyond = std::max(value, 0.0) + k;
              if (parts[i].box.squaredExteriorDistance(p) < beyond * beyond)
                value = smoothMin(value, parts[i](p), k);
            }
            return value;
          },
          box};
}

Shape blendCommon(const Shape& a, const Shape& b, double k)
{
  return {[a, b, k](const Point& p) { return -smoothMin(-a(p), -b(p), k); },
          a.box.intersection(b.box)};
}

double uniform(std::uint64_t seed, std::uint64_t counter) noexcept
{
  return static_cast<double>(core::splitMix64(core::splitMix64(seed) ^ counter) >> 11) * 0x1.0p-53;
}

Shape remembered(const Shape& a)
{
  constexpr std::size_t kSlots = 64;
  struct Last
  {
    std::uint64_t id = 0;
    Point point = Point::Zero();
    double value = 0.0;
  };
  static std::atomic<std::uint64_t> count{0};
  const std::uint64_t id = ++count; // never reused: a slot of another phantom cannot match
  return {[distance = a.distance, id](const Point& p)
          {
            thread_local std::array<Last, kSlots> memory;
            Last& last = memory[id % kSlots];
            if (last.id != id || last.point != p)
              last = {id, p, distance(p)};
            return last.value;
          },
          a.box};
}

double mottling(const Point& p) noexcept
{
  constexpr double kGrain = 1.2;    // mm between the lattice's random values
  constexpr double kContrast = 3.0; // restores deviation 1 after trilinear interpolation
  std::array<std::int64_t, 3> cell{};
  Eigen::Vector3d part;
  for (int a = 0; a < 3; ++a)
  {
    const double x = p[a] / kGrain;
    const double low = std::floor(x);
    cell[static_cast<std::size_t>(a)] = static_cast<std::int64_t>(low);
    part[a] = x - low;
  }
  double value = 0.0;
  for (int c = 0; c < 8; ++c)
  {
    std::uint64_t key = 0;
    double weight = 1.0;
    for (int a = 0; a < 3; ++a)
    {
      const int bit = (c >> a) & 1;
      key = key * 0x100000001B3ULL +
            static_cast<std::uint64_t>(cell[static_cast<std::size_t>(a)] + bit);
      weight *= bit ? part[a] : 1.0 - part[a];
    }
    value += weight * (static_cast<double>(core::splitMix64(key) >> 11) * 0x1.0p-53 - 0.5);
  }
  return 2.0 * kContrast * value;
}

} // namespace petrous::phantom::shapes
