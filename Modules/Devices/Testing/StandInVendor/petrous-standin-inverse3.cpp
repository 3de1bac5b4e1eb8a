// Stand-in of Haply's Inverse service: a WebSocket that sends the list of devices, then answers
// each message with the state of all. Ends with its parent's pipe on stdin.

#include <cmath>
#include <utility>

#include <QtCore/QCoreApplication>
#include <QtCore/QSocketNotifier>
#include <QtCore/QTimer>
#include <QtNetwork/QHostAddress>
#include <QtWebSockets/QWebSocket>
#include <QtWebSockets/QWebSocketServer>

#include <nlohmann/json.hpp>

#include "StandInDevice.h"

using nlohmann::json;
using petrous::devices::testing::standIn;

namespace
{

json number(double value) // JSON has no NaN
{
  return std::isfinite(value) ? json(value) : json();
}

std::string state(bool inventory)
{
  json message = json::object();
  if (standIn().format == 35 && inventory)
    message["session_id"] = 7;
  const auto& p = standIn().position;
  const auto& q = standIn().rotation;
  message["inverse3"] = json::array();
  json status = {{"calibrated", standIn().calibrated != 0},
                 {"power_supply", standIn().powered != 0},
                 {"ready", true}};
  if (standIn().another)
    message["inverse3"].push_back(
        {{"device_id", "0001"},
         {"state", {{"cursor_position", {{"x", 0.09}, {"y", 0.09}, {"z", 0.09}}}}},
         {"status", status}});
  const int untold = standIn().untold;
  for (const auto& [bit, key] : {std::pair(1, "calibrated"), {2, "power_supply"}, {4, "ready"}})
    if ((untold & bit) != 0)
      status.erase(key);
  json device = {
      {"device_id", "049D"},
      {"state",
       {{"cursor_position", {{"x", number(p[0])}, {"y", number(p[1])}, {"z", number(p[2])}}}}}};
  if ((untold & 8) == 0)
    device["status"] = status;
  if (standIn().plugged)
    message["inverse3"].push_back(device);
  message["wireless_verse_grip"] = {
      {{"device_id", "61548"},
       {"state",
        {{"orientation",
          {{"w", q[0].load()}, {"x", q[1].load()}, {"y", q[2].load()}, {"z", q[3].load()}}},
         {"buttons",
          {{"a", (standIn().buttons & 1U) != 0},
           {"b", (standIn().buttons & 2U) != 0},
           {"c", (standIn().buttons & 4U) != 0}}}}}}};
  return message.dump();
}

} // namespace

int main(int argc, char** argv)
{
  QCoreApplication application(argc, argv);
  QWebSocketServer server("stand-in", QWebSocketServer::NonSecureMode);
  if (!server.listen(QHostAddress::LocalHost))
    return 1;
  standIn().port = server.serverPort();
  int owed = 0;
  QObject::connect(
      &server, &QWebSocketServer::newConnection,
      [&]
      {
        QWebSocket* socket = server.nextPendingConnection();
        ++standIn().opened;
        QObject::connect(socket, &QWebSocket::disconnected, [] { ++standIn().closed; });
        QObject::connect(
            socket, &QWebSocket::textMessageReceived,
            [&owed, socket](const QString& text)
            {
              const json message = json::parse(text.toStdString());
              const json& device = message.at("inverse3").at(0);
              const json& command = device.at("commands").at("set_cursor_force");
              const json& force = command.at(standIn().format == 35 ? "vector" : "values");
              standIn().force[0] = force.at("x").get<double>();
              standIn().force[1] = force.at("y").get<double>();
              standIn().force[2] = force.at("z").get<double>();
              ++standIn().commands;
              if (owed++ > 0)
                ++standIn().piled;
              QTimer::singleShot(standIn().stall.load(), Qt::PreciseTimer, socket,
                                 [&owed, socket]
                                 {
                                   --owed;
                                   socket->sendTextMessage(QString::fromStdString(state(false)));
                                 });
            });
        socket->sendTextMessage(QString::fromStdString(state(true)));
      });
  const QSocketNotifier parent(0, QSocketNotifier::Read);
  QObject::connect(&parent, &QSocketNotifier::activated, &application, &QCoreApplication::quit);
  return QCoreApplication::exec();
}
