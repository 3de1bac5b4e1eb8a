#include "BurrWarnings.h"

#include <QStringList>

#include "Theme.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

namespace
{
constexpr int kAgain = 60; // ms; faster than anyone can read
}

BurrWarnings::BurrWarnings(presenters::WorkstationModel& model, QObject* parent)
  : QObject(parent)
  , m_model(model)
{
}

void BurrWarnings::burrMoved(const Eigen::Vector3d& center, double radius)
{
  if (m_sinceAsked.isValid() && m_sinceAsked.elapsed() < kAgain)
    return;
  m_sinceAsked.start();
  try
  {
    const auto warnings = m_model.warnings(center, radius);
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

void BurrWarnings::burrGone()
{
  m_sinceAsked.invalidate();
  warn({});
}

void BurrWarnings::warn(const QString& lines, bool near)
{
  if (near != m_alarmed)
    emit alarmed(m_alarmed = near);
  if (lines != m_warned)
    emit warned(m_warned = lines);
}

} // namespace petrous::workstation
