#include "RireFolder.h"

#include <filesystem>
#include <fstream>
#include <random>

#include <gtest/gtest.h>
#include <unistd.h>

#include "petrous/Core/Error.h"

using namespace petrous;
using namespace petrous::registration;

namespace
{

namespace fs = std::filesystem;

// Ground truth of RIRE's training_001, CT to MR T1, as published by the project.
constexpr const char* kStandard = R"(-----------------------------------------------------------
Transformation Parameters

Investigator(s): J. M. Fitzpatrick

Site: Vanderbilt University, Nashville, TN, USA

Method: 0
Date: 12 December 1994
Patient number: 001
From: CT
To: MR-T1

Point      x          y          z        new_x       new_y       new_z

  1    0.0000     0.0000     0.0000     5.0369   -17.4970   -27.1650
  2  333.9870     0.0000     0.0000   338.0219   -43.3470   -27.4162
  3    0.0000   333.9870     0.0000    30.8808   315.3043   -16.0856
  4  333.9870   333.9870     0.0000   363.8658   289.4544   -16.3368
  5    0.0000     0.0000   112.0000     4.8333   -21.2077    84.7733
  6  333.9870     0.0000   112.0000   337.8183   -47.0576    84.5221
  7    0.0000   333.9870   112.0000    30.6772   311.5937    95.8527
  8  333.9870   333.9870   112.0000   363.6622   285.7437    95.6015

(All distances are in millimeters.)
-----------------------------------------------------------
)";

class RireFolder : public ::testing::Test
{
protected:
  void SetUp() override
  {
    m_folder = fs::temp_directory_path() / ("petrous-rire-" + std::to_string(::getpid()) + "-" +
                                            std::to_string(std::random_device{}()));
    fs::create_directories(m_folder);
  }
  void TearDown() override
  {
    std::error_code ignored;
    fs::remove_all(m_folder, ignored);
  }

  void writeText(const fs::path& path, const std::string& text) const
  {
    fs::create_directories((m_folder / path).parent_path());
    std::ofstream(m_folder / path, std::ios::binary) << text;
  }

  // Voxel n has the value n - 3: both signs.
  void writeImage(const fs::path& folder, const std::string& orientation = "L : P : H",
                  int missing = 0) const
  {
    writeText(folder / "header.ascii",
              "Group length := 10\nModality := CT\n\nSlice thickness := 4.000000\n"
              "Patient Orientation := " +
                  orientation +
                  "\n\nImage dimensions := 3\nRows := 3\nColumns := 5\nSlices := 2\n"
                  "Pixel size := 0.750000 : 0.500000\nBits allocated := 16\n");
    std::string bytes;
    for (int n = -3; n < 27 - missing; ++n)
    {
      bytes += static_cast<char>(n >> 8 & 0xFF);
      bytes += static_cast<char>(n & 0xFF);
    }
    writeText(folder / "image.bin", bytes);
  }

  fs::path m_folder;
};

} // namespace

TEST_F(RireFolder, ReadsBigEndianVoxelsRowByRow)
{
  writeImage("ct");
  const auto image = readRireImage(m_folder / "ct");
  EXPECT_EQ(image->geometry().dims(), (core::Index3{5, 3, 2}));
  EXPECT_EQ(image->geometry().spacing(), Vector3d(0.5, 0.75, 4.0));
  EXPECT_EQ(image->geometry().origin(), Vector3d(0, 0, 0));
  EXPECT_EQ(image->at(0, 0, 0), -3.0);
  EXPECT_EQ(image->at(1, 0, 0), -2.0);
  EXPECT_EQ(image->at(0, 1, 0), 2.0);
  EXPECT_EQ(image->at(4, 2, 1), 26.0);
}

TEST_F(RireFolder, TakesTheAxesFromTheOrientation)
{
  writeImage("ct", "L : F : P");
  const auto image = readRireImage(m_folder / "ct");
  EXPECT_LT(
      (image->geometry().patientFromVoxel(Vector3d(2, 2, 1)) - Vector3d(1.0, 4.0, -1.5)).norm(),
      1e-9);
}

TEST_F(RireFolder, NamesWhatIsWrong)
{
  const auto message = [this]
  {
    try
    {
      readRireImage(m_folder / "ct");
    }
    catch (const core::Error& error)
    {
      EXPECT_EQ(error.fault(), core::Fault::BadInput);
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_NE(message().find("header.ascii"), std::string::npos);
  writeImage("ct", "L : P : H", 1);
  EXPECT_NE(message().find("58 bytes"), std::string::npos) << message();
  fs::remove(m_folder / "ct" / "image.bin");
  writeText("ct/image.bin.Z", "x");
  EXPECT_NE(message().find("uncompress"), std::string::npos) << message();
  writeImage("ct", "L : L : H");
  EXPECT_NE(message().find("Orientation"), std::string::npos) << message();
}

// The matrix is that of the public ct_to_mr_T1 transform file of training_001.
TEST_F(RireFolder, FitsTheMotionOfTrainingPatientOne)
{
  writeText("ct_T1.standard", kStandard);
  const RireStandard standard = readRireStandard(m_folder / "ct_T1.standard");
  EXPECT_LT(standard.rms, 2e-4); // the file is rounded to 1e-4
  Eigen::Matrix4d truth;
  truth << 0.997000003, 0.077380155, -0.001818059, 5.03685847, -0.077397855, 0.996449628,
      -0.033131713, -17.49694636, -0.000752132, 0.033173032, 0.999449341, -27.16499259, 0, 0, 0, 1;
  EXPECT_LT((standard.toFromFrom.matrix() - truth).cwiseAbs().maxCoeff(), 1e-4);
}

TEST_F(RireFolder, RefusesATruthThatIsNoRigidMotion)
{
  std::string text = kStandard;
  text.replace(text.find("315.3043"), 8, "325.3043");
  writeText("bent.standard", text);
  EXPECT_THROW(readRireStandard(m_folder / "bent.standard"), core::Error);
  writeText("short.standard", text.substr(0, text.find("  8 ")));
  EXPECT_THROW(readRireStandard(m_folder / "short.standard"), core::Error);
}

TEST_F(RireFolder, PairsEachMrWithItsTruth)
{
  EXPECT_THROW(rirePairs(m_folder), core::Error);
  writeImage("training_001/ct");
  writeImage("training_001/mr_T1");
  writeImage("training_001/mr_PD");
  writeImage("patient_002/ct");
  writeImage("patient_002/mr_T1");
  writeText("training_001/transformations/ct_T1.standard", kStandard);
  const auto pairs = rirePairs(m_folder);
  ASSERT_EQ(pairs.size(), 3U);
  EXPECT_EQ(pairs[0].name, "RIRE patient_002 CT, MR T1");
  EXPECT_FALSE(pairs[0].truth);
  EXPECT_EQ(pairs[1].name, "RIRE training_001 CT, MR PD");
  EXPECT_FALSE(pairs[1].truth);
  ASSERT_TRUE(pairs[2].truth);
  EXPECT_LT(
      (pairs[2].truth(Vector3d(333.987, 0, 112)) - Vector3d(337.8183, -47.0576, 84.5221)).norm(),
      1e-3);
}
