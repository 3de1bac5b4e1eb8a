#include "petrous/Presenters/DeviceTestRun.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>

#include "petrous/Core/NumberText.h"
#include "petrous/Devices/ServedDevice.h"

namespace petrous::presenters
{

namespace
{

using devices::DeviceCheck;
using Stage = DeviceCheck::Stage;

constexpr auto kTick = std::chrono::milliseconds(1);
constexpr int kReportEvery = 100; // ticks

// No force where its life ends, however that comes.
class Released
{
public:
  explicit Released(haptics::Device& device)
    : m_device(device)
  {
  }
  ~Released() { m_device.send({}); }
  Released(const Released&) = delete;
  Released& operator=(const Released&) = delete;

private:
  haptics::Device& m_device;
};

} // namespace

std::string deviceTestAdvice(const DeviceCheck& check)
{
  const std::string axis(1, "xyz"[std::min(check.axis(), 2)]);
  switch (check.stage())
  {
  case Stage::Ready:
    return "waiting for the device";
  case Stage::Workspace:
    return "move the handle through all of its workspace, and press its buttons";
  case Stage::Rest:
    return "hold the handle lightly in the middle, and keep it still";
  case Stage::ForceStep:
    return "hold it lightly: a short push along " + axis;
  case Stage::Stiffness:
    return "hold it lightly: spring along " + axis + ", " + core::fixedText(check.stiffness(), 2) +
           " N/mm";
  case Stage::Done:
    break;
  }
  return "done";
}

DeviceCheck::Result testDevice(devices::ServedDevice& device, const DeviceCheck::Options& options,
                               const std::function<void(const DeviceCheck&)>& report)
{
  using Clock = std::chrono::steady_clock;
  DeviceCheck check(device.description(), options);
  const Released released(device);
  std::optional<Stage> told;
  auto wake = Clock::now();
  const auto begin = wake;
  for (int n = 0; check.stage() != Stage::Done; ++n)
  {
    const auto clock = Clock::now();
    const double now = std::chrono::duration<double>(clock - begin).count();
    const haptics::DeviceReading reading = device.read(now);
    device.send(check.tick(reading, now, device.exchange().roundTrip));
    if (check.stage() != told || n % kReportEvery == 0)
      report(check);
    told = check.stage();
    wake = clock - wake > std::chrono::milliseconds(100) ? clock : wake + kTick;
    std::this_thread::sleep_until(wake);
  }
  return check.result();
}

} // namespace petrous::presenters
