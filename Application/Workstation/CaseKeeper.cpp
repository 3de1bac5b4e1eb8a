#include "CaseKeeper.h"

#include <cmath>

#include <QApplication>
#include <QFileDialog>
#include <QInputDialog>
#include <QMessageBox>
#include <QProgressDialog>
#include <QPushButton>
#include <QTemporaryDir>

#include "OpenCaseDialog.h"
#include "Theme.h"
#include "petrous/Imaging/SamplePatient.h"
#include "petrous/Presenters/CaseNaming.h"

namespace petrous::workstation
{

namespace fs = std::filesystem;

namespace
{

fs::path pathOf(const QString& text)
{
  return fs::path(QFile::encodeName(text).toStdString());
}

class WaitCursor
{
public:
  WaitCursor() { QApplication::setOverrideCursor(Qt::WaitCursor); }
  ~WaitCursor() { QApplication::restoreOverrideCursor(); }
  WaitCursor(const WaitCursor&) = delete;
  WaitCursor& operator=(const WaitCursor&) = delete;
};

} // namespace

CaseKeeper::CaseKeeper(presenters::WorkstationModel& model, QWidget& window)
  : m_model(model)
  , m_window(window)
{
}

CaseKeeper::~CaseKeeper() = default;

void CaseKeeper::refuse(const QString& why)
{
  QMessageBox box(QMessageBox::Warning, tr("Petrous"), why, QMessageBox::Ok, &m_window);
  box.setTextFormat(Qt::PlainText);
  box.setTextInteractionFlags(Qt::TextSelectableByMouse);
  box.exec();
}

void CaseKeeper::open(const QString& what)
{
  if (m_job && !m_model.beingStored())
    return; // one import at a time
  const fs::path path = pathOf(what);
  std::error_code error;
  try
  {
    if (!presenters::namesCase(m_model.library(), bytes(what)) && fs::exists(path, error))
      openPath(path);
    else
      openCase(bytes(what));
  }
  catch (const std::exception& fault)
  {
    refuse(inWords(fault));
  }
}

void CaseKeeper::openPath(const fs::path& path, const std::string& seriesUid)
{
  m_source = path;
  startImport(presenters::freeCaseName(m_model.library(), presenters::caseNameFrom(path)),
              [path, seriesUid](const core::Progress&)
              {
                presenters::CaseSources sources;
                sources.ct = path;
                sources.seriesUid = seriesUid;
                return sources;
              });
}

void CaseKeeper::chooseSeries(const QStringList& uids, const QStringList& descriptions)
{
  endJob();
  bool chosen = false;
  const QString text = QInputDialog::getItem(
      &m_window, tr("Which series?"), tr("There is more than one series; the case is made from:"),
      descriptions, 0, false, &chosen);
  const int index = descriptions.indexOf(text);
  if (!chosen || index < 0)
    return;
  try
  {
    openPath(m_source, bytes(uids[index]));
  }
  catch (const std::exception& fault)
  {
    refuse(inWords(fault));
  }
}

void CaseKeeper::openCase(const std::string& name)
{
  if (m_model.library().folder().empty() || !settle() || (m_model.unsaved() && !save()))
    return;
  try
  {
    const WaitCursor wait;
    m_model.open(name);
    emit said(tr("Opened %1.  Drag turns the patient, the wheel zooms, D switches to the drill.")
                  .arg(words(name)));
  }
  catch (const std::exception& fault)
  {
    refuse(inWords(fault));
  }
}

void CaseKeeper::openFolder()
{
  const QString folder = QFileDialog::getExistingDirectory(&m_window, tr("Open a DICOM folder"));
  if (!folder.isEmpty())
    open(folder);
}

void CaseKeeper::openImage()
{
  const QString file = QFileDialog::getOpenFileName(
      &m_window, tr("Open an image"), {},
      tr("CT images (*.nrrd *.nhdr *.nii *.nii.gz *.mha *.mhd *.dcm);;All files (*)"));
  if (!file.isEmpty())
    open(file);
}

void CaseKeeper::chooseCase()
{
  try
  {
    OpenCaseDialog dialog(m_model.library(), &m_window);
    if (dialog.exec() == QDialog::Accepted && !dialog.chosen().empty())
      openCase(dialog.chosen());
  }
  catch (const std::exception& fault)
  {
    refuse(inWords(fault));
  }
}

void CaseKeeper::makeSample()
{
  const auto folder = std::make_shared<QTemporaryDir>();
  if (!folder->isValid())
    return refuse(tr("No temporary folder can be made: %1").arg(folder->errorString()));
  try
  {
    startImport(presenters::freeCaseName(m_model.library(), "sample patient"),
                [folder](const core::Progress& progress)
                {
                  const fs::path out = pathOf(folder->filePath("sample patient"));
                  imaging::writeSamplePatient(out, {}, progress);
                  presenters::CaseSources sources;
                  sources.ct = out / "ct";
                  sources.parts.labels.push_back({"", out / "labels.seg.nrrd"});
                  return sources;
                });
  }
  catch (const std::exception& fault)
  {
    refuse(inWords(fault));
  }
}

void CaseKeeper::startImport(const std::string& name, ImportJob::Prepare prepare)
{
  if (!settle() || (m_model.unsaved() && !save()))
    return;
  m_job = std::make_unique<ImportJob>(m_model.library(), name, std::move(prepare));
  showProgress(name);
  connect(m_job.get(), &ImportJob::built, this, &CaseKeeper::built);
  connect(m_job.get(), &ImportJob::saved, this,
          [this](const std::shared_ptr<scene::Case>& saved)
          {
            endJob();
            m_model.stored(*saved);
            emit said(tr("Saved in the library as %1").arg(words(saved->name)));
            if (m_saveWanted)
              save();
          });
  connect(m_job.get(), &ImportJob::failed, this,
          [this](const QString& why, bool wasBuilt)
          {
            endJob();
            if (!wasBuilt)
              return refuse(why);
            m_model.notStored();
            save(); // tells why not, and what can be done
          });
  connect(m_job.get(), &ImportJob::cancelled, this,
          [this]
          {
            endJob();
            emit said(tr("Import cancelled; nothing was changed"));
          });
  connect(m_job.get(), &ImportJob::severalSeries, this, &CaseKeeper::chooseSeries);
  m_job->start();
}

void CaseKeeper::showProgress(const std::string& name)
{
  m_progress = std::make_unique<QProgressDialog>(tr("Looking at the files…"), tr("Cancel"), 0, 1000,
                                                 &m_window);
  m_progress->setObjectName("importProgress");
  m_progress->setWindowTitle(tr("Making the case %1").arg(words(name)));
  m_progress->setWindowModality(Qt::WindowModal);
  m_progress->setMinimumDuration(250);
  m_progress->setMinimumWidth(420);
  m_progress->setAutoClose(false);
  m_progress->setAutoReset(false);
  m_progress->setValue(0);
  // The box stays until the work has really stopped.
  disconnect(m_progress.get(), &QProgressDialog::canceled, m_progress.get(),
             &QProgressDialog::cancel);
  connect(m_progress.get(), &QProgressDialog::canceled, this,
          [this]
          {
            if (m_job)
              m_job->cancel();
            if (m_progress)
              m_progress->setLabelText(tr("Stopping…"));
          });
  connect(m_job.get(), &ImportJob::progressed, m_progress.get(),
          [this](double fraction, const QString& text)
          {
            if (!m_progress)
              return;
            m_progress->setValue(static_cast<int>(std::lround(1000.0 * fraction)));
            if (!text.isEmpty())
              m_progress->setLabelText(text.left(1).toUpper() + text.mid(1) + "…");
          });
}

void CaseKeeper::built(const std::shared_ptr<scene::Case>& value)
{
  m_progress.reset();
  const WaitCursor wait;
  m_model.adopt(std::move(*value));
  emit said(tr("Saving %1 in the library…").arg(words(m_model.value().name)));
}

void CaseKeeper::endJob()
{
  m_progress.reset();
  if (m_job)
  {
    m_job->wait();
    m_job.release()->deleteLater(); // it is the sender
  }
  emit importEnded();
}

bool CaseKeeper::settle()
{
  m_model.stopTouch(); // what was drilled until now is in the case
  if (!m_job)
    return true;
  const WaitCursor wait;
  if (!m_model.beingStored())
    m_job->cancel();
  m_job->wait();
  // Its last words are on their way.
  while (m_job)
    QApplication::processEvents(QEventLoop::ExcludeUserInputEvents, 50);
  return true;
}

bool CaseKeeper::save()
{
  if (!m_model.hasCase())
    return true;
  m_saveWanted = m_model.beingStored();
  if (m_saveWanted)
    return true;
  return keepTrying(false);
}

bool CaseKeeper::keepTrying(bool leaving)
{
  if (camera)
    m_model.setCamera(camera());
  std::function<void()> attempt = [this] { m_model.save(); };
  for (;;)
  {
    QString why;
    try
    {
      attempt();
      emit said(tr("Saved"));
      return true;
    }
    catch (const std::exception& fault)
    {
      why = inWords(fault);
    }
    const QString name = words(m_model.value().name);
    const std::string next = bytes(name.left(80)) + " copy";
    switch (askAfterFailure(why, leaving))
    {
    case Choice::Retry:
      attempt = [this] { m_model.save(); };
      break;
    case Choice::OtherName:
    {
      const QString other =
          QInputDialog::getText(&m_window, tr("Save under another name"), tr("Name of the case:"),
                                QLineEdit::Normal, words(next));
      if (!other.isEmpty())
        attempt = [this, other] { m_model.saveAs(bytes(other.trimmed())); };
      break;
    }
    case Choice::OtherFolder:
    {
      const QString folder =
          QFileDialog::getExistingDirectory(&m_window, tr("Library in another folder"));
      if (!folder.isEmpty())
        attempt = [this, folder]
        {
          const library::Library elsewhere(pathOf(folder));
          m_model.saveElsewhere(elsewhere.folder(),
                                presenters::freeCaseName(elsewhere, m_model.value().name));
        };
      break;
    }
    case Choice::GiveUp:
      return true;
    case Choice::Stay:
      emit said(tr("Not saved"));
      return false;
    }
  }
}

CaseKeeper::Choice CaseKeeper::askAfterFailure(const QString& why, bool leaving)
{
  QMessageBox box(QMessageBox::Warning, tr("Not saved"), why, QMessageBox::NoButton, &m_window);
  box.setTextFormat(Qt::PlainText);
  box.setInformativeText(tr("The work is still open in this window."));
  const auto* retry = box.addButton(tr("Try again"), QMessageBox::AcceptRole);
  const auto* name = box.addButton(tr("Another name…"), QMessageBox::ActionRole);
  const auto* folder = box.addButton(tr("Another folder…"), QMessageBox::ActionRole);
  const auto* quit =
      leaving ? box.addButton(tr("Quit without saving"), QMessageBox::DestructiveRole) : nullptr;
  auto* stay = box.addButton(tr("Go on working"), QMessageBox::RejectRole);
  box.setEscapeButton(stay);
  box.exec();
  const auto* clicked = box.clickedButton();
  if (clicked == retry)
    return Choice::Retry;
  if (clicked == name)
    return Choice::OtherName;
  if (clicked == folder)
    return Choice::OtherFolder;
  return quit && clicked == quit ? Choice::GiveUp : Choice::Stay;
}

void CaseKeeper::saveAs()
{
  if (!m_model.hasCase() || !settle())
    return;
  const std::string present = m_model.value().name;
  const QString name = QInputDialog::getText(
      &m_window, tr("Save as"), tr("Name of the new case:"), QLineEdit::Normal,
      words(presenters::freeCaseName(m_model.library(), present)));
  if (name.isEmpty())
    return;
  try
  {
    if (camera)
      m_model.setCamera(camera());
    m_model.saveAs(bytes(name.trimmed()));
    emit said(tr("Saved as %1").arg(name.trimmed()));
  }
  catch (const std::exception& fault)
  {
    refuse(inWords(fault));
  }
}

bool CaseKeeper::mayLeave()
{
  settle();
  return !m_model.hasCase() || !m_model.unsaved() || keepTrying(true);
}

} // namespace petrous::workstation
