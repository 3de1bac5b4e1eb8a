#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "petrous/Library/Journal.h"

namespace petrous::library
{

// The file of a journal: frames one after the other, each with its length and its hash, so that
// what a kill or a flipped bit left is known for what it is. The layout is in
// Documentation/adr/0003.

struct JournalFrame
{
  enum class Kind : std::uint8_t
  {
    Head = 'J',    ///< text: which case and revision
    Stroke = 'S',  ///< text: scene::toText(StrokePart), bytes: its voxels
    History = 'H', ///< text: scene::toText(History)
    Part = 'P'     ///< of the open stroke: as Stroke, since the part before
  };
  Kind kind = Kind::Head;
  std::string text;
  std::vector<std::uint8_t> bytes;
};

/// The state from which the session went on. What follows `strokes` is missing in journals of older
/// programs.
struct JournalHead
{
  JournalHead() = default;
  explicit JournalHead(const SavedState& base);

  std::string caseName;
  std::uint64_t revision = 0; ///< of the manifest
  std::size_t strokes = 0;    ///< that it has
  std::string ct;             ///< its object
  std::string strokesHash;    ///< of the names of their objects
  std::string history;        ///< scene::toText
};

/// What JournalHead::strokesHash says of these strokes.
std::string hashOfNames(const std::vector<std::string>& strokes);

struct JournalContent
{
  bool headed = false;  ///< else nothing of the rest is known
  bool started = false; ///< else the writer ended before its head was whole
  JournalHead head;
  std::vector<JournalFrame> frames; ///< the good ones up to the first that is not
  std::size_t leftOver = 0;         ///< bytes behind them
};

std::string encoded(const JournalFrame& frame);
std::string encoded(const JournalHead& head);

/// Never throws but for memory: what cannot be read is left over.
JournalContent journalFrom(std::string_view bytes);

/// Where the journal of a case lies.
std::filesystem::path journalPath(const std::filesystem::path& library, const std::string& name);

/// Renames a journal that cannot be used to a name that nobody has; that name. Throws LibraryError.
std::filesystem::path setAside(const std::filesystem::path& journal);

/// A journal that is open and locked: nobody else writes it or takes it for left behind.
class JournalFile
{
public:
  /// Makes the file with its head. Throws LibraryError: Conflict where another process has one.
  JournalFile(const std::filesystem::path& path, const JournalHead& head);

  /// One that is there. `held()` is false where a live program has it, `there()` where it is gone.
  explicit JournalFile(const std::filesystem::path& path);

  ~JournalFile();
  JournalFile(JournalFile&& other) noexcept;
  JournalFile& operator=(JournalFile&& other) noexcept;

  bool there() const noexcept { return m_descriptor >= 0; }
  bool held() const noexcept { return m_held; }
  std::size_t size() const noexcept { return m_size; }
  std::string read() const; ///< all of it

  /// Frames at the end, on the disk when it returns. Throws LibraryError; then the file is as
  /// before.
  void append(std::string_view frames);

  /// Takes the place of what lies there. Throws LibraryError.
  void moveTo(const std::filesystem::path& path);

  void remove() noexcept;

private:
  void write(std::string_view bytes);

  std::filesystem::path m_path;
  int m_descriptor = -1;
  bool m_held = false;
  std::size_t m_size = 0;
};

} // namespace petrous::library
