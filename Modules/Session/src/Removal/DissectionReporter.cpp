#include "petrous/Session/DissectionReporter.h"

#include <exception>
#include <utility>

namespace petrous::session
{

DissectionReporter::DissectionReporter(const dissection::Dissection& work,
                                       UpdateQueue& mailbox)
  : m_work(work)
  , m_mailbox(mailbox)
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
      m_mail.bricks[brick] = m_work.mask().brick(brick);
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
  using Kind = DissectionEvent::Kind;
  switch (edit.kind)
  {
  case MaskEdit::Kind::Begin:
    m_mail.events.push_back({Kind::StrokeBegun, nullptr});
    break;
  case MaskEdit::Kind::Cut:
    break;
  case MaskEdit::Kind::End:
    m_mail.events.push_back({Kind::StrokeClosed, std::exchange(m_closed, nullptr)});
    break;
  case MaskEdit::Kind::Undo:
    m_mail.events.push_back({Kind::Undone, nullptr});
    break;
  case MaskEdit::Kind::Redo:
    m_mail.events.push_back({Kind::Redone, nullptr});
    break;
  }
}

void DissectionReporter::note(const TickRecord& record)
{
  if (record.fault != 0)
    m_mail.fault = record;
}

void DissectionReporter::note(const std::string& recordingFault)
{
  m_mail.recordingFault = recordingFault;
}

void DissectionReporter::post()
{
  if (!m_mail.events.empty())
    m_mail.history = m_work;
  m_mailbox.post(m_mail);
}

std::string DissectionReporter::takeComplaint()
{
  return std::exchange(m_complaint, {});
}

} // namespace petrous::session
