#include "EditCodec.h"

#include <cstddef>
#include <cstring>

#include "WordPlanes.h"

namespace petrous::session
{

namespace
{

constexpr std::size_t kColumns = sizeof(MaskEdit) / 8;
constexpr std::size_t kFrom = offsetof(MaskEdit, from) / 8;
constexpr std::size_t kTo = offsetof(MaskEdit, to) / 8;

using Row = std::uint64_t[kColumns];

std::uint64_t predict(const Row& row, const Row& before, std::size_t column)
{
  return column >= kTo && column < kTo + 3 ? row[column - kTo + kFrom] : before[column];
}

} // namespace

std::size_t maxEditBytes(std::size_t count)
{
  return kColumns * (1 + 8 * count);
}

std::vector<std::uint8_t> encodeEdits(const std::vector<MaskEdit>& edits)
{
  std::vector<std::uint8_t> bytes;
  Words codes(edits.size());
  for (std::size_t column = 0; column < kColumns; ++column)
  {
    Row before{}, row{};
    for (std::size_t n = 0; n < edits.size(); ++n)
    {
      std::memcpy(row, &edits[n], sizeof row);
      codes[n] = codeOf(row[column], predict(row, before, column));
      std::memcpy(before, row, sizeof row);
    }
    const int planes = planesOf(codes);
    bytes.push_back(static_cast<std::uint8_t>(planes));
    putPlanes(codes, planes, bytes);
  }
  return bytes;
}

bool decodeEdits(const std::vector<std::uint8_t>& bytes, std::size_t count,
                 std::vector<MaskEdit>& edits)
{
  std::vector<Words> columns(kColumns, Words(count));
  std::size_t at = 0;
  for (Words& column : columns)
  {
    if (at == bytes.size())
      return false;
    const std::size_t planes = bytes[at++];
    if (planes > 8 || bytes.size() - at < planes * count)
      return false;
    for (std::size_t n = 0; n < count; ++n)
      column[n] = codeAt(bytes.data() + at, planes, count, n);
    at += planes * count;
  }
  if (at != bytes.size())
    return false;
  edits.resize(count);
  Row before{}, row{};
  for (std::size_t n = 0; n < count; ++n)
  {
    for (std::size_t column = 0; column < kColumns; ++column)
      row[column] = wordOf(columns[column][n], predict(row, before, column));
    std::memcpy(&edits[n], row, sizeof row);
    std::memcpy(before, row, sizeof row);
    if (edits[n].kind > MaskEdit::Kind::Redo)
      return false;
  }
  return true;
}

} // namespace petrous::session
