#include "petrous/Session/DissectionLoop.h"

#include <algorithm>
#include <utility>

#include "petrous/Core/Error.h"
#include "petrous/Session/TouchScene.h"

namespace petrous::session
{

namespace
{

// After a stall a tick must not remove for the time without drilling.
constexpr double kMaxTick = 0.01; // s

bool together(const TickRecord& record, const TickRecord& next)
{
  return next.drill && next.thrust > 0.0 &&
         (next.proxy.pose().position - record.proxy.pose().position).norm() <=
             DissectionLoop::kTogether;
}

} // namespace

DissectionLoop::DissectionLoop(dissection::Dissection& dissection, volume::PublishedMask& mask,
                               RemovalModel& removalModel, dissection::ProtectedTissue keep,
                               Hooks hooks)
  : m_dissection(dissection)
  , m_mask(mask)
  , m_removalModel(removalModel)
  , m_keep(std::move(keep))
  , m_hooks(std::move(hooks))
{
}

double DissectionLoop::secondsOf(const TickRecord& record)
{
  const double past = m_hasTime ? record.time() - m_time : 0.0;
  m_time = record.time();
  m_hasTime = true;
  return past > 0.0 ? std::min(past, kMaxTick) : 0.0; // 0 for NaN
}

// Opens and closes strokes as the drill is switched; returns whether it cuts. An interruption does
// not divide what is drilled with the drill held down.
bool DissectionLoop::follow(const TickRecord& record)
{
  const bool interrupted = m_on && isInterruption(record);
  m_on = record.drill != 0 || interrupted;
  m_untilOff = m_untilOff && m_on;
  const bool drill = record.drill != 0 && !m_untilOff && record.time() > m_ignoreUntil;
  if (drill)
    open();
  else
  {
    m_removalModel.release();
    if (!interrupted)
      endStroke();
  }
  return drill;
}

void DissectionLoop::open()
{
  if (m_dissection.strokeOpen())
    return;
  m_spindle = {};
  m_dissection.beginStroke(m_hooks.begin ? m_hooks.begin() : dissection::StrokeInfo());
  notify({MaskEdit::Kind::Begin});
}

void DissectionLoop::drilled(const TickRecord& record, double seconds)
{
  dissection::StrokeInfo& info = m_dissection.openInfo();
  info.duration += seconds;
  m_spindle.add(record.input, seconds);
  info.speed = m_spindle.speed(info.burr.rpm);
}

// The state number is known after publishing.
void DissectionLoop::notify(MaskEdit edit) const
{
  edit.state = m_mask.number();
  if (m_hooks.edited)
    m_hooks.edited(edit);
}

bool DissectionLoop::cut(const dissection::SweptSphere& burr)
{
  try
  {
    if (!m_dissection.cut(burr, m_keep))
      return false;
  }
  catch (...)
  {
    putBack();
    throw;
  }
  ++m_cuts;
  publish(false);
  MaskEdit edit{MaskEdit::Kind::Cut};
  for (int axis = 0; axis < 3; ++axis)
  {
    edit.from[axis] = burr.from[axis];
    edit.to[axis] = burr.to[axis];
  }
  edit.radius = burr.radius;
  notify(edit);
  return true;
}

// Restores what an incomplete cut has changed, which no stroke would list.
void DissectionLoop::putBack()
{
  volume::CutMask& mask = m_dissection.mask();
  for (const std::size_t brick : mask.takeDirty())
    mask.setBrick(brick, m_mask.brick(brick));
  mask.takeDirty();
}

void DissectionLoop::publish(bool raised)
{
  const std::vector<std::size_t> bricks = m_dissection.mask().takeDirty();
  m_mask.publish(m_dissection.mask(), bricks, raised);
  if (m_hooks.changed && !bricks.empty())
    m_hooks.changed(bricks);
}

bool DissectionLoop::step(const TickRecord& record)
{
  return step(&record, 1);
}

bool DissectionLoop::step(const TickRecord* records, std::size_t count)
{
  bool any = false;
  for (std::size_t n = 0; n < count; ++n)
  {
    const TickRecord& record = records[n];
    const double seconds = secondsOf(record);
    if (!follow(record))
      continue;
    drilled(record, seconds);
    if (!(record.thrust > 0.0))
    {
      m_removalModel.release();
      continue;
    }
    m_removalModel.press(record, seconds);
    // If the tool hardly moves, this tick's removal is combined with the next.
    if (n + 1 < count && together(record, records[n + 1]))
      continue;
    while (const auto swept = m_removalModel.nextCut(m_dissection.mask()))
      if (cut(*swept))
        any = true;
      else
        break;
  }
  return any;
}

bool DissectionLoop::sweep(const TickRecord& record, const dissection::SweptSphere& burr)
{
  const double seconds = secondsOf(record);
  if (!(record.time() > m_ignoreUntil))
    return false;
  open();
  m_removalModel.release();
  drilled(record, seconds);
  return cut(burr);
}

void DissectionLoop::endStroke()
{
  if (!m_dissection.strokeOpen())
    return;
  MaskEdit edit{MaskEdit::Kind::End};
  edit.duration = m_dissection.openInfo().duration;
  if (m_hooks.close)
    m_hooks.close(m_dissection);
  else
    m_dissection.endStroke();
  notify(edit);
}

bool DissectionLoop::turn(bool back)
{
  m_removalModel.release();
  endStroke();
  m_untilOff = m_on;
  try
  {
    if ((back ? m_dissection.undo() : m_dissection.redo()) == 0)
      return false;
  }
  catch (const core::Error&) // a damaged stroke; nothing has changed
  {
    return false;
  }
  publish(true);
  MaskEdit edit{back ? MaskEdit::Kind::Undo : MaskEdit::Kind::Redo};
  if (!back && m_hooks.edited)
    edit.setRedone(fingerprintOf(m_dissection.mask()));
  notify(edit);
  return true;
}

bool DissectionLoop::undo()
{
  return turn(true);
}

bool DissectionLoop::redo()
{
  return turn(false);
}

bool DissectionLoop::apply(const MaskEdit& edit)
{
  switch (edit.kind)
  {
  case MaskEdit::Kind::Begin:
    open();
    break;
  case MaskEdit::Kind::Cut:
    if (!m_dissection.strokeOpen() || !cut(edit.burr()))
      return false;
    break;
  case MaskEdit::Kind::End:
    if (m_dissection.strokeOpen())
      m_dissection.openInfo().duration = edit.duration;
    endStroke();
    break;
  case MaskEdit::Kind::Undo:
  case MaskEdit::Kind::Redo:
    if (!turn(edit.kind == MaskEdit::Kind::Undo))
      return false;
    if (edit.redone() != 0 && edit.kind == MaskEdit::Kind::Redo &&
        fingerprintOf(m_dissection.mask()) != edit.redone())
      return false;
    break;
  }
  return m_mask.number() == edit.state;
}

} // namespace petrous::session
