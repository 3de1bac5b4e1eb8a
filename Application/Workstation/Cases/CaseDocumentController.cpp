#include "CaseDocumentController.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <QDir>
#include <QFileDialog>
#include <QMessageBox>
#include <QProgressDialog>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QTemporaryDir>
#include <QTimer>

#include "AddPartsDialog.h"
#include "Application.h"
#include "ArchiveDialog.h"
#include "AskName.h"
#include "AxesDialog.h"
#include "Banner.h"
#include "CaseSaver.h"
#include "FaceCheck.h"
#include "RegionDialog.h"
#include "RepairDialog.h"
#include "SeriesDialog.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Imaging/DicomReader.h"
#include "petrous/Imaging/DicomScan.h"
#include "petrous/Imaging/FileFormats.h"
#include "petrous/Library/Archive.h"
#include "petrous/Library/FrameSalt.h"
#include "petrous/Phantom/SamplePatient.h"
#include "petrous/Presenters/CaseNaming.h"
#include "petrous/Presenters/CorrectedCase.h"
#include "petrous/Presenters/IdentityText.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/LeavingImages.h"
#include "petrous/Scene/FreeName.h"
#include "petrous/Scene/Placement.h"

namespace petrous::workstation
{

namespace fs = std::filesystem;

using presenters::Content;
using presenters::SourceContent;

namespace
{

constexpr int kShowLoading = 300;   // ms
constexpr int kHeldAgain = 50;      // ms
constexpr int kLookForDamage = 500; // ms; images are checked against their hash in another thread

QString nameOf(const fs::path& path)
{
  const auto plain = path.lexically_normal();
  return QFile::decodeName(
      (plain.has_filename() ? plain : plain.parent_path()).filename().string().c_str());
}

// A series by its description, as a folder often holds several.
template <class Source>
QString titleOf(const Source& source)
{
  return source.description.empty()
             ? nameOf(source.path)
             : QString("%1 (%2)").arg(words(source.description), nameOf(source.path));
}

QString lineOf(const SourceContent& source)
{
  return CaseDocumentController::tr("%1 “%2”").arg(phrase(presenters::nameOf(source.content)),
                                                   titleOf(source));
}

// Of the MRs, which are read once they are shown: what their files lack, a sentence each.
std::vector<std::string> lostMrs(const library::Library& library, const scene::Case& value)
{
  if (value.mr.empty())
    return {};
  scene::Case others = value;
  others.mr.clear();
  const std::vector<std::string> known = library.lost(others);
  std::vector<std::string> lost = library.lost(value);
  lost.erase(std::remove_if(lost.begin(), lost.end(),
                            [&known](const std::string& sentence) {
                              return std::find(known.begin(), known.end(), sentence) != known.end();
                            }),
             lost.end());
  return lost;
}

// What the user can do about a scan that cannot be used.
QString remedyOf(const std::vector<imaging::Finding>& findings)
{
  using Kind = imaging::FindingKind;
  const auto isAny = [&findings](std::initializer_list<Kind> kinds)
  {
    return std::any_of(findings.begin(), findings.end(),
                       [&](const imaging::Finding& finding) {
                         return std::find(kinds.begin(), kinds.end(), finding.kind) != kinds.end();
                       });
  };
  if (isAny({Kind::MissingSlice, Kind::UnevenSpacing, Kind::Unreadable, Kind::MissingEnd,
             Kind::MissingBetween}))
    return CaseDocumentController::tr(
        "Copy or send the series again, with all of its slices: Library > Receive fetches it from "
        "the archive. Anatomy that is missing is not made up.");
  if (isAny({Kind::DuplicateSlice, Kind::SideBySide, Kind::OddOrientation, Kind::OddSize,
             Kind::MixedPatients, Kind::MixedStudies, Kind::MixedAcquisitions}))
    return CaseDocumentController::tr(
        "Put the slices of one acquisition of one patient alone into a folder, and open that.");
  return CaseDocumentController::tr("Ask for the original thin slices, or open another series of "
                                    "the patient.");
}

bool isArchive(const fs::path& path)
{
  const QString name = nameOf(path);
  std::error_code ignored;
  return name.endsWith(library::kArchiveEnding, Qt::CaseInsensitive) &&
         fs::is_regular_file(path, ignored);
}

QString megabytes(std::uintmax_t bytes)
{
  return CaseDocumentController::tr("%1 MB").arg(numberText(1e-6 * static_cast<double>(bytes), 1));
}

// "CT, MR “T2”, 12 structures, 1 mesh, 3 strokes, and 1 undone".
QString contentsOf(const scene::Case& value, bool planOnly)
{
  const auto counted = [](std::size_t count, const QString& one, const QString& many)
  { return QString("%1 %2").arg(count).arg(count == 1 ? one : many); };
  QStringList parts;
  if (!planOnly)
  {
    parts += value.ct.modality == scene::Modality::Mr ? CaseDocumentController::tr("MR")
                                                      : CaseDocumentController::tr("CT");
    for (const scene::ImagePart& mr : value.mr)
      parts += CaseDocumentController::tr("MR “%1”").arg(shownName(mr.name));
    std::size_t structures = 0;
    for (const scene::LabelPart& part : value.labels)
      structures += part.structures.size();
    if (structures > 0)
      parts += counted(structures, CaseDocumentController::tr("structure"),
                       CaseDocumentController::tr("structures"));
    if (!value.meshes.empty())
      parts += counted(value.meshes.size(), CaseDocumentController::tr("mesh"),
                       CaseDocumentController::tr("meshes"));
  }
  const std::size_t strokes = value.dissection.strokes().size();
  const std::size_t applied = value.applied();
  const std::size_t undone = value.dissection.history().ahead();
  parts += strokes == 0 ? CaseDocumentController::tr("nothing drilled")
                        : counted(applied, CaseDocumentController::tr("stroke"),
                                  CaseDocumentController::tr("strokes"));
  if (undone > 0)
    parts += CaseDocumentController::tr("and %1 undone").arg(undone);
  if (strokes > applied + undone)
    parts +=
        CaseDocumentController::tr("and %1 of other approaches").arg(strokes - applied - undone);
  QString text = parts.join(", ");
  if (planOnly)
    text += CaseDocumentController::tr(", looks and registrations; no images, structures or "
                                       "meshes: it is restored where the very same CT is");
  return text;
}

// "“a.nrrd”, “b.nrrd”".
QString quotedNames(const std::vector<presenters::PartSource>& sources)
{
  QStringList names;
  for (const presenters::PartSource& source : sources)
    names += CaseDocumentController::tr("“%1”").arg(nameOf(source.path));
  return names.join(", ");
}

std::string unusedName(const std::string& wanted, const std::vector<std::string>& taken)
{
  return scene::freeName(wanted,
                         [&taken](const std::string& name)
                         {
                           return std::any_of(taken.begin(), taken.end(),
                                              [read = scene::asRead(name)](const auto& one)
                                              { return scene::asRead(one) == read; });
                         });
}

// The name under which another program deleted it since it was opened or saved; empty: it did not.
std::string deletedName(const library::Library& library, const scene::Case& value)
{
  try
  {
    return value.revision == 0 ? std::string() : library.deletedName(value.id, value.name);
  }
  catch (const std::exception&) // which is why it is not saved
  {
    return {};
  }
}

} // namespace

CaseDocumentController::CaseDocumentController(presenters::WorkstationModel& model,
                                               CaseSaver& saver, QWidget& window, Banner& unsaved,
                                               Banner& loading, Banner& damaged, Banner& removed)
  : m_model(model)
  , m_saver(saver)
  , m_window(window)
  , m_unsaved(unsaved)
  , m_loading(loading)
  , m_damaged(damaged)
  , m_removed(removed)
{
  connect(&m_work, &BackgroundWork::failed, this,
          [this](const QString& why)
          {
            endWork();
            fail(why);
          });
  connect(&m_work, &BackgroundWork::cancelled, this,
          [this]
          {
            endWork();
            m_model.notOpened();
            emit statusMessage(tr("Stopped; nothing was changed"));
            reopen();
          });
  connect(&m_heldAgain, &QTimer::timeout, this,
          [this]
          {
            if (isDialogOpen())
              return;
            m_heldAgain.stop();
            if (m_held && m_model.hasCase() && m_model.unsaved() && !m_saver.flush())
            {
              m_held = {}; // what the dialog changed is not to be lost
              m_model.notOpened();
              return emit statusMessage(tr("The open case is not saved yet; it stays open"));
            }
            if (const BackgroundWork::Reply reply = std::exchange(m_held, {}))
              take(reply);
          });
  connectBanners();
  watchForDamage();
}

CaseDocumentController::~CaseDocumentController() = default;

void CaseDocumentController::connectBanners()
{
  m_unsaved.addButton("retrySave", tr("Try again"), [this] { save(); });
  m_unsaved.addButton("bringBack", tr("Bring back"), [this] { bringBack(); });
  m_unsaved.addButton("saveAsOther", tr("Save under another name…"), [this] { saveAs(); });
  m_unsaved.addButton("saveElsewhere", tr("Another folder…"),
                      [this]
                      {
                        const QString folder = QFileDialog::getExistingDirectory(
                            &m_window, tr("Library in another folder"));
                        if (folder.isEmpty() || !m_model.hasCase())
                          return;
                        m_sayWhenSaved = true;
                        m_saver.saveElsewhere(pathOf(folder));
                      });
  m_unsaved.addButton("quitUnsaved", tr("Quit without saving"),
                      [this]
                      {
                        m_giveUp = true;
                        m_window.close();
                      });
  m_unsaved.addButton("dismiss", tr("Go on working"),
                      [this]
                      {
                        m_unsaved.hide();
                        m_unsaved.setButtonVisible("quitUnsaved", false);
                      });
  m_unsaved.setButtonVisible("quitUnsaved", false);
  connect(&m_saver, &CaseSaver::failed, this, &CaseDocumentController::notSaved);
  connect(&m_saver, &CaseSaver::saved, this,
          [this](const QString& name)
          {
            m_unsaved.hide();
            m_unsaved.setButtonVisible("quitUnsaved", false);
            const QString why = std::exchange(m_whyNamed, {});
            if (std::exchange(m_sayWhenSaved, false))
              emit statusMessage(why.isEmpty() ? tr("Saved as %1").arg(name) : why);
          });

  m_removed.addButton("restorePart", tr("Put back"), [this] { restorePart(); });
  m_removed.addButton("dismissRemoved", tr("Close"), [this] { m_removed.hide(); });

  m_loading.addButton("loadStructures", tr("Prepare them"), [this] { prepare(); });
  m_loading.addButton("cancelLoading", tr("Cancel"), [this] { m_preparation.cancel(); });
  connect(&m_preparation, &BackgroundWork::progressed, this,
          [this](double fraction, const QString& text, const QString& left)
          {
            m_loading.setText(withTimeLeft(tr("The structures are being prepared: %1, %2 %")
                                               .arg(text)
                                               .arg(numberText(100.0 * fraction, 0)),
                                           left));
          });
  const auto without = [this](const QString& why)
  {
    if (m_prepareAgain)
      return prepare();
    m_loading.setText(why);
    m_loading.setButtonVisible("loadStructures", true);
    m_loading.setButtonVisible("cancelLoading", false);
    m_loading.show();
  };
  connect(&m_preparation, &BackgroundWork::cancelled, this,
          [without]
          {
            without(tr(
                "The structures were not prepared: they are not shown and felt as the list says."));
          });
  connect(&m_preparation, &BackgroundWork::failed, this,
          [without](const QString& why)
          { without(tr("The structures could not be prepared: %1").arg(why)); });
}

void CaseDocumentController::watchForDamage()
{
  m_damaged.addButton("dismissDamage", tr("Close"), [this] { m_damaged.hide(); });
  auto* look = new QTimer(this);
  connect(look, &QTimer::timeout, this, &CaseDocumentController::lookForDamage);
  look->start(kLookForDamage);
}

void CaseDocumentController::notSaved(const QString& why)
{
  m_sayWhenSaved = false;
  m_whyNamed.clear();
  const bool wasDeleted =
      m_model.hasCase() && !deletedName(m_model.library(), m_model.value()).empty();
  m_unsaved.setButtonVisible("retrySave", !wasDeleted);
  m_unsaved.setButtonVisible("bringBack", wasDeleted);
  m_unsaved.setText(
      wasDeleted ? tr("Not saved: another program deleted the case “%1”. Bring it back, or save it "
                      "under another name. The work is still open in this window.")
                       .arg(words(m_model.value().name))
                 : tr("Not saved: %1 The work is still open in this window.").arg(sentence(why)));
  m_unsaved.show();
}

// As it was deleted, and then what is open is saved.
void CaseDocumentController::bringBack()
{
  if (!m_model.hasCase())
    return;
  if (writing())
    return emit statusMessage(tr("One at a time: something is being read already"));
  const std::string id = m_model.value().id;
  const std::string deleted = deletedName(m_model.library(), m_model.value());
  const std::string name = deleted.empty() ? m_model.value().name : deleted;
  m_model.beginOpen(m_model.value().name); // else its journal would count as another program's
  work(tr("Bringing back %1").arg(words(name)),
       [this, name, id,
        library = m_model.library()](const core::Progress&) mutable -> BackgroundWork::Reply
       {
         library.undelete(name, id);
         return [this]
         {
           m_model.notOpened();
           save();
         };
       });
}

void CaseDocumentController::refuse(const QString& why)
{
  QMessageBox box(QMessageBox::Warning, tr("Petrous"), windowText(why), QMessageBox::Ok, &m_window);
  box.setTextInteractionFlags(Qt::TextSelectableByMouse);
  box.exec();
}

// Returns at once; the window waits for the answer.
void CaseDocumentController::inform(const QString& text)
{
  auto* box =
      new QMessageBox(QMessageBox::Information, tr("Petrous"), text, QMessageBox::Ok, &m_window);
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setTextInteractionFlags(Qt::TextSelectableByMouse);
  box->open();
}

void CaseDocumentController::open(const QStringList& what)
{
  open(what, Purpose());
}

void CaseDocumentController::open(const QStringList& what, const Purpose& purpose)
{
  if (what.isEmpty())
    return;
  if (writing())
    return emit statusMessage(tr("One at a time: something is being read already"));
  try
  {
    std::vector<fs::path> paths;
    std::error_code error;
    for (const QString& one : what)
      paths.push_back(pathOf(one));
    const auto archive = std::find_if(paths.begin(), paths.end(), isArchive);
    if (archive != paths.end())
    {
      if (paths.size() > 1 || purpose.content)
        return refuse(
            tr("“%1” is the archive of a whole case; open it alone.").arg(nameOf(*archive)));
      return restore(*archive, {});
    }
    if (what.size() == 1 && !purpose.content &&
        (presenters::namesCase(m_model.library(), bytes(what.front())) ||
         !fs::exists(paths.front(), error)))
      openCase(bytes(what.front()));
    else
      lookAt(paths, purpose);
  }
  catch (const std::exception& fault)
  {
    refuse(toString(fault));
  }
}

// Runs one task with a progress dialog. What it made is taken when no dialog or menu is open:
// one may have been opened before the progress was shown, for the case that is open.
void CaseDocumentController::work(const QString& title, BackgroundWork::Work work, bool changesCase)
{
  endWork();
  m_changing = changesCase ? title : QString();
  m_progress = std::make_unique<QProgressDialog>(title + "…", tr("Cancel"), 0, 1000, &m_window);
  m_progress->setObjectName("importProgress");
  m_progress->setWindowTitle(title);
  m_progress->setWindowModality(Qt::WindowModal);
  m_progress->setMinimumDuration(250);
  m_progress->setMinimumWidth(420);
  m_progress->setAutoClose(false);
  m_progress->setAutoReset(false);
  m_progress->setValue(0);
  // The dialog stays until the task has really stopped.
  disconnect(m_progress.get(), &QProgressDialog::canceled, m_progress.get(),
             &QProgressDialog::cancel);
  connect(m_progress.get(), &QProgressDialog::canceled, this,
          [this]
          {
            m_work.cancel();
            if (m_progress)
              m_progress->setLabelText(tr("Stopping…"));
          });
  connect(&m_work, &BackgroundWork::progressed, m_progress.get(),
          [this, title](double fraction, const QString& text, const QString& left)
          {
            if (!text.isEmpty() || !left.isEmpty())
              m_progress->setLabelText(
                  withTimeLeft((text.isEmpty() ? title : capitalized(text)) + "…", left));
            // Processes events, so the task may end here.
            m_progress->setValue(static_cast<int>(std::lround(1000.0 * fraction)));
          });
  emit working(title);
  try
  {
    m_work.start(
        [this, work = std::move(work)](const core::Progress& progress) -> BackgroundWork::Reply
        {
          return [this, reply = work(progress)]
          {
            endWork();
            if (!m_model.hasCase() || !isDialogOpen())
              return take(reply);
            m_held = reply;
            m_heldAgain.start(kHeldAgain);
          };
        });
  }
  catch (...)
  {
    endWork();
    throw;
  }
}

// A library that cannot be read any more is told like a fault of the task.
void CaseDocumentController::take(const BackgroundWork::Reply& reply)
{
  QString why;
  guarded(reply, [&why](const QString& fault) { why = fault; });
  if (!why.isEmpty())
    fail(why);
}

void CaseDocumentController::fail(const QString& why)
{
  m_model.notOpened();
  refuse(why);
  reopen();
}

// Deferred deletion: it may be processing a progress update.
void CaseDocumentController::endWork()
{
  if (!m_progress)
    return;
  disconnect(&m_work, nullptr, m_progress.get(), nullptr);
  m_progress->cancel(); // hides it, and prevents showing after its minimum duration
  m_progress.release()->deleteLater();
  emit working({});
}

QString CaseDocumentController::changing() const
{
  return m_work.busy() || m_held ? m_changing : QString();
}

void CaseDocumentController::stopWork()
{
  m_work.dropInLoop();
  m_held = {};
  endWork();
}

bool CaseDocumentController::mayStopJobs(const std::function<void()>& again, const QString& what)
{
  const QScopedValueRollback<bool> asking(m_asking, true);
  return !mayDropJobs || mayDropJobs(again, what);
}

// Saves the open case before another one is opened; no tool can be taken up until then.
bool CaseDocumentController::leaveCase()
{
  const QScopedValueRollback<bool> asking(m_asking, true); // no other operation can start meanwhile
  if (mayDropDraft && !mayDropDraft())
    return false;
  m_model.beginLeave(); // all removal is in the case, and no more follows
  if (m_saver.flush())
    return true;
  m_model.notOpened();
  emit statusMessage(tr("The open case is not saved yet; it stays open"));
  return false;
}

void CaseDocumentController::openCase(const std::string& name)
{
  if (writing())
    return emit statusMessage(tr("One at a time: something is being read already"));
  if (m_model.library().folder().empty() ||
      !mayStopJobs([this, name] { openCase(name); },
                   tr("The case is closed, and “%1” is opened,").arg(words(name))) ||
      !leaveCase())
    return;
  m_model.beginOpen(name);
  work(tr("Opening %1").arg(words(name)),
       [this, library = m_model.library(),
        name](const core::Progress& progress) -> BackgroundWork::Reply
       {
         const auto read = std::make_shared<presenters::ReadCase>(
             presenters::ReadCase::from(library, name, progress));
         return [this, read, name]
         {
           m_removed.hide();
           m_model.opened(std::move(*read));
           emit statusMessage(
               tr("Opened %1.  Drag turns the patient, the wheel zooms, D switches to the drill.")
                   .arg(words(name)));
         };
       });
}

void CaseDocumentController::lookAt(const std::vector<fs::path>& paths, const Purpose& purpose)
{
  work(tr("Looking at the files"),
       [this, paths, purpose](const core::Progress& progress) -> BackgroundWork::Reply
       {
         Sources found;
         const auto expected = purpose.content == Content::Mesh ? std::nullopt : purpose.content;
         const auto count = static_cast<double>(paths.size());
         for (const fs::path& path : paths)
         {
           const auto n = static_cast<double>(found.size());
           found.push_back(
               presenters::lookAt(path, progress.part(n / count, (n + 1.0) / count), expected));
         }
         return [this, found = std::move(found), purpose] { decide(found, purpose); };
       });
}

bool CaseDocumentController::chooseSeries(const SourceContent& source, const Purpose& purpose,
                                          std::vector<Item>& items)
{
  if (source.series.empty())
  {
    items.push_back({source, purpose.region});
    return true;
  }
  SeriesDialog dialog(source, m_model.hasCase(), &m_window);
  if (dialog.exec() != QDialog::Accepted)
    return false;
  const std::vector<presenters::SeriesContent> chosen = dialog.chosen();
  const fs::path naming = presenters::namingFolder(chosen, source.series);
  const std::vector<std::optional<core::AxesCorrection>> axes = dialog.axes();
  for (std::size_t n = 0; n < chosen.size(); ++n)
  {
    const presenters::SeriesContent& series = chosen[n];
    Item item{source, purpose.region || dialog.wantsRegion()};
    item.axes = axes[n];
    item.source.selector = series.selector;
    item.source.content = series.content;
    item.source.name = series.name;
    item.source.naming = naming;
    item.source.isTooLarge = source.isTooLarge || series.isTooLarge;
    if (series.isDicom && series.files.empty())
      item.source.description = series.description;
    if (series.verdict == imaging::Verdict::Repairable)
      item.source.repair = series.findings;
    if (source.why.empty())
      item.source.why =
          series.modality.empty() ? "says no modality" : "says modality " + series.modality;
    if (series.files.empty())
      items.push_back(item);
    for (const fs::path& file : series.files)
    {
      item.source.path = file;
      item.region = false;
      item.isSeen = series.isDicom;
      items.push_back(item);
    }
  }
  return true;
}

bool CaseDocumentController::askContent(SourceContent& source)
{
  QMessageBox box(QMessageBox::Question, tr("What is this?"),
                  tr("What is “%1”? It %2.").arg(titleOf(source), phrase(source.why)),
                  QMessageBox::NoButton, &m_window);
  box.setObjectName("askContent");
  const bool open = m_model.hasCase();
  const QString name = open ? words(m_model.value().name) : QString();
  box.setInformativeText(
      open ? tr("A CT or cone beam begins a case of its own; “%1” is saved and stays in the "
                "library.")
                 .arg(name)
           : tr("A case begins with a CT or cone beam, to which an MR can come; with an MR alone "
                "where there is no CT."));
  const QString shown = QString(name).replace('&', "&&"); // in a button
  auto* ct = box.addButton(tr("&CT: a new case"), QMessageBox::ActionRole);
  auto* mr = box.addButton(open ? tr("&MR of “%1”").arg(shown) : tr("&MR: a new case"),
                           QMessageBox::ActionRole);
  const bool file = !fs::is_directory(source.path);
  auto* labels = open && file
                     ? box.addButton(tr("&Structures of “%1”").arg(shown), QMessageBox::ActionRole)
                     : nullptr;
  box.addButton(QMessageBox::Cancel);
  box.exec();
  const QAbstractButton* clicked = box.clickedButton();
  if (!clicked || (clicked != ct && clicked != mr && clicked != labels))
    return false;
  source.content = clicked == ct ? Content::Ct : clicked == mr ? Content::Mr : Content::Labels;
  return true;
}

bool CaseDocumentController::askMrAlone(const SourceContent& source)
{
  QMessageBox box(QMessageBox::Question, tr("A case without a CT?"),
                  tr("There is no CT here. Begin the case with the MR “%1”?").arg(titleOf(source)),
                  QMessageBox::NoButton, &m_window);
  box.setObjectName("askMrAlone");
  box.setInformativeText(tr("Its surface is then where tissue begins, not bone. If there is a CT "
                            "of the patient, open that first, and the MR comes to it."));
  const auto* yes = box.addButton(tr("&Begin with the MR"), QMessageBox::AcceptRole);
  box.setDefaultButton(box.addButton(QMessageBox::Cancel));
  box.exec();
  return box.clickedButton() == yes;
}

bool CaseDocumentController::askRepair(const SourceContent& source)
{
  if (source.repair.empty())
    return true;
  RepairDialog dialog(source, titleOf(source), &m_window);
  if (dialog.exec() == QDialog::Accepted)
    return true;
  if (dialog.wantsAnother())
    QTimer::singleShot(0, this, &CaseDocumentController::openFolder);
  return false;
}

// A scan that would mislead and that no repair can put right.
void CaseDocumentController::refuseSeries(const SourceContent& source)
{
  QMessageBox box(QMessageBox::Warning, tr("The scan cannot be used"),
                  tr("“%1” cannot be used: it would mislead.").arg(titleOf(source)),
                  QMessageBox::NoButton, &m_window);
  box.setTextInteractionFlags(Qt::TextSelectableByMouse);
  box.setObjectName("seriesRefused");
  QStringList lines;
  QStringList details{QFile::decodeName(source.path.c_str()), words(source.selector)};
  for (const imaging::Finding& finding : source.refused)
  {
    lines += QString::fromUtf8("• ") + words(finding.text);
    details += words(imaging::kindName(finding.kind)) + ": " + words(finding.text);
  }
  constexpr int kShown = 4;
  if (lines.size() > kShown)
    lines = lines.mid(0, kShown) << QString::fromUtf8("…");
  lines += "\n" + remedyOf(source.refused);
  box.setInformativeText(lines.join('\n'));
  box.setDetailedText(details.join('\n'));
  const auto* another = box.addButton(tr("Open &another…"), QMessageBox::ActionRole);
  box.setDefaultButton(box.addButton(QMessageBox::Close));
  box.exec();
  if (box.clickedButton() == another)
    QTimer::singleShot(0, this, &CaseDocumentController::openFolder);
}

bool CaseDocumentController::askRegion(Item& item)
{
  if (!item.region && !item.source.isTooLarge)
    return true;
  RegionDialog dialog(item.source.path, item.source.selector, !item.source.repair.empty(),
                      item.assumeRas, item.unit, &m_window,
                      item.axes.value_or(core::AxesCorrection()));
  dialog.setWindowTitle(tr("Region of the %1").arg(lineOf(item.source)));
  if (dialog.exec() != QDialog::Accepted)
    return false;
  item.roi = dialog.region();
  return true;
}

// False: the user gave up, or was told why it cannot be.
bool CaseDocumentController::ask(Item& item, const Purpose& purpose)
{
  SourceContent& source = item.source;
  if (source.content == Content::Image && purpose.content == Content::Mr)
    source.content = Content::Mr;
  if (purpose.content && source.content != *purpose.content)
  {
    refuse(tr("“%1” is no %2: it %3. File > Open takes it for what it is.")
               .arg(titleOf(source), phrase(presenters::nameOf(*purpose.content)),
                    phrase(source.why)));
    return false;
  }
  if (!askRepair(source) || (source.content == Content::Image && !askContent(source)))
    return false;
  if (source.content == Content::Image)
    source.content = Content::Ct;
  return source.content != Content::Ct || askPlace(item);
}

// Side and region of an image: a file's side is needed to picture it.
bool CaseDocumentController::askPlace(Item& item)
{
  if (item.source.isSideOpen)
  {
    item.assumeRas = askSide(item.source.path);
    if (!item.assumeRas)
      return false;
  }
  if (!item.source.unitDoubt.likely.empty())
  {
    item.unit = askUnit(item.source.path, item.source.unitDoubt);
    if (!item.unit)
      return false;
  }
  return askRegion(item);
}

// Names of parts, and consent to add them to the open case. A new case (its name is `newCase`) asks
// only where a file is named after nothing, or a mesh holds several objects.
bool CaseDocumentController::askNames(presenters::CaseSources& sources,
                                      const std::vector<Item>& others, const std::string& newCase)
{
  std::vector<std::string> taken{"ct"};
  std::vector<std::string> mrs;
  if (newCase.empty())
  {
    taken = scene::partNames(m_model.value());
    for (const scene::ImagePart& mr : m_model.value().mr)
      mrs.push_back(mr.name);
  }
  std::vector<std::string> proposed = taken;
  std::vector<AddPartsDialog::Part> parts;
  bool isAsked = newCase.empty();
  for (const Item& item : others)
  {
    const SourceContent& source = item.source;
    AddPartsDialog::Part part;
    part.what = lineOf(source);
    if (!source.structures.empty())
      part.what += ": " + shownName(scene::listed(source.structures));
    part.isPlaced = source.content != Content::Mr;
    if (source.content == Content::Mr)
      part.name = unusedName(source.name.empty() ? "mr" : source.name, proposed);
    else if (source.isNameless || source.content == Content::Mesh)
    {
      const std::string name = presenters::fileName(source.path).name;
      part.objects = source.content == Content::Mesh ? source.structureCount : 0;
      isAsked = isAsked || source.isNameless || part.objects > 1;
      // An empty name asks for one; that of a whole file name is kept as it is.
      part.name = name.empty() || !source.isNameless ? name : unusedName(name, proposed);
    }
    else
    {
      part.isNamed = false;
      part.unnamed = source.unnamed;
      part.count = source.structureCount;
      part.folder = QFile::decodeName(source.path.parent_path().c_str());
      isAsked = isAsked || source.unnamed > 0;
    }
    proposed.push_back(part.name);
    parts.push_back(std::move(part));
  }
  std::vector<AddPartsDialog::Answer> answers;
  if (isAsked)
  {
    const QString name = words(newCase.empty() ? m_model.value().name : newCase);
    const QString primary = newCase.empty() ? presenters::primaryName(m_model.value()) : "CT";
    AddPartsDialog dialog(
        newCase.empty() ? tr("Add to the case “%1”?").arg(name)
                        : tr("Make the case “%1”").arg(name),
        (others.size() == 1 ? tr("It must be of the same patient.%1")
                            : tr("They must be of the same patient.%1"))
            .arg(sources.parts.mr.empty()
                     ? QString()
                     : tr(" An MR is shown over the %1 once it is registered.").arg(primary)),
        newCase.empty() ? tr("&Add to “%1”").arg(QString(name).replace('&', "&&"))
                        : tr("&Make the case"),
        parts, taken, mrs, primary, &m_window);
    if (dialog.exec() != QDialog::Accepted)
      return false;
    answers = dialog.answers();
  }
  else
    for (const AddPartsDialog::Part& part : parts)
      answers.push_back({part.name, {}, {}});
  // A mesh of the name that a label map of the new case gives a structure takes another one, unless
  // the user chose it.
  if (!newCase.empty())
    for (std::size_t n = 0; n < others.size(); ++n)
      if (others[n].source.content == Content::Mesh && answers[n].name == parts[n].name &&
          presenters::fileName(others[n].source.path).isWhole)
        answers[n].name.clear();
  std::size_t next[3] = {0, 0, 0};
  for (std::size_t n = 0; n < others.size(); ++n)
  {
    const Content content = others[n].source.content;
    presenters::PartSource& part = content == Content::Mr     ? sources.parts.mr[next[0]++]
                                   : content == Content::Mesh ? sources.parts.meshes[next[1]++]
                                                              : sources.parts.labels[next[2]++];
    part.name = answers[n].name;
    part.drawnOn = answers[n].drawnOn;
    part.labelNames = answers[n].labelNames;
    part.isPerObject = answers[n].isPerObject;
  }
  return true;
}

void CaseDocumentController::decide(const Sources& found, const Purpose& purpose)
{
  std::vector<Item> items;
  {
    const QScopedValueRollback<bool> asking(m_asking, true);
    for (const SourceContent& source : found)
      if (!chooseSeries(source, purpose, items))
        return;
  }
  if (std::all_of(items.begin(), items.end(), [](const Item& item) { return item.isSeen; }))
    decide(std::move(items), purpose);
  else
    lookAtChosen(std::move(items), purpose);
}

// What the files beside a series hold.
void CaseDocumentController::lookAtChosen(std::vector<Item> items, const Purpose& purpose)
{
  work(tr("Looking at the files"),
       [this, items = std::move(items),
        purpose](const core::Progress& progress) mutable -> BackgroundWork::Reply
       {
         const auto count = static_cast<double>(items.size());
         double n = 0.0;
         for (Item& item : items)
         {
           const core::Progress part = progress.part(n / count, (n + 1.0) / count);
           n += 1.0;
           if (item.isSeen)
             continue;
           const bool isMesh = item.source.content == Content::Mesh;
           item.source = presenters::lookAt(item.source.path, part,
                                            isMesh ? std::nullopt : std::optional(Content::Labels));
           item.isSeen = true;
         }
         return [this, items = std::move(items), purpose] { decide(items, purpose); };
       });
}

void CaseDocumentController::decide(std::vector<Item> items, const Purpose& purpose)
{
  const QScopedValueRollback<bool> asking(m_asking, true);
  std::vector<Item> others;
  const SourceContent* ct = nullptr;
  presenters::CaseSources sources;
  for (Item& item : items)
  {
    const bool isPart = items.size() > 1 && item.source.content == Content::Mr;
    if (!item.source.refused.empty() && !isPart) // the others are added without it
      return refuseSeries(item.source);
    const bool isUndetermined = item.source.content == Content::Image;
    if (!ask(item, purpose))
      return;
    const SourceContent& source = item.source;
    const bool repair = !source.repair.empty();
    switch (source.content)
    {
    case Content::Ct:
    case Content::Image:
      if (ct)
        return refuse(tr("“%1” and “%2” are both CTs, and a case has one; open them one after the "
                         "other.")
                          .arg(titleOf(*ct), titleOf(source)));
      ct = &source;
      if (isUndetermined) // the user said so
        sources.modality = scene::Modality::Ct;
      sources.ct = source.path;
      sources.series = source.selector;
      sources.repair = repair;
      sources.roi = item.roi;
      sources.assumeRas = item.assumeRas;
      sources.unit = item.unit;
      sources.axes = item.axes.value_or(core::AxesCorrection());
      continue;
    case Content::Mr:
      sources.parts.mr.push_back({{}, source.path, {}, source.selector, repair});
      sources.parts.mr.back().description = source.description;
      sources.parts.mr.back().axes = item.axes;
      break;
    case Content::Labels:
      sources.parts.labels.push_back({{}, source.path});
      sources.parts.labels.back().axes = item.axes;
      break;
    case Content::Mesh:
      sources.parts.meshes.push_back({{}, source.path});
      sources.parts.meshes.back().axes = item.axes;
      break;
    }
    others.push_back(item);
  }
  QStringList what;
  for (const Item& item : others)
    what += lineOf(item.source);
  if (!ct && !m_model.hasCase())
  {
    const auto mr =
        std::find_if(others.begin(), others.end(),
                     [](const Item& item) { return item.source.content == Content::Mr; });
    if (mr == others.end())
      return refuse(tr("A case begins with a CT, and there is none here: %1. Open the patient's CT "
                       "first, then this.")
                        .arg(what.join(", ")));
    if (!askMrAlone(mr->source))
      return;
    if (!askPlace(*mr))
      return;
    sources.assumeRas = mr->assumeRas;
    sources.unit = mr->unit;
    sources.roi = mr->roi;
    sources.axes = mr->axes.value_or(core::AxesCorrection());
    ct = &mr->source;
    sources.modality = scene::Modality::Mr;
    sources.ct = mr->source.path;
    sources.series = mr->source.selector;
    sources.repair = !mr->source.repair.empty();
    sources.parts.mr.erase(sources.parts.mr.begin()); // the first of them
    const Item first = *mr;
    others.erase(mr);
    items = {first};
    ct = &items.front().source;
  }
  std::size_t next = 0; // of the MRs
  for (Item& item : others)
    if (item.source.content == Content::Mr)
    {
      presenters::PartSource& part = sources.parts.mr[next++];
      if (!item.region && !item.source.isTooLarge)
        continue;
      if (!askPlace(item))
        return;
      part.roi = item.roi;
      part.assumeRas = item.assumeRas;
      part.unit = item.unit;
    }
  const std::string name =
      ct ? presenters::freeCaseName(
               m_model.library(),
               presenters::caseNameFrom(ct->naming.empty() ? ct->path : ct->naming))
         : std::string();
  if (!askNames(sources, others, name) || (!ct && !askTaken(sources.parts, others)))
    return;
  if (ct)
    makeCase(name, [sources](const core::Progress&) { return sources; });
  else
    addParts(sources.parts, what.join(", "));
}

void CaseDocumentController::makeCase(
    const std::string& name, std::function<presenters::CaseSources(const core::Progress&)> sources,
    scene::Side side)
{
  if (!leaveCase())
    return;
  m_model.notOpened(); // it stays usable while the other one is made
  work(
      tr("Making the case %1").arg(words(name)),
      [this, name, side, library = m_model.library(),
       sources = std::move(sources)](const core::Progress& progress) -> BackgroundWork::Reply
      {
        double reached = 0.0; // a quick preparation does not count as half of the work
        const core::Progress first(
            [&](double fraction, const std::string& text)
            {
              reached = 0.5;
              progress.report(0.5 * fraction, text);
            });
        auto from = sources(first);
        const presenters::PartSources parts = std::exchange(from.parts, {});
        const double image = reached + 0.5 * (1.0 - reached);
        auto value = std::make_shared<scene::Case>();
        try
        {
          *value = presenters::buildCase(name, from, progress.part(reached, image));
        }
        catch (const imaging::BitsUnclearError& error)
        {
          from.parts = parts;
          // `sources` keeps the folder of what it made until that is read.
          return [this, name, side, sources, from, error]() mutable
          {
            const auto bits = askBits(error.what(), error.canKeep);
            if (!bits)
              return reopen();
            from.undeclaredBits = *bits;
            makeCase(
                name, [from, sources](const core::Progress&) { return from; }, side);
          };
        }
        value->description.side = side;
        std::vector<presenters::StructureReport> report;
        const auto failures =
            presenters::addSoundParts(*value, parts, progress.part(image, 1.0), &report);
        // A folder is often named after the patient, and the case's name goes wherever it goes.
        const bool isPatients = presenters::IdentityText(*value).mayIdentify(name);
        if (isPatients)
          value->name = presenters::freeCaseName(library, "case");
        const QString what = quotedNames(parts.labels);
        return [this, value, failures, report, isPatients, what]() mutable
        {
          const QString named = words(value->name);
          if (askOutside(report, what) != Outside::Added)
            presenters::leaveOutside(*value, report);
          const bool isShown = adopt(std::move(*value));
          if (isPatients)
          {
            const QString why = tr("The case is called “%1”: the name of its folder was not taken, "
                                   "as it may be the patient's; F2 in the library, or Save as…, "
                                   "gives it another one")
                                    .arg(named);
            emit statusMessage(why);
            m_whyNamed = isShown ? why : QString(); // again in place of “Saved as”
          }
          // Where it could only be kept, the case that stays open is another one.
          tell(failures, report, {isShown ? m_model.shownAs() : 0, named});
        };
      },
      true);
}

// False: the open one stays, and `value` is kept in the library.
bool CaseDocumentController::adopt(scene::Case value)
{
  // A device may have drilled meanwhile, or neither a draft nor a job is to be lost.
  if (!mayStopJobs() || !leaveCase())
  {
    keepInLibrary(std::move(value));
    return false;
  }
  try
  {
    m_model.adopt(std::move(value));
  }
  catch (...)
  {
    m_model.notOpened();
    throw;
  }
  m_removed.hide();
  m_sayWhenSaved = true;
  m_saver.save();
  emit statusMessage(tr("Saving %1 in the library…").arg(words(m_model.value().name)));
  return true;
}

// A case that cannot be opened now: building it may have taken minutes.
void CaseDocumentController::keepInLibrary(scene::Case value)
{
  const auto kept = std::make_shared<scene::Case>(std::move(value));
  work(tr("Saving %1 in the library…").arg(words(kept->name)),
       [this, kept, library = m_model.library()](
           const core::Progress& progress) mutable -> BackgroundWork::Reply
       {
         library.save(*kept, progress);
         return [this, kept]
         {
           emit statusMessage(tr("%1 is in the library; %2 stays open")
                                  .arg(words(kept->name), words(m_model.value().name)));
         };
       });
}

void CaseDocumentController::addParts(const presenters::PartSources& parts, const QString& what,
                                      const std::vector<presenters::StructureReport>& earlier)
{
  m_model.stopTouch();
  const auto value = std::make_shared<scene::Case>(m_model.value()); // shares voxels
  work(
      tr("Adding to %1").arg(words(value->name)),
      [this, value, before = scene::Case(*value), parts, what, earlier, library = m_model.library(),
       shownAs = m_model.shownAs()](const core::Progress& progress) -> BackgroundWork::Reply
      {
        presenters::PartSources sources = parts;
        sources.salted = library::frameSalter(library);
        std::vector<presenters::StructureReport> report;
        const auto failures = presenters::addSoundParts(*value, sources, progress, &report);
        const bool onlyImages = parts.labels.empty() && parts.meshes.empty();
        const bool isAny =
            failures.size() < parts.mr.size() + parts.labels.size() + parts.meshes.size();
        const bool onlyLabels = parts.mr.empty() && parts.meshes.empty();
        const QString labels = quotedNames(parts.labels);
        return [this, value, before, what, labels, shownAs, onlyImages, onlyLabels, isAny, failures,
                report, earlier]() mutable
        {
          const Target target{shownAs, words(before.name)};
          const Outside outside = isAny ? askOutside(report, labels) : Outside::Added;
          const bool isLeft = outside == Outside::AllLeft && onlyLabels;
          if (outside != Outside::Added)
            presenters::leaveOutside(*value, report);
          if (!isOpen(target))
            return refuse(
                tr("%1 was not added: the case “%2” is not open any more.").arg(what, target.name));
          if (isLeft)
            emit statusMessage(tr("Not added: %1").arg(what));
          else if (isAny)
          {
            const QString name = words(m_model.value().name);
            m_model.takeParts(before, std::move(*value));
            m_saver.save();
            emit added(onlyImages);
            emit statusMessage(
                report.empty() ? tr("Added to %1: %2").arg(name, what)
                               : tr("Added to %1: %2; %3")
                                     .arg(name, what, phrase(presenters::summaryOf(report).text)));
          }
          std::vector<presenters::StructureReport> all = earlier;
          all.insert(all.end(), report.begin(), report.end());
          tell(failures, all, target);
        };
      },
      true);
}

// What becomes of structures that lie wholly outside of the image: of another patient, or another
// place. `what`: quotedNames of their files.
CaseDocumentController::Outside
CaseDocumentController::askOutside(const std::vector<presenters::StructureReport>& report,
                                   const QString& what)
{
  using Status = presenters::StructureReport::Status;
  constexpr int kNamed = 8;
  int read = 0;
  QStringList outside;
  for (const presenters::StructureReport& one : report)
  {
    read += one.status == Status::Read ? 1 : 0;
    if (one.status == Status::Read && one.isOutside)
      outside += shownName(one.name);
  }
  if (outside.isEmpty())
    return Outside::Added;
  const bool isAll = outside.size() == read;
  const QScopedValueRollback<bool> asking(m_asking, true);
  QMessageBox box(
      QMessageBox::Warning, tr("Another place?"),
      read == 1 ? tr("The structure of %1 lies outside the image of this case: nothing of it will "
                     "be seen or felt.")
                      .arg(what)
      : isAll ? tr("None of the %2 structures of %1 lies in the image of this case: nothing of "
                   "them will be seen or felt.")
                    .arg(what, QString::number(read))
      : outside.size() == 1
          ? tr("1 of the %2 structures of %1 lies outside the image of this case: nothing of it "
               "will be seen or felt.")
                .arg(what, QString::number(read))
          : tr("%3 of the %2 structures of %1 lie outside the image of this case: nothing of "
               "them "
               "will be seen or felt.")
                .arg(what, QString::number(read), QString::number(outside.size())),
      QMessageBox::NoButton, &m_window);
  box.setObjectName("askOutside");
  QString more = tr("They may be another patient's, or of another scan.");
  if (!isAll)
    more = outside.mid(0, kNamed).join(", ") +
           (outside.size() > kNamed ? QString::fromUtf8(" …") : QString()) + "\n\n" + more;
  box.setInformativeText(more);
  auto* leave = isAll ? box.addButton(tr("Do &not add"), QMessageBox::RejectRole)
                      : box.addButton(tr("Add the &others only"), QMessageBox::RejectRole);
  auto* add = isAll ? box.addButton(tr("&Add anyway"), QMessageBox::AcceptRole)
                    : box.addButton(tr("&Add all"), QMessageBox::AcceptRole);
  box.setDefaultButton(leave);
  box.setEscapeButton(leave);
  box.exec();
  return box.clickedButton() == add ? Outside::Added : isAll ? Outside::AllLeft : Outside::Left;
}

// What did not come into the case, and structures that are not as their file says. Parts are added
// on an answer only to the case for which it was asked: another one may be open by then. One box at
// a time: what structures are like is told when nothing is left to ask.
void CaseDocumentController::tell(const std::vector<presenters::PartFailure>& failures,
                                  const std::vector<presenters::StructureReport>& report,
                                  const Target& target)
{
  presenters::PartSources again; // of all answers: reading one ends the reading of another
  QStringList names;
  QStringList lost;
  QStringList left; // by the user
  {
    const QScopedValueRollback<bool> asking(m_asking, true);
    for (const presenters::PartFailure& failure : failures)
    {
      const bool isQuestion = !failure.likely.empty() || failure.isOtherPatient ||
                              failure.isSideUnclear || failure.isFrameUnclear ||
                              failure.isBitsUnclear || !failure.unitDoubt.likely.empty() ||
                              failure.unrepaired > 0.0 || !failure.taken.empty();
      if (!isQuestion || !isOpen(target))
        lost += phrase(failure.why);
      else if (const auto source = askAgain(failure, target))
      {
        (again.*failure.kind).push_back(*source);
        names += titleOf(*source);
      }
      else
        left += titleOf(failure.source);
    }
  }
  refuseAll(lost);
  if (!left.isEmpty())
    emit statusMessage(tr("Not added: “%1”").arg(left.join("”, “")));
  if (!names.isEmpty() && isOpen(target) && !m_work.busy())
    return addParts(again, names.join(", "), report);
  const QString which = names.join(", ");
  if (!names.isEmpty())
    refuse(
        isOpen(target)
            ? tr("%1 was not added, as something else is being read; add it again.").arg(which)
            : tr("%1 was not added: the case “%2” is not open any more.").arg(which, target.name));
  tellStructures(report);
}

bool CaseDocumentController::isOpen(const Target& target) const
{
  return m_model.hasCase() && m_model.shownAs() == target.shownAs;
}

void CaseDocumentController::refuseAll(const QStringList& whys)
{
  constexpr int kShown = 6;
  if (whys.size() <= 1)
    return whys.isEmpty() ? void() : refuse(whys.front());
  QStringList lines;
  for (const QString& why : whys)
    lines += sentence(windowText(why));
  QMessageBox box(QMessageBox::Warning, tr("Petrous"),
                  tr("%1 files were not added.").arg(lines.size()), QMessageBox::Ok, &m_window);
  box.setObjectName("notAdded");
  box.setTextInteractionFlags(Qt::TextSelectableByMouse);
  box.setInformativeText(lines.mid(0, kShown).join("\n\n"));
  if (lines.size() > kShown)
    box.setDetailedText(lines.join("\n"));
  box.exec();
}

void CaseDocumentController::tellStructures(const std::vector<presenters::StructureReport>& report)
{
  using Status = presenters::StructureReport::Status;
  constexpr double kTolerance = 0.05; // of the volume by the file
  QStringList lines;
  bool isWhole = true;
  for (const presenters::StructureReport& one : report)
  {
    const auto error = one.volumeError();
    // What is empty is said with the notes.
    isWhole = isWhole && one.status != Status::Unread && (!error || std::abs(*error) <= kTolerance);
    QString line = shownName(one.name) + ": " + phrase(presenters::nameOf(one.status));
    if (one.status == Status::Read)
      line += ", " + numberText(one.volume, 1) + " mm³";
    if (one.fileVolume)
      line += tr(" (%1 mm³ by the file)").arg(numberText(*one.fileVolume, 1));
    if (!one.why.empty())
      line += ", " + phrase(one.why);
    lines += line;
  }
  if (isWhole)
    return;
  auto* box =
      new QMessageBox(QMessageBox::Warning, tr("Structures"),
                      phrase(presenters::summaryOf(report).text) + ".", QMessageBox::Ok, &m_window);
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setObjectName("structuresRead");
  box->setInformativeText(tr("Not all are as the file has them."));
  box->setDetailedText(lines.join("\n"));
  box->setModal(false);
  box->show();
}

// What the user says of a part that could not be added without; nullopt: it is left out.
std::optional<presenters::PartSource>
CaseDocumentController::askAgain(const presenters::PartFailure& failure, const Target& target)
{
  presenters::PartSource source = failure.source;
  if (failure.isOtherPatient)
  {
    if (!askOtherPatient(failure, target))
      return std::nullopt;
    source.isOtherPatient = true;
  }
  else if (failure.isSideUnclear)
  {
    source.assumeRas = askSide(source.path);
    if (!source.assumeRas)
      return std::nullopt;
  }
  else if (!failure.unitDoubt.likely.empty())
  {
    source.unit = askUnit(source.path, failure.unitDoubt);
    if (!source.unit)
      return std::nullopt;
  }
  else if (failure.isBitsUnclear)
  {
    const auto bits = askBits(failure.why, failure.canKeepBits);
    if (!bits)
      return std::nullopt;
    source.undeclaredBits = *bits;
  }
  else if (failure.isFrameUnclear)
  {
    if (!askDrawnOn(source))
      return std::nullopt;
  }
  else if (failure.unrepaired > 0.0)
  {
    if (!askAsTheyLie(failure))
      return std::nullopt;
    source.asTheyLie = true;
  }
  else if (!failure.taken.empty())
  {
    if (!askNewNames(source, failure.taken, failure.others))
      return std::nullopt;
  }
  else
  {
    const auto space = askMeshSpace(failure);
    if (!space)
      return std::nullopt;
    source.isRas = space->isRas;
    source.unit = space->mm;
  }
  return source;
}

// The unit of length (mm) of a file in whose own one it makes no sense; nullopt: the user does not
// know.
std::optional<double> CaseDocumentController::askUnit(const fs::path& path,
                                                      const imaging::UnitDoubt& doubt)
{
  const QScopedValueRollback<bool> asking(m_asking, true);
  const QString edge = numberText(presenters::lengthText(doubt.edge));
  QMessageBox box(QMessageBox::Question, tr("How large is it?"),
                  doubt.isStated ? tr("By the unit of length that “%1” states, it is %2 mm long: "
                                      "no head, ear or specimen.")
                                       .arg(nameOf(path), edge)
                                 : tr("“%1” states no unit of length, and in millimetres it is %2 "
                                      "mm long: no head, ear or "
                                      "specimen.")
                                       .arg(nameOf(path), edge),
                  QMessageBox::NoButton, &m_window);
  box.setObjectName("askUnit");
  box.setInformativeText(tr("In which unit are its numbers? Every distance, tool and thickness "
                            "follows this answer. Export the file again with its unit if you do "
                            "not know it."));
  std::vector<std::pair<const QAbstractButton*, double>> units;
  std::vector<double> choices = doubt.likely;
  choices.push_back(doubt.unit); // a phantom may be of any size
  for (const double unit : choices)
    units.emplace_back(
        box.addButton((doubt.isStated && unit == doubt.unit
                           ? tr("In %1, as the file says: %2 mm long")
                           : tr("In %1: %2 mm long"))
                          .arg(words(presenters::unitName(unit)))
                          .arg(numberText(presenters::lengthText(doubt.edge * unit / doubt.unit))),
                      QMessageBox::ActionRole),
        unit);
  box.setDefaultButton(box.addButton(QMessageBox::Cancel));
  box.exec();
  for (const auto& [button, unit] : units)
    if (box.clickedButton() == button)
      return unit;
  return std::nullopt;
}

std::optional<imaging::UndeclaredBits> CaseDocumentController::askBits(const std::string& why,
                                                                       bool canKeep)
{
  const QScopedValueRollback<bool> asking(m_asking, true);
  QMessageBox box(QMessageBox::Warning, tr("What are these bits?"),
                  tr("The scan contradicts itself about the bits of a pixel."),
                  QMessageBox::NoButton, &m_window);
  box.setTextInteractionFlags(Qt::TextSelectableByMouse);
  box.setObjectName("askBits");
  box.setInformativeText(
      sentence(phrase(why)) + "\n\n" +
      tr("A wrong answer shows metal as tissue, or tissue as metal, where these pixels are. Answer "
         "only if the values tell; otherwise export the scan again."));
  const auto* left = box.addButton(tr("&Leave the bits out"), QMessageBox::ActionRole);
  auto* kept = box.addButton(tr("&Keep the bits"), QMessageBox::ActionRole);
  kept->setEnabled(canKeep); // `why` says why not
  box.setDefaultButton(box.addButton(QMessageBox::Cancel));
  box.exec();
  if (box.clickedButton() == left)
    return imaging::UndeclaredBits::LeaveOut;
  if (box.clickedButton() == kept)
    return imaging::UndeclaredBits::Keep;
  return std::nullopt;
}

// Whether the axes of a file that leaves it open are RAS; nullopt: the user does not know.
std::optional<bool> CaseDocumentController::askSide(const fs::path& path)
{
  QMessageBox box(QMessageBox::Warning, tr("Which side is left?"),
                  tr("“%1” does not say which side of the patient is left. How do its axes run?")
                      .arg(nameOf(path)),
                  QMessageBox::NoButton, &m_window);
  box.setObjectName("askSide");
  box.setInformativeText(
      tr("A wrong answer turns it by half a turn: what is left is then shown on the right, and "
         "what is in front at the back, and nothing in the picture has to look odd. Answer only "
         "if you know it; otherwise export the file again together with its geometry."));
  const auto* lps =
      box.addButton(tr("To the &left and back (LPS: DICOM, ITK)"), QMessageBox::ActionRole);
  const auto* ras =
      box.addButton(tr("To the &right and front (RAS: NIfTI, Slicer)"), QMessageBox::ActionRole);
  box.setDefaultButton(box.addButton(QMessageBox::Cancel));
  box.exec();
  if (box.clickedButton() == lps || box.clickedButton() == ras)
    return box.clickedButton() == ras;
  return std::nullopt;
}

// On which image structures were drawn, or that they lie where they belong. False: the user does
// not know.
bool CaseDocumentController::askDrawnOn(presenters::PartSource& source)
{
  const QString primary = presenters::primaryName(m_model.value());
  const auto isCorrected = [](const scene::ImagePart& image)
  { return !image.provenance.axes.isIdentity(); };
  const scene::Case& value = m_model.value();
  const bool hasCorrected =
      isCorrected(value.ct) || std::any_of(value.mr.begin(), value.mr.end(), isCorrected);
  QMessageBox box(QMessageBox::Question, tr("On which image was it drawn?"),
                  (hasCorrected
                       ? tr("“%1” does not tell in which space of an image of this case it lies.")
                       : tr("“%1” was drawn in another frame of reference than the images of this "
                            "case."))
                      .arg(titleOf(source)),
                  QMessageBox::NoButton, &m_window);
  box.setObjectName("askDrawnOn");
  box.setInformativeText(
      (hasCorrected
           ? tr("The axes of an image were corrected. What was drawn on it as its file states it "
                "follows the correction; what lies where it belongs already, such as an export of "
                "this case, stays.") +
                 "\n\n"
           : QString()) +
      tr("It may have been drawn on another scan of the patient, and would then lie in the wrong "
         "place. Where another program or library gave this very %1 new identifiers, it lies "
         "where it belongs. Look at the slices afterwards.")
          .arg(primary));
  std::vector<std::pair<const QAbstractButton*, std::string>> images;
  images.emplace_back(box.addButton(tr("On the &%1").arg(primary), QMessageBox::ActionRole), "ct");
  for (const scene::ImagePart& mr : value.mr)
    images.emplace_back(box.addButton(tr("On %1").arg(shownName(mr.name).replace('&', "&&")),
                                      QMessageBox::ActionRole),
                        mr.name);
  const QAbstractButton* stays =
      hasCorrected ? box.addButton(tr("&Leave it where it is"), QMessageBox::ActionRole) : nullptr;
  box.setDefaultButton(box.addButton(QMessageBox::Cancel));
  box.exec();
  if (stays && box.clickedButton() == stays)
  {
    source.drawnOn = "ct";
    source.axes = core::AxesCorrection();
    return true;
  }
  for (const auto& [button, name] : images)
    if (box.clickedButton() == button)
    {
      source.drawnOn = name;
      return true;
    }
  return false;
}

// Whether structures that may have been drawn on the slices before the repair of the CT are added
// where they lie.
bool CaseDocumentController::askAsTheyLie(const presenters::PartFailure& failure)
{
  QMessageBox box(
      QMessageBox::Warning, tr("Does it lie where it belongs?"),
      tr("“%1” has another grid than the CT, which was repaired.").arg(titleOf(failure.source)),
      QMessageBox::NoButton, &m_window);
  box.setObjectName("askAsTheyLie");
  box.setInformativeText(
      tr("Drawn on the slices as they lie in the files, by a program that takes them for straight "
         "and even, it lies up to %1 mm off the bone. How each slice was moved is not known of it, "
         "so that it cannot follow the repair: export the repaired CT and draw it there. What was "
         "drawn on the repaired CT, or where each slice really lies, fits.")
          .arg(numberText(failure.unrepaired, 1)));
  const auto* add = box.addButton(tr("&Add it as it lies"), QMessageBox::ActionRole);
  box.setDefaultButton(box.addButton(QMessageBox::Cancel));
  box.exec();
  return box.clickedButton() == add;
}

// Parts of a file that have names of the case: what they are called here, or whether the others
// come without them. False: the file is left out.
bool CaseDocumentController::askNewNames(presenters::PartSource& source,
                                         const std::vector<std::string>& taken, std::size_t others)
{
  std::vector<std::string> there = scene::partNames(m_model.value());
  there.emplace_back("ct");
  std::vector<std::string> proposed = there;
  std::vector<AddPartsDialog::Part> parts;
  for (const std::string& name : taken)
  {
    AddPartsDialog::Part part;
    part.what = shownName(name);
    part.name = unusedName(presenters::shownName(name), proposed);
    proposed.push_back(part.name);
    parts.push_back(std::move(part));
  }
  QString more = tr("Those of the case stay as they are.");
  if (others > 0)
    more += ' ' + (others == 1
                       ? tr("1 other structure of the file is new to the case.")
                       : tr("%1 other structures of the file are new to the case.").arg(others));
  AddPartsDialog dialog(
      taken.size() == 1
          ? tr("The case has “%1” already, which is in “%2”, too. What is it to be called?")
                .arg(parts.front().what, nameOf(source.path))
          : tr("The case has parts of %1 of the names in “%2” already. What are they to be called?")
                .arg(taken.size())
                .arg(nameOf(source.path)),
      more, taken.size() == 1 ? tr("&Add under this name") : tr("&Add under these names"), parts,
      there, {}, {}, &m_window,
      others == 0         ? QString()
      : taken.size() == 1 ? tr("Add the &others without it")
                          : tr("Add the &others without them"));
  dialog.setObjectName("askNewNames");
  const int answer = dialog.exec();
  if (answer == AddPartsDialog::kSkipped)
    source.skipsTaken = true;
  else if (answer == QDialog::Accepted)
    for (std::size_t n = 0; n < taken.size(); ++n)
      source.newNames[taken[n]] = dialog.answers()[n].name;
  return answer != QDialog::Rejected;
}

// Asks of folders of masks, whose names are known, before they are read. False: the user gave up.
bool CaseDocumentController::askTaken(presenters::PartSources& parts,
                                      const std::vector<Item>& others)
{
  std::size_t next = 0; // of the labels
  for (const Item& item : others)
  {
    if (item.source.content != Content::Labels)
      continue;
    presenters::PartSource& part = parts.labels[next++];
    std::vector<std::string> taken;
    for (const std::string& name : item.source.structures)
      if (!scene::partReadAs(m_model.value(), name).empty())
        taken.push_back(name);
    if (taken.empty() || item.source.structures.size() < 2)
      continue; // told when it is added
    if (!askNewNames(part, taken, item.source.structures.size() - taken.size()))
      return false;
  }
  return true;
}

bool CaseDocumentController::askOtherPatient(const presenters::PartFailure& failure,
                                             const Target& target)
{
  QMessageBox box(QMessageBox::Warning, tr("Another patient?"),
                  tr("“%1” states another patient than the images of “%2” do. What differs: %3.")
                      .arg(titleOf(failure.source), target.name, phrase(failure.differing)),
                  QMessageBox::NoButton, &m_window);
  box.setObjectName("askOtherPatient");
  box.setInformativeText(
      tr("Of another patient, it would put an anatomy into the picture that is not this one's, and "
         "the plan would be wrong where it counts. Look at the files first. Add it only if you "
         "know that it is this patient's, as where one of the files was de-identified or the "
         "patient's name was changed; a note in the case will say so."));
  const auto* add = box.addButton(tr("It is this &patient's: add it"), QMessageBox::ActionRole);
  box.setDefaultButton(box.addButton(QMessageBox::Cancel));
  box.exec();
  return box.clickedButton() == add;
}

std::optional<imaging::MeshSpace>
CaseDocumentController::askMeshSpace(const presenters::PartFailure& failure)
{
  QMessageBox box(
      QMessageBox::Question, tr("Coordinates of a mesh"),
      tr("Which coordinate system does the mesh “%1” use?").arg(nameOf(failure.source.path)),
      QMessageBox::NoButton, &m_window);
  box.setObjectName("askMeshSpace");
  box.setInformativeText(phrase(failure.why));
  std::vector<QAbstractButton*> buttons;
  for (const imaging::MeshSpace& space : failure.likely)
    buttons.push_back(box.addButton(tr("Add as &%1").arg(phrase(presenters::coordinatesOf(space))),
                                    QMessageBox::ActionRole));
  box.setDefaultButton(box.addButton(QMessageBox::Cancel));
  box.exec();
  const auto chosen = std::find(buttons.begin(), buttons.end(), box.clickedButton());
  if (chosen == buttons.end())
    return std::nullopt;
  return failure.likely[static_cast<std::size_t>(chosen - buttons.begin())];
}

// Not while parts are being added to a copy of the case, or another case is coming.
bool CaseDocumentController::changeParts(const std::function<void()>& change)
{
  if (!m_model.hasCase() || m_model.drilling())
    return false;
  if (writing())
  {
    emit statusMessage(tr("One at a time: something is being read already"));
    return false;
  }
  try
  {
    change();
  }
  catch (const std::exception& fault)
  {
    refuse(toString(fault));
    return false;
  }
  m_removed.setVisible(!m_model.removedPart().empty());
  m_removed.setText(tr("“%1” was taken out of the case. Until the case is closed it can be put "
                       "back.")
                        .arg(shownName(m_model.removedPart())));
  m_saver.save();
  return true;
}

void CaseDocumentController::removePart(const std::string& name)
{
  if (changeParts([this, &name] { m_model.removePart(name); }))
    emit statusMessage(tr("“%1” was taken out of the case").arg(shownName(name)));
}

void CaseDocumentController::restorePart()
{
  const std::string name = m_model.removedPart();
  if (!name.empty() && changeParts([this] { m_model.restorePart(); }))
    emit statusMessage(tr("“%1” is in the case again").arg(shownName(name)));
}

void CaseDocumentController::renamePart(const std::string& name)
{
  if (!m_model.hasCase())
    return;
  if (writing())
    return emit statusMessage(tr("One at a time: something is being read already"));
  const QScopedValueRollback<bool> asking(m_asking, true);
  const std::string to =
      bytes(askName(m_window, tr("Rename"), tr("New name of “%1”:").arg(words(name)), words(name),
                    [this, &name](const std::string& wanted)
                    {
                      if (m_model.hasCase() && wanted != name)
                        scene::checkNewPartName(m_model.value(), name, wanted);
                    }));
  m_asking = false;
  if (!to.empty() && to != name &&
      changeParts([this, &name, &to] { m_model.renamePart(name, to); }))
    emit statusMessage(tr("“%1” is called “%2” now").arg(shownName(name), shownName(to)));
}

void CaseDocumentController::correctAxes(const std::string& part)
{
  if (!m_model.hasCase())
    return;
  if (writing())
    return emit statusMessage(tr("One at a time: something is being read already"));
  core::AxesCorrection axes;
  const std::uint64_t shown = m_model.shownAs();
  try
  {
    const QScopedValueRollback<bool> asking(m_asking, true);
    AxesDialog dialog(m_model.value(), &m_window, part);
    if (dialog.exec() != QDialog::Accepted || !m_model.hasCase() || m_model.shownAs() != shown)
      return;
    axes = dialog.axes();
  }
  catch (const std::exception& fault)
  {
    return refuse(toString(fault));
  }
  if (changeParts([&] { m_model.correctAxes(part, axes); }))
    emit statusMessage(tr("The axes of “%1” are corrected").arg(shownName(part)));
}

// One at a time. A request during a run cancels and repeats it, without waiting.
void CaseDocumentController::prepare()
{
  m_prepareAgain = m_preparation.busy();
  if (m_prepareAgain)
    return m_preparation.cancel();
  m_loading.hide();
  m_loading.setButtonVisible("loadStructures", false);
  m_loading.setButtonVisible("cancelLoading", true);
  if (!m_model.preparationHelps())
    return;
  m_loading.setText(tr("The structures are being prepared…"));
  QTimer::singleShot(kShowLoading, this,
                     [this]
                     {
                       if (m_preparation.busy())
                         m_loading.show();
                     });
  m_preparation.start(
      [this, make = m_model.preparation()](const core::Progress& progress) -> BackgroundWork::Reply
      {
        const auto done = std::make_shared<presenters::PreparedCase>(make(progress));
        return [this, done]
        {
          if (m_prepareAgain) // the result is of an outdated state
            return prepare();
          m_loading.hide();
          if (m_model.prepared(std::move(*done)))
            emit ready();
          lookForDamage();
        };
      });
}

void CaseDocumentController::prepareUnlessUnderWay()
{
  if (!m_preparation.busy())
    prepare();
}

void CaseDocumentController::lookForDamage()
{
  QStringList lines;
  for (const std::string& one : m_model.damage())
    lines += tr("Damaged: %1. Do not rely on what is shown of it; nothing is drilled in this case "
                "until it is whole and opened again.")
                 .arg(phrase(one));
  if (m_model.hasCase() && m_model.library().isStandIn(m_model.value().ct))
    lines +=
        tr("The case is open with what is left of it: description, attachments, structures and "
           "strokes; where its image was is nothing. Import the same image again, as a case of "
           "its own, or restore the file from a copy of the library: then open this case again. "
           "Or remove it (Library > Cases).");
  for (const std::string& one : m_model.leftOut())
    lines += tr("Left out, neither shown nor felt: %1.").arg(phrase(one));
  if (m_model.hasCase())
    for (const std::string& one : lostMrs(m_model.library(), m_model.value()))
      lines += tr("Left out, neither shown nor felt: %1.").arg(phrase(one));
  for (const std::string& one : m_model.damagedStrokes())
    lines += tr("Damaged, and not applied: %1.").arg(phrase(one));
  if (const std::size_t undone = m_model.undoneForDamage())
    lines +=
        (undone == 1
             ? tr("The case is shown without its last stroke, which stays in it.")
             : tr("The case is shown without its last %1 strokes, which stay in it.").arg(undone));
  const QString text = lines.join('\n');
  if (text == m_damageTold)
    return;
  m_damageTold = text;
  m_damaged.setText(text);
  m_damaged.setVisible(!text.isEmpty());
}

void CaseDocumentController::openFolder()
{
  const QString folder = QFileDialog::getExistingDirectory(&m_window, tr("Open a DICOM folder"));
  if (!folder.isEmpty())
    open({folder});
}

void CaseDocumentController::openRegion()
{
  const QString folder =
      QFileDialog::getExistingDirectory(&m_window, tr("Open a DICOM folder, and choose a region"));
  if (!folder.isEmpty())
    open({folder}, {std::nullopt, true});
}

void CaseDocumentController::openFileRegion()
{
  const QString file = QFileDialog::getOpenFileName(
      &m_window, tr("Open an image file, and choose a region of it"), {},
      tr("Images (%1);;All files (*)").arg(patternsOf(imaging::kImage | imaging::kDicom)));
  if (!file.isEmpty())
    open({file}, {std::nullopt, true});
}

void CaseDocumentController::add(Content content, bool folder)
{
  if (!m_model.hasCase())
    return;
  if (folder)
  {
    const QString chosen = QFileDialog::getExistingDirectory(
        &m_window, content == Content::Mr ? tr("Add an MR from a DICOM folder")
                                          : tr("Add structures from a folder of masks"));
    if (!chosen.isEmpty())
      open({chosen}, {content});
    return;
  }
  const unsigned reads = content == Content::Mesh     ? imaging::kMesh
                         : content == Content::Labels ? imaging::kLabels | imaging::kDicom
                                                      : imaging::kImage | imaging::kDicom;
  const QString what = content == Content::Mesh     ? tr("Meshes")
                       : content == Content::Labels ? tr("Segmentations and label maps")
                                                    : tr("MR images");
  open(QFileDialog::getOpenFileNames(
           &m_window, tr("Add to “%1”").arg(words(m_model.value().name)), {},
           QString("%1 (%2);;").arg(what, patternsOf(reads)) + tr("All files (*)")),
       {content});
}

void CaseDocumentController::openFiles()
{
  open(QFileDialog::getOpenFileNames(
      &m_window, tr("Open images, labels or meshes"), {},
      tr("Images, labels, meshes (%1);;All files (*)")
          .arg(patternsOf(imaging::kImage | imaging::kLabels | imaging::kMesh | imaging::kDicom))));
}

// What is written is what the command would write: the case as it is saved.
void CaseDocumentController::exportPart(const QString& what, const QString& part)
{
  if (!m_model.hasCase())
    return;
  if (writing())
    return emit statusMessage(tr("One at a time: something is being read already"));
  presenters::ExportOptions options;
  {
    const QScopedValueRollback<bool> asking(m_asking, true);
    if (mayDropDraft && !mayDropDraft())
      return;
    const scene::Case value = m_model.value(); // may be closed meanwhile
    const FaceCheck faces = lookForFaces(value, m_window);
    if (faces.isCancelled || !m_model.hasCase())
      return;
    std::optional<ExportDialog::Choices> proposed = m_exported;
    if (!what.isEmpty())
    {
      // The name follows what is chosen, in the folder of the last one.
      ExportDialog::Choices chosen = m_exported.value_or(ExportDialog::Choices());
      chosen.caseName.clear();
      chosen.what = what;
      chosen.part = part;
      if (chosen.path.isEmpty())
        chosen.path = QDir::home().filePath("x");
      proposed = chosen;
    }
    ExportDialog dialog(value, faces, proposed, &m_window);
    if (dialog.exec() != QDialog::Accepted || !m_model.hasCase())
      return;
    options = dialog.options();
    options.mask.found = faces.found;
    m_exported = dialog.choices();
  }
  write(options);
}

void CaseDocumentController::write(const presenters::ExportOptions& options)
{
  m_model.stopTouch();
  if (!m_saver.flush())
    return emit statusMessage(tr("The case is not saved yet, so nothing was exported"));
  const std::string name = m_model.value().name; // a save after a conflict may have changed it
  work(
      tr("Exporting from %1").arg(words(name)),
      [this, library = m_model.library(), name, options,
       isPart = !m_model.leftOut().empty()](const core::Progress& progress) -> BackgroundWork::Reply
      {
        scene::Case value = library.open(name);
        presenters::LeftOut leftOut;
        if (isPart) // what is damaged was said when the case was opened
          leftOut = presenters::leaveOutDamaged(value, progress.part(0.0, 0.1));
        else if (options.what == "surface") // that of all structures
          library.checkStructures(value, progress.part(0.0, 0.1));
        std::vector<std::string> warnings = leftOut.sentences();
        try
        {
          const auto done = presenters::exportCase(
              library, value, options, leftOut,
              [&warnings](const std::string& line) { warnings.push_back(line); },
              progress.part(0.1, 1.0));
          return [this, done, warnings, options]
          {
            QString text =
                tr("Written: %1%2").arg(QFile::decodeName(options.out.c_str()), phrase(done.words));
            if (done.voxelsVolume)
              text += tr("\nVolume of the voxels: %1 mm³").arg(numberText(*done.voxelsVolume, 2));
            text += tr("\nCoordinates: %1").arg(phrase(presenters::coordinatesOf(options)));
            for (const std::string& line : warnings)
              text += '\n' + sentence(phrase(line));
            inform(text);
          };
        }
        catch (const presenters::ExportGridError& error)
        {
          return [this, options, why = phrase(error.what())] { offerCtGrid(options, why); };
        }
      });
}

// Returns at once; the window waits for the answer.
void CaseDocumentController::offerCtGrid(const presenters::ExportOptions& options,
                                         const QString& why)
{
  auto* box = new QMessageBox(QMessageBox::Question, tr("Export"), sentence(why),
                              QMessageBox::Cancel, &m_window);
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setObjectName("exportGrids");
  const QString primary = m_model.hasCase() ? presenters::primaryName(m_model.value()) : "CT";
  box->setInformativeText(tr("On the %1's grid each of its voxels takes the nearest label, so that "
                             "volumes change by the voxels at the border.")
                              .arg(primary));
  auto* onCt = box->addButton(tr("Export on the %1's &grid").arg(primary), QMessageBox::AcceptRole);
  box->setDefaultButton(onCt);
  connect(box, &QMessageBox::buttonClicked, this,
          [this, options, onCt](QAbstractButton* clicked)
          {
            if (clicked != onCt || !m_model.hasCase() || writing())
              return;
            auto again = options;
            again.onCt = true;
            if (m_exported)
              m_exported->onCt = true;
            write(again);
          });
  box->open();
}

// An archive contains what is saved, so the case is saved first.
void CaseDocumentController::archive()
{
  if (m_model.hasCase())
    archive(m_model.value().name);
}

void CaseDocumentController::correctAxes()
{
  if (writing())
    return emit statusMessage(tr("One at a time: something is being read already"));
  if (!m_model.hasCase())
    return;
  const scene::Case value = m_model.value(); // it may be closed meanwhile
  core::AxesCorrection axes;
  try
  {
    const QScopedValueRollback<bool> asking(m_asking, true);
    AxesDialog dialog(value, &m_window);
    if (dialog.exec() != QDialog::Accepted || m_model.library().folder().empty())
      return;
    axes = dialog.axes();
  }
  catch (const std::exception& fault)
  {
    return refuse(toString(fault));
  }
  m_model.stopTouch();
  const std::string name = presenters::freeCaseName(
      m_model.library(), bytes(tr("%1 (axes corrected)").arg(words(value.name))));
  work(
      tr("Making the case %1").arg(words(name)),
      [this, value, axes, name](const core::Progress& progress) -> BackgroundWork::Reply
      {
        const auto next =
            std::make_shared<scene::Case>(presenters::correctedCase(value, axes, name, progress));
        return [this, next] { adopt(std::move(*next)); };
      },
      true);
}

void CaseDocumentController::archive(const std::string& which)
{
  if (writing())
    return emit statusMessage(tr("One at a time: something is being read already"));
  const bool isOpen = m_model.hasCase() && m_model.value().name == which;
  fs::path file;
  library::ArchiveOptions options;
  scene::ImageMask mask;
  std::vector<std::string> withoutMrs;
  QStringList facesLeft;
  std::string name = which;
  {
    const QScopedValueRollback<bool> asking(m_asking, true);
    if (isOpen && mayDropDraft && !mayDropDraft())
      return;
    try
    {
      // A copy: the case may be closed meanwhile.
      const scene::Case value = isOpen ? m_model.value() : m_model.library().open(name);
      const FaceCheck faces = lookForFaces(value, m_window);
      if (faces.isCancelled || (isOpen && !m_model.hasCase()))
        return;
      ArchiveDialog dialog(value, m_model.library(), faces, &m_window);
      if (dialog.exec() != QDialog::Accepted || (isOpen && !m_model.hasCase()))
        return;
      file = dialog.file();
      options = dialog.options();
      mask = dialog.mask();
      withoutMrs = dialog.withoutMrs();
      facesLeft = dialog.facesLeft();
    }
    catch (const std::exception& fault)
    {
      return refuse(toString(fault));
    }
    if (isOpen)
    {
      if (!saved())
        return emit statusMessage(tr("The case is not saved yet, so it was not archived"));
      name = m_model.value().name; // a save after a conflict may have changed it
    }
  }
  work(tr("Archiving %1").arg(words(name)),
       [this, library = m_model.library(), name, file, mask, withoutMrs, facesLeft,
        options](const core::Progress& progress) mutable -> BackgroundWork::Reply
       {
         options.prepare = presenters::maskForArchive(library, mask, withoutMrs);
         const library::ArchiveSummary done =
             library::archiveCase(library, name, file, options, progress);
         scene::Case kept = library.open(name);
         presenters::leaveOutMrs(kept, withoutMrs);
         const QString contents = contentsOf(kept, done.planOnly);
         return [this, done, file, contents, facesLeft]
         {
           QString text =
               (done.planOnly ? tr("The plan of “%1” is archived.") : tr("“%1” is archived."))
                   .arg(words(done.name));
           text +=
               tr("\nFile: %1, %2\nIn it: %3")
                   .arg(QFile::decodeName(file.c_str()), megabytes(done.archiveBytes), contents);
           for (const std::string& note : done.notes)
             text += "\n" + phrase(note);
           for (const QString& left : facesLeft)
             text += "\n" + left;
           if (!done.durable)
             text += tr("\nThe disk reported an error; check the disk.");
           inform(text);
         };
       });
}

void CaseDocumentController::restore()
{
  const QString file = QFileDialog::getOpenFileName(
      &m_window, tr("Restore a case from its archive"), {},
      tr("Case archives (*%1);;All files (*)").arg(library::kArchiveEnding));
  if (file.isEmpty())
    return;
  if (writing())
    return emit statusMessage(tr("One at a time: something is being read already"));
  restore(pathOf(file), {});
}

// `name`: of the restored case; empty: as the archive says. Asked for where that is taken.
void CaseDocumentController::restore(const fs::path& file, const std::string& name)
{
  if (!leaveCase())
    return;
  m_model.notOpened(); // it stays usable while the other one is restored
  work(tr("Restoring %1").arg(nameOf(file)),
       [this, library = m_model.library(), file,
        name](const core::Progress& progress) mutable -> BackgroundWork::Reply
       {
         try
         {
           const library::RestoreSummary done =
               library::restoreCase(library, file, {name, {}}, progress);
           return [this, done]
           {
             QStringList notes;
             for (const std::string& note : done.notes)
               notes += phrase(note);
             if (!notes.isEmpty())
             {
               const QScopedValueRollback<bool> asking(m_asking, true);
               refuse(notes.join('\n'));
             }
             openCase(done.name);
           };
         }
         catch (const library::LibraryError& error)
         {
           if (error.reason != library::LibraryError::Reason::NameTaken)
             throw;
           const std::string taken =
               name.empty() ? library::inspectArchive(file).name : name; // still in this thread
           return [this, file, taken]
           {
             std::string other;
             {
               const QScopedValueRollback<bool> asking(m_asking, true);
               other = bytes(askName(
                   m_window, tr("Restore"),
                   tr("The library has a case “%1”. Name of the restored one:").arg(words(taken)),
                   words(presenters::freeCaseName(m_model.library(), taken)),
                   [this](const std::string& wanted)
                   { presenters::checkFreeCaseName(m_model.library(), wanted); }));
             }
             if (other.empty())
               return emit statusMessage(tr("Stopped; nothing was changed"));
             restore(file, other);
           };
         }
       });
}

void CaseDocumentController::run(const QString& title, BackgroundWork::Work task)
{
  if (writing())
    return emit statusMessage(tr("One at a time: something is being read already"));
  work(title,
       [this, task = std::move(task)](const core::Progress& progress) -> BackgroundWork::Reply
       { return [this, reply = task(progress)] { reply(); }; });
}

void CaseDocumentController::changeCase(const QString& title, const std::string& name,
                                        const std::string& after,
                                        std::function<void(library::Library&)> change,
                                        std::function<void()> changed)
{
  if (writing())
    return emit statusMessage(tr("One at a time: something is being read already"));
  if (m_model.hasCase() && m_model.value().name == name && !closeToReopen())
    return;
  work(title,
       [this, library = m_model.library(), after, change = std::move(change),
        changed = std::move(changed)](const core::Progress&) mutable -> BackgroundWork::Reply
       {
         change(library);
         return [this, after, changed]
         {
           if (!m_reopen.empty())
             m_reopen = after;
           changed();
           reopen();
         };
       });
}

void CaseDocumentController::maintain(
    const QString& title,
    std::function<BackgroundWork::Reply(library::Library&, const core::Progress&)> task)
{
  if (writing())
    return emit statusMessage(tr("One at a time: something is being read already"));
  if (m_model.hasCase() && !closeToReopen())
    return;
  work(title,
       [this, library = m_model.library(),
        task = std::move(task)](const core::Progress& progress) mutable -> BackgroundWork::Reply
       {
         return [this, reply = task(library, progress)]
         {
           reply();
           reopen();
         };
       });
}

bool CaseDocumentController::closeToReopen()
{
  if (!mayStopJobs() || !leaveCase())
    return false;
  m_reopen = m_model.value().name; // a save after a conflict may have changed it
  m_model.close();
  return true;
}

// What was closed for maintenance, however that ended.
void CaseDocumentController::reopen()
{
  if (const std::string name = std::exchange(m_reopen, {}); !name.empty())
    openCase(name);
}

void CaseDocumentController::makeSample()
{
  if (writing())
    return;
  const auto folder = std::make_shared<QTemporaryDir>();
  if (!folder->isValid())
    return refuse(tr("No temporary folder can be made: %1").arg(folder->errorString()));
  try
  {
    makeCase(
        presenters::freeCaseName(m_model.library(), "sample patient"),
        [folder](const core::Progress& progress)
        {
          const fs::path out = pathOf(folder->filePath("sample patient"));
          phantom::writeSamplePatient(out, {}, progress);
          presenters::CaseSources sources;
          sources.ct = out / "ct";
          sources.parts.labels.push_back({"", out / "labels.seg.nrrd"});
          return sources;
        },
        scene::Side::Right); // as it is made
  }
  catch (const std::exception& fault)
  {
    refuse(toString(fault));
  }
}

bool CaseDocumentController::saved()
{
  m_model.stopTouch();
  return m_saver.flush();
}

void CaseDocumentController::save()
{
  if (!m_model.hasCase())
    return;
  m_sayWhenSaved = true;
  m_saver.save();
}

void CaseDocumentController::saveAs()
{
  if (!m_model.hasCase())
    return;
  try
  {
    const QString name =
        askName(m_window, tr("Save as"), tr("Name of the new case:"),
                words(presenters::freeCaseName(m_model.library(), m_model.value().name)),
                [this](const std::string& wanted)
                { presenters::checkFreeCaseName(m_model.library(), wanted); });
    if (name.isEmpty() || !m_model.hasCase())
      return;
    m_sayWhenSaved = true;
    m_saver.saveAs(bytes(name));
  }
  catch (const std::exception& fault)
  {
    refuse(toString(fault));
  }
}

void CaseDocumentController::closeCase()
{
  if (writing())
    return emit statusMessage(tr("One at a time: something is being read already"));
  if (!m_model.hasCase() || !mayStopJobs([this] { closeCase(); }, tr("The case is closed")) ||
      !leaveCase())
    return;
  m_removed.hide();
  m_model.close();
}

bool CaseDocumentController::mayLeave()
{
  if (m_giveUp)
  {
    m_saver.stop();
    return true;
  }
  if (m_leaving) // called again while saving
    return false;
  const QScopedValueRollback<bool> leaving(m_leaving, true);
  if (!mayStopJobs([this] { m_window.close(); }, tr("Petrous is closed")) ||
      (mayDropDraft && !mayDropDraft()))
    return false;
  const FinishingNote note(m_window);
  stopWork();
  m_preparation.dropInLoop();
  m_model.stopTouch();
  const bool safe = m_saver.flush();
  if (!safe)
  {
    m_unsaved.setButtonVisible("quitUnsaved", true);
    prepare(); // the window stays
  }
  return safe;
}

} // namespace petrous::workstation
