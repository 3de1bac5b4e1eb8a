#pragma once

#include <string>
#include <utility>
#include <vector>

#include <QDialog>

#include "petrous/Presenters/CaseExport.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;

namespace petrous::workstation
{

/// What of a case is written for other programs, in which format and where: `petrous export`.
class ExportDialog : public QDialog
{
  Q_OBJECT
public:
  explicit ExportDialog(const scene::Case& value, QWidget* parent = nullptr);

  presenters::ExportOptions options() const;

private:
  void whatChanged();
  void formatChanged();
  void check();
  void browse();
  void askAndAccept();
  bool isSeries() const;

  QString m_caseName;
  std::vector<std::pair<std::string, bool>> m_mr; ///< names; whether registered
  std::vector<std::string> m_labels;
  std::vector<std::string> m_surfaces; ///< labels and meshes
  QComboBox* m_what;
  QComboBox* m_part;
  QComboBox* m_format;
  QCheckBox* m_onCt;
  QSpinBox* m_triangles;
  QLineEdit* m_path;
  QLabel* m_advice;
  QPushButton* m_accept;
};

} // namespace petrous::workstation
