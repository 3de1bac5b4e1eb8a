#include "MutualInformation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <vector>

#include <tbb/parallel_for.h>

#include "JointHistogram.h"
#include "petrous/Volume/Sampling.h"

namespace petrous::registration
{

namespace
{

constexpr std::size_t kChunk = 8192; // samples per partial histogram
constexpr int kPad = 2;              // empty bins on each side, for the support of the B-spline

// The four weights of the cubic B-spline at t in [0, 1) after a bin; windowSlope: their
// derivatives.
struct Window
{
  std::array<float, 4> weight;
  explicit Window(float t)
  {
    const float s = 1.0f - t;
    const float t2 = t * t;
    weight = {s * s * s / 6.0f, (4.0f - 6.0f * t2 + 3.0f * t2 * t) / 6.0f,
              (1.0f + 3.0f * (t + t2 - t2 * t)) / 6.0f, t2 * t / 6.0f};
  }
};

std::array<float, 4> windowSlope(float t)
{
  const float s = 1.0f - t;
  return {-0.5f * s * s, -2.0f * t + 1.5f * t * t, 0.5f + t - 1.5f * t * t, 0.5f * t * t};
}

// The moving image, addressed as required by the inner loop. Not volume::sampleTrilinear, which
// finds the cell in double and clamps positions to the hull; here one outside does not count.
struct Sampler
{
  const float* values;
  std::array<int, 3> last; // index of the lower corner of the last cell
  Eigen::Array3f upper;    // largest voxel coordinate
  std::ptrdiff_t row;
  std::ptrdiff_t slice;
  std::array<std::ptrdiff_t, 3> next; // 0 along an axis with one voxel
  Eigen::Matrix3f linear;             // voxel from fixed point (relative to its centre)
  Eigen::Vector3f offset;

  Sampler(const LevelImage& moving, const Eigen::Vector3d& centre,
          const core::RigidTransform& movingFromFixed)
    : values(moving.voxels.data())
  {
    const core::GridGeometry& grid = moving.grid();
    const core::Index3& dims = grid.dims();
    row = dims[0];
    slice = static_cast<std::ptrdiff_t>(dims[0]) * dims[1];
    const std::array<std::ptrdiff_t, 3> step{1, row, slice};
    for (std::size_t a = 0; a < 3; ++a)
    {
      last[a] = std::max(0, dims[a] - 2);
      upper[static_cast<Eigen::Index>(a)] = static_cast<float>(dims[a] - 1);
      next[a] = dims[a] > 1 ? step[a] : 0;
    }
    linear = (grid.voxelFromPatientLinear() * movingFromFixed.rotation().toRotationMatrix())
                 .cast<float>();
    offset = grid.voxelFromPatient(movingFromFixed * centre).cast<float>();
  }

  // Cell and interpolation weights; false outside the hull.
  bool locate(const Eigen::Vector3f& point, const float*& cell, Eigen::Array3f& w) const
  {
    const Eigen::Array3f voxel = (linear * point + offset).array();
    if (!((voxel >= 0.0f).all() && (voxel <= upper).all()))
      return false;
    std::array<int, 3> index;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const auto axis = static_cast<Eigen::Index>(a);
      index[a] = std::min(static_cast<int>(voxel[axis]), last[a]);
      w[axis] = voxel[axis] - static_cast<float>(index[a]);
    }
    cell = values + index[0] + index[1] * row + index[2] * slice;
    return true;
  }

  volume::CellCorners<float> corners(const float* c) const
  {
    const float* d = c + next[1];
    const float* e = c + next[2];
    const float* f = e + next[1];
    return {c[0], c[next[0]], d[0], d[next[0]], e[0], e[next[0]], f[0], f[next[0]]};
  }
  float value(const float* c, const Eigen::Array3f& w) const
  {
    return volume::interpolateCell(corners(c), w[0], w[1], w[2]);
  }
  // Gradient of `value` per voxel.
  Eigen::Vector3f slope(const float* c, const Eigen::Array3f& w) const
  {
    return volume::gradientInCell(corners(c), w[0], w[1], w[2]);
  }
};

struct Scaling
{
  float low;
  float perUnit;
  float top; // maximum bin position

  Scaling(const LevelImage& moving, int bins)
    : low(moving.low)
    , perUnit(moving.high > moving.low ? static_cast<float>(bins) / (moving.high - moving.low)
                                       : 0.0f)
    , top(static_cast<float>(bins) * 0.99999f)
  {
  }
};

std::size_t chunksOf(std::size_t size)
{
  return (size + kChunk - 1) / kChunk;
}

// For evaluations without gradient.
struct Forget
{
};

// Histogram position of a sample, for the gradient.
struct Touch
{
  Eigen::Vector3f slope; // of the bin position, per voxel of the moving image; 0 where clamped
  float t = 0.0f;
  std::int16_t column = -1; // of the first bin of the window; -1: outside
};

} // namespace

double informationBias(int bins, double samples)
{
  return samples > 0.0 ? 0.5 * (bins - 1.0) * (bins - 1.0) / samples : 0.0;
}

double poseScore(double information, double overlap)
{
  return information * std::sqrt(overlap);
}

MutualInformation::MutualInformation(const FixedSamples& fixed, const LevelImage& moving, int bins)
  : m_fixed(fixed)
  , m_moving(moving)
  , m_bins(bins)
  , m_weight(fixed.weights.empty()
                 ? static_cast<double>(fixed.size())
                 : std::accumulate(fixed.weights.begin(), fixed.weights.end(), 0.0))
{
}

// These loops may be nested in a loop over several fits. If that is cancelled they still run to
// completion (`isolated`): a partial histogram is invalid.
template <class Fall>
JointHistogram MutualInformation::fill(const core::RigidTransform& movingFromFixed,
                                       const Fall& fall) const
{
  const Sampler sampler(m_moving, m_fixed.centre, movingFromFixed);
  const Scaling scaling(m_moving, m_bins);
  const int columns = m_bins + 2 * kPad;
  std::vector<std::vector<float>> parts(chunksOf(m_fixed.size()));
  tbb::task_group_context whole(tbb::task_group_context::isolated);
  tbb::parallel_for(
      std::size_t{0}, parts.size(),
      [&](std::size_t chunk)
      {
        std::vector<float>& histogram = parts[chunk];
        histogram.assign(static_cast<std::size_t>(m_bins) * columns, 0.0f);
        const std::size_t end = std::min(m_fixed.size(), (chunk + 1) * kChunk);
        const float* cell = nullptr;
        Eigen::Array3f w;
        for (std::size_t n = chunk * kChunk; n < end; ++n)
        {
          if (!sampler.locate(m_fixed.points[n], cell, w))
            continue;
          const float v = sampler.value(cell, w);
          if (std::isnan(v))
            continue;
          const float raw = (v - scaling.low) * scaling.perUnit;
          const float u = std::clamp(raw, 0.0f, scaling.top);
          const int bin = static_cast<int>(u);
          const int column = bin + kPad - 1;
          const float t = u - static_cast<float>(bin);
          const Window window(t);
          const float weight = m_fixed.weights.empty() ? 1.0f : m_fixed.weights[n];
          float* out = &histogram[static_cast<std::size_t>(m_fixed.bins[n]) * columns + column];
          for (std::size_t b = 0; b < 4; ++b)
            out[b] += weight * window.weight[b];
          if constexpr (!std::is_same_v<Fall, Forget>)
            fall(n, column, t,
                 u == raw ? Eigen::Vector3f(scaling.perUnit * sampler.slope(cell, w))
                          : Eigen::Vector3f::Zero().eval());
        }
      },
      whole);
  return {parts, m_bins, columns};
}

double MutualInformation::value(const core::RigidTransform& movingFromFixed, double* overlap) const
{
  const JointHistogram joint = fill(movingFromFixed, Forget());
  if (overlap)
    *overlap = m_weight > 0.0 ? joint.total / m_weight : 0.0;
  return joint.information();
}

MutualInformation::Value
MutualInformation::withGradient(const core::RigidTransform& movingFromFixed) const
{
  std::vector<Touch> touches(m_fixed.size());
  const JointHistogram joint =
      fill(movingFromFixed,
           [&touches](std::size_t n, int column, float t, const Eigen::Vector3f& slope) {
             touches[n] = {slope, t, static_cast<std::int16_t>(column)};
           });
  Value result;
  result.information = joint.information();
  result.overlap = m_weight > 0.0 ? joint.total / m_weight : 0.0;
  if (joint.total <= 0.0)
    return result;

  const std::vector<float> gradientWeights = joint.gradientWeights();
  const int columns = m_bins + 2 * kPad;
  const Eigen::Matrix3f rotation = movingFromFixed.rotation().toRotationMatrix().cast<float>();
  const Eigen::Matrix3f patientFromSlope =
      m_moving.grid().voxelFromPatientLinear().transpose().cast<float>();
  std::vector<std::array<Eigen::Vector3d, 2>> sums(
      chunksOf(m_fixed.size()), {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
  tbb::task_group_context whole(tbb::task_group_context::isolated);
  tbb::parallel_for(
      std::size_t{0}, sums.size(),
      [&](std::size_t chunk)
      {
        const std::size_t end = std::min(m_fixed.size(), (chunk + 1) * kChunk);
        // sum of g and of p x g, p relative to the fixed centre, both rotated afterwards
        Eigen::Vector3f force = Eigen::Vector3f::Zero();
        Eigen::Matrix3f moment = Eigen::Matrix3f::Zero(); // sum of g p^T
        for (std::size_t n = chunk * kChunk; n < end; ++n)
        {
          const Touch& touch = touches[n];
          if (touch.column < 0)
            continue;
          const std::array<float, 4> slope = windowSlope(touch.t);
          const float* earned =
              &gradientWeights[static_cast<std::size_t>(m_fixed.bins[n]) * columns + touch.column];
          float gain = slope[0] * earned[0] + slope[1] * earned[1] + slope[2] * earned[2] +
                       slope[3] * earned[3];
          if (!m_fixed.weights.empty())
            gain *= m_fixed.weights[n];
          const Eigen::Vector3f g = gain * touch.slope;
          force += g;
          moment += g * m_fixed.points[n].transpose();
        }
        const Eigen::Matrix3d turned =
            (patientFromSlope * moment * rotation.transpose()).cast<double>();
        sums[chunk][0] = (patientFromSlope * force).cast<double>();
        // sum of (R p) x g, from sum g (R p)^T
        sums[chunk][1] = Eigen::Vector3d(turned(2, 1) - turned(1, 2), turned(0, 2) - turned(2, 0),
                                         turned(1, 0) - turned(0, 1));
      },
      whole);
  for (const auto& sum : sums)
  {
    result.translation += sum[0];
    result.rotation += sum[1];
  }
  result.translation /= joint.total;
  result.rotation /= joint.total;
  return result;
}

} // namespace petrous::registration
