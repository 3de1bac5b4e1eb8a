#include "petrous/Rendering/Picture.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

#include <gtest/gtest.h>

#include <unistd.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include "petrous/Rendering/RenderingError.h"

using namespace petrous::rendering;
namespace fs = std::filesystem;

namespace
{

class PictureFiles : public ::testing::Test
{
protected:
  void SetUp() override
  {
    m_folder = fs::temp_directory_path() / ("petrous-picture-" + std::to_string(::getpid()));
    fs::create_directories(m_folder);
  }
  void TearDown() override { fs::remove_all(m_folder); }
  fs::path m_folder;
};

Picture twoByTwo()
{
  return {2, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 10, 20, 30}};
}

} // namespace

TEST_F(PictureFiles, PngHasRowsFromTheTop)
{
  const fs::path file = m_folder / "a.png";
  writePng(file, twoByTwo());
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  const auto* bottom = static_cast<unsigned char*>(reader->GetOutput()->GetScalarPointer(1, 0, 0));
  const auto* top = static_cast<unsigned char*>(reader->GetOutput()->GetScalarPointer(0, 1, 0));
  EXPECT_EQ(bottom[0], 10);
  EXPECT_EQ(top[0], 255);
}

TEST_F(PictureFiles, LeaveNothingElseBehind)
{
  writePng(m_folder / "a.png", twoByTwo());
  writePng(m_folder / "a.png", twoByTwo());
  EXPECT_EQ(std::distance(fs::directory_iterator(m_folder), fs::directory_iterator()), 1);
}

TEST_F(PictureFiles, NameTheFileThatCannotBeWritten)
{
  const fs::path file = m_folder / "missing" / "a.png";
  try
  {
    writePng(file, twoByTwo());
    FAIL();
  }
  catch (const RenderingError& error)
  {
    EXPECT_EQ(error.reason, RenderingError::Reason::CannotWrite);
    EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos);
  }
}

TEST_F(PictureFiles, RefuseAPictureWithoutItsPixels)
{
  EXPECT_THROW(writePng(m_folder / "a.png", Picture{3, 3, {1, 2, 3}}), RenderingError);
  EXPECT_FALSE(fs::exists(m_folder / "a.png"));
}

TEST_F(PictureFiles, NpyIsVersionOneLittleEndianRowsFirst)
{
  const fs::path file = m_folder / "depth.npy";
  writeNpy(file, {2, 1, {1.25F, std::numeric_limits<float>::quiet_NaN()}});
  std::ifstream in(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  ASSERT_GT(bytes.size(), 10U);
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t header =
      static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
  EXPECT_EQ((10 + header) % 64, 0U);
  ASSERT_EQ(bytes.size(), 10 + header + 8);
  EXPECT_NE(bytes.find("'descr': '<f4', 'fortran_order': False, 'shape': (1, 2), }"),
            std::string::npos);
  float values[2];
  std::memcpy(values, bytes.data() + 10 + header, sizeof values);
  EXPECT_EQ(values[0], 1.25F);
  EXPECT_TRUE(std::isnan(values[1]));
}

TEST(Picture, CountsPixelsThatDiffer)
{
  Picture other = twoByTwo();
  EXPECT_EQ(countDifferentPixels(twoByTwo(), other), 0U);
  other.rgb[4] = 254;
  other.rgb[5] = 1;
  EXPECT_EQ(countDifferentPixels(twoByTwo(), other), 1U);
  EXPECT_EQ(countDifferentPixels(twoByTwo(), Picture{1, 1, {0, 0, 0}}), 4U);
}
