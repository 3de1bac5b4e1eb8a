#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <QDialog>

#include "FaceCheck.h"
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
  /// What was chosen, to be proposed again.
  struct Choices
  {
    QString caseName, what, part, format, path;
    bool onCt = false;
    int triangles = 0;
    bool maskFace = false;
  };

  /// `last`: as far as this case has it. Its file is proposed for the same case, else its folder.
  ExportDialog(const scene::Case& value, const FaceCheck& faces,
               const std::optional<Choices>& last = {}, QWidget* parent = nullptr);

  presenters::ExportOptions options() const;
  Choices choices() const;

private:
  void whatChanged();
  void formatChanged();
  void check();
  void browse();
  void askAndAccept();
  void choose(const Choices& last);
  bool isSeries() const;

  QString m_caseName;
  std::vector<std::pair<std::string, bool>> m_mr; ///< names; whether registered
  std::vector<std::string> m_labels;
  std::vector<std::string> m_surfaces; ///< labels and meshes
  QComboBox* m_what;
  QComboBox* m_part;
  QComboBox* m_format;
  QCheckBox* m_onCt;
  QCheckBox* m_maskFace;
  bool m_hasFace = false;
  QLabel* m_face; ///< in which images one can be recognised
  QSpinBox* m_triangles;
  QLabel* m_coordinates;
  QLineEdit* m_path;
  QLabel* m_advice;
  QPushButton* m_accept;
};

} // namespace petrous::workstation
