#include "PanelLayout.h"

#include <algorithm>
#include <cmath>

#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>
#include <QStyle>
#include <QTextDocument>
#include <QToolButton>
#include <QTreeView>
#include <QVBoxLayout>

#include "Theme.h"

namespace petrous::workstation
{

namespace
{

constexpr int kNarrowest = 340; // px

// What an area takes of the width that it has, with its scroll bar. Some styles leave a gap between
// the bar and a frame that is about the contents only.
int besides(const QAbstractScrollArea& area)
{
  const QScrollBar* bar = area.verticalScrollBar();
  bar->ensurePolished(); // a style may make it wider
  const QStyle* style = area.style();
  const bool hasGap =
      style->styleHint(QStyle::SH_ScrollView_FrameOnlyAroundContents, nullptr, &area);
  const int gap =
      hasGap ? style->pixelMetric(QStyle::PM_ScrollView_ScrollBarSpacing, nullptr, &area) : 0;
  return bar->sizeHint().width() + std::max(gap, 0) + 2 * area.frameWidth();
}

QSize roomFor(const QWidget& widget)
{
  const QScreen* screen = widget.screen();
  return screen ? screen->availableSize() : QSize(1920, 1080);
}

class Area : public QScrollArea
{
public:
  explicit Area(QWidget* inside)
  {
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
    setWidget(inside);
  }

  // Another page inside may need another width.
  bool eventFilter(QObject* watched, QEvent* event) override
  {
    if (watched == widget() && event->type() == QEvent::LayoutRequest)
      updateGeometry();
    return QScrollArea::eventFilter(watched, event);
  }

protected:
  // A scroll area by itself may become narrower than what it shows, which is then cut off.
  QSize least() const
  {
    const QSize size = widget()->minimumSizeHint().expandedTo(widget()->minimumSize());
    return size + QSize(besides(*this), 0);
  }
};

class AboveFoot : public Area
{
public:
  explicit AboveFoot(QWidget* inside)
    : Area(inside)
  {
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  }

  QSize minimumSizeHint() const override
  {
    return {std::max(kNarrowest, least().width()), Area::minimumSizeHint().height()};
  }
};

// As large as the panel needs, unless the screen is too small for that: then it scrolls.
class WholePanel : public Area
{
public:
  explicit WholePanel(QWidget* panel)
    : Area(panel)
  {
    setFocusPolicy(Qt::NoFocus);
  }

  QSize minimumSizeHint() const override
  {
    const QSize room = roomFor(*this);
    return least().boundedTo({room.width() / 2, room.height() / 3});
  }

  QSize sizeHint() const override { return widget()->sizeHint().expandedTo(least()); }
};

// What the text takes at the label's width. QLabel::heightForWidth is no less than the height that
// was reserved before.
int heightOfLines(const QLabel& label)
{
  if (label.text().isEmpty())
    return 0;
  const QMargins beside = label.contentsMargins();
  const int around = 2 * label.margin();
  const int width = std::max(1, label.width() - beside.left() - beside.right() - around);
  const bool isRich = label.textFormat() == Qt::RichText ||
                      (label.textFormat() == Qt::AutoText && Qt::mightBeRichText(label.text()));
  int lines = 0;
  if (isRich)
  {
    QTextDocument text;
    text.setDefaultFont(label.font());
    text.setDocumentMargin(0.0);
    text.setHtml(label.text());
    text.setTextWidth(width);
    lines = static_cast<int>(std::ceil(text.size().height()));
  }
  else
    lines = label.fontMetrics()
                .boundingRect(QRect(0, 0, width, QWIDGETSIZE_MAX), Qt::TextWordWrap, label.text())
                .height();
  return lines + beside.top() + beside.bottom() + around;
}

// Of a label whose lines are broken: when its width, its letters or (as it is drawn anew) its text
// is another.
class WholeLines : public QObject
{
public:
  WholeLines(QLabel& label, int least)
    : QObject(&label)
    , m_label(label)
    , m_least(least)
  {
    label.installEventFilter(this);
    if (least > 0)
      label.setMinimumHeight(floor()); // its width is not known yet
  }

  bool eventFilter(QObject* watched, QEvent* event) override
  {
    const bool isShown = event->type() == QEvent::Resize || event->type() == QEvent::Show ||
                         event->type() == QEvent::Paint;
    if (isShown && watched == &m_label && m_label.isVisible())
    {
      const int needed = std::max(heightOfLines(m_label), floor());
      if (m_label.minimumHeight() != needed)
        m_label.setMinimumHeight(needed);
    }
    return false;
  }

private:
  // Lines are drawn a pixel higher than their spacing with some fonts.
  int floor() const
  {
    const QFontMetrics metrics = m_label.fontMetrics();
    const QString lines = QString("x\n").repeated(m_least).trimmed();
    return lines.isEmpty()
               ? 0
               : std::max(m_least * metrics.lineSpacing(),
                          metrics
                              .boundingRect(QRect(0, 0, QWIDGETSIZE_MAX, QWIDGETSIZE_MAX),
                                            Qt::TextWordWrap, lines)
                              .height());
  }

  QLabel& m_label;
  int m_least; // lines
};

} // namespace

QWidget* scrolledPanel(QWidget* panel)
{
  constexpr int kLow = 700; // px, with the system's letters
  return roomFor(*panel).height() < kLow * fontScale() ? new WholePanel(panel) : panel;
}

QSize leastOfScreen(const QWidget& widget, const QSize& wanted)
{
  const QSize room = roomFor(widget);
  return wanted.boundedTo({2 * room.width() / 5, 2 * room.height() / 5});
}

int wholeWidthOf(const QTreeView& tree)
{
  const QHeaderView& header = *tree.header();
  const int last = header.count() - 1;
  int width = besides(tree) + header.sectionSizeHint(last);
  for (int column = 0; column < last; ++column)
    width += header.sectionSize(column);
  return width;
}

void layOutPanel(QWidget& panel, QWidget* inside, QWidget* foot)
{
  auto* outer = new QVBoxLayout(&panel);
  outer->setContentsMargins(0, 0, 0, 0);
  outer->setSpacing(0);
  outer->addWidget(new AboveFoot(inside), 1);
  outer->addWidget(foot);
}

void resizeOnScreen(QWidget& window, const QSize& wanted)
{
  constexpr int kTitleBar = 40; // px, that the window manager adds
  const QWidget* parent = window.parentWidget();
  window.resize(wanted.boundedTo(roomFor(parent ? *parent : window) - QSize(0, kTitleBar)));
}

void wrapWords(QLabel& label, int least)
{
  label.setWordWrap(true);
  new WholeLines(label, least);
}

QHBoxLayout* rowOf(std::initializer_list<QWidget*> widgets)
{
  auto* row = new QHBoxLayout;
  row->setSpacing(4);
  for (QWidget* widget : widgets)
    row->addWidget(widget);
  return row;
}

QGridLayout* toolGrid(const std::vector<QAction*>& tools, const char* name)
{
  constexpr int kInRow = 3;
  auto* grid = new QGridLayout;
  grid->setSpacing(4);
  for (std::size_t n = 0; n < tools.size(); ++n)
  {
    auto* tool = new QToolButton;
    tool->setDefaultAction(tools[n]);
    tool->setObjectName(name);
    tool->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    tool->setFocusPolicy(Qt::TabFocus);
    grid->addWidget(tool, static_cast<int>(n) / kInRow, static_cast<int>(n) % kInRow);
  }
  return grid;
}

} // namespace petrous::workstation
