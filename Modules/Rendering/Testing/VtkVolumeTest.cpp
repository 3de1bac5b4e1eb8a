#include "petrous/Rendering/VtkVolume.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>
#include <vtkMatrix3x3.h>
#include <vtkOutputWindow.h>
#include <vtkSetGet.h>

#include "SyntheticScenes.h"
#include "petrous/Core/Log.h"
#include "petrous/Rendering/RenderingError.h"

using namespace petrous;
using namespace petrous::rendering;

namespace
{
core::GridGeometry grid()
{
  return {{3, 4, 5}, {0.4, 0.5, 0.6}, {-10.0, 20.0, 30.0}, synthetic::obliqueMirrored()};
}
} // namespace

TEST(VtkVolume, SharesTheMemory)
{
  const auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid(), std::int16_t{7});
  const auto image = wrap<std::int16_t>(voxels);
  EXPECT_EQ(image->GetScalarPointer(), voxels->data());
  EXPECT_EQ(image->GetScalarType(), VTK_SHORT);
}

TEST(VtkVolume, KeepsTheVolumeAliveAndLetsItGo)
{
  auto voxels = std::make_shared<volume::Volume<float>>(grid(), 1.5F);
  const std::weak_ptr<const volume::Volume<float>> watch = voxels;
  auto image = wrap<float>(voxels);
  voxels.reset();
  EXPECT_FALSE(watch.expired());
  EXPECT_EQ(image->GetScalarComponentAsDouble(2, 3, 4, 0), 1.5);
  image = nullptr;
  EXPECT_TRUE(watch.expired());
}

TEST(VtkVolume, PlacesEveryVoxelWhereThePatientHasIt)
{
  const auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid(), std::uint16_t{0});
  const auto image = wrap<std::uint16_t>(voxels);
  const Eigen::Vector3d index(2.0, 1.0, 4.0);
  Eigen::Vector3d patient;
  image->TransformContinuousIndexToPhysicalPoint(index.data(), patient.data());
  EXPECT_TRUE(patient.isApprox(grid().patientFromVoxel(index), 1e-12));
}

TEST(VtkVolume, TakesEveryTypeOfAnImage)
{
  const auto image = wrap(*synthetic::ball<float>(synthetic::cube(6, 1.0), 2.0));
  EXPECT_EQ(image->GetScalarType(), VTK_FLOAT);
}

TEST(ToolkitMessages, OfVtkGoToTheLogWithoutTheirText)
{
  core::log::Setup setup;
  setup.file = std::filesystem::temp_directory_path() /
               ("petrous-vtk-" + std::to_string(::getpid()) + ".log");
  core::log::start(setup);
  logToolkitMessages();
  ::testing::internal::CaptureStderr();
  vtkGenericWarningMacro("cannot read /data/Meier^Anna.vti");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  vtkOutputWindow::SetInstance(nullptr);
  setup.level = core::log::Level::Off;
  core::log::start(setup);
  std::string line;
  std::getline(std::ifstream(setup.file), line);
  EXPECT_NE(line.find(" warning VTK message, VtkVolumeTest.cpp:"), std::string::npos) << line;
  EXPECT_EQ(line.find("Meier"), std::string::npos);
  std::filesystem::remove(setup.file);
}
