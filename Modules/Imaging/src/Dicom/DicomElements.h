#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ByteSource.h"

namespace petrous::imaging
{

/// Group and element as one number: (0028,0010) is 0x00280010.
using Tag = std::uint32_t;

constexpr Tag kFloatPixelData = 0x7fe00008;
constexpr Tag kDoublePixelData = 0x7fe00009;
constexpr Tag kPixelData = 0x7fe00010;
constexpr Tag kExtendedOffsets = 0x7fe00001;
/// In the functional groups of a frame; kept is the number of its items.
constexpr Tag kRealWorldMapping = 0x00409096;

/// Whether the texts that a frame's functional group and the shared one state for an element are
/// not the same text or numbers; a group is either shared or stands for each frame (PS3.3
/// C.7.6.16.1.1). An empty text states nothing.
bool contradict(const std::string& ofFrame, const std::string& ofAll);

/// The short top-level elements of a DICOM file up to its pixel data (PS3.5 section 7, PS3.10).
///
/// Used instead of gdcm::Reader, which as built by Debian has assertions enabled: a damaged file
/// would abort the program and lose the user's work. GDCM decodes the pixels.
class DicomElements
{
public:
  enum class State
  {
    Foreign, ///< not DICOM
    Damaged, ///< an element does not fit into the file
    Complete ///< read to the pixel data or, without any, to the end
  };

  explicit DicomElements(ByteSource& source);

  State state() const noexcept { return m_state; }
  const std::string& transferSyntax() const noexcept ///< UID
  {
    return m_syntax;
  }
  bool isBigEndian() const noexcept { return m_bigEndian; }
  bool isExplicit() const noexcept { return m_explicit; }          ///< elements state their VR
  std::uint64_t dataStart() const noexcept { return m_dataStart; } ///< after the file meta group

  struct Pixels
  {
    Tag tag = 0; ///< 0: no pixel data
    std::uint64_t offset = 0;
    std::uint32_t length = 0; ///< kUndefinedLength if encapsulated
    bool isWords = false;     ///< VR OW
    /// Of the value of an extended offset table of `offsetCount` frames (PS3.3 C.7.6.3.1.8).
    std::uint64_t offsetTable = 0;
    std::uint64_t offsetCount = 0;
  };
  const Pixels& pixels() const noexcept { return m_pixels; }
  bool empty() const noexcept ///< no elements except file meta information
  {
    return m_count == 0;
  }

  bool hasModalityLut() const noexcept ///< a lookup table instead of rescale slope and intercept
  {
    return m_hasModalityLut;
  }

  /// Items of the per-frame functional groups (PS3.3 C.7.6.16).
  std::size_t frameCount() const noexcept { return m_frames.size(); }

  /// From now on values are those of this frame: its functional groups take precedence over the
  /// shared ones, and these over the top level.
  void selectFrame(std::size_t frame) noexcept { m_frame = frame; }
  /// Whether that frame's functional groups and the shared ones contradict each other.
  bool contradictsShared(Tag tag) const;

  /// Without padding and control characters, safe for a terminal or a JSON parser.
  std::string text(Tag tag) const;
  std::vector<std::string> words(Tag tag) const; ///< split at backslashes
  std::optional<double> number(Tag tag) const;   ///< decimal string; nullopt if malformed
  std::vector<double> numbers(Tag tag, std::size_t count) const; ///< all of them, or empty
  std::optional<double> real(Tag tag) const; ///< binary, four or eight bytes (FL, FD)
  std::optional<int> integer(Tag tag, bool isSigned = false) const; ///< binary, two or four bytes
  std::string bytes(Tag tag) const;                                 ///< as written

  static constexpr std::uint32_t kUndefinedLength = 0xFFFFFFFFU;

private:
  struct Element
  {
    Tag tag = 0;
    std::uint32_t length = 0;
    std::uint64_t value = 0; ///< offset
    bool isUnknown = false;  ///< VR UN: content of undefined length is implicit VR
    bool isWords = false;    ///< VR OW
  };

  bool findStart(std::uint64_t& offset);
  bool readMeta(std::uint64_t& offset);
  void readDataSet(std::uint64_t offset);
  bool readElement(std::uint64_t offset, Element& element, bool explicitVr);
  bool skipItems(std::uint64_t& offset, bool explicitVr, int depth);
  bool skipItemContent(std::uint64_t& offset, bool explicitVr, int depth);
  using Values = std::vector<std::pair<Tag, std::string>>; ///< ascending, each tag once
  static void set(Values& values, Tag tag, std::string value);
  static const std::string* find(const Values& values, Tag tag);
  bool keep(const Element& element, Values& values);
  bool readGroups(const Element& sequence, std::uint64_t& offset, bool explicitVr, int depth,
                  std::vector<Values>& items);
  bool readGroupItem(std::uint64_t& offset, std::uint64_t end, bool explicitVr, int depth,
                     Values& values);
  const std::string* find(Tag tag) const;
  std::uint16_t number16(const unsigned char* bytes) const;
  std::uint32_t number32(const unsigned char* bytes) const;

  ByteSource& m_source;
  State m_state = State::Foreign;
  std::string m_syntax;
  bool m_bigEndian = false;
  bool m_explicit = true;
  std::uint64_t m_dataStart = 0;
  bool m_hasModalityLut = false;
  std::size_t m_count = 0;
  Pixels m_pixels;
  Values m_values;              ///< top level
  std::vector<Values> m_shared; ///< one item
  std::vector<Values> m_frames;
  std::size_t m_frame = static_cast<std::size_t>(-1);
};

} // namespace petrous::imaging
