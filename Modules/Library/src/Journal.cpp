#include "petrous/Library/Journal.h"

#include <utility>

#include "JournalFile.h"
#include "petrous/Dissection/StrokeCodec.h"
#include "petrous/Scene/HistoryText.h"

namespace petrous::library
{

namespace fs = std::filesystem;

namespace
{

std::string frameOf(JournalFrame::Kind kind, const dissection::StrokeInfo& info,
                    const std::vector<std::uint8_t>& packed)
{
  return encoded(
      JournalFrame{kind, scene::toText(scene::StrokePart{{}, packed.size(), info, {}}), packed});
}

} // namespace

Journal::Journal(const Library& library, const scene::Case& value, Measure measure)
  : m_folder(library.folder())
  , m_name(value.name)
  , m_revision(value.revision)
  , m_base(value.strokes.size())
  , m_measure(std::move(measure))
  , m_written(value.strokes.size())
  , m_changes(value.dissection->changes())
{
  const fs::path path = journalPath(m_folder, m_name);
  const JournalFile other(path);
  if (other.there() && !other.held())
    throw LibraryError(LibraryError::Reason::Conflict,
                       "case '" + m_name + "' is being drilled by another program; end that first");
  if (other.there())
    setAside(path); // Library::open could not bring it back, and said so
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
    m_file = std::make_unique<JournalFile>(journalPath(m_folder, m_name),
                                           JournalHead{m_name, m_revision, m_base});
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

// What the open stroke took since the last part, if that is due.
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
  return Kept{work.strokes().size(),
              frameOf(JournalFrame::Kind::Part, m_measure ? m_measure(work) : work.openInfo(),
                      dissection::encodeDeltas(deltas))};
}

void Journal::follow(const dissection::Dissection& work)
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  if (m_changes != work.changes())
  {
    std::vector<Kept> frames;
    for (std::size_t n = m_written; n < work.strokes().size(); ++n)
      frames.push_back({n, frameOf(JournalFrame::Kind::Stroke, work.strokes()[n]->info,
                                   work.strokes()[n]->packed)});
    frames.push_back(
        {work.strokes().size(),
         encoded(JournalFrame{JournalFrame::Kind::History, scene::toText(work.history()), {}})});
    write(std::move(frames));
    m_written = work.strokes().size();
    m_changes = work.changes();
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

void Journal::saved(const scene::Case& value)
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  const std::size_t strokes = value.strokes.size();
  // A frame of the history holds all of it: what leads up to the saved one is of no more use.
  const std::string history =
      encoded(JournalFrame{JournalFrame::Kind::History, scene::toText(value.history), {}});
  std::vector<Kept> left;
  for (const Kept& kept : m_kept)
  {
    if (kept.frame == history)
      left.clear();
    else if (kept.strokes >= strokes)
      left.push_back(kept);
  }
  const JournalHead head{value.name, value.revision, strokes};
  const fs::path path = journalPath(m_folder, value.name);
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
    const fs::path next = path.string() + ".new";
    std::error_code ignored;
    fs::remove(next, ignored); // of one that was killed here
    auto file = std::make_unique<JournalFile>(next, head);
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
    if (value.name != m_name)
      m_file->remove();
    m_file = std::move(file);
  }
  m_kept = std::move(left);
  m_name = value.name;
  m_revision = value.revision;
  m_base = strokes;
}

} // namespace petrous::library
