#include "petrous/Rendering/PrintPicture.h"

#include <cmath>

#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include "petrous/Core/Error.h"

using namespace petrous;
using rendering::PrintSize;

TEST(PrintSize, IsPixelsOfMillimetresAndDotsPerInch)
{
  PrintSize size;
  size.widthMillimetres = 254.0;
  size.dotsPerInch = 300.0;
  size.heightToWidth = 0.5;
  EXPECT_EQ(size.width(), 3000);
  EXPECT_EQ(size.height(), 1500);
  EXPECT_NO_THROW(size.validate());
  size.dotsPerInch = 2400.0;
  EXPECT_THROW(size.validate(), core::InvalidParameter);
  size.widthMillimetres = 0.1;
  size.dotsPerInch = 72.0;
  EXPECT_THROW(size.validate(), core::InvalidParameter);
}

TEST(PrintPicture, KnowsTheMillimetresOfAPixel)
{
  core::CameraPose camera;
  camera.position = {0.0, -100.0, 0.0};
  camera.focalPoint = {0.0, 0.0, 0.0};
  camera.viewAngle = 90.0; // sees 200 mm there
  EXPECT_NEAR(rendering::millimetresPerPixel(camera, 400), 0.5, 1e-12);
  camera.parallelScale = 30.0;
  EXPECT_NEAR(rendering::millimetresPerPixel(camera, 600), 0.1, 1e-12);
}

TEST(PrintPicture, StatesItsResolutionInThePng)
{
  rendering::Picture picture{2, 1, {255, 0, 0, 0, 0, 255}};
  const auto png = rendering::pngOf(picture, 300.0);
  const std::string bytes(png.begin(), png.end());
  const std::size_t at = bytes.find("pHYs");
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(at, 37U) << "directly after IHDR";
  // 300 / 25.4 mm = 11811 dots a metre = 0x2e23, and the checksum that other programs write
  EXPECT_EQ(bytes.substr(at - 4, 21), std::string("\x00\x00\x00\x09pHYs\x00\x00\x2e\x23\x00\x00"
                                                  "\x2e\x23\x01\x78\xa5\x3f\x76",
                                                  21));
  vtkNew<vtkPNGReader> reader;
  reader->SetMemoryBuffer(png.data());
  reader->SetMemoryBufferLength(static_cast<vtkIdType>(png.size()));
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetScalarComponentAsDouble(0, 0, 0, 0), 255.0);
  EXPECT_EQ(reader->GetOutput()->GetScalarComponentAsDouble(1, 0, 0, 2), 255.0);
}
