// Device server for the Touch, Touch X and Phantom Omni of 3D Systems, by OpenHaptics' HD API,
// which is loaded at run time.
//
//   petrous-device-touch [--sdk FILE] [--device NAME] [--max-force N] [--max-stiffness N/MM] BLOCK
//
// --device is the name in the vendor's set-up program; without it the default device. The API's
// axes are those of the protocol, millimetres and newtons; the stylus' z axis points from the tip
// to the wrist. Frames run in the vendor's servo thread; forces are for the three motors of the
// arm, the gimbal of this family has none.

#include <atomic>
#include <cstdint>
#include <string>

#include "DeviceServer.h"
#include "HdApi.h"
#include "ServerArguments.h"

namespace
{

using petrous::devices::HdApi;
using petrous::devices::ServerArguments;
using petrous::devices::VendorLibrary;

constexpr double kUsualForce = 3.3;           // N, the Touch, where the driver names none
constexpr double kUsualStiffness = 0.4;       // N/mm, likewise
constexpr std::int64_t kCoolFor = 3000000000; // ns without force after warm motors
constexpr std::int64_t kRestFor = 500000000;  // ns without force after another force error
constexpr int kCalibrationEvery = 100;        // frames

struct Device
{
  std::string sdk;
  std::string name;
  double maxForce = 0.0;     // N; 0: the driver's
  double maxStiffness = 0.0; // N/mm; 0: the driver's

  VendorLibrary library;
  HdApi api;
  petrous_device_server* server = nullptr;
  unsigned int handle = HdApi::kInvalidHandle;
  bool scheduled = false; // the scheduler runs
  unsigned long callback = 0;
  int frames = 0;
  bool calibrated = false; // by the last look
  std::int64_t restUntil = 0;
};

std::uint32_t explained(petrous_device_server* server, std::uint32_t state, const std::string& text)
{
  petrous_device_explain(server, text.c_str());
  return state;
}

std::string textOf(const Device& device, unsigned int code)
{
  const char* text = device.api.getErrorString(code);
  return text ? text : "unknown error";
}

// READY, or STARTING with what the user has to do.
std::uint32_t calibration(const Device& device, petrous_device_server* server)
{
  const HdApi& api = device.api;
  int styles = 0;
  api.getIntegers(HdApi::kCalibrationStyle, &styles);
  const unsigned int style = (styles & HdApi::kInkwell) != 0 ? HdApi::kInkwell
                             : (styles & HdApi::kAuto) != 0  ? HdApi::kAuto
                                                             : HdApi::kEncoderReset;
  switch (api.checkCalibration())
  {
  case HdApi::kCalibrationOk:
    return PETROUS_SERVER_READY;
  case HdApi::kCalibrationNeedsUpdate:
    api.updateCalibration(style);
    return api.checkCalibration() == HdApi::kCalibrationOk
               ? std::uint32_t{PETROUS_SERVER_READY}
               : explained(server, PETROUS_SERVER_STARTING,
                           "it is being calibrated: hold it still");
  default:
    return explained(server, PETROUS_SERVER_STARTING,
                     style == HdApi::kInkwell
                         ? "it is not calibrated: put the stylus into the inkwell"
                         : "it is not calibrated: run Touch Diagnostic of the driver");
  }
}

void describe(const Device& device, petrous_device_server* server)
{
  const HdApi& api = device.api;
  const char* model = api.getString(HdApi::kModelType);
  double force = 0.0;
  double stiffness = 0.0;
  api.getDoubles(HdApi::kMaxForce, &force);
  api.getDoubles(HdApi::kMaxStiffness, &stiffness);
  const char* number = api.getString(HdApi::kSerialNumber);
  api.getError(); // a driver without these numbers leaves an error
  std::string title = model && *model ? model : "OpenHaptics device";
  if (number && *number)
    title += std::string(" ") + number;
  petrous_device_description description{};
  description.name = title.c_str();
  description.flags = PETROUS_SENSES_ROTATION | PETROUS_GIVES_FORCE;
  description.max_force = device.maxForce > 0.0          ? device.maxForce
                          : force > 0.0 && force <= 40.0 ? force
                                                         : kUsualForce;
  description.max_stiffness = device.maxStiffness > 0.0              ? device.maxStiffness
                              : stiffness > 0.0 && stiffness <= 10.0 ? stiffness
                                                                     : kUsualStiffness;
  petrous_device_describe(server, &description);
}

// In the vendor's servo thread.
unsigned int frame(void* data)
{
  return petrous_device_exchange(static_cast<Device*>(data)->server) == PETROUS_SERVER_NO_DEVICE
             ? HdApi::kCallbackDone
             : HdApi::kCallbackContinue;
}

std::uint32_t openDevice(void* data, petrous_device_server* server)
{
  Device& device = *static_cast<Device*>(data);
  if (!device.library.open(device.sdk, "PETROUS_OPENHAPTICS_LIBRARY",
                           {"libHD.so", "libHD.so.3", "libHD.so.3.4"},
                           {"/usr/local/lib", "/opt/OpenHaptics/Developer/3.4-0/lib"}))
    return explained(server, PETROUS_SERVER_FAULT, device.library.problem());
  if (!device.api.initDevice)
    device.api.load(device.library);
  if (!device.library.problem().empty())
    return explained(server, PETROUS_SERVER_FAULT, device.library.problem());
  const HdApi& api = device.api;
  if (device.handle == HdApi::kInvalidHandle)
  {
    for (int i = 0; i < 100 && api.getError().code != HdApi::kSuccess; ++i)
      ; // those of the device that went
    device.handle = api.initDevice(device.name.empty() ? nullptr : device.name.c_str());
    const HdApi::ErrorInfo error = api.getError();
    if (error.code != HdApi::kSuccess || device.handle == HdApi::kInvalidHandle)
    {
      device.handle = HdApi::kInvalidHandle;
      return explained(server, PETROUS_SERVER_NO_DEVICE,
                       "it cannot be opened: " + textOf(device, error.code) +
                           "; the driver's set-up program must have paired it");
    }
    api.makeCurrent(device.handle);
    describe(device, server);
    api.enable(HdApi::kMaxForceClamping);
    api.enable(HdApi::kForceOutput);
    api.startScheduler();
    const HdApi::ErrorInfo started = api.getError();
    if (started.code != HdApi::kSuccess)
      return explained(server, PETROUS_SERVER_NO_DEVICE,
                       "the vendor's scheduler does not start: " + textOf(device, started.code));
    device.scheduled = true;
  }
  const std::uint32_t state = calibration(device, server);
  if (state != PETROUS_SERVER_READY)
    return state;
  device.server = server;
  device.frames = 0;
  device.restUntil = 0;
  if (device.callback == 0)
    device.callback = api.scheduleAsynchronous(frame, &device, HdApi::kDefaultPriority);
  return PETROUS_SERVER_READY;
}

// What the SDK's error means for the device.
std::uint32_t stateFor(Device& device, petrous_device_server* server, const HdApi::ErrorInfo& error,
                       std::int64_t now)
{
  if (error.code == HdApi::kWarmMotors)
  {
    device.restUntil = now + kCoolFor;
    return explained(server, PETROUS_SERVER_FAULT,
                     "its motors are hot: let it rest; the forces return by themselves");
  }
  if ((error.code & HdApi::kErrorFamily) == HdApi::kForceErrors)
  {
    device.restUntil = now + kRestFor;
    return explained(server, PETROUS_SERVER_FAULT,
                     "its forces are off: " + textOf(device, error.code));
  }
  if ((error.code & HdApi::kErrorFamily) == HdApi::kDeviceErrors)
    return explained(server, PETROUS_SERVER_NO_DEVICE,
                     "it was unplugged or switched off: " + textOf(device, error.code));
  if (error.code != HdApi::kSuccess)
    return explained(server, PETROUS_SERVER_FAULT,
                     "the SDK reports: " + textOf(device, error.code));
  return PETROUS_SERVER_READY;
}

std::uint32_t step(void* data, petrous_device_server* server, const petrous_device_wrench* wrench,
                   petrous_device_pose* pose)
{
  Device& device = *static_cast<Device*>(data);
  const HdApi& api = device.api;
  double transform[16] = {};
  int buttons = 0;
  api.beginFrame(device.handle);
  const std::int64_t now = petrous_device_now();
  api.getDoubles(HdApi::kTransform, transform);
  api.getIntegers(HdApi::kButtons, &buttons);
  api.setDoubles(HdApi::kForce, wrench->force);
  const bool off = !api.isEnabled(HdApi::kForceOutput);
  api.endFrame(device.handle);
  const HdApi::ErrorInfo error = api.getError();

  pose->time_ns = static_cast<std::uint64_t>(now);
  double rotation[3][3];
  for (int i = 0; i < 3; ++i)
  {
    pose->position[i] = transform[12 + i];
    for (int j = 0; j < 3; ++j)
      rotation[i][j] = transform[4 * j + i];
  }
  petrous_device_quaternion(rotation, pose->rotation);
  pose->buttons = static_cast<std::uint32_t>(buttons);

  const std::uint32_t state = stateFor(device, server, error, now);
  if (state != PETROUS_SERVER_READY)
    return state;
  if (now < device.restUntil)
    return PETROUS_SERVER_FAULT; // the message stands
  // The driver had a reason: they return when the user asks for them.
  if (off)
    return explained(server, PETROUS_SERVER_FAULT,
                     "its forces are off: the driver disabled them; choose the device again");
  // The frames go on while the user puts the stylus into the inkwell.
  if (device.frames++ % kCalibrationEvery == 0)
    device.calibrated = calibration(device, server) == PETROUS_SERVER_READY;
  return device.calibrated ? PETROUS_SERVER_READY : PETROUS_SERVER_FAULT;
}

void closeDevice(void* data)
{
  Device& device = *static_cast<Device*>(data);
  const HdApi& api = device.api;
  if (device.handle == HdApi::kInvalidHandle)
    return;
  const double zero[3] = {};
  if (device.scheduled)
    api.stopScheduler(); // no frame runs any longer
  if (device.callback != 0)
    api.unschedule(device.callback);
  api.makeCurrent(device.handle);
  api.beginFrame(device.handle);
  api.setDoubles(HdApi::kForce, zero);
  api.endFrame(device.handle);
  api.disable(HdApi::kForceOutput);
  api.disableDevice(device.handle);
  device.scheduled = false;
  device.callback = 0;
  device.handle = HdApi::kInvalidHandle;
}

} // namespace

int main(int argc, char** argv)
{
  Device device;
  ServerArguments arguments;
  if (!arguments.parse(
          argc, argv,
          {{"--sdk", ""}, {"--device", ""}, {"--max-force", "0"}, {"--max-stiffness", "0"}}) ||
      !arguments.number("--max-force", 0.0, 40.0, device.maxForce) ||
      !arguments.number("--max-stiffness", 0.0, 20.0, device.maxStiffness))
    return 2;
  device.sdk = arguments.text("--sdk");
  device.name = arguments.text("--device");
  const petrous_device_driver driver = {
      "petrous-device-touch", &device, openDevice, step, closeDevice, 1};
  return petrous_device_serve(&driver, arguments.block().c_str());
}
