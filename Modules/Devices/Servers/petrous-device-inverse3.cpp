// Device server for the Inverse3 of Haply Robotics, with or without a VerseGrip, by the vendor's
// Inverse service: a WebSocket on this machine that answers each message with the state of all
// devices, as JSON. Versions 3.1 to 3.5 of its format.
//
//   petrous-device-inverse3 [--url URL] [--device ID] [--max-force N] [--max-stiffness N/MM] BLOCK
//
// --device is the service's id of an Inverse3; without it the first that is seen, from then on.
// The service's axes are x right, y forward, z up, right-handed, metres and newtons:
// v_D = (x, z, -y); orientations R_D = P R P^T, with which a grip that points forward has its +z to
// the wrist. Forces apply to the message's tick only, so that silence is zero there as well.

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include <QtCore/QCoreApplication>
#include <QtCore/QEventLoop>
#include <QtCore/QTimer>
#include <QtCore/QUrl>
#include <QtWebSockets/QWebSocket>

#include <nlohmann/json.hpp>

#include "DeviceServer.h"
#include "ServerArguments.h"

namespace
{

using nlohmann::json;
using petrous::devices::ServerArguments;

// Not measured here; see Documentation/devices.md.
constexpr double kUsualForce = 5.0;     // N
constexpr double kUsualStiffness = 1.0; // N/mm

constexpr int kConnectFor = 2000;              // ms
constexpr int kAnswerFor = 20;                 // ms waited for an answer in one step
constexpr std::int64_t kSilentFor = 200000000; // ns without an answer: the service hangs

struct Device
{
  QUrl url;
  double maxForce = 0.0;     // N; 0: the usual
  double maxStiffness = 0.0; // N/mm; 0: the usual

  std::unique_ptr<QWebSocket> socket;
  QEventLoop* waiting = nullptr;
  std::string answer; // the latest; empty: none yet
  bool owed = false;  // an answer is
  std::int64_t answeredAt = 0;

  std::string id;    // empty: the first
  bool told = false; // the status below
  bool powered = false;
  bool calibrated = false;
  bool ready = false;
  bool senses = false;        // has a grip
  bool vectorCommand = false; // format 3.5
  double rotation[4] = {1.0, 0.0, 0.0, 0.0};
};

std::uint32_t explained(petrous_device_server* server, std::uint32_t state, const char* text)
{
  petrous_device_explain(server, text);
  return state;
}

// The member, or null where there is none.
const json& at(const json& object, const char* key)
{
  static const json kNull;
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found == object.end() ? kNull : *found;
}

const json& first(const json& object, const char* key)
{
  const json& list = at(object, key);
  static const json kNull;
  return list.is_array() && !list.empty() ? list.front() : kNull;
}

// Of the list's devices that with this id, or null.
const json& withId(const json& object, const char* key, const std::string& id)
{
  static const json kNull;
  for (const json& device : at(object, key))
    if (at(device, "device_id") == id)
      return device;
  return kNull;
}

double number(const json& object, const char* key)
{
  const json& value = at(object, key);
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

bool says(const json& object, const char* key, bool otherwise)
{
  const json& value = at(object, key);
  return value.is_boolean() ? value.get<bool>() : otherwise;
}

const json& gripOf(const json& state)
{
  const json& wireless = first(state, "wireless_verse_grip");
  return wireless.is_null() ? first(state, "verse_grip") : wireless;
}

// Waits for an answer that is owed; false if there is none in time.
bool await(Device& device, int milliseconds)
{
  if (device.owed && device.socket->state() == QAbstractSocket::ConnectedState)
  {
    QEventLoop loop;
    QTimer timer;
    timer.setTimerType(Qt::PreciseTimer);
    timer.setSingleShot(true);
    QObject::connect(&timer, &QTimer::timeout, &loop, &QEventLoop::quit);
    timer.start(milliseconds);
    device.waiting = &loop;
    loop.exec();
    device.waiting = nullptr;
  }
  return !device.owed;
}

void sendForce(Device& device, const double force[3])
{
  const json values = {{"x", force[0]}, {"y", -force[2]}, {"z", force[1]}};
  const json command = {{device.vectorCommand ? "vector" : "values", values}};
  const json message = {
      {"inverse3", {{{"device_id", device.id}, {"commands", {{"set_cursor_force", command}}}}}}};
  device.owed = true;
  device.socket->sendTextMessage(QString::fromStdString(message.dump()));
  device.socket->flush();
}

// What the service does not tell is not so.
std::uint32_t stateOf(Device& device, const json& inverse, petrous_device_server* server)
{
  if (inverse.is_null())
    return explained(server, PETROUS_SERVER_NO_DEVICE,
                     "its Inverse3 is not connected to the Inverse service");
  // A message without changes may leave the status out.
  if (const json& status = at(inverse, "status"); status.is_object())
  {
    device.told = true;
    device.powered = says(status, "power_supply", false);
    device.calibrated = says(status, "calibrated", false);
    device.ready = says(status, "ready", false);
  }
  if (!device.told)
    return explained(server, PETROUS_SERVER_STARTING,
                     "the Inverse service does not tell whether it is ready");
  if (!device.powered)
    return explained(server, PETROUS_SERVER_FAULT,
                     "it has no power supply: plug it in; its forces are off");
  if (!device.calibrated)
    return explained(server, PETROUS_SERVER_STARTING,
                     "it is not calibrated: put the grip into the holder on its base");
  if (!device.ready)
    return explained(server, PETROUS_SERVER_FAULT, "it is not ready; its forces are off");
  return PETROUS_SERVER_READY;
}

json parsed(const Device& device)
{
  return json::parse(device.answer, nullptr, false);
}

std::uint32_t openDevice(void* data, petrous_device_server* server)
{
  Device& device = *static_cast<Device*>(data);
  if (!device.socket)
  {
    device.answer.clear();
    device.socket = std::make_unique<QWebSocket>();
    const auto answered = [&device]
    {
      device.owed = false;
      device.answeredAt = petrous_device_now();
      if (device.waiting)
        device.waiting->quit();
    };
    QObject::connect(device.socket.get(), &QWebSocket::textMessageReceived,
                     [&device, answered](const QString& text)
                     {
                       device.answer = text.toStdString();
                       answered();
                     });
    QObject::connect(device.socket.get(), &QWebSocket::disconnected,
                     [&device]
                     {
                       if (device.waiting)
                         device.waiting->quit();
                     });
    device.owed = true; // the service begins with the list of devices
    device.socket->open(device.url);
    QEventLoop loop;
    device.waiting = &loop;
    QTimer::singleShot(kConnectFor, &loop, &QEventLoop::quit);
    loop.exec();
    device.waiting = nullptr;
    if (device.owed)
      return explained(server, PETROUS_SERVER_NO_DEVICE,
                       "the Inverse service does not answer: start haply-inverse-service");
    const json state = parsed(device);
    const json& inverse =
        device.id.empty() ? first(state, "inverse3") : withId(state, "inverse3", device.id);
    const json& id = at(inverse, "device_id");
    if (!id.is_string())
      return explained(server, PETROUS_SERVER_NO_DEVICE,
                       device.id.empty() ? "no Inverse3 is connected to the Inverse service"
                                         : "its Inverse3 is not connected to the Inverse service");
    device.id = id.get<std::string>();
    device.told = false;
    device.vectorCommand = !at(state, "session_id").is_null();
    device.senses = !gripOf(state).is_null();
    petrous_device_description description{};
    const std::string name =
        "Haply Inverse3 " + device.id + (device.senses ? " with VerseGrip" : "");
    description.name = name.c_str();
    description.flags = PETROUS_GIVES_FORCE;
    if (device.senses)
      description.flags |= PETROUS_SENSES_ROTATION;
    description.max_force = device.maxForce > 0.0 ? device.maxForce : kUsualForce;
    description.max_stiffness = device.maxStiffness > 0.0 ? device.maxStiffness : kUsualStiffness;
    petrous_device_describe(server, &description);
  }
  const double zero[3] = {};
  if (!device.owed)
    sendForce(device, zero);
  if (!await(device, kAnswerFor))
    return device.socket->state() == QAbstractSocket::ConnectedState
               ? explained(server, PETROUS_SERVER_STARTING, "the Inverse service is slow to answer")
               : explained(server, PETROUS_SERVER_NO_DEVICE, "the Inverse service has ended");
  const json state = parsed(device);
  return stateOf(device, withId(state, "inverse3", device.id), server);
}

void takeGrip(Device& device, const json& grip, petrous_device_pose& pose)
{
  const json& state = at(grip, "state");
  const json& q = at(state, "orientation");
  // A grip that sleeps sends none: the last orientation is held.
  if (q.is_object())
  {
    device.rotation[0] = number(q, "w");
    device.rotation[1] = number(q, "x");
    device.rotation[2] = number(q, "z");
    device.rotation[3] = -number(q, "y");
  }
  for (int i = 0; i < 4; ++i)
    pose.rotation[i] = device.rotation[i];
  const json& buttons = at(state, "buttons");
  pose.buttons = (says(state, "button", false) || says(buttons, "a", false) ? 1U : 0U) |
                 (says(buttons, "b", false) ? 2U : 0U) | (says(buttons, "c", false) ? 4U : 0U);
}

std::uint32_t step(void* data, petrous_device_server* server, const petrous_device_wrench* wrench,
                   petrous_device_pose* pose)
{
  Device& device = *static_cast<Device*>(data);
  // One answer for each message: a late one is waited for, so that none piles up.
  if (!device.owed)
    sendForce(device, wrench->force);
  if (!await(device, kAnswerFor))
  {
    if (device.socket->state() != QAbstractSocket::ConnectedState)
      return explained(server, PETROUS_SERVER_NO_DEVICE, "the Inverse service has ended");
    return petrous_device_now() - device.answeredAt > kSilentFor
               ? explained(server, PETROUS_SERVER_FAULT,
                           "the Inverse service has not answered for 0.2 s")
               : std::uint32_t{PETROUS_SERVER_READY};
  }
  const json state = parsed(device);
  const json& inverse = withId(state, "inverse3", device.id);
  const json& position = at(at(inverse, "state"), "cursor_position");
  pose->position[0] = 1000.0 * number(position, "x");
  pose->position[1] = 1000.0 * number(position, "z");
  pose->position[2] = -1000.0 * number(position, "y");
  pose->time_ns = static_cast<std::uint64_t>(device.answeredAt);
  takeGrip(device, gripOf(state), *pose);
  return stateOf(device, inverse, server);
}

void closeDevice(void* data)
{
  Device& device = *static_cast<Device*>(data);
  if (!device.socket)
    return;
  if (device.socket->state() == QAbstractSocket::ConnectedState && !device.id.empty())
  {
    const double zero[3] = {};
    sendForce(device, zero);
    await(device, kAnswerFor);
  }
  device.socket->disconnect();
  device.socket->abort();
  device.socket.reset();
  device.owed = false;
}

} // namespace

int main(int argc, char** argv)
{
  Device device;
  ServerArguments arguments;
  if (!arguments.parse(argc, argv,
                       {{"--url", "ws://127.0.0.1:10001"},
                        {"--device", ""},
                        {"--max-force", "0"},
                        {"--max-stiffness", "0"}}) ||
      !arguments.number("--max-force", 0.0, 20.0, device.maxForce) ||
      !arguments.number("--max-stiffness", 0.0, 20.0, device.maxStiffness))
    return 2;
  device.id = arguments.text("--device");
  device.url = QUrl(QString::fromStdString(arguments.text("--url")));
  QCoreApplication application(argc, argv);
  const petrous_device_driver driver = {
      "petrous-device-inverse3", &device, openDevice, step, closeDevice, 0};
  return petrous_device_serve(&driver, arguments.block().c_str());
}
