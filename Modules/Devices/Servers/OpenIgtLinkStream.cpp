#include "OpenIgtLinkStream.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace petrous::devices
{

namespace
{

constexpr std::size_t kHeader = 58;
constexpr std::uint64_t kLargestBody = 65536;             // of a pose, with its metadata
constexpr std::uint64_t kPolynomial = 0x42F0E1EBA9EA3693; // ECMA-182

std::uint64_t integer(const unsigned char* bytes, int count)
{
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i)
    value = value << 8U | bytes[i];
  return value;
}

double real(const unsigned char* bytes)
{
  const auto bits = static_cast<std::uint32_t>(integer(bytes, 4));
  float value = 0.0F;
  std::memcpy(&value, &bits, sizeof value);
  return static_cast<double>(value);
}

std::string text(const unsigned char* bytes, std::size_t most)
{
  const unsigned char* end = std::find(bytes, bytes + most, '\0');
  return {bytes, end};
}

// Three columns of the rotation, then the translation.
bool transform(const unsigned char* content, std::uint64_t size, TrackedPose& pose)
{
  if (size < 48)
    return false;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 3; ++row)
      (column < 3 ? pose.rotation[row][column] : pose.position[row]) =
          real(content + 4 * (3 * column + row));
  return true;
}

// Position, then a quaternion x, y, z, w, which may be left out.
bool position(const unsigned char* content, std::uint64_t size, TrackedPose& pose)
{
  if (size < 12)
    return false;
  double q[4] = {0.0, 0.0, 0.0, 1.0};
  for (int i = 0; i < 3; ++i)
    pose.position[i] = real(content + 4 * i);
  for (int i = 0; i < 4 && size >= 28; ++i)
    q[i] = real(content + 12 + 4 * i);
  const double x = q[0];
  const double y = q[1];
  const double z = q[2];
  const double w = q[3];
  const double matrix[3][3] = {
      {w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)},
      {2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x)},
      {2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z}};
  std::memcpy(pose.rotation, matrix, sizeof matrix);
  return true;
}

} // namespace

std::uint64_t OpenIgtLinkStream::checksum(const unsigned char* bytes, std::size_t count)
{
  static const std::array<std::uint64_t, 256> kTable = []
  {
    std::array<std::uint64_t, 256> table{};
    for (std::uint64_t i = 0; i < table.size(); ++i)
    {
      std::uint64_t value = i << 56U;
      for (int bit = 0; bit < 8; ++bit)
        value = (value << 1U) ^ ((value >> 63U) != 0 ? kPolynomial : 0U);
      table[i] = value;
    }
    return table;
  }();
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < count; ++i)
    sum = kTable[static_cast<std::size_t>((sum >> 56U) ^ bytes[i])] ^ (sum << 8U);
  return sum;
}

void OpenIgtLinkStream::take(const unsigned char* bytes, std::size_t count,
                             std::vector<TrackedPose>& poses)
{
  const auto skipped = static_cast<std::size_t>(std::min<std::uint64_t>(m_skip, count));
  m_skip -= skipped;
  m_bytes.insert(m_bytes.end(), bytes + skipped, bytes + count);

  std::size_t begin = 0;
  while (m_bytes.size() - begin >= kHeader)
  {
    const unsigned char* header = m_bytes.data() + begin;
    const std::uint64_t version = integer(header, 2);
    const std::string type = text(header + 2, 12);
    const std::uint64_t size = integer(header + 42, 8);
    const bool wanted = type == "TRANSFORM" || type == "POSITION";
    if (!wanted || size > kLargestBody)
    {
      m_refused += wanted ? 1 : 0;
      const std::uint64_t here = m_bytes.size() - begin - kHeader;
      const auto passed = static_cast<std::size_t>(std::min(size, here));
      m_skip = size - passed;
      begin += kHeader + passed;
      continue;
    }
    const auto length = static_cast<std::size_t>(size);
    if (m_bytes.size() - begin < kHeader + length)
      break;
    const unsigned char* content = header + kHeader;
    std::uint64_t contentSize = size;
    bool good = integer(header + 50, 8) == checksum(content, length);
    if (good && version >= 2) // an extended header before, metadata behind
    {
      const std::uint64_t extended = size >= 12 ? integer(content, 2) : size + 1;
      const std::uint64_t metadata =
          size >= 12 ? integer(content + 2, 2) + integer(content + 4, 4) : 0;
      good = extended >= 12 && extended + metadata <= size;
      if (good)
      {
        content += extended;
        contentSize -= extended + metadata;
      }
    }
    TrackedPose pose{};
    pose.tool = text(header + 14, 20);
    if (good && (type == "TRANSFORM" ? transform(content, contentSize, pose)
                                     : position(content, contentSize, pose)))
      poses.push_back(pose);
    else
      ++m_refused;
    begin += kHeader + length;
  }
  m_bytes.erase(m_bytes.begin(), m_bytes.begin() + static_cast<std::ptrdiff_t>(begin));
}

} // namespace petrous::devices
