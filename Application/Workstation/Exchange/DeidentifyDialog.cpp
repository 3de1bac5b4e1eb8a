#include "DeidentifyDialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include "Bind.h"
#include "PanelLayout.h"
#include "Passphrase.h"
#include "PathRow.h"
#include "Theme.h"

namespace petrous::workstation
{

DeidentifyDialog::DeidentifyDialog(QWidget* parent)
  : QDialog(parent)
  , m_input(new PathRow("deidentifyInput", PathRow::Kind::Folder, tr("Folder of DICOM files")))
  , m_output(new PathRow("deidentifyOutput", PathRow::Kind::Folder, tr("New or empty folder")))
  , m_dates(new QComboBox)
  , m_descriptors(checkBox(tr("Descriptions, &reduced to medical words"), "keepDescriptors",
                           tr("Otherwise descriptions are removed")))
  , m_device(checkBox(tr("What identifies the de&vice"), "keepDevice",
                      tr("Model, software, names of sequences, kernels and coils")))
  , m_patient(checkBox(tr("Se&x, age, size and weight"), "keepPatient", {}))
  , m_private(checkBox(tr("Private attributes that the &standard lists as safe"), "keepPrivate",
                       tr("PS3.15, Table E.3.10-1")))
  , m_burnedIn(checkBox(tr("Images that may &have text in their pixels"), "keepBurnedIn",
                        tr("Otherwise they are left out, and named")))
  , m_maskFace(
        checkBox(tr("Put &air in place of the face in CT and MR series"), "maskFace",
                 tr("In front of a plane about 50 mm behind the tip of the nose. Images that "
                    "are in no such volume are left out, and named")))
  , m_mapped(checkBox(tr("Remember who is &behind the pseudonyms"), "useMap",
                      tr("In an encrypted file that stays here. The same file gives the same "
                         "pseudonyms, UIDs and date shifts again")))
  , m_map(new PathRow("pseudonymMap", PathRow::Kind::NewFile, tr("File of the pseudonyms")))
  , m_first(passphraseLine("passphrase"))
  , m_second(passphraseLine("passphraseAgain"))
  , m_advice(new QLabel)
{
  setObjectName("deidentify");
  setWindowTitle(tr("De-identify DICOM files"));
  m_dates->setObjectName("deidentifyDates");
  using Dates = library::DeidentificationOptions::Dates;
  m_dates->addItem(tr("removed"), static_cast<int>(Dates::Remove));
  m_dates->addItem(tr("shifted, by days of each patient's own"), static_cast<int>(Dates::Shift));
  m_dates->addItem(tr("kept"), static_cast<int>(Dates::Keep));
  m_advice->setObjectName("deidentifyAdvice");
  m_advice->setTextFormat(Qt::PlainText);
  wrapWords(*m_advice, 2);

  auto* form = new QFormLayout;
  form->addRow(tr("&From:"), m_input);
  form->addRow(tr("&To:"), m_output);
  form->addRow(tr("&Dates:"), m_dates);
  form->addRow(tr("Keep:"), m_descriptors);
  for (QCheckBox* box : {m_device, m_patient, m_private, m_burnedIn})
    form->addRow({}, box);
  form->addRow(tr("Face:"), m_maskFace);
  form->addRow({}, m_mapped);
  form->addRow(tr("Fi&le:"), m_map);
  form->addRow(tr("&Passphrase:"), m_first);
  form->addRow(tr("Once &more:"), m_second);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  m_accept = buttons->addButton(tr("De-&identify"), QDialogButtonBox::AcceptRole);
  m_accept->setObjectName("primary");
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  for (PathRow* row : {m_input, m_output, m_map})
    connect(row, &PathRow::changed, this, &DeidentifyDialog::check);
  for (QLineEdit* line : {m_first, m_second})
    connect(line, &QLineEdit::textChanged, this, &DeidentifyDialog::check);
  connect(m_mapped, &QCheckBox::toggled, this, &DeidentifyDialog::check);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(form);
  layout->addWidget(m_advice);
  layout->addWidget(buttons);
  resize(640, 0);
  check();
}

DeidentifyDialog::~DeidentifyDialog()
{
  clearPassphrases();
}

void DeidentifyDialog::clearPassphrases()
{
  for (QLineEdit* line : {m_first, m_second})
    clearPassphrase(*line);
}

void DeidentifyDialog::check()
{
  const bool mapped = m_mapped->isChecked();
  const QString map = m_map->text();
  const bool isNew = mapped && !map.isEmpty() && !QFileInfo::exists(map);
  m_map->setEnabled(mapped);
  m_first->setEnabled(mapped);
  m_second->setEnabled(isNew);
  const QFileInfo output(m_output->text());
  QString advice;
  if (m_input->text().isEmpty() || !QFileInfo::exists(m_input->text()))
    advice = tr("Choose the folder whose files are to be de-identified; it is never changed.");
  else if (m_output->text().isEmpty() || (output.exists() && !QDir(m_output->text()).isEmpty()))
    advice = tr("Choose a new or empty folder for what is written.");
  else if (mapped && map.isEmpty())
    advice = tr("Choose the file of the pseudonyms; it need not exist yet.");
  else if (mapped && m_first->text().toUtf8().size() < kShortestPassphrase)
    advice = tr("The passphrase must have at least %1 characters.").arg(kShortestPassphrase);
  else if (isNew && m_second->text() != m_first->text())
    advice = tr("The file is new: type the same passphrase once more. Who forgets it cannot find "
                "out any more who is who.");
  m_accept->setEnabled(advice.isEmpty());
  m_advice->setText(advice.isEmpty() ? tr("By PS3.15, Basic Application Level Confidentiality "
                                          "Profile. What stays and why is listed at the end.")
                                     : advice);
}

presenters::DeidentifyRequest DeidentifyDialog::request() const
{
  presenters::DeidentifyRequest request;
  request.input = m_input->path();
  request.output = m_output->path();
  if (m_mapped->isChecked())
    request.map = m_map->path();
  library::DeidentificationOptions& options = request.options;
  options.dates =
      static_cast<library::DeidentificationOptions::Dates>(m_dates->currentData().toInt());
  options.cleanDescriptors = m_descriptors->isChecked();
  options.retainDevice = m_device->isChecked();
  options.retainPatientCharacteristics = m_patient->isChecked();
  options.retainSafePrivate = m_private->isChecked();
  options.keepBurnedIn = m_burnedIn->isChecked();
  options.maskFace = m_maskFace->isChecked();
  return request;
}

std::shared_ptr<const std::string> DeidentifyDialog::takePassphrase()
{
  auto secret = workstation::takePassphrase(*m_first);
  clearPassphrases();
  return secret;
}

} // namespace petrous::workstation
