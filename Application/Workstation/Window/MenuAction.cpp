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

QString keysOf(const QAction& action)
{
  QStringList keys;
  for (const QKeySequence& one : action.shortcuts())
    keys += one.toString(QKeySequence::NativeText);
  keys.removeAll(QString());
  return keys.join(QObject::tr(" or "));
}

void addKey(QAction& action, const QKeySequence& key)
{
  action.setShortcuts(action.shortcuts() << key);
  setTip(action, action.statusTip());
}

void setTip(QAction& action, const QString& tip)
{
  const QString keys = keysOf(action);
  action.setToolTip(keys.isEmpty() ? tip : tip + " (" + keys + ")");
  action.setStatusTip(tip);
}

} // namespace petrous::workstation
