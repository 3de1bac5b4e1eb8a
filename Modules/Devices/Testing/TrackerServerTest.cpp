#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
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
const char* const kTransform =
    "00015452414e53464f524d0000005374796c7573000000000000000000000000000000000000000000000000"
    "000000000030d014c90aa45f55be000000003f80000000000000bf8000000000000000000000000000000000"
    "00003f80000041280000c1a2000041f00000";
// "Stylus" at (1.5, -2.5, 3.5), likewise turned.
const char* const kPosition =
    "0001504f534954494f4e000000005374796c7573000000000000000000000000000000000000000000000000"
    "00000000001cdbaa2327b53c2f203fc00000c02000004060000000000000000000003f3504f33f3504f3";
const char* const kStatus =
    "0001535441545553000000000000446576696365000000000000000000000000000000000000000000000000"
    "00000000002410ce46c5d04dfcd1000100000000000000000a00000000000000000000000000000000000000"
    "726561647900";

Bytes bytesOf(const std::string& hex)
{
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(static_cast<unsigned char>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  return bytes;
}

void put(Bytes& bytes, std::size_t at, std::uint64_t value, int count)
{
  for (int i = count - 1; i >= 0; --i, value >>= 8U)
    bytes[at + static_cast<std::size_t>(i)] = static_cast<unsigned char>(value);
}

// The message with header version 2: an extended header before its content (sizes of it and of the
// metadata, number of the message) and metadata behind.
Bytes withMetadata(const Bytes& message,
                   const std::vector<std::pair<std::string, std::string>>& entries = {{"k", "vv"}})
{
  Bytes metadata(2 + 8 * entries.size());
  put(metadata, 0, entries.size(), 2);
  Bytes extended(12);
  put(extended, 0, 12, 2);
  put(extended, 2, metadata.size(), 2);
  for (std::size_t i = 0; i < entries.size(); ++i)
  {
    const auto& [key, value] = entries[i];
    put(metadata, 2 + 8 * i, key.size(), 2);
    put(metadata, 4 + 8 * i, 3, 2);
    put(metadata, 6 + 8 * i, value.size(), 4);
    metadata.insert(metadata.end(), key.begin(), key.end());
    metadata.insert(metadata.end(), value.begin(), value.end());
  }
  put(extended, 4, metadata.size() - 2 - 8 * entries.size(), 4);
  put(extended, 8, 7, 4);
  Bytes bytes = message;
  bytes.insert(bytes.begin() + 58, extended.begin(), extended.end());
  bytes.insert(bytes.end(), metadata.begin(), metadata.end());
  put(bytes, 0, 2, 2);
  put(bytes, 42, bytes.size() - 58, 8);
  put(bytes, 50, OpenIgtLinkStream::checksum(bytes.data() + 58, bytes.size() - 58), 8);
  return bytes;
}

// The message with these numbers, from number `first` of its body on.
Bytes with(const Bytes& message, std::size_t first, const std::vector<float>& numbers)
{
  Bytes bytes = message;
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &numbers[i], sizeof bits);
    put(bytes, 58 + 4 * (first + i), bits, 4);
  }
  put(bytes, 50, OpenIgtLinkStream::checksum(bytes.data() + 58, bytes.size() - 58), 8);
  return bytes;
}

// A message of another type with a body of zeros.
Bytes image(std::size_t size)
{
  Bytes bytes(58 + size);
  put(bytes, 0, 1, 2);
  const std::string type = "IMAGE";
  std::copy(type.begin(), type.end(), bytes.begin() + 2);
  put(bytes, 42, size, 8);
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

TEST(OpenIgtLinkStream, ReadsWhatTheReferenceLibraryWritesAndTheSameOfVersion2)
{
  OpenIgtLinkStream stream;
  for (const Bytes& bytes : {bytesOf(kTransform), withMetadata(bytesOf(kTransform))})
  {
    const auto poses = posesIn(stream, bytes);
    ASSERT_EQ(poses.size(), 1U);
    expectPose(poses.front(), 10.5, -20.25, 30.0);
  }
  for (const Bytes& bytes : {bytesOf(kPosition), withMetadata(bytesOf(kPosition))})
  {
    const auto poses = posesIn(stream, bytes);
    ASSERT_EQ(poses.size(), 1U);
    expectPose(poses.front(), 1.5, -2.5, 3.5);
  }
  EXPECT_EQ(stream.refused(), 0U);
}

TEST(OpenIgtLinkStream, PutsTogetherWhatComesInPiecesBetweenOtherMessages)
{
  Bytes all;
  for (const char* message : {kStatus, kTransform, kStatus, kPosition, kStatus, kTransform})
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
  const Bytes good = withMetadata(bytesOf(kTransform));
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

TEST(OpenIgtLinkStream, NormalisesAQuaternionAndRefusesOneThatIsNone)
{
  const Bytes message = bytesOf(kPosition);
  OpenIgtLinkStream stream;
  const auto scaled = [&](float scale)
  {
    const float half = 0.70710678F * scale;
    return posesIn(stream, with(message, 3, {0.0F, 0.0F, half, half}));
  };
  for (const float scale : {0.92F, 1.0F, 1.08F, -1.0F})
  {
    const auto poses = scaled(scale);
    ASSERT_EQ(poses.size(), 1U) << scale;
    expectPose(poses.front(), 1.5, -2.5, 3.5);
  }
  EXPECT_EQ(stream.refused(), 0U);
  for (const float scale : {0.0F, 0.7F, 2.0F, std::nanf("")})
    EXPECT_TRUE(scaled(scale).empty()) << scale;
  EXPECT_TRUE(posesIn(stream, with(message, 0, {std::nanf("")})).empty());
  EXPECT_EQ(stream.refused(), 5U);
}

TEST(OpenIgtLinkStream, RefusesATransformThatIsNoRotation)
{
  const Bytes message = bytesOf(kTransform);
  const std::vector<std::vector<float>> bad = {{0, 0, 0, 0, 0, 0, 0, 0, 0},    // none
                                               {2, 0, 0, 0, 2, 0, 0, 0, 2},    // scaled
                                               {1, 0, 0, 0, 1, 0, 0, 0, -1},   // left-handed
                                               {1, 0, 0, 0.5F, 1, 0, 0, 0, 1}, // sheared
                                               {std::nanf(""), 0, 0, 0, 1, 0, 0, 0, 1}};
  OpenIgtLinkStream stream;
  for (const auto& columns : bad)
    EXPECT_TRUE(posesIn(stream, with(message, 0, columns)).empty());
  EXPECT_EQ(stream.refused(), bad.size());
  EXPECT_EQ(posesIn(stream, with(message, 0, {1, 0, 0, 0, 1, 0, 0, 0, 1})).size(), 1U);
}

TEST(OpenIgtLinkStream, TakesAToolAsMissingWhereItsMetadataSaySo)
{
  const Bytes message = bytesOf(kTransform);
  OpenIgtLinkStream stream;
  const auto missing = [&](const std::vector<std::pair<std::string, std::string>>& entries)
  {
    const auto poses = posesIn(stream, withMetadata(message, entries));
    return poses.size() == 1U && poses.front().missing;
  };
  EXPECT_TRUE(missing({{"TransformValid", "False"}, {"TransformStatus", "MISSING"}}));
  EXPECT_TRUE(missing({{"other", "x"}, {"TransformStatus", "OUT_OF_VIEW"}}));
  EXPECT_TRUE(missing({{"TransformValid", "0"}}));
  EXPECT_FALSE(missing({{"TransformValid", "True"}, {"TransformStatus", "OK"}}));
  EXPECT_FALSE(missing({}));
  EXPECT_EQ(stream.refused(), 0U);
}

TEST(TrackerServer, ShowsTheNewestPoseBehindImages)
{
  FakeTracker tracker;
  ServedDevice device(tracker.options("images"));
  const auto isAt = [&](double x)
  { return eventually([&] { return device.read(steadySeconds()).pose.position.x() == x; }); };
  tracker.send(with(bytesOf(kTransform), 9, {1.0F, 2.0F, 3.0F}));
  ASSERT_TRUE(isAt(1.0));
  Bytes burst;
  for (int i = 2; i <= 5; ++i)
  {
    const Bytes picture = image(3000000);
    const Bytes pose = with(bytesOf(kTransform), 9, {static_cast<float>(i), 2.0F, 3.0F});
    burst.insert(burst.end(), picture.begin(), picture.end());
    burst.insert(burst.end(), pose.begin(), pose.end());
  }
  tracker.send(burst);
  EXPECT_TRUE(isAt(5.0));
}

TEST(TrackerServer, SaysAtOnceThatTheTrackerReportsTheToolMissing)
{
  FakeTracker tracker;
  ServedDevice device(tracker.options("missing"));
  const auto sends = [&](const char* status, DeviceHealth health)
  {
    return eventually(
        [&]
        {
          tracker.send(withMetadata(bytesOf(kTransform), {{"TransformStatus", status}}));
          return healthOf(device) == health;
        });
  };
  ASSERT_TRUE(sends("OK", DeviceHealth::Good));
  EXPECT_TRUE(sends("MISSING", DeviceHealth::Faulty));
  EXPECT_TRUE(eventually(
      [&] { return device.status().fault.find("does not see 'Stylus'") != std::string::npos; }))
      << device.status().fault;
  EXPECT_TRUE(sends("OK", DeviceHealth::Good));
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
        tracker.send(bytesOf(kTransform));
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
    tracker.send(withMetadata(bytesOf(kPosition)));
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
