#include "GuiTest.h"

#include <QAbstractItemModelTester>
#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDockWidget>
#include <QHeaderView>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QProgressBar>
#include <QPushButton>
#include <QScreen>
#include <QSlider>
#include <QStatusBar>
#include <QTableWidget>
#include <QTreeWidget>

#include "ApproachPanel.h"
#include "ComparisonWindow.h"
#include "Language.h"
#include "SliceColumn.h"
#include "SliceView.h"
#include "StrokeThumbnails.h"
#include "petrous/Scene/Branches.h"

using namespace petrous;
using namespace petrous::workstation;
using Eigen::Vector3d;

namespace
{

class Approaches : public GuiTest
{
protected:
  // main: two strokes; above: forks after the first of them, one stroke. On main, all applied.
  void saveApproaches()
  {
    scene::Case value = ballCase("ball");
    value.dissection = dissection::Dissection(value.ct.geometry);
    const auto drill = [&value](const Vector3d& from, double removed, double seconds)
    {
      dissection::StrokeInfo info;
      info.duration = seconds;
      info.burr.diameter = 5.0;
      core::CameraPose camera;
      camera.position = kBallCenter + Vector3d(20, -60, 20);
      camera.focalPoint = kBallCenter;
      camera.viewUp = {0, 0, 1};
      info.camera = camera;
      value.dissection.beginStroke(info);
      const Vector3d at = kBallCenter + kBallRadius * from.normalized();
      value.dissection.cut({at, at, 3.0});
      value.dissection.openInfo().removed = removed;
      value.dissection.endStroke();
    };
    drill({0, -1, 0}, 10.0, 5.0);
    drill({1, -1, 0}, 11.0, 6.5);
    scene::startBranch(value, "above", 1);
    drill({0, -1, 1}, 12.0, 70.0);
    scene::goToBranch(value, "main");
    library().save(value);
  }
  void openPanel()
  {
    QTest::keyClick(&window(), Qt::Key_F9, Qt::ShiftModifier);
    ASSERT_TRUE(waitFor([this] { return tree().isVisible(); }));
    QTest::qWait(20);
  }
  QTreeWidget& tree() { return *window().findChild<QTreeWidget*>("approaches"); }
  QSlider& line() { return *window().findChild<QSlider*>("strokeLine"); }
  // Rows from the top, with their depth.
  QStringList rows()
  {
    QStringList texts;
    for (QTreeWidgetItemIterator at(&tree()); *at; ++at)
    {
      int depth = 0;
      for (const QTreeWidgetItem* above = (*at)->parent(); above; above = above->parent())
        ++depth;
      texts += QString(depth, '.') + (*at)->text(0);
    }
    return texts;
  }
  QString current() { return tree().currentItem() ? tree().currentItem()->text(0) : QString(); }
  const scene::Case& value() { return window().model().value(); }
  std::string branch() { return value().dissection.history().branch().name; }
  void press(int key)
  {
    QTest::keyClick(&tree(), static_cast<Qt::Key>(key));
    QTest::qWait(20);
  }
  ComparisonWindow* comparison() { return window().findChild<ComparisonWindow*>("comparison"); }
  QString cell(const QString& row, int column)
  {
    QTableWidget& table = comparison()->table();
    for (int n = 0; n < table.rowCount(); ++n)
      if (table.item(n, 0)->text().startsWith(row))
        return table.item(n, column)->text();
    return {};
  }
};

} // namespace

TEST_F(Approaches, AreATreeOfTheirStrokesWithWhatEachRemoved)
{
  saveApproaches();
  openWindow();
  openPanel();
  const QAbstractItemModelTester tester(tree().model());
  EXPECT_EQ(rows(),
            QStringList({QString::fromUtf8("▶ main"), ".Untouched", ".1", "..above", "...3", ".2"}))
      << "as `petrous history` and the report number them";
  EXPECT_EQ(current(), "2");
  QTreeWidgetItem* main = tree().topLevelItem(0);
  EXPECT_EQ(main->text(1), QString::fromUtf8("21.00 mm³"));
  EXPECT_EQ(main->child(1)->text(2), "5.0 s");
  EXPECT_EQ(main->child(1)->text(3), "5.0 mm cutting");
  EXPECT_EQ(main->child(1)->child(0)->text(2), "1 min 15 s") << "with the first stroke";
}

TEST_F(Approaches, AClosedCaseLeavesNoneInThePanels)
{
  saveApproaches();
  saveBall("untouched");
  openWindow("ball");
  openPanel();
  QTest::keyClick(&window(), Qt::Key_F7);
  const auto* removed = window().findChild<QLabel*>("removed");
  ASSERT_TRUE(waitFor([&] { return removed->text().contains("21.0"); }));
  ASSERT_EQ(rows().size(), 6);
  action("Close the case")->trigger();
  ASSERT_TRUE(waitFor([this] { return !window().model().hasCase() && !window().busy(); }));
  EXPECT_EQ(rows(), QStringList());
  EXPECT_EQ(removed->text(), "");
  EXPECT_EQ(line().maximum(), 0);
  // Of one without a stroke, as many changes as of none.
  window().begin("untouched");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  EXPECT_EQ(rows(), QStringList({QString::fromUtf8("▶ main"), ".Untouched"}));
  action("Close the case")->trigger();
  ASSERT_TRUE(waitFor([this] { return !window().model().hasCase() && !window().busy(); }));
  EXPECT_EQ(rows(), QStringList());
}

TEST_F(Approaches, ArrowKeysGoToTheStatesLive)
{
  saveApproaches();
  openWindow();
  openPanel();
  tree().setFocus();
  press(Qt::Key_Up); // 3, the second of "above"
  EXPECT_EQ(branch(), "above");
  EXPECT_EQ(value().applied(), 2u);
  EXPECT_DOUBLE_EQ(value().removedVolume(), 22.0);
  EXPECT_EQ(current(), "3");
  EXPECT_EQ(window().model().undoText(), "change to approach above");
  press(Qt::Key_Up); // the approach itself
  EXPECT_EQ(branch(), "above");
  press(Qt::Key_Up); // 1 of main
  EXPECT_EQ(branch(), "main");
  EXPECT_EQ(value().applied(), 1u);
  EXPECT_EQ(value().dissection.history().ahead(), 1u);
  EXPECT_EQ(window().model().redoText(), "stroke 2") << "as after an undo";
  press(Qt::Key_Up);
  EXPECT_TRUE(value().dissection.mask().untouched());
  EXPECT_EQ(line().value(), 0);
  EXPECT_EQ(line().maximum(), 2);
  line().setFocus();
  QTest::keyClick(&line(), Qt::Key_Right);
  QTest::keyClick(&line(), Qt::Key_Right);
  EXPECT_EQ(value().applied(), 2u);
  EXPECT_EQ(current(), "2");
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(value().applied(), 1u);
  EXPECT_EQ(line().value(), 1);
  EXPECT_EQ(current(), "1");
  // Saved when it rests.
  EXPECT_TRUE(waitFor([this] { return !window().model().unsaved() && !window().busy(); }));
  EXPECT_EQ(library().open("ball").applied(), 1u);
}

TEST_F(Approaches, BranchRenameAndDeleteAndUndoThem)
{
  saveApproaches();
  openWindow();
  openPanel();
  tree().setFocus();
  const auto answer = [this](const QString& name)
  {
    onDialog(
        [name](QDialog& dialog)
        {
          auto* ask = qobject_cast<QInputDialog*>(&dialog);
          if (!ask)
            return false;
          auto* ok = ask->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok);
          auto* edit = ask->findChild<QLineEdit*>();
          edit->setText(QString(QChar(0xe4)).repeated(51)); // 102 bytes
          EXPECT_FALSE(ok->isEnabled());
          EXPECT_TRUE(ask->findChild<QLabel*>()->text().contains("100 bytes"));
          edit->setText(name);
          ok->click();
          return true;
        });
  };
  press(Qt::Key_Up);
  ASSERT_EQ(branch(), "above");
  answer("retrosigmoid");
  QTest::keyClick(&tree(), Qt::Key_F2);
  QApplication::setActiveWindow(&window()); // a loaded machine gives it back later
  EXPECT_EQ(branch(), "retrosigmoid");
  EXPECT_TRUE(rows().contains(QString::fromUtf8("..▶ retrosigmoid")));
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(branch(), "above");
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(branch(), "retrosigmoid");

  tree().setFocus();
  QTest::keyClick(&tree(), Qt::Key_Delete);
  QTest::qWait(20);
  EXPECT_EQ(branch(), "main");
  EXPECT_EQ(rows(), QStringList({QString::fromUtf8("▶ main"), ".Untouched", ".1", ".2"}));
  EXPECT_TRUE(settled());
  EXPECT_EQ(library().open("ball").dissection.history().branches().size(), 1u);
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(rows().contains("..retrosigmoid"));
  EXPECT_TRUE(settled());
  EXPECT_EQ(library().open("ball").dissection.history().branches().size(), 2u);

  answer("deeper");
  QTest::keyClick(&window(), Qt::Key_B, Qt::ControlModifier);
  EXPECT_EQ(branch(), "deeper");
  EXPECT_TRUE(rows().contains(QString::fromUtf8("..▶ deeper")));
}

// Both cases have an approach "main".
TEST_F(Approaches, AnotherCaseIsNotOpenedUnderADialog)
{
  saveApproaches();
  saveBall("other");
  openWindow("ball");
  ASSERT_TRUE(settled());
  int looks = 0;
  onDialog(
      [this, &looks](QDialog& dialog)
      {
        auto* ask = qobject_cast<QInputDialog*>(&dialog);
        if (!ask)
          return false;
        EXPECT_EQ(window().model().value().name, "ball");
        if (++looks < 50) // the other case is read meanwhile
          return false;
        ask->findChild<QLineEdit*>()->setText("translabyrinthine");
        ask->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok)->click();
        return true;
      });
  window().begin("other");
  ASSERT_TRUE(window().busy());
  action("Rename the approach…")->trigger();
  ASSERT_TRUE(waitFor([this] { return window().model().value().name == "other"; }));
  ASSERT_TRUE(settled());
  EXPECT_EQ(looks, 50);
  EXPECT_TRUE(library().open("other").dissection.history().find("main"));
  const scene::Case ball = library().open("ball");
  EXPECT_TRUE(ball.dissection.history().find("translabyrinthine"));
  EXPECT_FALSE(ball.dissection.history().find("main"));
}

TEST_F(Approaches, ThumbnailsAreDrawnOfTheRowsThatAreSeen)
{
  saveApproaches();
  drawThumbnailsAfter = 0;
  openWindow();
  auto* thumbnails = window().findChild<StrokeThumbnails*>();
  QTest::qWait(250);
  EXPECT_TRUE(thumbnails->of(0).isNull()) << "the panel is hidden";
  openPanel();
  ASSERT_TRUE(waitFor(
      [&]
      {
        return !thumbnails->of(0).isNull() && !thumbnails->of(1).isNull() &&
               !thumbnails->of(2).isNull();
      }));
  const QImage untouched = thumbnails->of(dissection::History::kStart);
  EXPECT_EQ(untouched.size(), QSize(StrokeThumbnails::kWidth, StrokeThumbnails::kHeight));
  EXPECT_NE(thumbnails->of(0), untouched);
  EXPECT_NE(thumbnails->of(0), thumbnails->of(1));
  EXPECT_NE(thumbnails->of(1), thumbnails->of(2));
  picture();
}

TEST_F(Approaches, KeysOfTheMainWindowActInTheComparison)
{
  saveApproaches();
  openWindow();
  QTest::keyClick(&window(), Qt::Key_D, Qt::ControlModifier);
  ASSERT_TRUE(comparison());
  ASSERT_TRUE(waitFor([this] { return comparison()->table().rowCount() > 0; }));
  ASSERT_EQ(value().applied(), 2u);
  QApplication::setActiveWindow(comparison());
  QTest::keyClick(comparison(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(value().applied(), 1u);
  QTest::keyClick(comparison(), Qt::Key_Y, Qt::ControlModifier);
  EXPECT_EQ(value().applied(), 2u);
  ASSERT_FALSE(tree().isVisible());
  QTest::keyClick(comparison(), Qt::Key_F9, Qt::ShiftModifier);
  EXPECT_TRUE(waitFor([this] { return tree().isVisible(); }));
}

TEST_F(Approaches, UndoLeavesAnApproachToo)
{
  saveApproaches();
  scene::Case three = library().open("ball");
  scene::startBranch(three, "below");
  scene::goToBranch(three, "main");
  library().save(three);
  openWindow();
  QTest::keyClick(&window(), Qt::Key_PageDown, Qt::ControlModifier);
  ASSERT_EQ(branch(), "above");
  QTest::keyClick(&window(), Qt::Key_PageDown, Qt::ControlModifier);
  ASSERT_EQ(branch(), "below");
  ASSERT_TRUE(settled());
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier);
  ASSERT_EQ(branch(), "above");
  QTest::keyClick(&window(), Qt::Key_D, Qt::ControlModifier);
  ASSERT_TRUE(comparison());
  EXPECT_EQ(comparison()->findChild<QComboBox*>("firstApproach")->currentText(), "above");
  EXPECT_EQ(comparison()->findChild<QComboBox*>("secondApproach")->currentText(), "below")
      << "the one that undo left";
}

TEST_F(Approaches, AreComparedByOneKey)
{
  saveApproaches();
  openWindow();
  QTest::keyClick(&window(), Qt::Key_D, Qt::ControlModifier);
  ASSERT_TRUE(comparison());
  ASSERT_TRUE(waitFor([this] { return comparison()->table().rowCount() > 0; }));
  EXPECT_TRUE(cell("Strokes, 1 in common", 1) == "2") << cell("Strokes", 1).toStdString();
  EXPECT_EQ(cell("Drilling time", 2), "1 min 15 s");
  // The nerve is a ball of 4 mm in one of 12: burrs of 3 mm leave 5.
  EXPECT_NEAR(cell("Distance to nerve", 1).section(' ', 0, 0).toDouble(), 5.0, 0.31);
  const auto [first, second] = comparison()->views();
  EXPECT_TRUE(second->isVisible());
  // Each picture names the approach that it shows, and then the case.
  const QString ofCase = view().stamp();
  EXPECT_FALSE(ofCase.isEmpty());
  for (const auto& [picture, column] : {std::pair(first, 1), std::pair(second, 2)})
    EXPECT_EQ(picture->stamp(), comparison()->table().horizontalHeaderItem(column)->text() +
                                    QString::fromUtf8(" · ") + ofCase);
  EXPECT_NE(first->stamp(), second->stamp());
  core::CameraPose camera = first->picture().camera();
  camera.position = kBallCenter + Vector3d(0, -60, 30);
  first->setCamera(camera);
  EXPECT_EQ(second->picture().camera().position, camera.position) << "they turn together";
  camera.position = kBallCenter + Vector3d(10, -60, 0);
  second->setCamera(camera);
  EXPECT_EQ(first->picture().camera().position, camera.position);

  auto* slice = window().findChild<SliceColumn*>()->views()[0];
  const QImage before = steady([&] { return slice->grab().toImage(); });
  comparison()->findChild<QCheckBox*>("showDifference")->click();
  EXPECT_FALSE(second->isVisible());
  EXPECT_EQ(first->stamp(), ofCase) << "it shows both";
  // Orange where main alone removed bone.
  QImage drawn;
  int orange = 0, blue = 0;
  const auto isCoded = [&]
  {
    drawn = first->grabFramebuffer();
    orange = blue = 0;
    for (int y = 0; y < drawn.height(); ++y)
      for (int x = 0; x < drawn.width(); ++x)
      {
        const QColor pixel = drawn.pixelColor(x, y);
        orange += pixel.red() > 2 * pixel.blue() + 40;
        blue += pixel.blue() > 2 * pixel.red() + 20;
      }
    return orange > 100 && blue > 100;
  };
  EXPECT_TRUE(waitFor(isCoded)) << orange << " orange, " << blue << " blue";
  const QString pictures = qEnvironmentVariable("PETROUS_GUI_PICTURES");
  if (!pictures.isEmpty())
    window().screen()->grabWindow(comparison()->winId()).save(pictures + "/comparison.png");
  QTest::keyClick(comparison(), Qt::Key_Escape);
  EXPECT_TRUE(waitFor([this] { return !comparison(); }));
  EXPECT_TRUE(
      waitFor([&] { return differentPixels(before, slice->grab().toImage(), kSmoothing) == 0; }))
      << "its colours went with it";
}

TEST_F(Approaches, AComparisonSaysWhatItDoesAndIsStoppedAndBegunAgain)
{
  saveApproaches();
  openWindow();
  QTest::keyClick(&window(), Qt::Key_D, Qt::ControlModifier);
  ASSERT_TRUE(comparison());
  const auto heading = [this](int column)
  { return comparison()->table().horizontalHeaderItem(column)->text(); };
  EXPECT_EQ(heading(0), "Quantity");
  EXPECT_EQ(heading(1), "main");
  auto* cancel = comparison()->findChild<QPushButton*>("cancelComparison");
  auto* again = comparison()->findChild<QPushButton*>("compareAgain");
  auto* bar = comparison()->findChild<QProgressBar*>();
  ASSERT_TRUE(cancel->isVisible());
  EXPECT_FALSE(again->isVisible());
  EXPECT_GT(bar->width(), bar->fontMetrics().horizontalAdvance("Comparing, 100 %"));
  for (ThreeDView* view : comparison()->views())
    EXPECT_EQ(view->findChild<QLabel*>("guessed")->text(),
              "Comparing; the picture comes after that");
  cancel->click();
  const auto isCompared = [this] { return comparison()->table().rowCount() > 0; };
  ASSERT_TRUE(waitFor([&] { return again->isVisible() || isCompared(); }));
  if (again->isVisible()) // else it was faster
  {
    EXPECT_FALSE(cancel->isVisible());
    EXPECT_FALSE(isCompared());
    again->click();
    EXPECT_TRUE(cancel->isVisible());
  }
  ASSERT_TRUE(waitFor(isCompared));
  EXPECT_FALSE(cancel->isVisible());
  EXPECT_FALSE(again->isVisible());
  for (ThreeDView* view : comparison()->views())
    EXPECT_FALSE(view->findChild<QLabel*>("guessed")->isVisible());
}

// The main approach is called so by the program; no user typed it.
TEST_F(Approaches, AreComparedUnderTheNamesThatTheUsersLanguageHasForThem)
{
  if (!hasLanguage("de"))
    GTEST_SKIP() << "built without lrelease";
  saveApproaches();
  const GermanTexts german;
  ASSERT_TRUE(german.isThere());
  openWindow();
  QTest::keyClick(&window(), Qt::Key_D, Qt::ControlModifier);
  ASSERT_TRUE(comparison());
  const auto heading = [this](int column)
  { return comparison()->table().horizontalHeaderItem(column)->text(); };
  auto* first = comparison()->findChild<QComboBox*>("firstApproach");
  auto* second = comparison()->findChild<QComboBox*>("secondApproach");
  ASSERT_EQ(first->count(), 2);
  EXPECT_EQ(first->currentText(), "Hauptzugang");
  EXPECT_EQ(second->currentText(), "above");
  EXPECT_EQ(heading(1), "Hauptzugang");
  ASSERT_TRUE(waitFor([this] { return comparison()->table().rowCount() > 0; }));
  EXPECT_EQ(heading(1), "Hauptzugang");
  EXPECT_TRUE(comparison()->views()[0]->stamp().startsWith("Hauptzugang"));
  // What is chosen is the approach, whatever it is called.
  QSignalSpy chosen(comparison(), &ComparisonWindow::approachesChosen);
  first->setCurrentIndex(1);
  second->setCurrentIndex(0);
  emit second->activated(0);
  ASSERT_EQ(chosen.size(), 1);
  EXPECT_EQ(chosen[0][0].toString(), "above");
  EXPECT_EQ(chosen[0][1].toString(), "main");
  EXPECT_TRUE(waitFor([&] { return heading(1) == "above" && heading(2) == "Hauptzugang"; }));
  // The line of the present state.
  QApplication::setActiveWindow(&window());
  openPanel();
  line().setValue(1);
  EXPECT_TRUE(waitFor(
      [this] { return window().statusBar()->currentMessage().startsWith("Zugang Hauptzugang, "); }))
      << window().statusBar()->currentMessage().toStdString();
}

TEST_F(Approaches, AComparisonFollowsWhatIsUndone)
{
  saveApproaches();
  openWindow();
  QTest::keyClick(&window(), Qt::Key_D, Qt::ControlModifier);
  ASSERT_TRUE(waitFor([this] { return comparison() && comparison()->table().rowCount() > 0; }));
  QApplication::setActiveWindow(&window());
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(waitFor([this] { return cell("Strokes, 1 in common", 1) == "1"; }));
  EXPECT_EQ(cell("Removed there alone", 1), QString::fromUtf8("0.00 mm³"));
  action("Close the case")->trigger();
  EXPECT_TRUE(waitFor([this] { return !comparison(); }));
}
