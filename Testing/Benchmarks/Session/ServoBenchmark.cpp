#include "ServoBenchmark.h"

#include <algorithm>
#include <cmath>

#include "SimulatedDevice.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/TickTimes.h"
#include "petrous/Haptics/ConstrainedProxy.h"
#include "petrous/Session/BurrRemovalModel.h"
#include "petrous/Session/DissectionLoop.h"
#include "petrous/Session/RecordingReplay.h"
#include "petrous/Session/RecordingWriter.h"

namespace petrous::session
{

namespace
{

core::GridGeometry gridOf(double h)
{
  const int n = static_cast<int>(18.0 / h) + 1;
  return {{n, n, n}, Eigen::Vector3d::Constant(h), Eigen::Vector3d(-9.0, -9.0, -15.0)};
}

// Bone below z = 0, its surface a ramp of a voxel or two, as in a scan.
volume::TissueField boneOn(const core::GridGeometry& grid)
{
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid);
  for (int k = 0; k < grid.dims()[2]; ++k)
  {
    const double z = grid.patientFromVoxel({0.0, 0.0, 1.0 * k}).z();
    const double hu = std::clamp(300.0 - 2000.0 * z, -1000.0, 1500.0);
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
        voxels->at(i, j, k) = static_cast<std::int16_t>(hu);
  }
  return {std::make_shared<volume::IntensityVolume>(
              std::shared_ptr<const volume::Volume<std::int16_t>>(voxels)),
          {},
          nullptr,
          {}};
}

struct Block
{
  explicit Block(double h)
    : work(gridOf(h))
    , mask(std::make_shared<volume::PublishedMask>(work.mask()))
    , shell(haptics::makeBurrShell({}, h))
    , tissue(boneOn(work.mask().geometry()))
    , tool(std::make_unique<haptics::ConstrainedProxy>(
          std::make_shared<haptics::HapticField>(tissue, mask), shell))
    , resistance(tissue.ct(), {300.0, 1800.0, 741.0, 2224.0}, {}) // N/mm2, of a cutting burr
    , search(tissue, resistance, {}, 2.0)
    , removalModel(search, {}, h)
  {
  }

  dissection::Dissection work;
  std::shared_ptr<volume::PublishedMask> mask;
  haptics::PointShell shell;
  volume::TissueField tissue;
  std::unique_ptr<haptics::ConstrainedProxy> tool;
  dissection::TissueResistance resistance;
  dissection::RemovalDepthSolver search;
  BurrRemovalModel removalModel;
};

haptics::Pose handAt(double t)
{
  return {{4.0 * std::sin(1.7 * t), 4.0 * std::cos(2.3 * t), 1.0 + std::sin(2.0 * t)},
          Eigen::Quaterniond(Eigen::AngleAxisd(0.5 * std::sin(t), Eigen::Vector3d(0.6, 0.8, 0.0)))};
}

// Synchronous: each cut is made and written before the next tick.
DissectionLoop::Hooks to(RecordingWriter& writer, core::TickTimes& writing)
{
  DissectionLoop::Hooks hooks;
  hooks.edited = [&writer, &writing](const MaskEdit& edit)
  { writing.take([&] { writer.add(edit); }); };
  return hooks;
}

core::BenchmarkPoint measure(double h, const std::filesystem::path& file, int ticks)
{
  Block block(h);
  RecordingSetup setup;
  setup.servo.burrPoints = block.shell.burrCount;
  setup.servo.passivity.emplace();
  setup.servo.limits.maxForce = 10.0;
  Servo servo(*block.tool, setup.servo);
  RecordingWriter writer(file, setup);
  core::TickTimes tick, writing;
  DissectionLoop loop(block.work, *block.mask, block.removalModel, {}, to(writer, writing));
  haptics::SimulatedDevice::Hand hand;
  hand.tremor = 0.05;
  haptics::SimulatedDevice device(handAt, hand, {});
  ServoParameters parameters;
  for (int n = 0; n < ticks; ++n)
  {
    const double now = 0.001 * n;
    parameters.drill = n % 1000 > 500 ? 1 : 0;
    const TickRecord& record = tick.take(
        [&]() -> const TickRecord&
        {
          const TickRecord& made = servo.tick(TickInput::of(now, device.read(now), parameters));
          device.send(made.output.wrench());
          return made;
        });
    writing.take([&] { writer.add(record); });
    loop.step(record);
  }
  writer.close();

  Block again(h);
  Servo other(*again.tool, setup.servo);
  DissectionLoop otherLoop(again.work, *again.mask, again.removalModel);
  RecordingReader reader(file);
  RecordingReplay replay(reader, other, otherLoop);
  while (replay.next())
    replay.feel();

  core::BenchmarkPoint point;
  point.setting["voxel_mm"] = core::fixedText(h, 2);
  point.scene = "4 mm burr drilling a block, hand with tremor";
  point.isDefault = h == 0.3;
  point.seconds = tick.wall(0.5);
  point.error = 100.0 * static_cast<double>(replay.outcome().different) / ticks;
  point.errorUnit = "% of the ticks that a replay gives otherwise";
  point.extra["tick_p99_us"] = 1e6 * tick.wall(0.99);
  point.extra["tick_max_us"] = 1e6 * tick.wall(1.0);
  point.extra["cuts"] = static_cast<double>(loop.cuts());
  point.extra["recorded_bytes_per_tick"] = static_cast<double>(writer.bytes()) / ticks;
  point.extra["recording_us_per_tick"] = 1e6 * writing.wallSum() / ticks;
  point.extra["recording_us_max"] = 1e6 * writing.wall(1.0);
  return point;
}

} // namespace

core::BenchmarkReport runServoBenchmark(const std::filesystem::path& work, bool quick,
                                        const core::Progress& progress)
{
  core::BenchmarkReport report{"servo", "A servo tick and its recording", {}};
  const std::vector<double> spacings =
      quick ? std::vector<double>{0.3} : std::vector<double>{0.15, 0.2, 0.3, 0.4};
  for (std::size_t n = 0; n < spacings.size(); ++n)
  {
    progress.report(static_cast<double>(n) / static_cast<double>(spacings.size()),
                    "drilling blocks");
    report.points.push_back(measure(spacings[n], work / "servo.ticks", quick ? 2000 : 10000));
  }
  return report;
}

} // namespace petrous::session
