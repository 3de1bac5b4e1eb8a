#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <tbb/parallel_for.h>

#include "PhantomScene.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/SplitMix64.h"

namespace petrous::phantom
{
namespace
{

constexpr int kSlab = 8;          // slices per task
constexpr double kFraction = 8.0; // steps per HU while filtering, so that rounding adds < 0.1 HU

/// Stateless Gaussian noise: maps counters through the quantiles of the normal distribution.
class GaussianNoise
{
public:
  GaussianNoise(std::uint64_t seed, double sigma)
    : m_seed(core::splitMix64(seed ^ 0x6E6F697365ULL))
  {
    for (std::size_t i = 0; i <= kSteps; ++i)
    {
      const double share = std::clamp(static_cast<double>(i) / kSteps, 1e-5, 1.0 - 1e-5);
      m_quantile[i] = static_cast<float>(sigma * quantile(share));
    }
  }

  float at(std::uint64_t counter) const noexcept
  {
    const std::uint64_t bits = core::splitMix64(m_seed + counter);
    const std::size_t step = bits >> 52;
    const float part = static_cast<float>((bits >> 28) & 0xFFFFFF) * 0x1.0p-24F;
    return m_quantile[step] + part * (m_quantile[step + 1] - m_quantile[step]);
  }

private:
  static constexpr std::size_t kSteps = 4096;

  /// Newton's method on Phi(x) = share.
  static double quantile(double share)
  {
    double x = 0.0;
    for (int i = 0; i < 60; ++i)
    {
      const double error = 0.5 * std::erfc(-x / std::sqrt(2.0)) - share;
      const double density = std::exp(-0.5 * x * x) / std::sqrt(2.0 * 3.14159265358979323846);
      x -= std::clamp(error / density, -0.5, 0.5);
    }
    return x;
  }

  std::uint64_t m_seed;
  std::array<float, kSteps + 1> m_quantile{};
};

/// Weights of a Gaussian sampled at integer voxels, from -n to n; {1} if it is narrower than a
/// third of a voxel (less than the blur of partial volume). The variance of the partial-volume
/// kernel exceeds that of a voxel's box by 1/12 voxel^2, which is subtracted here.
std::vector<float> gaussianKernel(double width)
{
  if (width < 1.0 / 3.0)
    return {1.0F};
  const double sigma = std::sqrt(width * width - 1.0 / 12.0);
  const int n = static_cast<int>(std::ceil(3.0 * sigma));
  std::vector<float> kernel;
  double sum = 0.0;
  for (int i = -n; i <= n; ++i)
    sum += std::exp(-0.5 * i * i / (sigma * sigma));
  for (int i = -n; i <= n; ++i)
    kernel.push_back(static_cast<float>(std::exp(-0.5 * i * i / (sigma * sigma)) / sum));
  return kernel;
}

/// Filters one line in place; the end samples are repeated beyond the ends.
void filterLine(float* line, int count, std::ptrdiff_t stride, const std::vector<float>& kernel,
                std::vector<float>& scratch)
{
  const int n = static_cast<int>(kernel.size()) / 2;
  if (n == 0)
    return;
  scratch.resize(static_cast<std::size_t>(count + 2 * n));
  for (int i = 0; i < count + 2 * n; ++i)
    scratch[static_cast<std::size_t>(i)] = line[std::clamp(i - n, 0, count - 1) * stride];
  for (int i = 0; i < count; ++i)
  {
    float sum = 0.0F;
    for (std::size_t w = 0; w < kernel.size(); ++w)
      sum += kernel[w] * scratch[static_cast<std::size_t>(i) + w];
    line[i * stride] = sum;
  }
}

core::GridGeometry geometryOf(const ScanGrid& grid)
{
  Eigen::Matrix3d axes = grid.step;
  Eigen::Vector3d spacing = grid.step.colwise().norm().transpose();
  axes.col(0) /= spacing[0];
  axes.col(1) /= spacing[1];
  const Eigen::Vector3d normal = axes.col(0).cross(axes.col(1)).normalized();
  const double along = normal.dot(grid.step.col(2));
  axes.col(2) = along < 0.0 ? Eigen::Vector3d(-normal) : normal;
  spacing[2] = std::abs(along);
  return {grid.dims, spacing, grid.origin, axes};
}

struct Frame
{
  Eigen::Vector3d origin;
  Eigen::Matrix3d step;

  shapes::Point at(double i, double j, double k) const
  {
    return origin + step * Eigen::Vector3d(i, j, k);
  }
};

/// Calls each(box, stack) for boxes of voxels that cover slices [first, last): the slab is bisected
/// while it contains borders and a box is wider than a few voxels.
template <class Each>
class BlockVisitor
{
public:
  BlockVisitor(const Phantom::Scene& scene, const Frame& frame, double margin, const Each& each)
    : m_scene(scene)
    , m_frame(frame)
    , m_margin(margin)
    , m_each(each)
  {
  }

  void visit(const core::Index3& dims, int first, int last) const
  {
    for (int j = 0; j < dims[1]; j += kTile)
      for (int i = 0; i < dims[0]; i += kTile)
        split({{i, j, first}, {std::min(i + kTile, dims[0]), std::min(j + kTile, dims[1]), last}},
              nullptr);
  }

private:
  static constexpr int kTile = 32;
  static constexpr int kSmallest = 4;

  void split(const core::IndexBox& box, const Phantom::Scene::Stack* among) const
  {
    const core::Index3 size = box.size();
    const Eigen::Vector3d half(0.5 * (size[0] - 1), 0.5 * (size[1] - 1), 0.5 * (size[2] - 1));
    const Eigen::Vector3d low(box.lower[0], box.lower[1], box.lower[2]);
    // the farthest corner, also for a sheared grid
    double reach = 0.0;
    for (int corner = 0; corner < 4; ++corner)
    {
      const Eigen::Vector3d side(half[0], (corner & 1) ? half[1] : -half[1],
                                 (corner & 2) ? half[2] : -half[2]);
      reach = std::max(reach, (m_frame.step * side).norm());
    }
    const Eigen::Vector3d middle = low + half;
    const auto stack =
        m_scene.stackAround(m_frame.at(middle[0], middle[1], middle[2]), reach + m_margin, among);
    std::size_t axis = 0;
    for (std::size_t a = 1; a < 3; ++a)
      if (size[a] > size[axis])
        axis = a;
    if (stack.layers.empty() || size[axis] <= kSmallest)
    {
      m_each(box, stack);
      return;
    }
    core::IndexBox lower = box;
    core::IndexBox upper = box;
    lower.upper[axis] = upper.lower[axis] = box.lower[axis] + size[axis] / 2;
    split(lower, &stack);
    split(upper, &stack);
  }

  const Phantom::Scene& m_scene;
  const Frame& m_frame;
  double m_margin;
  const Each& m_each;
};

} // namespace

volume::Volume<std::int16_t> samplePhantom(const Phantom& phantom, const ScanGrid& grid,
                                           const ScanSettings& settings,
                                           const core::Progress& progress)
{
  if (!(settings.noise >= 0.0 && settings.noise <= 1000.0))
    throw core::InvalidParameter("phantom: the noise must be 0 to 1000");
  volume::Volume<std::int16_t> result(geometryOf(grid));
  const Phantom::Scene& scene = phantom.scene();
  const core::Index3 dims = grid.dims;
  const Frame frame{settings.patientFromScan * grid.origin,
                    settings.patientFromScan.rotation().toRotationMatrix() * grid.step};
  const Eigen::Vector3d spacing = grid.step.colwise().norm().transpose();
  const double width = std::cbrt(spacing.prod());
  const double sigma =
      settings.pointSpread < 0.0 ? std::min(0.25, 0.75 * spacing.minCoeff()) : settings.pointSpread;
  const std::array<std::vector<float>, 3> kernels{gaussianKernel(sigma / spacing[0]),
                                                  gaussianKernel(sigma / spacing[1]),
                                                  gaussianKernel(sigma / spacing[2])};
  const bool filterSlices = kernels[2].size() > 1;
  const std::size_t slice = static_cast<std::size_t>(dims[0]) * static_cast<std::size_t>(dims[1]);
  const auto rounded = [](float v)
  { return static_cast<std::int16_t>(std::lround(std::clamp(v, -32768.0F, 32767.0F))); };

  const int slabs = (dims[2] + kSlab - 1) / kSlab;
  std::atomic<int> done{0};
  tbb::parallel_for(
      0, slabs,
      [&](int slab)
      {
        progress.report(0.8 * done.fetch_add(1) / slabs, "scanning the phantom");
        const int first = slab * kSlab;
        const int last = std::min(first + kSlab, dims[2]);
        std::vector<float> buffer(slice * static_cast<std::size_t>(last - first));
        const auto fill = [&](const core::IndexBox& box, const Phantom::Scene::Stack& stack)
        {
          const bool plain = stack.layers.empty() && scene.baseIsUniform(stack);
          const auto base = static_cast<float>(scene.baseIntensity(stack, settings.modality));
          for (int k = box.lower[2]; k < box.upper[2]; ++k)
            for (int j = box.lower[1]; j < box.upper[1]; ++j)
            {
              float* row = buffer.data() + slice * static_cast<std::size_t>(k - first) +
                           static_cast<std::size_t>(j) * static_cast<std::size_t>(dims[0]);
              for (int i = box.lower[0]; i < box.upper[0]; ++i)
                row[i] = plain ? base
                               : static_cast<float>(scene.look(frame.at(i, j, k), width,
                                                               settings.modality, stack));
            }
        };
        BlockVisitor(scene, frame, width, fill).visit(dims, first, last);
        std::vector<float> scratch;
        for (int k = first; k < last; ++k)
        {
          float* plane = buffer.data() + slice * static_cast<std::size_t>(k - first);
          for (int j = 0; j < dims[1]; ++j)
            filterLine(plane + static_cast<std::ptrdiff_t>(j) * dims[0], dims[0], 1, kernels[0],
                       scratch);
          for (int i = 0; i < dims[0]; ++i)
            filterLine(plane + i, dims[1], dims[0], kernels[1], scratch);
        }
        std::int16_t* out = result.data() + slice * static_cast<std::size_t>(first);
        for (std::size_t v = 0; v < buffer.size(); ++v)
          out[v] = rounded(buffer[v] * static_cast<float>(kFraction));
      });

  // Filter across the slices, and noise. A sheared grid is filtered along its own slice axis.
  const GaussianNoise noise(settings.seed, settings.noise);
  done = 0;
  tbb::parallel_for(
      0, dims[1],
      [&](int j)
      {
        progress.report(0.8 + 0.2 * done.fetch_add(1) / dims[1], "scanning the phantom");
        const auto columns = static_cast<std::size_t>(dims[0]);
        std::vector<float> sheet(columns * static_cast<std::size_t>(dims[2]));
        std::vector<float> scratch;
        const std::size_t offset = static_cast<std::size_t>(j) * columns;
        for (std::size_t k = 0; k < static_cast<std::size_t>(dims[2]); ++k)
          for (std::size_t i = 0; i < columns; ++i)
            sheet[k * columns + i] = static_cast<float>(result.data()[k * slice + offset + i]);
        if (filterSlices)
          for (int i = 0; i < dims[0]; ++i)
            filterLine(sheet.data() + i, dims[2], dims[0], kernels[2], scratch);
        for (std::size_t k = 0; k < static_cast<std::size_t>(dims[2]); ++k)
          for (std::size_t i = 0; i < columns; ++i)
          {
            const std::size_t voxel = k * slice + offset + i;
            float value = sheet[k * columns + i] / static_cast<float>(kFraction);
            if (settings.noise > 0.0)
              value += noise.at(voxel);
            // a magnitude image has no negative values
            if (settings.modality == Phantom::Modality::Mr)
              value = std::abs(value);
            result.data()[voxel] = rounded(value);
          }
      });
  return result;
}

volume::LabelMap labelPhantom(const Phantom& phantom, const core::GridGeometry& geometry,
                              const core::Progress& progress)
{
  const Phantom::Scene& scene = phantom.scene();
  std::vector<std::uint16_t> indexOfLayer(scene.layers.size(), 0);
  for (std::size_t s = 0; s < scene.layerOf.size(); ++s)
    indexOfLayer[scene.layerOf[s]] = static_cast<std::uint16_t>(s + 1);
  const auto indexOf = [&](int layer) -> std::uint16_t
  { return layer < 0 ? std::uint16_t{0} : indexOfLayer[static_cast<std::size_t>(layer)]; };

  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(geometry);
  const core::Index3 dims = geometry.dims();
  const Frame frame{geometry.origin(), geometry.patientFromVoxelLinear()};
  const int slabs = (dims[2] + kSlab - 1) / kSlab;
  std::atomic<int> done{0};
  tbb::parallel_for(
      0, slabs,
      [&](int slab)
      {
        progress.report(static_cast<double>(done.fetch_add(1)) / slabs, "labelling the phantom");
        const int first = slab * kSlab;
        const int last = std::min(first + kSlab, dims[2]);
        const auto fill = [&](const core::IndexBox& box, const Phantom::Scene::Stack& stack)
        {
          for (int k = box.lower[2]; k < box.upper[2]; ++k)
            for (int j = box.lower[1]; j < box.upper[1]; ++j)
              for (int i = box.lower[0]; i < box.upper[0]; ++i)
                voxels->at(i, j, k) = stack.layers.empty()
                                          ? indexOf(stack.base)
                                          : indexOf(scene.topmost(frame.at(i, j, k), stack));
        };
        BlockVisitor(scene, frame, 0.0, fill).visit(dims, first, last);
      });

  std::vector<volume::Segment> names;
  for (std::size_t s = 0; s < phantom.structures().size(); ++s)
  {
    const PhantomStructure& structure = phantom.structures()[s];
    names.push_back({structure.name, static_cast<std::uint16_t>(s + 1), structure.color, 0});
  }
  return volume::makeLabelMap(std::move(voxels), std::move(names));
}

} // namespace petrous::phantom
