#include "petrous/Library/Journal.h"

#include <utility>

#include "Graft.h"
#include "JournalFile.h"
#include "ManifestFile.h"
#include "petrous/Dissection/StrokeCodec.h"
#include "petrous/Scene/HistoryText.h"

namespace petrous::library
{

namespace fs = std::filesystem;

SavedState::SavedState(const scene::Case& saved)
  : name(saved.name)
  , id(saved.id)
  , revision(saved.revision)
  , ct(saved.ct.object)
  , history(saved.dissection.history())
{
  for (const auto& stroke : saved.dissection.strokes())
    strokes.push_back(stroke->object);
}

namespace
{

// Sets aside a journal that Library::open could not recover, and reported. Throws LibraryError:
// Conflict if another process is drilling in the case.
void clearOfJournal(const fs::path& path, const std::string& name)
{
  const JournalFile other(path);
  if (other.there() && !other.held())
    throw LibraryError(LibraryError::Reason::Conflict,
                       "case '" + name + "' is being drilled by another process; end that first");
  if (other.there())
    setAside(path);
}

} // namespace

Journal::Journal(const Library& library, SavedState saved, Measure measure)
  : m_folder(library.folder())
  , m_base(std::move(saved))
  , m_measure(std::move(measure))
  , m_written(m_base.strokes.size())
  , m_history(m_base.history)
{
  clearOfJournal(journalOf(m_folder, m_base.name, m_base.id), m_base.name);
}

void Journal::claim()
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  if (!m_file)
    makeFile();
}

void Journal::leave()
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  m_file.reset();
}

void Journal::makeFile()
{
  // What is there is of a process that was killed since this object was created.
  clearOfJournal(journalOf(m_folder, m_base.name, m_base.id), m_base.name);
  const fs::path path = newJournalPath(m_folder, m_base.name, m_base.id);
  clearOfJournal(path, m_base.name);
  m_file = std::make_unique<JournalFile>(path, JournalHead(m_base));
}

Journal::~Journal()
{
  if (m_file)
    m_file->remove();
}

std::size_t Journal::bytes() const
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  return m_file ? m_file->size() : 0;
}

void Journal::write(std::vector<Kept> frames)
{
  std::string bytes;
  for (const Kept& kept : frames)
    bytes += kept.frame;
  const bool fresh = !m_file;
  if (fresh)
    makeFile();
  try
  {
    m_file->append(bytes);
  }
  catch (...)
  {
    if (fresh)
    {
      m_file->remove();
      m_file.reset();
    }
    throw;
  }
  for (Kept& kept : frames)
    m_kept.push_back(std::move(kept));
}

// What the open stroke removed since the last part, if a part is due.
std::optional<Journal::Kept> Journal::partOf(const dissection::Dissection& work)
{
  const Clock::time_point now = Clock::now();
  const double duration = work.openInfo().duration;
  if (!m_open)
  {
    m_open = true;
    m_last.reset();
    m_lastWall = now;
    m_lastDuration = 0.0;
  }
  if (std::chrono::duration<double>(now - m_lastWall).count() < kInterval &&
      duration - m_lastDuration < kInterval)
    return std::nullopt;
  m_lastWall = now;
  m_lastDuration = duration;
  const volume::CutMask& last = m_last ? *m_last : work.maskBeforeStroke();
  std::vector<dissection::BrickDelta> deltas;
  for (const std::size_t brick : work.openBricks())
    if (last.brick(brick) != work.mask().brick(brick))
      deltas.push_back({brick, last.brick(brick), work.mask().brick(brick)});
  if (deltas.empty())
    return std::nullopt;
  return Kept{work.strokes().size(), encoded(frameOf(JournalFrame::Kind::Part,
                                                     {m_measure ? m_measure(work) : work.openInfo(),
                                                      dissection::encodeDeltas(deltas)}))};
}

void Journal::follow(const dissection::Dissection& work)
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  if (m_written != work.strokes().size() || !sameHistory(m_history, work.history()))
  {
    std::vector<Kept> frames;
    for (std::size_t n = m_written; n < work.strokes().size(); ++n)
      frames.push_back({n, encoded(frameOf(JournalFrame::Kind::Stroke, *work.strokes()[n]))});
    frames.push_back(
        {work.strokes().size(),
         encoded(JournalFrame{JournalFrame::Kind::History, scene::toText(work.history()), {}})});
    write(std::move(frames));
    m_written = work.strokes().size();
    m_history = work.history();
    m_open = false;
  }
  if (!work.strokeOpen())
  {
    m_open = false;
    m_last.reset();
    return;
  }
  if (auto part = partOf(work))
  {
    write({std::move(*part)});
    m_last = work.mask();
  }
}

void Journal::saved(SavedState now)
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  const std::size_t strokes = now.strokes.size();
  // A history frame is complete: frames leading up to the saved one are obsolete.
  const std::string history =
      encoded(JournalFrame{JournalFrame::Kind::History, scene::toText(now.history), {}});
  std::vector<Kept> left;
  for (const Kept& kept : m_kept)
  {
    if (kept.frame == history)
      left.clear();
    else if (kept.strokes >= strokes)
      left.push_back(kept);
  }
  if (left.empty() && m_file)
  {
    m_file->remove();
    m_file.reset();
  }
  else if (m_file)
  {
    std::string bytes;
    for (const Kept& kept : left)
      bytes += kept.frame;
    const fs::path path = newJournalPath(m_folder, now.name, now.id);
    const fs::path next = path.string() + ".new";
    std::error_code ignored;
    fs::remove(next, ignored); // of a process that was killed here
    auto file = std::make_unique<JournalFile>(next, JournalHead(now));
    try
    {
      file->append(bytes);
      file->moveTo(path);
    }
    catch (...)
    {
      file->remove();
      throw;
    }
    m_file->remove(); // unless it was replaced
    m_file = std::move(file);
  }
  m_kept = std::move(left);
  m_base = std::move(now);
}

} // namespace petrous::library
