#include "OpenIgtLinkStream.h"

#include <algorithm>
#include <array>
#include <cmath>
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

constexpr double kOff = 0.1; // of a rotation's products of columns, a quaternion's norm

// Right-handed, columns orthonormal to kOff.
bool isRotation(const double m[3][3])
{
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j)
    {
      const double product = m[0][i] * m[0][j] + m[1][i] * m[1][j] + m[2][i] * m[2][j];
      if (!(std::abs(product - (i == j ? 1.0 : 0.0)) < kOff))
        return false;
    }
  const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                             m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                             m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return determinant > 0.0;
}

bool finite(const double v[3])
{
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
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
  return isRotation(pose.rotation) && finite(pose.position);
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
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(std::abs(norm - 1.0) < kOff) || !finite(pose.position))
    return false;
  const double x = q[0] / norm;
  const double y = q[1] / norm;
  const double z = q[2] / norm;
  const double w = q[3] / norm;
  const double matrix[3][3] = {
      {w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)},
      {2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x)},
      {2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z}};
  std::memcpy(pose.rotation, matrix, sizeof matrix);
  return true;
}

char upper(char c) noexcept
{
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

bool isWord(const std::string& value, const char* word)
{
  return std::equal(value.begin(), value.end(), word, word + std::strlen(word),
                    [](char a, char b) { return upper(a) == upper(b); });
}

// Whether metadata say that the tracker does not see the tool: a count of entries, 8 bytes each
// with the sizes of key and value, in `header`; keys and values in `content`.
bool missingBy(const unsigned char* header, std::uint64_t headerSize, const unsigned char* content,
               std::uint64_t size)
{
  const std::uint64_t count = headerSize >= 2 ? integer(header, 2) : 0;
  bool missing = false;
  for (std::uint64_t i = 0; i < count && 2 + 8 * (i + 1) <= headerSize; ++i)
  {
    const unsigned char* entry = header + 2 + 8 * i;
    const std::uint64_t keySize = integer(entry, 2);
    const std::uint64_t valueSize = integer(entry + 4, 4);
    if (keySize + valueSize > size)
      break;
    const std::string key(content, content + keySize);
    const std::string value(content + keySize, content + keySize + valueSize);
    missing = missing || (key == "TransformStatus" && !isWord(value, "OK")) ||
              (key == "TransformValid" && (isWord(value, "false") || value == "0"));
    content += keySize + valueSize;
    size -= keySize + valueSize;
  }
  return missing;
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
    bool missing = false;
    if (good && version >= 2) // an extended header before, metadata behind
    {
      const std::uint64_t extended = size >= 12 ? integer(content, 2) : size + 1;
      const std::uint64_t metadataHeader = size >= 12 ? integer(content + 2, 2) : 0;
      const std::uint64_t metadata = metadataHeader + (size >= 12 ? integer(content + 4, 4) : 0);
      good = extended >= 12 && extended + metadata <= size;
      if (good)
      {
        const unsigned char* behind = content + (size - metadata);
        missing =
            missingBy(behind, metadataHeader, behind + metadataHeader, metadata - metadataHeader);
        content += extended;
        contentSize -= extended + metadata;
      }
    }
    TrackedPose pose{};
    pose.tool = text(header + 14, 20);
    pose.missing = missing;
    if (good && (missing || (type == "TRANSFORM" ? transform(content, contentSize, pose)
                                                 : position(content, contentSize, pose))))
      poses.push_back(pose);
    else
      ++m_refused;
    begin += kHeader + length;
  }
  m_bytes.erase(m_bytes.begin(), m_bytes.begin() + static_cast<std::ptrdiff_t>(begin));
}

} // namespace petrous::devices
