#pragma once

class QAction;
class QKeySequence;
class QMenu;
class QString;

namespace petrous::workstation
{

/// A new action at the end of a menu, which owns it.
QAction* make(QMenu* menu, const QString& text, const QKeySequence& keys, const QString& tip);

/// All of them, as on the keyboard: "[ or A"; empty without any.
QString keysOf(const QAction& action);

/// One more key for an action of make(). Where the usual one is a character that some keyboards
/// have only with AltGr, and so not at all with Ctrl.
void addKey(QAction& action, const QKeySequence& key);

/// The tooltip ends with the action's keys.
void setTip(QAction& action, const QString& tip);

} // namespace petrous::workstation
