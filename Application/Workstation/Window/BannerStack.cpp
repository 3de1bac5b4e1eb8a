#include "BannerStack.h"

#include <QEvent>
#include <QVBoxLayout>

#include "Banner.h"

namespace petrous::workstation
{

BannerStack::BannerStack(QWidget& over)
  : QWidget(&over)
  , m_layout(new QVBoxLayout(this))
  , m_room(new QWidget(&over))
{
  m_layout->setContentsMargins(0, 0, 0, 0);
  m_layout->setSpacing(0);
  m_layout->setSizeConstraint(QLayout::SetNoConstraint);
  m_room->setFixedHeight(0);
  over.installEventFilter(this);
}

void BannerStack::add(Banner* banner)
{
  m_layout->addWidget(banner);
}

void BannerStack::setHeld(bool held)
{
  m_held = held;
  place();
}

bool BannerStack::event(QEvent* event)
{
  const bool done = QWidget::event(event);
  if (event->type() == QEvent::LayoutRequest)
    place();
  return done;
}

bool BannerStack::eventFilter(QObject* watched, QEvent* event)
{
  if (watched == parent() && event->type() == QEvent::Resize)
    place();
  return QWidget::eventFilter(watched, event);
}

void BannerStack::place()
{
  const int across = parentWidget()->width();
  const int down = m_layout->hasHeightForWidth() ? m_layout->totalHeightForWidth(across)
                                                 : m_layout->sizeHint().height();
  setGeometry(0, 0, across, down);
  raise();
  if (!m_held)
    m_room->setFixedHeight(down);
  emit covers(down - m_room->height());
}

} // namespace petrous::workstation
