#include "MessageRoom.h"

#include <QEvent>
#include <QStatusBar>

namespace petrous::workstation
{

namespace
{

constexpr int kMargins = 40; // pixels: about the message, and the corner that resizes the window
constexpr int kBetween = 8;  // pixels: of the bar's layout

} // namespace

MessageRoom::MessageRoom(QStatusBar& bar, const std::vector<QWidget*>& yielding)
  : QObject(&bar)
  , m_bar(bar)
{
  for (QWidget* widget : yielding)
    m_yielding.push_back({widget, widget->minimumWidth(), widget->maximumWidth()});
  connect(&bar, &QStatusBar::messageChanged, this, &MessageRoom::say);
  bar.installEventFilter(this);
}

bool MessageRoom::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() == QEvent::Resize)
    arrange();
  if (event->type() == QEvent::LayoutRequest)
    m_bar.update(); // the message reaches as far as the widgets leave it
  return QObject::eventFilter(watched, event);
}

void MessageRoom::say(const QString& message)
{
  m_bar.setToolTip(message);
  m_bar.setAccessibleDescription(message);
  arrange();
}

void MessageRoom::arrange()
{
  int needed = kMargins + m_bar.fontMetrics().horizontalAdvance(m_bar.currentMessage());
  for (const QWidget* widget : m_bar.findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly))
    if (!widget->isHidden())
      needed += widget->sizeHint().width() + kBetween;
  for (Yielding& one : m_yielding)
  {
    const bool isGone = !m_bar.currentMessage().isEmpty() && needed > m_bar.width();
    if (isGone && !one.widget->isHidden())
      needed -= one.widget->sizeHint().width() + kBetween;
    if (isGone == one.isGone)
      continue;
    one.isGone = isGone;
    one.widget->setMinimumWidth(isGone ? 0 : one.least);
    one.widget->setMaximumWidth(isGone ? 0 : one.most);
  }
}

} // namespace petrous::workstation
