#pragma once

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <unistd.h>

#include "petrous/Core/NumberText.h"

namespace petrous::imaging::test
{

/// Temporary folder, removed after the test.
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "petrous-XXXXXX").string();
    if (!::mkdtemp(name.data()))
      throw std::runtime_error("no temporary folder");
    m_path = name;
  }
  ~TemporaryFolder()
  {
    std::error_code error;
    std::filesystem::remove_all(m_path, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return m_path; }

private:
  std::filesystem::path m_path;
};

/// One slice, written byte by byte according to PS3.10: a reference that shares no code with the
/// reader.
struct TestSlice
{
  int columns = 8;
  int rows = 6;
  double x = -10.0;
  double z = 0.0;
  double y = 20.5;
  std::string orientation = "1\\0\\0\\0\\1\\0";
  std::string seriesUid = "1.2.3.4";
  std::string studyUid = "1.2.3.8";
  std::string modality = "CT";
  std::string sopClass = "1.2.840.10008.5.1.4.1.1.2";
  int bitsAllocated = 16;
  int bitsStored = 16;
  bool isSigned = true;
  std::optional<double> slope = 1.0;
  double intercept = 0.0;
  std::optional<std::uint16_t> padding;
  std::optional<std::uint16_t> paddingLimit;
  bool implicitVr = false;
  bool bigEndian = false;
  bool marker = true; ///< preamble, DICM and group 2
  bool pixels = true;
  std::string extra;           ///< encoded elements appended after the first group
  std::string extraPixel = {}; ///< likewise, before the rescale
  std::string syntax;          ///< declares another one than is used
  std::string photometric = "MONOCHROME2";
  int highBit = -1;                    ///< -1: bitsStored - 1
  std::uint32_t pixelTag = 0x7fe00010; ///< 0x7fe00008: float, 0x7fe00009: double
  std::string pixelVr = {};            ///< empty: OB for 8 bits, else OW
  /// The cell of a pixel, including unused bits.
  std::function<std::uint32_t(int i, int j)> cell = [](int, int) { return 0U; };
  std::function<double(int i, int j)> real = [](int, int) { return 0.0; }; ///< of float and double

  void append(std::string& out, std::uint32_t number, int bytes) const
  {
    for (int b = 0; b < bytes; ++b)
      out += static_cast<char>(number >> 8 * (bigEndian ? bytes - 1 - b : b));
  }

  void element(std::string& out, std::uint32_t tag, const char* vr, std::string value) const
  {
    if (value.size() % 2)
      value += std::string(vr) == "UI" ? '\0' : ' ';
    append(out, tag >> 16, 2);
    append(out, tag & 0xffff, 2);
    const std::string type = vr;
    const bool isLong = vr[0] == 'O' || type == "SQ" || type == "UN" || type == "UC";
    if (!implicitVr)
      out += vr;
    if (!implicitVr && isLong)
      out += std::string(2, '\0');
    append(out, static_cast<std::uint32_t>(value.size()), implicitVr || isLong ? 4 : 2);
    out += value;
  }

  void number(std::string& out, std::uint32_t tag, std::uint32_t value) const
  {
    std::string bytes;
    append(bytes, value, 2);
    element(out, tag, "US", bytes);
  }

  std::string bytes() const
  {
    std::string out;
    if (marker)
    {
      TestSlice meta;
      std::string group;
      const char* own = implicitVr  ? "1.2.840.10008.1.2"
                        : bigEndian ? "1.2.840.10008.1.2.2"
                                    : "1.2.840.10008.1.2.1";
      meta.element(group, 0x00020010, "UI", syntax.empty() ? own : syntax);
      out = std::string(128, '\0') + "DICM" + group;
    }
    const std::string here = core::fixedText(z, 6);
    element(out, 0x00080008, "CS", "ORIGINAL\\PRIMARY\\AXIAL");
    element(out, 0x00080016, "UI", sopClass);
    element(out, 0x00080018, "UI", "1.2.3.4.5." + std::to_string(1000 + static_cast<int>(z * 10)));
    element(out, 0x00080060, "CS", modality);
    element(out, 0x0008103e, "LO", "EAR \x1b[31mTEST");
    out += extra;
    element(out, 0x00100010, "PN", "SECRET^NAME");
    element(out, 0x0020000d, "UI", studyUid);
    element(out, 0x0020000e, "UI", seriesUid);
    element(out, 0x00200032, "DS",
            core::generalText(x) + "\\" + core::generalText(y) + "\\" + here);
    element(out, 0x00200037, "DS", orientation);
    element(out, 0x00200052, "UI", "1.2.3.9");
    number(out, 0x00280002, 1);
    element(out, 0x00280004, "CS", photometric);
    number(out, 0x00280010, static_cast<std::uint32_t>(rows));
    number(out, 0x00280011, static_cast<std::uint32_t>(columns));
    element(out, 0x00280030, "DS", "0.5\\0.4");
    number(out, 0x00280100, static_cast<std::uint32_t>(bitsAllocated));
    number(out, 0x00280101, static_cast<std::uint32_t>(bitsStored));
    number(out, 0x00280102, static_cast<std::uint32_t>(highBit < 0 ? bitsStored - 1 : highBit));
    number(out, 0x00280103, isSigned ? 1 : 0);
    if (padding)
      number(out, 0x00280120, *padding);
    if (paddingLimit)
      number(out, 0x00280121, *paddingLimit);
    out += extraPixel;
    if (slope)
    {
      element(out, 0x00281052, "DS", core::fixedText(intercept, 6));
      element(out, 0x00281053, "DS", core::fixedText(*slope, 6));
    }
    if (!pixels)
      return out;
    std::string data;
    std::uint32_t held = 0; // bits of a pixel that follow those of the one before
    int bits = 0;
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i)
        if (pixelTag == 0x7fe00008)
          appendReal(data, static_cast<float>(real(i, j)));
        else if (pixelTag == 0x7fe00009)
          appendReal(data, real(i, j));
        else if (bitsAllocated % 8 == 0)
          append(data, cell(i, j), bitsAllocated / 8);
        else
          for (held |= cell(i, j) << bits, bits += bitsAllocated; bits >= 8; bits -= 8, held >>= 8)
            data += static_cast<char>(held & 0xFFU);
    if (bits > 0)
      data += static_cast<char>(held & 0xFFU);
    data += std::string(data.size() % 2, '\0');
    const std::string vr = !pixelVr.empty()         ? pixelVr
                           : pixelTag == 0x7fe00008 ? "OF"
                           : pixelTag == 0x7fe00009 ? "OD"
                           : bitsAllocated == 8     ? "OB"
                                                    : "OW";
    if (bigEndian && vr == "OW" && bitsAllocated % 16 != 0) // words of 16 bits (PS3.5 7.3)
      for (std::size_t at = 0; at < data.size(); at += 2)
        std::swap(data[at], data[at + 1]);
    element(out, pixelTag, vr.c_str(), data);
    return out;
  }

  template <class Real>
  void appendReal(std::string& out, Real value) const
  {
    std::string raw(sizeof value, '\0');
    std::memcpy(raw.data(), &value, sizeof value);
    out += bigEndian ? std::string(raw.rbegin(), raw.rend()) : raw;
  }

  void write(const std::filesystem::path& file) const
  {
    std::filesystem::create_directories(file.parent_path());
    const std::string all = bytes();
    std::ofstream(file, std::ios::binary).write(all.data(), static_cast<long>(all.size()));
  }
};

/// `count` slices 0.5 mm apart; `change` modifies slice k before it is written.
inline void writeSeries(
    const std::filesystem::path& folder, int count,
    const std::function<void(int k, TestSlice&)>& change = [](int, TestSlice&) {})
{
  for (int k = 0; k < count; ++k)
  {
    TestSlice slice;
    slice.z = 0.5 * k;
    change(k, slice);
    slice.write(folder / ("s" + std::to_string(k) + ".dcm"));
  }
}

inline void writeText(const std::filesystem::path& file, const std::string& text)
{
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

} // namespace petrous::imaging::test
