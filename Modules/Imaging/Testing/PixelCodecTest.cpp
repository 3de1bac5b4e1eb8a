// Compressed pixels, written by GDCM's encoders from the same uncompressed files.
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>

#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmImageReader.h>
#include <gdcmImageWriter.h>
#include <gdcmReader.h>
#include <gdcmWriter.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "TestDicom.h"
#include "TestFiles.h"
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

class PixelCodec : public ::testing::TestWithParam<gdcm::TransferSyntax::TSType>
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

/// States 12 bits stored in a file of 16.
void stateTwelveBits(const fs::path& file)
{
  std::ifstream stream(file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  const std::size_t stored = bytes.find(std::string("\x28\x00\x01\x01US\x02\x00\x10", 9));
  const std::size_t high = bytes.find(std::string("\x28\x00\x02\x01US\x02\x00\x0f", 9));
  ASSERT_NE(stored, std::string::npos);
  ASSERT_NE(high, std::string::npos);
  bytes[stored + 8] = 12;
  bytes[high + 8] = 11;
  test::writeText(file, bytes);
}

TEST_P(PixelCodec, ACodestreamOfMoreBitsThanTheHeaderStatesIsNeverCut)
{
  if (GetParam() == gdcm::TransferSyntax::RLELossless)
    GTEST_SKIP() << "a stream that states no bits";
  for (const bool isSigned : {false, true})
    for (const bool isLarge : {false, true})
    {
      const TemporaryFolder folder;
      writeSeries(folder.path() / "raw", 2,
                  [&](int, TestSlice& s)
                  {
                    s.columns = 40;
                    s.rows = 30;
                    s.isSigned = isSigned;
                    s.cell = [=](int i, int j) {
                      return 0xFFFFU &
                             ((isLarge ? 40000U : 0U) + ramp(i, j, 0) - (isSigned ? 1000U : 0U));
                    };
                  });
      fs::create_directories(folder.path() / "packed");
      for (const char* name : {"s0.dcm", "s1.dcm"})
      {
        compress(folder.path() / "raw" / name, folder.path() / "packed" / name, GetParam());
        stateTwelveBits(folder.path() / "packed" / name);
      }
      if (isLarge)
      {
        try
        {
          readFolder(folder.path() / "packed");
          ADD_FAILURE() << "read";
        }
        catch (const DicomError& error)
        {
          EXPECT_NE(std::string(error.what()).find("bits of a pixel"), std::string::npos)
              << error.what();
        }
        continue;
      }
      const IntensityVolume raw = readFolder(folder.path() / "raw");
      const IntensityVolume packed = readFolder(folder.path() / "packed");
      for (int j = 0; j < 30; ++j)
        for (int i = 0; i < 40; ++i)
          ASSERT_EQ(raw.at(i, j, 1), packed.at(i, j, 1)) << i << " " << j;
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
  ::testing::internal::CaptureStderr();
  action();
  return ::testing::internal::GetCapturedStderr();
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

// A file that is whole, with a codestream that ends too early.
TEST_P(PixelCodec, RefusesACodestreamThatEndsEarlyAndNamesTheFile)
{
  const TemporaryFolder folder;
  writeSeries(folder.path() / "raw", 2,
              [](int k, TestSlice& s)
              {
                s.columns = 40;
                s.rows = 30;
                s.cell = [k](int i, int j) { return 0xFFFU & (ramp(i, j, k) * 2654435761U >> 7); };
              });
  for (const char* name : {"s0.dcm", "s1.dcm"})
    compress(folder.path() / "raw" / name, folder.path() / name, GetParam());
  fs::remove_all(folder.path() / "raw");
  std::ifstream stream(folder.path() / "s1.dcm", std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(stream)),
                          std::istreambuf_iterator<char>());
  const auto length = [&whole](std::size_t at)
  {
    std::size_t value = 0;
    for (std::size_t b = 4; b-- > 0;)
      value = value << 8 | static_cast<unsigned char>(whole[at + b]);
    return value;
  };
  const std::size_t table = whole.find(std::string("\xe0\x7f\x10\x00OB", 6)) + 12;
  ASSERT_LT(table, whole.size());
  const std::size_t item = table + 8 + length(table + 4);
  const std::size_t bytes = length(item + 4);
  ASSERT_LE(item + 8 + bytes, whole.size());
  for (int percent = 1; percent < 95; percent += 7)
  {
    const std::size_t left = bytes * static_cast<std::size_t>(percent) / 100 / 2 * 2;
    std::string cut = whole.substr(0, item + 4);
    for (int b = 0; b < 4; ++b)
      cut += static_cast<char>(left >> 8 * b);
    cut += whole.substr(item + 8, left) + std::string("\xfe\xff\xdd\xe0\0\0\0\0", 8);
    test::writeText(folder.path() / "s1.dcm", cut);
    try
    {
      readFolder(folder.path());
      ADD_FAILURE() << percent << " % of the codestream was read as a whole slice";
    }
    catch (const DicomError& error)
    {
      EXPECT_NE(std::string(error.what()).find("s1.dcm"), std::string::npos) << error.what();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Syntaxes, PixelCodec,
                         ::testing::Values(gdcm::TransferSyntax::RLELossless,
                                           gdcm::TransferSyntax::JPEGLosslessProcess14_1,
                                           gdcm::TransferSyntax::JPEGLSLossless,
                                           gdcm::TransferSyntax::JPEG2000Lossless));

struct PixelForm
{
  const char* name;
  std::function<void(int k, TestSlice&)> change; ///< of a series of values in 0 to 100
};

// The photometric interpretation says how the values that rescale slope and intercept give are
// shown (PS3.3 C.7.6.3.1.2, PS3.4 N.2), so MONOCHROME1 leaves Hounsfield units as they are.
TEST(PixelForms, EqualTheExplicitLittleEndianSeriesToTheBit)
{
  const auto value = [](int i, int j, int k) { return ramp(i, j, k) % 101U; };
  const auto shifted = [value](int k, TestSlice& s)
  {
    s.bitsStored = 12;
    s.highBit = 15;
    // Values from -50, with overlays in the four bits below.
    for (std::uint32_t n = 0; n < 4; ++n)
    {
      s.number(s.extraPixel, (0x6000U + 2 * n) << 16 | 0x0100U, 16);
      s.number(s.extraPixel, (0x6000U + 2 * n) << 16 | 0x0102U, n);
    }
    s.isSigned = true;
    s.intercept += 50.0;
    s.cell = [value, k](int i, int j)
    { return ((value(i, j, k) - 50U) & 0xFFFU) << 4 | (ramp(j, i, k) & 0xFU); };
  };
  const std::vector<PixelForm> forms = {
      {"MONOCHROME1", [](int, TestSlice& s) { s.photometric = "MONOCHROME1"; }},
      {"implicit", [](int, TestSlice& s) { s.implicitVr = true; }},
      {"big endian", [](int, TestSlice& s) { s.bigEndian = true; }},
      {"unsigned", [](int, TestSlice& s) { s.isSigned = false; }},
      {"8 bits", [](int, TestSlice& s) { s.bitsAllocated = s.bitsStored = 8; }},
      {"8 bits, big endian",
       [](int, TestSlice& s)
       {
         s.bitsAllocated = s.bitsStored = 8;
         s.bigEndian = true;
       }},
      {"8 bits in words, big endian",
       [](int, TestSlice& s)
       {
         s.bitsAllocated = s.bitsStored = 8;
         s.bigEndian = true;
         s.pixelVr = "OW";
       }},
      {"8 bits in words",
       [](int, TestSlice& s)
       {
         s.bitsAllocated = s.bitsStored = 8;
         s.pixelVr = "OW";
       }},
      {"12 bits", [](int, TestSlice& s) { s.bitsAllocated = s.bitsStored = 12; }},
      {"12 bits, big endian",
       [](int, TestSlice& s)
       {
         s.bitsAllocated = s.bitsStored = 12;
         s.bigEndian = true;
       }},
      {"12 in 16 bits", [](int, TestSlice& s) { s.bitsStored = 12; }},
      {"12 bits with a high bit of 15", shifted},
      {"12 bits with a high bit of 15, big endian",
       [shifted](int k, TestSlice& s)
       {
         s.bigEndian = true;
         shifted(k, s);
       }},
      {"32 bits", [](int, TestSlice& s) { s.bitsAllocated = s.bitsStored = 32; }},
      {"32 bits, big endian",
       [](int, TestSlice& s)
       {
         s.bitsAllocated = s.bitsStored = 32;
         s.bigEndian = true;
       }},
      {"signs that differ between slices", [](int k, TestSlice& s) { s.isSigned = k % 2 == 0; }},
      {"a padding value that no pixel has",
       [](int, TestSlice& s) { s.padding = std::uint16_t{0xF830}; }},
      {"a transfer syntax that differs between slices",
       [](int k, TestSlice& s) { (k % 2 == 0 ? s.bigEndian : s.implicitVr) = true; }},
  };
  for (const PixelForm& form : forms)
  {
    SCOPED_TRACE(form.name);
    const TemporaryFolder folder;
    writeSeries(folder.path(), 3,
                [&](int k, TestSlice& s)
                {
                  s.intercept = -1000.0;
                  s.cell = [value, k](int i, int j) { return value(i, j, k); };
                  form.change(k, s);
                });
    const IntensityVolume image = readFolder(folder.path());
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 6; ++j)
        for (int i = 0; i < 8; ++i)
          ASSERT_EQ(image.at(i, j, k), static_cast<double>(value(i, j, k)) - 1000.0)
              << i << " " << j << " " << k;
  }
}

// Metal of 3976 HU stored as 5000 in a series that states 12 bits would become soft tissue.
TEST(PixelForms, AValueOfMoreThanTheBitsStoredIsRefusedOrReadAsTheUserSays)
{
  for (const bool isBigEndian : {false, true})
    for (const bool isSigned : {false, true})
      for (const bool isRle : {false, true})
      {
        if (isRle && isBigEndian)
          continue;
        SCOPED_TRACE(std::to_string(isBigEndian) + std::to_string(isSigned) +
                     std::to_string(isRle));
        const TemporaryFolder folder;
        const auto write = [&](const fs::path& to, unsigned metal)
        {
          writeSeries(to, 2,
                      [&](int, TestSlice& s)
                      {
                        s.bitsStored = isRle ? 16 : 12;
                        s.isSigned = isSigned;
                        s.bigEndian = isBigEndian;
                        s.cell = [=](int i, int j) {
                          return i == 3 && j == 2 ? metal : isSigned ? 0xFF00U : 100U;
                        };
                      });
          if (!isRle)
            return;
          for (const char* name : {"s0.dcm", "s1.dcm"})
          {
            compress(to / name, to / (std::string("packed") + name),
                     gdcm::TransferSyntax::RLELossless);
            stateTwelveBits(to / (std::string("packed") + name));
            fs::remove(to / name);
          }
        };
        write(folder.path() / "sound", 1000);
        EXPECT_EQ(readFolder(folder.path() / "sound").at(3, 2, 0), 1000.0);
        write(folder.path() / "metal", 5000);
        try
        {
          readFolder(folder.path() / "metal");
          ADD_FAILURE() << "read";
        }
        catch (const DicomError& error)
        {
          const std::string why = error.what();
          EXPECT_EQ(error.reason(), DicomError::Reason::BitsUnclear);
          EXPECT_NE(why.find("2 pixels have values of more than the 12 bits"), std::string::npos)
              << why;
          EXPECT_NE(why.find("in 2 slices"), std::string::npos) << why;
          EXPECT_NE(why.find("(--bits stored), the values are 904;"), std::string::npos) << why;
          EXPECT_NE(why.find("(--bits allocated), they are 5000;"), std::string::npos) << why;
          EXPECT_NE(why.find(isSigned ? "beside them lies -256 " : "beside them lies 100 "),
                    std::string::npos)
              << why;
        }
        // 5000 = 4096 + 904: as the user says.
        const auto metalAs = [&](UndeclaredBits undeclared)
        {
          const ScanResult scan = scanDicom(folder.path() / "metal", {});
          ReadOptions options;
          options.undeclaredBits = undeclared;
          std::vector<std::string> notes;
          const IntensityVolume image = readSeries(scan.series.at(0), options, {}, &notes);
          EXPECT_EQ(notes.size(), 1U);
          EXPECT_NE(notes.at(0).find("2 pixels have bits beside those stored"), std::string::npos)
              << notes.at(0);
          EXPECT_EQ(image.at(2, 2, 0), isSigned ? -256.0 : 100.0);
          return image.at(3, 2, 0);
        };
        EXPECT_EQ(metalAs(UndeclaredBits::LeaveOut), 904.0);
        EXPECT_EQ(metalAs(UndeclaredBits::Keep), 5000.0);
      }
}

// As scanners wrote them until 2004: graphics in a bit above those of the values.
TEST(PixelForms, OverlaysThatAreDeclaredAreLeftOut)
{
  struct Case
  {
    unsigned group, bit;
    bool isRead;
  };
  for (const auto& [group, bit, isRead] :
       {Case{0x6000, 12, true}, {0x601e, 15, true}, {0x6000, 13, false}, {0x6001, 12, false}})
    for (const bool isSigned : {false, true})
    {
      SCOPED_TRACE(std::to_string(group) + " " + std::to_string(bit) + std::to_string(isSigned));
      const unsigned used = group == 0x601e ? 15 : 12;
      const TemporaryFolder folder;
      writeSeries(folder.path(), 2,
                  [=, group = group, bit = bit](int, TestSlice& s)
                  {
                    s.bitsStored = 12;
                    s.isSigned = isSigned;
                    s.cell = [=](int i, int j)
                    {
                      const unsigned value = isSigned && i == 1 ? 0xFFFFU : 100U + i; // -1
                      return i == j ? value | 1U << used : value & ~(1U << used);
                    };
                    s.number(s.extraPixel, group << 16 | 0x0100U, 16);
                    s.number(s.extraPixel, group << 16 | 0x0102U, bit);
                  });
      if (!isRead)
      {
        EXPECT_THROW(readFolder(folder.path()), DicomError);
        continue;
      }
      const auto image = readFolder(folder.path());
      for (int i = 0; i < 5; ++i)
        EXPECT_EQ(image.at(i, 3, 0), isSigned && i == 1 ? -1.0 : 100.0 + i) << i;
    }
}

TEST(PixelForms, OverlaysThatAreDeclaredAreNoValuesWhereBitsAreKept)
{
  for (const bool isSigned : {false, true})
  {
    const TemporaryFolder folder;
    writeSeries(folder.path(), 2,
                [isSigned](int, TestSlice& s)
                {
                  s.bitsStored = 12;
                  s.isSigned = isSigned;
                  s.cell = [isSigned](int i, int j)
                  {
                    const unsigned value = isSigned && i == 1 ? 0xFFFFU // -1
                                           : i == 3           ? 0x2100U // 8448, undeclared
                                                              : 100U;
                    return i == j ? value | 0x1000U : value & ~0x1000U;
                  };
                  s.number(s.extraPixel, 0x60000100U, 16);
                  s.number(s.extraPixel, 0x60000102U, 12);
                });
    const ScanResult scan = scanDicom(folder.path(), {});
    ReadOptions options;
    options.undeclaredBits = UndeclaredBits::Keep;
    std::vector<std::string> notes;
    const IntensityVolume image = readSeries(scan.series.at(0), options, {}, &notes);
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 8; ++i)
        EXPECT_EQ(image.at(i, j, 1), isSigned && i == 1 ? -1.0
                                     : i == 3           ? 8448.0
                                                        : 100.0)
            << isSigned << i << j;
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_EQ(notes[0].find("12 pixels have bits beside those stored"), 0U) << notes[0];
  }
}

// Metal of 3000 in a slice without air has the bits of -1096; the copies of the sign that air has
// tell, also in a slice whose own metal has undeclared bits, and outside of what is read.
TEST(PixelForms, SlicesTogetherTellWhatUndeclaredBitsAre)
{
  const TemporaryFolder folder;
  const auto write = [&](bool hasCopies)
  {
    writeSeries(folder.path(), 4,
                [hasCopies](int k, TestSlice& s)
                {
                  s.bitsStored = 12;
                  s.isSigned = true;
                  s.cell = [k, hasCopies](int i, int j)
                  {
                    if (i == 3 && j == 2)
                      return k < 2 ? 5000U : 3000U;
                    return k < 2 ? static_cast<unsigned>(-1000) & (hasCopies ? 0xFFFFU : 0xFFFU)
                                 : 100U;
                  };
                });
    return scanDicom(folder.path(), {}).series.at(0);
  };
  std::vector<std::string> notes;
  const auto optionsOf = [&notes](const DicomSeries& series, UndeclaredBits bits, bool isPart)
  {
    notes.clear();
    ReadOptions options;
    options.undeclaredBits = bits;
    if (isPart) // the slices with air are outside of it
      options.roi = series.geometry.grid->cropped({{0, 0, 2}, {8, 6, 4}}).patientBounds();
    return options;
  };
  const auto refusalOf = [&](const DicomSeries& series, UndeclaredBits bits, bool canKeep)
  {
    try
    {
      readSeries(series, optionsOf(series, bits, false), {});
    }
    catch (const BitsUnclearError& error)
    {
      EXPECT_EQ(error.canKeep, canKeep) << error.what();
      return std::string(error.what());
    }
    return std::string();
  };
  const auto imageOf = [&](const DicomSeries& series, UndeclaredBits bits, bool isPart)
  { return readSeries(series, optionsOf(series, bits, isPart), {}, &notes); };

  const DicomSeries copied = write(true);
  const std::string asked = refusalOf(copied, UndeclaredBits::Refuse, true);
  for (const char* said :
       {"s0.dcm contradicts itself", "4 pixels have values of more than the 12 bits",
        "in 4 slices: some without the copies of the sign that the negative values of s0.dcm have",
        "(--bits stored), the values are -1096 to 904;",
        "(--bits allocated), they are 3000 to 5000;", "beside them lies -450 on average"})
    EXPECT_NE(asked.find(said), std::string::npos) << asked;
  const auto left = imageOf(copied, UndeclaredBits::LeaveOut, false);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0].find("4 pixels have bits beside those stored"), 0U) << notes[0];
  const auto kept = imageOf(copied, UndeclaredBits::Keep, false);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0].find("4 pixels have bits beside those stored"), 0U) << notes[0];
  for (int k = 0; k < 4; ++k)
  {
    EXPECT_EQ(left.at(3, 2, k), k < 2 ? 904.0 : -1096.0) << k;
    EXPECT_EQ(kept.at(3, 2, k), k < 2 ? 5000.0 : 3000.0) << k;
    for (const IntensityVolume* image : {&left, &kept})
      EXPECT_EQ(image->at(0, 0, k), k < 2 ? -1000.0 : 100.0) << k;
  }
  EXPECT_THROW(imageOf(copied, UndeclaredBits::Refuse, true), BitsUnclearError);
  EXPECT_EQ(imageOf(copied, UndeclaredBits::LeaveOut, true).at(3, 2, 0), -1096.0);
  EXPECT_EQ(imageOf(copied, UndeclaredBits::Keep, true).at(3, 2, 0), 3000.0);

  // Where no slice has copies, metal of 3000 and air cannot be told apart, nor bits be kept: that
  // is said with the question.
  const DicomSeries bare = write(false);
  for (const UndeclaredBits bits : {UndeclaredBits::Refuse, UndeclaredBits::Keep})
  {
    const std::string why = refusalOf(bare, bits, false);
    EXPECT_NE(why.find("2 pixels have values of more than the 12 bits"), std::string::npos) << why;
    EXPECT_NE(why.find("(--bits stored), but not kept: no copies of the sign"), std::string::npos)
        << why;
    EXPECT_EQ(why.find("--bits allocated"), std::string::npos) << why;
  }
  const auto cut = imageOf(bare, UndeclaredBits::LeaveOut, false);
  EXPECT_EQ(notes.size(), 2U);
  EXPECT_EQ(cut.at(0, 0, 0), -1000.0);
  EXPECT_EQ(cut.at(3, 2, 0), 904.0);
  EXPECT_EQ(cut.at(3, 2, 3), -1096.0);
  // Outside of the region nobody asks for that.
  for (const UndeclaredBits bits :
       {UndeclaredBits::Refuse, UndeclaredBits::LeaveOut, UndeclaredBits::Keep})
  {
    EXPECT_EQ(imageOf(bare, bits, true).at(3, 2, 0), -1096.0);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].find("Look whether metal shows as air"), std::string::npos) << notes[0];
  }
}

TEST(PixelForms, BitsBelowTheValuesAreNotKept)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 2,
              [](int, TestSlice& s)
              {
                s.bitsStored = 12;
                s.highBit = 14; // of 0 to 15: three unused bits below, one above
                s.isSigned = false;
                s.cell = [](int i, int j) { return i == 3 && j == 2 ? 0x8008U : 100U << 3; };
              });
  const DicomSeries series = scanDicom(folder.path(), {}).series.at(0);
  ReadOptions options;
  for (const UndeclaredBits bits : {UndeclaredBits::Refuse, UndeclaredBits::Keep})
    try
    {
      options.undeclaredBits = bits;
      readSeries(series, options, {});
      ADD_FAILURE() << "read";
    }
    catch (const BitsUnclearError& error)
    {
      EXPECT_FALSE(error.canKeep);
      EXPECT_NE(std::string(error.what()).find("not kept: unused bits lie below the values"),
                std::string::npos)
          << error.what();
    }
  options.undeclaredBits = UndeclaredBits::LeaveOut;
  EXPECT_EQ(readSeries(series, options, {}).at(3, 2, 1), 1.0);
}

// 12 bits with a sign: 3000 has the bits of -1096 but for the copies of the sign that -1000 has.
TEST(PixelForms, APositiveValueIsNotTakenForANegativeOne)
{
  for (const bool hasCopies : {true, false})
  {
    const TemporaryFolder folder;
    writeSeries(folder.path(), 2,
                [hasCopies](int, TestSlice& s)
                {
                  s.bitsStored = 12;
                  s.isSigned = true;
                  s.cell = [hasCopies](int i, int j)
                  {
                    const unsigned air =
                        static_cast<unsigned>(-1000) & (hasCopies ? 0xFFFFU : 0xFFFU);
                    return i == 3 && j == 2 ? 3000U : air;
                  };
                });
    if (hasCopies)
    {
      EXPECT_THROW(readFolder(folder.path()), DicomError);
      continue;
    }
    const auto image = readFolder(folder.path());
    EXPECT_EQ(image.at(0, 0, 0), -1000.0);
    EXPECT_EQ(image.at(3, 2, 0), 3000.0 - 4096.0) << "as the header says";
  }
}

/// Twelve slices of 12 bits with a sign: in the first half air of -1000 with copies of its sign or
/// without, in the second half the bits of 2500 HU, which are those of -1596 without copies.
void writeAirAndMetal(const fs::path& folder, bool hasCopies)
{
  writeSeries(folder, 12,
              [hasCopies](int k, TestSlice& s)
              {
                s.bitsStored = 12;
                s.isSigned = true;
                s.cell = [k, hasCopies](int i, int j)
                {
                  if (i == 3 && j == 2)
                    return k < 6 ? 40U : 2500U;
                  return k < 6 ? static_cast<unsigned>(-1000) & (hasCopies ? 0xFFFFU : 0xFFFU)
                               : 100U;
                };
              });
}

TEST(PixelForms, CopiesOfTheSignInAnySliceTellPositiveValuesFromNegativeOnes)
{
  const TemporaryFolder folder;
  writeAirAndMetal(folder.path(), true);
  const ScanResult result = scanDicom(folder.path(), {});
  const DicomSeries& series = result.series.at(0);
  ReadOptions metalOnly; // the slices with the copies are outside of it
  const auto bounds = series.geometry.grid->cropped({{0, 0, 8}, {8, 6, 12}}).patientBounds();
  metalOnly.roi = bounds;
  for (const ReadOptions& options : {ReadOptions{}, metalOnly})
    try
    {
      readSeries(series, options, {});
      ADD_FAILURE() << "read";
    }
    catch (const BitsUnclearError& error)
    {
      const std::string text = error.what();
      EXPECT_TRUE(error.canKeep);
      const std::string first = options.roi
                                    ? "s8.dcm contradicts itself about the bits of a pixel: 4"
                                    : "s6.dcm contradicts itself about the bits of a pixel: 6";
      EXPECT_EQ(text.find(first + " pixels have values of more than the 12 bits"), 0U) << text;
      EXPECT_NE(text.find("negative values of s0.dcm"), std::string::npos) << text;
    }
}

TEST(PixelForms, ValuesThatMayBePositiveAreNoted)
{
  const TemporaryFolder folder;
  writeAirAndMetal(folder.path(), false);
  const ScanResult result = scanDicom(folder.path(), {});
  std::vector<std::string> notes;
  const auto image = readSeries(result.series.at(0), {}, {}, &notes);
  EXPECT_EQ(image.at(3, 2, 7), 2500.0 - 4096.0);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("read as negative"), std::string::npos) << notes[0];
}

// 2227 in 16 bits is 139 in the upper 12 of them.
TEST(PixelForms, BitsBelowTheStoredOnesAreRefused)
{
  const TemporaryFolder folder;
  for (const unsigned low : {0U, 3U})
  {
    writeSeries(folder.path(), 2,
                [low](int, TestSlice& s)
                {
                  s.bitsStored = 12;
                  s.highBit = 15;
                  s.isSigned = false;
                  s.cell = [low](int i, int) { return (100U + i) << 4 | (i == 2 ? low : 0U); };
                });
    if (low == 0)
    {
      EXPECT_EQ(readFolder(folder.path()).at(2, 0, 0), 102.0);
      continue;
    }
    try
    {
      readFolder(folder.path());
      ADD_FAILURE() << "read";
    }
    catch (const DicomError& error)
    {
      EXPECT_NE(std::string(error.what()).find("12 pixels have values of more than the 12 bits"),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(PixelForms, PaddingOfMoreThanTheBitsStoredIsPadding)
{
  for (const bool isCorner : {true, false})
    for (const bool isBigEndian : {false, true})
    {
      SCOPED_TRACE(std::to_string(isCorner) + std::to_string(isBigEndian));
      const TemporaryFolder folder;
      writeSeries(folder.path(), 2,
                  [=](int, TestSlice& s)
                  {
                    s.bitsStored = 12;
                    s.isSigned = false;
                    s.bigEndian = isBigEndian;
                    s.intercept = -1024.0;
                    s.padding = std::uint16_t{0xF830};
                    s.cell = [=](int i, int j)
                    {
                      const bool isPadding = isCorner ? j == 0 : i == 3 && j == 2;
                      return isPadding ? 0xF830U : i == 4 && j == 3 ? 0x830U : 1064U;
                    };
                  });
      const IntensityVolume image = readFolder(folder.path());
      EXPECT_EQ(image.padding(), -1024.0);
      EXPECT_EQ(isCorner ? image.at(5, 0, 1) : image.at(3, 2, 1), -1024.0);
      EXPECT_EQ(image.at(4, 3, 1), 0x830 - 1024.0) << "the same 12 bits";
      EXPECT_EQ(image.at(4, 4, 1), 40.0);
    }
}

TEST(PixelForms, FloatingPointIsKeptToTheBit)
{
  const auto value = [](int i, int j, int k) // floats that decimal digits do not hold
  {
    return static_cast<double>(static_cast<float>(std::sqrt(2.0 + i) * 1e-3 - j / 7.0 + 900 * k));
  };
  for (const std::uint32_t tag : {0x7fe00008U, 0x7fe00009U})
    for (const bool isBigEndian : {false, true})
      for (const bool isImplicit : {false, true})
      {
        if (isBigEndian && isImplicit)
          continue;
        const TemporaryFolder folder;
        writeSeries(folder.path(), 3,
                    [&](int k, TestSlice& s)
                    {
                      s.bitsAllocated = s.bitsStored = tag == 0x7fe00008U ? 32 : 64;
                      s.pixelTag = tag;
                      s.bigEndian = isBigEndian;
                      s.implicitVr = isImplicit;
                      s.real = [value, k](int i, int j) { return value(i, j, k); };
                    });
        const IntensityVolume image = readFolder(folder.path());
        ASSERT_EQ(image.voxels().index(),
                  IntensityVolume::Voxels(std::shared_ptr<const volume::Volume<float>>()).index());
        for (int k = 0; k < 3; ++k)
          for (int j = 0; j < 6; ++j)
            for (int i = 0; i < 8; ++i)
              ASSERT_EQ(image.at(i, j, k), value(i, j, k)) << i << " " << j << " " << k;
      }
}

TEST(PixelForms, FloatingPointHasItsRescalePaddingAndRounding)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 3,
              [](int, TestSlice& s)
              {
                s.bitsAllocated = s.bitsStored = 64;
                s.pixelTag = 0x7fe00009;
                std::string bytes;
                s.appendReal(bytes, -3000.0);
                s.element(s.extraPixel, 0x00280123, "FD", bytes);
                s.intercept = 10.0;
                s.real = [](int i, int j) { return i + j == 0 ? -3000.0 : i == 3 ? 0.1 : j; };
              });
  std::vector<std::string> notes;
  const ScanResult result = scanDicom(folder.path(), {});
  const IntensityVolume image = readSeries(result.series.front(), {}, {}, &notes);
  EXPECT_EQ(image.padding(), -2990.0);
  EXPECT_EQ(image.at(0, 0, 1), -2990.0);
  EXPECT_EQ(image.at(3, 2, 1), static_cast<double>(static_cast<float>(10.1)));
  EXPECT_EQ(image.at(1, 5, 2), 15.0);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("rounded to 32-bit floating point, by up to 0.00000038"),
            std::string::npos)
      << notes[0]; // 10.1 in float is 10.1000003815
  writeSeries(folder.path(), 3,
              [](int, TestSlice& s)
              {
                s.bitsAllocated = s.bitsStored = 32;
                s.pixelTag = 0x7fe00008;
                s.real = [](int i, int) { return i == 3 ? std::nan("") : 1.0; };
              });
  try
  {
    readFolder(folder.path());
    FAIL() << "read";
  }
  catch (const DicomError& error)
  {
    EXPECT_NE(std::string(error.what()).find("not finite"), std::string::npos) << error.what();
  }
}

TEST(PixelForms, UnsignedValuesOf32BitsAreReadWhole)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 2,
              [](int, TestSlice& s)
              {
                s.bitsAllocated = s.bitsStored = 32;
                s.isSigned = false;
                s.cell = [](int i, int) { return i == 0 ? 4294967040U : 16777217U + i; };
              });
  std::vector<std::string> notes;
  const ScanResult result = scanDicom(folder.path(), {});
  const IntensityVolume image = readSeries(result.series.front(), {}, {}, &notes);
  EXPECT_EQ(image.at(0, 0, 0), 4294967040.0); // a float
  EXPECT_EQ(image.at(1, 0, 0), 16777218.0);
  EXPECT_EQ(image.at(2, 0, 0), 16777220.0) << "16777219 is between two floats";
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("by up to 1."), std::string::npos) << notes[0];
}

TEST(PixelForms, TwelveBitsOfNoDicomFileAreRefused)
{
  const TemporaryFolder folder;
  for (const bool isMarked : {true, false})
  {
    writeSeries(folder.path(), 2,
                [&](int, TestSlice& s)
                {
                  s.marker = isMarked;
                  s.bitsAllocated = s.bitsStored = 12;
                });
    EXPECT_EQ(scanDicom(folder.path(), {}).series.front().geometry.verdict,
              isMarked ? Verdict::Ok : Verdict::Refused);
  }
}

TEST(PixelForms, FewerPixelsThanTheHeaderSaysAreRefusedByName)
{
  for (const int bits : {8, 12, 16, 32})
    for (const bool isBigEndian : {false, true})
    {
      const TemporaryFolder folder;
      writeSeries(folder.path(), 2,
                  [&](int, TestSlice& s)
                  {
                    s.bitsAllocated = s.bitsStored = bits;
                    s.bigEndian = isBigEndian;
                  });
      TestSlice tall;
      tall.z = 0.5;
      tall.bitsAllocated = tall.bitsStored = bits;
      tall.bigEndian = isBigEndian;
      std::string bytes = tall.bytes();
      const std::string rows = isBigEndian ? std::string("\0\x28\0\x10US\0\2\0\6", 10)
                                           : std::string("\x28\0\x10\0US\2\0\6\0", 10);
      const std::size_t at = bytes.find(rows);
      ASSERT_NE(at, std::string::npos);
      bytes[at + (isBigEndian ? 9 : 8)] = 7;
      test::writeText(folder.path() / "s1.dcm", bytes);
      try
      {
        readFolder(folder.path());
        ADD_FAILURE() << "read";
      }
      catch (const DicomError& error)
      {
        EXPECT_NE(std::string(error.what()).find("s1.dcm"), std::string::npos) << error.what();
      }
    }
}

/// An enhanced CT of three frames of 2 x 2 bytes in RLE, the second in two fragments, with an
/// extended offset table (PS3.3 C.7.6.3.1.8) in place of the basic one.
std::string extendedOffsetFile()
{
  TestSlice code;
  code.pixels = false;
  code.rows = code.columns = 2;
  code.bitsAllocated = code.bitsStored = 8;
  code.isSigned = false;
  code.sopClass = "1.2.840.10008.5.1.4.1.1.2.1";
  code.syntax = "1.2.840.10008.1.2.5";
  code.element(code.extraPixel, 0x00280008, "IS", "3");
  std::string file = code.bytes();
  const auto number = [](std::uint64_t value, int bytes)
  {
    std::string out;
    for (int b = 0; b < bytes; ++b)
      out += static_cast<char>(value >> 8 * b);
    return out;
  };
  const auto item = [&](const std::string& content)
  { return std::string("\xfe\xff\x00\xe0", 4) + number(content.size(), 4) + content; };
  const auto sequence = [&](std::uint32_t tag, const std::string& items)
  {
    std::string out;
    code.element(out, tag, "SQ", items);
    return out;
  };
  std::string groups;
  for (int k = 0; k < 3; ++k)
  {
    std::string place;
    code.element(place, 0x00200032, "DS", "0\\0\\" + std::to_string(k));
    groups += item(sequence(0x00209113, item(place)));
  }
  file += sequence(0x52009230, groups);
  // one segment of a literal run: 64 bytes of offsets, a count, the bytes
  const auto frame = [&](char value)
  {
    std::string rle = number(1, 4) + number(64, 4) + std::string(56, '\0');
    return rle + std::string("\x03", 1) + std::string(4, value) + std::string(1, '\0');
  };
  std::string fragments = item(""); // no basic offset table
  std::string offsets;
  std::string items;
  for (int k = 0; k < 3; ++k)
  {
    offsets += number(items.size(), 8);
    const std::string all = frame(static_cast<char>(10 + k));
    items += k == 1 ? item(all.substr(0, 40)) + item(all.substr(40)) : item(all);
  }
  code.element(file, 0x7fe00001, "OV", offsets);
  file += std::string("\xe0\x7f\x10\x00OB\0\0\xff\xff\xff\xff", 12) + fragments + items +
          std::string("\xfe\xff\xdd\xe0\0\0\0\0", 8);
  return file;
}

TEST(PixelForms, AnExtendedOffsetTableSaysWhereFramesBegin)
{
  const TemporaryFolder folder;
  const std::string file = extendedOffsetFile();
  test::writeText(folder.path() / "ct.dcm", file);
  const IntensityVolume image = readFolder(folder.path());
  ASSERT_EQ(image.geometry().dims(), (core::Index3{2, 2, 3}));
  for (int k = 0; k < 3; ++k)
    EXPECT_EQ(image.at(1, 1, k), 10.0 + k);
  // A table that points beside a fragment is refused.
  const std::size_t at = file.find(std::string("\xe0\x7f\x01\x00OV", 6)) + 12 + 8;
  std::string other = file;
  other[at] = static_cast<char>(other[at] + 2);
  test::writeText(folder.path() / "ct.dcm", other);
  EXPECT_THROW(readFolder(folder.path()), DicomError);
}

/// A slice, or several frames of one file, of these fragments.
SliceHeader compressedSlice(const std::string& syntax, const std::vector<std::string>& fragments,
                            int frames = 1)
{
  TestSlice code;
  code.pixels = false;
  code.syntax = syntax;
  std::string file;
  const auto item = [&code](const std::string& content)
  {
    std::string out("\xfe\xff\x00\xe0", 4);
    code.append(out, static_cast<std::uint32_t>(content.size()), 4);
    return out + content;
  };
  if (frames > 1)
  {
    code.sopClass = "1.2.840.10008.5.1.4.1.1.2.1";
    code.element(code.extraPixel, 0x00280008, "IS", std::to_string(frames));
    std::string groups;
    for (int k = 0; k < frames; ++k)
    {
      std::string place, sequence;
      code.element(place, 0x00200032, "DS", "0\\0\\" + std::to_string(k));
      code.element(sequence, 0x00209113, "SQ", item(place));
      groups += item(sequence);
    }
    file = code.bytes();
    code.element(file, 0x52009230, "SQ", groups);
  }
  else
    file = code.bytes();
  file += std::string("\xe0\x7f\x10\x00OB\0\0\xff\xff\xff\xff", 12) + item("");
  for (const std::string& one : fragments)
    file += item(one + std::string(one.size() % 2, '\0'));
  file += std::string("\xfe\xff\xdd\xe0\0\0\0\0", 8);
  const TemporaryFolder folder;
  test::writeText(folder.path() / "s.dcm", file);
  const ScanResult result = scanDicom(folder.path(), {});
  const auto& slices = result.series.at(0).geometry.slices;
  if (slices.size() != static_cast<std::size_t>(frames))
    ADD_FAILURE() << slices.size() << " slices";
  return slices.empty() ? SliceHeader() : slices.front();
}

// Two slices at one place are compared in the scan; without a bound each would take 17 GB.
TEST(PixelForms, MoreCompressedPixelsThanTheirBytesCanHoldAreRefusedBeforeMemoryIsTaken)
{
  for (const char* syntax : {"1.2.840.10008.1.2.5", "1.2.840.10008.1.2.4.70",
                             "1.2.840.10008.1.2.4.80", "1.2.840.10008.1.2.4.90"})
  {
    const TemporaryFolder folder;
    for (int k = 0; k < 24; ++k)
    {
      TestSlice code;
      code.pixels = false;
      code.syntax = syntax;
      code.z = 0.5 * (k / 2);
      code.rows = code.columns = 65535;
      std::string file = code.bytes();
      file += std::string("\xe0\x7f\x10\x00OB\0\0\xff\xff\xff\xff", 12) +
              std::string("\xfe\xff\x00\xe0\0\0\0\0", 8) +
              std::string("\xfe\xff\x00\xe0\x40\0\0\0", 8) + std::string(64, '\1') +
              std::string("\xfe\xff\xdd\xe0\0\0\0\0", 8);
      test::writeText(folder.path() / ("s" + std::to_string(k) + ".dcm"), file);
    }
    const ScanResult result = scanDicom(folder.path(), {});
    ASSERT_EQ(result.series.size(), 1U);
    const SeriesGeometry& geometry = result.series.front().geometry;
    EXPECT_EQ(geometry.verdict, Verdict::Refused);
    ASSERT_FALSE(geometry.findings.empty());
    EXPECT_NE(geometry.findings.front().text.find("fewer pixels"), std::string::npos)
        << geometry.findings.front().text;
  }
}

TEST(PixelForms, FewerFragmentsThanFramesAreRefused)
{
  TestSlice code;
  code.pixels = false;
  code.syntax = "1.2.840.10008.1.2.5";
  code.sopClass = "1.2.840.10008.5.1.4.1.1.2.1";
  code.element(code.extraPixel, 0x00280008, "IS", "3");
  std::string file = code.bytes();
  const std::string item("\xfe\xff\x00\xe0\0\0\0\0", 8); // of a frame that says nothing
  code.element(file, 0x52009230, "SQ", item + item + item);
  file += std::string("\xe0\x7f\x10\x00OB\0\0\xff\xff\xff\xff", 12) + item +
          std::string("\xfe\xff\x00\xe0\x40\0\0\0", 8) + std::string(64, '\1') +
          std::string("\xfe\xff\xdd\xe0\0\0\0\0", 8);
  const TemporaryFolder folder;
  test::writeText(folder.path() / "s.dcm", file);
  const ScanResult result = scanDicom(folder.path(), {});
  ASSERT_EQ(result.series.size(), 1U);
  const auto& findings = result.series.front().geometry.findings;
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_NE(findings.front().text.find("fewer pixels"), std::string::npos) << findings.front().text;
}

bool isLossyFile(const std::string& syntax, const std::string& codestream)
{
  const SliceHeader slice = compressedSlice(syntax, {codestream});
  EXPECT_FALSE(slice.isLossUnknown);
  return slice.isLossy;
}

TEST(PixelForms, TheCodestreamSaysWhetherItHasLoss)
{
  // T.87: SOI, SOF55 (8 bits, 6 x 8, one component), SOS with NEAR
  const auto jpegLs = [](char near)
  {
    return std::string("\xff\xd8\xff\xf7\0\x0b\x08\0\x06\0\x08\x01\x01\x11\0", 15) +
           std::string("\xff\xda\0\x08\x01\x01\0", 7) + near + std::string("\0\0\xff\xd9", 4);
  };
  EXPECT_TRUE(isLossyFile("1.2.840.10008.1.2.4.81", jpegLs(2)));
  EXPECT_FALSE(isLossyFile("1.2.840.10008.1.2.4.81", jpegLs(0)));
  // T.800: SOC, SIZ, COD whose last byte is the wavelet
  const auto jpeg2000 = [](char wavelet)
  {
    std::string siz("\xff\x4f\xff\x51\0\x29\0\0", 8);
    for (const char size : {'\x08', '\x06', '\0', '\0', '\x08', '\x06', '\0', '\0'})
      siz += std::string(3, '\0') + size;
    siz += std::string("\0\x01\x07\x01\x01", 5);
    return siz + std::string("\xff\x52\0\x0c\0\0\0\x01\0\x01\x04\x04\0", 13) + wavelet +
           std::string("\xff\x90\0\x0a\0\0\0\0\0\0\0\x01\xff\x93\xff\xd9", 16);
  };
  EXPECT_TRUE(isLossyFile("1.2.840.10008.1.2.4.91", jpeg2000(0)));
  EXPECT_FALSE(isLossyFile("1.2.840.10008.1.2.4.91", jpeg2000(1)));
}

TEST(PixelForms, ALongHeaderOrALaterFrameHidesNoLoss)
{
  const std::string kLs = "1.2.840.10008.1.2.4.81";
  const std::string k2000 = "1.2.840.10008.1.2.4.91";
  const std::string frame("\xff\xf7\0\x0b\x08\0\x06\0\x08\x01\x01\x11\0", 13);
  const auto jpegLs = [&](char near, std::size_t comment) // T.81 B.2.4.5: COM
  {
    std::string text("\xff\xfe", 2);
    text += static_cast<char>((comment + 2) >> 8);
    text += static_cast<char>((comment + 2) & 0xff);
    return std::string("\xff\xd8", 2) + text + std::string(comment, 'x') + frame +
           std::string("\xff\xda\0\x08\x01\x01\0", 7) + near + std::string("\0\0\xff\xd9", 4);
  };
  for (const std::size_t comment : {0U, 900U, 1100U, 5000U, 60000U})
  {
    EXPECT_TRUE(isLossyFile(kLs, jpegLs(2, comment))) << comment;
    EXPECT_FALSE(isLossyFile(kLs, jpegLs(0, comment))) << comment;
  }
  // T.800 A.9.2: COM before COD, in a JP2 file (I.5.1) with a long box before the codestream.
  const auto jpeg2000 = [&](char wavelet, std::size_t comment, std::size_t box)
  {
    std::string siz("\xff\x4f\xff\x51\0\x29\0\0", 8);
    for (const char size : {'\x08', '\x06', '\0', '\0', '\x08', '\x06', '\0', '\0'})
      siz += std::string(3, '\0') + size;
    siz += std::string("\0\x01\x07\x01\x01", 5);
    std::string text("\xff\x64", 2);
    text += static_cast<char>((comment + 4) >> 8);
    text += static_cast<char>((comment + 4) & 0xff);
    text += std::string("\0\x01", 2) + std::string(comment, 'x');
    const std::string stream =
        siz + text + std::string("\xff\x52\0\x0c\0\0\0\x01\0\x01\x04\x04\0", 13) + wavelet +
        std::string("\xff\x90\0\x0a\0\0\0\0\0\0\0\x01\xff\x93\xff\xd9", 16);
    if (box == 0)
      return stream;
    std::string file("\0\0\0\x0cjP  \r\n\x87\n", 12);
    for (int b = 3; b >= 0; --b)
      file += static_cast<char>((box + 8) >> 8 * b);
    return file + "xml " + std::string(box, 'y') + std::string("\0\0\0\0jp2c", 8) + stream;
  };
  for (const std::size_t comment : {0U, 1100U, 5000U})
    for (const std::size_t box : {0U, 30U, 3000U})
    {
      EXPECT_TRUE(isLossyFile(k2000, jpeg2000(0, comment, box))) << comment << ' ' << box;
      EXPECT_FALSE(isLossyFile(k2000, jpeg2000(1, comment, box))) << comment << ' ' << box;
    }
  // The header in two fragments.
  const std::string split = jpegLs(2, 1100);
  EXPECT_TRUE(compressedSlice(kLs, {split.substr(0, 500), split.substr(500)}).isLossy);
  // Loss in the last of three frames.
  EXPECT_TRUE(compressedSlice(kLs, {jpegLs(0, 0), jpegLs(0, 0), jpegLs(1, 0)}, 3).isLossy);
  EXPECT_FALSE(compressedSlice(kLs, {jpegLs(0, 0), jpegLs(0, 0), jpegLs(0, 0)}, 3).isLossy);
  // A stream that ends before it says.
  EXPECT_TRUE(compressedSlice(kLs, {jpegLs(2, 100).substr(0, 60)}).isLossUnknown);
  EXPECT_TRUE(compressedSlice(k2000, {jpeg2000(0, 100, 0).substr(0, 60)}).isLossUnknown);
  EXPECT_TRUE(compressedSlice(k2000, {"nothing like it"}).isLossUnknown);
}

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
  EXPECT_TRUE(canBeInflated(folder.path() / "packed" / "s0.dcm"));
  EXPECT_TRUE(canBeInflated(folder.path() / "raw" / "s0.dcm"));
  // Its end is missing; and zeros, of which DEFLATE makes 300 MB from 300 kB.
  const std::string whole = fileBytes(folder.path() / "packed" / "s0.dcm");
  std::ofstream(folder.path() / "cut.dcm", std::ios::binary) << whole.substr(0, whole.size() - 20);
  EXPECT_FALSE(canBeInflated(folder.path() / "cut.dcm"));
  std::uint32_t group = 0; // of the meta information's length, element (0002,0000)
  std::memcpy(&group, whole.data() + 140, sizeof group);
  std::string bomb = whole.substr(0, 144 + group);
  {
    const std::string zeros(1 << 20, '\0');
    z_stream stream = {};
    ASSERT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 9, Z_DEFAULT_STRATEGY), Z_OK);
    std::string packed(1 << 20, '\0');
    for (int megabyte = 0; megabyte < 300; ++megabyte)
    {
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(zeros.data()));
      stream.avail_in = static_cast<uInt>(zeros.size());
      stream.next_out = reinterpret_cast<Bytef*>(packed.data());
      stream.avail_out = static_cast<uInt>(packed.size());
      ::deflate(&stream, megabyte == 299 ? Z_FINISH : Z_NO_FLUSH);
      bomb.append(packed, 0, packed.size() - stream.avail_out);
    }
    deflateEnd(&stream);
  }
  ASSERT_LT(bomb.size(), 1U << 20);
  std::ofstream(folder.path() / "bomb.dcm", std::ios::binary) << bomb;
  EXPECT_FALSE(canBeInflated(folder.path() / "bomb.dcm"));
}

} // namespace
} // namespace petrous::imaging
