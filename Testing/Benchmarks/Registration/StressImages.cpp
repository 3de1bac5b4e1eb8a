#include <array>
#include <limits>

#include <Eigen/Geometry>

#include "StressList.h"

namespace petrous::registration::stress
{

namespace
{

using Image = std::shared_ptr<const volume::IntensityVolume>;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Image noiseLike(const volume::IntensityVolume& image, std::uint64_t seed, double low, double high)
{
  const CounterNoise noise(seed);
  const core::GridGeometry& grid = image.geometry();
  return changed(image,
                 [&](int i, int j, int k, float) {
                   return static_cast<float>(noise.uniform(grid.linearIndex(i, j, k), low, high));
                 });
}

// Random balls: an image with shapes unrelated to the CT.
Image ballsLike(const volume::IntensityVolume& image, std::uint64_t seed)
{
  const CounterNoise noise(seed);
  const core::GridGeometry& grid = image.geometry();
  const auto bounds = grid.patientBounds();
  struct Ball
  {
    Vector3d center;
    double radius;
    float value;
  };
  std::vector<Ball> balls;
  for (std::uint64_t b = 0; b < 40; ++b)
  {
    Ball ball{bounds.min(), noise.uniform(10 * b, 0.03, 0.16) * bounds.diagonal().norm(),
              static_cast<float>(noise.uniform(10 * b + 1, 0.0, 1000.0))};
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      ball.center[axis] = noise.uniform(10 * b + 2 + static_cast<std::uint64_t>(axis),
                                        bounds.min()[axis], bounds.max()[axis]);
    balls.push_back(ball);
  }
  return changed(image,
                 [&](int i, int j, int k, float)
                 {
                   const Vector3d p = grid.patientFromVoxel(Vector3d(i, j, k));
                   float value = 20.0F;
                   for (const Ball& ball : balls)
                     if ((p - ball.center).squaredNorm() < ball.radius * ball.radius)
                       value = ball.value;
                   return value + static_cast<float>(
                                      noise.uniform(100000 + grid.linearIndex(i, j, k), 0.0, 30.0));
                 });
}

// Sets a random fraction of the MR's voxels to `value`.
RegistrationPair scattered(const Draw& draw, double share, float value)
{
  const RegistrationPair pair = draw.usual();
  const CounterNoise noise(draw.seed() + 5);
  const core::GridGeometry& grid = pair.mr->geometry();
  return withMr(
      pair, changed(*pair.mr, [&](int i, int j, int k, float before)
                    { return noise.uniform(grid.linearIndex(i, j, k)) < share ? value : before; }));
}

// An MR with only `slices` slices along z, y or x.
RegistrationPair fewSlices(const Draw& draw, int slices)
{
  PairRecipe recipe = draw.recipe();
  MrAcquisition& a = recipe.acquisition;
  const std::array<Eigen::Matrix3d, 3> planes{
      Eigen::Matrix3d::Identity(),
      Eigen::AngleAxisd(90.0 * kDegree, Vector3d::UnitX()).toRotationMatrix(),
      Eigen::AngleAxisd(90.0 * kDegree, Vector3d::UnitY()).toRotationMatrix()};
  a.axes = planes[draw.n % 3];
  a.center = draw.earAt();
  a.spacing[2] = 3.0;
  a.extent[2] = 3.0 * slices;
  return simulatePair(draw.body(), draw.ear(), recipe);
}

} // namespace

void addImages(List& list)
{
  list.add("constant MR", 6,
           [](const Draw& d)
           {
             const auto pair = d.usual();
             return withoutTruth(
                 withMr(pair, changed(*pair.mr, [](int, int, int, float) { return 100.0F; })));
           });
  list.add("constant MR but for one voxel", 4,
           [](const Draw& d)
           {
             const auto pair = d.usual();
             return withoutTruth(
                 withMr(pair, changed(*pair.mr, [](int i, int j, int k, float)
                                      { return i + j + k == 9 && i == 3 ? 9.F : 1.F; })));
           });
  list.add("constant CT", 4,
           [](const Draw& d)
           {
             auto pair = d.usual();
             pair.ct = changed(*pair.ct, [](int, int, int, float) { return 0.0F; });
             return withoutTruth(pair);
           });
  list.add("MR of one slice", 10, [](const Draw& d) { return fewSlices(d, 1); });
  list.add("MR of two slices", 5, [](const Draw& d) { return fewSlices(d, 2); });
  list.add("MR of three slices", 5, [](const Draw& d) { return fewSlices(d, 3); });
  list.add("NaN in 5 % of the MR", 6, [](const Draw& d) { return scattered(d, 0.05, kNan); });
  list.add("NaN in 70 % of the MR", 6, [](const Draw& d) { return scattered(d, 0.7, kNan); });
  list.add("NaN in all of the MR", 4,
           [](const Draw& d) { return withoutTruth(scattered(d, 2.0, kNan)); });
  list.add("infinite values in 2 % of the MR", 4,
           [](const Draw& d)
           { return scattered(d, 0.02, std::numeric_limits<float>::infinity()); });
  list.add("NaN in half of the MR, one side", 6,
           [](const Draw& d)
           {
             const auto pair = d.usual();
             const int half = pair.mr->geometry().dims()[d.n % 3] / 2;
             const std::size_t axis = d.n % 3;
             return withMr(pair,
                           changed(*pair.mr,
                                   [&](int i, int j, int k, float before) {
                                     return core::Index3{i, j, k}[axis] < half ? kNan : before;
                                   }));
           });
  list.add("NaN in 20 % of the CT", 4,
           [](const Draw& d)
           {
             auto pair = d.usual();
             const CounterNoise noise(d.seed());
             const auto& grid = pair.ct->geometry();
             pair.ct = changed(
                 *pair.ct, [&](int i, int j, int k, float before)
                 { return noise.uniform(grid.linearIndex(i, j, k)) < 0.2 ? kNan : before; });
             return pair;
           });
  list.add("noise for an MR", 8,
           [](const Draw& d)
           {
             const auto pair = d.usual();
             return withoutTruth(withMr(pair, noiseLike(*pair.mr, d.seed(), 0.0, 1000.0)));
           });
  list.add("noise for a CT", 4,
           [](const Draw& d)
           {
             auto pair = d.usual();
             pair.ct = noiseLike(*pair.ct, d.seed(), -1000.0, 2000.0);
             return withoutTruth(pair);
           });
  list.add("balls for an MR", 8,
           [](const Draw& d)
           {
             const auto pair = d.usual();
             return withoutTruth(withMr(pair, ballsLike(*pair.mr, d.seed())));
           });
  list.add("MR as noisy as it is bright", 8,
           [](const Draw& d)
           {
             PairRecipe recipe = d.recipe();
             recipe.acquisition.noise = 0.5 + 0.15 * static_cast<double>(d.n);
             return simulatePair(d.body(), d.ear(), recipe);
           });
}

} // namespace petrous::registration::stress
