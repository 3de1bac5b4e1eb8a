#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "OpenIgtLinkStream.h"
#include "ServerOptions.h"

using namespace petrous;
using namespace petrous::devices;
using namespace petrous::devices::testing;
using haptics::DeviceHealth;
using haptics::DeviceReading;

namespace
{

using Bytes = std::vector<unsigned char>;

// Messages written by OpenIGTLink 1.11 (igtl::TransformMessage, PositionMessage, StatusMessage).
// "Stylus" at (10.5, -20.25, 30), turned by a quarter about z; header version 1.
const char* const kTransform1 = "@TRANSFORM1@";
// The same with header version 2, message 7 and metadata "status".
const char* const kTransform2 = "@TRANSFORM2@";
// "Stylus" at (1.5, -2.5, 3.5), likewise turned; header versions 1 and 2.
const char* const kPosition1 = "@POSITION1@";
const char* const kPosition2 = "@POSITION2@";
const char* const kStatus = "@STATUS@";

Bytes bytesOf(const std::string& hex)
{
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(static_cast<unsigned char>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  return bytes;
}

std::vector<TrackedPose> posesIn(OpenIgtLinkStream& stream, const Bytes& bytes)
{
  std::vector<TrackedPose> poses;
  stream.take(bytes.data(), bytes.size(), poses);
  return poses;
}

void expectPose(const TrackedPose& pose, double x, double y, double z)
{
  const double turned[3][3] = {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
  EXPECT_EQ(pose.tool, "Stylus");
  EXPECT_DOUBLE_EQ(pose.position[0], x);
  EXPECT_DOUBLE_EQ(pose.position[1], y);
  EXPECT_DOUBLE_EQ(pose.position[2], z);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(pose.rotation[i][j], turned[i][j], 1e-6);
}

// A tracker that one program listens to.
class FakeTracker
{
public:
  FakeTracker()
    : m_listening(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0))
  {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(::bind(m_listening, reinterpret_cast<sockaddr*>(&address), size), 0);
    EXPECT_EQ(::listen(m_listening, 4), 0);
    ::getsockname(m_listening, reinterpret_cast<sockaddr*>(&address), &size);
    m_port = ntohs(address.sin_port);
  }
  ~FakeTracker()
  {
    hangUp();
    ::close(m_listening);
  }
  FakeTracker(const FakeTracker&) = delete;
  FakeTracker& operator=(const FakeTracker&) = delete;

  ServedDevice::Options options(const std::string& name, std::vector<std::string> more = {}) const
  {
    ServedDevice::Options options = optionsFor(name);
    options.command = {PETROUS_OPENIGTLINK_SERVER, "--port", std::to_string(m_port)};
    options.command.insert(options.command.end(), more.begin(), more.end());
    return options;
  }

  void send(const Bytes& bytes)
  {
    if (m_client < 0)
      m_client = ::accept4(m_listening, nullptr, nullptr, SOCK_CLOEXEC);
    EXPECT_EQ(::send(m_client, bytes.data(), bytes.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(bytes.size()));
  }

  void hangUp()
  {
    if (m_client >= 0)
      ::close(m_client);
    m_client = -1;
  }

private:
  int m_listening;
  int m_client = -1;
  int m_port = 0;
};

} // namespace

TEST(OpenIgtLinkStream, ChecksumIsCrc64OfEcma182)
{
  const std::string check = "123456789"; // the check value of the catalogue of CRC algorithms
  EXPECT_EQ(OpenIgtLinkStream::checksum(reinterpret_cast<const unsigned char*>(check.data()),
                                        check.size()),
            0x6C40DF5F0B497347U);
}

TEST(OpenIgtLinkStream, ReadsWhatTheReferenceLibraryWrites)
{
  OpenIgtLinkStream stream;
  for (const char* message : {kTransform1, kTransform2})
  {
    const auto poses = posesIn(stream, bytesOf(message));
    ASSERT_EQ(poses.size(), 1U);
    expectPose(poses.front(), 10.5, -20.25, 30.0);
  }
  for (const char* message : {kPosition1, kPosition2})
  {
    const auto poses = posesIn(stream, bytesOf(message));
    ASSERT_EQ(poses.size(), 1U);
    expectPose(poses.front(), 1.5, -2.5, 3.5);
  }
  EXPECT_EQ(stream.refused(), 0U);
}

TEST(OpenIgtLinkStream, PutsTogetherWhatComesInPiecesBetweenOtherMessages)
{
  Bytes all;
  for (const char* message : {kStatus, kTransform2, kStatus, kPosition1, kStatus, kTransform1})
  {
    const Bytes one = bytesOf(message);
    all.insert(all.end(), one.begin(), one.end());
  }
  for (const std::size_t piece : {1U, 7U, 58U, 100U, 1000U})
  {
    OpenIgtLinkStream stream;
    std::vector<TrackedPose> poses;
    for (std::size_t at = 0; at < all.size(); at += piece)
      stream.take(all.data() + at, std::min(piece, all.size() - at), poses);
    EXPECT_EQ(poses.size(), 3U) << piece;
    EXPECT_EQ(stream.refused(), 0U);
  }
}

TEST(OpenIgtLinkStream, LeavesOutEveryMessageWithAnAlteredByteInItsBody)
{
  const Bytes good = bytesOf(kTransform2);
  for (std::size_t at = 58; at < good.size(); ++at)
  {
    Bytes bad = good;
    bad[at] ^= 0x10U;
    OpenIgtLinkStream stream;
    EXPECT_TRUE(posesIn(stream, bad).empty()) << at;
    EXPECT_EQ(stream.refused(), 1U);
    EXPECT_EQ(posesIn(stream, good).size(), 1U) << "the stream goes on";
  }
}

TEST(TrackerServer, IsAHandWithoutForcesInTheAxesItIsTold)
{
  FakeTracker tracker;
  ServedDevice device(
      tracker.options("tracker", {"--tool", "Stylus", "--axes", "+y+z+x", "--handle", "+y+z+x"}));
  EXPECT_FALSE(device.description().givesForce);
  EXPECT_TRUE(device.description().sensesRotation);
  DeviceReading reading;
  ASSERT_TRUE(eventually(
      [&]
      {
        tracker.send(bytesOf(kTransform1));
        reading = device.read(steadySeconds());
        return reading.health == DeviceHealth::Good;
      }));
  EXPECT_EQ(reading.pose.position, Eigen::Vector3d(-20.25, 30.0, 10.5));
  // A quarter turn about the tracker's z, which is the protocol's y.
  const double half = std::sqrt(0.5);
  EXPECT_NEAR(std::abs(reading.pose.rotation.dot(Eigen::Quaterniond(half, 0.0, half, 0.0))), 1.0,
              1e-6);
}

TEST(TrackerServer, SaysWhenTheToolIsOutOfSightAndWhenTheTrackerEnds)
{
  FakeTracker tracker;
  ServedDevice device(tracker.options("sight"));
  const auto seen = [&]
  {
    tracker.send(bytesOf(kPosition2));
    return healthOf(device) == DeviceHealth::Good;
  };
  ASSERT_TRUE(eventually(seen));
  const auto says = [&](const char* text)
  { return eventually([&] { return device.status().fault.find(text) != std::string::npos; }); };
  EXPECT_TRUE(says("does not see 'Stylus'")) << device.status().fault;
  EXPECT_TRUE(eventually(seen));
  tracker.hangUp();
  EXPECT_TRUE(says("has ended")) << device.status().fault;
  EXPECT_TRUE(eventually(seen)) << "it is connected to anew";
}

TEST(TrackerServer, NamesTheAddressWhereNobodyAnswers)
{
  ServedDevice::Options options = optionsFor("nobody");
  options.command = {PETROUS_OPENIGTLINK_SERVER, "--port", "1"};
  try
  {
    const ServedDevice device(options);
    ADD_FAILURE();
  }
  catch (const ServerError& error)
  {
    EXPECT_EQ(error.reason(), ServerError::Reason::NoDevice);
    EXPECT_NE(std::string(error.what()).find("127.0.0.1 port 1"), std::string::npos)
        << error.what();
  }
}
