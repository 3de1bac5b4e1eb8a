// Device server for Force Dimension's omega, delta, sigma and lambda, and for the Novint Falcon,
// by the vendor's Haptic SDK, which is loaded at run time.
//
//   petrous-device-force-dimension [--sdk FILE] [--effector-mass KG] [--max-force N]
//                                  [--max-stiffness N/MM] BLOCK
//
// The SDK's axes are x to the user, y right, z up: v_D = (y, z, x). Its handle's x axis points from
// the tip to the user's wrist in the neutral pose, so the same permutation, applied on both sides,
// converts orientations: R_D = P R P^T.

#include <algorithm>
#include <cstdint>
#include <string>

#include "DeviceServer.h"
#include "DhdApi.h"
#include "ServerArguments.h"

namespace
{

using petrous::devices::DhdApi;
using petrous::devices::ServerArguments;
using petrous::devices::VendorLibrary;

constexpr char kFirst = -1;                       // the SDK's default device
constexpr int kLookEvery = 20;                    // steps between two looks at the status
constexpr std::int64_t kEnableEvery = 1000000000; // ns
constexpr unsigned char kWatchdog = 240; // 30 ms in eighths: motors off without a new force
constexpr int kSdkAxis[3] = {1, 2, 0};   // of D's x, y, z

// From the data sheets and the defaults of other programs (Documentation/devices.md); none was
// measured here. N, N mm, N/mm.
struct Model
{
  const char* prefix;
  double force;
  double torque;
  double stiffness;
};
constexpr Model kModels[] = {{"omega", 12.0, 0.0, 5.0},   {"delta", 20.0, 0.0, 5.0},
                             {"sigma", 20.0, 400.0, 4.0}, {"lambda", 10.0, 100.0, 2.0},
                             {"falcon", 8.0, 0.0, 3.0},   {"", 5.0, 0.0, 1.0}};
constexpr double kTorqueStiffness = 400.0; // N mm/rad, for devices with torque

struct Device
{
  std::string sdk;
  double effectorMass = 0.0; // kg; 0: the SDK's own
  double maxForce = 0.0;     // N; 0: the model's
  double maxStiffness = 0.0; // N/mm; 0: the model's

  VendorLibrary library;
  DhdApi api;
  bool open = false;
  bool senses = false;  // rotation
  bool torques = false; // active wrist
  int steps = 0;
  bool userSwitchedOff = false; // by the button or the dead man's switch
  std::int64_t enabledAt = 0;
  std::uint32_t state = PETROUS_SERVER_NO_DEVICE; // by the last look
};

Model modelOf(std::string name)
{
  for (char& c : name)
    if (c >= 'A' && c <= 'Z')
      c = static_cast<char>(c - 'A' + 'a');
  for (const Model& model : kModels)
    if (name.find(model.prefix) != std::string::npos)
      return model;
  return kModels[5];
}

std::string lastError(const Device& device)
{
  const char* text = device.api.errorGetLastStr();
  return text ? text : "unknown error";
}

const char* whyForceIsOff(int cause)
{
  switch (cause)
  {
  case DhdApi::kButton:
    return "its forces are off: press the force button on the device";
  case DhdApi::kVelocity:
    return "its forces are off, as it was moved too fast: hold it still";
  case DhdApi::kWatchdog:
    return "its forces are off, as it had no command for 30 ms; they return in a second";
  case DhdApi::kDeadman:
    return "its forces are off: hold the dead man's switch";
  default:
    return "its forces are off: press the force button on the device";
  }
}

void setZero(const DhdApi& api)
{
  api.setForceAndTorque(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, kFirst);
}

// The motors hold the last force until another comes, also those of a device that has lost its
// calibration.
void setOff(const DhdApi& api)
{
  setZero(api);
  api.enableForce(0, kFirst);
}

// The state by dhdGetStatus, with a message unless READY; then the motors have no force.
std::uint32_t look(Device& device, petrous_device_server* server)
{
  int status[DhdApi::kStatusRoom] = {};
  if (device.api.getStatus(status, kFirst) < 0 || !status[DhdApi::kConnected])
  {
    petrous_device_explain(server, "it was unplugged or switched off");
    setOff(device.api);
    return PETROUS_SERVER_NO_DEVICE;
  }
  if (!status[DhdApi::kPower])
  {
    petrous_device_explain(server, "it has no power: switch it on");
    setOff(device.api);
    return PETROUS_SERVER_FAULT;
  }
  if (status[DhdApi::kError])
  {
    petrous_device_explain(server, "the device reports an error: switch it off and on");
    setOff(device.api);
    return PETROUS_SERVER_FAULT;
  }
  if (!status[DhdApi::kReset])
  {
    petrous_device_explain(server, "it is not calibrated: run HapticInit of the SDK; a Falcon's "
                                   "grip is pulled out and pushed in once");
    setOff(device.api);
    return PETROUS_SERVER_STARTING;
  }
  if (!status[DhdApi::kForce])
  {
    const int cause = status[DhdApi::kForceOffCause];
    petrous_device_explain(server, whyForceIsOff(cause));
    setZero(device.api); // they are off already; switching them off anew would hide the cause
    device.userSwitchedOff = cause == DhdApi::kButton || cause == DhdApi::kDeadman;
    const std::int64_t now = petrous_device_now();
    // Whoever pressed the button or let go of the switch decides when the forces return.
    if (!device.userSwitchedOff && now - device.enabledAt > kEnableEvery)
    {
      device.enabledAt = now;
      device.api.enableForce(1, kFirst);
    }
    return PETROUS_SERVER_FAULT;
  }
  device.userSwitchedOff = false;
  return PETROUS_SERVER_READY;
}

void describe(Device& device, petrous_device_server* server)
{
  const char* given = device.api.getSystemName(kFirst);
  const std::string name = given && *given ? given : "Force Dimension device";
  const Model model = modelOf(name);
  device.senses = device.api.hasWrist(kFirst);
  device.torques = device.api.hasActiveWrist(kFirst);
  std::string title = name == "Force Dimension device" ? name : "Force Dimension " + name;
  unsigned short number = 0;
  if (device.api.getSerialNumber && device.api.getSerialNumber(&number, kFirst) >= 0 && number != 0)
    title += " " + std::to_string(number);
  petrous_device_description description{};
  description.name = title.c_str();
  description.flags = PETROUS_GIVES_FORCE;
  if (device.senses)
    description.flags |= PETROUS_SENSES_ROTATION;
  if (device.torques)
    description.flags |= PETROUS_GIVES_TORQUE;
  description.max_force = device.maxForce > 0.0 ? device.maxForce : model.force;
  description.max_torque = device.torques ? model.torque : 0.0;
  description.max_stiffness = device.maxStiffness > 0.0 ? device.maxStiffness : model.stiffness;
  description.max_angular_stiffness = device.torques ? kTorqueStiffness : 0.0;
  petrous_device_describe(server, &description);
}

void setWatchdog(const DhdApi& api)
{
  if (!api.setWatchdog || !api.enableExpertMode || !api.disableExpertMode)
    return;
  api.enableExpertMode();
  api.setWatchdog(kWatchdog, kFirst);
  api.disableExpertMode();
}

std::uint32_t openDevice(void* data, petrous_device_server* server)
{
  Device& device = *static_cast<Device*>(data);
  if (!device.library.open(device.sdk, "PETROUS_FORCE_DIMENSION_LIBRARY",
                           {"libdrd.so.3", "libdrd.so", "libdhd.so.3", "libdhd.so"},
                           {"/usr/local/lib", "/opt/forcedimension/lib"}))
  {
    petrous_device_explain(server, device.library.problem().c_str());
    return PETROUS_SERVER_FAULT;
  }
  if (!device.api.open)
    device.api.load(device.library);
  if (!device.library.problem().empty())
  {
    petrous_device_explain(server, device.library.problem().c_str());
    return PETROUS_SERVER_FAULT;
  }
  const DhdApi& api = device.api;
  if (!device.open)
  {
    if (api.open() < 0)
    {
      petrous_device_explain(server, ("it cannot be opened: " + lastError(device)).c_str());
      return PETROUS_SERVER_NO_DEVICE;
    }
    device.open = true;
    describe(device, server);
    if (device.effectorMass > 0.0)
      api.setEffectorMass(device.effectorMass, kFirst);
    api.setGravityCompensation(1, kFirst);
    if (api.hasGripper(kFirst))
      api.emulateButton(1, kFirst); // closing the gripper is button 0
    setWatchdog(api);
  }
  setZero(api); // before anything enables the motors
  device.state = look(device, server);
  if (device.state != PETROUS_SERVER_FAULT && device.state != PETROUS_SERVER_READY)
    return device.state;
  // Forces that are off are reported by the steps.
  if (!device.userSwitchedOff && api.enableForce(1, kFirst) < 0)
  {
    petrous_device_explain(server, ("its forces cannot be enabled: " + lastError(device)).c_str());
    return PETROUS_SERVER_NO_DEVICE;
  }
  device.enabledAt = petrous_device_now();
  device.steps = 0;
  return PETROUS_SERVER_READY;
}

std::uint32_t step(void* data, petrous_device_server* server, const petrous_device_wrench* wrench,
                   petrous_device_pose* pose)
{
  Device& device = *static_cast<Device*>(data);
  const DhdApi& api = device.api;
  double force[3] = {};
  double torque[3] = {};
  for (int i = 0; i < 3; ++i)
  {
    force[kSdkAxis[i]] = wrench->force[i];
    torque[kSdkAxis[i]] = 0.001 * wrench->torque[i]; // N mm to N m
  }
  double position[3] = {};
  double matrix[3][3] = {};
  const int set =
      api.setForceAndTorque(force[0], force[1], force[2], torque[0], torque[1], torque[2], kFirst);
  const std::int64_t now = petrous_device_now();
  const int got = api.getPose(&position[0], &position[1], &position[2], matrix, kFirst);
  if (device.steps++ % kLookEvery == 0 || set < 0 || got < 0)
  {
    device.state = look(device, server);
    if (device.state == PETROUS_SERVER_READY && (set < 0 || got < 0))
    {
      petrous_device_explain(server, ("the SDK reports: " + lastError(device)).c_str());
      device.state = PETROUS_SERVER_FAULT;
      device.steps = 0; // look again in the next step
    }
  }
  pose->time_ns = static_cast<std::uint64_t>(now);
  double rotated[3][3];
  for (int i = 0; i < 3; ++i)
  {
    pose->position[i] = 1000.0 * position[kSdkAxis[i]];
    for (int j = 0; j < 3; ++j)
      rotated[i][j] = matrix[kSdkAxis[i]][kSdkAxis[j]];
  }
  if (device.senses)
    petrous_device_quaternion(rotated, pose->rotation);
  pose->buttons = api.getButtonMask(kFirst);
  return device.state;
}

void closeDevice(void* data)
{
  Device& device = *static_cast<Device*>(data);
  if (!device.open)
    return;
  setOff(device.api);
  device.api.setBrakes(1, kFirst);
  device.api.close(kFirst);
  device.open = false;
}

} // namespace

int main(int argc, char** argv)
{
  Device device;
  ServerArguments arguments;
  if (!arguments.parse(argc, argv,
                       {{"--sdk", ""},
                        {"--effector-mass", "0"},
                        {"--max-force", "0"},
                        {"--max-stiffness", "0"}}) ||
      !arguments.number("--effector-mass", 0.0, 1.0, device.effectorMass) ||
      !arguments.number("--max-force", 0.0, 40.0, device.maxForce) ||
      !arguments.number("--max-stiffness", 0.0, 20.0, device.maxStiffness))
    return 2;
  device.sdk = arguments.text("--sdk");
  const petrous_device_driver driver = {
      "petrous-device-force-dimension", &device, openDevice, step, closeDevice, 0};
  return petrous_device_serve(&driver, arguments.block().c_str());
}
