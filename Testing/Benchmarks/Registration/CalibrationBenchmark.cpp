#include <Eigen/Geometry>

#include "CounterNoise.h"
#include "RegistrationBenchmark.h"
#include "petrous/Registration/Register.h"

namespace petrous::registration
{

namespace
{

constexpr double kDegree = 3.14159265358979323846 / 180.0;

// A random pair over the range met in practice: contrast, noise, slices, tilt, fields of view,
// motion.
RegistrationPair drawn(const SimulationBody& body, std::uint64_t seed)
{
  const CounterNoise draw(seed * 13 + 4);
  const std::size_t ear = static_cast<std::size_t>(draw.bits(0) % body.ears.size());
  PairRecipe recipe = usualRecipe(body, ear, seed);
  MrAcquisition& a = recipe.acquisition;
  const auto bounds = body.ct->geometry().patientBounds();
  const Vector3d size = bounds.sizes();
  const double fine = a.spacing[0];
  a.spacing.head<2>().setConstant(fine * draw.uniform(1, 0.7, 1.3));
  a.spacing[2] = draw.uniform(2, 1.0, std::min(6.0, 5.0 * fine));
  a.noise = draw.uniform(3, 0.01, 0.15);
  a.bias = draw.uniform(4, 0.0, 0.5);
  a.axes = (Eigen::AngleAxisd(draw.uniform(5, -25.0, 25.0) * kDegree, Vector3d::UnitX()) *
            Eigen::AngleAxisd(draw.uniform(6, -8.0, 8.0) * kDegree, Vector3d::UnitY()))
               .toRotationMatrix();
  a.mrFromCt = randomMotion(body.ears[ear], draw.uniform(7, 0.0, 20.0), draw.uniform(8, 0.0, 15.0),
                            seed * 13 + 5);
  // A slab over the ears, in every second pair.
  if (draw.uniform(9) < 0.5)
  {
    a.center[2] = body.ears[ear][2] + draw.uniform(10, -10.0, 10.0);
    a.extent[2] = std::min(a.extent[2], draw.uniform(11, 35.0, 80.0));
  }
  // A CT of the temporal bone only, in every third pair.
  if (draw.uniform(12) < 0.33)
  {
    recipe.ctExtent = size.cwiseMin(draw.uniform(13, 0.8, 1.4) * Vector3d(70.0, 80.0, 55.0));
    recipe.ctCenter = body.ears[ear];
  }
  return simulatePair(body, ear, recipe);
}

// Share of the points at a distance (mm) from the target, along the CT's six directions, where the
// true error is within the p95 that the spread states there.
double coveredAt(const RegistrationPair& pair, const Registration& result, double distance)
{
  const Vector3d& target = pair.targets.front();
  int covered = 0;
  for (int n = 0; n < 6; ++n)
  {
    const Vector3d at = target + (n % 2 == 0 ? distance : -distance) * Vector3d::Unit(n / 2);
    const double error = (result.fit.mrFromCt * at - pair.truth(at)).norm();
    const Eigen::Matrix3d moments = core::displacementMoments(*result.error.spread, at);
    covered += error <= core::lengthQuantile(moments, core::kNormal95) ? 1 : 0;
  }
  return covered / 6.0;
}

} // namespace

std::vector<core::BenchmarkPoint> calibrationPoints(const BenchmarkInput& input,
                                                    const core::Progress& progress)
{
  const std::size_t count = input.quick ? 3 : 240;
  std::vector<core::BenchmarkPoint> points;
  for (std::size_t n = 0; n < count; ++n)
  {
    progress.report(static_cast<double>(n) / static_cast<double>(count), "calibration");
    const SimulationBody& body = input.bodies[n % input.bodies.size()];
    const RegistrationPair pair = drawn(body, 2000 + n);
    const Registration result = registerRigid(*pair.ct, *pair.mr, {}, pair.targets.front());
    core::BenchmarkPoint point;
    point.scene = "calibration";
    const core::GridGeometry& grid = pair.mr->geometry();
    point.setting = {{"pair", std::to_string(n + 1)},
                     {"images", pair.name},
                     {"verdict", nameOf(result.verdict)}};
    point.seconds = result.fit.seconds + result.estimateSeconds;
    point.error = errorOf(pair, result.fit.mrFromCt).target;
    point.errorUnit = "mm at the target";
    point.extra = {{"median_mm", result.error.median},
                   {"p95_mm", result.error.p95},
                   {"max_mm", result.error.max},
                   {"slice_mm", grid.spacing()[2]},
                   {"in_plane_mm", grid.spacing()[0]},
                   {"overlap", result.fit.overlap},
                   {"covered", point.error <= result.error.p95 ? 1.0 : 0.0}};
    if (result.error.spread) // else the error is stated at the target alone
      for (const int distance : {30, 60, 90})
        point.extra["covered_at_" + std::to_string(distance) + "_mm"] =
            coveredAt(pair, result, distance);
    points.push_back(std::move(point));
  }
  return points;
}

} // namespace petrous::registration
