#include "DecimalPoint.h"

#include <algorithm>
#include <clocale>
#include <utility>

#include <QApplication>
#include <QClipboard>
#include <QDialog>
#include <QDoubleSpinBox>
#include <QKeyEvent>
#include <QLineEdit>
#include <QLocale>
#include <QMainWindow>
#include <QSpinBox>
#include <QStatusBar>
#include <QStyle>
#include <QToolTip>

#include "Language.h"

namespace petrous::workstation
{

namespace
{

constexpr int kMarked = 5000; // ms
constexpr int kSaid = 8000;   // ms in the status bar

int decimalsOf(const QAbstractSpinBox& box)
{
  const auto* number = qobject_cast<const QDoubleSpinBox*>(&box);
  return number ? number->decimals() : 0;
}

bool isOfNumber(QChar c)
{
  return c.isDigit() || QString(".,-+").contains(c);
}

// Words for what the field takes.
QString possibleIn(const QAbstractSpinBox& box)
{
  if (const QString said = box.property("possible").toString(); !said.isEmpty())
    return said;
  const int decimals = decimalsOf(box);
  const auto text = [&](const char* name)
  { return box.locale().toString(box.property(name).toDouble(), 'f', decimals); };
  const QString range =
      DecimalPoint::tr("From %1 to %2%3")
          .arg(text("minimum"), text("maximum"), box.property("suffix").toString());
  return decimals == 0 ? DecimalPoint::tr("%1, whole numbers").arg(range)
                       : DecimalPoint::tr("%1, decimals: at most %2").arg(range).arg(decimals);
}

// "9 is above the most, 4 EV"; where it is no number beyond the limits, what is possible.
QString whyNot(const QAbstractSpinBox& box, const QString& typed)
{
  bool isNumber = false;
  const double number = box.locale().toDouble(typed.trimmed(), &isNumber);
  const double least = box.property("minimum").toDouble();
  const double most = box.property("maximum").toDouble();
  const auto limit = [&box](double value)
  {
    const double rounded = QLocale::c().toString(value, 'f', decimalsOf(box)).toDouble();
    return box.locale().toString(rounded, 'g', 10) + box.property("suffix").toString();
  };
  if (isNumber && number > most)
    return DecimalPoint::tr("%1 is above the most, %2").arg(typed.trimmed(), limit(most));
  if (isNumber && number < least)
    return DecimalPoint::tr("%1 is below the least, %2").arg(typed.trimmed(), limit(least));
  return DecimalPoint::tr("“%1” is not possible here; the number is as it was. %2.")
      .arg(typed, possibleIn(box));
}

// The window's, also of a field in a dialog or a floating panel; nullptr: it has none.
QStatusBar* statusBarOf(const QAbstractSpinBox& box)
{
  const QMainWindow* window = nullptr;
  for (const QWidget* one = &box; one && !window; one = one->parentWidget())
    window = qobject_cast<const QMainWindow*>(one);
  return window ? window->findChild<QStatusBar*>() : nullptr;
}

// Below the field, or below a dialog, whose other fields it would cover.
QPoint placeOfReason(const QAbstractSpinBox& box)
{
  const auto* dialog = qobject_cast<const QDialog*>(box.window());
  return dialog ? dialog->mapToGlobal(QPoint(0, dialog->height()))
                : box.mapToGlobal(QPoint(0, box.height()));
}

} // namespace

DecimalPoint::DecimalPoint(QApplication& application)
  : QObject(&application)
{
  std::setlocale(LC_NUMERIC, "C");
  useNumberLocale();
  application.installEventFilter(this);
  m_marks.setSingleShot(true);
  m_marks.setInterval(kMarked);
  connect(&m_marks, &QTimer::timeout, this, &DecimalPoint::unmark);
}

void DecimalPoint::unmark()
{
  if (m_marked)
    mark(*m_marked, false);
}

void DecimalPoint::mark(QAbstractSpinBox& box, bool refused)
{
  if (refused)
  {
    if (m_marked != &box)
      unmark();
    m_marked = &box;
    m_marks.start();
  }
  if (box.property("refused").toBool() == refused)
    return;
  box.setProperty("refused", refused);
  box.style()->unpolish(&box);
  box.style()->polish(&box);
}

void DecimalPoint::refuse(QAbstractSpinBox& box, const QString& what)
{
  box.setProperty("value", m_before);
  if (auto* line = box.findChild<QLineEdit*>()) // what was typed of it is not the number that was
    line->setText(box.property("prefix").toString() +
                  box.locale().toString(m_before.toDouble(), 'f', decimalsOf(box)) +
                  box.property("suffix").toString());
  box.selectAll();
  mark(box, true);
  m_isRest = true;
  QString why = whyNot(box, what);
  m_said = why;
  if (QStatusBar* bar = statusBarOf(box))
    bar->showMessage(why, kSaid);
  if (const QString possible = possibleIn(box); !why.contains(possible))
    why += ". " + possible + '.';
  QToolTip::showText(placeOfReason(box), why, &box);
}

void DecimalPoint::mended(QAbstractSpinBox& box)
{
  mark(box, false);
  if (m_said.isEmpty())
    return;
  if (QStatusBar* bar = statusBarOf(box); bar && bar->currentMessage() == m_said)
    bar->clearMessage();
  m_said.clear();
  QToolTip::hideText();
}

// True: the field has had it.
bool DecimalPoint::typed(QAbstractSpinBox& box, const QString& text)
{
  auto* line = box.findChild<QLineEdit*>();
  if (!line || line->isReadOnly() || box.metaObject()->indexOfProperty("value") < 0 ||
      !box.isEnabled() || text.isEmpty() || !std::all_of(text.begin(), text.end(), isOfNumber))
    return false;
  if (m_box != &box)
  {
    m_box = &box;
    m_before = box.property("value");
    m_isRest = false;
  }
  if (m_isRest)
    return true;
  const bool isWhole = decimalsOf(box) == 0;
  QString points = text;
  if (!isWhole)
    points.replace(',', '.').replace('.', box.locale().decimalPoint());
  QString wanted = line->text();
  int at = line->cursorPosition();
  if (line->hasSelectedText())
  {
    at = line->selectionStart();
    wanted.remove(at, line->selectedText().size());
  }
  wanted.insert(at, points);
  const QString suffix = box.property("suffix").toString();
  const QString shown = wanted.endsWith(suffix) ? wanted.chopped(suffix.size()) : wanted;
  int end = at + points.size();
  // Between thousands they are the locale's own, which nobody means who types one.
  if (isWhole && (points.contains(',') || points.contains('.')))
  {
    refuse(box, shown);
    return true;
  }
  QString checked = wanted;
  if (box.validate(checked, end) == QValidator::Invalid)
  {
    refuse(box, shown);
    return true;
  }
  mended(box);
  if (points == text)
    return false; // as it is
  for (const QChar point : points)
  {
    QKeyEvent key(QEvent::KeyPress, Qt::Key_Period, Qt::NoModifier, QString(point));
    box.event(&key);
  }
  return true;
}

bool DecimalPoint::eventFilter(QObject* watched, QEvent* event)
{
  auto* box = qobject_cast<QAbstractSpinBox*>(watched);
  if (!box || (event->type() != QEvent::KeyPress && event->type() != QEvent::FocusOut))
    return false;
  const auto* key =
      event->type() == QEvent::KeyPress ? static_cast<const QKeyEvent*>(event) : nullptr;
  if (key && key->matches(QKeySequence::Paste))
    return typed(*box, QApplication::clipboard()->text().trimmed());
  if (key && !(key->modifiers() & (Qt::ControlModifier | Qt::AltModifier)) &&
      typed(*box, key->text()))
    return true;
  if (m_box != box)
    return false;
  const bool isEnd = !key || key->key() == Qt::Key_Return || key->key() == Qt::Key_Enter ||
                     key->key() == Qt::Key_Tab || key->key() == Qt::Key_Backtab;
  if (isEnd && !m_isRest && !box->hasAcceptableInput())
    refuse(*box, box->findChild<QLineEdit*>()->text());
  if (isEnd)
  {
    m_box.clear();
    // The keys that follow are meant for the field, not for what would have the focus next.
    const bool isKept = std::exchange(m_isRest, false) && key;
    if (isKept)
      box->selectAll();
    return isKept;
  }
  if (const int code = key->key();
      code == Qt::Key_Backspace || (code >= Qt::Key_Escape && code < Qt::Key_Shift))
  {
    m_isRest = false;
    mended(*box);
  }
  return false;
}

} // namespace petrous::workstation
