// The corpus of the fuzzing targets, as it is, cut and spoilt, through the same readers.

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "HostileReaders.h"

namespace fs = std::filesystem;
using petrous::testing::HostileReaders;

namespace
{

constexpr std::size_t kMostBytes = 200'000; // of the whole corpus

std::vector<fs::path> corpusOf(const std::string& reader)
{
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(PETROUS_CORPUS) / reader))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string bytesOf(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class HostileFiles : public ::testing::TestWithParam<std::string>
{
protected:
  const HostileReaders m_readers;
};

} // namespace

// What is neither accepted nor refused in one line throws through, or crashes.
TEST_P(HostileFiles, AreReadOrRefused)
{
  std::size_t accepted = 0;
  for (const fs::path& file : corpusOf(GetParam()))
    accepted += m_readers.accepts(GetParam(), bytesOf(file)) ? 1 : 0;
  EXPECT_GT(accepted, 0U) << "a corpus without a valid file reaches little of the reader";
}

TEST_P(HostileFiles, AreReadOrRefusedWhereverTheyBreakOff)
{
  for (const fs::path& file : corpusOf(GetParam()))
  {
    const std::string bytes = bytesOf(file);
    for (std::size_t hundredths = 0; hundredths < 100; ++hundredths)
      ASSERT_NO_THROW(
          m_readers.accepts(GetParam(), bytes.substr(0, bytes.size() * hundredths / 100)))
          << file << " cut to " << hundredths << " %";
  }
}

TEST_P(HostileFiles, AreReadOrRefusedWithAnyByteChanged)
{
  std::uint32_t random = 1;
  for (const fs::path& file : corpusOf(GetParam()))
  {
    const std::string bytes = bytesOf(file);
    for (int n = 0; n < 200 && !bytes.empty(); ++n)
    {
      std::string spoilt = bytes;
      for (int change = 0; change <= n % 3; ++change)
      {
        random = random * 1664525U + 1013904223U;
        // Mostly in the header.
        const std::size_t range =
            n % 4 == 0 ? bytes.size() : std::min<std::size_t>(600, bytes.size());
        spoilt[(random >> 8) % range] = "\0\xff\x7f\x80 9-e"[random & 7];
      }
      ASSERT_NO_THROW(m_readers.accepts(GetParam(), spoilt)) << file << ", change " << n;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, HostileFiles, ::testing::ValuesIn(HostileReaders::names()),
                         [](const auto& reader)
                         {
                           std::string name = reader.param;
                           name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
                           return name;
                         });

TEST(HostileCorpus, IsSmall)
{
  std::size_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(PETROUS_CORPUS))
    bytes += entry.is_regular_file() ? entry.file_size() : 0;
  EXPECT_LT(bytes, kMostBytes);
}
