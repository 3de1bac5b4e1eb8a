#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include "petrous/Imaging/FileError.h"

namespace petrous::imaging
{

/// Temporary folder, removed after the test.
class TestFolder
{
public:
  TestFolder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "petrous-test-XXXXXX").string();
    m_path = mkdtemp(name.data());
  }
  ~TestFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return m_path / name; }
  const std::filesystem::path& path() const { return m_path; }
  std::size_t fileCount() const
  {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(m_path))
      count += entry.exists() ? 1 : 0;
    return count;
  }

private:
  std::filesystem::path m_path;
};

inline std::string fileBytes(const std::filesystem::path& path)
{
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

inline std::filesystem::path putFile(const std::filesystem::path& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

inline std::filesystem::path putGzip(const std::filesystem::path& path, const std::string& bytes)
{
  gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(file);
  return path;
}

template <class T>
std::string bytesOf(const std::vector<T>& values)
{
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// Reason and message of the FileError thrown by `action`.
struct Refusal
{
  bool thrown = false;
  FileError::Reason reason{};
  core::Fault fault{};
  std::string text;
};

template <class Action>
Refusal refusalOf(const Action& action)
{
  try
  {
    action();
  }
  catch (const FileError& error)
  {
    return {true, error.reason, error.fault(), error.what()};
  }
  return {};
}

/// One line "PATH: what is wrong; what would be right".
inline void expectRefused(const Refusal& refusal, FileError::Reason reason,
                          const std::string& word = "")
{
  ASSERT_TRUE(refusal.thrown);
  EXPECT_EQ(refusal.reason, reason) << refusal.text;
  EXPECT_EQ(refusal.text.find('\n'), std::string::npos) << refusal.text;
  EXPECT_NE(refusal.text.find(": "), std::string::npos) << refusal.text;
  EXPECT_NE(refusal.text.find(word), std::string::npos) << refusal.text;
}

/// A NIfTI-1 header written field by field from the standard (nifti1.h), not by our writer.
struct TestNifti
{
  std::vector<std::int16_t> dims{3, 4, 3, 2, 1, 1, 1, 1};
  std::int16_t dataType = 4;
  std::int16_t bits = 16;
  std::vector<float> pixdim{1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F};
  float slope = 1.0F;
  float intercept = 0.0F;
  char units = 2;
  std::int16_t qform = 0;
  std::int16_t sform = 1;
  std::vector<float> quaternion{0.0F, 0.0F, 0.0F};
  std::vector<float> offset{0.0F, 0.0F, 0.0F};
  std::vector<float> srow{1.0F, 0.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F};
  std::string voxels;

  std::string bytes() const
  {
    std::string h(352, '\0');
    const auto put = [&h](std::size_t at, const auto& values)
    {
      const std::string raw = bytesOf(values);
      h.replace(at, raw.size(), raw);
    };
    put(0, std::vector<std::int32_t>{348});
    put(40, dims);
    put(70, std::vector<std::int16_t>{dataType, bits});
    put(76, pixdim);
    put(108, std::vector<float>{352.0F, slope, intercept});
    h[123] = units;
    put(252, std::vector<std::int16_t>{qform, sform});
    put(256, quaternion);
    put(268, offset);
    put(280, srow);
    h.replace(344, 3, "n+1");
    return h + voxels;
  }

  /// The same header as NIfTI-2 (nifti2.h), without the voxels; as wanted, big-endian.
  std::string second(const std::string& magic, std::int64_t voxelOffset, bool big = false) const
  {
    std::string h(544, '\0');
    const auto put = [&h, big](std::size_t at, auto value)
    {
      std::string raw = bytesOf(std::vector{value});
      if (big)
        std::reverse(raw.begin(), raw.end());
      h.replace(at, raw.size(), raw);
    };
    put(0, std::int32_t{540});
    h.replace(4, magic.size(), magic);
    h.replace(8, 4, "\r\n\x1a\n");
    put(12, dataType);
    put(14, bits);
    for (std::size_t n = 0; n < 8; ++n)
      put(16 + 8 * n, std::int64_t{dims[n]});
    for (std::size_t n = 0; n < 8; ++n)
      put(104 + 8 * n, double{pixdim[n]});
    put(168, voxelOffset);
    put(176, double{slope});
    put(184, double{intercept});
    put(344, std::int32_t{qform});
    put(348, std::int32_t{sform});
    for (std::size_t n = 0; n < 3; ++n)
    {
      put(352 + 8 * n, double{quaternion[n]});
      put(376 + 8 * n, double{offset[n]});
    }
    for (std::size_t n = 0; n < 12; ++n)
      put(400 + 8 * n, double{srow[n]});
    put(500, std::int32_t{units});
    return h;
  }
};

} // namespace petrous::imaging
