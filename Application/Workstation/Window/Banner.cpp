#include "Banner.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QRegularExpression>
#include <QVariant>

namespace petrous::workstation
{

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
  m_text->setWordWrap(true);
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
  connect(button, &QPushButton::clicked, this, act);
  m_layout->addWidget(button);
}

void Banner::setButtonVisible(const QString& name, bool visible)
{
  if (auto* button = findChild<QPushButton*>(name))
    button->setVisible(visible);
}

} // namespace petrous::workstation
