#include "petrous/Session/DissectionUpdate.h"

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

void UpdateQueue::post(DissectionUpdate& mail)
{
  if (mail.empty())
    return;
  const std::lock_guard<std::mutex> lock(m_mutex);
  m_mail.append(mail);
}

DissectionUpdate UpdateQueue::take()
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  return std::exchange(m_mail, {});
}

std::vector<std::size_t> follow(DissectionUpdate& mail, dissection::Dissection& copy)
{
  if (mail.history)
  {
    // Likewise where the mask changed but no update could be written.
    const volume::CutMask& now = mail.history->mask();
    for (std::size_t brick = 0; brick < now.brickCount(); ++brick)
      if (now.brick(brick) != copy.mask().brick(brick))
        mail.bricks.emplace(brick, now.brick(brick));
    copy = *std::exchange(mail.history, std::nullopt);
  }
  std::vector<std::size_t> bricks;
  bricks.reserve(mail.bricks.size());
  for (auto& [brick, version] : mail.bricks)
  {
    bricks.push_back(brick);
    if (copy.mask().brick(brick) != version)
      copy.mask().setBrick(brick, std::move(version));
  }
  mail.bricks.clear();
  copy.mask().takeDirty();
  return bricks;
}

} // namespace petrous::session
