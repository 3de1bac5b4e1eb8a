#include "petrous/Phantom/SamplePatient.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <set>

#include <gdcmImageReader.h>
#include <gdcmStringFilter.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "petrous/Core/Error.h"
#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Phantom/Phantom.h"

namespace petrous::phantom
{
namespace
{

namespace fs = std::filesystem;

/// A temporary folder that is removed after the test.
class Folder
{
public:
  Folder()
    : m_path(fs::temp_directory_path() /
             ("petrous-sample-" + std::to_string(getpid()) + "-" +
              ::testing::UnitTest::GetInstance()->current_test_info()->name()))
  {
    fs::remove_all(m_path);
    fs::create_directories(m_path);
  }
  ~Folder()
  {
    std::error_code ignored;
    fs::remove_all(m_path, ignored);
  }
  const fs::path& path() const { return m_path; }

private:
  fs::path m_path;
};

/// A small volume around the labyrinth: fast, and it contains most structures.
SampleOptions small()
{
  SampleOptions options;
  options.dims = core::Index3{44, 40, 36};
  options.spacing = 0.5;
  return options;
}

std::map<std::string, std::string> contents(const fs::path& folder)
{
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
    {
      std::ifstream stream(entry.path(), std::ios::binary);
      files[entry.path().lexically_relative(folder).string()] =
          std::string(std::istreambuf_iterator<char>(stream), {});
    }
  return files;
}

struct Slice
{
  Eigen::Vector3d origin;
  Eigen::Vector3d row;
  Eigen::Vector3d column;
  Eigen::Vector3d spacing;
  std::string frame;
  std::string modality;
  std::string instance;
  std::string position; // as written
  double intercept = 0.0;
  std::vector<std::int16_t> pixels;
};

std::vector<Slice> readSeries(const fs::path& folder)
{
  std::vector<fs::path> names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.push_back(entry.path());
  std::sort(names.begin(), names.end());
  std::vector<Slice> slices;
  for (const fs::path& name : names)
  {
    gdcm::ImageReader reader;
    reader.SetFileName(name.c_str());
    EXPECT_TRUE(reader.Read()) << name;
    const gdcm::Image& image = reader.GetImage();
    gdcm::StringFilter text;
    text.SetFile(reader.GetFile());
    Slice slice;
    slice.origin = Eigen::Map<const Eigen::Vector3d>(image.GetOrigin());
    slice.row = Eigen::Map<const Eigen::Vector3d>(image.GetDirectionCosines());
    slice.column = Eigen::Map<const Eigen::Vector3d>(image.GetDirectionCosines() + 3);
    slice.spacing = Eigen::Map<const Eigen::Vector3d>(image.GetSpacing());
    slice.intercept = image.GetIntercept();
    slice.frame = text.ToString(gdcm::Tag(0x0020, 0x0052));
    slice.modality = text.ToString(gdcm::Tag(0x0008, 0x0060));
    slice.instance = text.ToString(gdcm::Tag(0x0008, 0x0018));
    slice.position = text.ToString(gdcm::Tag(0x0020, 0x0032));
    slice.pixels.resize(image.GetBufferLength() / 2);
    EXPECT_TRUE(image.GetBuffer(reinterpret_cast<char*>(slice.pixels.data())));
    slices.push_back(std::move(slice));
  }
  return slices;
}

} // namespace

TEST(SampleGrid, CentresTheEarAndFillsTheVolume)
{
  const core::GridGeometry standard = sampleGrid({});
  EXPECT_EQ(standard.dims(), (core::Index3{220, 220, 200}));
  EXPECT_NEAR(standard.minSpacing(), 0.3, 1e-12);
  EXPECT_NEAR((standard.center() - Phantom::center()).norm(), 0.0, 1e-9);

  SampleOptions cube;
  cube.dims = core::Index3{512, 512, 512};
  EXPECT_NEAR(sampleGrid(cube).minSpacing() * 512, 66.0, 1e-3);
  cube.spacing = 0.2;
  EXPECT_NEAR(sampleGrid(cube).minSpacing(), 0.2, 1e-12);
}

TEST(SampleGrid, NamesTheBadNumber)
{
  const auto refuses = [](auto change, const std::string& word)
  {
    SampleOptions options;
    change(options);
    try
    {
      sampleGrid(options);
      FAIL() << word;
    }
    catch (const core::InvalidParameter& error)
    {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  refuses([](SampleOptions& o) { o.spacing = 0.04; }, "0.04");
  refuses([](SampleOptions& o) { o.spacing = std::nan(""); }, "spacing");
  refuses([](SampleOptions& o) { o.dims = core::Index3{15, 64, 64}; }, "15");
  refuses([](SampleOptions& o) { o.dims = core::Index3{64, 64, 1025}; }, "1025");
  refuses([](SampleOptions& o) { o.noise = -1.0; }, "noise");
  refuses([](SampleOptions& o) { o.tilt = 36.0; }, "36");
}

TEST(SamplePatient, WritesTheSameBytesForASeedAndOthersForAnother)
{
  const Folder folder;
  SampleOptions options = small();
  options.dims = core::Index3{24, 24, 24};
  writeSamplePatient(folder.path() / "a", options);
  writeSamplePatient(folder.path() / "b", options);
  options.seed = 2;
  writeSamplePatient(folder.path() / "c", options);
  const auto a = contents(folder.path() / "a");
  EXPECT_EQ(a, contents(folder.path() / "b"));
  const auto c = contents(folder.path() / "c");
  EXPECT_NE(a.at("ct/slice-0001.dcm"), c.at("ct/slice-0001.dcm"));
  EXPECT_NE(a.at("truth.json"), c.at("truth.json"));
  for (const auto& file : a)
    EXPECT_EQ(file.first.find("partial"), std::string::npos) << file.first;
}

TEST(SamplePatient, CtIsWhereAndWhatItSays)
{
  const Folder folder;
  SampleOptions options = small();
  options.noise = 0.0;
  writeSamplePatient(folder.path() / "p", options);
  const core::GridGeometry grid = sampleGrid(options);
  const std::vector<Slice> ct = readSeries(folder.path() / "p/ct");
  ASSERT_EQ(ct.size(), 36U);
  std::set<std::string> instances;
  for (std::size_t k = 0; k < ct.size(); ++k)
  {
    const Slice& slice = ct[k];
    EXPECT_EQ(slice.modality, "CT");
    EXPECT_DOUBLE_EQ(slice.intercept, -1024.0);
    const Eigen::Vector3d expected = grid.patientFromVoxel(Eigen::Vector3d(0, 0, double(k)));
    EXPECT_NEAR((slice.origin - expected).norm(), 0.0, 1e-6);
    EXPECT_EQ(slice.row, Eigen::Vector3d::UnitX());
    EXPECT_EQ(slice.column, Eigen::Vector3d::UnitY());
    EXPECT_NEAR(slice.spacing[0], 0.5, 1e-9);
    EXPECT_LE(slice.instance.size(), 64U);
    instances.insert(slice.instance);
  }
  EXPECT_EQ(instances.size(), ct.size());
  // the vestibule is wide enough to contain a voxel without partial volume
  const Eigen::Vector3d voxel = grid.voxelFromPatient({-38.4, 1.0, 1.4});
  const auto index = [&](int a) { return static_cast<std::size_t>(std::lround(voxel[a])); };
  EXPECT_NEAR(ct[index(2)].pixels[index(1) * 44 + index(0)] - 1024.0, 12.0, 30.0);
}

TEST(SamplePatient, MrHasAFrameOfItsOwnAndTruthHoldsTheMotion)
{
  const Folder folder;
  writeSamplePatient(folder.path() / "p", small());
  const std::vector<Slice> ct = readSeries(folder.path() / "p/ct");
  const std::vector<Slice> mr = readSeries(folder.path() / "p/mr");
  EXPECT_EQ(mr.front().modality, "MR");
  EXPECT_NE(ct.front().frame, mr.front().frame);
  EXPECT_EQ(mr.front().frame.rfind("2.25.", 0), 0U);

  std::ifstream stream(folder.path() / "p/truth.json");
  const auto truth = nlohmann::json::parse(stream);
  ASSERT_EQ(truth["transform"].size(), 16U);
  Eigen::Matrix4d motion;
  for (int i = 0; i < 16; ++i)
    motion(i / 4, i % 4) = truth["transform"][static_cast<std::size_t>(i)].get<double>();
  EXPECT_NO_THROW(core::RigidTransform::fromMatrix(motion));
  for (const auto& structure : truth["structures"])
  {
    const double volume = structure["volume_mm3"];
    EXPECT_GE(volume, -1e-6);
    if (volume > 40.0)
    {
      EXPECT_NEAR(structure["label_volume_mm3"].get<double>(), volume, 0.06 * volume)
          << structure["name"];
    }
    if (!structure["label"].is_null())
    {
      EXPECT_TRUE(fs::exists(folder.path() / "p" / structure["label"].get<std::string>()));
    }
    if (!structure["mesh"].is_null())
    {
      // the flat cut of an incomplete one loses its sharp rim
      const double tolerance = structure["complete"] ? 0.01 * volume : 0.03 * volume + 0.5;
      EXPECT_NEAR(structure["mesh"]["volume_mm3"].get<double>(), volume, tolerance)
          << structure["name"];
      EXPECT_TRUE(fs::exists(folder.path() / "p" / structure["mesh"]["file"].get<std::string>()));
    }
  }
  EXPECT_TRUE(fs::exists(folder.path() / "p/labels.seg.nrrd"));
}

TEST(SamplePatient, TiltShearsTheSlicesAgainstTheirPlane)
{
  const Folder folder;
  SampleOptions options = small();
  options.dims = core::Index3{24, 24, 24};
  options.tilt = 20.0;
  options.noise = 0.0;
  writeSamplePatient(folder.path() / "p", options);
  const std::vector<Slice> ct = readSeries(folder.path() / "p/ct");
  const double tilt = 20.0 * 3.14159265358979323846 / 180.0;
  for (std::size_t k = 0; k < ct.size(); ++k)
  {
    EXPECT_NEAR((ct[k].column - Eigen::Vector3d(0, std::cos(tilt), std::sin(tilt))).norm(), 0.0,
                1e-9);
    if (k > 0)
    {
      EXPECT_NEAR((ct[k].origin - ct[k - 1].origin - Eigen::Vector3d(0, 0, 0.5)).norm(), 0.0, 1e-6);
    }
    std::size_t from = 0; // each decimal string holds at most 16 characters
    for (std::size_t to = 0; to <= ct[k].position.size(); ++to)
      if (to == ct[k].position.size() || ct[k].position[to] == '\\')
      {
        EXPECT_LE(to - from, 16U) << ct[k].position;
        from = to + 1;
      }
  }
  // a voxel shows the tissue at its own sheared position
  const Phantom phantom;
  int same = 0;
  int all = 0;
  for (int j = 0; j < 24; ++j)
    for (int i = 0; i < 24; ++i)
    {
      const Eigen::Vector3d p = ct[12].origin + 0.5 * (i * ct[12].row + j * ct[12].column);
      const double shown = ct[12].pixels[static_cast<std::size_t>(24 * j + i)] - 1024.0;
      ++all;
      same += std::abs(shown - phantom.hounsfield(p)) < 450.0 ? 1 : 0;
    }
  EXPECT_GT(same, 0.85 * all);
}

TEST(SamplePatient, RefusesAFolderThatIsNotEmpty)
{
  const Folder folder;
  std::ofstream(folder.path() / "mine.txt") << "keep";
  try
  {
    writeSamplePatient(folder.path(), small());
    FAIL();
  }
  catch (const core::Error& error)
  {
    EXPECT_EQ(error.fault(), core::Fault::Refused);
    EXPECT_NE(std::string(error.what()).find("not empty"), std::string::npos);
  }
  EXPECT_EQ(contents(folder.path()).size(), 1U);
  EXPECT_THROW(writeSamplePatient(folder.path() / "mine.txt", small()), core::Error);
}

TEST(SamplePatient, FillsAnEmptyFolder)
{
  const Folder folder;
  SampleOptions options = small();
  options.dims = core::Index3{16, 16, 16};
  writeSamplePatient(folder.path(), options);
  EXPECT_TRUE(fs::exists(folder.path() / "truth.json"));
  EXPECT_TRUE(fs::exists(folder.path() / "ct/slice-0016.dcm"));
}

TEST(SamplePatient, CancelLeavesNothing)
{
  const Folder folder;
  auto token = std::make_shared<core::CancelToken>();
  const core::Progress progress(
      [&](double fraction, const std::string&)
      {
        if (fraction > 0.5)
          token->cancel();
      },
      token);
  EXPECT_THROW(writeSamplePatient(folder.path() / "new/p", small(), progress),
               core::CancelledError);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(DicomWriter, RefusesWhatItCannotWriteRight)
{
  const Folder folder;
  imaging::SeriesDescription series;
  series.studyUid = imaging::deterministicUid(1, "study");
  series.seriesUid = imaging::deterministicUid(1, "series");
  series.frameOfReferenceUid = "not a uid";
  const volume::IntensityVolume image(
      std::make_shared<const volume::Volume<std::int16_t>>(core::GridGeometry(), std::int16_t{0}));
  EXPECT_THROW(imaging::writeDicomSeries(folder.path(), image, series), core::InvalidParameter);
  series.frameOfReferenceUid = imaging::deterministicUid(1, "frame");
  EXPECT_NE(series.frameOfReferenceUid, imaging::deterministicUid(2, "frame"));
  const volume::IntensityVolume real(
      std::make_shared<const volume::Volume<float>>(core::GridGeometry(), 0.3F)); // needs a rescale
  EXPECT_THROW(imaging::writeDicomSeries(folder.path(), real, series), core::InvalidParameter);
  std::ofstream(folder.path() / "file") << "x";
  try
  {
    imaging::writeDicomSeries(folder.path() / "file/ct", image, series);
    FAIL();
  }
  catch (const core::Error& error)
  {
    EXPECT_NE(std::string(error.what()).find("file/ct"), std::string::npos);
  }
}

} // namespace petrous::phantom
