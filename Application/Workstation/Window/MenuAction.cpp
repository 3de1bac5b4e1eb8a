#include "MenuAction.h"

#include <QKeySequence>
#include <QMenu>

namespace petrous::workstation
{

QAction* make(QMenu* menu, const QString& text, const QKeySequence& keys, const QString& tip)
{
  QAction* action = menu->addAction(text);
  action->setShortcut(keys);
  setTip(*action, tip);
  return action;
}

void setTip(QAction& action, const QString& tip)
{
  const QString keys = action.shortcut().toString(QKeySequence::NativeText);
  action.setToolTip(keys.isEmpty() ? tip : tip + " (" + keys + ")");
  action.setStatusTip(tip);
}

} // namespace petrous::workstation
