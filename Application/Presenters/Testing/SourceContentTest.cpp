#include <random>

#include <gtest/gtest.h>

#include <unistd.h>

#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Imaging/VolumeFile.h"
#include "petrous/Phantom/SamplePatient.h"
#include "petrous/Presenters/SourceContent.h"

using namespace petrous;
using Eigen::Vector3d;
using presenters::Content;

namespace
{

const core::GridGeometry kGrid({24, 20, 16}, Vector3d::Constant(0.5), Vector3d::Zero());

// A voxel's value from its position, -1 to 1 in each axis.
template <class T, class Value>
std::shared_ptr<const volume::Volume<T>> filled(const Value& value)
{
  auto image = std::make_shared<volume::Volume<T>>(kGrid);
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < 24; ++i)
        image->at(i, j, k) =
            static_cast<T>(value(Vector3d(i / 11.5 - 1.0, j / 9.5 - 1.0, k / 7.5 - 1.0)));
  return image;
}

template <class T, class Value>
Content contentOf(const Value& value)
{
  return presenters::contentOf(volume::IntensityVolume(filled<T>(value)));
}

class SourceContent : public ::testing::Test
{
protected:
  void SetUp() override
  {
    m_folder =
        std::filesystem::temp_directory_path() / ("petrous-content-" + std::to_string(::getpid()));
    std::filesystem::create_directories(m_folder);
  }
  void TearDown() override { std::filesystem::remove_all(m_folder); }
  Content at(const std::string& name) const
  {
    return presenters::lookAt(m_folder / name, {}).content;
  }
  std::filesystem::path m_folder;
};

double headInHounsfield(const Vector3d& at)
{
  const double r = at.norm();
  return r > 0.9 ? -1000.0 : r > 0.7 ? 1100.0 + 100.0 * at.x() : 40.0 + 10.0 * at.y();
}

} // namespace

TEST(Content, HounsfieldUnitsAreACt)
{
  EXPECT_EQ(contentOf<std::int16_t>(headInHounsfield), Content::Ct);
  EXPECT_EQ(contentOf<float>(headInHounsfield), Content::Ct);
}

TEST(Content, UnitsOfTheirOwnAreInDoubt)
{
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 12.0);
  const auto mr = [&](const Vector3d& at)
  { return at.norm() > 0.9 ? std::abs(noise(random)) : std::abs(120.0 + noise(random)); };
  EXPECT_EQ(contentOf<std::uint16_t>(mr), Content::Image);
  EXPECT_EQ(contentOf<std::int16_t>(mr), Content::Image);
  EXPECT_EQ(contentOf<float>([&](const Vector3d& at) { return 7.3 * mr(at); }), Content::Image);
  const auto coneBeam = [](const Vector3d& at)
  { return 8000.0 + 20.0 * headInHounsfield(at) + 20000.0; };
  EXPECT_EQ(contentOf<std::uint16_t>(coneBeam), Content::Image);
}

// A masked 8-bit MR: few values, many of them 0.
TEST(Content, AnMrOfEightBitsIsNoLabelMap)
{
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 12.0);
  const auto brain = [&](const Vector3d& at)
  { return at.norm() > 0.9 ? 0.0 : std::clamp(std::round(120.0 + noise(random)), 0.0, 255.0); };
  EXPECT_EQ(contentOf<std::int16_t>(brain), Content::Image);
}

TEST(Content, FewWholeNumbersInPatchesAreLabels)
{
  const auto two = [](const Vector3d& at) {
    return at.norm() < 0.4 ? 2.0 : at.norm() < 0.6 ? 1.0 : 0.0;
  };
  EXPECT_EQ(contentOf<std::int16_t>(two), Content::Labels);
  EXPECT_EQ(contentOf<std::uint16_t>(two), Content::Labels);
  EXPECT_EQ(contentOf<float>(two), Content::Labels);
  const auto thirty = [](const Vector3d& at) {
    return std::floor(5.99 * (0.5 * at.x() + 0.5)) + 6.0 * std::floor(4.99 * (0.5 * at.y() + 0.5));
  };
  EXPECT_EQ(contentOf<std::int16_t>(thirty), Content::Labels);
  // A nerve one voxel thin, oblique, whose voxels touch only at corners.
  const auto thread = [](const Vector3d& at)
  {
    const int i = static_cast<int>(std::lround(11.5 * (at.x() + 1.0)));
    const int j = static_cast<int>(std::lround(9.5 * (at.y() + 1.0)));
    const int k = static_cast<int>(std::lround(7.5 * (at.z() + 1.0)));
    return i == j && j == k ? 255.0 : 0.0;
  };
  EXPECT_EQ(contentOf<std::int16_t>(thread), Content::Labels);
  EXPECT_EQ(contentOf<float>([&](const Vector3d& at) { return 0.5 * two(at); }), Content::Image);
  EXPECT_NE(contentOf<std::int16_t>([](const Vector3d&) { return 0.0; }), Content::Labels);
}

TEST_F(SourceContent, IsKnownOfEachKindOfFile)
{
  phantom::SampleOptions options;
  options.spacing = 1.5;
  phantom::writeSamplePatient(m_folder, options);
  EXPECT_EQ(at("ct"), Content::Ct);
  EXPECT_EQ(at("mr"), Content::Mr);
  EXPECT_EQ(at("labels.seg.nrrd"), Content::Labels);
  imaging::writeVolume(m_folder / "ear.nrrd", *filled<std::int16_t>(headInHounsfield));
  EXPECT_EQ(at("ear.nrrd"), Content::Ct);
  auto labels = filled<std::uint16_t>([](const Vector3d& a) { return a.norm() < 0.5 ? 3.0 : 0.0; });
  imaging::writeLabelFile(m_folder / "x.nii.gz", volume::makeLabelMap(std::move(labels), {}));
  EXPECT_EQ(at("x.nii.gz"), Content::Labels);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(m_folder / "meshes"))
  {
    EXPECT_EQ(presenters::lookAt(entry.path(), {}).content, Content::Mesh);
    break;
  }
}

TEST_F(SourceContent, OfAFolderWithCtAndMrTheUserSaysWhich)
{
  phantom::SampleOptions options;
  options.spacing = 1.5;
  phantom::writeSamplePatient(m_folder, options);
  std::filesystem::create_directory(m_folder / "visit");
  std::filesystem::rename(m_folder / "ct", m_folder / "visit" / "ct");
  std::filesystem::rename(m_folder / "mr", m_folder / "visit" / "mr");
  const auto found = presenters::lookAt(m_folder / "visit", {});
  ASSERT_EQ(found.series.size(), 2u);
  EXPECT_EQ(found.series[0].content, Content::Ct);
  EXPECT_EQ(found.series[1].content, Content::Mr);
  EXPECT_GT(found.series[0].slices, 10u);
  EXPECT_EQ(found.series[0].folder, "ct");
  EXPECT_EQ(found.series[1].folder, "mr");
  EXPECT_EQ(found.series[0].taken, "20200101 1200"); // as written by the test
  EXPECT_EQ(found.series[0].patientPosition, "HFS");
}
