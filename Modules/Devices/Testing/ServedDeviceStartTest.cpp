#include <cmath>
#include <csignal>
#include <string>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "FakeServer.h"
#include "ServerOptions.h"

using namespace petrous;
using namespace petrous::devices;
using namespace petrous::devices::testing;
using haptics::DeviceHealth;

namespace
{

ServerError::Reason reasonOf(const ServedDevice::Options& options, std::string& message)
{
  try
  {
    const ServedDevice device(options);
  }
  catch (const ServerError& error)
  {
    message = error.what();
    return error.reason();
  }
  ADD_FAILURE() << "the server was taken";
  return {};
}

} // namespace

TEST(ServedDeviceStart, NamesAProgramThatDoesNotExist)
{
  ServedDevice::Options options = optionsFor("missing");
  options.command = {"/nowhere/petrous-device-missing"};
  std::string message;
  EXPECT_EQ(reasonOf(options, message), ServerError::Reason::NotStarted);
  EXPECT_NE(message.find("/nowhere/petrous-device-missing"), std::string::npos) << message;
  EXPECT_NE(message.find("No such file"), std::string::npos) << message;
}

TEST(ServedDeviceStart, NamesTheStatusOfAServerThatEndsAtOnce)
{
  ServedDevice::Options options = optionsFor("ends");
  options.command = {"sh", "-c", "exit 3"};
  std::string message;
  EXPECT_EQ(reasonOf(options, message), ServerError::Reason::Ended);
  EXPECT_NE(message.find("ended by itself with status 3"), std::string::npos) << message;
}

TEST(ServedDeviceStart, SaysThatNobodyStartedTheServer)
{
  ServedDevice::Options options = optionsFor("nobody");
  options.startTimeout = 0.1;
  std::string message;
  EXPECT_EQ(reasonOf(options, message), ServerError::Reason::NotStarted);
  EXPECT_NE(message.find("nobody opened /petrous-device-" + options.name), std::string::npos)
      << message;
}

TEST(ServedDeviceStart, RefusesAServerOfAnotherVersion)
{
  const ServedDevice::Options options = optionsFor("version");
  const FakeServer server(options.name, {}, PETROUS_DEVICE_VERSION + 1);
  std::string message;
  EXPECT_EQ(reasonOf(options, message), ServerError::Reason::VersionMismatch);
  EXPECT_NE(message.find("version 2"), std::string::npos) << message;
  EXPECT_NE(message.find("version 1"), std::string::npos) << message;
}

TEST(ServedDeviceStart, RefusesADescriptionThatCannotBe)
{
  for (const double force : {std::nan(""), -1.0, 1e6})
  {
    const ServedDevice::Options options = optionsFor("description");
    const FakeServer server(options.name,
                            [force](petrous_device_block& block) { block.max_force = force; });
    std::string message;
    EXPECT_EQ(reasonOf(options, message), ServerError::Reason::BadDescription) << force;
    EXPECT_NE(message.find("force"), std::string::npos) << message;
  }
}

TEST(ServedDeviceStart, RefusesABlockThatAnotherPetrousHolds)
{
  const ServedDevice device(exampleFor("in-use"));
  std::string message;
  EXPECT_EQ(reasonOf(exampleFor("in-use"), message), ServerError::Reason::InUse);
}

TEST(ServedDeviceStart, ReplacesABlockLeftByACrash)
{
  const ServedDevice::Options options = exampleFor("leftover");
  const std::string path = "/petrous-device-" + options.name;
  const int file = ::shm_open(path.c_str(), O_RDWR | O_CREAT, 0600);
  ASSERT_GE(file, 0);
  ::close(file);
  ServedDevice device(options);
  EXPECT_TRUE(becomes(device, DeviceHealth::Good));
}

TEST(ServedDeviceStart, LeavesNeitherServerNorBlockBehind)
{
  const ServedDevice::Options options = exampleFor("tidy");
  int pid = 0;
  {
    const ServedDevice device(options);
    pid = device.status().pid;
  }
  EXPECT_NE(::kill(pid, 0), 0);
  EXPECT_LT(::shm_open(("/petrous-device-" + options.name).c_str(), O_RDWR, 0), 0);
}

TEST(ServedDeviceStart, RefusesNamesThatAreNoFileNames)
{
  for (const char* name : {"", "../x", "a b", "/", "ä"})
  {
    ServedDevice::Options options;
    options.name = name;
    EXPECT_THROW(ServedDevice{options}, core::InvalidParameter) << name;
  }
}

TEST(ServedDeviceStart, StopsWaitingForAServerThatIsNotWantedAnyMore)
{
  ServedDevice::Options options = optionsFor("unwanted");
  options.command = {"/bin/sh", "-c", "exec sleep 600"};
  options.startTimeout = 3600.0;
  int asked = 0;
  options.wanted = [&asked] { return ++asked < 3; };
  EXPECT_THROW(ServedDevice{options}, ServerError);
  EXPECT_EQ(asked, 3);
}
