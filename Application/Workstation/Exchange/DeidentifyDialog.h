#pragma once

#include <memory>
#include <string>

#include <QDialog>

#include "petrous/Presenters/FolderIdentity.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace petrous::workstation
{

class PathRow;

/// A folder of DICOM, what of it is kept (`petrous deidentify`), and the map of pseudonyms with its
/// passphrase, which is nowhere kept.
class DeidentifyDialog : public QDialog
{
  Q_OBJECT
public:
  explicit DeidentifyDialog(QWidget* parent = nullptr);
  ~DeidentifyDialog() override;

  presenters::DeidentifyRequest request() const;
  /// Takes it out of the dialog; it is overwritten when the last reference goes.
  std::shared_ptr<const std::string> takePassphrase();

private:
  void check();
  void clearPassphrases();

  PathRow* m_input;
  PathRow* m_output;
  QComboBox* m_dates;
  QCheckBox* m_descriptors;
  QCheckBox* m_device;
  QCheckBox* m_patient;
  QCheckBox* m_private;
  QCheckBox* m_burnedIn;
  QCheckBox* m_maskFace;
  QCheckBox* m_mapped;
  PathRow* m_map;
  QLineEdit* m_first;
  QLineEdit* m_second;
  QLabel* m_advice;
  QPushButton* m_accept;
};

} // namespace petrous::workstation
