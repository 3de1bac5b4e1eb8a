#pragma once

#include <QDialog>

#include "petrous/Library/Library.h"

class QTreeWidget;

namespace petrous::workstation
{

/// The cases of the library to choose from.
class OpenCaseDialog : public QDialog
{
  Q_OBJECT
public:
  explicit OpenCaseDialog(const library::Library& library, QWidget* parent = nullptr);

  std::string chosen() const; ///< empty: none

private:
  QTreeWidget* m_list;
};

} // namespace petrous::workstation
