#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "FakeTracker.h"
#include "OpenIgtLinkStream.h"

using namespace petrous;
using namespace petrous::devices;
using namespace petrous::devices::testing;
using haptics::DeviceHealth;
using haptics::DeviceReading;

namespace
{

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
