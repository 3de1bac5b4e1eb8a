#pragma once

#include <string>
#include <vector>

namespace petrous::scene
{

enum class Side
{
  Unknown,
  Left, ///< of the patient
  Right,
  Both
};

/// What the clinician says of a case. Typed by the user: nothing of it comes from an image.
struct Description
{
  static constexpr std::size_t kLongestNote = 65536; ///< bytes
  static constexpr std::size_t kLongestLine = 500;   ///< diagnosis, procedure; bytes
  static constexpr std::size_t kLongestTag = 64;     ///< bytes
  static constexpr std::size_t kMaxTags = 64;

  std::string note; ///< any number of lines, which end in \n
  std::vector<std::string> tags;
  std::string diagnosis; ///< a line, like procedure
  std::string procedure;
  Side side = Side::Unknown;
  std::string date; ///< of the planned operation, ISO 8601: "2026-03-31"; or empty

  bool empty() const;
};

bool operator==(const Description& a, const Description& b);
inline bool operator!=(const Description& a, const Description& b)
{
  return !(a == b);
}

/// Throws InvalidParameter naming the first field that is invalid, and the limit. All text must be
/// UTF-8 without control characters (C0 and C1), but for tabs and line ends of the note; neither
/// lines nor tags are blank at their ends; tags differ in more than case (lowerCase); the date
/// exists.
void checkDescription(const Description& description);

const char* nameOf(Side side) noexcept; ///< "left", "right", "both", "unknown"
/// Throws InvalidParameter for another name.
Side sideFromName(const std::string& name);

/// Whether it is a date of the calendar as YYYY-MM-DD, of the years 1900 to 2999.
bool isDate(const std::string& text) noexcept;

/// Lower case of ASCII and of the accented letters of Latin-1, in UTF-8.
std::string lowerCase(std::string text);

} // namespace petrous::scene
