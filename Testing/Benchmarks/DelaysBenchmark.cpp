#include "DelaysBenchmark.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include <pthread.h>
#include <time.h>
#include <unistd.h>

#include "AnsweringServer.h"
#include "BenchmarkPatients.h"
#include "HeardSound.h"
#include "SimulatedDevice.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/TickHistogram.h"
#include "petrous/Devices/ServedDevice.h"
#include "petrous/Presenters/DeviceMapping.h"
#include "petrous/Session/TouchSession.h"
#include "petrous/Sound/Speaker.h"

namespace petrous::cli
{

namespace
{

constexpr std::int64_t kTick = 1000000;                               // ns
constexpr double kWantedForce = 0.3e-3;                               // s
constexpr double kWantedSound = 20e-3;                                // s
constexpr double kWalls[] = {5.0, 4.0, 3.0, 2.0, 1.0, 0.5, 0.2, 0.0}; // mm
constexpr std::pair<const char*, double> kShares[] = {
    {"p50", 0.5}, {"p90", 0.9}, {"p99", 0.99}, {"p99.9", 0.999}, {"max", 1.0}};

std::int64_t now()
{
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return std::int64_t{time.tv_sec} * 1000000000 + time.tv_nsec;
}

void sleepUntil(std::int64_t time)
{
  const timespec until{time / 1000000000, time % 1000000000};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

void enter(const char* what, const core::TickHistogram& times, core::BenchmarkPoint& point)
{
  for (const auto& [name, share] : kShares)
    point.extra[std::string(what) + "_us_" + name] = 1e6 * times.quantile(share);
}

// What a servo's thread did with one pose, ns.
struct Answer
{
  std::int64_t age = 0;  // of the pose when it had been read
  std::int64_t read = 0; // when it had been read
  std::int64_t sent = 0; // when the answer was about to be sent
};

struct Answers
{
  std::vector<Answer> ticks; // of tick n + 1
  bool realTime = false;
};

// As the servo's thread does, without a tool.
void answer(devices::ServedDevice& device, std::size_t ticks, Answers& answers)
{
  sched_param priority{};
  priority.sched_priority = 50;
  answers.realTime = pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority) == 0;
  answers.ticks.reserve(ticks);
  std::int64_t due = now();
  for (std::size_t n = 0; n < ticks; ++n)
  {
    due = std::max(due + kTick, now() - 100 * kTick); // pauses are not made up for
    sleepUntil(due);
    const haptics::DeviceReading reading = device.read(1e-9 * static_cast<double>(now()));
    Answer one;
    one.read = now();
    const auto microseconds =
        static_cast<std::uint32_t>(static_cast<std::uint64_t>(one.read) / 1000U);
    one.age = std::int64_t{1000} * static_cast<std::uint32_t>(microseconds - reading.buttons);
    haptics::Wrench wrench;
    wrench.linear.x() = 0.1;
    one.sent = now();
    device.send(wrench);
    answers.ticks.push_back(one);
  }
}

core::BenchmarkPoint serverToForce(const std::filesystem::path& work, bool polls, bool quick)
{
  const std::filesystem::path file = work / (polls ? "polling" : "ticking");
  Answers answers;
  {
    devices::ServedDevice::Options options;
    options.name = "bench-" + std::to_string(::getpid());
    options.command = answeringServer(polls, file);
    options.restart = false;
    devices::ServedDevice device(options);
    std::thread servo([&] { answer(device, quick ? 1000 : 60000, answers); });
    servo.join();
  }
  core::TickHistogram toServo;
  core::TickHistogram toMotors;
  core::TickHistogram added;
  for (const Arrival& arrival : arrivalsIn(file))
  {
    if (arrival.tick > answers.ticks.size())
      continue;
    const Answer& one = answers.ticks[arrival.tick - 1];
    if (one.age > 1000 * kTick) // no pose yet
      continue;
    const auto seconds = [](std::int64_t ns) { return 1e-9 * static_cast<double>(ns); };
    toServo.add(seconds(one.age));
    toMotors.add(seconds(arrival.time - one.sent));
    added.add(seconds(one.age + arrival.time - one.read));
  }
  core::BenchmarkPoint point;
  point.scene = "server to force";
  point.setting["server"] = polls ? "exchanges without a pause" : "1 kHz";
  point.isDefault = polls;
  point.seconds = added.quantile(0.5);
  point.error = std::numeric_limits<double>::quiet_NaN();
  enter("pose_to_servo", toServo, point);
  enter("servo_to_motors", toMotors, point);
  enter("pose_to_motors", added, point);
  point.extra["ticks"] = static_cast<double>(answers.ticks.size());
  point.extra["arrived"] = static_cast<double>(added.count());
  point.extra["real_time_priority"] = answers.realTime;
  if (polls)
  {
    point.extra["wanted_us"] = 1e6 * kWantedForce;
    for (const auto& [name, share] : {kShares[2], kShares[3]})
      point.extra[std::string("wanted_met_at_") + name] = added.quantile(share) <= kWantedForce;
  }
  return point;
}

// From the beginning of a tick to its being heard, while the tool taps on bone.
void tap(bool quick, const core::Progress& progress, core::TickHistogram& delays, int& contacts)
{
  const BenchmarkPatient patient = phantomPatient(quick ? 96 : 256, progress.part(0.0, 0.3));
  scene::Case value = touchCaseOf(patient);
  session::TouchScene scene(value, progress.part(0.3, 0.5));
  haptics::SimulatedDevice hand(
      [](double time)
      {
        haptics::Pose pose; // the tissue lies towards -z; the cavity is some mm deep
        pose.position.z() = 25.0 * std::cos(2.0 * 3.14159265358979323846 * time) - 15.0;
        return pose;
      });
  presenters::DeviceMapping mapping;
  mapping.scale = presenters::usualScale(hand.description());
  session::TouchSession::Setup setup;
  presenters::fit(setup, hand.description(), mapping, false);
  core::CameraPose camera;
  camera.position = patient.entry + 200.0 * patient.lateral;
  camera.focalPoint = patient.entry;
  setup.parameters = presenters::parametersFor(hand.description(), mapping, camera);
  setup.center = patient.entry;
  bool touched = false;
  setup.heard = [&](const session::TickRecord& record)
  {
    if (!(record.time() > 0.0)) // the end of the session
      return;
    delays.add(1e-9 * static_cast<double>(now()) - record.time());
    contacts += !touched && record.contacts > 0 ? 1 : 0;
    touched = record.contacts > 0;
  };
  session::TouchSession session(value, scene, hand, setup);
  const int frames = quick ? 60 : 3600;
  auto frame = std::chrono::steady_clock::now();
  for (int n = 0; n < frames; ++n)
  {
    progress.part(0.5, 1.0).report(static_cast<double>(n) / frames, "tapping");
    session.advance();
    frame += std::chrono::microseconds(16667);
    std::this_thread::sleep_until(frame);
  }
  session.stop();
}

// From the first sample in tissue until half of the change in loudness has come, over 2 ms; s.
double onset(const sound::DrillState& state)
{
  constexpr std::size_t kWindow = 96; // 2 ms
  sound::DrillVoice voice(sound::kHeardRate);
  sound::DrillState air = state;
  air.load = 0.0;
  sound::heard(voice, air, 0.5);
  const double before = sound::loudness(sound::heard(voice, air, 0.1));
  const std::vector<float> samples = sound::heard(voice, state, 0.1);
  sound::heard(voice, state, 0.4);
  const double after = sound::loudness(sound::heard(voice, state, 0.1));
  for (std::size_t end = kWindow; end <= samples.size(); ++end)
  {
    const auto from = samples.begin() + static_cast<std::ptrdiff_t>(end - kWindow);
    if (sound::loudness({from, from + kWindow}) >= 0.5 * (before + after))
      return static_cast<double>(end) / sound::kHeardRate;
  }
  return std::numeric_limits<double>::infinity();
}

core::BenchmarkPoint contactToSound(const core::TickHistogram& heard, int contacts, int flutes,
                                    double load)
{
  core::BenchmarkPoint point;
  point.scene = "contact to sound";
  point.setting["flutes"] = std::to_string(flutes);
  point.setting["load_n"] = core::generalText(load, 3);
  point.isDefault = flutes > 0 && load == 1.0;
  point.error = std::numeric_limits<double>::quiet_NaN();
  const double block = static_cast<double>(sound::Speaker::kBlock) / sound::kHeardRate;
  const double voice = onset(sound::drilling(load, sound::DrillVoice::kThick, flutes));
  point.seconds = heard.quantile(0.999) + block + voice;
  enter("tick_to_heard", heard, point);
  point.extra["taps"] = contacts;
  point.extra["block_ms"] = 1e3 * block;
  point.extra["onset_ms"] = 1e3 * voice;
  point.extra["without_card_ms"] = 1e3 * point.seconds;
  point.extra["left_for_card_ms"] = 1e3 * (kWantedSound - point.seconds);
  double last = 0.0;
  bool rises = true;
  for (const double wall : kWalls)
  {
    const double hertz = sound::settledCentroid(sound::drilling(load, wall, flutes));
    rises = rises && hertz > last;
    last = hertz;
    point.extra["centroid_hz_at_" + core::generalText(wall, 3) + "_mm"] = hertz;
  }
  point.extra["centroid_monotone"] = rises;
  return point;
}

} // namespace

core::BenchmarkReport runDelaysBenchmark(const std::filesystem::path& work, bool quick,
                                         const core::Progress& progress)
{
  core::BenchmarkReport report{"delays", "From hand to force and sound", {}};
  progress.report(0.0, "exchanging with a device server");
  for (const bool polls : {true, false})
    report.points.push_back(serverToForce(work, polls, quick));
  progress.check("the benchmark of delays");
  core::TickHistogram heard;
  int contacts = 0;
  tap(quick, progress.part(0.3, 0.9), heard, contacts);
  for (const int flutes : {8, 0})
    for (const double load : {0.5, 1.0, 3.0})
      report.points.push_back(contactToSound(heard, contacts, flutes, load));
  return report;
}

} // namespace petrous::cli
