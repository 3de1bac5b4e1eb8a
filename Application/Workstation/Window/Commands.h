#pragma once

#include <vector>

#include <QPointer>
#include <QString>

#include "petrous/Presenters/CommandSearch.h"

class QAction;
class QMainWindow;

namespace petrous::workstation
{

/// setEnabled, with the reason for which it is not, to be told where it is asked for.
void enable(QAction& action, bool on, const QString& whyNot);

/// Something that the window can do now.
struct Command
{
  QPointer<QAction> action; ///< menus that are filled anew take theirs with them
  QString name;
  QString menu; ///< "View › Layout", or the panel whose keys it has
  QString keys; ///< empty: none
  QString tip;
  bool isEnabled = true;
  QString whyNot; ///< if it is not enabled, as far as known
};

/// All that the menus have, in their order, then what tool bars and panels have beside them that
/// has a key. Fills menus that are filled when they open.
std::vector<Command> commandsOf(const QMainWindow& window, bool hasCase);

std::vector<presenters::CommandEntry> entriesOf(const std::vector<Command>& commands);

} // namespace petrous::workstation
