#include "TouchTicks.h"

#include <algorithm>
#include <cmath>

#include "CutBall.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/TickTimes.h"
#include "petrous/Haptics/ConstrainedProxy.h"

namespace petrous::haptics
{

namespace
{

using Eigen::Vector3d;

constexpr double kCircle = 2.0;    // mm, radius of the device's path
constexpr double kDescent = 0.1;   // mm per tick
constexpr double kFarthest = 30.0; // mm, to the tissue
constexpr double kTwoPi = 6.283185307179586;

double bumps(const Vector3d& p)
{
  return 0.4 * std::sin(1.3 * p.x()) * std::cos(1.1 * p.y()) + 0.2 * std::sin(2.9 * p.y() + p.x());
}

// A structure protruding from the bone, as in a smoothed union.
std::shared_ptr<const volume::Volume<float>> structureOn(const core::GridGeometry& grid)
{
  auto share = std::make_shared<volume::Volume<float>>(grid);
  const core::Index3& n = grid.dims();
  const double h = grid.minSpacing();
  for (int k = 1; k < n[2] - 1; ++k)
    for (int j = 1; j < n[1] - 1; ++j)
      for (int i = 1; i < n[0] - 1; ++i)
      {
        const Vector3d p = grid.patientFromVoxel(Vector3d(i, j, k));
        const double d = 2.5 - (p - Vector3d(2.0, 1.0, -1.6)).norm();
        share->at(i, j, k) = static_cast<float>(std::clamp(0.5 + d / (3.0 * h), 0.0, 1.0));
      }
  return share;
}

// Moves the tool until contact; returns the distance moved, < 0 without contact.
double descend(ConstrainedProxy& proxy, const Pose& from, const Vector3d& toward)
{
  proxy.place(from);
  for (double way = 0.0; way < kFarthest; way += kDescent)
  {
    const Pose goal{from.position + way * toward, from.rotation};
    if (proxy.step(goal).contactCount > 0)
      return way;
  }
  return -1.0;
}

struct Slide
{
  core::TickTimes times;
  double deepest = -1.0;
  long touched = 0;
  long rounds = 0;
  double force = 0.0;          // N, mean
  std::vector<double> samples; // of the field, per tick

  double samplesAt(double share)
  {
    if (samples.empty())
      return 0.0;
    const auto place = samples.begin() +
                       static_cast<std::ptrdiff_t>(share * static_cast<double>(samples.size() - 1));
    std::nth_element(samples.begin(), place, samples.end());
    return *place;
  }
};

// The device moves on a circle perpendicular to `toward`, 1 to 2 mm deeper than the tool.
void slide(ConstrainedProxy& proxy, const TouchScene::Start& start, double speed, int ticks,
           Slide& result)
{
  const Vector3d toward = start.toward.normalized();
  const Eigen::Quaterniond rotation =
      Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), Vector3d(-toward));
  if (descend(proxy, {start.position, rotation}, toward) < 0.0)
    return;
  const Vector3d across = rotation * Vector3d::UnitX();
  const Vector3d aside = rotation * Vector3d::UnitY();
  const HapticField& field = proxy.field();
  for (int t = 0; t < ticks; ++t)
  {
    const double angle = speed * t / kCircle;
    const double press = 1.5 + 0.5 * std::sin(0.7 * angle);
    Pose goal;
    goal.rotation = rotation * rotationFrom(Vector3d(0.05 * std::sin(angle), 0.0, 0.1 * angle));
    goal.position = start.position +
                    kCircle * (std::sin(angle) * across + (1.0 - std::cos(angle)) * aside) +
                    ((proxy.pose().position - start.position).dot(toward) + press) * toward;
    const ProxyTick& tick =
        result.times.take([&]() -> const ProxyTick& { return proxy.step(goal); });
    result.touched += tick.contactCount > 0;
    result.rounds += tick.rounds;
    result.force += tick.wrench.linear.norm();
    result.samples.push_back(static_cast<double>(tick.samples));
    if (t % 20 != 0)
      continue;
    const volume::MaskState& mask = *field.mask().acquire();
    for (const Vector3d& point : proxy.shell().points)
      result.deepest =
          std::max(result.deepest,
                   field.sample(field.geometry().voxelFromPatient(tick.pose * point), mask).value);
    field.mask().release();
  }
}

} // namespace

TouchScene bumpyBone()
{
  const auto ct = testing::scanOf([](const Vector3d& p) { return bumps(p) - p.z(); }, 0.3, 15.0);
  testing::Scene scene = testing::sceneOf(ct, {structureOn(ct->geometry())});
  for (int n = 0; n < 40; ++n)
    testing::cutBall(scene, Vector3d(-4.0 + 0.2 * n, -1.5 + 0.05 * n, 1.2), 1.5);
  TouchScene result{"bumpy bone 101^3, structure, groove", scene.field, {}};
  for (int n = 0; n < 4; ++n)
    result.starts.push_back({{2.5 * std::cos(kTwoPi * n / 4), 2.5 * std::sin(kTwoPi * n / 4), 5.0},
                             {0.1 * n, -0.1, -1.0}});
  return result;
}

std::vector<core::BenchmarkPoint> touchTicks(const TouchScene& scene, bool quick,
                                             const core::Progress& progress)
{
  const PointShell shell = makeBurrShell({}, scene.field->voxel());
  const int ticks = quick ? 500 : 10000; // per start position
  std::vector<core::BenchmarkPoint> points;
  for (const double speed : {0.05, 0.1, 0.2}) // m/s, i.e. mm/tick
  {
    progress.report(static_cast<double>(points.size()) / 3.0, "sliding over " + scene.name);
    Slide all;
    ConstrainedProxy proxy(scene.field, shell);
    for (const TouchScene::Start& start : scene.starts)
    {
      progress.check("the benchmark of touch");
      slide(proxy, start, speed, ticks, all);
    }
    core::BenchmarkPoint point;
    const std::string text = core::fixedText(speed, 2);
    point.scene = "burr of 4 mm, " + scene.name + ", " + text + " m/s";
    point.setting["speed_m_s"] = text;
    point.setting["shell_points"] = std::to_string(shell.points.size());
    point.isDefault = true;
    all.times.enter(point);
    point.error = std::max(0.0, all.deepest);
    point.errorUnit = "f at the deepest shell point";
    const double count = std::max(1.0, static_cast<double>(all.samples.size()));
    point.extra["in_contact_share"] = static_cast<double>(all.touched) / count;
    point.extra["rounds_mean"] = static_cast<double>(all.rounds) / count;
    point.extra["force_mean_n"] = all.force / count;
    point.extra["samples_p50"] = all.samplesAt(0.5);
    point.extra["samples_p99.9"] = all.samplesAt(0.999);
    point.extra["samples_max"] = all.samplesAt(1.0);
    points.push_back(std::move(point));
  }
  return points;
}

} // namespace petrous::haptics
