#include <array>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "petrous/Core/AxesCorrection.h"
#include "petrous/Core/Error.h"

using namespace petrous::core;
using Eigen::Vector3d;

namespace
{

/// The 48 signed permutations: 6 orders of the axes, 8 signs of each.
std::vector<std::string> allTexts()
{
  const std::string ends[] = {"LR", "PA", "SI"};
  std::vector<std::string> texts;
  for (const auto& order : {std::array{0, 1, 2}, std::array{0, 2, 1}, std::array{1, 0, 2},
                            std::array{1, 2, 0}, std::array{2, 0, 1}, std::array{2, 1, 0}})
    for (std::size_t signs = 0; signs < 8; ++signs)
    {
      std::string text;
      for (std::size_t n = 0; n < 3; ++n)
        text += ends[order[n]][signs >> n & 1];
      texts.push_back(text);
    }
  return texts;
}

GridGeometry oblique()
{
  const Eigen::Matrix3d direction =
      Eigen::AngleAxisd(0.4, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  return {{40, 30, 20}, {0.45, 0.5, 1.25}, {-100.0, 35.5, 712.25}, direction};
}

} // namespace

TEST(AxesCorrection, StatesWhereTheFilesAxesReallyPoint)
{
  const AxesCorrection mirrored = AxesCorrection::parse("RPS");
  EXPECT_EQ(mirrored.matrix() * Vector3d(3, 5, 7), Vector3d(-3, 5, 7));
  EXPECT_TRUE(mirrored.isMirroring());
  const AxesCorrection turned = AxesCorrection::parse("RAS"); // half a turn about the long axis
  EXPECT_EQ(turned.matrix() * Vector3d(3, 5, 7), Vector3d(-3, -5, 7));
  EXPECT_FALSE(turned.isMirroring());
  // What the file calls left is superior, its posterior left, its superior anterior.
  const AxesCorrection permuted = AxesCorrection::parse("SLA");
  EXPECT_EQ(permuted.matrix() * Vector3d(3, 5, 7), Vector3d(5, -7, 3));
  EXPECT_EQ(permuted.letter(2), 'A');
  EXPECT_TRUE(AxesCorrection().isIdentity());
  EXPECT_EQ(AxesCorrection().letters(), "LPS");
}

TEST(AxesCorrection, ReadsAndWritesEverySignedPermutation)
{
  std::size_t mirroring = 0;
  for (const std::string& text : allTexts())
  {
    const AxesCorrection one = AxesCorrection::parse(text);
    EXPECT_EQ(one.letters(), text);
    mirroring += one.isMirroring();
    EXPECT_TRUE((one * one.inverse()).isIdentity()) << text;
    EXPECT_TRUE((one.inverse() * one).isIdentity()) << text;
    EXPECT_EQ(one.isIdentity(), text == "LPS");
    for (const char* other : {"SLA", "RPI"})
      EXPECT_EQ((one * AxesCorrection::parse(other)).matrix(),
                one.matrix() * AxesCorrection::parse(other).matrix());
  }
  EXPECT_EQ(mirroring, 24U);
  EXPECT_EQ(AxesCorrection::parse("rpf"), AxesCorrection::parse("RPI"));
  EXPECT_EQ(AxesCorrection::parse("LPH"), AxesCorrection());
}

TEST(AxesCorrection, RefusesWhatIsNoPermutation)
{
  for (const char* text : {"", "L", "LP", "LPSS", "LRS", "LLS", "LPX", "LAP", "SIH", "L S", "ras!"})
    EXPECT_THROW(AxesCorrection::parse(text), InvalidParameter) << text;
}

// Of the voxel a known way left, behind and above the centre by the file.
TEST(AxesCorrection, MovesTheVoxelsOfAGridAboutItsCentre)
{
  const GridGeometry stated = oblique();
  const Vector3d voxel(31, 4, 17);
  const Vector3d byFile = stated.patientFromVoxel(voxel) - stated.center();
  const GridGeometry mirrored = AxesCorrection::parse("RPS").applied(stated);
  EXPECT_LT((mirrored.center() - stated.center()).norm(), 1e-9);
  EXPECT_LT((mirrored.patientFromVoxel(voxel) - stated.center() -
             Vector3d(-byFile[0], byFile[1], byFile[2]))
                .norm(),
            1e-9);
  EXPECT_LT(mirrored.direction().determinant(), 0.0) << "left-handed";
  EXPECT_DOUBLE_EQ(mirrored.voxelVolume(), stated.voxelVolume());
  const GridGeometry permuted = AxesCorrection::parse("SLA").applied(stated);
  EXPECT_LT((permuted.patientFromVoxel(voxel) - stated.center() -
             Vector3d(byFile[1], -byFile[2], byFile[0]))
                .norm(),
            1e-9);
  EXPECT_LT(permuted.direction().determinant(), 0.0) << "a cycle, and one axis turned round";
  EXPECT_GT(AxesCorrection::parse("LSA").applied(stated).direction().determinant(), 0.0)
      << "a quarter of a turn about the left-right axis";
  for (const std::string& text : allTexts())
  {
    const AxesCorrection one = AxesCorrection::parse(text);
    EXPECT_TRUE(sameGrid(one.inverse().applied(one.applied(stated)), stated)) << text;
    EXPECT_EQ(sameGrid(one.applied(stated), stated), one.isIdentity()) << text;
  }
  // What lies elsewhere in the file's space goes with it.
  const GridGeometry part = stated.cropped({{2, 3, 4}, {10, 9, 8}});
  EXPECT_TRUE(sameGrid(AxesCorrection::parse("RPS").applied(part, stated.center()),
                       mirrored.cropped({{2, 3, 4}, {10, 9, 8}})));
}
