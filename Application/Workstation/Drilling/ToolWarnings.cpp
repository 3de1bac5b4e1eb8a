#include "ToolWarnings.h"

#include <QStringList>

#include "Theme.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

namespace
{
constexpr int kAgain = 60; // ms; faster than anyone can read
}

ToolWarnings::ToolWarnings(presenters::WorkstationModel& model, QObject* parent)
  : QObject(parent)
  , m_model(model)
{
}

void ToolWarnings::toolMoved(const presenters::MeasuredTool& tool, const haptics::Pose& pose)
{
  if (m_sinceAsked.isValid() && m_sinceAsked.elapsed() < kAgain)
    return;
  m_sinceAsked.start();
  try
  {
    const auto warnings = m_model.warnings(tool, pose);
    // The user must know that there can be no warnings yet, or not of all.
    if (warnings)
    {
      QStringList lines{phrase(*warnings), phrase(m_model.unmeasuredNearby())};
      lines.removeAll({});
      warn(lines.join('\n'), !warnings->empty());
    }
    else
      warn(tr("no warnings yet: structures are being measured"));
  }
  catch (const std::exception&) // out of memory, a missing file; the panel shows which
  {
    warn(tr("no warnings: the structures cannot be measured"));
  }
}

void ToolWarnings::toolGone()
{
  m_sinceAsked.invalidate();
  warn({});
}

void ToolWarnings::warn(const QString& lines, bool near)
{
  if (near != m_alarmed)
    emit alarmed(m_alarmed = near);
  if (lines != m_warned)
    emit warned(m_warned = lines);
}

} // namespace petrous::workstation
