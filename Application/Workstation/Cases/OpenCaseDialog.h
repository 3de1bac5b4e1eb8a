#pragma once

#include <functional>

#include <QDialog>

#include "petrous/Library/Library.h"

class QLineEdit;
class QMenu;
class QPushButton;
class QTreeWidget;

namespace petrous::workstation
{

/// Lists the library's cases to search (Ctrl+F), open, rename (F2), copy (Ctrl+C) and delete (Del);
/// deleted ones can be brought back.
class OpenCaseDialog : public QDialog
{
  Q_OBJECT
public:
  /// Operations on the library; both throw as it does. If empty, the dialog only selects.
  struct Changes
  {
    std::function<void(const std::string& name, const std::string& to)> rename;
    std::function<void(const std::string& name)> remove;
    std::function<void(const std::string& name, const std::string& to)> copy;
    std::function<void(const std::string& name)> undelete;
  };
  OpenCaseDialog(const library::Library& library, Changes changes, QWidget* parent = nullptr);

  std::string chosen() const; ///< a case that can be opened; empty: none

private:
  void fill(const std::string& current);
  std::string current() const; ///< damaged or not
  void rename();
  void remove();
  void copy();
  void listDeleted();
  void attempt(const std::function<void()>& change);

  const library::Library& m_library;
  Changes m_changes;
  QLineEdit* m_search;
  QTreeWidget* m_list;
  QMenu* m_deleted;
  QPushButton* m_undelete = nullptr;
};

} // namespace petrous::workstation
