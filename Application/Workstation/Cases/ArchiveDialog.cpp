#include "ArchiveDialog.h"

#include <utility>

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include "AskName.h"
#include "PathRow.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Library/Attachments.h"
#include "petrous/Presenters/CaseTransfer.h"
#include "petrous/Presenters/IdentityText.h"
#include "petrous/Presenters/LeavingImages.h"

namespace petrous::workstation
{

ArchiveDialog::ArchiveDialog(const scene::Case& value, const library::Library& library,
                             FaceCheck faces, QWidget* parent)
  : QDialog(parent)
  , m_value(value)
  , m_faces(std::move(faces))
  , m_library(library)
  , m_file(new PathRow("archiveFile", PathRow::Kind::NewFile, tr("File of the archive")))
  , m_plan(new QCheckBox(tr("&Plan only, without images and structures")))
  , m_note(new QCheckBox(tr("with its &note")))
  , m_videos(new QCheckBox(tr("with its &videos, which may show or name the patient")))
  , m_documents(new QCheckBox(tr("with its PDF&s, which may name the patient")))
  , m_date(new QCheckBox(tr("with &dates and times, and who signed registrations")))
  , m_maskFace(new QCheckBox)
  , m_report(new QPlainTextEdit)
  , m_advice(new QLabel)
{
  setObjectName("archiveCase");
  setWindowTitle(tr("Archive “%1”").arg(words(value.name)));
  m_file->setText(QDir::home().filePath(words(value.name) + library::kArchiveEnding));
  m_plan->setObjectName("archivePlan");
  m_plan->setToolTip(tr("A small file with strokes, views and appearance. It is restored where the "
                        "very same CT is"));
  m_note->setObjectName("archiveNote");
  m_note->setEnabled(!value.description.note.empty());
  const presenters::IdentityText identity(value, library);
  m_noteIsPlain = m_note->isEnabled() && !identity.mayIdentify(value.description.note);
  m_note->setChecked(m_noteIsPlain);
  m_videos->setObjectName("archiveVideos");
  m_videos->setEnabled(library::hasAttachment(value, scene::Attachment::Kind::Video));
  m_documents->setObjectName("archiveDocuments");
  m_documents->setEnabled(library::hasAttachment(value, scene::Attachment::Kind::Document));
  m_date->setObjectName("archiveDate");
  m_date->setToolTip(tr("The dates of the planned operation and of attachments, the times of "
                        "strokes, names and times of sign-offs"));
  const QStringList leftOut = findWhatCannotBeMasked();
  m_maskFace->setText(leftOut.isEmpty() || !m_canMask
                          ? tr("Put a&ir in place of the face")
                          : tr("Put air in place of the &face, and leave out %1")
                                .arg(leftOut.join(", ").replace('&', "&&")));
  m_maskFace->setObjectName("archiveMaskFace");
  m_maskFace->setToolTip(tr("In front of a plane about 50 mm behind the tip of the nose. What is "
                            "segmented or drilled and the temporal bones stay; the case here does "
                            "not change"));
  m_maskFace->setChecked(m_canMask);
  m_report->setObjectName("archiveReport");
  m_report->setAccessibleName(tr("What the archive tells of the patient"));
  m_report->setReadOnly(true);
  m_report->setMinimumHeight(200);
  m_advice->setObjectName("dim");
  m_advice->setTextFormat(Qt::PlainText);

  auto* form = new QFormLayout;
  form->addRow(tr("&File:"), m_file);
  form->addRow(tr("What:"), m_plan);
  form->addRow({}, m_note);
  form->addRow({}, m_videos);
  form->addRow({}, m_documents);
  form->addRow({}, m_date);
  form->addRow({}, m_maskFace);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  m_accept = buttons->addButton(tr("&Archive"), QDialogButtonBox::AcceptRole);
  m_accept->setObjectName("primary");
  m_accept->setDefault(true);
  connect(buttons, &QDialogButtonBox::accepted, this, &ArchiveDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(m_file, &PathRow::changed, this, &ArchiveDialog::update);
  // A plan is made to be handed on. What the user chose stays.
  connect(m_note, &QCheckBox::clicked, this, [this] { m_noteIsChosen = true; });
  connect(m_plan, &QCheckBox::toggled, this,
          [this](bool plan)
          {
            if (!m_noteIsChosen)
              m_note->setChecked(m_noteIsPlain && !plan);
          });
  for (QCheckBox* box : {m_plan, m_note, m_videos, m_documents, m_date, m_maskFace})
    connect(box, &QCheckBox::toggled, this, &ArchiveDialog::update);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(form);
  layout->addWidget(new QLabel(tr("What is in the file:")));
  layout->addWidget(m_report, 1);
  layout->addWidget(m_advice);
  layout->addWidget(buttons);
  resize(680, 500);
  update();
}

std::filesystem::path ArchiveDialog::file() const
{
  const QString text = m_file->text();
  const bool isNamed = text.endsWith(library::kArchiveEnding, Qt::CaseInsensitive);
  return pathOf(isNamed ? text : text + library::kArchiveEnding);
}

library::ArchiveOptions ArchiveDialog::options() const
{
  library::ArchiveOptions options;
  options.planOnly = m_plan->isChecked();
  options.withoutNotes = !m_note->isChecked();
  options.withVideos = m_videos->isChecked();
  options.withDocuments = m_documents->isChecked();
  options.keepIdentity = m_date->isChecked();
  return options;
}

// Returns what can be left out instead.
QStringList ArchiveDialog::findWhatCannotBeMasked()
{
  QStringList leftOut;
  m_canMask = m_faces.mayHave();
  scene::Case rest = m_value;
  for (const scene::ImageWithFace& image : m_faces.images)
  {
    if (image.fault.empty())
      continue;
    m_canMask = m_canMask && !image.mr.empty();
    if (image.mr.empty())
      continue;
    try
    {
      presenters::leaveOutMrs(rest, {image.mr});
      m_notMaskable.push_back(image.mr);
      leftOut += textOf(image);
    }
    catch (const core::Error&) // structures were drawn on it
    {
      m_canMask = false;
    }
  }
  return leftOut;
}

bool ArchiveDialog::masks() const
{
  return m_maskFace->isEnabled() && m_maskFace->isChecked();
}

scene::ImageMask ArchiveDialog::mask() const
{
  scene::ImageMask mask;
  mask.face = masks();
  mask.found = m_faces.found;
  return mask;
}

std::vector<std::string> ArchiveDialog::withoutMrs() const
{
  return masks() ? m_notMaskable : std::vector<std::string>();
}

QStringList ArchiveDialog::facesLeft() const
{
  if (masks() || m_plan->isChecked() || !m_faces.mayHave())
    return {};
  return m_faces.isKnown ? warningsOf(m_faces.images) : QStringList{textOf(m_faces)};
}

void ArchiveDialog::update()
{
  m_maskFace->setEnabled(m_canMask && !m_plan->isChecked());
  const QFileInfo target(m_file->text());
  QString advice;
  if (m_file->text().isEmpty() || target.isDir())
    advice = tr("Give the file a name.");
  else if (!target.absoluteDir().exists())
    advice = tr("There is no such folder.");
  m_advice->setText(advice);
  m_accept->setEnabled(advice.isEmpty());
  scene::Case leaving = m_value;
  presenters::leaveOutMrs(leaving, withoutMrs());
  std::vector<scene::ImageWithFace> faces;
  QStringList faults;
  for (const scene::ImageWithFace& image : m_faces.images)
    if (masks() && !image.fault.empty())
      faults += sentence(capitalized(phrase(image.fault)));
    else
      faces.push_back(image);
  QString text = phrase(presenters::identityReport(leaving, options(), mask(), &m_library,
                                                   m_faces.isKnown ? &faces : nullptr)
                            .text());
  for (const QString& fault : faults)
    text += '\n' + fault;
  if (!m_faces.isKnown)
    text += '\n' + textOf(m_faces);
  m_report->setPlainText(text);
}

bool ArchiveDialog::mayLeaveFaces()
{
  const QStringList left = facesLeft();
  if (left.isEmpty())
    return true;
  QMessageBox ask(QMessageBox::Warning, windowTitle(), left.join('\n'), QMessageBox::Cancel, this);
  ask.setObjectName("archiveFace");
  auto* go = ask.addButton(tr("&Archive with the face"), QMessageBox::AcceptRole);
  ask.setDefaultButton(QMessageBox::Cancel);
  ask.exec();
  return ask.clickedButton() == go;
}

void ArchiveDialog::accept()
{
  if (mayLeaveFaces() && mayReplace(*this, {file()}))
    QDialog::accept();
}

} // namespace petrous::workstation
