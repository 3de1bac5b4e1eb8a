#include "TextKeys.h"

#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QTextEdit>

namespace petrous::workstation
{

namespace
{

bool takesText(const QObject& field)
{
  if (const auto* line = qobject_cast<const QLineEdit*>(&field))
    return !line->isReadOnly();
  if (const auto* number = qobject_cast<const QAbstractSpinBox*>(&field))
    return !number->isReadOnly();
  if (const auto* choice = qobject_cast<const QComboBox*>(&field))
    return choice->isEditable();
  if (const auto* text = qobject_cast<const QTextEdit*>(&field))
    return !text->isReadOnly();
  if (const auto* text = qobject_cast<const QPlainTextEdit*>(&field))
    return !text->isReadOnly();
  return false;
}

// AltGr is a modifier of its own under X11, and Ctrl with Alt elsewhere; each of these two alone
// makes a command of a character.
bool isCharacter(const QKeyEvent& key)
{
  const Qt::KeyboardModifiers commands =
      key.modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier);
  const bool isAltGr = commands == (Qt::ControlModifier | Qt::AltModifier);
  return !key.text().isEmpty() && key.text().at(0).isPrint() && (!commands || isAltGr);
}

} // namespace

TextKeys::TextKeys(QApplication& application)
  : QObject(&application)
{
  application.installEventFilter(this);
}

bool TextKeys::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() != QEvent::ShortcutOverride || !takesText(*watched) ||
      !isCharacter(*static_cast<const QKeyEvent*>(event)))
    return false;
  event->accept();
  return true;
}

} // namespace petrous::workstation
