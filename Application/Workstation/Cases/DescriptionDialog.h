#pragma once

#include <QDialog>

#include "petrous/Scene/Description.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QPlainTextEdit;
class QPushButton;

namespace petrous::workstation
{

/// What the user says of a case: note, tags, diagnosis, procedure, side, planned date.
class DescriptionDialog : public QDialog
{
  Q_OBJECT
public:
  DescriptionDialog(const QString& name, const scene::Description& description,
                    QWidget* parent = nullptr);

  scene::Description description() const;

private:
  void check();

  QLineEdit* m_diagnosis;
  QLineEdit* m_procedure;
  QComboBox* m_side;
  QLineEdit* m_date;
  QLineEdit* m_tags;
  QPlainTextEdit* m_note;
  QLabel* m_problem;
  QPushButton* m_accept;
};

/// The side for the user; empty if it is unknown.
QString sideText(scene::Side side);

} // namespace petrous::workstation
