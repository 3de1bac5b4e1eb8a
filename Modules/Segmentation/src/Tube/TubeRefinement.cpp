#include "TubeRefinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <tbb/parallel_for.h>

namespace petrous::segmentation
{
namespace
{

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr std::size_t kAngles = 24;
constexpr int kRounds = 6;
constexpr double kPi = 3.14159265358979323846;

/// Gaussian mean along the line with weights; `sigma` in vertices.
template <class T>
std::vector<T> smoothedAlong(const std::vector<T>& values, const std::vector<double>& weights,
                             double sigma, const T& zero)
{
  const auto n = static_cast<int>(values.size());
  const int reach = std::min(static_cast<int>(std::ceil(3.0 * sigma)), n - 1);
  std::vector<T> result(values.size(), zero);
  for (int i = 0; i < n; ++i)
  {
    T sum = zero;
    double total = 0.0;
    for (int j = std::max(i - reach, 0); j <= std::min(i + reach, n - 1); ++j)
    {
      const auto at = static_cast<std::size_t>(j);
      const double q = (j - i) / std::max(sigma, 1e-9);
      const double w = weights[at] * std::exp(-0.5 * q * q);
      sum = sum + w * values[at];
      total += w;
    }
    if (total > 1e-9)
      result[static_cast<std::size_t>(i)] = (1.0 / total) * sum;
  }
  return result;
}

/// Gaussian smoothing of the positions; both ends stay.
std::vector<Vector3d> smoothedLine(const std::vector<Vector3d>& line, double sigma)
{
  const auto n = static_cast<int>(line.size());
  const int reach = std::min(static_cast<int>(std::ceil(3.0 * sigma)), n - 1);
  const auto at = [&](int i) -> Vector3d
  {
    if (i < 0)
      return 2.0 * line.front() - line[static_cast<std::size_t>(-i)];
    if (i >= n)
      return 2.0 * line.back() - line[static_cast<std::size_t>(2 * n - 2 - i)];
    return line[static_cast<std::size_t>(i)];
  };
  std::vector<Vector3d> result(line.size());
  for (int i = 0; i < n; ++i)
  {
    Vector3d sum = Vector3d::Zero();
    double total = 0.0;
    for (int j = -reach; j <= reach; ++j)
    {
      const double w = std::exp(-0.5 * j * j / (sigma * sigma));
      sum += w * at(i + j);
      total += w;
    }
    result[static_cast<std::size_t>(i)] = sum / total;
  }
  return result;
}

/// Two directions across the line at each vertex, without twist.
struct Frame
{
  Vector3d u;
  Vector3d v;
};

std::vector<Frame> framesOf(const std::vector<Vector3d>& line)
{
  std::vector<Frame> frames(line.size());
  Vector3d u = Vector3d::Zero();
  for (std::size_t i = 0; i < line.size(); ++i)
  {
    const Vector3d t =
        (line[std::min(i + 1, line.size() - 1)] - line[i > 0 ? i - 1 : 0]).normalized();
    if (i == 0)
      u = t.unitOrthogonal();
    u = (u - u.dot(t) * t).eval();
    if (u.norm() < 1e-6)
      u = t.unitOrthogonal();
    u.normalize();
    frames[i] = {u, t.cross(u)};
  }
  return frames;
}

/// What the borders of one cross-section say.
struct Section
{
  double shiftU = 0.0;
  double shiftV = 0.0;
  double halfRadius = 0.0;
  double contrast = 0.0;
  double lumen = 0.0; ///< darker than the wall
  double closure = 0.0;
  double weight = 0.0; ///< of the shift
};

/// How the walls of a cross-section are sought. The centre needs the nearest wall, also a faint
/// one: beside a thin wall lies another cavity. The radius needs the walls' full height.
struct WallSearch
{
  double relativeReach; ///< beyond the expected border, in radii
  double blurredReach;  ///< the same, in voxels, or in 1.25 sigma of the blur; the larger counts
  double dip;           ///< relative fall behind a wall that ends the search
  double faint;         ///< relative height of a wall that is not trusted
  double firm;          ///< the same, of one that is trusted fully
};

constexpr WallSearch kForCentre{0.3, 0.8, 0.1, 0.15, 0.5};
constexpr WallSearch kForRadius{0.5, 2.0, 10.0, 0.4, 0.8};

struct ProfileGrid
{
  double step = 0.1; ///< mm along a ray
  std::size_t count = 0;
};

Section fitSection(const float* profiles, const ProfileGrid& grid, double expected,
                   double noiseLevel, bool isRadiusGiven, const WallSearch& search)
{
  Section section;
  section.halfRadius = expected;
  const auto value = [&](std::size_t angle, std::size_t k)
  { return static_cast<double>(profiles[angle * grid.count + k]); };
  const auto indexAt = [&](double rho)
  { return std::min(static_cast<std::size_t>(rho / grid.step), grid.count - 1); };

  double lumen = 0.0;
  const std::size_t core = indexAt(0.3 * expected);
  for (std::size_t a = 0; a < kAngles; ++a)
    for (std::size_t k = 0; k <= core; ++k)
      lumen += value(a, k);
  lumen /= static_cast<double>(kAngles * (core + 1));
  section.lumen = lumen;

  std::array<double, kAngles> wall{};
  std::array<std::size_t, kAngles> peak{};
  for (std::size_t a = 0; a < kAngles; ++a)
  {
    // the first wall: behind a thin one there may be another cavity, and the wall of that
    peak[a] = indexAt(0.6 * expected);
    for (std::size_t k = peak[a]; k < grid.count; ++k)
      if (value(a, k) > value(a, peak[a]))
        peak[a] = k;
      else if (value(a, k) <
               value(a, peak[a]) - search.dip * std::max(value(a, peak[a]) - lumen, 0.0))
        break;
    wall[a] = value(a, peak[a]);
  }
  std::array<double, kAngles> ordered = wall;
  std::nth_element(ordered.begin(), ordered.begin() + kAngles / 2, ordered.end());
  const double typical = ordered[kAngles / 2] - lumen;
  section.contrast = std::max(typical, 0.0);
  if (typical <= 0.0)
    return section;
  const auto quarter = ordered.begin() + kAngles / 4;
  std::nth_element(ordered.begin(), quarter, ordered.end());
  section.closure = std::max(*quarter - lumen, 0.0) / typical;

  // r + shift . (cos, sin) = distance of the border; least squares, outliers weigh less
  std::array<double, kAngles> border{};
  std::array<double, kAngles> trust{};
  for (std::size_t a = 0; a < kAngles; ++a)
  {
    const double height = wall[a] - lumen;
    trust[a] =
        std::clamp((height / typical - search.faint) / (search.firm - search.faint), 0.0, 1.0);
    if (trust[a] <= 0.0)
      continue;
    const double half = lumen + 0.5 * std::min(height, 1.5 * typical);
    std::size_t k = peak[a];
    while (k > 0 && value(a, k - 1) > half)
      --k;
    if (k == 0)
    {
      trust[a] = 0.0;
      continue;
    }
    const double low = value(a, k - 1);
    const double high = value(a, k);
    border[a] =
        grid.step * (static_cast<double>(k - 1) + (high > low ? (half - low) / (high - low) : 0.5));
  }
  Vector3d x(0.0, 0.0, expected);
  for (int round = 0; round < 4; ++round)
  {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Vector3d right = Vector3d::Zero();
    const double anchor = (isRadiusGiven ? 1.0 : 0.25) * static_cast<double>(kAngles);
    normal(2, 2) += anchor;
    right[2] += anchor * expected;
    normal(0, 0) += 0.5;
    normal(1, 1) += 0.5;
    for (std::size_t a = 0; a < kAngles; ++a)
    {
      if (trust[a] <= 0.0)
        continue;
      const double angle = 2.0 * kPi * static_cast<double>(a) / kAngles;
      const Vector3d row(std::cos(angle), std::sin(angle), 1.0);
      const double residual = std::abs(border[a] - row.dot(x));
      const double bound = 0.15 * expected;
      const double w = trust[a] * (residual <= bound ? 1.0 : bound / residual);
      normal += w * row * row.transpose();
      right += w * border[a] * row;
    }
    x = normal.ldlt().solve(right);
  }
  const double limit = 0.4 * expected;
  const double shift = std::hypot(x[0], x[1]);
  const double damping = shift > limit ? limit / shift : 1.0;
  section.shiftU = damping * x[0];
  section.shiftV = damping * x[1];
  section.halfRadius = std::clamp(x[2], 0.5 * expected, 1.6 * expected);
  section.weight = noiseLevel > 0.0 ? std::clamp(typical / noiseLevel - 0.7, 0.0, 1.0) : 1.0;
  return section;
}

} // namespace

std::vector<double> arcLengths(const std::vector<Vector3d>& line)
{
  std::vector<double> lengths(line.size(), 0.0);
  for (std::size_t i = 1; i < line.size(); ++i)
    lengths[i] = lengths[i - 1] + (line[i] - line[i - 1]).norm();
  return lengths;
}

std::vector<Vector3d> resampled(const std::vector<Vector3d>& line, double step)
{
  const std::vector<double> lengths = arcLengths(line);
  const double length = lengths.back();
  const auto pieces = std::max<std::size_t>(static_cast<std::size_t>(std::ceil(length / step)), 2);
  std::vector<Vector3d> result;
  std::size_t segment = 0;
  for (std::size_t i = 0; i < pieces; ++i)
  {
    const double s = length * static_cast<double>(i) / static_cast<double>(pieces);
    while (segment + 2 < line.size() && lengths[segment + 1] < s)
      ++segment;
    const double run = lengths[segment + 1] - lengths[segment];
    const double t = run > 0.0 ? std::clamp((s - lengths[segment]) / run, 0.0, 1.0) : 0.0;
    result.emplace_back(line[segment] + t * (line[segment + 1] - line[segment]));
  }
  result.push_back(line.back());
  return result;
}

CentreLine refineLine(const TubeImage& image, const std::vector<Vector3d>& path,
                      const TubeModel& model, double halfRadius, double blur, bool isRadiusGiven,
                      const std::vector<Vector3d>& held, const core::Progress& progress)
{
  const double voxel = image.geometry().spacing().maxCoeff();
  const double spacing = std::clamp(0.25 * model.radius, 0.1, 1.0);
  const float sign = model.isBright ? -1.0F : 1.0F;
  const Eigen::Matrix3d& toVoxel = image.geometry().voxelFromPatientLinear();
  CentreLine result;
  std::vector<Vector3d>& line = result.vertices;
  line = resampled(path, spacing);
  line = smoothedLine(line, std::max(0.45 * model.radius, 0.15) / spacing);
  double typicalRadius = halfRadius;
  std::vector<double> radii(line.size(), halfRadius);
  for (int round = 0; round < kRounds; ++round)
  {
    progress.check("trace tube");
    const std::size_t n = line.size();
    if (radii.size() != n) // resampled since: the number changes by a few at most
      radii.assign(n, typicalRadius);
    const std::vector<Frame> frames =
        framesOf(smoothedLine(line, std::max(0.5 * model.radius, 0.25) / spacing));
    const double largest = *std::max_element(radii.begin(), radii.end());
    ProfileGrid grid;
    grid.step = std::min(0.15 * typicalRadius, 0.4 * voxel);
    const WallSearch& search = round + 1 < kRounds ? kForCentre : kForRadius;
    const double reach = largest + std::max(search.relativeReach * largest,
                                            search.blurredReach * std::max(voxel, 1.25 * blur));
    grid.count = static_cast<std::size_t>(std::ceil(reach / grid.step)) + 1;
    const std::size_t size = kAngles * grid.count;
    std::vector<float> raw(n * size);
    tbb::parallel_for(std::size_t{0}, n,
                      [&](std::size_t i)
                      {
                        float* to = raw.data() + i * size;
                        const Vector3f center = image.voxelOf(line[i]);
                        for (std::size_t a = 0; a < kAngles; ++a)
                        {
                          const double angle = 2.0 * kPi * static_cast<double>(a) / kAngles;
                          const Vector3f ray =
                              (grid.step * (toVoxel * (std::cos(angle) * frames[i].u +
                                                       std::sin(angle) * frames[i].v)))
                                  .cast<float>();
                          for (std::size_t k = 0; k < grid.count; ++k)
                            *to++ = sign * image.sample(center + static_cast<float>(k) * ray);
                        }
                      });
    // the borders are sought in profiles averaged along the tube
    const double sigma = std::max(0.5 * typicalRadius, 0.35) / spacing;
    const int window = std::min(static_cast<int>(std::ceil(2.5 * sigma)), static_cast<int>(n) - 1);
    std::vector<Section> sections(n);
    tbb::parallel_for(std::size_t{0}, n,
                      [&](std::size_t i)
                      {
                        std::vector<float> mean(size, 0.0F);
                        float total = 0.0F;
                        const auto here = static_cast<int>(i);
                        for (int j = std::max(here - window, 0);
                             j <= std::min(here + window, static_cast<int>(n) - 1); ++j)
                        {
                          const double q = (j - here) / sigma;
                          const auto w = static_cast<float>(std::exp(-0.5 * q * q));
                          const float* from = raw.data() + static_cast<std::size_t>(j) * size;
                          for (std::size_t k = 0; k < size; ++k)
                            mean[k] += w * from[k];
                          total += w;
                        }
                        for (float& m : mean)
                          m /= total;
                        sections[i] = fitSection(mean.data(), grid, radii[i], image.noise(),
                                                 isRadiusGiven, search);
                      });
    std::vector<double> weights(n);
    std::vector<Vector3d> shifts(n);
    std::vector<double> found(n);
    result.contrast.resize(n);
    result.lumen.resize(n);
    result.closure.resize(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      weights[i] = std::max(sections[i].weight, 1e-3);
      shifts[i] = sections[i].weight *
                  (sections[i].shiftU * frames[i].u + sections[i].shiftV * frames[i].v);
      found[i] = sections[i].halfRadius;
      result.contrast[i] = sections[i].contrast;
      result.lumen[i] = static_cast<double>(sign) * sections[i].lumen;
      result.closure[i] = sections[i].closure;
    }
    radii = smoothedAlong(found, weights, std::max(typicalRadius, 0.5) / spacing, 0.0);
    std::vector<double> ordered = radii;
    std::nth_element(ordered.begin(), ordered.begin() + static_cast<std::ptrdiff_t>(n / 2),
                     ordered.end());
    typicalRadius = ordered[n / 2];
    if (round + 1 == kRounds)
      break;
    const std::vector<Vector3d> smooth =
        smoothedAlong(shifts, std::vector<double>(n, 1.0),
                      std::max(0.25 * typicalRadius, 0.15) / spacing, Vector3d(Vector3d::Zero()));
    for (std::size_t i = 0; i < n; ++i)
      line[i] += smooth[i];
    for (const Vector3d& point : held)
    {
      std::size_t nearest = 0;
      for (std::size_t i = 1; i < n; ++i)
        if ((line[i] - point).squaredNorm() < (line[nearest] - point).squaredNorm())
          nearest = i;
      const Vector3d pull = point - line[nearest];
      for (std::size_t i = 0; i < n; ++i)
      {
        const double s = (static_cast<double>(i) - static_cast<double>(nearest)) * spacing;
        line[i] += std::exp(-0.5 * s * s) * pull;
      }
    }
    // even spacing again, with as many vertices
    const std::vector<double> lengths = arcLengths(line);
    line = resampled(line, lengths.back() / (static_cast<double>(n) - 1.0) * (1.0 + 1e-9));
  }
  result.halfRadius = radii;
  return result;
}

double halfMaximumRadius(double radius, double sigma)
{
  if (sigma <= 0.02 * radius)
    return radius;
  // in units of sigma; the integrand as exp(-(rho - t)^2 / 2) times the scaled Bessel function
  const double edge = radius / sigma;
  const auto scaledBessel = [](double x) // exp(-x) I0(x), Abramowitz and Stegun 9.8.1 and 9.8.2
  {
    if (x < 3.75)
    {
      const double t = x * x / (3.75 * 3.75);
      return std::exp(-x) *
             (1.0 +
              t * (3.5156229 +
                   t * (3.0899424 +
                        t * (1.2067492 + t * (0.2659732 + t * (0.0360768 + t * 0.0045813))))));
    }
    const double t = 3.75 / x;
    return (0.39894228 +
            t * (0.01328592 +
                 t * (0.00225319 +
                      t * (-0.00157565 +
                           t * (0.00916281 +
                                t * (-0.02057706 +
                                     t * (0.02635537 + t * (-0.01647633 + t * 0.00392377)))))))) /
           std::sqrt(x);
  };
  const auto profile = [&](double rho)
  {
    const double from = std::max(rho - 8.0, 0.0);
    const double to = std::min(edge, rho + 8.0);
    if (to <= from)
      return 0.0;
    const int pieces = 200; // Simpson
    const double h = (to - from) / pieces;
    double sum = 0.0;
    for (int i = 0; i <= pieces; ++i)
    {
      const double t = from + h * i;
      const double f = t * std::exp(-0.5 * (rho - t) * (rho - t)) * scaledBessel(rho * t);
      sum += f * (i == 0 || i == pieces ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0));
    }
    return sum * h / 3.0;
  };
  const double half = 0.5 * profile(0.0);
  double low = 0.0;
  double high = edge + 2.0;
  for (int i = 0; i < 40; ++i)
  {
    const double middle = 0.5 * (low + high);
    (profile(middle) > half ? low : high) = middle;
  }
  return sigma * 0.5 * (low + high);
}

std::vector<double> radiiFromHalfMaximum(const std::vector<double>& halfRadii, double sigma)
{
  if (sigma <= 0.0 || halfRadii.empty())
    return halfRadii;
  // wide tubes look narrower than they are by sigma^2 / (2 R), thin ones wider
  const double widest = *std::max_element(halfRadii.begin(), halfRadii.end()) + sigma;
  const double thinnest = 0.05 * sigma;
  constexpr std::size_t kEntries = 48;
  std::array<double, kEntries> radius{};
  std::array<double, kEntries> half{};
  const double ratio = std::pow(widest / thinnest, 1.0 / (kEntries - 1));
  for (std::size_t i = 0; i < kEntries; ++i)
  {
    radius[i] = i == 0 ? thinnest : radius[i - 1] * ratio;
    half[i] = halfMaximumRadius(radius[i], sigma);
  }
  std::vector<double> result;
  for (const double h : halfRadii)
  {
    const auto above = std::upper_bound(half.begin(), half.end(), h);
    const auto i = static_cast<std::size_t>(above - half.begin());
    if (i == 0)
      result.push_back(0.0);
    else if (i == kEntries)
      result.push_back(radius.back());
    else
      result.push_back(radius[i - 1] +
                       (radius[i] - radius[i - 1]) * (h - half[i - 1]) / (half[i] - half[i - 1]));
  }
  return result;
}

} // namespace petrous::segmentation
