#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "petrous/Library/Journal.h"

namespace petrous::library
{

// A journal file is a sequence of frames, each with its length and hash, so that truncation by a
// kill and flipped bits are detected. The layout is in Documentation/adr/0003.

struct JournalFrame
{
  enum class Kind : std::uint8_t
  {
    Head = 'J',    ///< text: case and revision
    Stroke = 'S',  ///< text: scene::toText(Stroke), bytes: voxels
    History = 'H', ///< text: scene::toText(History)
    Part = 'P'     ///< of the open stroke: like Stroke, since the previous part
  };
  Kind kind = Kind::Head;
  std::string text;
  std::vector<std::uint8_t> bytes;
};

/// The state that the journal continues. The members after `strokes` are missing in journals of
/// older programs, and `caseId` also where the case has none.
struct JournalHead
{
  JournalHead() = default;
  explicit JournalHead(const SavedState& base);

  std::string caseName;
  std::uint64_t revision = 0; ///< of the manifest
  std::size_t strokes = 0;    ///< in the manifest
  std::string ct;             ///< object name
  std::string strokesHash;    ///< of their object names
  std::string history;        ///< scene::toText
  std::string caseId;

  /// By the ID, else by the name: the case may have another name by now.
  bool isOf(const scene::Case& value) const;
};

/// JournalHead::strokesHash of these strokes.
std::string hashOfNames(const std::vector<std::string>& strokes);

constexpr int kJournalFormat = 1;

struct JournalContent
{
  bool headed = false;  ///< else nothing else is known
  int newerFormat = 0;  ///< that of a newer program, which alone can read it; 0: it is none
  bool started = false; ///< else the writer terminated before its head was complete
  JournalHead head;
  std::vector<JournalFrame> frames; ///< valid frames up to the first invalid one
  std::size_t leftOver = 0;         ///< bytes after them
};

/// The frame of a stroke, or of a part of one, with its voxels.
JournalFrame frameOf(JournalFrame::Kind kind, dissection::Stroke stroke);

std::string encoded(const JournalFrame& frame);
std::string encoded(const JournalHead& head);

/// Throws only bad_alloc: unreadable content is reported as left over.
JournalContent journalFrom(std::string_view bytes);

/// Path of the journal of a case, unless it was renamed while open (journalOf in ManifestFile.h).
std::filesystem::path journalPath(const std::filesystem::path& library, const std::string& name);

/// JournalHead::caseId of a file, which is not locked for that; empty if it has none or cannot be
/// read.
std::string caseIdIn(const std::filesystem::path& journal) noexcept;

/// Whether it is known to belong to another case than that of this ID; false if that is empty.
bool isOfOtherCase(const std::filesystem::path& journal, const std::string& id) noexcept;

/// Renames an unusable journal to an unused name and returns that. Throws LibraryError.
std::filesystem::path setAside(const std::filesystem::path& journal);

/// An open and locked journal: no other process writes it or considers it stale.
class JournalFile
{
public:
  /// Creates the file with its head. Throws LibraryError: Conflict if another process has one.
  JournalFile(const std::filesystem::path& path, const JournalHead& head);

  /// Opens an existing file. `held()` is false if a running program has it locked, `there()` if it
  /// is gone.
  explicit JournalFile(const std::filesystem::path& path);

  ~JournalFile();
  JournalFile(JournalFile&& other) noexcept;
  JournalFile& operator=(JournalFile&& other) noexcept;

  bool there() const noexcept { return m_descriptor >= 0; }
  bool held() const noexcept { return m_held; }
  std::size_t size() const noexcept { return m_size; }
  const std::filesystem::path& path() const noexcept { return m_path; }
  std::string read() const; ///< the whole file

  /// Appends frames, synced to disk on return. Throws LibraryError; the file is then unchanged.
  void append(std::string_view frames);

  /// Atomically replaces the file at `path`. Throws LibraryError.
  void moveTo(const std::filesystem::path& path);

  /// Not another file that is at its path by now.
  void remove() noexcept;

private:
  void write(std::string_view bytes);

  std::filesystem::path m_path;
  int m_descriptor = -1;
  bool m_held = false;
  std::size_t m_size = 0;    ///< of the frames that were appended
  bool m_hasRemains = false; ///< of an append that failed, behind them
};

} // namespace petrous::library
