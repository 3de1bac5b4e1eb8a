#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Library/Library.h"

namespace petrous::library
{

class JournalFile;

/// A case as its manifest has it, as far as strokes go on from it.
struct SavedState
{
  SavedState() = default;
  SavedState(const scene::Case& saved); ///< one that was just opened or saved

  std::string name;
  std::string id;
  std::uint64_t revision = 0;
  std::string ct;                   ///< its object
  std::vector<std::string> strokes; ///< their objects
  dissection::History history;
};

/// What was drilled since a case was saved, on the disk: strokes as they end, and of a long stroke
/// what was drilled every `kInterval` seconds, so that a kill loses no more than that.
/// Library::open brings it back.
///
/// The file is there while it holds something: it comes with the first stroke and goes when all is
/// saved, or with this object. A program that ends otherwise leaves it. One program at a time has a
/// journal of a case.
///
///     Journal journal(library, value);
///     ... journal.follow(*value.dissection);    // after each step, in the thread that cuts
///     library.save(value);
///     journal.saved(value);                     // in any thread
class Journal
{
public:
  static constexpr double kInterval = 4.5; ///< s, of the clock on the wall or of simulated time

  /// What is known of the open stroke, with what it removed so far. Asked in the thread that calls
  /// `follow`, once a part is due.
  using Measure = std::function<dissection::StrokeInfo(const dissection::Dissection&)>;

  /// For a case of the library, as it was opened or saved; what was drilled since then is told with
  /// `follow`. Where there is no `measure`, parts say of their stroke what Dissection::openInfo
  /// does. Throws LibraryError: Conflict where another process is drilling in this case.
  Journal(const Library& library, SavedState saved, Measure measure = {});

  /// Makes the file at once, so that nobody else starts drilling in this case. Throws LibraryError
  /// as the constructor, and where nothing can be written.
  void claim();

  /// Removes the file: whoever ends in order has saved, or does not want to.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Writes what is new in the dissection: strokes that ended, undo, redo, another branch, and a
  /// part of the open stroke where one is due. Costs a look at the clock where nothing is.
  /// Throws LibraryError (DiskFull, Unwritable): the file is as before, and the next call writes
  /// what is missing, a part after another interval. Branches must not be removed between two
  /// saves.
  void follow(const dissection::Dissection& work);

  /// The case was saved: what it holds leaves the file, and what was drilled since stays there.
  /// Throws LibraryError; the file then still has all of it.
  void saved(SavedState now);

  /// What is not saved stays on the disk when this object goes: Library::open brings it back.
  void leave();

  std::size_t bytes() const; ///< in the file

private:
  using Clock = std::chrono::steady_clock;
  struct Kept
  {
    std::size_t strokes = 0; ///< there must be more than that for the frame to be saved
    std::string frame;
  };

  void write(std::vector<Kept> frames);
  void makeFile();
  std::optional<Kept> partOf(const dissection::Dissection& work);

  mutable std::mutex m_mutex;
  std::filesystem::path m_folder;
  SavedState m_base;
  Measure m_measure;
  std::unique_ptr<JournalFile> m_file;
  std::vector<Kept> m_kept; ///< what the file holds

  std::size_t m_written = 0;     ///< strokes that the case or the file has
  dissection::History m_history; ///< that it has
  bool m_open = false;
  std::optional<volume::CutMask> m_last; ///< as of the last part; none: as the stroke began
  Clock::time_point m_lastWall;
  double m_lastDuration = 0.0;
};

} // namespace petrous::library
