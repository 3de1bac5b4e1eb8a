#include "petrous/Session/DissectionUpdate.h"

#include <exception>
#include <iterator>
#include <utility>

namespace petrous::session
{

namespace
{

using Kind = DissectionEvent::Kind;

bool tookNothing(const DissectionEvent& event)
{
  return event.kind == Kind::StrokeClosed && !event.stroke;
}

// A drill switched on and off in the air would add events without limit.
void forgetRepeated(std::vector<DissectionEvent>& events)
{
  const std::size_t n = events.size();
  if (n >= 3 && tookNothing(events[n - 1]) && events[n - 2].kind == Kind::StrokeBegun &&
      tookNothing(events[n - 3]))
    events.resize(n - 2);
}

} // namespace

bool DissectionUpdate::empty() const noexcept
{
  return bricks.empty() && events.empty() && !history && !fault && recordingFault.empty();
}

void DissectionUpdate::append(DissectionUpdate& next)
{
  events.reserve(events.size() + next.events.size());
  for (DissectionEvent& event : next.events)
  {
    events.push_back(std::move(event));
    forgetRepeated(events);
  }
  next.events.clear();
  next.bricks.merge(bricks); // only missing ones: its own are newer
  bricks.swap(next.bricks);
  next.bricks.clear();
  if (next.history) // includes what could not be noted for lack of memory
    for (auto& [brick, version] : bricks)
      version = next.history->mask().brick(brick);
  if (next.history)
    history = std::exchange(next.history, std::nullopt);
  if (next.fault)
    fault = std::exchange(next.fault, std::nullopt);
  if (recordingFault.empty())
    recordingFault.swap(next.recordingFault);
  next.recordingFault.clear();
}

void UpdateQueue::post(DissectionUpdate& update)
{
  if (update.empty())
    return;
  const std::lock_guard<std::mutex> lock(m_mutex);
  m_update.append(update);
}

DissectionUpdate UpdateQueue::take()
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  return std::exchange(m_update, {});
}

DissectionReporter::DissectionReporter(const dissection::Dissection& work, UpdateQueue& queue)
  : m_work(work)
  , m_queue(queue)
{
}

DissectionLoop::Hooks DissectionReporter::listen(DissectionLoop::Begin begin,
                                                 DissectionLoop::Edited edited, Complete complete)
{
  DissectionLoop::Hooks hooks;
  hooks.begin = std::move(begin);
  hooks.close = [this, complete = std::move(complete)](dissection::Dissection& work)
  { close(work, complete); };
  hooks.changed = [this](const std::vector<std::size_t>& bricks)
  {
    for (const std::size_t brick : bricks)
      m_update.bricks[brick] = m_work.mask().brick(brick);
  };
  hooks.edited = [this, edited = std::move(edited)](const MaskEdit& edit)
  {
    if (edited)
      edited(edit);
    note(edit);
  };
  return hooks;
}

void DissectionReporter::close(dissection::Dissection& work, const Complete& complete)
{
  try
  {
    if (complete)
      complete(work);
  }
  catch (const std::exception& error)
  {
    m_complaint = error.what();
  }
  m_closed = work.endStroke();
}

void DissectionReporter::note(const MaskEdit& edit)
{
  switch (edit.kind)
  {
  case MaskEdit::Kind::Begin:
    m_update.events.push_back({Kind::StrokeBegun, nullptr});
    break;
  case MaskEdit::Kind::Cut:
    break;
  case MaskEdit::Kind::End:
    m_update.events.push_back({Kind::StrokeClosed, std::exchange(m_closed, nullptr)});
    break;
  case MaskEdit::Kind::Undo:
    m_update.events.push_back({Kind::Undone, nullptr});
    break;
  case MaskEdit::Kind::Redo:
    m_update.events.push_back({Kind::Redone, nullptr});
    break;
  }
}

void DissectionReporter::note(const TickRecord& record)
{
  if (record.fault != 0)
    m_update.fault = record;
}

void DissectionReporter::note(const std::string& recordingFault)
{
  m_update.recordingFault = recordingFault;
}

void DissectionReporter::post()
{
  if (!m_update.events.empty())
    m_update.history = m_work;
  m_queue.post(m_update);
}

std::string DissectionReporter::takeComplaint()
{
  return std::exchange(m_complaint, {});
}

std::vector<std::size_t> follow(DissectionUpdate& update, dissection::Dissection& copy)
{
  if (update.history)
  {
    // Likewise where the mask changed but no update could be written.
    const volume::CutMask& now = update.history->mask();
    for (std::size_t brick = 0; brick < now.brickCount(); ++brick)
      if (now.brick(brick) != copy.mask().brick(brick))
        update.bricks.emplace(brick, now.brick(brick));
    copy.catchUp(*std::exchange(update.history, std::nullopt));
  }
  std::vector<std::size_t> bricks;
  bricks.reserve(update.bricks.size());
  for (auto& [brick, version] : update.bricks)
  {
    bricks.push_back(brick);
    if (copy.mask().brick(brick) != version)
      copy.mask().setBrick(brick, std::move(version));
  }
  update.bricks.clear();
  copy.mask().takeDirty();
  return bricks;
}

} // namespace petrous::session
