// Device server for any tracker that is published over OpenIGTLink (the PLUS Toolkit, 3D Slicer's
// OpenIGTLinkIF, many vendors): a hand with a pose and without forces.
//
//   petrous-device-openigtlink [--host NAME] [--port N] [--tool NAME] [--axes XYZ] [--handle XYZ]
//                              BLOCK
//
// --tool is the message's device name; without it the first that is seen. --axes names the
// tracker's axes that point right, up and to the user, --handle the tool's axes that are the
// handle's x, y and z (z to the wrist), each as three signed letters: "+x-z+y". Default "+x+y+z".

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "DeviceServer.h"
#include "OpenIgtLinkStream.h"
#include "ServerArguments.h"

namespace
{

using petrous::devices::OpenIgtLinkStream;
using petrous::devices::ServerArguments;
using petrous::devices::TrackedPose;

constexpr int kConnectFor = 2000;              // ms
constexpr std::int64_t kUnseenFor = 500000000; // ns
constexpr std::size_t kMostAtOnce = 64 << 20;  // bytes read in one step

struct Axes
{
  int index[3] = {0, 1, 2};
  double sign[3] = {1.0, 1.0, 1.0};
};

struct Device
{
  std::string host;
  std::string port;
  std::string tool; // empty: the first
  Axes axes;
  Axes handle;

  int socket = -1;
  OpenIgtLinkStream stream;
  std::vector<TrackedPose> poses;
  std::string followed;
  std::int64_t seenAt = 0;
  bool seen = false;
  bool missing = false; // by the tracker's last word
};

// "+x-z+y": right-handed, each axis once.
bool parseAxes(const std::string& text, Axes& axes)
{
  if (text.size() != 6)
    return false;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const char sign = text[2 * i];
    const char letter = text[2 * i + 1];
    if ((sign != '+' && sign != '-') || letter < 'x' || letter > 'z')
      return false;
    axes.sign[i] = sign == '+' ? 1.0 : -1.0;
    axes.index[i] = letter - 'x';
  }
  const int* n = axes.index;
  const bool even = (n[1] == (n[0] + 1) % 3) && (n[2] == (n[0] + 2) % 3);
  const bool odd = (n[1] == (n[0] + 2) % 3) && (n[2] == (n[0] + 1) % 3);
  const double product = axes.sign[0] * axes.sign[1] * axes.sign[2];
  return (even && product > 0.0) || (odd && product < 0.0);
}

std::uint32_t explained(petrous_device_server* server, std::uint32_t state, const std::string& text)
{
  petrous_device_explain(server, text.c_str());
  return state;
}

// A connected socket that does not block, or -1.
int connectTo(const std::string& host, const std::string& port)
{
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (::getaddrinfo(host.c_str(), port.c_str(), &hints, &found) != 0)
    return -1;
  int result = -1;
  for (const addrinfo* address = found; address && result < 0; address = address->ai_next)
  {
    const int file = ::socket(address->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (file < 0)
      continue;
    int error = ::connect(file, address->ai_addr, address->ai_addrlen) == 0 ? 0 : errno;
    pollfd wait = {file, POLLOUT, 0};
    socklen_t size = sizeof error;
    if (error == EINPROGRESS && ::poll(&wait, 1, kConnectFor) == 1)
      ::getsockopt(file, SOL_SOCKET, SO_ERROR, &error, &size);
    if (error == 0)
      result = file;
    else
      ::close(file);
  }
  ::freeaddrinfo(found);
  return result;
}

std::uint32_t openDevice(void* data, petrous_device_server* server)
{
  Device& device = *static_cast<Device*>(data);
  device.socket = connectTo(device.host, device.port);
  if (device.socket < 0)
    return explained(server, PETROUS_SERVER_NO_DEVICE,
                     "no OpenIGTLink server answers at " + device.host + " port " + device.port);
  device.stream = OpenIgtLinkStream();
  device.seenAt = petrous_device_now();
  device.seen = false;
  device.missing = false;
  petrous_device_description description{};
  description.name = "OpenIGTLink tracker";
  description.flags = PETROUS_SENSES_ROTATION;
  petrous_device_describe(server, &description);
  return PETROUS_SERVER_READY;
}

void convert(const Device& device, const TrackedPose& tracked, petrous_device_pose& pose)
{
  double rotation[3][3];
  for (int i = 0; i < 3; ++i)
  {
    pose.position[i] = device.axes.sign[i] * tracked.position[device.axes.index[i]];
    for (int j = 0; j < 3; ++j)
      rotation[i][j] = device.axes.sign[i] * device.handle.sign[j] *
                       tracked.rotation[device.axes.index[i]][device.handle.index[j]];
  }
  petrous_device_quaternion(rotation, pose.rotation);
}

std::uint32_t step(void* data, petrous_device_server* server, const petrous_device_wrench*,
                   petrous_device_pose* pose)
{
  Device& device = *static_cast<Device*>(data);
  // All that is there: behind images, which are skipped, poses would grow old.
  unsigned char bytes[65536];
  device.poses.clear();
  for (std::size_t read = 0; read < kMostAtOnce;)
  {
    const ssize_t count = ::recv(device.socket, bytes, sizeof bytes, 0);
    if (count < 0 && errno == EINTR)
      continue;
    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK))
      break;
    if (count <= 0)
      return explained(server, PETROUS_SERVER_NO_DEVICE, "the OpenIGTLink server has ended");
    device.stream.take(bytes, static_cast<std::size_t>(count), device.poses);
    read += static_cast<std::size_t>(count);
  }
  const std::int64_t now = petrous_device_now();
  for (const TrackedPose& tracked : device.poses)
  {
    if (device.followed.empty() && device.tool.empty())
      device.followed = tracked.tool;
    if (tracked.tool != (device.tool.empty() ? device.followed : device.tool))
      continue;
    device.missing = tracked.missing;
    device.seen = true;
    if (tracked.missing)
    {
      pose->time_ns = 0;
      continue;
    }
    device.seenAt = now;
    convert(device, tracked, *pose);
    pose->time_ns = static_cast<std::uint64_t>(now);
  }
  if (!device.missing && now - device.seenAt <= kUnseenFor)
    return PETROUS_SERVER_READY;
  const std::string& tool = device.tool.empty() ? device.followed : device.tool;
  return explained(server, PETROUS_SERVER_FAULT,
                   device.seen ? "the tracker does not see '" + tool + "'"
                               : "the tracker has not sent a pose" +
                                     (tool.empty() ? tool : " of '" + tool + "'"));
}

void closeDevice(void* data)
{
  Device& device = *static_cast<Device*>(data);
  if (device.socket >= 0)
    ::close(device.socket);
  device.socket = -1;
}

} // namespace

int main(int argc, char** argv)
{
  Device device;
  ServerArguments arguments;
  double port = 0.0;
  if (!arguments.parse(argc, argv,
                       {{"--host", "127.0.0.1"},
                        {"--port", "18944"},
                        {"--tool", ""},
                        {"--axes", "+x+y+z"},
                        {"--handle", "+x+y+z"}}) ||
      !arguments.number("--port", 1.0, 65535.0, port))
    return 2;
  if (!parseAxes(arguments.text("--axes"), device.axes) ||
      !parseAxes(arguments.text("--handle"), device.handle))
  {
    std::fprintf(stderr, "petrous-device-openigtlink: --axes and --handle name three axes with "
                         "their signs, right-handed: +x-z+y\n");
    return 2;
  }
  device.host = arguments.text("--host");
  device.port = arguments.text("--port");
  device.tool = arguments.text("--tool");
  const petrous_device_driver driver = {
      "petrous-device-openigtlink", &device, openDevice, step, closeDevice, 0};
  return petrous_device_serve(&driver, arguments.block().c_str());
}
