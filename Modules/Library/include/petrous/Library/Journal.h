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

/// A case as of its manifest, as far as needed to continue its strokes.
struct SavedState
{
  SavedState() = default;
  SavedState(const scene::Case& saved); ///< just opened or saved

  std::string name;
  std::string id;
  std::uint64_t revision = 0;
  std::string ct;                   ///< object name
  std::vector<std::string> strokes; ///< object names
  dissection::History history;
};

/// Journal of what was drilled since a case was saved: each finished stroke, and of a long stroke
/// its progress every `kInterval` seconds, so that a kill loses no more than that. Library::open
/// recovers it.
///
/// The file exists while it has content: it is created with the first stroke and removed when
/// everything is saved, or by the destructor. A program that terminates otherwise leaves it behind.
/// Only one program at a time has a journal of a case.
///
///     Journal journal(library, value);
///     ... journal.follow(value.dissection);    // after each step, on the drilling thread
///     library.save(value);
///     journal.saved(value);                     // on any thread
class Journal
{
public:
  static constexpr double kInterval = 4.5; ///< s, wall-clock or simulated time

  /// Info on the open stroke, including the volume removed so far. Called on the thread that calls
  /// `follow`, whenever a part is due.
  using Measure = std::function<dissection::StrokeInfo(const dissection::Dissection&)>;

  /// For a case of the library as it was opened or saved; what is drilled afterwards is passed to
  /// `follow`. Without `measure`, parts are recorded with Dissection::openInfo. Throws
  /// LibraryError: Conflict if another process is drilling in this case.
  Journal(const Library& library, SavedState saved, Measure measure = {});

  /// Creates the file at once, so that nobody else starts drilling in this case. Throws
  /// LibraryError like the constructor, and if nothing can be written.
  void claim();

  /// Removes the file: a caller that exits regularly has saved, or does not want to.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Writes what is new in the dissection: finished strokes, undo, redo, branch changes, and a part
  /// of the open stroke if due. If nothing is new it only reads the clock. Throws LibraryError
  /// (DiskFull, Unwritable): the file is unchanged, and the next call writes what is missing, a
  /// part after another interval. Branches must not be removed between two saves.
  void follow(const dissection::Dissection& work);

  /// Call after the case was saved: removes from the file what the case now contains; later strokes
  /// remain. Throws LibraryError; the file then still has everything.
  void saved(SavedState now);

  /// Keeps unsaved content on disk when this object is destroyed: Library::open recovers it.
  void leave();

  std::size_t bytes() const; ///< size of the file

private:
  using Clock = std::chrono::steady_clock;
  struct Kept
  {
    std::size_t strokes = 0; ///< the frame is saved once the case has more strokes than this
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
  std::vector<Kept> m_kept; ///< content of the file

  std::size_t m_written = 0;     ///< strokes in the case or the file
  dissection::History m_history; ///< as in the case or the file
  bool m_open = false;
  std::optional<volume::CutMask> m_last; ///< as of the last part; nullopt: at the stroke's start
  Clock::time_point m_lastWall;
  double m_lastDuration = 0.0;
};

} // namespace petrous::library
