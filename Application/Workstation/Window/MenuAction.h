#pragma once

class QAction;
class QKeySequence;
class QMenu;
class QString;

namespace petrous::workstation
{

/// A new action at the end of a menu, which owns it.
QAction* make(QMenu* menu, const QString& text, const QKeySequence& keys, const QString& tip);

/// The tooltip ends with the action's keys.
void setTip(QAction& action, const QString& tip);

} // namespace petrous::workstation
