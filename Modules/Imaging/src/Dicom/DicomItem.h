#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "DicomElements.h"

namespace petrous::imaging
{

/// A data set in memory, or an item of one of its sequences (PS3.5 section 7.5). Values are views
/// of the bytes it was made from; sequences are parsed when they are asked for. An element that
/// does not fit ends the item and sets `isDamaged`.
class DicomItem
{
public:
  struct Encoding
  {
    bool isExplicit = true; ///< elements state their VR
    bool isBigEndian = false;
  };

  DicomItem() = default;
  DicomItem(std::string_view bytes, Encoding encoding);

  bool isDamaged() const noexcept { return m_isDamaged; }
  /// What it was made from.
  std::string_view bytes() const noexcept { return m_bytes; }
  bool has(Tag tag) const noexcept { return find(tag) != nullptr; }

  /// Without padding and control characters; "" if absent.
  std::string text(Tag tag) const;
  /// All numbers of a decimal or integer string, or empty if one is malformed.
  std::vector<double> numbers(Tag tag) const;
  std::optional<double> number(Tag tag) const;
  /// Binary values of two bytes (US); empty if absent.
  std::vector<int> shorts(Tag tag) const;
  std::optional<int> integer(Tag tag) const;
  /// A binary value of four bytes (UL).
  std::optional<std::uint32_t> whole(Tag tag) const;
  /// The items of a sequence, the last one damaged if more follows that is none, and its first one
  /// (an item without elements if there is none).
  std::vector<DicomItem> items(Tag tag) const;
  DicomItem item(Tag tag) const;

private:
  struct Element
  {
    Tag tag = 0;
    Encoding items; ///< of its items
    bool isBigEndian = false;
    std::string_view value;
  };
  const Element* find(Tag tag) const noexcept;

  std::string_view m_bytes;
  std::vector<Element> m_elements; ///< ascending
  bool m_isDamaged = false;
};

/// `text` as UTF-8, by the character set (0008,0005) of its data set: ISO_IR 192 and ISO_IR 100;
/// letters of others become '?'.
std::string toUtf8(const std::string& text, const std::string& characterSet);

} // namespace petrous::imaging
