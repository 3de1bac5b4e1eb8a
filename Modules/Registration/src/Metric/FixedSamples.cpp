#include "FixedSamples.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "petrous/Volume/Sampling.h"

namespace petrous::registration
{

namespace
{

// Computes centre and radius of the points, and makes them relative to the centre.
void settle(FixedSamples& samples)
{
  if (samples.points.empty())
    return;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& p : samples.points)
    mean += p.cast<double>();
  mean /= static_cast<double>(samples.points.size());
  double square = 0.0;
  for (Eigen::Vector3f& p : samples.points)
  {
    p -= mean.cast<float>();
    square += p.cast<double>().squaredNorm();
  }
  samples.centre += mean;
  samples.radius = std::max(1.0, std::sqrt(square / static_cast<double>(samples.points.size())));
}

} // namespace

FixedSamples drawSamples(const LevelImage& image, const core::IndexBox& box, std::size_t count,
                         std::uint32_t seed, int bins)
{
  // Additive recurrence with the generalized golden ratio g, g^4 = g + 1 (Roberts 2018).
  constexpr double g = 1.2207440846057596;
  const Eigen::Vector3d step(1.0 / g, 1.0 / (g * g), 1.0 / (g * g * g));
  std::mt19937 random(seed);
  const auto uniform = [&random] { return (static_cast<double>(random()) + 0.5) / 4294967296.0; };
  Eigen::Vector3d at(uniform(), uniform(), uniform());

  const core::Index3& dims = image.grid().dims();
  Eigen::Vector3d first;
  Eigen::Vector3d span;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<Eigen::Index>(a);
    first[axis] = box.lower[a];
    span[axis] = std::min(box.upper[a], dims[a]) - 1.0 - box.lower[a];
  }
  std::vector<Eigen::Vector3f> voxels(count);
  for (Eigen::Vector3f& voxel : voxels)
  {
    voxel = (first + span.cwiseProduct(at)).cast<float>();
    at += step;
    at -= at.array().floor().matrix();
  }
  std::sort(voxels.begin(), voxels.end(),
            [](const Eigen::Vector3f& a, const Eigen::Vector3f& b)
            {
              const int ka = static_cast<int>(a[2]);
              const int kb = static_cast<int>(b[2]);
              return ka != kb ? ka < kb : a[1] < b[1];
            });

  FixedSamples samples;
  samples.centre = image.grid().patientFromVoxel(first + 0.5 * span);
  samples.points.reserve(count);
  samples.bins.reserve(count);
  const double scale = image.high > image.low ? bins / (double{image.high} - image.low) : 0.0;
  for (const Eigen::Vector3f& voxel : voxels)
  {
    const double value = volume::sampleTrilinear(image.voxels, voxel.cast<double>());
    if (std::isnan(value))
      continue;
    samples.points.push_back(
        (image.grid().patientFromVoxel(voxel.cast<double>()) - samples.centre).cast<float>());
    samples.bins.push_back(static_cast<std::uint8_t>(
        std::clamp(static_cast<int>((value - image.low) * scale), 0, bins - 1)));
  }
  settle(samples);
  return samples;
}

FixedSamples within(const FixedSamples& samples, const Eigen::Vector3d& point, double radius)
{
  FixedSamples near;
  near.centre = samples.centre;
  const Eigen::Vector3f middle = (point - samples.centre).cast<float>();
  const auto reach = static_cast<float>(radius * radius);
  for (std::size_t n = 0; n < samples.size(); ++n)
    if ((samples.points[n] - middle).squaredNorm() <= reach)
    {
      near.points.push_back(samples.points[n]);
      near.bins.push_back(samples.bins[n]);
      if (!samples.weights.empty())
        near.weights.push_back(samples.weights[n]);
    }
  settle(near);
  return near;
}

FixedSamples bootstrap(const FixedSamples& samples, int blocks, std::uint32_t seed)
{
  FixedSamples drawn;
  drawn.centre = samples.centre;
  if (samples.points.empty())
    return drawn;
  Eigen::Array3f low = samples.points.front().array();
  Eigen::Array3f high = low;
  for (const Eigen::Vector3f& p : samples.points)
  {
    low = low.min(p.array());
    high = high.max(p.array());
  }
  const Eigen::Array3f cells = static_cast<float>(blocks) / (high - low).max(1e-3f);
  const int count = blocks * blocks * blocks;
  std::mt19937 random(seed);
  std::vector<std::uint8_t> times(static_cast<std::size_t>(count), 0);
  for (int n = 0; n < count; ++n)
    ++times[random() % static_cast<std::uint32_t>(count)];
  for (std::size_t n = 0; n < samples.size(); ++n)
  {
    const Eigen::Array3i cell =
        ((samples.points[n].array() - low) * cells).cast<int>().min(blocks - 1).max(0);
    const std::uint8_t weight =
        times[static_cast<std::size_t>((cell[2] * blocks + cell[1]) * blocks + cell[0])];
    if (weight == 0)
      continue;
    drawn.points.push_back(samples.points[n]);
    drawn.bins.push_back(samples.bins[n]);
    drawn.weights.push_back(weight);
  }
  settle(drawn);
  return drawn;
}

} // namespace petrous::registration
