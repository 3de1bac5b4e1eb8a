#include "SimulatedMr.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <tbb/parallel_for.h>

#include "CounterNoise.h"

namespace petrous::registration
{

namespace
{

struct Knot
{
  double hounsfield, signal;
};

// Relative signals of the tissues at their typical HU, interpolated linearly. Our own values: they
// reproduce the known order of the weightings, not measured signals.
constexpr std::array<Knot, 12> kT1{{{-400, 0.02},
                                    {-160, 0.90},
                                    {-90, 1.00},
                                    {-40, 0.80},
                                    {0, 0.20},
                                    {14, 0.28},
                                    {32, 0.55},
                                    {50, 0.60},
                                    {110, 0.50},
                                    {250, 0.40},
                                    {600, 0.10},
                                    {1200, 0.02}}};
constexpr std::array<Knot, 12> kT2{{{-400, 0.02},
                                    {-160, 0.50},
                                    {-90, 0.55},
                                    {-40, 0.50},
                                    {0, 1.00},
                                    {14, 0.90},
                                    {32, 0.50},
                                    {50, 0.32},
                                    {110, 0.25},
                                    {250, 0.20},
                                    {600, 0.06},
                                    {1200, 0.02}}};
constexpr std::array<Knot, 12> kDiffusion{{{-400, 0.02},
                                           {-160, 0.04},
                                           {-90, 0.05},
                                           {-40, 0.08},
                                           {0, 0.10},
                                           {14, 0.20},
                                           {32, 0.80},
                                           {50, 0.45},
                                           {110, 0.20},
                                           {250, 0.08},
                                           {600, 0.03},
                                           {1200, 0.02}}};

constexpr float kAir = -1000.0F;
constexpr float kSoftLow = -250.0F, kSoftHigh = 250.0F; // HU range of possible soft tissue
constexpr float kLikeness = 70.0F;                      // HU, of neighbours to average
constexpr double kScale = 1000.0;                       // MR units per contrast of 1

double signalOf(const std::array<Knot, 12>& curve, double hounsfield)
{
  if (hounsfield <= curve.front().hounsfield)
    return curve.front().signal;
  for (std::size_t n = 1; n < curve.size(); ++n)
    if (hounsfield < curve[n].hounsfield)
    {
      const Knot &a = curve[n - 1], &b = curve[n];
      return a.signal +
             (b.signal - a.signal) * (hounsfield - a.hounsfield) / (b.hounsfield - a.hounsfield);
    }
  return curve.back().signal;
}

// Smooth noise of about -1 to 1: random values on a lattice of `cell` mm, interpolated.
class SmoothNoise
{
public:
  SmoothNoise(std::uint64_t seed, double cell)
    : m_noise(seed)
    , m_cell(cell)
  {
  }

  double at(const Vector3d& p) const
  {
    std::array<std::int64_t, 3> lower{};
    Vector3d w;
    for (Eigen::Index a = 0; a < 3; ++a)
    {
      const double x = p[a] / m_cell;
      const double floor = std::floor(x);
      lower[static_cast<std::size_t>(a)] = static_cast<std::int64_t>(floor);
      const double t = x - floor;
      w[a] = t * t * (3.0 - 2.0 * t);
    }
    double sum = 0.0;
    for (int c = 0; c < 8; ++c)
    {
      const std::int64_t i = lower[0] + (c & 1), j = lower[1] + (c >> 1 & 1),
                         k = lower[2] + (c >> 2);
      const double weight = ((c & 1) ? w[0] : 1.0 - w[0]) * ((c & 2) ? w[1] : 1.0 - w[1]) *
                            ((c & 4) ? w[2] : 1.0 - w[2]);
      sum += weight *
             m_noise.uniform(static_cast<std::uint64_t>(i * 73856093 + j * 19349663 + k * 83492791),
                             -1.0, 1.0);
    }
    return sum;
  }

private:
  CounterNoise m_noise;
  double m_cell;
};

volume::Volume<float> hounsfieldOf(const volume::IntensityVolume& ct)
{
  volume::Volume<float> result(ct.geometry());
  const auto padding = ct.padding();
  ct.visit(
      [&](const auto& voxels)
      {
        for (std::size_t n = 0; n < voxels.size(); ++n)
        {
          const auto value = static_cast<float>(voxels.data()[n]);
          const bool air =
              !std::isfinite(value) || (padding && value == static_cast<float>(*padding));
          result.data()[n] = air ? kAir : value;
        }
      });
  return result;
}

// In a neighbourhood of about 2 mm of a voxel: the mean of similar voxels, and whether the voxel is
// on the border between air and bone.
struct Neighbourhood
{
  double mean;
  bool rim;
};

Neighbourhood look(const volume::Volume<float>& ct, int i, int j, int k, const core::Index3& reach)
{
  const core::Index3& n = ct.geometry().dims();
  const float here = ct.at(i, j, k);
  double sum = 0.0;
  int count = 0;
  bool air = false, bone = false;
  for (int z = std::max(0, k - reach[2]); z <= std::min(n[2] - 1, k + reach[2]); ++z)
    for (int y = std::max(0, j - reach[1]); y <= std::min(n[1] - 1, j + reach[1]); ++y)
      for (int x = std::max(0, i - reach[0]); x <= std::min(n[0] - 1, i + reach[0]); ++x)
      {
        const float value = ct.at(x, y, z);
        if (std::abs(value - here) < kLikeness)
        {
          sum += value;
          ++count;
        }
        if (std::abs(x - i) <= 1 && std::abs(y - j) <= 1 && std::abs(z - k) <= 1)
        {
          air = air || value < -500.0F;
          bone = bone || value > 300.0F;
        }
      }
  return {sum / count, air && bone};
}

// Keys' cubic convolution kernel (1981), a = -1/2.
std::array<float, 4> cubicWeights(float t)
{
  const float t2 = t * t, t3 = t2 * t;
  return {-0.5F * t + t2 - 0.5F * t3, 1.0F - 2.5F * t2 + 1.5F * t3,
          0.5F * t + 2.0F * t2 - 1.5F * t3, -0.5F * t2 + 0.5F * t3};
}

float sampleCubic(const volume::Volume<float>& image, const Vector3d& voxel)
{
  const core::Index3& n = image.geometry().dims();
  std::array<int, 3> base{};
  std::array<std::array<float, 4>, 3> w{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    const double x = voxel[static_cast<Eigen::Index>(a)];
    if (!(x >= -0.5 && x <= n[a] - 0.5))
      return 0.0F;
    base[a] = static_cast<int>(std::floor(x));
    w[a] = cubicWeights(static_cast<float>(x - base[a]));
  }
  float sum = 0.0F;
  const bool inside = base[0] >= 1 && base[0] + 2 < n[0] && base[1] >= 1 && base[1] + 2 < n[1] &&
                      base[2] >= 1 && base[2] + 2 < n[2];
  if (inside)
  {
    const float* first = &image.at(base[0] - 1, base[1] - 1, base[2] - 1);
    const std::ptrdiff_t row = n[0], slice = row * n[1];
    for (std::size_t z = 0; z < 4; ++z)
      for (std::size_t y = 0; y < 4; ++y)
      {
        const float* x =
            first + static_cast<std::ptrdiff_t>(z) * slice + static_cast<std::ptrdiff_t>(y) * row;
        sum +=
            w[2][z] * w[1][y] * (w[0][0] * x[0] + w[0][1] * x[1] + w[0][2] * x[2] + w[0][3] * x[3]);
      }
    return sum;
  }
  // At the border the last sample is repeated.
  const auto index = [&n](int i, std::size_t a) { return std::clamp(i, 0, n[a] - 1); };
  for (int z = 0; z < 4; ++z)
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x)
        sum += w[2][static_cast<std::size_t>(z)] * w[1][static_cast<std::size_t>(y)] *
               w[0][static_cast<std::size_t>(x)] *
               image.at(index(base[0] + x - 1, 0), index(base[1] + y - 1, 1),
                        index(base[2] + z - 1, 2));
  return sum;
}

// Coil sensitivity: a low-order polynomial of the position in the extent, -1 to 1 along each axis.
double biasAt(const CounterNoise& noise, double strength, const Vector3d& u)
{
  double sum = 0.0;
  for (Eigen::Index a = 0; a < 3; ++a)
  {
    const auto n = static_cast<std::uint64_t>(a);
    sum += noise.uniform(n, -0.5, 0.5) * u[a] + noise.uniform(3 + n, -0.5, 0.5) * u[a] * u[a];
  }
  return std::exp(strength * sum);
}

// Fraction of the shift that applies at p.
double occupancyOf(const LocalShift& part, const Vector3d& p)
{
  const double inside =
      std::clamp((part.radius - (p - part.center).norm()) / part.edge + 0.5, 0.0, 1.0);
  return inside * inside * (3.0 - 2.0 * inside);
}

} // namespace

volume::Volume<float> mrContrastOf(const volume::IntensityVolume& ct, MrContrast contrast,
                                   std::uint64_t seed)
{
  const auto& curve = contrast == MrContrast::T1   ? kT1
                      : contrast == MrContrast::T2 ? kT2
                                                   : kDiffusion;
  const volume::Volume<float> hounsfield = hounsfieldOf(ct);
  const core::GridGeometry& grid = ct.geometry();
  const core::Index3& n = grid.dims();
  core::Index3 reach{};
  for (std::size_t a = 0; a < 3; ++a)
    reach[a] = std::clamp(
        static_cast<int>(std::round(2.0 / grid.spacing()[static_cast<Eigen::Index>(a)])), 0, 2);
  const SmoothNoise coarse(seed * 2 + 11, 11.0), fine(seed * 2 + 12, 5.0);
  volume::Volume<float> result(grid);
  tbb::parallel_for(0, n[2],
                    [&](int k)
                    {
                      for (int j = 0; j < n[1]; ++j)
                        for (int i = 0; i < n[0]; ++i)
                        {
                          float& out = result.at(i, j, k);
                          const float value = hounsfield.at(i, j, k);
                          if (value <= kSoftLow || value >= kSoftHigh)
                          {
                            out = static_cast<float>(signalOf(curve, value));
                            if (value < -400.0F || value > 1200.0F)
                              continue;
                          }
                          const Neighbourhood around = look(hounsfield, i, j, k, reach);
                          if (around.rim)
                          {
                            out = 0.02F;
                            continue;
                          }
                          if (value <= kSoftLow || value >= kSoftHigh)
                            continue;
                          const Vector3d p = grid.patientFromVoxel(Vector3d(i, j, k));
                          const double pattern = std::tanh(4.0 * (coarse.at(p) + 0.6 * fine.at(p)));
                          out = static_cast<float>(signalOf(curve, around.mean) *
                                                   (1.0 + 0.22 * pattern));
                        }
                    });
  return result;
}

SimulatedMr acquireMr(const volume::Volume<float>& contrast, const MrAcquisition& a)
{
  core::Index3 dims{};
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    dims[static_cast<std::size_t>(axis)] =
        std::max(1, static_cast<int>(std::round(a.extent[axis] / a.spacing[axis])));
  const Vector3d last(dims[0] - 1, dims[1] - 1, dims[2] - 1);
  const Vector3d first =
      a.center - 0.5 * a.axes * a.spacing.cwiseProduct(last); // in the CT's frame
  const core::GridGeometry scan(dims, a.spacing, first, a.axes);
  const core::GridGeometry grid(dims, a.spacing, a.mrFromCt * first,
                                a.mrFromCt.rotation().toRotationMatrix() * a.axes);
  const core::GridGeometry& from = contrast.geometry();

  // Samples per voxel box along each of its axes: at most 0.7 CT voxels apart.
  core::Index3 parts{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    parts[axis] = std::clamp(static_cast<int>(std::ceil(a.spacing[static_cast<Eigen::Index>(axis)] /
                                                        (0.7 * from.minSpacing()))),
                             2, 12);
  // From the centre of an MR voxel, in voxels of the contrast.
  std::vector<Vector3d> steps;
  const Eigen::Matrix3d turn = from.voxelFromPatientLinear() * scan.patientFromVoxelLinear();
  for (int w = 0; w < parts[2]; ++w)
    for (int v = 0; v < parts[1]; ++v)
      for (int u = 0; u < parts[0]; ++u)
        steps.emplace_back(turn * Vector3d((u + 0.5) / parts[0] - 0.5, (v + 0.5) / parts[1] - 0.5,
                                           (w + 0.5) / parts[2] - 0.5));
  const SmoothNoise field(a.seed + 101, 45.0);
  const Vector3d encode = a.axes.col(1);
  // Position in the CT's frame whose signal appears at p.
  const auto source = [field, encode, amount = a.distortion,
                       local = a.local](const Vector3d& p) -> Vector3d
  {
    return local ? Vector3d(p - occupancyOf(*local, p) * local->shift)
                 : Vector3d(p + amount * field.at(p) * encode);
  };

  const CounterNoise noise(a.seed * 3 + 5), coil(a.seed * 3 + 6);
  auto voxels = std::make_shared<volume::Volume<float>>(grid);
  tbb::parallel_for(
      0, dims[2],
      [&](int k)
      {
        for (int j = 0; j < dims[1]; ++j)
          for (int i = 0; i < dims[0]; ++i)
          {
            const Vector3d index(i, j, k);
            Vector3d shift = Vector3d::Zero();
            if (a.distortion != 0.0 || a.local)
            {
              const Vector3d p = scan.patientFromVoxel(index);
              shift = source(p) - p;
            }
            const Vector3d middle = from.voxelFromPatient(scan.patientFromVoxel(index) + shift);
            double sum = 0.0;
            for (const Vector3d& step : steps)
              sum += sampleCubic(contrast, middle + step);
            const Vector3d place = index.cwiseQuotient(last.cwiseMax(1.0)) * 2.0 - Vector3d::Ones();
            const double signal =
                sum / static_cast<double>(steps.size()) * biasAt(coil, a.bias, place);
            const auto n = static_cast<std::uint64_t>(scan.linearIndex(i, j, k));
            voxels->at(i, j, k) =
                static_cast<float>(kScale * std::hypot(signal + a.noise * noise.normal(2 * n),
                                                       a.noise * noise.normal(2 * n + 1)));
          }
      });
  SimulatedMr result;
  result.volume = std::make_shared<volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<float>>(std::move(voxels)));
  // Where the signal of a CT point appears: the inverse of `source`, by fixed-point iteration
  // (`source` is near the identity, except at the edge of a displaced part, where there is no
  // inverse).
  result.truth = [source, x = a.mrFromCt](const Vector3d& p) -> Vector3d
  {
    Vector3d q = p;
    for (int round = 0; round < 20; ++round)
      q -= source(q) - p;
    return x * q;
  };
  return result;
}

} // namespace petrous::registration
