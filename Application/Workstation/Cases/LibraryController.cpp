#include "LibraryController.h"

#include <QMenu>
#include <QMessageBox>
#include <QPushButton>
#include <QTimer>

#include "Application.h"
#include "AskName.h"
#include "CaseDocumentController.h"
#include "DescriptionDialog.h"
#include "LibraryPanel.h"
#include "ReportWindow.h"
#include "Theme.h"
#include "ThumbnailDrawer.h"
#include "WindowTexts.h"
#include "petrous/Core/Error.h"
#include "petrous/Library/DerivedCache.h"
#include "petrous/Library/NewerVersion.h"
#include "petrous/Network/NodeList.h"
#include "petrous/Presenters/CaseNaming.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Presenters/CaseStamp.h"

namespace petrous::workstation
{

namespace
{

QString megabytes(std::uintmax_t bytes)
{
  return LibraryController::tr("%1 MB").arg(numberText(1e-6 * static_cast<double>(bytes), 1));
}

// What is damaged, the cases that need it, and the file, for each.
QString damageText(const library::Inspection& found)
{
  QStringList lines;
  for (const auto& one : found.damaged)
  {
    QString what = phrase(one.text);
    const QString named = words(one.object) + ": "; // the file, which comes last
    if (const int at = what.indexOf(named); at >= 0)
      what = what.mid(at + named.size());
    lines += sentence(what.left(1).toUpper() + what.mid(1));
    lines += LibraryController::tr("    needed by: %1")
                 .arg(one.cases.empty() ? LibraryController::tr("no case") : listed(one.cases));
    if (!one.deletedCases.empty())
      lines += LibraryController::tr("    and by deleted cases: %1").arg(listed(one.deletedCases));
    lines += LibraryController::tr("    file: %1").arg(phrase(one.object)) + '\n';
  }
  return lines.join('\n') + '\n';
}

} // namespace

LibraryController::LibraryController(presenters::WorkstationModel& model,
                                     CaseDocumentController& keeper, QWidget& window, int drawAfter)
  : QObject(&window)
  , m_model(model)
  , m_keeper(keeper)
  , m_window(window)
  , m_panel(new LibraryPanel(model))
  , m_menu(new QMenu(tr("&Library"), &window))
  , m_thumbnails(new ThumbnailDrawer([&model] { return model.library(); }, drawAfter, this))
{
  fillMenu();
  connectPanel();
  m_panel->onSeen([this](const library::CaseSummary& one) { m_thumbnails->caseSeen(one); });
  connect(m_thumbnails, &ThumbnailDrawer::drawn, m_panel,
          [this](const QString& id) { m_panel->pictureDrawn(bytes(id)); });
}

void LibraryController::refresh()
{
  m_panel->refreshSoon();
}

void LibraryController::fillMenu()
{
  const auto add = [this](const char* name, const QString& text, const QString& tip, auto what)
  {
    QAction* action = m_menu->addAction(text);
    action->setObjectName(name);
    action->setToolTip(tip);
    action->setStatusTip(tip);
    connect(action, &QAction::triggered, this, what);
  };
  add("showLibrary", tr("&Cases"), tr("The list of all cases"), [this] { emit panelWanted(); });
  add("drawThumbnails", tr("&Draw pictures"),
      tr("The small pictures in the list are drawn when a case is saved, and where one is missing, "
         "while nothing else goes on"),
      [this] { m_thumbnails->setEnabled(m_draw->isChecked()); });
  m_draw = m_menu->actions().last();
  m_draw->setCheckable(true);
  m_draw->setChecked(true);
  m_menu->addSeparator();
  add("verifyLibrary", tr("&Verify…"),
      tr("Reads every file of the library and compares it with what was stored"),
      [this] { verify(); });
  add("repairLibrary", tr("Re&pair…"),
      tr("Recovers strokes that were not saved, and makes the list of cases anew from their files"),
      [this] { repair(); });
  add("collectLibrary", tr("Clean &up…"),
      tr("Removes deleted cases for good, and all that no case needs"), [this] { collect(); });
}

void LibraryController::connectPanel()
{
  const auto on = [this](void (LibraryPanel::*asked)(const QString&), auto what)
  {
    connect(m_panel, asked, this,
            [this, what](const QString& name) { (this->*what)(bytes(name)); });
  };
  connect(m_panel, &LibraryPanel::openAsked, this,
          [this](const QString& name) { m_keeper.openCase(bytes(name)); });
  on(&LibraryPanel::renameAsked, &LibraryController::rename);
  on(&LibraryPanel::copyAsked, &LibraryController::copy);
  on(&LibraryPanel::removeAsked, &LibraryController::remove);
  on(&LibraryPanel::describeAsked, &LibraryController::describe);
  on(&LibraryPanel::pictureAsked, &LibraryController::makePicture);
  connect(m_panel, &LibraryPanel::archiveAsked, this,
          [this](const QString& name) { m_keeper.archive(bytes(name)); });
  connect(m_panel, &LibraryPanel::undeleteAsked, this,
          [this](const QString& name)
          {
            m_keeper.changeCase(
                tr("Bringing back %1").arg(name), {}, {},
                [name](library::Library& library) { library.undelete(bytes(name)); },
                [this, name] { m_panel->select(bytes(name)); });
          });
}

namespace
{

// Also of a list that cannot be read, which is told where a node is asked for.
bool mayHaveNodes(const std::filesystem::path& library)
{
  try
  {
    return !network::NodeList(library).nodes().empty();
  }
  catch (const std::exception&)
  {
    return true;
  }
}

} // namespace

void LibraryController::rename(const std::string& name)
{
  const std::string to = bytes(askName(m_window, tr("Rename the case"),
                                       tr("New name of “%1”:").arg(words(name)), words(name),
                                       [this, &name](const std::string& wanted)
                                       {
                                         if (wanted != name)
                                           presenters::checkFreeCaseName(m_model.library(), wanted);
                                       }));
  if (to.empty() || to == name)
    return;
  m_keeper.changeCase(
      tr("Renaming %1").arg(words(name)), name, to,
      [name, to](library::Library& library) { library.rename(name, to); },
      [this, to]
      {
        m_panel->select(to);
        if (mayHaveNodes(m_model.library().folder()))
          emit statusMessage(tr("The case is called “%1”. A node to which it was sent keeps it as "
                                "it was; sent again, it is another patient and study there.")
                                 .arg(words(to)));
      });
}

void LibraryController::copy(const std::string& name)
{
  QString proposed;
  try
  {
    proposed = words(presenters::freeCaseName(m_model.library(), name));
  }
  catch (const core::Error& error) // the library cannot be read any more
  {
    return emit statusMessage(toString(error));
  }
  const QString to = askName(m_window, tr("Copy the case"),
                             tr("Name of the copy of “%1”:").arg(words(name)), proposed,
                             [this](const std::string& wanted)
                             { presenters::checkFreeCaseName(m_model.library(), wanted); });
  if (to.isEmpty())
    return;
  if (m_model.hasCase() && m_model.value().name == name)
  {
    if (!m_keeper.saved())
      return emit statusMessage(tr("The case is not saved yet, so it was not copied"));
    return copyOpen(bytes(to));
  }
  m_keeper.changeCase(
      tr("Copying %1").arg(words(name)), name, name,
      [name, to](library::Library& library) { library.copy(name, bytes(to)); },
      [this, to] { m_panel->select(bytes(to)); });
}

// As it is saved; it stays open, with all that can be undone. The copy shares its voxels.
void LibraryController::copyOpen(const std::string& to)
{
  const auto copy = std::make_shared<scene::Case>(m_model.value());
  const std::string name = std::exchange(copy->name, to);
  copy->id.clear();
  copy->revision = 0;
  m_keeper.run(tr("Copying %1").arg(words(name)),
               [this, name, copy, library = m_model.library()](
                   const core::Progress& progress) mutable -> BackgroundWork::Reply
               {
                 const auto png = library.thumbnail(name);
                 library.save(*copy, progress);
                 if (!png.empty())
                   library.setThumbnail(copy->name, png);
                 return [this, to = copy->name] { m_panel->select(to); };
               });
}

void LibraryController::remove(const std::string& name)
{
  QMessageBox box(QMessageBox::Warning, tr("Delete the case"),
                  tr("Delete the case “%1”?").arg(words(name)), QMessageBox::NoButton, &m_window);
  box.setObjectName("askDelete");
  const std::size_t strokes = m_panel->strokes();
  box.setInformativeText(
      (strokes == 0   ? QString()
       : strokes == 1 ? tr("1 stroke was drilled in it. ")
                      : tr("%1 strokes were drilled in it. ").arg(strokes)) +
      tr("It can be brought back (Bring back, below the list) until the library is cleaned up."));
  const auto* yes = box.addButton(tr("Delete"), QMessageBox::DestructiveRole);
  box.setDefaultButton(box.addButton(QMessageBox::Cancel));
  box.exec();
  if (box.clickedButton() != yes)
    return;
  m_keeper.changeCase(
      tr("Deleting %1").arg(words(name)), name, {},
      [name](library::Library& library) { library.remove(name); }, [this] { m_panel->refresh(); });
}

void LibraryController::describe(const std::string& name)
{
  m_keeper.run(tr("Reading %1").arg(words(name)),
               [this, library = m_model.library(),
                name](const core::Progress&) mutable -> BackgroundWork::Reply
               {
                 const scene::Description before = library.description(name);
                 // After the reply, when another task can be started.
                 return [this, name, before] {
                   QTimer::singleShot(0, this,
                                      [this, name, before] { askDescription(name, before); });
                 };
               });
}

void LibraryController::askDescription(const std::string& name, const scene::Description& before)
{
  DescriptionDialog dialog(words(name), before, &m_window);
  if (dialog.exec() != QDialog::Accepted || dialog.description() == before)
    return;
  const bool isOtherSide = dialog.description().side != before.side;
  const auto doubt = std::make_shared<std::string>();
  m_keeper.changeCase(
      tr("Describing %1").arg(words(name)), name, name,
      [name, after = dialog.description(), isOtherSide, doubt](library::Library& library)
      {
        library.describe(name, after);
        if (isOtherSide)
          *doubt = presenters::sideDoubt(library.open(name));
      },
      [this, name, doubt]
      {
        m_panel->select(name);
        if (doubt->empty())
          return;
        auto* box = new QMessageBox(QMessageBox::Warning, tr("Side"), phrase(*doubt),
                                    QMessageBox::Ok, &m_window);
        box->setObjectName("sideDoubt");
        box->setAttribute(Qt::WA_DeleteOnClose);
        box->open();
      });
}

void LibraryController::makePicture(const std::string& name)
{
  if (m_model.hasCase() && m_model.value().name == name && !m_keeper.saved())
    return; // the banner tells why
  m_keeper.run(tr("Making the picture of %1").arg(words(name)),
               [this, library = m_model.library(),
                name](const core::Progress& progress) mutable -> BackgroundWork::Reply
               {
                 scene::Case value = library.open(name);
                 const bool isMade = presenters::storeThumbnail(library, value, progress);
                 return [this, name, isMade]
                 {
                   m_panel->forgetPictures();
                   refresh();
                   emit statusMessage(
                       isMade ? tr("The picture of %1 is made").arg(words(name))
                              : tr("No picture was made: it would show neither bone nor a "
                                   "structure"));
                 };
               });
}

void LibraryController::verify()
{
  m_keeper.run(
      tr("Verifying the library"),
      [this, library = m_model.library()](const core::Progress& progress) -> BackgroundWork::Reply
      {
        const library::Inspection found = library.verify(progress);
        return [this, found, newer = library::casesOfNewerVersion(library.folder())]
        {
          QString sum = tr("%1 cases and %2 files were read.").arg(found.cases).arg(found.objects);
          if (!newer.empty())
          {
            std::vector<std::string> names;
            for (const library::NewerCase& one : newer)
              names.push_back(one.name);
            sum +=
                ' ' +
                tr("Written by a newer version of Petrous, and left alone: %1.").arg(listed(names));
          }
          if (found.damaged.empty() && !newer.empty())
            return showReport(&m_window, tr("Verify"), sum + ' ' + tr("All others are sound."), {},
                              {}, {});
          if (found.damaged.empty())
            return showReport(&m_window, tr("Verify"), sum + ' ' + tr("All are sound."), {}, {},
                              {});
          showReport(&m_window, tr("Verify"),
                     sum + ' ' +
                         (found.damaged.size() == 1
                              ? tr("1 is damaged or missing.")
                              : tr("%1 are damaged or missing.").arg(found.damaged.size())) +
                         ' ' + tr("Restore from a copy of the library, or import the data again."),
                     damageText(found), "petrous-verify.txt", m_model.library().folder());
        };
      });
}

void LibraryController::collect()
{
  const auto deleted = m_model.library().deleted().size();
  QMessageBox box(
      QMessageBox::Question, tr("Clean up"),
      deleted == 0 ? tr("Remove all that no case needs?")
      : deleted == 1
          ? tr("Remove the deleted case for good, and all that no case needs?")
          : tr("Remove %1 deleted cases for good, and all that no case needs?").arg(deleted),
      QMessageBox::NoButton, &m_window);
  box.setObjectName("askCollect");
  QString more = tr("They cannot be brought back afterwards. Data that were derived from images "
                    "are computed anew when they are needed.");
  if (!m_model.removedPart().empty())
    more += ' ' + tr("What was taken out of the open case (“%1”) cannot be put back any more.")
                      .arg(shownName(m_model.removedPart()));
  box.setInformativeText(more);
  const auto* yes = box.addButton(tr("Clean up"), QMessageBox::DestructiveRole);
  box.setDefaultButton(box.addButton(QMessageBox::Cancel));
  box.exec();
  if (box.clickedButton() != yes)
    return;
  m_keeper.maintain(
      tr("Cleaning up the library"),
      [this](library::Library& library, const core::Progress& progress) -> BackgroundWork::Reply
      {
        progress.report(0.0, "looking for what no case needs");
        const library::Collected removed = library.collectGarbage(progress);
        library::DerivedCache derived(library::derivedFolder(library.folder()));
        const std::uintmax_t freed = derived.prune(0);
        return [this, removed, freed]
        {
          refresh();
          emit statusMessage(
              tr("Cleaned up: %1 and %2 are gone, %3 are free again")
                  .arg(removed.cases == 1 ? tr("1 deleted case")
                                          : tr("%1 deleted cases").arg(removed.cases),
                       removed.objects == 1 ? tr("1 file") : tr("%1 files").arg(removed.objects),
                       megabytes(removed.bytes + freed)));
        };
      });
}

void LibraryController::repair()
{
  m_keeper.maintain(
      tr("Repairing the library"),
      [this](library::Library& library, const core::Progress& progress) -> BackgroundWork::Reply
      {
        progress.report(0.0, "looking for strokes that were not saved");
        const library::Repaired found = library.repair(progress);
        return [this, found]
        {
          refresh();
          QStringList lines;
          for (const auto* all : {&found.lost, &found.done})
            for (const std::string& line : *all)
              lines += phrase(line);
          const QString verify = tr("Library > Verify tells whether files are damaged.");
          showReport(&m_window, tr("Repair"),
                     (found.lost.empty()
                          ? tr("The library is repaired.")
                          : tr("What could be repaired is; what cases need is missing.")) +
                         ' ' + verify,
                     lines.join('\n'), "petrous-repair.txt", m_model.library().folder());
        };
      });
}

} // namespace petrous::workstation
