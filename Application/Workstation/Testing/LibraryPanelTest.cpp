#include "GuiTest.h"

#include <fstream>

#include <QBuffer>
#include <QCheckBox>
#include <QComboBox>
#include <QDateEdit>
#include <QDialog>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QMenu>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QStatusBar>
#include <QTimer>
#include <QToolButton>
#include <QTreeView>

#include "Banner.h"
#include "CasesModel.h"
#include "LibraryPanel.h"
#include "StartPage.h"
#include "Theme.h"
#include "ThumbnailDrawer.h"
#include "petrous/Library/Archive.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

namespace fs = std::filesystem;

class LibraryWindow : public GuiTest
{
protected:
  // With what was asked for: it is read in a separate thread.
  LibraryPanel& panel()
  {
    auto& panel = *window().findChild<LibraryPanel*>();
    EXPECT_TRUE(waitFor([&panel] { return !panel.isReading(); }));
    return panel;
  }
  StartPage& firstPage()
  {
    auto& page = *window().findChild<StartPage*>();
    EXPECT_TRUE(waitFor([&page] { return !page.isReading(); }));
    return page;
  }
  QTreeView& list() { return *panel().findChild<QTreeView*>("cases"); }
  QStringList names()
  {
    QStringList found;
    for (int row = 0; row < list().model()->rowCount(); ++row)
      found += list().model()->index(row, 0).data().toString();
    return found;
  }
  void showPanel()
  {
    action("Open case…")->trigger();
    ASSERT_TRUE(panel().isVisible());
  }
  bool select(const QString& name)
  {
    const int row = names().indexOf(name);
    list().setCurrentIndex(list().model()->index(row, 0));
    return row >= 0;
  }
  // An entry of the list's context menu.
  void act(const QString& text)
  {
    for (QAction* one : list().actions())
      if (one->text().remove('&') == text)
        return one->trigger();
    ADD_FAILURE() << text.toStdString();
  }
  void button(const char* name) { panel().findChild<QToolButton*>(name)->click(); }
  void menu(const char* name) { window().findChild<QAction*>(name)->trigger(); }
  void answerName(const QString& name)
  {
    onDialog(
        [name](QDialog& dialog)
        {
          auto* ask = qobject_cast<QInputDialog*>(&dialog);
          if (!ask)
            return false;
          ask->setTextValue(name);
          ask->accept();
          return true;
        });
  }
  void answer(const QString& text)
  {
    onMessage(
        [text](QMessageBox& box)
        {
          for (auto* one : box.buttons())
            if (one->text().remove('&') == text)
              return one->click();
          box.reject();
        });
  }
  bool isOpen(const char* name)
  {
    return waitFor(
        [&]
        {
          return window().model().hasCase() && window().model().value().name == name &&
                 !window().busy();
        });
  }
  QDialog* report() { return window().findChild<QDialog*>("report"); }
  QString reportHead() { return report()->findChild<QLabel*>("reportHead")->text(); }
  QString reportText() { return report()->findChild<QPlainTextEdit*>("reportText")->toPlainText(); }
};

} // namespace

// The open one too: it is renamed while open, and closed when deleted.
TEST_F(LibraryWindow, CasesAreRenamedAndDeletedWhereTheyAreListed)
{
  saveBall("first");
  saveBall("second");
  openWindow("first");
  drill(300);
  showPanel();
  ASSERT_TRUE(select("first"));
  answerName("third");
  button("renameCase");
  ASSERT_TRUE(isOpen("third"));
  EXPECT_EQ(window().model().value().dissection.strokes().size(), 1u);
  EXPECT_EQ(library().open("third").dissection.strokes().size(), 1u);
  EXPECT_FALSE(library().contains("first"));
  EXPECT_EQ(panel().current(), "third");

  const auto remove = [&](const QString& name, const QString& reply)
  {
    ASSERT_TRUE(select(name));
    answer(reply);
    button("deleteCase");
    EXPECT_TRUE(settled());
  };
  remove("third", "Cancel");
  EXPECT_TRUE(library().contains("third"));
  remove("second", "Delete");
  EXPECT_FALSE(library().contains("second"));
  EXPECT_TRUE(window().model().hasCase());
  remove("third", "Delete");
  EXPECT_FALSE(library().contains("third"));
  EXPECT_FALSE(window().model().hasCase());

  // Brought back with its stroke, found by a search, and opened.
  EXPECT_TRUE(names().isEmpty());
  auto* deleted = panel().findChild<QMenu*>("deletedCases");
  ASSERT_EQ(deleted->actions().size(), 2);
  EXPECT_TRUE(deleted->actions()[0]->text().startsWith("third, "));
  deleted->actions()[1]->trigger();
  ASSERT_TRUE(settled());
  deleted->actions()[0]->trigger();
  ASSERT_TRUE(settled());
  EXPECT_FALSE(panel().findChild<QToolButton*>("undeleteCase")->isEnabled());
  EXPECT_EQ(names().size(), 2);
  panel().findChild<QLineEdit*>("searchCases")->setText("HIRD");
  EXPECT_EQ(names(), QStringList{"third"});
  EXPECT_EQ(panel().chosen(), "third");
  QApplication::setActiveWindow(&window());
  list().setFocus();
  QTest::keyClick(&list(), Qt::Key_Return);
  ASSERT_TRUE(isOpen("third"));
  EXPECT_EQ(window().model().value().dissection.strokes().size(), 1u);
  EXPECT_TRUE(library().contains("second"));
}

// That a node may have it under its old name is said as if there were some.
TEST_F(LibraryWindow, ARenamedCaseIsOpenAgainAlsoWhereTheNodesCannotBeRead)
{
  saveBall("first");
  openWindow("first");
  std::ofstream(folder() / "library/nodes.json") << "{";
  showPanel();
  ASSERT_TRUE(select("first"));
  answerName("third");
  button("renameCase");
  ASSERT_TRUE(isOpen("third"));
  EXPECT_TRUE(library().contains("third"));
}

TEST_F(LibraryWindow, ACopyIsListedAndTheOriginalStaysOpen)
{
  saveBall("ball");
  openWindow("ball");
  showPanel();
  ASSERT_TRUE(select("ball"));
  answerName("copy");
  const auto shown = window().model().shownAs();
  act("Copy…");
  ASSERT_TRUE(waitFor([this] { return panel().current() == "copy"; }));
  ASSERT_TRUE(isOpen("ball"));
  EXPECT_EQ(window().model().shownAs(), shown) << "opened again: nothing could be undone";
  EXPECT_EQ(library().open("copy").ct.object, library().open("ball").ct.object);
  EXPECT_NE(library().open("copy").id, library().open("ball").id);

  // Another order keeps the selection.
  list().sortByColumn(CasesModel::Name, Qt::DescendingOrder);
  EXPECT_EQ(names(), (QStringList{"copy", "ball"}));
  EXPECT_EQ(panel().current(), "copy");
  // Ctrl+F is the surgeon's window elsewhere.
  QApplication::setActiveWindow(&window());
  list().setFocus();
  QTest::keyClick(&list(), Qt::Key_F, Qt::ControlModifier);
  EXPECT_TRUE(panel().findChild<QLineEdit*>("searchCases")->hasFocus());

  // A name that is taken is refused, and the case is open again.
  ASSERT_TRUE(select("ball"));
  QString why;
  onDialog(
      [&](QDialog& dialog)
      {
        if (auto* ask = qobject_cast<QInputDialog*>(&dialog))
        {
          ask->setTextValue("copy");
          ask->accept();
          return false;
        }
        auto* box = qobject_cast<QMessageBox*>(&dialog);
        why = box->text();
        box->accept();
        return true;
      });
  act("Rename…");
  EXPECT_TRUE(waitFor([&] { return why.contains("copy"); })) << why.toStdString();
  ASSERT_TRUE(isOpen("ball"));
}

// As of a disk that was taken away since the cases were listed.
TEST_F(LibraryWindow, ACopyFromALibraryThatCannotBeReadIsRefusedInWords)
{
  saveBall("ball");
  openWindow();
  ASSERT_TRUE(settled());
  showPanel();
  ASSERT_TRUE(select("ball"));
  const fs::path cases = folder() / "library/cases";
  fs::rename(cases, folder() / "cases");
  std::ofstream(cases) << "no folder";
  act("Copy…");
  EXPECT_TRUE(window().statusBar()->currentMessage().contains("cannot be read"))
      << window().statusBar()->currentMessage().toStdString();
  EXPECT_FALSE(window().findChild<Banner*>("faultBanner")->isVisible());
  fs::remove(cases);
  fs::rename(folder() / "cases", cases);
}

// The damaged file, and the case that needs it.
TEST_F(LibraryWindow, VerifyNamesWhatIsDamaged)
{
  saveBall("ball");
  scene::Case other = ballCase("other");
  other.labels.clear();
  library().save(other);
  openWindow("other");
  menu("verifyLibrary");
  ASSERT_TRUE(waitFor([&] { return report() && !window().busy(); }));
  EXPECT_TRUE(reportHead().contains("All are sound")) << reportHead().toStdString();
  report()->close();
  ASSERT_TRUE(waitFor([&] { return !report(); }));

  const std::string object = library().open("ball").labels[0].object;
  const fs::path file = folder() / "library/objects" / object;
  fs::permissions(file, fs::perms::owner_write, fs::perm_options::add);
  std::fstream(file, std::ios::in | std::ios::out).put('#');
  menu("verifyLibrary");
  ASSERT_TRUE(waitFor([&] { return report() && !window().busy(); }));
  EXPECT_TRUE(reportHead().contains("1 is damaged")) << reportHead().toStdString();
  EXPECT_TRUE(reportText().contains(words(object)));
  EXPECT_TRUE(reportText().contains("needed by: ball")) << reportText().toStdString();
}

// The open case is closed meanwhile, and comes back as it was.
TEST_F(LibraryWindow, CleaningUpRemovesDeletedCasesForGood)
{
  saveBall("ball");
  scene::Case other = ballCase("other");
  other.iso = 450.0;
  library().save(other);
  library().remove("other");
  openWindow("ball");
  drill(300);
  answer("Cancel");
  menu("collectLibrary");
  EXPECT_EQ(library().deleted().size(), 1u);
  answer("Clean up");
  menu("collectLibrary");
  ASSERT_TRUE(waitFor([&] { return library().deleted().empty(); }));
  ASSERT_TRUE(isOpen("ball"));
  EXPECT_EQ(window().model().value().dissection.strokes().size(), 1u);
}

TEST_F(LibraryWindow, RepairMakesTheIndexAnew)
{
  saveBall("ball");
  std::ofstream(folder() / "library" / "library.sqlite") << "no database";
  openWindow("ball");
  menu("repairLibrary");
  ASSERT_TRUE(waitFor([&] { return report() && !window().busy(); }));
  EXPECT_TRUE(reportHead().contains("repaired"));
  ASSERT_TRUE(isOpen("ball"));
  EXPECT_TRUE(library().verify().damaged.empty());
}

// Of a case that is not open; and an archive that is dropped comes back.
TEST_F(LibraryWindow, AnyCaseIsArchivedAndComesBackByDrop)
{
  saveBall("ball");
  saveBall("other");
  openWindow("ball");
  showPanel();
  ASSERT_TRUE(select("other"));
  const fs::path file = folder() / "other.petrous";
  onDialog(
      [&](QDialog& dialog)
      {
        if (dialog.objectName() != "archiveCase")
          return false;
        dialog.findChild<QLineEdit*>("archiveFile")->setText(QString::fromStdString(file.string()));
        dialog.findChild<QPushButton*>("primary")->click();
        return true;
      });
  bool isTold = false;
  onMessage(
      [&isTold](QMessageBox& box)
      {
        isTold = box.text().contains("other.petrous");
        box.accept();
      });
  act("Archive the case…");
  ASSERT_TRUE(waitFor([&] { return isTold && fs::exists(file) && !window().busy(); }));
  EXPECT_EQ(library::inspectArchive(file).name, "other");
  EXPECT_EQ(window().model().value().name, "ball");
  library().remove("other");
  panel().refresh();
  EXPECT_EQ(names(), QStringList{"ball"});

  // What is dropped on the panel is for the window.
  EXPECT_FALSE(panel().findChild<QLineEdit*>("searchCases")->acceptDrops());
  EXPECT_FALSE(list().viewport()->acceptDrops());
  dropPath(file);
  ASSERT_TRUE(isOpen("other"));
  EXPECT_TRUE(waitFor([&] { return names().contains("other"); }));
}

// What goes into the file is read before; note and date go only as they are ticked, and a file that
// is there is replaced only with consent.
TEST_F(LibraryWindow, AnArchiveIsWrittenAsTheDialogSays)
{
  scene::Case value = ballCase("ball");
  value.description.note = "seen on ward 7";
  value.description.date = "2026-03-31";
  library().save(value);
  openWindow();
  showPanel();
  const fs::path file = folder() / "ball.petrous";
  std::ofstream(file) << "of somebody else";
  int step = 0;
  onDialog(
      [&](QDialog& dialog)
      {
        if (auto* box = qobject_cast<QMessageBox*>(&dialog))
        {
          if (step == 1 || step == 2)
          {
            EXPECT_TRUE(box->text().contains("ball.petrous")) << box->text().toStdString();
            EXPECT_EQ(box->defaultButton(), box->button(QMessageBox::Cancel));
            for (QAbstractButton* button : box->buttons())
              if (button->text().contains(step == 1 ? "Cancel" : "Replace"))
              {
                ++step;
                button->click();
                break;
              }
          }
          return step == 3;
        }
        if (dialog.objectName() != "archiveCase")
          return false;
        const auto report = [&]
        { return dialog.findChild<QPlainTextEdit*>("archiveReport")->toPlainText(); };
        const auto below = [&](const char* title, const char* line)
        {
          const int from = report().indexOf(title);
          const int to = report().indexOf("\n\n", from);
          return from >= 0 && report().mid(from, to < 0 ? -1 : to - from).contains(line);
        };
        if (step == 0)
        {
          EXPECT_TRUE(below("Goes along:", "the note"));
          EXPECT_TRUE(below("Stays here:", "planned date"));
          dialog.findChild<QCheckBox*>("archiveNote")->click();
          EXPECT_TRUE(below("Stays here:", "the note"));
          dialog.findChild<QCheckBox*>("archiveDate")->setChecked(true);
          EXPECT_TRUE(below("Goes along:", "planned date"));
          EXPECT_TRUE(below("May identify", "planned date"));
          dialog.findChild<QCheckBox*>("archivePlan")->setChecked(true);
          EXPECT_FALSE(below("Goes along:", "voxels"));
          dialog.findChild<QCheckBox*>("archivePlan")->setChecked(false);
          EXPECT_TRUE(below("Goes along:", "voxels"));
          auto* line = dialog.findChild<QLineEdit*>("archiveFile");
          line->setText(QString::fromStdString((folder() / "nowhere" / "x").string()));
          EXPECT_FALSE(dialog.findChild<QPushButton*>("primary")->isEnabled());
          line->setText(QString::fromStdString(file.string()));
          step = 1;
        }
        // The first question is answered by No: the dialog stays.
        QTimer::singleShot(0, dialog.findChild<QPushButton*>("primary"), &QPushButton::click);
        return false;
      });
  action("Archive…")->trigger();
  EXPECT_EQ(step, 3);
  ASSERT_TRUE(waitFor([&] { return !window().busy() && fs::file_size(file) > 100; }));
  library::Library other(folder() / "other");
  library::restoreCase(other, file);
  EXPECT_EQ(other.description("ball").note, "");
  EXPECT_EQ(other.description("ball").date, "2026-03-31");
}

// By the keyboard as by the mouse, and with the very actions of the menus.
TEST_F(LibraryWindow, ThePanelHasArchivesNodesAndVerify)
{
  saveBall("ear");
  openWindow("ear");
  showPanel();
  ASSERT_TRUE(select("ear"));
  auto* more = panel().findChild<QToolButton*>("moreOfLibrary");
  ASSERT_NE(more, nullptr);
  EXPECT_TRUE((more->focusPolicy() & Qt::TabFocus) != 0);
  EXPECT_TRUE(more->isVisible());
  const QList<QAction*> entries = more->menu()->actions();
  const auto entry = [&entries](const QString& text) -> QAction*
  {
    for (QAction* one : entries)
      if (one->text().remove('&') == text)
        return one;
    return nullptr;
  };
  EXPECT_EQ(entry("Restore…"), action("Restore…"));
  EXPECT_EQ(entry("Receive from a node…"), window().findChild<QAction*>("receiveCase"));
  EXPECT_EQ(entry("Verify…"), window().findChild<QAction*>("verifyLibrary"));
  for (const char* ofCase : {"Make the picture", "Archive the case…", "Send the case…"})
  {
    ASSERT_NE(entry(ofCase), nullptr) << ofCase;
    EXPECT_TRUE(list().actions().contains(entry(ofCase))) << ofCase;
    EXPECT_TRUE(entry(ofCase)->isEnabled()) << ofCase;
  }
  list().setCurrentIndex({});
  EXPECT_FALSE(entry("Archive the case…")->isEnabled()) << "no case is selected";
  EXPECT_TRUE(entry("Restore…")->isEnabled());

  // The space key opens the menu.
  ASSERT_TRUE(select("ear"));
  bool isOpened = false;
  QObject::connect(more->menu(), &QMenu::aboutToShow, more->menu(),
                   [&isOpened, menu = more->menu()]
                   {
                     isOpened = true;
                     QTimer::singleShot(0, menu, &QMenu::close);
                   });
  more->setFocus();
  QTest::keyClick(more, Qt::Key_Space);
  EXPECT_TRUE(isOpened);
  EXPECT_TRUE(waitFor([more] { return !more->menu()->isVisible(); }));
}

// It can be renamed and deleted, not opened.
TEST_F(LibraryWindow, ADamagedCaseIsListed)
{
  saveBall("ball");
  saveBall("broken");
  std::ofstream(folder() / "library" / "cases" / "broken.json") << "{";
  std::ofstream(folder() / "library" / "cases" / "newer.json") << "{\"petrous_case\": 1000}";
  openWindow("ball");
  showPanel();
  ASSERT_TRUE(select("newer"));
  EXPECT_EQ(
      list().model()->index(list().currentIndex().row(), CasesModel::Structures).data().toString(),
      "newer version");
  ASSERT_TRUE(select("broken"));
  EXPECT_EQ(panel().current(), "broken");
  EXPECT_EQ(panel().chosen(), "");
  EXPECT_FALSE(panel().findChild<QToolButton*>("openThisCase")->isEnabled());
  EXPECT_TRUE(panel().findChild<QToolButton*>("deleteCase")->isEnabled());
  const int row = list().currentIndex().row();
  EXPECT_EQ(list().model()->index(row, CasesModel::Structures).data().toString(), "damaged");
}

// Another program may have named its file so.
TEST_F(LibraryWindow, ANameDoesNotTurnItsLineAround)
{
  saveBall("ball");
  std::ofstream(folder() / "library" / "cases" / "ear\u202eknab.json") << "{";
  openWindow("ball");
  showPanel();
  ASSERT_EQ(list().model()->rowCount(), 2);
  QStringList names;
  for (int row = 0; row < 2; ++row)
    for (const int role : {Qt::DisplayRole, Qt::ToolTipRole, Qt::AccessibleTextRole})
      names += list().model()->index(row, CasesModel::Name).data(role).toString();
  EXPECT_FALSE(names.join(' ').contains(QChar(0x202E)));
  EXPECT_TRUE(names.contains(QString::fromUtf8("ear\ufffdknab")));
}

// Of the open case, which is open again afterwards; found by it, and by its side.
TEST_F(LibraryWindow, ACaseIsDescribedAndFoundByThat)
{
  saveBall("ball");
  saveBall("other");
  openWindow("ball");
  drill(300);
  showPanel();
  ASSERT_TRUE(select("ball"));
  onDialog(
      [](QDialog& dialog)
      {
        if (dialog.objectName() != "describeCase")
          return false;
        auto* accept = dialog.findChild<QPushButton*>("primary");
        dialog.findChild<QLineEdit*>("plannedDate")->setText("2026-02-30");
        EXPECT_FALSE(accept->isEnabled()) << "there is no such day";
        dialog.findChild<QLineEdit*>("tags")->setText(QString(300, 't'));
        const auto* problem = dialog.findChild<QLabel*>("problem");
        EXPECT_TRUE(problem->text().contains("2026-02-30") && problem->text().contains("tag"))
            << problem->text().toStdString();
        dialog.findChild<QLineEdit*>("plannedDate")->setText("28.2.2026");
        dialog.findChild<QLineEdit*>("tags")->setText("teaching, , cholesteatoma , Teaching");
        dialog.findChild<QPlainTextEdit*>("note")->setPlainText("high jugular bulb");
        auto* side = dialog.findChild<QComboBox*>("side");
        side->setCurrentIndex(side->findText("left"));
        EXPECT_TRUE(accept->isEnabled());
        accept->click();
        return true;
      });
  button("describeCase");
  ASSERT_TRUE(waitFor([&] { return !library().description("ball").date.empty(); }));
  ASSERT_TRUE(isOpen("ball"));
  EXPECT_EQ(window().model().value().dissection.strokes().size(), 1u);
  const scene::Description said = library().description("ball");
  EXPECT_EQ(said.tags, (std::vector<std::string>{"teaching", "cholesteatoma"}));
  EXPECT_EQ(said.date, "2026-02-28");
  EXPECT_EQ(said.side, scene::Side::Left);

  auto* search = panel().findChild<QLineEdit*>("searchCases");
  search->setText("cholest");
  EXPECT_EQ(names(), QStringList{"ball"});
  search->setText("jugular");
  EXPECT_EQ(names(), QStringList());
  panel().findChild<QCheckBox*>("searchNotes")->setChecked(true);
  EXPECT_EQ(names(), QStringList{"ball"});
  search->clear();
  EXPECT_EQ(names().size(), 2);
  auto* side = panel().findChild<QComboBox*>("searchSide");
  side->setCurrentIndex(side->findText("right"));
  EXPECT_EQ(names(), QStringList{"other"});
  side->setCurrentIndex(side->findText("left"));
  EXPECT_EQ(names(), QStringList{"ball"});
  side->setCurrentIndex(0);

  // By a tag of the library, and by the planned date, both ends included.
  auto* tag = panel().findChild<QComboBox*>("searchTag");
  ASSERT_EQ(tag->count(), 3);
  tag->setCurrentIndex(tag->findText("cholesteatoma"));
  EXPECT_EQ(names(), QStringList{"ball"});
  panel().refresh();
  EXPECT_EQ(tag->currentText(), "cholesteatoma") << "a choice stays";
  tag->setCurrentIndex(0);
  EXPECT_EQ(names().size(), 2);
  auto* from = panel().findChild<QDateEdit*>("searchFrom");
  auto* to = panel().findChild<QDateEdit*>("searchTo");
  EXPECT_FALSE(from->isEnabled());
  panel().findChild<QCheckBox*>("searchDated")->setChecked(true);
  to->setDate({2026, 2, 28});
  from->setDate({2026, 2, 28});
  EXPECT_EQ(names(), QStringList{"ball"});
  from->setDate({2026, 2, 1});
  to->setDate({2026, 2, 27});
  EXPECT_EQ(names(), QStringList());
  panel().findChild<QCheckBox*>("searchDated")->setChecked(false);
  EXPECT_EQ(names().size(), 2);
}

// Reading happens elsewhere: the list stays as it was until it is done, and what is typed meanwhile
// takes the place of a search that is not.
TEST_F(LibraryWindow, TheLastOfSeveralSearchesIsShownWithoutWaiting)
{
  for (const char* name : {"first", "second", "third"})
  {
    scene::Case value = ballCase(name);
    value.description.note = std::string("a note on the ") + name;
    library().save(value);
  }
  openWindow();
  showPanel();
  ASSERT_EQ(names().size(), 3);
  panel().findChild<QCheckBox*>("searchNotes")->setChecked(true);
  auto& search = *panel().findChild<QLineEdit*>("searchCases");
  auto& model = *list().model();
  for (const char* typed : {"on", "on the f", "on the first", "on the se"})
  {
    search.setText(typed);
    EXPECT_EQ(model.rowCount(), 3);
  }
  EXPECT_TRUE(window().findChild<LibraryPanel*>()->isReading());
  EXPECT_EQ(names(), QStringList{"second"});
}

// Nor is a picture read while it is painted.
TEST_F(LibraryWindow, PicturesAreReadInTheBackground)
{
  saveBall("ball");
  const auto keep = [this](const QColor& color)
  {
    QImage image(library::kThumbnailWidth, library::kThumbnailHeight, QImage::Format_RGB888);
    image.fill(color);
    QByteArray png;
    QBuffer buffer(&png);
    ASSERT_TRUE(buffer.open(QIODevice::WriteOnly) && image.save(&buffer, "PNG"));
    if (const int at = png.indexOf("pHYs"); at > 0)
      png.remove(at - 4, 21); // length, name, 9 bytes, CRC
    library().setThumbnail("ball", {png.begin(), png.end()});
  };
  keep(Qt::red);
  const auto cases = library().list();
  ASSERT_EQ(cases.size(), 1U);
  ASSERT_TRUE(cases[0].hasThumbnail);
  CasesModel model;
  model.library = [this] { return library(); };
  model.setCases(cases, {});
  const auto shown = [&model]
  {
    const auto picture = model.index(0, 0).data(Qt::DecorationRole).value<QPixmap>().toImage();
    return picture.pixelColor(picture.rect().center());
  };
  EXPECT_EQ(shown().alpha(), 0);
  EXPECT_TRUE(waitFor([&] { return shown() == QColor(Qt::red); }));
  // Drawn anew: the former one is shown until it is read.
  keep(Qt::blue);
  model.pictureDrawn(cases[0].id);
  EXPECT_EQ(shown(), QColor(Qt::red));
  EXPECT_TRUE(waitFor([&] { return shown() == QColor(Qt::blue); }));
  openWindow();
}

TEST_F(LibraryWindow, ACaseHasAPicture)
{
  saveBall("ball");
  openWindow("ball");
  showPanel();
  ASSERT_TRUE(select("ball"));
  act("Make the picture");
  ASSERT_TRUE(waitFor([&] { return !library().thumbnail("ball").empty() && !window().busy(); }));
  const auto shown = [&]
  {
    const auto picture =
        list().model()->index(0, 0).data(Qt::DecorationRole).value<QPixmap>().toImage();
    return !picture.isNull() && pixelsUnlikeTheCorner(picture) > 50;
  };
  EXPECT_TRUE(waitFor(shown));
}

// Of a case that was saved, and of listed ones without a picture: bone alone is in it, since the
// ball is nothing else. Not where the user does not want that.
TEST_F(LibraryWindow, PicturesAreDrawnInTheBackground)
{
  saveBall("ball");
  saveBall("other");
  drawThumbnailsAfter = 50;
  openWindow("ball");
  const auto has = [this](const char* name) { return !library().thumbnail(name).empty(); };
  EXPECT_FALSE(has("ball")) << "nothing was saved, and nobody looks at the list";
  drill(300);
  EXPECT_TRUE(action("Drill")->isChecked());
  QTest::keyClick(&view(), Qt::Key_D); // the tool is put away
  ASSERT_TRUE(waitFor([&] { return has("ball"); }));
  showPanel(); // the first page has shown the other one, too, if it was there long enough
  ASSERT_TRUE(waitFor([&] { return has("other"); }));
  const auto shown = [&](int row)
  {
    const auto picture =
        list().model()->index(row, 0).data(Qt::DecorationRole).value<QPixmap>().toImage();
    return !picture.isNull() && pixelsUnlikeTheCorner(picture) > 50;
  };
  EXPECT_TRUE(waitFor([&] { return shown(0) && shown(1); }));

  // Drawn anew after the next stroke.
  const auto before = library().thumbnail("ball");
  drill(600, 20);
  QTest::keyClick(&view(), Qt::Key_D);
  EXPECT_TRUE(waitFor([&] { return library().thumbnail("ball") != before; }));
  closeWindow();

  const auto drawing = [this] { return window().findChild<QAction*>("drawThumbnails"); };
  openWindow("ball");
  EXPECT_TRUE(drawing()->isChecked());
  drawing()->trigger();
  closeWindow();
  saveBall("third");
  openWindow("ball");
  EXPECT_FALSE(drawing()->isChecked()) << "kept";
  auto& drawer = *window().findChild<ThumbnailDrawer*>();
  showPanel();
  EXPECT_EQ(names().size(), 3);
  EXPECT_FALSE(drawer.busy());
  drawing()->trigger();
  panel().refresh();
  EXPECT_TRUE(waitFor([&] { return has("third"); }));
}

// The first page while no case is open: the cases that were changed last, reached by the keyboard.
TEST_F(LibraryWindow, TheFirstPageHasTheRecentCases)
{
  scene::Case value = ballCase("first");
  value.description.side = scene::Side::Left;
  value.description.date = "2026-03-31";
  value.description.tags = {"teaching"};
  library().save(value);
  saveBall("second");
  saveBall("broken");
  std::ofstream(folder() / "library" / "cases" / "broken.json") << "{";
  openWindow("first");
  auto& page = *window().findChild<StartPage*>();
  EXPECT_FALSE(page.isVisible());
  action("Close the case")->trigger();
  ASSERT_TRUE(firstPage().isVisible());
  EXPECT_FALSE(window().model().hasCase());
  EXPECT_FALSE(action("Close the case")->isEnabled());
  auto& recent = *page.findChild<QListView*>("recentCases");
  ASSERT_EQ(recent.model()->rowCount(), 2) << "a damaged one is in the panel only";
  QApplication::setActiveWindow(&window());
  EXPECT_TRUE(waitFor([&] { return recent.hasFocus(); }));
  const auto row = [&](const QString& name)
  { return recent.model()->index(0, 0).data().toString() == name ? 0 : 1; };
  const auto told = recent.model()->index(row("first"), 0).data(Qt::AccessibleTextRole).toString();
  for (const char* what : {"first", "left", "2026-03-31", "teaching"})
    EXPECT_TRUE(told.contains(what)) << told.toStdString();

  // All of it is reached by Tab, in both directions, and is on the page.
  QSet<QWidget*> reached;
  for (int n = 0; n < 80; ++n)
  {
    reached += QApplication::focusWidget();
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Tab);
  }
  for (auto* button : page.findChildren<QPushButton*>())
    EXPECT_TRUE(reached.contains(button)) << button->text().toStdString();
  EXPECT_TRUE(reached.contains(&recent));

  // Deleted meanwhile; and the one that is left is opened by Enter.
  library().remove("second");
  panel().show();
  panel().refresh();
  panel();
  firstPage();
  EXPECT_EQ(recent.model()->rowCount(), 1);
  recent.setFocus();
  QTest::keyClick(&recent, Qt::Key_Return);
  ASSERT_TRUE(isOpen("first"));
  EXPECT_FALSE(page.isVisible());
}

// With texts that are 40 % longer, on the smallest screen, with panels open beside it.
TEST_F(LibraryWindow, TheFirstPageSaysThatACaseOrTheLibraryIsGone)
{
  saveBall("first");
  saveBall("second");
  openWindow("first");
  action("Close the case")->trigger();
  auto& page = *window().findChild<StartPage*>();
  ASSERT_TRUE(waitFor([&] { return page.isVisible() && !window().busy(); }));
  auto& recent = *firstPage().findChild<QListView*>("recentCases");
  auto& trouble = *page.findChild<QLabel*>("recentTrouble");
  ASSERT_EQ(recent.model()->rowCount(), 2);
  EXPECT_FALSE(trouble.isVisible());
  const auto openRow = [&](const QString& name)
  {
    for (int row = 0; row < recent.model()->rowCount(); ++row)
      if (recent.model()->index(row, 0).data().toString() == name)
        recent.setCurrentIndex(recent.model()->index(row, 0));
    recent.setFocus();
    QTest::keyClick(&recent, Qt::Key_Return);
    firstPage();
  };
  library().remove("second"); // by another program
  openRow("second");
  EXPECT_TRUE(trouble.isVisible());
  EXPECT_TRUE(trouble.text().contains("second") && trouble.text().contains("no longer"))
      << trouble.text().toStdString();
  EXPECT_EQ(recent.model()->rowCount(), 1);
  EXPECT_FALSE(window().model().hasCase());

  std::filesystem::rename(folder() / "library", folder() / "taken away");
  openRow("first");
  EXPECT_TRUE(trouble.text().contains(QString::fromStdString((folder() / "library").string())))
      << trouble.text().toStdString();
  EXPECT_FALSE(window().model().hasCase());
  std::filesystem::remove_all(folder() / "library");
  std::filesystem::rename(folder() / "taken away", folder() / "library");
  page.refresh();
  firstPage();
  EXPECT_FALSE(trouble.isVisible());
  openRow("first");
  EXPECT_TRUE(isOpen("first"));
}

TEST_F(LibraryWindow, TheFirstPageHasRoomForLongTexts)
{
  LongTexts longer;
  QApplication::installTranslator(&longer);
  saveBall("first");
  openWindow("first");
  QApplication::removeTranslator(&longer);
  window().resize(1280, 720);
  for (auto* action : window().findChildren<QAction*>())
    if (action->text().startsWith("Cl&ose the case"))
      action->trigger();
  auto& page = *window().findChild<StartPage*>();
  ASSERT_TRUE(waitFor([&] { return page.isVisible() && !page.isReading(); }));
  QTest::qWait(0);
  EXPECT_LE(window().width(), 1280);
  EXPECT_LE(window().height(), 720);
  for (auto* widget : page.findChildren<QWidget*>())
    if (widget->isVisible() &&
        (qobject_cast<QPushButton*>(widget) || qobject_cast<QLabel*>(widget)))
    {
      const QRect on(widget->mapTo(&page, QPoint()), widget->size());
      EXPECT_TRUE(page.rect().contains(on)) << widget->objectName().toStdString();
      EXPECT_GE(widget->width(), widget->minimumSizeHint().width());
      EXPECT_GE(widget->height(), widget->hasHeightForWidth()
                                      ? widget->heightForWidth(widget->width())
                                      : widget->minimumSizeHint().height());
    }
  EXPECT_GE(page.findChild<QListView*>("recentCases")->height(), 100) << "a row of cases";
}
