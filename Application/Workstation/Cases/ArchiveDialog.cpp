#include "ArchiveDialog.h"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
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

namespace petrous::workstation
{

ArchiveDialog::ArchiveDialog(const scene::Case& value, const library::Library& library,
                             QWidget* parent)
  : QDialog(parent)
  , m_value(value)
  , m_library(library)
  , m_file(new PathRow("archiveFile", PathRow::Kind::NewFile, tr("File of the archive")))
  , m_plan(new QCheckBox(tr("&Plan only, without images and structures")))
  , m_note(new QCheckBox(tr("with its &note")))
  , m_videos(new QCheckBox(tr("with its &videos, which may show or name the patient")))
  , m_documents(new QCheckBox(tr("with its PD&Fs, which may name the patient")))
  , m_date(new QCheckBox(tr("with &dates and times, and who signed registrations")))
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
  for (QCheckBox* box : {m_plan, m_note, m_videos, m_documents, m_date})
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

void ArchiveDialog::update()
{
  const QFileInfo target(m_file->text());
  QString advice;
  if (m_file->text().isEmpty() || target.isDir())
    advice = tr("Give the file a name.");
  else if (!target.absoluteDir().exists())
    advice = tr("There is no such folder.");
  m_advice->setText(advice);
  m_accept->setEnabled(advice.isEmpty());
  m_report->setPlainText(
      phrase(presenters::identityReport(m_value, options(), {}, &m_library).text()));
}

void ArchiveDialog::accept()
{
  if (mayReplace(*this, {file()}))
    QDialog::accept();
}

} // namespace petrous::workstation
