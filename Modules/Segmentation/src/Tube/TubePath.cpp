#include "TubePath.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <queue>
#include <utility>

#include <Eigen/Eigenvalues>
#include <tbb/parallel_for.h>

#include "petrous/Core/Error.h"

namespace petrous::segmentation
{
namespace
{

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Radii that are tried where none is given, mm.
constexpr double kRadiusLadder[] = {0.25, 0.4, 0.6, 0.9, 1.3, 1.9, 2.8, 4.0, 6.0};

/// One of each pair of opposite directions: the vertices of an icosahedron and the middles of its
/// edges.
std::vector<Vector3d> sphereAxes()
{
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Vector3d> corners;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-golden, golden})
    {
      corners.emplace_back(0.0, a, b);
      corners.emplace_back(a, b, 0.0);
      corners.emplace_back(b, 0.0, a);
    }
  std::vector<Vector3d> all = corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = i + 1; j < corners.size(); ++j)
      if ((corners[i] - corners[j]).norm() < 2.1) // an edge is 2 long
        all.push_back(corners[i] + corners[j]);
  std::vector<Vector3d> axes;
  for (const Vector3d& v : all)
  {
    const Vector3d n = v.normalized();
    if (std::none_of(axes.begin(), axes.end(),
                     [&](const Vector3d& other) { return (n + other).norm() < 1e-6; }))
      axes.push_back(n);
  }
  return axes;
}

/// Rounded to a geometric ladder of steps of about a fifth.
double rounded(double value)
{
  return std::exp2(std::round(4.0 * std::log2(value)) / 4.0);
}

/// Positions within `reach` of a centre, on a lattice, nearest first.
std::vector<Vector3d> ball(double reach, double step)
{
  std::vector<Vector3d> offsets;
  const int n = static_cast<int>(std::ceil(reach / step));
  for (int k = -n; k <= n; ++k)
    for (int j = -n; j <= n; ++j)
      for (int i = -n; i <= n; ++i)
      {
        const Vector3d offset = step * Vector3d(i, j, k);
        if (offset.norm() <= reach + 1e-9)
          offsets.push_back(offset);
      }
  std::stable_sort(offsets.begin(), offsets.end(),
                   [](const Vector3d& a, const Vector3d& b)
                   { return a.squaredNorm() < b.squaredNorm(); });
  return offsets;
}

/// Blocks of about `size` voxels, first and end, of which each has neighbours along this axis;
/// `each`: only every so many. An odd number of them, symmetric about the middle one.
std::vector<std::pair<int, int>> symmetricBlocks(int dim, double size, int each)
{
  const int inner = dim - 2;
  const int half = static_cast<int>(std::floor(0.5 * inner / size)); // on either side
  const int count = 2 * half + 1;
  const auto edge = [&](int n) // at the lower side of block n
  {
    return n <= half
               ? 1 + static_cast<int>(static_cast<std::int64_t>(inner) * n / count)
               : dim - 1 - static_cast<int>(static_cast<std::int64_t>(inner) * (count - n) / count);
  };
  std::vector<std::pair<int, int>> blocks;
  for (int n = 0; n < count; ++n)
    if ((n - half) % each == 0)
      blocks.emplace_back(edge(n), edge(n + 1));
  return blocks;
}

/// A position's worth falls with its distance from the point that was set: half at the reach.
double nearness(double distance, double reach)
{
  const double q = distance / reach;
  return 1.0 - 0.5 * q * q;
}

/// How well the lumen's intensity agrees with the model's: air cells beside a nerve's canal are
/// tubes as well.
double likeness(double value, const TubeModel& model)
{
  const double q = (value - model.lumen) / (0.6 * model.contrast);
  return std::exp(-q * q);
}

std::vector<double> legRadii(const TubeModel& model)
{
  return {0.75 * model.radius, model.radius, 1.3 * model.radius};
}

double snapStep(const TubeModel& model)
{
  return std::clamp(0.3 * model.radius, 0.12, 0.5);
}

/// Whether the voxels do not resolve the tube. Then the points are followed rather than the image:
/// marrow spaces beside a faint tube stand out more than it does.
bool isThin(const TubeImage& image, const TubeModel& model)
{
  return model.radius < 0.8 * image.geometry().spacing().mean();
}

/// Response relative to the model's contrast, 0 to about 1.
double relativeResponse(const TubeImage& image, const TubeFlux& flux, const TubeModel& model,
                        const Vector3d& p)
{
  const double m = std::max(flux.at(p).value, 0.0) / model.contrast;
  return m > 0.0 ? m * likeness(static_cast<double>(image.atPatient(p)), model) : 0.0;
}

} // namespace

TubeImage::TubeImage(const volume::IntensityVolume& image, const core::IndexBox& box)
  : m_voxels(image.geometry().cropped(box))
{
  const core::Index3 size = box.size();
  m_stride = {1, size[0], static_cast<std::ptrdiff_t>(size[0]) * size[1]};
  const double padding = image.padding().value_or(std::numeric_limits<double>::quiet_NaN());
  std::vector<std::uint8_t> holes(static_cast<std::size_t>(size[2]), 0);
  image.visit(
      [&](const auto& source)
      {
        tbb::parallel_for(0, size[2],
                          [&](int k)
                          {
                            bool hole = false;
                            for (int j = 0; j < size[1]; ++j)
                            {
                              const auto* from =
                                  &source.at(box.lower[0], box.lower[1] + j, box.lower[2] + k);
                              float* to = &m_voxels.at(0, j, k);
                              for (int i = 0; i < size[0]; ++i)
                              {
                                const auto value = static_cast<double>(from[i]);
                                const bool valid = std::isfinite(value) && value != padding;
                                hole = hole || !valid;
                                to[i] = valid ? static_cast<float>(value)
                                              : std::numeric_limits<float>::quiet_NaN();
                              }
                            }
                            holes[static_cast<std::size_t>(k)] = hole ? 1 : 0;
                          });
      });
  float* data = m_voxels.data();
  const auto valid = [](float v) { return !std::isnan(v); };
  const float* const end = data + m_voxels.size();
  const float* const first = std::find_if(static_cast<const float*>(data), end, valid);
  if (first == end)
    throw core::InvalidParameter(
        "tube: the image has no valid voxels around the points; set them inside the scanned field");
  if (std::all_of(first, end, [&](float v) { return std::isnan(v) || v == *first; }))
    throw core::InvalidParameter(
        "tube: the image has the same value everywhere around the points; set them on a structure "
        "that differs from its surroundings");
  if (std::find(holes.begin(), holes.end(), 1) != holes.end())
  {
    std::vector<float> all; // a sample would depend on the order of the voxels
    std::copy_if(first, end, std::back_inserter(all), valid);
    const auto fill = static_cast<float>(medianOf(std::move(all)));
    std::replace_if(
        data, data + m_voxels.size(), [](float v) { return std::isnan(v); }, fill);
  }
  m_noise = estimateNoise();
}

float TubeImage::sample(const Vector3f& voxel) const noexcept
{
  std::ptrdiff_t at = 0;
  std::ptrdiff_t up[3];
  float w[3];
  for (std::size_t a = 0; a < 3; ++a)
  {
    const int dim = geometry().dims()[a];
    const float x =
        std::clamp(voxel[static_cast<Eigen::Index>(a)], 0.0F, static_cast<float>(dim - 1));
    const int lower = std::min(static_cast<int>(x), std::max(dim - 2, 0));
    at += lower * m_stride[a];
    up[a] = lower + 1 < dim ? m_stride[a] : 0;
    w[a] = x - static_cast<float>(lower);
  }
  const float* c = m_voxels.data() + at;
  const auto mix = [](float a, float b, float t) { return a + (b - a) * t; };
  const auto face = [&](const float* f)
  { return mix(mix(f[0], f[up[0]], w[0]), mix(f[up[1]], f[up[0] + up[1]], w[0]), w[1]); };
  return mix(face(c), face(c + up[2]), w[2]);
}

/// From pseudo-residuals against the six neighbours, in blocks; the lower quartile of the blocks,
/// as homogeneous tissue is wanted. Blocks without any variation (clipped air) do not count. The
/// blocks lie the same in an image that is stored the other way along an axis.
double TubeImage::estimateNoise() const
{
  constexpr double kBlock = 8.0; // voxels, about
  const core::Index3& dims = geometry().dims();
  if (dims[0] < 3 || dims[1] < 3 || dims[2] < 3)
    return 0.0;
  std::array<std::vector<std::pair<int, int>>, 3> blocks;
  const int each =
      std::max(1, static_cast<int>(std::cbrt(static_cast<double>(m_voxels.size()) / 4e6)));
  for (std::size_t a = 0; a < 3; ++a)
    blocks[a] = symmetricBlocks(dims[a], kBlock, each);
  std::vector<double> found;
  for (const auto& [k, kEnd] : blocks[2])
    for (const auto& [j, jEnd] : blocks[1])
      for (const auto& [i, iEnd] : blocks[0])
      {
        double sum = 0.0;
        int count = 0;
        for (int z = k; z < kEnd; ++z)
          for (int y = j; y < jEnd; ++y)
            for (int x = i; x < iEnd; ++x)
            {
              const float* c = &m_voxels.at(x, y, z);
              float mean = 0.0F;
              for (const std::ptrdiff_t s : m_stride)
                mean += c[s] + c[-s];
              const auto residual = static_cast<double>(*c - mean / 6.0F);
              sum += residual * residual;
              ++count;
            }
        if (count >= 27 && sum > 0.0)
          found.push_back(std::sqrt(sum / count * 6.0 / 7.0));
      }
  if (found.empty())
    return 0.0;
  const auto quarter = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 4);
  std::nth_element(found.begin(), quarter, found.end());
  return *quarter;
}

TubeFlux::TubeFlux(const TubeImage& image, bool isBright, const std::vector<double>& radii,
                   double contrastCap)
  : m_image(image)
  , m_sign(isBright ? -1.0F : 1.0F)
  , m_cap(static_cast<float>(std::min(contrastCap, 1e30)))
{
  const std::vector<Vector3d> axes = sphereAxes();
  const double h = image.geometry().spacing().mean();
  const Eigen::Matrix3d& toVoxel = image.geometry().voxelFromPatientLinear();
  for (const double radius : radii)
  {
    Scale scale{radius, {}, {}};
    const double inner = std::max(radius - std::max(0.4 * radius, 0.7 * h), 0.0);
    const double outer = radius + std::max(0.25 * radius, 0.7 * h);
    for (const double side : {1.0, -1.0})
      for (const Vector3d& n : axes)
      {
        const Vector3d v = toVoxel * (side * n);
        scale.inner.push_back((inner * v).cast<float>());
        scale.outer.push_back((outer * v).cast<float>());
      }
    m_scales.push_back(std::move(scale));
  }
}

TubeFlux::Response TubeFlux::at(const Vector3d& patient) const
{
  static const std::vector<Vector3f> axes = []
  {
    std::vector<Vector3f> result;
    for (const Vector3d& n : sphereAxes())
      result.push_back(n.cast<float>());
    return result;
  }();
  const Vector3f center = m_image.voxelOf(patient);
  Response best{-kInfinity, 0.0};
  for (const Scale& scale : m_scales)
  {
    Eigen::Matrix3f q = Eigen::Matrix3f::Zero();
    for (std::size_t j = 0; j < axes.size(); ++j)
    {
      float both = 0.0F;
      for (const std::size_t side : {j, j + axes.size()})
      {
        const float d = m_sign * (m_image.sample(center + scale.outer[side]) -
                                  m_image.sample(center + scale.inner[side]));
        both += std::clamp(d, -m_cap, m_cap);
      }
      q.noalias() += both * axes[j] * axes[j].transpose();
    }
    q *= 3.0F / static_cast<float>(2 * axes.size());
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
    solver.computeDirect(q, Eigen::EigenvaluesOnly);
    const auto& lambda = solver.eigenvalues(); // ascending
    const auto value = static_cast<double>(lambda[1] - 0.3F * std::max(lambda[0], 0.0F));
    if (value > best.value)
      best = {value, scale.radius};
  }
  return best;
}

double TubeFlux::unevenness(const Vector3d& patient) const
{
  const Vector3f center = m_image.voxelOf(patient);
  double sum = 0.0;
  double squares = 0.0;
  int count = 0;
  for (const float depth : {1.0F, 0.5F})
    for (const Vector3f& offset : m_scales.front().inner)
    {
      const auto value = static_cast<double>(m_image.sample(center + depth * offset));
      sum += value;
      squares += value * value;
      ++count;
    }
  const double mean = sum / count;
  return std::sqrt(std::max(squares / count - mean * mean, 0.0));
}

TubeModel estimateModel(const TubeImage& image, const std::vector<Vector3d>& points,
                        const TubeOptions& options, const core::Progress& progress)
{
  // As far as a point may be off the axis, also for wide tubes: with more, the deeper contrast of a
  // cavity beside the tube would win.
  const double reach = std::max(options.reach, 0.3);
  std::vector<double> radii;
  if (options.radius)
    radii = {*options.radius};
  else
    std::copy_if(std::begin(kRadiusLadder), std::end(kRadiusLadder), std::back_inserter(radii),
                 [&options](double r) { return r <= options.widest; });
  if (radii.empty())
    radii = {options.widest};
  const double finest = 0.6 * image.geometry().spacing().minCoeff();
  if (!options.radius) // what is thinner than a voxel cannot be told apart
    radii.erase(radii.begin(), std::find_if(radii.begin(), radii.end() - 1,
                                            [&](double r) { return r >= finest; }));
  struct Candidate
  {
    bool isBright;
    double radius;
    std::vector<double> response; // of each point
    std::vector<double> lumen;
    double score = 0.0;
  };
  std::vector<Candidate> candidates;
  for (const bool bright : {false, true})
    if (options.contrast == TubeOptions::Contrast::Automatic ||
        (options.contrast == TubeOptions::Contrast::Bright) == bright)
      for (const double r : radii)
        candidates.push_back({bright, r, std::vector<double>(points.size(), 0.0),
                              std::vector<double>(points.size(), 0.0)});
  tbb::parallel_for(std::size_t{0}, candidates.size() * points.size(),
                    [&](std::size_t n)
                    {
                      progress.check("trace tube");
                      Candidate& c = candidates[n / points.size()];
                      const std::size_t p = n % points.size();
                      const TubeFlux flux(image, c.isBright, {c.radius}, kInfinity);
                      double best = 0.0;
                      for (const Vector3d& offset :
                           ball(reach, std::clamp(0.45 * c.radius, 0.2, 0.6)))
                      {
                        const Vector3d q = points[p] + offset;
                        double value = flux.at(q).value * nearness(offset.norm(), reach);
                        if (value <= best)
                          continue;
                        value -= std::max(flux.unevenness(q) - image.noise(), 0.0);
                        if (value > best)
                        {
                          best = value;
                          c.lumen[p] = static_cast<double>(image.atPatient(q));
                        }
                      }
                      c.response[p] = best;
                    });
  for (Candidate& c : candidates)
    c.score = medianOf(c.response);
  const Candidate& best =
      *std::max_element(candidates.begin(), candidates.end(),
                        [](const Candidate& a, const Candidate& b) { return a.score < b.score; });
  TubeModel model;
  model.isBright = best.isBright;
  model.radius = best.radius;
  constexpr double kLeast = 1.5; // sigma of the noise: below, only the points are followed
  if (best.score > kLeast * image.noise() && best.score > 0.0)
  {
    model.contrast = rounded(best.score);
    const double step = 0.25 * model.contrast;
    model.lumen = step * std::round(medianOf(best.lumen) / step);
  }
  return model;
}

std::vector<SnappedPoint> snapPoints(const TubeImage& image, const std::vector<Vector3d>& points,
                                     const TubeModel& model, const TubeOptions& options)
{
  std::vector<SnappedPoint> snapped;
  for (const Vector3d& point : points)
    snapped.push_back({point, true});
  if (model.contrast <= 0.0 || options.reach <= 0.0)
    return snapped;
  constexpr double kFaint = 0.25; // of the model's contrast: no axis
  const TubeFlux flux(image, model.isBright, legRadii(model), model.contrast);
  const double reach = isThin(image, model)
                           ? std::min(options.reach, 1.25 * image.geometry().spacing().mean())
                           : options.reach;
  const std::vector<Vector3d> offsets = ball(reach, snapStep(model));
  tbb::parallel_for(std::size_t{0}, points.size(),
                    [&](std::size_t p)
                    {
                      double best = 0.0;
                      double response = 0.0;
                      Vector3d position = points[p];
                      for (const Vector3d& offset : offsets)
                      {
                        const Vector3d q = points[p] + offset;
                        const double m = relativeResponse(image, flux, model, q);
                        const double value = m * nearness(offset.norm(), reach);
                        if (value > best)
                        {
                          best = value;
                          response = m;
                          position = q;
                        }
                      }
                      if (response >= kFaint)
                        snapped[p] = {position, false};
                    });
  return snapped;
}

double legReach(double legLength, double radius) noexcept
{
  return std::max({3.0, 4.0 * radius, 0.5 * legLength});
}

std::vector<Vector3d> findLeg(const TubeImage& image, const Vector3d& from, const Vector3d& to,
                              const TubeModel& model, const core::Progress& progress)
{
  const double length = (to - from).norm();
  if (model.contrast <= 0.0 || length < 1e-9)
    return {from, to};

  // lattice over the capsule around the straight line; no finer than a few million nodes
  double reach = legReach(length, model.radius);
  if (isThin(image, model))
    reach = std::min(reach, std::max(0.75, 0.2 * length));
  const Vector3d lower = from.cwiseMin(to).array() - reach;
  const Vector3d extent = (from - to).cwiseAbs().array() + 2.0 * reach;
  constexpr double kMostNodes = 4e6;
  const double h =
      std::max(std::clamp(0.45 * model.radius, 0.15, 2.0), std::cbrt(extent.prod() / kMostNodes));
  std::array<int, 3> dims{};
  for (std::size_t a = 0; a < 3; ++a)
    dims[a] = static_cast<int>(std::ceil(extent[static_cast<Eigen::Index>(a)] / h)) + 1;
  const std::array<std::ptrdiff_t, 3> stride{1, dims[0],
                                             static_cast<std::ptrdiff_t>(dims[0]) * dims[1]};
  const auto count = static_cast<std::size_t>(stride[2] * dims[2]);
  const auto nodeOf = [&](const Vector3d& p)
  {
    std::ptrdiff_t n = 0;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const auto axis = static_cast<Eigen::Index>(a);
      const auto i = static_cast<int>(std::lround((p[axis] - lower[axis]) / h));
      n += std::clamp(i, 0, dims[a] - 1) * stride[a];
    }
    return static_cast<std::size_t>(n);
  };
  const auto indexOf = [&](std::size_t node)
  {
    const auto n = static_cast<std::ptrdiff_t>(node);
    return std::array<int, 3>{static_cast<int>(n % dims[0]),
                              static_cast<int>(n / stride[1] % dims[1]),
                              static_cast<int>(n / stride[2])};
  };
  const auto positionOf = [&](const std::array<int, 3>& i)
  { return Vector3d(lower + h * Vector3d(i[0], i[1], i[2])); };

  const Vector3d along = (to - from) / length;
  const auto isWithin = [&](const Vector3d& p)
  {
    const double t = std::clamp((p - from).dot(along), 0.0, length);
    return (p - from - t * along).squaredNorm() <= reach * reach;
  };
  const TubeFlux flux(image, model.isBright, legRadii(model), model.contrast);
  std::vector<float> cost(count, -1.0F); // of a node, per mm; asked only where the front comes
  const auto costOf = [&](std::size_t node, const Vector3d& p)
  {
    if (cost[node] < 0.0F)
    {
      const double m = std::min(relativeResponse(image, flux, model, p), 1.2);
      cost[node] = static_cast<float>(1.0 / (0.02 + m * m));
    }
    return static_cast<double>(cost[node]);
  };

  struct Step
  {
    std::array<int, 3> by;
    double length;
  };
  std::vector<Step> steps;
  for (int k = -1; k <= 1; ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i)
        if (i != 0 || j != 0 || k != 0)
          steps.push_back({{i, j, k}, h * std::sqrt(1.0 * (i * i + j * j + k * k))});

  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<float> total(count, std::numeric_limits<float>::max());
  std::vector<std::uint32_t> cameFrom(count, kNone);
  using Entry = std::pair<float, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  const std::size_t start = nodeOf(from);
  const std::size_t goal = nodeOf(to);
  total[start] = 0.0F;
  front.emplace(0.0F, static_cast<std::uint32_t>(start));
  for (std::size_t settled = 0; !front.empty(); ++settled)
  {
    if (settled % 1024 == 0)
      progress.check("trace tube");
    const auto [reached, node] = front.top();
    front.pop();
    if (node == goal)
      break;
    if (reached > total[node])
      continue;
    const std::array<int, 3> at = indexOf(node);
    const double here = costOf(node, positionOf(at));
    for (const Step& step : steps)
    {
      std::array<int, 3> next = at;
      std::ptrdiff_t n = static_cast<std::ptrdiff_t>(node);
      bool inside = true;
      for (std::size_t a = 0; a < 3; ++a)
      {
        next[a] += step.by[a];
        inside = inside && next[a] >= 0 && next[a] < dims[a];
        n += step.by[a] * stride[a];
      }
      const auto other = static_cast<std::size_t>(n);
      if (!inside || total[other] <= reached)
        continue;
      const Vector3d p = positionOf(next);
      if (!isWithin(p) && other != goal)
        continue;
      const double sum =
          static_cast<double>(reached) + 0.5 * step.length * (here + costOf(other, p));
      if (sum < static_cast<double>(total[other]))
      {
        total[other] = static_cast<float>(sum);
        cameFrom[other] = node;
        front.emplace(total[other], static_cast<std::uint32_t>(other));
      }
    }
  }
  std::vector<Vector3d> path{to};
  if (cameFrom[goal] != kNone)
    for (std::size_t node = cameFrom[goal]; node != start; node = cameFrom[node])
      path.push_back(positionOf(indexOf(node)));
  path.push_back(from);
  std::reverse(path.begin(), path.end());
  return path;
}

} // namespace petrous::segmentation
