// A session with each device server against its stand-in, recorded and replayed as the program does
// it. What the recording must hold is known from what the stand-in was told and what it received.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "BoneCase.h"
#include "FakeTracker.h"
#include "StandInVendor/VendorBench.h"
#include "petrous/Presenters/DeviceMapping.h"
#include "petrous/Presenters/RecordingPlayer.h"
#include "petrous/Presenters/SessionReview.h"

using namespace petrous;
using namespace petrous::devices::testing;
using devices::ServedDevice;
using Eigen::Vector3d;
using haptics::DeviceHealth;
using presenters::testing::block;
using presenters::testing::kTop;
using session::TickRecord;

namespace
{

constexpr double kRadius = 2.0; // mm, of the burr
constexpr double kAbove = 2.0;  // mm of the tool, above the bone with the hand at its origin
constexpr double kScale = 0.5;  // mm of the tool per mm of the hand
constexpr double kTouches = -kAbove / kScale; // mm, z of the hand where the burr touches the bone
constexpr double kStep = 0.02;                // mm of the hand in a step of the script
constexpr int kFadeOut = 25; // ticks after a fault until no force is left: 20 ms, and some

// What the hand does along the protocol's z, and what is done to its device.
class ScriptedHand
{
public:
  virtual ~ScriptedHand() = default;

  virtual ServedDevice::Options options() = 0;
  virtual std::optional<double> stiffness() const = 0; // N/mm, by the vendor; none without forces
  virtual void hold() = 0;                             // again what it was told last
  virtual void lose(bool lost) = 0;                    // unplugged
  virtual void breakDown(bool broken) = 0;             // reports that it does not work
  virtual bool hasButton() const = 0;
  virtual void press(bool) {}
  virtual double force() const { return 0.0; } // N along +z, as the device has it

  /// The next place; what the protocol must carry is kept.
  void place(double z)
  {
    m_z = z;
    m_told.push_back(tell(z));
  }
  double z() const { return m_z; }
  const std::vector<double>& told() const { return m_told; } // mm, in order

protected:
  virtual double tell(double z) = 0; // returns z as the server is to convert it, to the bit

private:
  double m_z = 0.0;
  std::vector<double> m_told;
};

// Which axis of the SDK is +z, to the user, by the vendor's manual.
struct SdkAxis
{
  std::size_t index;
  double sign;
  double stiffness; // N/mm, of the model that the stand-in plays
};

class VendorHand final : public ScriptedHand
{
public:
  VendorHand(const Vendor& vendor, const SdkAxis& axis, const std::vector<double>& quarterTurn)
    : m_vendor(vendor)
    , m_axis(axis)
    , m_bench(vendor)
  {
    for (std::size_t n = 0; n < quarterTurn.size(); ++n)
      m_bench->rotation[n] = quarterTurn[n];
    place(0.0);
  }
  ServedDevice::Options options() override
  {
    return m_bench.options(std::string("session-") + m_vendor.name);
  }
  std::optional<double> stiffness() const override { return m_axis.stiffness; }
  void hold() override {}
  void lose(bool lost) override { m_bench->plugged = lost ? 0 : 1; }
  void breakDown(bool broken) override
  {
    (*m_bench.operator->()).*m_vendor.forces = broken ? m_vendor.off : 1 - m_vendor.off;
  }
  bool hasButton() const override { return true; }
  void press(bool down) override { m_bench->buttons = down ? 1U : 0U; }
  double force() const override { return m_axis.sign * m_bench->force[m_axis.index]; }

private:
  double tell(double z) override
  {
    const double placed = m_axis.sign * z / m_vendor.unit;
    m_bench->position[m_axis.index] = placed;
    return m_axis.sign * m_vendor.unit * placed;
  }

  const Vendor& m_vendor;
  SdkAxis m_axis;
  VendorBench m_bench;
};

class TrackedHand final : public ScriptedHand
{
public:
  TrackedHand() { place(0.0); }
  ServedDevice::Options options() override
  {
    m_on = true;
    return m_tracker.options("session-tracker");
  }
  std::optional<double> stiffness() const override { return std::nullopt; }
  void hold() override { send(); }
  void lose(bool lost) override
  {
    m_on = !lost;
    if (lost)
      m_tracker.hangUp();
  }
  void breakDown(bool broken) override { m_seen = !broken; }
  bool hasButton() const override { return false; }

private:
  double tell(double z) override
  {
    m_z = static_cast<float>(z);
    send();
    return static_cast<double>(m_z);
  }
  void send()
  {
    const Bytes pose = with(bytesOf(kTransform), 9, {0.0F, 0.0F, m_z});
    if (m_on)
      m_tracker.send(m_seen ? pose : withMetadata(pose, {{"TransformStatus", "MISSING"}}));
  }

  FakeTracker m_tracker;
  float m_z = 0.0F;
  bool m_on = false; // the server may connect
  bool m_seen = true;
};

struct Server
{
  const char* name;
  std::function<std::unique_ptr<ScriptedHand>()> hand;
};

void PrintTo(const Server& server, std::ostream* out)
{
  *out << server.name;
}

std::vector<Server> servers()
{
  const double half = std::sqrt(0.5);
  // Each a quarter turn about +z in the SDK's own axes.
  std::vector<Server> all = {
      {"ForceDimension",
       []
       {
         return std::make_unique<VendorHand>(kForceDimension, SdkAxis{0, 1.0, 4.0},
                                             std::vector<double>{1, 0, 0, 0, 0, -1, 0, 1, 0});
       }},
      {"Touch",
       []
       {
         return std::make_unique<VendorHand>(kTouch, SdkAxis{2, 1.0, 0.5},
                                             std::vector<double>{0, -1, 0, 1, 0, 0, 0, 0, 1});
       }},
      {"OpenIgtLink", [] { return std::make_unique<TrackedHand>(); }}};
#ifdef PETROUS_INVERSE3_SERVER
  all.push_back({"Inverse3", [half]
                 {
                   return std::make_unique<VendorHand>(kInverse3, SdkAxis{1, -1.0, 1.0},
                                                       std::vector<double>{half, 0.0, -half, 0.0});
                 }});
#else
  static_cast<void>(half);
#endif
  return all;
}

/// Between two places where the burr rests on bone, without a fault.
struct Rests
{
  std::uint64_t first, second; // numbers of ticks
  double moved;                // mm, of the hand
};

class ServedSession : public ::testing::TestWithParam<Server>
{
protected:
  void SetUp() override { std::filesystem::create_directories(m_folder); }
  void TearDown() override { std::filesystem::remove_all(m_folder); }

  // Threads of the program: the servo's and that of removal. This one is the hand and the window.
  void perform(scene::Case& value)
  {
    session::TouchScene scene(value);
    m_hand = GetParam().hand();
    ServedDevice device(m_hand->options());
    presenters::DeviceMapping mapping;
    mapping.scale = kScale;
    core::CameraPose camera; // its axes are the patient's
    camera.position = {6.0, 6.0, 100.0};
    camera.focalPoint = {6.0, 6.0, 0.0};
    camera.viewUp = {0.0, 1.0, 0.0};
    session::TouchSession::Setup setup;
    setup.tool.mode = session::TouchTool::Mode::SixDof;
    setup.tool.burr.diameter = 2.0 * kRadius;
    setup.tool.burr.rpm = 600000.0; // ten times as fast, to shorten the test
    setup.center = {6.0, 6.0, kTop + kRadius + kAbove};
    setup.recording = m_file;
    presenters::fit(setup, device.description(), mapping, false);
    m_parameters = presenters::parametersFor(device.description(), mapping, camera);
    setup.parameters = m_parameters;
    m_thrust = mapping.thrust;
    session::TouchSession session(value, scene, device, setup);
    m_session = &session;
    std::thread watch([this] { watchForces(); });
    act();
    m_watching = false;
    watch.join();
    const auto news = session.stop();
    EXPECT_EQ(news.recordingFault, "");
    EXPECT_EQ(session.state().dropped, 0U);
    EXPECT_EQ(session.recording()->ticks(), session.state().ticks);
    m_session = nullptr;
  }

  void act()
  {
    ASSERT_TRUE(becomes(DeviceHealth::Good)) << "at its origin";
    ASSERT_TRUE(rests()) << "the force has faded in";
    // On the bone, in two depths.
    go(kTouches - 1.0);
    for (int n = 0; n < 10 && m_rests.empty() && m_hand->stiffness(); ++n)
    {
      ASSERT_TRUE(rests());
      const std::uint64_t first = m_record.number;
      const std::size_t faults = m_faults;
      go(m_hand->z() - 1.0);
      ASSERT_TRUE(rests());
      if (m_faults == faults) // of a machine that was busy
        m_rests.push_back({first, m_record.number, -1.0});
    }
    // A stroke.
    const std::uint64_t before = m_record.maskState;
    drill(true);
    ASSERT_TRUE(until([&] { return m_record.drill && m_record.maskState > before; }));
    drill(false);
    ASSERT_TRUE(until([this] { return m_record.drill == 0; }));
    // Unplugged in contact.
    go(m_hand->z() - 1.0);
    ASSERT_TRUE(rests());
    m_hand->lose(true);
    ASSERT_TRUE(becomes(DeviceHealth::Disconnected));
    m_hand->lose(false);
    ASSERT_TRUE(becomes(DeviceHealth::Good));
    go(m_hand->z() - 1.0); // from where the tool is
    ASSERT_TRUE(rests());
    m_hand->breakDown(true);
    ASSERT_TRUE(becomes(DeviceHealth::Faulty));
    m_hand->breakDown(false);
    ASSERT_TRUE(becomes(DeviceHealth::Good));
    go(m_hand->z() + 3.0);
    ASSERT_TRUE(rests());
  }

  void frame()
  {
    const auto news = m_session->advance();
    m_record = news.record.value_or(m_record);
    m_faults += news.fault.empty() ? 0U : 1U;
  }

  bool until(const std::function<bool()>& done)
  {
    return eventually(
        [&]
        {
          m_hand->hold();
          frame();
          return done();
        });
  }
  bool becomes(DeviceHealth health)
  {
    return until([&] { return m_record.input.health == static_cast<std::uint32_t>(health); });
  }
  // 150 ticks at one place: a force has faded in, and the tool has come to rest.
  bool rests()
  {
    const std::uint64_t end = m_record.number + 150;
    return until([&] { return m_record.number >= end; });
  }
  void go(double z)
  {
    while (std::abs(z - m_hand->z()) > 1e-9)
    {
      m_hand->place(m_hand->z() + std::clamp(z - m_hand->z(), -kStep, kStep));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      frame();
    }
  }
  void drill(bool on)
  {
    m_hand->press(on);
    if (m_hand->hasButton())
      return;
    m_parameters.drill = on ? session::ServoParameters::kDrill : std::uint8_t{0}; // the space bar
    m_session->setParameters(m_parameters);
  }

  void watchForces()
  {
    while (m_watching)
    {
      m_received.push_back(m_hand->force());
      std::this_thread::sleep_for(std::chrono::microseconds(300));
    }
  }

  std::vector<TickRecord> ticks() const
  {
    session::RecordingReader reader(m_file);
    std::vector<TickRecord> all;
    session::RecordingBlock read;
    while (reader.next(read))
      all.insert(all.end(), read.ticks.begin(), read.ticks.end());
    EXPECT_TRUE(reader.complete());
    return all;
  }

  static bool isGood(const TickRecord& tick)
  {
    return tick.input.health == static_cast<std::uint32_t>(DeviceHealth::Good);
  }

  const std::filesystem::path m_folder =
      std::filesystem::temp_directory_path() / ("petrous-served-" + std::to_string(::getpid()));
  const std::filesystem::path m_file = m_folder / "session.ticks";
  std::unique_ptr<ScriptedHand> m_hand;
  session::TouchSession* m_session = nullptr;
  session::ServoParameters m_parameters;
  double m_thrust = 0.0; // N, of hands without forces
  TickRecord m_record;   // the latest
  std::size_t m_faults = 0;
  std::vector<Rests> m_rests;
  std::atomic<bool> m_watching{true};
  std::vector<double> m_received; // N, by the device
};

} // namespace

TEST_P(ServedSession, IsRecordedAsTheDeviceHadItAndReplaysToTheBit)
{
  scene::Case first = block();
  ASSERT_NO_FATAL_FAILURE(perform(first));
  const std::vector<TickRecord> recorded = ticks();
  ASSERT_FALSE(recorded.empty());

  // Poses: each is one that the device had, in its order.
  const std::vector<double>& told = m_hand->told();
  auto place = told.begin();
  std::size_t places = 0;
  const double half = std::sqrt(0.5);
  for (const TickRecord& tick : recorded)
  {
    if (!isGood(tick))
      continue;
    const session::PoseValues& pose = tick.input.device;
    EXPECT_EQ(pose.position[0], 0.0);
    EXPECT_EQ(pose.position[1], 0.0);
    const auto found = std::find(place, told.end(), pose.position[2]);
    ASSERT_NE(found, told.end()) << pose.position[2] << " mm in tick " << tick.number;
    places += found != place ? 1U : 0U;
    place = found;
    EXPECT_NEAR(std::abs(pose.pose().rotation.dot(Eigen::Quaterniond(half, 0.0, 0.0, half))), 1.0,
                1e-6);
  }
  EXPECT_GT(places, 20U);

  // Forces: what the device received is what was recorded.
  std::set<double> sent = {0.0};
  double most = 0.0;
  for (const TickRecord& tick : recorded)
  {
    sent.insert(tick.output.force[2]);
    most = std::max(most, std::abs(tick.output.force[2]));
  }
  std::set<double> received;
  for (const double force : m_received)
  {
    EXPECT_EQ(sent.count(force), 1U) << force << " N";
    received.insert(force);
  }
  if (const auto stiffness = m_hand->stiffness())
  {
    EXPECT_GT(received.size(), 20U);
    ASSERT_EQ(m_rests.size(), 1U);
    const double change = recorded.at(m_rests[0].second).output.force[2] -
                          recorded.at(m_rests[0].first).output.force[2];
    EXPECT_NEAR(change, -*stiffness * m_rests[0].moved, 0.03 * *stiffness) << "N, of 1 mm";
  }
  else
  {
    EXPECT_EQ(most, 0.0);
    for (const TickRecord& tick : recorded)
      EXPECT_LE(tick.thrust, 1.05 * m_thrust);
  }

  // Events: one stroke, with the button held.
  std::size_t drilled = 0;
  for (const TickRecord& tick : recorded)
  {
    drilled += tick.drill;
    if (m_hand->hasButton() && tick.drill)
    {
      EXPECT_EQ(tick.input.buttons, 1U);
    }
  }
  EXPECT_GT(drilled, 0U);
  ASSERT_EQ(first.dissection.strokes().size(), 1U);
  EXPECT_GT(first.dissection.strokes()[0]->info.removed, 0.0);

  // Faults: each was seen, with no force and no drill after the fall.
  std::set<std::uint32_t> seen;
  int since = 0; // ticks
  for (const TickRecord& tick : recorded)
  {
    seen.insert(tick.input.health);
    since = tick.fault == static_cast<std::uint8_t>(session::ServoFault::None) ? 0 : since + 1;
    if (!isGood(tick))
    {
      EXPECT_EQ(tick.drill, 0U);
    }
    if (since > kFadeOut)
    {
      EXPECT_EQ(tick.output.wrench().linear.norm(), 0.0) << session::toString(tick);
    }
  }
  for (const DeviceHealth health :
       {DeviceHealth::Good, DeviceHealth::Disconnected, DeviceHealth::Faulty})
    EXPECT_EQ(seen.count(static_cast<std::uint32_t>(health)), 1U) << static_cast<int>(health);

  // Replayed, on a case as it was.
  scene::Case second = block();
  {
    session::RecordingReader reader(m_file);
    session::TouchScene scene(second, {}, reader.setup().scene.firstState);
    presenters::RecordingPlayer replay(second, scene, reader, "session.ticks");
    for (std::size_t n = 0; replay.next(); ++n)
      ASSERT_TRUE(session::identical(replay.feel(), recorded.at(n))) << n;
    EXPECT_TRUE(replay.outcome().equal()) << replay.outcome().difference;
    EXPECT_EQ(replay.outcome().warning, "");
    EXPECT_EQ(replay.outcome().ticks, recorded.size());
  }
  ASSERT_EQ(second.dissection.strokes().size(), 1U);
  EXPECT_EQ(second.dissection.strokes()[0]->info.removed,
            first.dissection.strokes()[0]->info.removed);

  const presenters::SessionReview review = presenters::reviewRecording(m_file, block());
  EXPECT_EQ(review.whyUnmeasured, "");
  ASSERT_TRUE(review.removed);
  EXPECT_DOUBLE_EQ(*review.removed, first.dissection.strokes()[0]->info.removed);
  EXPECT_EQ(review.metrics.drillStarts, 1U);
}

INSTANTIATE_TEST_SUITE_P(, ServedSession, ::testing::ValuesIn(servers()),
                         [](const auto& instance) { return std::string(instance.param.name); });
