#include "PduChecker.h"

#include <algorithm>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmnet/assoc.h>

namespace petrous::network
{
namespace
{

constexpr std::uint32_t kHeader = 6, kItem = 4, kPdvLength = 4; // bytes
constexpr std::uint32_t kFields = 68;                           // version, titles, reserved
constexpr std::uint32_t kLeastPdv = 2;                          // context, control header
constexpr std::uint32_t kMaxAssociation = 1 << 20; // 128 contexts of 40 syntaxes are a third of it

constexpr std::uint8_t kRequest = 1, kAccept = 2, kData = 4, kAbort = 7;

} // namespace

void PduChecker::read(Part part, std::size_t size)
{
  m_part = part;
  m_needed = size;
  m_read = 0;
}

std::uint32_t PduChecker::number(std::size_t from, std::size_t size) const
{
  std::uint32_t value = 0;
  for (std::size_t n = from; n < from + size; ++n)
    value = value << 8 | m_bytes[n];
  return value;
}

std::string PduChecker::take(const std::uint8_t* bytes, std::size_t count)
{
  while (count > 0)
  {
    const std::size_t now = std::min(count, m_needed);
    if (m_part != Part::Body && m_part != Part::Fields)
    {
      std::copy_n(bytes, now, m_bytes.begin() + static_cast<std::ptrdiff_t>(m_read));
      m_read += now;
    }
    bytes += now;
    count -= now;
    m_needed -= now;
    if (m_needed > 0)
      break;
    if (std::string fault = next(); !fault.empty())
    {
      m_needed = 1;
      return fault;
    }
  }
  return {};
}

// A part is complete.
std::string PduChecker::next()
{
  std::uint32_t behind = 0;
  switch (m_part)
  {
  case Part::Header:
    return begin();
  case Part::Item:
    behind = number(2, 2);
    break;
  case Part::PdvLength:
    behind = number(0, 4);
    if (behind < kLeastPdv)
      return "a data value of " + std::to_string(behind) + " bytes";
    break;
  case Part::Fields:
  case Part::Body:
    break;
  }
  if (behind > m_left)
    return "a PDU of type " + std::to_string(m_type) + " with a part that is longer than it is";
  m_left -= behind;
  if (behind > 0)
    read(Part::Body, behind);
  else if (m_left == 0)
    read(Part::Header, kHeader);
  else
  {
    const std::uint32_t size = m_type == kData ? kPdvLength : kItem;
    if (m_left < size)
      return "a PDU of type " + std::to_string(m_type) + " with bytes behind its last part";
    m_left -= size;
    read(m_type == kData ? Part::PdvLength : Part::Item, size);
  }
  return {};
}

std::string PduChecker::begin()
{
  m_type = m_bytes[0];
  const std::uint32_t length = number(2, 4);
  const bool isAssociation = m_type == kRequest || m_type == kAccept;
  if (m_type < kRequest || m_type > kAbort)
    return "a PDU of type " + std::to_string(m_type);
  const std::uint32_t least = isAssociation     ? kFields
                              : m_type == kData ? kPdvLength + kLeastPdv
                                                : 4;
  const std::uint32_t most = isAssociation     ? kMaxAssociation
                             : m_type == kData ? ASC_MAXIMUMPDUSIZE
                                               : 4;
  if (length < least || length > most)
    return "a PDU of type " + std::to_string(m_type) + " that states " + std::to_string(length) +
           " bytes";
  m_left = length;
  if (isAssociation)
  {
    m_left -= kFields;
    read(Part::Fields, kFields);
  }
  else if (m_type == kData)
  {
    m_left -= kPdvLength;
    read(Part::PdvLength, kPdvLength);
  }
  else
  {
    m_left = 0;
    read(Part::Body, length);
  }
  return {};
}

} // namespace petrous::network
