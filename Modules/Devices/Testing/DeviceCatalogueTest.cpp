#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <sys/stat.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "StandIn.h"
#include "petrous/Devices/DeviceCatalogue.h"

using namespace petrous::devices;
using namespace petrous::devices::testing;

namespace
{

// An empty file in place of a hidraw node.
class Node
{
public:
  Node(const std::string& name, mode_t mode)
    : m_path(::testing::TempDir() + "petrous-" + name + "-" + std::to_string(::getpid()))
  {
    std::ofstream file(m_path);
    file.close();
    ::chmod(m_path.c_str(), mode);
  }
  ~Node() { ::unlink(m_path.c_str()); }
  const std::string& path() const { return m_path; }

private:
  std::string m_path;
};

// Root may open everything, so tests of permissions run as another user.
class NotRoot
{
public:
  NotRoot()
    : m_user(::geteuid())
  {
    if (m_user == 0)
      m_changed = ::seteuid(65534) == 0;
  }
  ~NotRoot()
  {
    if (m_changed && ::seteuid(m_user) != 0)
      std::abort();
  }
  NotRoot(const NotRoot&) = delete;
  NotRoot& operator=(const NotRoot&) = delete;
  bool works() const { return m_user != 0 || m_changed; }

private:
  uid_t m_user;
  bool m_changed = false;
};

std::string rules()
{
  const std::ifstream file(PETROUS_UDEV_RULES);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

} // namespace

TEST(DeviceCatalogue, FindsTheDevicesThatItKnowsAndWhoMayOpenThem)
{
  const Node open("open", 0666);
  const Node closed("closed", 0000);
  StandIn hid;
  hid.playAll("plug " + open.path() + " 046d c62b 1 8 SpaceMouse Pro\n" + "plug " + closed.path() +
              " 05f3 00ff c 3 VEC USB Footpedal\n" +
              "plug /nowhere/hidraw7 256f c652 1 8 Receiver\n" +
              "plug keys 0c45 7403 1 6 FootSwitch\n" + "plug mouse 046d c077 1 2 Optical Mouse\n");
  std::vector<FoundDevice> found;
  {
    const NotRoot user;
    if (!user.works())
      GTEST_SKIP() << "cannot stop being root";
    found = findDevices(*hid.library());
  }
  ASSERT_EQ(found.size(), 4U);
  const auto of = [&found](std::uint16_t product) -> const FoundDevice&
  {
    for (const FoundDevice& each : found)
      if (each.device.product == product)
        return each;
    ADD_FAILURE() << product;
    return found.front();
  };
  EXPECT_EQ(of(0xc62b).title(), "SpaceMouse Pro (046d:c62b)");
  EXPECT_EQ(of(0xc62b).access, Access::Allowed);
  EXPECT_EQ(of(0xc62b).advice, "");

  EXPECT_EQ(of(0x00ff).device.kind, DeviceKind::Pedal);
  EXPECT_EQ(of(0x00ff).access, Access::Denied);
  EXPECT_NE(of(0x00ff).advice.find("70-petrous-devices.rules"), std::string::npos);
  EXPECT_NE(of(0x00ff).advice.find(closed.path()), std::string::npos);

  EXPECT_EQ(of(0xc652).access, Access::Gone);

  EXPECT_EQ(of(0x7403).device.kind, DeviceKind::KeyboardPedal);
  EXPECT_NE(of(0x7403).advice.find("key"), std::string::npos);
}

// As Linux has them in /sys/class/hidraw.
TEST(DeviceCatalogue, KnowsFromTheKernelsNodesWhetherAnyOfItIsPluggedIn)
{
  namespace fs = std::filesystem;
  const fs::path nodes =
      fs::path(::testing::TempDir()) / ("petrous-hidraw-" + std::to_string(::getpid()));
  const auto plug = [&](const char* node, const char* id)
  {
    fs::create_directories(nodes / node / "device");
    std::ofstream(nodes / node / "device" / "uevent")
        << "DRIVER=hid-generic\nHID_ID=" << id << "\nHID_NAME=x\n";
  };
  EXPECT_FALSE(isKnownPluggedIn(nodes)) << "no such folder";
  plug("hidraw0", "0003:0000046D:0000C31C"); // a keyboard
  plug("hidraw1", "0003:00000C45:00007403"); // a pedal that types: nothing to open
  fs::create_directories(nodes / "hidraw2");
  EXPECT_FALSE(isKnownPluggedIn(nodes));
  plug("hidraw3", "0003:0000256F:0000C635");
  EXPECT_TRUE(isKnownPluggedIn(nodes)) << "SpaceMouse Compact";
  fs::remove_all(nodes / "hidraw3");
  plug("hidraw4", "0003:000005F3:000000FF");
  EXPECT_TRUE(isKnownPluggedIn(nodes)) << "foot pedal";
  fs::remove_all(nodes);
}

TEST(DeviceCatalogue, ListsADeviceOnceThatHidapiListsOnceAUsage)
{
  StandIn hid;
  hid.playAll("plug cap 256f c633 1 8 SpaceMouse Enterprise\n"
              "plug keys 256f c633 1 6 SpaceMouse Enterprise\n");
  const std::vector<FoundDevice> found = findDevices(*hid.library());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].interface.path, "cap");
}

TEST(DeviceCatalogue, KnowsEachDeviceOnce)
{
  const auto& devices = knownDevices();
  for (std::size_t i = 0; i < devices.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(devices[i].vendor == devices[j].vendor &&
                   devices[i].product == devices[j].product)
          << devices[i].name;
}

TEST(UdevRules, NameEveryDeviceThatPetrousOpensAndNoKeyboard)
{
  const std::string text = rules();
  ASSERT_FALSE(text.empty()) << PETROUS_UDEV_RULES;
  for (const KnownDevice& device : knownDevices())
  {
    char pattern[32];
    std::snprintf(pattern, sizeof pattern, "*:%04X:%04X.*", device.vendor, device.product);
    EXPECT_EQ(text.find(pattern) != std::string::npos, device.kind != DeviceKind::KeyboardPedal)
        << pattern;
  }
}
