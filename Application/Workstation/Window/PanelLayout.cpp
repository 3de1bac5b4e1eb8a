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

// That a scroll bar takes: a style may make it wider, and leaves pixels beside it and at the frame.
int widthOf(QScrollBar& bar)
{
  constexpr int kBeside = 20; // px
  bar.ensurePolished();
  return bar.sizeHint().width() + kBeside;
}

class Area : public QScrollArea
{
public:
  // A scroll area by itself may become narrower than what it shows, which is then cut off.
  QSize minimumSizeHint() const override
  {
    QSize size = QScrollArea::minimumSizeHint();
    const int inside = widget() ? widget()->minimumSizeHint().width() : 0;
    size.setWidth(std::max(kNarrowest, inside + widthOf(*verticalScrollBar())));
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

QSize roomFor(const QWidget& widget)
{
  const QScreen* screen = widget.screen() ? widget.screen() : QGuiApplication::primaryScreen();
  return screen ? screen->availableSize() : QSize(1920, 1080);
}

// As large as the panel needs, unless the screen is too small for that: then it scrolls.
class WholePanel : public QScrollArea
{
public:
  explicit WholePanel(QWidget* panel)
  {
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
    setFocusPolicy(Qt::NoFocus);
    setWidget(panel);
  }

  QSize minimumSizeHint() const override
  {
    const QSize room = roomFor(*this);
    return least().boundedTo({room.width() / 2, room.height() / 3});
  }

  QSize sizeHint() const override { return widget()->sizeHint().expandedTo(least()); }

  bool eventFilter(QObject* watched, QEvent* event) override
  {
    if (watched == widget() && event->type() == QEvent::LayoutRequest)
      updateGeometry();
    return QScrollArea::eventFilter(watched, event);
  }

private:
  QSize least() const
  {
    const QSize size = widget()->minimumSizeHint().expandedTo(widget()->minimumSize());
    return size + QSize(widthOf(*verticalScrollBar()), 0);
  }
};

} // namespace

QWidget* scrolledPanel(QWidget* panel)
{
  constexpr int kLow = 700; // px
  return roomFor(*panel).height() < kLow ? new WholePanel(panel) : panel;
}

QSize leastOfScreen(const QWidget& widget, const QSize& wanted)
{
  const QSize room = roomFor(widget);
  return wanted.boundedTo({2 * room.width() / 5, 2 * room.height() / 5});
}

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
