#include "PanelLayout.h"

#include <algorithm>

#include <QEvent>
#include <QGuiApplication>
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>
#include <QVBoxLayout>

namespace petrous::workstation
{

namespace
{

constexpr int kNarrowest = 340; // px

class Area : public QScrollArea
{
public:
  // A scroll area by itself may become narrower than what it shows, which is then cut off.
  QSize minimumSizeHint() const override
  {
    QSize size = QScrollArea::minimumSizeHint();
    const int inside = widget() ? widget()->minimumSizeHint().width() : 0;
    size.setWidth(std::max(kNarrowest, inside + verticalScrollBar()->sizeHint().width()));
    return size;
  }

  // Another page inside may need another width.
  bool eventFilter(QObject* watched, QEvent* event) override
  {
    if (watched == widget() && event->type() == QEvent::LayoutRequest)
      updateGeometry();
    return QScrollArea::eventFilter(watched, event);
  }
};

} // namespace

void layOutPanel(QWidget& panel, QWidget* inside, QWidget* foot)
{
  auto* area = new Area;
  area->setWidgetResizable(true);
  area->setFrameShape(QFrame::NoFrame);
  area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  area->setWidget(inside);
  auto* outer = new QVBoxLayout(&panel);
  outer->setContentsMargins(0, 0, 0, 0);
  outer->setSpacing(0);
  outer->addWidget(area, 1);
  outer->addWidget(foot);
}

void resizeOnScreen(QWidget& window, const QSize& wanted)
{
  constexpr int kTitleBar = 40; // px, that the window manager adds
  const QWidget* parent = window.parentWidget();
  const QScreen* screen = parent ? parent->screen() : QGuiApplication::primaryScreen();
  const QSize room = screen ? screen->availableSize() - QSize(0, kTitleBar) : wanted;
  window.resize(wanted.boundedTo(room));
}

} // namespace petrous::workstation
