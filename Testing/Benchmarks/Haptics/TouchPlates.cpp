#include "TouchPlates.h"

#include <array>
#include <atomic>

#include <tbb/parallel_for.h>

#include "ProxyChecks.h"
#include "SteppedSphere.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/TickTimes.h"
#include "petrous/Haptics/PointProxy.h"

namespace petrous::haptics
{

namespace
{

using Eigen::Vector3d;

constexpr double kVoxel = 0.3;     // mm
constexpr double kRadius = 1.0;    // mm, of the burr
constexpr double kReach = 3.5;     // mm, of the tool
constexpr double kWithin = 3.0;    // mm, range of the device
constexpr double kSlope = 0.4;     // slope of f per mm: 400 HU/mm over 1000 HU
constexpr std::size_t kPhases = 4; // sub-voxel positions of the plate, for each thickness
enum Program : std::size_t
{
  SixDof,
  ThreeDof,
  Stepped,
  kPrograms
};

struct Walk
{
  long crossings = 0; ///< of the plate, in both directions
  long crossed = 0;   ///< ticks spent beyond it
  long touched = 0;
  double deepest = -1.0; ///< mm
  core::TickTimes times;

  void add(const Walk& other)
  {
    crossings += other.crossings;
    crossed += other.crossed;
    touched += other.touched;
    deepest = std::max(deepest, other.deepest);
    times.add(other.times);
  }
};

// The side is determined by the ball's centre, and by every shell point in six degrees of freedom.
Walk walk(Proxy& proxy, const PointShell& shell, bool anyPoint, const volume::TissueField& tissue,
          const Vector3d& normal, double offset, unsigned seed, long ticks)
{
  const Pose start{(offset + 1.8) * normal,
                   Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), normal)};
  proxy.place(start);
  testing::RandomHand hand(seed, start, kWithin);
  Walk result;
  bool beyond = false;
  for (long t = 0; t < ticks; ++t)
  {
    const Pose& goal = hand.tick();
    const ProxyTick& tick =
        result.times.take([&]() -> const ProxyTick& { return proxy.step(goal); });
    result.touched += tick.contactCount > 0;
    double lowest = normal.dot(tick.pose.position) - offset;
    if (anyPoint)
      for (const Vector3d& point : shell.points)
      {
        const Vector3d p = tick.pose * point;
        const double height = normal.dot(p) - offset;
        lowest = std::min(lowest, height);
        if (std::abs(height) < 3.0 * kVoxel)
          result.deepest = std::max(result.deepest, tissue.value(p) / kSlope);
      }
    result.crossings += beyond != (lowest < 0.0);
    beyond = lowest < 0.0;
    result.crossed += beyond;
  }
  return result;
}

core::BenchmarkPoint pointOf(const Walk& walk, double thickness, Program program)
{
  core::BenchmarkPoint point;
  point.scene = std::string("random hand") + (program == ThreeDof ? ", burr alone" : "") +
                ", plate of " + core::fixedText(thickness, 1) + " voxels";
  point.setting["voxel_mm"] = "0.3";
  if (program == Stepped)
    point.peer = "stepped sphere, no sweep";
  point.isDefault = program == SixDof;
  walk.times.enter(point);
  point.error = static_cast<double>(walk.crossings);
  point.errorUnit = "crossings";
  point.extra["ticks_beyond"] = static_cast<double>(walk.crossed);
  point.extra["ticks_in_contact"] = static_cast<double>(walk.touched);
  if (program == SixDof)
    point.extra["deepest_voxels"] = walk.deepest / kVoxel;
  return point;
}

} // namespace

std::vector<core::BenchmarkPoint> touchPlates(bool quick, const core::Progress& progress)
{
  constexpr std::array<double, 3> thicknesses{1.0, 1.5, 2.0};
  const long ticks = (quick ? 10000 : 1000000) / static_cast<long>(thicknesses.size() * kPhases);
  std::array<std::array<std::array<Walk, kPrograms>, kPhases>, thicknesses.size()> walks;
  std::atomic<int> done{0};
  tbb::parallel_for(
      std::size_t{0}, thicknesses.size() * kPhases,
      [&](std::size_t n)
      {
        const std::size_t which = n / kPhases;
        const std::size_t phase = n % kPhases;
        const Vector3d normals[] = {
            {0.0, 0.0, 1.0}, {0.3, -0.5, 0.8}, {1.0, 1.0, 1.0}, {-0.7, 0.2, 0.1}};
        const Vector3d normal = normals[phase].normalized();
        const double offset = kVoxel * (0.13 + 0.21 * static_cast<double>(phase + which));
        const auto centred = testing::plate(normal, thicknesses[which] * kVoxel);
        const testing::Scene scene = testing::sceneOf(
            testing::scanOf([&](const Vector3d& p) { return centred(p - offset * normal); }, kVoxel,
                            kWithin + kReach + 1.5));
        const auto seed = static_cast<unsigned>(n + 1);
        const PointShell burr = testing::shortBurr(kRadius, kReach, kVoxel, 500);
        ConstrainedProxy ours(scene.field, burr);
        auto& of = walks[which][phase];
        of[SixDof] = walk(ours, burr, true, *scene.tissue, normal, offset, seed, ticks);
        const PointShell ball = testing::ballShell(kRadius, 300);
        CentreBurr alone;
        alone.radius = kRadius;
        PointProxy centre(scene.field, alone);
        of[ThreeDof] = walk(centre, ball, false, *scene.tissue, normal, offset, seed, ticks);
        SteppedSphere peer(scene.field, ball);
        of[Stepped] = walk(peer, ball, false, *scene.tissue, normal, offset, seed, ticks);
        progress.report(static_cast<double>(++done) / (thicknesses.size() * kPhases),
                        "a hand at random over thin plates");
      });
  std::vector<core::BenchmarkPoint> points;
  for (std::size_t which = 0; which < thicknesses.size(); ++which)
    for (const Program program : {SixDof, ThreeDof, Stepped})
    {
      Walk all;
      for (std::size_t phase = 0; phase < kPhases; ++phase)
        all.add(walks[which][phase][program]);
      points.push_back(pointOf(all, thicknesses[which], program));
    }
  return points;
}

} // namespace petrous::haptics
