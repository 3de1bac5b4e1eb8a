#include "DeviceTest.h"

#include <QDialogButtonBox>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QPushButton>
#include <QTimer>

#include "SliceView.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

class Branches : public DeviceTest
{
protected:
  QMenu& menu()
  {
    for (QAction* action : window().menuBar()->actions())
      if (action->text() == "&Approach")
        return *action->menu();
    throw std::runtime_error("no menu of approaches");
  }
  QStringList lines()
  {
    emit menu().aboutToShow();
    QStringList lines;
    bool listed = false;
    for (QAction* action : menu().actions())
      if (action->isSeparator())
        listed = true;
      else if (listed)
        lines += (action->isChecked() ? "*" : "") + action->text();
    return lines;
  }
  void startBranch(const QString& name)
  {
    QTimer::singleShot(300, &window(),
                       [name]
                       {
                         auto* dialog =
                             qobject_cast<QInputDialog*>(QApplication::activeModalWidget());
                         ASSERT_TRUE(dialog);
                         dialog->setTextValue(name);
                         dialog->accept();
                       });
    QTest::keyClick(&window(), Qt::Key_B, Qt::ControlModifier);
    // In case no window manager returns the keyboard focus to the window.
    window().activateWindow();
    EXPECT_TRUE(QTest::qWaitForWindowActive(&window()));
  }
  const scene::Case& value() { return window().model().value(); }
};

} // namespace

TEST_F(Branches, BeginAtThePresentStateAndLeaveTheOtherAsItWas)
{
  saveBall("ball");
  openWindow();
  EXPECT_EQ(lines(), QStringList(QString::fromUtf8("*&1  main: 0 strokes, 0.0 mm³")));
  startBranch("other");
  EXPECT_EQ(value().dissection.history().branch().name, "other");
  drill(800, 30);
  ASSERT_EQ(value().applied(), 1u);
  const double removed = value().removedVolume();
  ASSERT_GT(removed, 0.0);
  // To main, by its shortcut in the menu.
  emit menu().aboutToShow();
  menu().actions().at(8)->trigger();
  EXPECT_EQ(value().dissection.history().branch().name, "main");
  EXPECT_EQ(value().applied(), 0u);
  EXPECT_TRUE(value().dissection.mask().untouched());
  EXPECT_EQ(lines().size(), 2);
  EXPECT_TRUE(lines().at(1).startsWith("&2  other: 1 stroke, ")) << lines().at(1).toStdString();
  // The next one by key: wraps around to the other.
  QTest::keyClick(&window(), Qt::Key_PageDown, Qt::ControlModifier);
  EXPECT_EQ(value().dissection.history().branch().name, "other");
  EXPECT_EQ(value().removedVolume(), removed);
  EXPECT_FALSE(value().dissection.mask().untouched());
  EXPECT_TRUE(settled());
  EXPECT_FALSE(window().model().unsaved());
  const scene::Case saved = library().open("ball");
  EXPECT_EQ(saved.dissection.history().branch().name, "other");
  EXPECT_EQ(saved.dissection.history().branches().size(), 2u);
}

TEST_F(Branches, AreShownAsEachWasLeftAlsoByUndo)
{
  saveBall("ball");
  openWindow();
  ASSERT_TRUE(settled());
  auto& axial = *window().findChild<SliceView*>("axialView");
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  const Eigen::Vector3d crosshair = model.crosshair();
  const double zoom = axial.plane().zoom;
  const core::CameraPose camera = view().picture().camera();
  const auto isAt = [this](const core::CameraPose& pose)
  { return (view().picture().camera().position - pose.position).norm() < 1e-6; };

  startBranch("other");
  EXPECT_TRUE(isAt(camera)) << "a new one goes on from what is seen";
  core::CameraPose close = camera;
  close.position = 0.5 * (camera.position + camera.focalPoint);
  view().setCamera(close);
  scene::ViewState::Clipping cropped;
  cropped.crop = core::IndexBox{{0, 0, 0}, {48, 64, 64}};
  model.setClipping(cropped);
  const Eigen::Vector3d beside = crosshair + Eigen::Vector3d(2.0, 0.0, 0.0);
  model.setCrosshair(beside);
  axial.setPlane({2.0 * zoom, Eigen::Vector3d::Zero()});
  const auto expectMain = [&]
  {
    EXPECT_EQ(value().dissection.history().branch().name, "main");
    EXPECT_TRUE(value().view.clipping.empty());
    EXPECT_TRUE(isAt(camera));
    EXPECT_LT((model.crosshair() - crosshair).norm(), 1e-9);
    EXPECT_EQ(axial.plane().zoom, zoom);
  };
  const auto expectOther = [&]
  {
    EXPECT_EQ(value().dissection.history().branch().name, "other");
    EXPECT_TRUE(value().view.clipping == cropped);
    EXPECT_TRUE(isAt(close));
    EXPECT_LT((model.crosshair() - beside).norm(), 1e-9);
    EXPECT_EQ(axial.plane().zoom, 2.0 * zoom);
  };
  QTest::keyClick(&window(), Qt::Key_PageDown, Qt::ControlModifier);
  expectMain();
  ASSERT_TRUE(settled());
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier);
  expectOther();
  ASSERT_TRUE(settled());
  const scene::Case undone = library().open("ball"); // undo is saved, too
  EXPECT_EQ(undone.dissection.history().branch().name, "other");
  EXPECT_TRUE(undone.view.clipping == cropped);
  ASSERT_EQ(undone.view.branches.count("main"), 1u);
  EXPECT_EQ(undone.view.branches.count("other"), 0u);
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  expectMain();
  ASSERT_TRUE(settled());
  const scene::Case saved = library().open("ball");
  EXPECT_EQ(saved.dissection.history().branch().name, "main");
  ASSERT_EQ(saved.view.branches.count("other"), 1u);
  EXPECT_TRUE(saved.view.branches.at("other").clipping == cropped);

  closeWindow();
  openWindow();
  ASSERT_TRUE(settled());
  QTest::keyClick(&window(), Qt::Key_PageDown, Qt::ControlModifier);
  EXPECT_TRUE(value().view.clipping == cropped);
  EXPECT_TRUE(isAt(close));
  EXPECT_LT((window().model().crosshair() - beside).norm(), 1e-9);
  EXPECT_EQ(window().findChild<SliceView*>("axialView")->plane().zoom, 2.0 * zoom);
}

// Putting the tool away ends the stroke, and so moves the history from which the name comes.
TEST_F(Branches, GoOnWhileTheDrillIsStillOn)
{
  saveBall("ball");
  openWindow();
  startBranch("other");
  QTest::mouseMove(&view(), view().rect().center());
  QTest::keyClick(&view(), Qt::Key_D);
  ASSERT_TRUE(hasTool());
  QTest::keyPress(&view(), Qt::Key_Space);
  ASSERT_TRUE(waitFor([this] { return !value().dissection.mask().untouched(); }));
  QTest::keyClick(&window(), Qt::Key_PageDown, Qt::ControlModifier);
  EXPECT_EQ(value().dissection.history().branch().name, "main");
  QTest::keyRelease(&view(), Qt::Key_Space);
  EXPECT_TRUE(settled());
  EXPECT_EQ(library().open("ball").dissection.strokes().size(), 1u);
}

TEST_F(Branches, RefuseANameThatIsTakenInWords)
{
  saveBall("ball");
  openWindow();
  QString words;
  QTimer::singleShot(900, &window(),
                     [&words]
                     {
                       auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
                       ASSERT_TRUE(box);
                       words = box->text();
                       box->accept();
                     });
  startBranch("main");
  EXPECT_TRUE(words.contains("main")) << words.toStdString();
  EXPECT_EQ(value().dissection.history().branches().size(), 1u);
}

// What was typed stays: the name is judged before it is taken.
TEST_F(Branches, ANameThatIsTooLongCanBeShortened)
{
  saveBall("ball");
  openWindow();
  bool asked = false;
  onDialog(
      [&](QDialog& dialog)
      {
        auto* ask = qobject_cast<QInputDialog*>(&dialog);
        if (!ask)
          return false;
        asked = true;
        auto* ok = ask->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok);
        auto* line = ask->findChild<QLineEdit*>();
        EXPECT_FALSE(ok->isEnabled()) << "no name yet";
        const QString name = QString(QChar(0xe4)).repeated(51); // 102 bytes
        line->insert(name);                                     // keyClicks takes ASCII alone
        EXPECT_FALSE(ok->isEnabled());
        EXPECT_TRUE(ask->labelText().contains("100 bytes") ||
                    ask->findChild<QLabel*>()->text().contains("100 bytes"))
            << ask->findChild<QLabel*>()->text().toStdString();
        QTest::keyClick(line, Qt::Key_Return);
        EXPECT_TRUE(ask->isVisible());
        EXPECT_EQ(line->text(), name);
        QTest::keyClick(line, Qt::Key_Backspace);
        EXPECT_TRUE(ok->isEnabled());
        EXPECT_FALSE(ask->findChild<QLabel*>()->text().contains("bytes"));
        line->setText("main");
        EXPECT_FALSE(ok->isEnabled()) << "taken";
        line->setText("retrosigmoid");
        ok->click();
        return true;
      });
  QTest::keyClick(&window(), Qt::Key_B, Qt::ControlModifier);
  EXPECT_TRUE(asked);
  EXPECT_EQ(value().dissection.history().branch().name, "retrosigmoid");
}
