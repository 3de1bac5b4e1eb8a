#pragma once

#include <cmath>
#include <cstdio>
#include <fstream>

#include <unistd.h>

#include <QComboBox>
#include <QStandardItemModel>
#include <QStatusBar>

#include "FakeServer.h"
#include "GuiTest.h"
#include "StandIn.h"

namespace petrous::workstation
{

/// A window with simulated devices that a test plugs in, and a folder for device servers.
class DeviceTest : public GuiTest
{
protected:
  DeviceTest()
  {
    devices.hid = bench.library();
    devices.serverFolders = {servers()};
    std::filesystem::create_directories(servers());
  }

  void TearDown() override
  {
    closeWindow(); // no device may be open when the bench is destroyed
    devices = {};
  }

  std::filesystem::path servers() const { return folder() / "servers"; }

  /// Installs a program that only signals its start, and its process id in NAME.pid, and waits: the
  /// test itself is the server.
  void installServer(const std::string& name)
  {
    const auto program = servers() / name;
    std::ofstream(program) << "#!/bin/sh\necho $$ > '" << (folder() / (name + ".pid")).string()
                           << "'\ntouch '" << (folder() / (name + ".started")).string()
                           << "'\nexec sleep 600\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  }
  bool started(const std::string& name) const
  {
    return std::filesystem::exists(folder() / (name + ".started"));
  }

  /// A name unique to this test run: the shared memory block is system-wide.
  static std::string serverName() { return "gui-" + std::to_string(::getpid()); }

  QComboBox& choice() { return *window().findChild<QComboBox*>("deviceChoice"); }
  bool offers(const QString& hand)
  {
    return waitFor([&] { return choice().findText(hand) >= 0; });
  }
  void choose(const QString& hand)
  {
    ASSERT_TRUE(offers(hand)) << hand.toStdString();
    const int row = choice().findText(hand);
    choice().setCurrentIndex(row);
    emit choice().activated(row);
  }
  QString message() { return window().statusBar()->currentMessage(); }

  bool hasTool() // soon
  {
    const bool has = waitFor([this] { return view().display().tool().has_value(); });
    EXPECT_TRUE(has) << message().toStdString();
    return has;
  }
  Eigen::Vector3d tool() { return view().display().tool()->center; }

  /// The view's axes: right, up, towards the camera.
  Eigen::Matrix3d axes()
  {
    const auto camera = view().picture().camera();
    const Eigen::Vector3d back = (camera.position - camera.focalPoint).normalized();
    const Eigen::Vector3d right = camera.viewUp.cross(back).normalized();
    Eigen::Matrix3d result;
    result << right, back.cross(right), back;
    return result;
  }

  /// Moves continuously, without a jump.
  static void glide(devices::testing::FakeServer& server, const Eigen::Vector3d& from,
                    const Eigen::Vector3d& to)
  {
    const int steps = static_cast<int>(std::ceil((to - from).norm() / 0.2)) + 1;
    for (int n = 1; n <= steps; ++n)
    {
      const Eigen::Vector3d at = from + (to - from) * n / steps;
      server.setPose(devices::testing::FakeServer::poseAt(at.x(), at.y(), at.z()));
      QTest::qWait(2);
    }
  }

  /// Holds the SpaceMouse deflected until then.
  bool holdCapUntil(const std::string& held, const std::function<bool()>& done)
  {
    for (int n = 0; n < 200 && !done(); ++n)
    {
      bench.play(held);
      QTest::qWait(110);
    }
    return done();
  }

  devices::testing::StandIn bench;
};

constexpr char kPlugCap[] = "plug cap 256f c635 1 8 SpaceMouse Compact\n";
constexpr char kPlugFoot[] = "plug foot 05f3 00ff c 3 VEC USB Footpedal\n";

/// A SpaceMouse held deflected for an eighth of a second: 350 is full; x right, y to the user, z
/// down. `buttons`: the first is 1.
inline std::string capHeld(int x, int y, int z, int buttons = 0)
{
  char line[160];
  const auto low = [](int v) { return static_cast<unsigned>(v) & 0xffU; };
  const auto high = [](int v) { return static_cast<unsigned>(v) >> 8 & 0xffU; };
  std::snprintf(line, sizeof line,
                "repeat 16\nreport cap 01 %02x %02x %02x %02x %02x %02x\nwait 8\nend\n"
                "report cap 03 %02x 00\n",
                low(x), high(x), low(y), high(y), low(z), high(z), static_cast<unsigned>(buttons));
  return std::string("await cap\n") + line;
}

} // namespace petrous::workstation
