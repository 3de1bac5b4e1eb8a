// Compressed pixels, written by GDCM's encoders from the same uncompressed files.
#include <fstream>
#include <iterator>

#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmImageReader.h>
#include <gdcmImageWriter.h>
#include <gdcmReader.h>
#include <gdcmWriter.h>
#include <gtest/gtest.h>

#include "TestDicom.h"
#include "petrous/Imaging/DicomReader.h"

namespace petrous::imaging
{
namespace
{

namespace fs = std::filesystem;
using test::TemporaryFolder;
using test::TestSlice;
using test::writeSeries;
using volume::IntensityVolume;

IntensityVolume readFolder(const fs::path& folder)
{
  const ScanResult result = scanDicom(folder, {});
  return readSeries(chooseSeries(result, folder), {}, {});
}

std::uint32_t ramp(int i, int j, int k)
{
  return static_cast<std::uint32_t>(17 * i + 31 * j + 101 * k);
}

/// Writes `from` in another transfer syntax.
void compress(const fs::path& from, const fs::path& to, gdcm::TransferSyntax::TSType syntax)
{
  gdcm::ImageReader reader;
  reader.SetFileName(from.c_str());
  ASSERT_TRUE(reader.Read());
  gdcm::ImageChangeTransferSyntax change;
  change.SetTransferSyntax(syntax);
  change.SetInput(reader.GetImage());
  ASSERT_TRUE(change.Change());
  gdcm::ImageWriter writer;
  writer.SetFileName(to.c_str());
  writer.SetFile(reader.GetFile());
  writer.SetImage(change.GetOutput());
  ASSERT_TRUE(writer.Write());
}

class PixelCodec : public testing::TestWithParam<gdcm::TransferSyntax::TSType>
{
};

TEST_P(PixelCodec, EqualsTheUncompressedSeriesToTheBit)
{
  for (const bool isSigned : {false, true})
  {
    const TemporaryFolder folder;
    writeSeries(folder.path() / "raw", 3,
                [&](int k, TestSlice& s)
                {
                  s.columns = 40;
                  s.rows = 30;
                  s.isSigned = isSigned;
                  s.bitsStored = isSigned ? 16 : 12;
                  s.intercept = isSigned ? 0 : -1024;
                  s.cell = [k, isSigned](int i, int j)
                  { return 0xFFFFU & (ramp(i, j, k) - (isSigned ? 1000U : 0U)); };
                });
    fs::create_directories(folder.path() / "packed");
    for (const char* name : {"s0.dcm", "s1.dcm", "s2.dcm"})
      compress(folder.path() / "raw" / name, folder.path() / "packed" / name, GetParam());
    const IntensityVolume raw = readFolder(folder.path() / "raw");
    const IntensityVolume packed = readFolder(folder.path() / "packed");
    ASSERT_TRUE(core::sameGrid(raw.geometry(), packed.geometry(), 1e-9));
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 30; ++j)
        for (int i = 0; i < 40; ++i)
          ASSERT_EQ(raw.at(i, j, k), packed.at(i, j, k)) << i << " " << j << " " << k;
  }
}

TEST_P(PixelCodec, RefusesACodestreamOfAnotherSize)
{
  const TemporaryFolder folder;
  writeSeries(folder.path() / "raw", 2,
              [](int k, TestSlice& s)
              {
                s.columns = 40;
                s.rows = 30;
                s.cell = [k](int i, int j) { return ramp(i, j, k); };
              });
  for (const char* name : {"s0.dcm", "s1.dcm"})
  {
    const fs::path file = folder.path() / name;
    compress(folder.path() / "raw" / name, file, GetParam());
    std::ifstream stream(file, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    const std::size_t rows = bytes.find(std::string("\x28\x00\x10\x00US\x02\x00", 8));
    ASSERT_NE(rows, std::string::npos);
    bytes[rows + 8] = 37;
    test::writeText(file, bytes);
  }
  fs::remove_all(folder.path() / "raw");
  EXPECT_THROW(readFolder(folder.path()), DicomError);
}

/// Output on stderr by the program and its libraries during the action.
template <class Action>
std::string saidDuring(const Action& action)
{
  testing::internal::CaptureStderr();
  action();
  return testing::internal::GetCapturedStderr();
}

// The libraries' messages may quote the file, and would mix with those of this program.
TEST_P(PixelCodec, SaysNothingOfItsOwnAboutSpoiltBytes)
{
  const TemporaryFolder folder;
  writeSeries(folder.path() / "raw", 2,
              [](int k, TestSlice& s)
              {
                s.columns = 40;
                s.rows = 30;
                s.cell = [k](int i, int j) { return ramp(i, j, k); };
              });
  for (const char* name : {"s0.dcm", "s1.dcm"})
    compress(folder.path() / "raw" / name, folder.path() / name, GetParam());
  fs::remove_all(folder.path() / "raw");
  std::ifstream stream(folder.path() / "s1.dcm", std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(stream)),
                          std::istreambuf_iterator<char>());
  const std::size_t pixels = whole.find(std::string("\xe0\x7f\x10\x00", 4));
  ASSERT_NE(pixels, std::string::npos);
  const std::string said = saidDuring(
      [&]
      {
        for (std::size_t n = 0; n < 120; ++n)
        {
          std::string spoilt = whole;
          const std::size_t at = pixels + 12 + n * (whole.size() - pixels - 13) / 119;
          spoilt[at] = static_cast<char>(spoilt[at] ^ (1 << n % 8));
          test::writeText(folder.path() / "s1.dcm", spoilt);
          try
          {
            readFolder(folder.path());
          }
          catch (const DicomError&)
          {
          }
        }
      });
  EXPECT_EQ(said, "");
}

INSTANTIATE_TEST_SUITE_P(Syntaxes, PixelCodec,
                         testing::Values(gdcm::TransferSyntax::RLELossless,
                                         gdcm::TransferSyntax::JPEGLosslessProcess14_1,
                                         gdcm::TransferSyntax::JPEGLSLossless,
                                         gdcm::TransferSyntax::JPEG2000Lossless));

TEST(PixelCodecDeflated, ReadsADeflatedSeries)
{
  const TemporaryFolder folder;
  writeSeries(folder.path() / "raw", 2,
              [](int k, TestSlice& s) { s.cell = [k](int i, int j) { return ramp(i, j, k); }; });
  fs::create_directories(folder.path() / "packed");
  for (const char* name : {"s0.dcm", "s1.dcm"})
  {
    gdcm::Reader reader;
    reader.SetFileName((folder.path() / "raw" / name).c_str());
    ASSERT_TRUE(reader.Read());
    gdcm::Writer writer;
    writer.SetFile(reader.GetFile());
    writer.GetFile().GetHeader().SetDataSetTransferSyntax(
        gdcm::TransferSyntax::DeflatedExplicitVRLittleEndian);
    writer.SetFileName((folder.path() / "packed" / name).c_str());
    ASSERT_TRUE(writer.Write());
  }
  const IntensityVolume volume = readFolder(folder.path() / "packed");
  EXPECT_EQ(volume.at(7, 5, 1), ramp(7, 5, 1));
}

} // namespace
} // namespace petrous::imaging
