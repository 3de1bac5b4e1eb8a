#include <dlfcn.h>

#include <gtest/gtest.h>

#include "StandIn.h"
#include "petrous/Devices/HidLibrary.h"

using namespace petrous::devices;
using namespace petrous::devices::testing;

namespace
{

std::string refusal(const std::string& path)
{
  try
  {
    const HidLibrary library(path);
  }
  catch (const HidError& error)
  {
    return error.what();
  }
  return "taken";
}

} // namespace

TEST(HidLibrary, LoadsTheSystemsHidapiAtItsFirstUseAndListsWhateverIsPluggedIn)
{
  const auto isLoaded = []
  {
    void* handle = ::dlopen("libhidapi-hidraw.so.0", RTLD_LAZY | RTLD_NOLOAD);
    if (handle)
      ::dlclose(handle);
    return handle != nullptr;
  };
  const HidLibrary library;
  EXPECT_FALSE(isLoaded());
  library.list();
  EXPECT_TRUE(isLoaded());
  for (const HidInterface& interface : library.list())
    EXPECT_FALSE(interface.path.empty());
  EXPECT_EQ(library.open("/nowhere/hidraw0"), nullptr);
}

TEST(HidLibrary, NamesALibraryThatCannotBeLoaded)
{
  const std::string message = refusal("/nowhere/libhidapi.so");
  EXPECT_NE(message.find("/nowhere/libhidapi.so"), std::string::npos) << message;
}

TEST(HidLibrary, NamesTheFunctionThatALibraryLacks)
{
  const std::string message = refusal("libm.so.6");
  EXPECT_NE(message.find("hid_init"), std::string::npos) << message;
}

TEST(HidLibrary, ListsAndReadsWhatTheStandInHasPluggedIn)
{
  StandIn hid;
  hid.playAll("plug a 046d c62b 1 8 SpaceMouse Pro\nplug b 05f3 ff c 3 Pedal\n");
  const auto interfaces = hid.library()->list();
  ASSERT_EQ(interfaces.size(), 2U);
  EXPECT_EQ(interfaces[0].path, "a");
  EXPECT_EQ(interfaces[0].vendor, 0x046d);
  EXPECT_EQ(interfaces[0].product, 0xc62b);
  EXPECT_EQ(interfaces[0].usagePage, 1);
  EXPECT_EQ(interfaces[0].usage, 8);
  EXPECT_EQ(interfaces[0].name, "SpaceMouse Pro");
  EXPECT_EQ(interfaces[1].product, 0x00ff);

  auto connection = hid.library()->open("a");
  ASSERT_NE(connection, nullptr);
  unsigned char bytes[8] = {};
  EXPECT_EQ(connection->read(bytes, sizeof bytes, 1), 0);
  hid.playAll("report a 03 01 00\nerror a\n");
  EXPECT_EQ(connection->read(bytes, sizeof bytes, 20000), 3);
  EXPECT_EQ(bytes[1], 1);
  EXPECT_LT(connection->read(bytes, sizeof bytes, 20000), 0);
  EXPECT_EQ(connection->read(bytes, sizeof bytes, 1), 0);
  hid.playAll("unplug a\nplug a 046d c62b 1 8 SpaceMouse Pro\n");
  EXPECT_LT(connection->read(bytes, sizeof bytes, 1), 0) << "an old handle reads the new device";
}

// The functions of Debian's hidapi 0.13.1, from its symbol table.
TEST(StandInHid, HasTheWholeInterfaceOfHidapi)
{
  void* handle = ::dlopen(PETROUS_STANDIN_HID_LIBRARY, RTLD_NOW | RTLD_LOCAL);
  ASSERT_NE(handle, nullptr);
  for (const char* name : {"hid_close",
                           "hid_enumerate",
                           "hid_error",
                           "hid_exit",
                           "hid_free_enumeration",
                           "hid_get_device_info",
                           "hid_get_feature_report",
                           "hid_get_indexed_string",
                           "hid_get_input_report",
                           "hid_get_manufacturer_string",
                           "hid_get_product_string",
                           "hid_get_serial_number_string",
                           "hid_init",
                           "hid_open",
                           "hid_open_path",
                           "hid_read",
                           "hid_read_timeout",
                           "hid_send_feature_report",
                           "hid_set_nonblocking",
                           "hid_version",
                           "hid_version_str",
                           "hid_write"})
    EXPECT_NE(::dlsym(handle, name), nullptr) << name;
  ::dlclose(handle);
}

TEST(StandInHid, NamesTheLineThatItDoesNotUnderstand)
{
  StandIn hid;
  EXPECT_EQ(hid.badLine("# nothing\n\nplug a 046d\n"), 3);
  EXPECT_EQ(hid.badLine("jump a\n"), 1);
  EXPECT_EQ(hid.badLine("report a 0g\n"), 1);
  EXPECT_EQ(hid.badLine("wait 1\nrepeat 3\nwait 1\n"), 3);
  EXPECT_EQ(hid.badLine("end\n"), 1);
}
