#include "Recovery.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "Graft.h"
#include "JournalFile.h"
#include "petrous/Library/Library.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Scene/HistoryText.h"

namespace petrous::library
{

namespace fs = std::filesystem;

namespace
{

using Kind = JournalFrame::Kind;

std::string nameIn(const JournalFrame& stroke)
{
  return sha256Of(stroke.bytes.data(), stroke.bytes.size()) + ".stroke";
}

struct Standing
{
  bool fits = false;
  std::size_t saved = 0; ///< strokes of the journal that are already in the manifest
};

// A journal continues the manifest of its revision, or the next revision if that contains strokes
// of the journal: the program terminated after saving them.
Standing standingOf(const JournalContent& content, const scene::Case& value)
{
  Standing standing;
  const JournalHead& head = content.head;
  const auto& strokes = value.dissection.strokes();
  if (!head.isOf(value) || head.strokes > strokes.size() ||
      (!head.ct.empty() && head.ct != value.ct.object))
    return standing;
  const std::size_t since = strokes.size() - head.strokes;
  if (head.revision == value.revision)
    standing.fits = since == 0;
  else if (head.revision + 1 == value.revision && since > 0)
  {
    for (const JournalFrame& frame : content.frames)
      if (frame.kind == Kind::Stroke && standing.saved < since &&
          nameIn(frame) == strokes[head.strokes + standing.saved]->object)
        ++standing.saved;
    standing.fits = standing.saved == since;
  }
  return standing;
}

struct Recovered
{
  std::size_t strokes = 0; ///< finished ones
  double part = -1.0;      ///< duration of an open stroke, s; < 0: none
};

std::shared_ptr<dissection::Stroke> strokeOf(const JournalFrame& frame)
{
  return std::make_shared<dissection::Stroke>(scene::strokeFromText(frame.text).info, frame.bytes);
}

// Throws InvalidParameter if a frame does not fit its predecessors.
Recovered play(const JournalContent& content, std::size_t saved, dissection::Dissection& work)
{
  Recovered result;
  std::vector<const JournalFrame*> parts;
  for (const JournalFrame& frame : content.frames)
  {
    const bool known = saved > 0;
    switch (frame.kind)
    {
    case Kind::Stroke:
      parts.clear();
      if (known)
        --saved;
      else
      {
        work.append(strokeOf(frame));
        ++result.strokes;
      }
      break;
    case Kind::History:
      if (!known)
        work.follow(scene::historyFromText(frame.text));
      break;
    case Kind::Part:
      if (!known)
        parts.push_back(&frame);
      break;
    case Kind::Head:
      break;
    }
  }
  if (parts.empty())
    return result;
  dissection::StrokeInfo info = scene::strokeFromText(parts.back()->text).info;
  info.recovered = true;
  result.part = info.duration;
  work.beginStroke(info);
  for (const JournalFrame* part : parts)
    work.cutAgain(part->bytes);
  work.endStroke();
  return result;
}

std::string toString(const Recovered& what, std::size_t leftOver)
{
  std::string text;
  if (what.strokes > 0)
    text = std::to_string(what.strokes) + (what.strokes == 1 ? " stroke" : " strokes");
  if (what.part >= 0.0)
    text += (text.empty() ? "" : " and ") + std::string("the first ") +
            std::to_string(std::lround(what.part)) + " s of a stroke that was being drilled";
  if (text.empty())
    text = "the place in the history";
  return text + (leftOver > 0 ? " (the end of its journal was not whole)" : "");
}

// The base state of the journal, if the case has been continued from it too: another program has
// saved it meanwhile.
std::optional<SavedState> commonState(const JournalContent& content, const scene::Case& value)
{
  const JournalHead& head = content.head;
  const auto& strokes = value.dissection.strokes();
  if (head.history.empty() || !head.isOf(value) || head.strokes > strokes.size())
    return std::nullopt;
  SavedState base;
  base.name = value.name;
  base.ct = head.ct;
  for (std::size_t n = 0; n < head.strokes; ++n)
    base.strokes.push_back(strokes[n]->object);
  if (head.ct != value.ct.object || hashOfNames(base.strokes) != head.strokesHash)
    return std::nullopt;
  try
  {
    base.history = scene::historyFromText(head.history);
  }
  catch (const core::InvalidParameter&)
  {
    return std::nullopt;
  }
  if (base.history.size() != head.strokes)
    return std::nullopt;
  return base;
}

// Whether the case has all strokes of the journal: saved before the program was killed.
bool isSpent(const JournalContent& content, const scene::Case& value)
{
  const auto& strokes = value.dissection.strokes();
  std::size_t at = content.head.strokes;
  bool any = false;
  bool open = false;
  for (const JournalFrame& frame : content.frames)
  {
    open = frame.kind == Kind::Part || (open && frame.kind != Kind::Stroke);
    if (frame.kind != Kind::Stroke)
      continue;
    any = true;
    while (at < strokes.size() && strokes[at]->object != nameIn(frame))
      ++at;
    if (at == strokes.size())
      return false;
    ++at;
  }
  return any && !open;
}

// The dissection at an earlier state.
dissection::Dissection atState(const scene::Case& value, const SavedState& base)
{
  const auto first = value.dissection.strokes().begin();
  return {value.ct.geometry,
          {first, first + static_cast<std::ptrdiff_t>(base.strokes.size())},
          base.history};
}

std::string recoverFrom(JournalFile& file, const fs::path& path, Library& library,
                        scene::Case& value)
{
  const std::string bytes = file.read();
  const JournalContent content = journalFrom(bytes);
  const std::string about = "case '" + value.name + "': ";
  const auto aside = [&](const std::string& why)
  { return about + why + "; it was set aside as " + setAside(path).string(); };
  if (content.newerFormat > 0)
    throw LibraryError(LibraryError::Reason::Damaged,
                       "written by format " + std::to_string(content.newerFormat) +
                           "; this program reads up to " + std::to_string(kJournalFormat));
  if (!content.headed && content.started)
    return aside("the journal of a session that ended without saving cannot be read");
  if (!content.headed)
  {
    file.remove(); // terminated before anything was written
    return {};
  }
  const Standing standing = standingOf(content, value);
  const auto holdsVoxels = [](const JournalFrame& frame)
  { return frame.kind == Kind::Stroke || frame.kind == Kind::Part; };
  if (!standing.fits && std::none_of(content.frames.begin(), content.frames.end(), holdsVoxels))
  {
    file.remove(); // nothing was drilled
    return {};
  }
  if (!standing.fits && isSpent(content, value))
  {
    file.remove();
    return {};
  }
  const std::optional<SavedState> base = standing.fits ? std::nullopt : commonState(content, value);
  if (!standing.fits && !base)
    return aside("the journal of a session that ended without saving belongs to another state of "
                 "the case");
  scene::Case next = value;
  Recovered what;
  const std::vector<std::string> damage = library.loadSoundDissection(next);
  const std::string sound = scene::toText(next.dissection.history());
  // The journal continues a state that cannot be made now, unless the case was open without it.
  if (sound != scene::toText(value.dissection.history()) && sound != content.head.history)
    throw LibraryError(LibraryError::Reason::Damaged, damage.front());
  try
  {
    if (base)
    {
      dissection::Dissection work = atState(next, *base);
      what = play(content, 0, work);
      next = graft(next, *base, work);
    }
    else
      what = play(content, standing.saved, next.dissection);
  }
  catch (const core::InvalidParameter& error)
  {
    return aside(std::string("the journal of a session that ended without saving does not fit (") +
                 error.what() + ")");
  }
  const bool moved =
      scene::toText(next.dissection.history()) != scene::toText(value.dissection.history());
  if (what.strokes > 0 || what.part >= 0.0 || moved)
  {
    if (what.part >= 0.0) // so that the journal is recognized as spent once this is saved
      file.append(encoded(frameOf(Kind::Stroke, *next.dissection.strokes().back())));
    library.save(next);
    next.dissection.unload();
    value = std::move(next);
  }
  file.remove();
  if (what.strokes == 0 && what.part < 0.0 && !moved)
    return {};
  return "the last session with case '" + value.name + "' ended without saving; " +
         toString(what, content.leftOver) + " came back" +
         (base ? ", on branch '" + value.dissection.history().branch().name +
                     "', as another program had changed the case"
               : "");
}

} // namespace

std::string recover(Library library, scene::Case& value, const fs::path& path,
                    const std::function<scene::Case()>& read)
{
  try
  {
    JournalFile file(path);
    value = read();
    if (!file.there() || !file.held())
      return {};
    return recoverFrom(file, path, library, value);
  }
  catch (const core::Error& error)
  {
    return "case '" + value.name + "': " + path.string() +
           " holds what a session drilled and did not save, and could not be brought back now: " +
           error.what() + "; it stays there for the next time";
  }
}

} // namespace petrous::library
