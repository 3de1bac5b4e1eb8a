#include "ToolWarnings.h"

#include <QStringList>

#include "Theme.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

ToolWarnings::ToolWarnings(QObject* parent)
  : QObject(parent)
{
}

void ToolWarnings::show(const presenters::ToolSurroundings& near)
{
  if (!near.fault.empty()) // the panel shows which
    return warn(tr("no warnings: the structures cannot be measured"));
  // The user must know that there can be no warnings yet, or not of all.
  if (!near.isMeasured)
    return warn(tr("no warnings yet: structures are being measured"));
  const std::string warnings = presenters::warningsOf(near.structures);
  QStringList lines{phrase(warnings), phrase(near.unmeasured)};
  lines.removeAll({});
  warn(lines.join('\n'), !warnings.empty());
}

void ToolWarnings::toolGone()
{
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
