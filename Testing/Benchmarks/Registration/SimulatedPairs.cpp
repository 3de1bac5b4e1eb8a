#include "SimulatedPairs.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "CounterNoise.h"

namespace petrous::registration
{

namespace
{

constexpr double kDegree = 3.14159265358979323846 / 180.0;

template <class Make>
auto floatsOn(const core::GridGeometry& grid, const Make& make)
{
  auto voxels = std::make_shared<volume::Volume<float>>(grid);
  const core::Index3& n = grid.dims();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        voxels->at(i, j, k) = make(i, j, k);
  return std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<float>>(std::move(voxels)));
}

} // namespace

std::shared_ptr<const volume::IntensityVolume>
croppedTo(const volume::IntensityVolume& image, const Vector3d& center, const Vector3d& extent)
{
  const core::IndexBox box =
      image.geometry().boxCovering(center - 0.5 * extent, center + 0.5 * extent);
  return image.visit(
      [&](const auto& from)
      {
        using Voxels = std::decay_t<decltype(from)>;
        auto part = std::make_shared<Voxels>(from.geometry().cropped(box));
        const core::Index3& n = part->geometry().dims();
        for (int k = 0; k < n[2]; ++k)
          for (int j = 0; j < n[1]; ++j)
            std::copy_n(&from.at(box.lower[0], box.lower[1] + j, box.lower[2] + k), n[0],
                        &part->at(0, j, k));
        return std::make_shared<const volume::IntensityVolume>(
            std::shared_ptr<const Voxels>(std::move(part)), image.padding());
      });
}

std::shared_ptr<const volume::IntensityVolume>
changed(const volume::IntensityVolume& image,
        const std::function<float(int, int, int, float)>& value)
{
  return floatsOn(image.geometry(), [&](int i, int j, int k)
                  { return value(i, j, k, static_cast<float>(image.at(i, j, k))); });
}

std::shared_ptr<const volume::IntensityVolume> flipped(const volume::IntensityVolume& image,
                                                       int axis, bool header)
{
  const core::GridGeometry& grid = image.geometry();
  const auto a = static_cast<std::size_t>(axis);
  const int last = grid.dims()[a] - 1;
  Eigen::Matrix3d direction = grid.direction();
  Vector3d origin = grid.origin();
  if (header)
  {
    origin += grid.patientFromVoxelLinear().col(axis) * last;
    direction.col(axis) *= -1.0;
  }
  return floatsOn(core::GridGeometry(grid.dims(), grid.spacing(), origin, direction),
                  [&](int i, int j, int k)
                  {
                    core::Index3 at{i, j, k};
                    at[a] = last - at[a];
                    return static_cast<float>(image.at(at[0], at[1], at[2]));
                  });
}

std::shared_ptr<const volume::IntensityVolume> relaid(const volume::IntensityVolume& image,
                                                      const core::GridGeometry& grid)
{
  return floatsOn(grid, [&](int i, int j, int k) { return static_cast<float>(image.at(i, j, k)); });
}

RegistrationPair simulatePair(const SimulationBody& body, std::size_t ear, const PairRecipe& recipe)
{
  const auto& contrast = body.contrasts[recipe.contrast % body.contrasts.size()];
  SimulatedMr mr = acquireMr(*contrast.image, recipe.acquisition);
  RegistrationPair pair;
  pair.name = body.name + ", " + contrast.name;
  pair.ct = recipe.ctExtent ? croppedTo(*body.ct, recipe.ctCenter, *recipe.ctExtent) : body.ct;
  pair.mr = mr.volume;
  pair.truth = mr.truth;
  pair.targets = {body.ears[ear % body.ears.size()]};
  return pair;
}

PairRecipe usualRecipe(const SimulationBody& body, std::size_t ear, std::uint64_t seed)
{
  const CounterNoise draw(seed * 7 + 1);
  const auto bounds = body.ct->geometry().patientBounds();
  const Vector3d size = bounds.sizes();
  PairRecipe recipe;
  recipe.contrast = static_cast<std::size_t>(draw.bits(0) % body.contrasts.size());
  MrAcquisition& a = recipe.acquisition;
  a.extent = (size + Vector3d::Constant(10.0)).cwiseMin(Vector3d(180.0, 220.0, 140.0));
  // Smaller voxels for a small body.
  const double fine = std::clamp(a.extent.minCoeff() / 100.0, 0.6, 1.2);
  a.spacing = fine * Vector3d(1.0, 1.0, 2.5);
  a.center = bounds.center();
  a.axes = Eigen::AngleAxisd(draw.uniform(1, -12.0, 12.0) * kDegree, Vector3d::UnitX()).matrix();
  a.mrFromCt = randomMotion(body.ears[ear % body.ears.size()], 8.0, 6.0, seed * 7 + 2);
  a.noise = draw.uniform(2, 0.02, 0.06);
  a.seed = seed;
  return recipe;
}

} // namespace petrous::registration
