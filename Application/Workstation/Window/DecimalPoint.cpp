#include "DecimalPoint.h"

#include <clocale>

#include <QApplication>
#include <QDoubleSpinBox>
#include <QKeyEvent>
#include <QLocale>

namespace petrous::workstation
{

DecimalPoint::DecimalPoint(QApplication& application)
  : QObject(&application)
{
  std::setlocale(LC_NUMERIC, "C");
  QLocale::setDefault(QLocale::c());
  application.installEventFilter(this);
}

bool DecimalPoint::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() != QEvent::KeyPress)
    return false;
  const auto* key = static_cast<const QKeyEvent*>(event);
  if (key->text() != "," || !qobject_cast<QDoubleSpinBox*>(watched))
    return false;
  QKeyEvent point(QEvent::KeyPress, Qt::Key_Period, key->modifiers(), ".");
  QCoreApplication::sendEvent(watched, &point);
  return true;
}

} // namespace petrous::workstation
