#pragma once

#include <vector>

#include <QPointer>
#include <QString>

#include "petrous/Presenters/CommandSearch.h"

class QAction;
class QMainWindow;
class QWidget;

namespace petrous::workstation
{

/// setEnabled, with the reason for which it is not, to be told where it is asked for.
void enable(QAction& action, bool on, const QString& whyNot);
void enable(QWidget& control, bool on, const QString& whyNot); ///< a setting, or a group of them

/// Something that the window can do, or a setting that it has.
struct Command
{
  QPointer<QAction> action;  ///< menus that are filled anew take theirs with them
  QPointer<QWidget> control; ///< of a setting, which has no action
  QString name;
  QString menu; ///< "View › Layout", or the panel whose keys it has: "Registration › By hand"
  QString keys; ///< empty: none
  QString tip;
  bool isEnabled = true;
  QString whyNot; ///< if it is not enabled, as far as known
};

/// All that the menus have, in their order, then what tool bars and panels have beside them that
/// has a key. Fills menus that are filled when they open.
std::vector<Command> commandsOf(const QMainWindow& window, bool hasCase);

/// The check boxes, sliders, numbers and choices of panels and tool bars, by their own texts: that
/// of a check box, else the label whose buddy they are, the accessible name or the beginning of the
/// tool tip. Those that their panel hides at present, as parts of another tool, are not among them;
/// those in sections that are folded are.
std::vector<Command> settingsOf(const QMainWindow& window, bool hasCase);
/// Shows its tool bar or raises its panel, unfolds and scrolls to it, and gives it the focus.
void showSetting(QWidget& control);

std::vector<presenters::CommandEntry> entriesOf(const std::vector<Command>& commands);

} // namespace petrous::workstation
