#include "Banner.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPointer>
#include <QPushButton>
#include <QRegularExpression>
#include <QVBoxLayout>
#include <QVariant>

#include "PanelLayout.h"

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
  m_whole = text;
  const QString shown = elided(text);
  m_text->setText(shown);
  m_text->setToolTip(shown == text ? QString() : text);
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
  m_layout->addWidget(button);
}

void Banner::setButtonVisible(const QString& name, bool visible)
{
  if (auto* button = findChild<QPushButton*>(name))
    button->setVisible(visible);
}

} // namespace petrous::workstation
