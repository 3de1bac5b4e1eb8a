#pragma once

#include <vector>

#include <QDialog>

#include "Commands.h"

class QLineEdit;
class QTreeWidget;

namespace petrous::workstation
{

/// All keys of the window, by menu and panel, with a search: those of its actions, and those that
/// views take without one. The window can be used beside it.
class KeyList : public QDialog
{
  Q_OBJECT
public:
  KeyList(const std::vector<Command>& commands, QWidget* parent);

private:
  void add(const QString& group, const QString& name, const QString& keys, const QString& tip);
  int fitColumns();
  void search();

  QLineEdit* m_search;
  QTreeWidget* m_list;
};

} // namespace petrous::workstation
