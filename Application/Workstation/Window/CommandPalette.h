#pragma once

#include <vector>

#include <QDialog>

#include "Commands.h"

class QLabel;
class QLineEdit;
class QTreeWidget;
class QTreeWidgetItem;

namespace petrous::workstation
{

/// Finds a command by name, menu or what it does, shows its key, and runs it, or a setting, and
/// shows that: type, arrow keys, Enter. One that is not enabled is grey and says why.
class CommandPalette : public QDialog
{
  Q_OBJECT
public:
  CommandPalette(std::vector<Command> commands, QWidget* parent);

protected:
  bool eventFilter(QObject* watched, QEvent* event) override; ///< keys of the search

private:
  void search();
  void tell();
  void run();
  const Command* chosen() const;

  std::vector<Command> m_commands;
  std::vector<presenters::CommandEntry> m_entries;
  QLineEdit* m_search;
  QTreeWidget* m_list;
  QLabel* m_tip;
};

} // namespace petrous::workstation
