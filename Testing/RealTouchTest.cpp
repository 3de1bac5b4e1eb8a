#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#include <Eigen/Geometry>

#include "CommandRunner.h"
#include "SimulatedDevice.h"
#include "petrous/Library/Library.h"
#include "petrous/Presenters/RecordingPlayer.h"
#include "petrous/Session/TouchSession.h"

using namespace petrous;
using petrous::session::TickRecord;
using petrous::testing::CommandLine;
using petrous::testing::quoted;
using petrous::testing::textOf;

namespace
{

constexpr double kRadius = 2.0; // mm, of the burr

// A burr dragged over the mastoid of a real CT (Visible Human, left side).
class RealTouch : public CommandLine
{
protected:
  void SetUp() override
  {
    CommandLine::SetUp();
    const char* data = std::getenv("PETROUS_DATA");
    if (!data || !*data)
      GTEST_SKIP() << "no real data beside the project (PETROUS_DATA is not set)";
    const auto series = std::filesystem::path(data) / "ct_head_vhm/vhm_1080-1245";
    if (!std::filesystem::exists(series))
      GTEST_SKIP() << series << " is not there";
    json("new ear --ct " + quoted(series) + " --roi 285,335,245,290,1095,1160");
  }

  // An ellipse of 12 by 20 mm over the mastoid, whose surface is at x = 310 to 320 mm, once in 4 s
  // and up to about 4 mm deep for an unconstrained burr; the device rotates to and fro by 20
  // degrees. The first half second approaches from beside the head.
  static haptics::Pose handAt(double t)
  {
    const double turn = 2.0 * std::acos(-1.0) * t / 4.0;
    const Eigen::Quaterniond lateral(Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitY()));
    const Eigen::Quaterniond sway(
        Eigen::AngleAxisd(0.35 * std::sin(1.3 * turn), Eigen::Vector3d(0.0, 0.6, 0.8)));
    return {{318.5 + std::max(0.0, 12.0 - 24.0 * t), 267.0 + 6.0 * std::sin(turn),
             1128.0 + 10.0 * std::cos(turn)},
            sway * lateral};
  }
  static constexpr double kLength = 8.0; // s

  // Drills from 2 to 6 s, with a pause.
  std::filesystem::path path(bool drill) const
  {
    std::ofstream file(m_folder / "path.csv");
    file.precision(17);
    file << "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill\n";
    for (int n = 0; n <= 800; ++n)
    {
      const double t = 0.01 * n;
      const haptics::Pose pose = handAt(t);
      const auto& q = pose.rotation;
      file << t << ',' << pose.position.x() << ',' << pose.position.y() << ',' << pose.position.z()
           << ',' << q.w() << ',' << q.x() << ',' << q.y() << ',' << q.z() << ','
           << (drill && t >= 2.0 && t < 6.0 && !(t >= 3.5 && t < 4.0)) << '\n';
    }
    return m_folder / "path.csv";
  }

  struct Felt
  {
    std::size_t ticks = 0;
    std::size_t pressed = 0;
    std::size_t longest = 0;  // ticks of uninterrupted contact
    double force = 0.0;       // N
    std::size_t refilled = 0; // ticks reporting tissue restored around the tool
    std::size_t inside = 0;   // maximum number of consecutive such ticks
    double highest = -1e9; // maximum of f at any shell point in all other ticks: 0 is the surface
    double overCoupling = -1e9; // maximum excess of a wrench over the coupling's
  };

  // Contacts can only reduce the spring (Gauss' principle): with K = diag(k, k_a) and u from tool
  // to device, sqrt(W' K^-1 W) <= sqrt(u' K u), in sqrt(N mm). A tick is a sequence of motions,
  // each of which may end at contacts, so u is the longer of those at its beginning and its end.
  static double hardness(const haptics::Wrench& wrench, const haptics::ProxyParameters& k)
  {
    return std::sqrt(wrench.linear.squaredNorm() / k.stiffness +
                     wrench.angular.squaredNorm() / k.angularStiffness);
  }
  static double pull(const haptics::Pose& tool, const haptics::Pose& hand,
                     const haptics::ProxyParameters& k)
  {
    const haptics::Motion u = haptics::motionBetween(tool, hand);
    return std::sqrt(k.stiffness * u.linear.squaredNorm() +
                     k.angularStiffness * u.angular.squaredNorm());
  }

  // Replays the recording in this process and checks every tick. f is taken from the field shared
  // with the picture, not from the one used for the haptics.
  Felt examined(const std::filesystem::path& file)
  {
    library::Library library(this->library());
    scene::Case value = library.open("ear");
    library.loadDissection(value);
    session::RecordingReader reader(file);
    session::TouchScene scene(value, {}, reader.setup().scene.firstState);
    presenters::RecordingPlayer replay(value, scene, reader, "session.ticks");
    const auto& shell = scene.shellOf(presenters::toolOf(reader.setup())).points;
    EXPECT_GT(shell.size(), 100u);
    Felt result;
    std::size_t run = 0;
    std::size_t enclosed = 0;
    haptics::Pose before;
    bool hasBefore = false;
    while (const TickRecord* recorded = replay.next())
    {
      const TickRecord& felt = replay.feel();
      EXPECT_TRUE(std::memcmp(recorded, &felt, sizeof felt) == 0) << felt.number;
      const haptics::Pose tool = felt.proxy.pose();
      ++result.ticks;
      if (!hasBefore && felt.fault != 0)
        continue; // the device is not valid yet
      // Leaving tissue restored by an undo is limited by each tick's work.
      const bool inside = felt.fault == static_cast<std::uint8_t>(session::ServoFault::Inside);
      enclosed = inside ? enclosed + 1 : 0;
      result.refilled += inside;
      result.inside = std::max(result.inside, enclosed);
      for (std::size_t n = 0; n < shell.size() && !inside; ++n)
        result.highest = std::max(
            result.highest, scene.drill().field().value(tool.position + tool.rotation * shell[n]));
      result.pressed += felt.thrust > 0.0;
      run = felt.thrust > 0.0 ? run + 1 : 0;
      result.longest = std::max(result.longest, run);
      const haptics::Wrench wrench = felt.wrench.wrench();
      result.force = std::max(result.force, wrench.linear.norm());
      if (hasBefore)
        result.overCoupling =
            std::max(result.overCoupling,
                     hardness(wrench, reader.setup().proxy) -
                         std::max(pull(before, felt.mapped.pose(), reader.setup().proxy),
                                  pull(tool, felt.mapped.pose(), reader.setup().proxy)));
      before = tool;
      hasBefore = true;
    }
    EXPECT_TRUE(replay.outcome().equal()) << replay.outcome().difference;
    return result;
  }

  void expectHeld(const Felt& felt, std::size_t contact, std::size_t undone = 0)
  {
    EXPECT_LE(felt.inside, 20u) << "ticks until the tool was out of what an undo brought back";
    EXPECT_LE(felt.refilled, 20u * undone);
    EXPECT_LE(felt.highest, 1e-9) << "of f at the shell's points";
    EXPECT_GT(felt.highest, -0.05) << "it never touched";
    EXPECT_GT(felt.pressed, contact);
    EXPECT_GT(felt.force, 0.3);
    EXPECT_LE(felt.overCoupling, 1e-9);
  }

  static void report(const Felt& felt, const std::filesystem::path& file, double removed)
  {
    const double bytes = static_cast<double>(std::filesystem::file_size(file));
    std::printf("%zu ticks, %.1f bytes a tick, %zu in contact, longest %zu, largest force %.3f N, "
                "highest f %.2e, %.1f mm3 removed\n",
                felt.ticks, bytes / static_cast<double>(felt.ticks), felt.pressed, felt.longest,
                felt.force, felt.highest, removed);
  }
};

} // namespace

TEST_F(RealTouch, DraggedOverTheMastoidTheBurrIsHeldAndTheReplayIsTheRecording)
{
  for (const bool drill : {false, true})
  {
    const auto file = m_folder / (drill ? "drilled.ticks" : "dragged.ticks");
    const auto first =
        json("drill ear --path " + quoted(path(drill)) + " --record " + quoted(file));
    EXPECT_EQ(first["ticks"], 8001);
    EXPECT_EQ(first["ticks_inside"], 0);
    EXPECT_EQ(first["strokes"], drill ? 2 : 0);
    if (drill)
      json("undo ear 2");
    const auto again = json("drill ear --replay " + quoted(file));
    EXPECT_EQ(again["replay"]["equal"], true);
    for (const char* key : {"ticks", "strokes", "removed_mm3", "max_force_n", "max_torque_nmm"})
      EXPECT_EQ(again[key], first[key]) << key;
    if (drill)
      json("undo ear 2");
    const Felt felt = examined(file);
    expectHeld(felt, drill ? 2000 : 6000);
    EXPECT_EQ(felt.force, first["max_force_n"]);
    report(felt, file, first["removed_mm3"]);
  }
}

TEST_F(RealTouch, ALiveSessionOverTheMastoidIsPlayedAgainByTheCommand)
{
  const auto file = m_folder / "live.ticks";
  double removed = 0.0;
  {
    // The library's case is read but not saved: it keeps the state at the start of the recording.
    library::Library library(this->library());
    scene::Case value = library.open("ear");
    library.loadDissection(value);
    session::TouchScene scene(value);
    haptics::SimulatedDevice::Hand tremor;
    tremor.tremor = 0.05;
    double start = -1.0;
    haptics::SimulatedDevice device(
        [&start](double now)
        {
          if (start < 0.0)
            start = now;
          return handAt(now - start);
        },
        tremor, {});
    session::TouchSession::Setup setup;
    setup.tool.burr.diameter = 2.0 * kRadius;
    setup.recording = file;
    session::ServoParameters parameters;
    session::TouchSession session(value, scene, device, setup);
    const auto until = [&](double seconds)
    {
      const auto ticks = static_cast<std::uint64_t>(1000.0 * seconds);
      // Frames at 60 Hz; a stalled machine loses ticks, but the test does not fail.
      for (int n = 0; session.state().ticks < ticks && n < 4000; ++n)
      {
        EXPECT_EQ(session.advance().recordingFault, "");
        std::this_thread::sleep_for(std::chrono::milliseconds(16));
      }
    };
    until(2.0);
    parameters.drill = 1;
    session.setParameters(parameters);
    until(3.0);
    session.undo(); // in contact, while drilling
    until(4.0);
    parameters.drill = 0;
    session.setParameters(parameters);
    until(5.0);
    session.undo();
    until(5.2);
    session.redo();
    until(6.0);
    const auto news = session.stop();
    EXPECT_EQ(news.recordingFault, "");
    removed = value.removedVolume();
  }
  const Felt felt = examined(file);
  expectHeld(felt, 3000, 2);
  const auto again = json("drill ear --replay " + quoted(file));
  EXPECT_EQ(again["replay"]["equal"], true);
  EXPECT_EQ(again["replay"]["session"], "live session");
  EXPECT_EQ(again["ticks"], felt.ticks);
  EXPECT_GT(removed, 0.1);
  EXPECT_EQ(again["removed_mm3"], removed);
  EXPECT_EQ(again["max_force_n"], felt.force);
  report(felt, file, removed);
}
