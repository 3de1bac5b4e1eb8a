#include "Banner.h"

#include <algorithm>

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPointer>
#include <QPushButton>
#include <QRegularExpression>
#include <QScrollArea>
#include <QScrollBar>
#include <QVBoxLayout>
#include <QVariant>

#include "PanelLayout.h"

namespace petrous::workstation
{

BannerStack::BannerStack(QWidget& over)
  : QWidget(&over)
  , m_scroll(new QScrollArea(this))
  , m_inside(new QWidget)
  , m_layout(new QVBoxLayout(m_inside))
  , m_room(new QWidget(&over))
{
  m_layout->setContentsMargins(0, 0, 0, 0);
  m_layout->setSpacing(0);
  m_layout->setSizeConstraint(QLayout::SetNoConstraint);
  m_scroll->setFrameShape(QFrame::NoFrame);
  m_scroll->setFocusPolicy(Qt::NoFocus);
  m_scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  m_scroll->setWidget(m_inside);
  m_inside->installEventFilter(this);
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
  if (watched == m_inside && event->type() == QEvent::LayoutRequest)
    place();
  return QWidget::eventFilter(watched, event);
}

int BannerStack::heightFor(int across) const
{
  return m_layout->hasHeightForWidth() ? m_layout->totalHeightForWidth(across)
                                       : m_layout->sizeHint().height();
}

// A share of the widget, and no more than the views leave.
int BannerStack::most() const
{
  constexpr double kShare = 0.4;
  constexpr int kLeast = 72; // px, as of a line or two with buttons
  const QLayout* whole = parentWidget()->layout();
  const int views = whole ? whole->minimumSize().height() - m_room->minimumHeight() : 0;
  const int down = parentWidget()->height();
  return std::max(kLeast, std::min(static_cast<int>(kShare * down), down - views));
}

void BannerStack::place()
{
  const int across = parentWidget()->width();
  int whole = heightFor(across);
  const int down = std::min(whole, most());
  int wide = across;
  if (down < whole)
  {
    wide -= m_scroll->verticalScrollBar()->sizeHint().width();
    whole = heightFor(wide);
  }
  setGeometry(0, 0, across, down);
  m_scroll->setGeometry(rect());
  m_inside->resize(wide, whole);
  raise();
  if (!m_held)
    m_room->setFixedHeight(down);
  emit covers(down - m_room->height());
}

namespace
{
// Lines cannot be broken within a word, such as the name of a library file.
QString elided(QString text)
{
  static const QRegularExpression longWord("(\\S{16})\\S{9,}(\\S{16})");
  return text.replace(longWord, QString::fromUtf8("\\1…\\2"));
}
} // namespace

Banner::Banner(const QString& name, Kind kind, QWidget* parent)
  : QFrame(parent)
  , m_text(new QLabel)
  , m_layout(new QHBoxLayout(this))
{
  setObjectName(name);
  setProperty("banner",
              QString(kind == Kind::Warning ? "warning" : "notice")); // for the style sheet
  m_text->setTextFormat(Qt::PlainText);
  wrapWords(*m_text);
  m_text->setTextInteractionFlags(Qt::TextSelectableByMouse);
  m_layout->setContentsMargins(12, 6, 8, 6);
  m_layout->addWidget(m_text, 1);
  hide();
}

void Banner::setText(const QString& text)
{
  setText(text, text);
}

void Banner::setText(const QString& text, const QString& shown)
{
  m_whole = text;
  m_text->setText(elided(shown));
  m_text->setToolTip(m_text->text() == text ? QString() : text);
}

QString Banner::text() const
{
  return m_whole;
}

QString Banner::shownText() const
{
  return m_text->text();
}

void Banner::addButton(const QString& name, const QString& text, const std::function<void()>& act)
{
  auto* button = new QPushButton(text);
  button->setObjectName(name);
  button->setAutoDefault(false);
  connect(button, &QPushButton::clicked, this,
          [this, act, button]
          {
            const QPointer<Banner> self(this);
            const bool hadFocus = button->hasFocus();
            act();
            if (self && hadFocus && isHidden())
              emit dismissed();
          });
  m_layout->addWidget(button, 0, Qt::AlignTop); // seen before a long text is scrolled
}

void Banner::setButtonVisible(const QString& name, bool visible)
{
  if (auto* button = findChild<QPushButton*>(name))
    button->setVisible(visible);
}

} // namespace petrous::workstation
