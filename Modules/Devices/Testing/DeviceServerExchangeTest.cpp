#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "DeviceServer.h"
#include "petrous/Devices/DeviceServerExchange.h"

namespace
{

petrous_device_wrench wrenchOf(std::uint64_t tick, double force)
{
  petrous_device_wrench wrench{};
  wrench.tick = tick;
  wrench.force[0] = force;
  return wrench;
}

void send(petrous_device_block& block, const petrous_device_wrench& wrench)
{
  petrous_device_put(&block.wrench_sequence, block.wrench, &wrench);
}

constexpr std::int64_t kMs = 1000000;

} // namespace

TEST(DeviceServerExchange, GivesNothingBeforeTheFirstPose)
{
  petrous_device_block block{};
  petrous_device_pose pose{};
  pose.buttons = 9;
  EXPECT_EQ(petrous_device_get(&block.pose_sequence, block.pose, &pose), 0U);
  EXPECT_EQ(pose.buttons, 9U);
}

TEST(DeviceServerExchange, GivesTheLatestPose)
{
  petrous_device_block block{};
  std::uint64_t last = 0;
  for (int i = 1; i <= 3; ++i)
  {
    petrous_device_pose pose{};
    pose.position[1] = 0.5 * i;
    pose.pedal = 0.1;
    petrous_device_put(&block.pose_sequence, block.pose, &pose);
    petrous_device_pose copy{};
    const std::uint64_t sequence = petrous_device_get(&block.pose_sequence, block.pose, &copy);
    EXPECT_GT(sequence, last);
    last = sequence;
    EXPECT_EQ(copy.position[1], 0.5 * i);
    EXPECT_EQ(copy.pedal, 0.1);
  }
}

TEST(DeviceServerExchange, KeepsTheReaderFromAPoseWhoseWriterDiedAndHealsWithTheNext)
{
  petrous_device_block block{};
  petrous_device_pose pose{};
  petrous_device_put(&block.pose_sequence, block.pose, &pose);
  block.pose_sequence += 1; // as left by a writer killed between the words
  EXPECT_EQ(petrous_device_get(&block.pose_sequence, block.pose, &pose), 0U);
  pose.position[0] = 4.0;
  petrous_device_put(&block.pose_sequence, block.pose, &pose);
  petrous_device_pose copy{};
  EXPECT_EQ(petrous_device_get(&block.pose_sequence, block.pose, &copy), 4U);
  EXPECT_EQ(copy.position[0], 4.0);
}

TEST(DeviceServerExchange, NeverGivesHalfAPoseBesideAWriter)
{
  petrous_device_block block{};
  std::atomic<bool> done{false};
  std::thread writer(
      [&]
      {
        petrous_device_pose pose{};
        while (!done)
        {
          for (int i = 0; i < 200; ++i)
          {
            pose.time_ns += 1;
            pose.echo = pose.time_ns;
            pose.buttons = pose.time_ns;
            pose.reserved[3] = pose.time_ns;
            petrous_device_put(&block.pose_sequence, block.pose, &pose);
          }
          // A reader of one slot starves next to a writer that never pauses; a device does pause.
          std::this_thread::sleep_for(std::chrono::microseconds(1));
        }
      });
  std::uint64_t different = 0;
  std::uint64_t torn = 0;
  std::uint64_t last = 0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (different < 1000 && std::chrono::steady_clock::now() < end)
  {
    petrous_device_pose pose{};
    if (petrous_device_get(&block.pose_sequence, block.pose, &pose) == 0)
      continue;
    different += pose.time_ns != last;
    last = pose.time_ns;
    torn += pose.echo != last || pose.buttons != last || pose.reserved[3] != last;
  }
  done = true;
  writer.join();
  EXPECT_GT(different, 10U);
  EXPECT_EQ(torn, 0U);
}

TEST(DeviceServerExchange, TurnsTheMotorsOffAfterFiftyMillisecondsOfSilence)
{
  petrous_device_block block{};
  petrous_device_guard guard{};
  EXPECT_EQ(petrous_device_wrench_now(&block, &guard, 100 * kMs).tick, 0U);
  send(block, wrenchOf(1, 2.5));
  EXPECT_EQ(petrous_device_wrench_now(&block, &guard, 101 * kMs).force[0], 2.5);
  EXPECT_EQ(petrous_device_wrench_now(&block, &guard, 151 * kMs).force[0], 2.5);
  const petrous_device_wrench silent = petrous_device_wrench_now(&block, &guard, 152 * kMs);
  EXPECT_EQ(silent.force[0], 0.0);
  EXPECT_EQ(silent.tick, 0U);
  send(block, wrenchOf(2, 1.5));
  EXPECT_EQ(petrous_device_wrench_now(&block, &guard, 300 * kMs).force[0], 1.5);
}

TEST(DeviceServerExchange, TakesNoWrenchThatLayThereBeforeTheServerCame)
{
  petrous_device_block block{};
  send(block, wrenchOf(77, 3.0));
  petrous_device_guard guard{};
  EXPECT_EQ(petrous_device_wrench_now(&block, &guard, 100 * kMs).force[0], 0.0);
  EXPECT_EQ(petrous_device_wrench_now(&block, &guard, 101 * kMs).force[0], 0.0);
  send(block, wrenchOf(78, 3.0));
  EXPECT_EQ(petrous_device_wrench_now(&block, &guard, 102 * kMs).force[0], 3.0);
}

TEST(DeviceServerExchange, GivesTheMotorsZeroForAWrenchThatIsNoNumber)
{
  petrous_device_block block{};
  petrous_device_guard guard{};
  petrous_device_wrench_now(&block, &guard, 0);
  petrous_device_wrench wrench = wrenchOf(1, 1.0);
  wrench.torque[2] = std::nan("");
  send(block, wrench);
  EXPECT_EQ(petrous_device_wrench_now(&block, &guard, kMs).force[0], 0.0);
}

TEST(DeviceServerExchange, CutsTextsThatAreTooLong)
{
  petrous_device_block block{};
  petrous_device_text(block.name, sizeof block.name, std::string(200, 'x').c_str());
  EXPECT_EQ(std::strlen(block.name), sizeof block.name - 1);
  petrous_device_text(block.name, sizeof block.name, "Touch");
  EXPECT_STREQ(block.name, "Touch");
}

TEST(DeviceServer, QuaternionOfARotationMatrixIsEigens)
{
  // Half turns about each axis and rotations between, where each of the components is the largest.
  for (int n = 0; n < 200; ++n)
  {
    const Eigen::Vector3d axis =
        Eigen::Vector3d(std::cos(1.7 * n), std::sin(2.3 * n), std::cos(0.9 * n + 1.0)).normalized();
    const Eigen::Matrix3d rotation =
        n < 3 ? Eigen::AngleAxisd(3.14159265358979, Eigen::Vector3d::Unit(n)).toRotationMatrix()
              : Eigen::AngleAxisd(0.0315 * n, axis).toRotationMatrix();
    double matrix[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        matrix[i][j] = rotation(i, j);
    double q[4];
    petrous_device_quaternion(matrix, q);
    const Eigen::Quaterniond expected(rotation);
    EXPECT_NEAR(std::abs(expected.dot(Eigen::Quaterniond(q[0], q[1], q[2], q[3]))), 1.0, 1e-12)
        << n;
  }
}
