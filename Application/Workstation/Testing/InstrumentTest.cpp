#include "GuiTest.h"

#include <cmath>
#include <fstream>

#include <QFileDialog>
#include <QInputDialog>
#include <QLineEdit>
#include <QSignalSpy>

#include "ActiveDeviceController.h"
#include "DrillController.h"
#include "SceneDisplay.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

class InstrumentWindow : public GuiTest
{
protected:
  // 60 mm long, 2 mm wide at the hand's end, which lies along `z+` or `x+` of the file.
  QString writePick(const std::string& name, bool lies = false) const
  {
    std::ofstream file(folder() / name);
    file << "v 0 0 0\n";
    for (const auto& [u, v] : {std::pair(1, 1), {-1, 1}, {-1, -1}, {1, -1}})
      lies ? file << "v 60 " << u << ' ' << v << '\n' : file << "v " << u << ' ' << v << " 60\n";
    file << "f 1 3 2\nf 1 4 3\nf 1 5 4\nf 1 2 5\nf 2 3 4\nf 2 4 5\n";
    return QString::fromStdString((folder() / name).string());
  }
  DrillController& drillController() { return *window().findChild<DrillController*>(); }
  const std::optional<rendering::ToolPose>& tool() { return view().display().tool(); }
  bool isHeld()
  {
    QTest::mouseMove(&view(), view().rect().center() + QPoint(3, 0));
    QTest::mouseMove(&view(), view().rect().center());
    return waitFor([this] { return tool() && tool()->instrument; });
  }
};

} // namespace

TEST_F(InstrumentWindow, IsDrawnAsItIsAndPressedOnBoneOfWhichItTakesNone)
{
  saveBall("ball");
  openWindow();
  const QString file = writePick("pick.obj");
  drillController().readInstrument(file, "z+");
  ASSERT_TRUE(waitFor([this] { return action("Instrument")->isChecked(); }));
  EXPECT_FALSE(action("Drill")->isChecked());
  ASSERT_TRUE(isHeld());
  EXPECT_EQ(tool()->instrument->triangles.size(), 6U);
  EXPECT_NEAR(tool()->instrument->bounds()[1].z(), 60.0F, 1e-4F);
  EXPECT_FALSE(tool()->handpiece);

  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, view().rect().center());
  // Its tip comes down onto the ball.
  EXPECT_TRUE(waitFor(
      [this]
      { return tool() && std::abs((tool()->center - kBallCenter).norm() - kBallRadius) < 0.35; }));
  QTest::qWait(300);
  EXPECT_FALSE(window().model().drilling());
  EXPECT_FALSE(tool()->drilling);
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, view().rect().center());
  QTest::qWait(200);
  EXPECT_TRUE(window().model().value().dissection.strokes().empty());
  EXPECT_TRUE(window().model().value().dissection.mask().untouched());

  action("Drill")->trigger(); // the burr again
  EXPECT_FALSE(action("Instrument")->isChecked());
  ASSERT_TRUE(waitFor([this] { return tool() && !tool()->instrument; }));
}

// The nerve is a sphere of 4 mm about the centre of the ball.
TEST_F(InstrumentWindow, IsWarnedOfAStructureFromItsNearestPoint)
{
  scene::Case value = ballCase("ball");
  value.labels.front().structures.front().look.warning = 40.0; // mm
  library().save(value);
  openWindow("ball");
  drillController().readInstrument(writePick("pick.obj"), "z+");
  ASSERT_TRUE(waitFor([this] { return action("Instrument")->isChecked(); }));
  ASSERT_TRUE(isHeld());
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, view().rect().center());
  EXPECT_TRUE(waitFor([this] { return view().display().warning().startsWith("nerve "); }))
      << view().display().warning().toStdString();
  QTest::qWait(500); // until it is at rest
  const QStringList words = view().display().warning().split(' ');
  ASSERT_GT(words.size(), 2);
  // Its tip is nearest, which points at the ball from outside.
  EXPECT_NEAR(words[1].toDouble(), (tool()->center - kBallCenter).norm() - 4.0, 0.4);
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, view().rect().center());
  action("Instrument")->trigger();
  EXPECT_TRUE(waitFor([this] { return view().display().warning().isEmpty(); }));
}

TEST_F(InstrumentWindow, IsRememberedAndReadWhenItIsTakenUpAgain)
{
  saveBall("ball");
  openWindow();
  const QString file = writePick("lying.obj", true);
  drillController().readInstrument(file, "x+");
  ASSERT_TRUE(waitFor([this] { return action("Instrument")->isChecked(); }));
  closeWindow();
  openWindow("ball");
  action("Instrument")->trigger();
  ASSERT_TRUE(waitFor([this] { return action("Instrument")->isChecked(); }));
  ASSERT_TRUE(isHeld());
  EXPECT_NEAR(tool()->instrument->bounds()[1].z(), 60.0F, 1e-4F) << "turned as before";
  closeWindow();

  std::filesystem::remove(folder() / "lying.obj");
  openWindow("ball");
  QString text;
  onMessage(
      [&text](QMessageBox& box)
      {
        text = box.text();
        box.accept();
      });
  action("Instrument")->trigger();
  ASSERT_TRUE(waitFor([&text] { return !text.isEmpty(); }));
  EXPECT_TRUE(text.contains("lying.obj")) << text.toStdString();
  EXPECT_FALSE(action("Instrument")->isChecked());
}

// What is still being read does not take the tool out of the hand.
TEST_F(InstrumentWindow, IsNotTakenUpWhenAnotherToolOrCaseCameMeanwhile)
{
  saveBall("ball");
  saveBall("other");
  openWindow("ball");
  const QString file = writePick("pick.obj");
  QSignalSpy read(&drillController(), &DrillController::instrumentRead);
  constexpr int kReads = 5000; // ms; below a second when nothing else runs

  drillController().readInstrument(file, "z+");
  action("Drill")->trigger();
  EXPECT_FALSE(waitFor([&read] { return !read.isEmpty(); }, kReads));
  EXPECT_TRUE(action("Drill")->isChecked());

  drillController().readInstrument(file, "z+");
  drillController().releaseTool();
  EXPECT_FALSE(waitFor([&read] { return !read.isEmpty(); }, kReads));
  EXPECT_FALSE(action("Instrument")->isChecked());

  drillController().readInstrument(file, "z+");
  action("Close the case")->trigger();
  ASSERT_FALSE(window().model().hasCase());
  window().begin("other");
  EXPECT_FALSE(waitFor([&read] { return !read.isEmpty(); }, kReads));
  ASSERT_TRUE(settled());
  EXPECT_EQ(window().model().value().name, "other");
  EXPECT_FALSE(action("Instrument")->isChecked());

  drillController().readInstrument(file, "z+"); // nothing came between
  EXPECT_TRUE(waitFor([this] { return action("Instrument")->isChecked(); }));
  EXPECT_EQ(read.size(), 1);
}

TEST_F(InstrumentWindow, LetsAStrokeGoOnThatIsOpenWhenItIsRead)
{
  saveBall("ball");
  openWindow("ball");
  const QString file = writePick("pick.obj");
  QTest::keyClick(&view(), Qt::Key_D);
  const QPoint middle = view().rect().center();
  QTest::mouseMove(&view(), middle);
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  ASSERT_TRUE(waitFor([this] { return window().model().drilling(); }));
  QSignalSpy read(&drillController(), &DrillController::instrumentRead);
  drillController().readInstrument(file, "z+");
  ASSERT_TRUE(waitFor([&read] { return !read.isEmpty(); }));
  QTest::qWait(100);
  EXPECT_TRUE(window().model().drilling());
  EXPECT_TRUE(action("Drill")->isChecked());
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  EXPECT_TRUE(strokeEnds());
  action("Instrument")->trigger(); // it is read already
  EXPECT_TRUE(action("Instrument")->isChecked());
}

// Its coupling is that of six degrees of freedom, whatever is chosen for the burr.
TEST_F(InstrumentWindow, IsFeltInSixDegreesOfFreedomWhereOnlyTheBurrIsFelt)
{
  openWindow();
  saveBall("ball");
  presenters::WorkstationModel model(library());
  model.open("ball");
  ToolDriver driver(model, view(), *window().findChild<ActiveDeviceController*>());
  constexpr double kThrust = 3.0; // N, more than the usual stiffness bears
  interaction::AimSettings aim;
  aim.thrust = kThrust;
  driver.set(aim);
  const auto stiffnessWith = [&driver](std::shared_ptr<const session::Instrument> instrument)
  {
    session::TouchSession::Setup setup;
    setup.tool.mode = session::TouchTool::Mode::ThreeDof;
    setup.tool.instrument = std::move(instrument);
    driver.prepare(setup);
    EXPECT_FALSE(driver.outgrown());
    return setup.tool.coupling.stiffness;
  };
  const double burr = stiffnessWith(nullptr);
  EXPECT_EQ(burr, session::couplingFor(session::TouchTool::Mode::ThreeDof, kThrust).stiffness);
  const double instrument = stiffnessWith(std::make_shared<const session::Instrument>());
  EXPECT_EQ(instrument, session::couplingFor(session::TouchTool::Mode::SixDof, kThrust).stiffness);
  EXPECT_GT(instrument, burr);
}

TEST_F(InstrumentWindow, IsRefusedInWordsWhenItIsNotClosed)
{
  saveBall("ball");
  openWindow();
  std::ofstream(folder() / "open.obj") << "v 0 0 0\nv 1 1 60\nv -1 1 60\nf 1 2 3\n";
  QString text;
  onMessage(
      [&text](QMessageBox& box)
      {
        text = box.text();
        box.accept();
      });
  drillController().readInstrument(QString::fromStdString((folder() / "open.obj").string()), "z+");
  ASSERT_TRUE(waitFor([&text] { return !text.isEmpty(); }));
  EXPECT_TRUE(text.contains("not closed")) << text.toStdString();
  EXPECT_FALSE(action("Instrument")->isChecked());
}

TEST_F(InstrumentWindow, IsChosenWithItsAxis)
{
  saveBall("ball");
  openWindow();
  const QString file = writePick("lying.obj", true);
  bool isFile = false;
  bool isAxis = false;
  onDialog(
      [&](QDialog& dialog)
      {
        if (auto* open = qobject_cast<QFileDialog*>(&dialog); open && !isFile)
        {
          isFile = true;
          open->findChild<QLineEdit*>("fileNameEdit")->setText(file);
          static_cast<QDialog&>(*open).accept();
        }
        if (auto* ask = qobject_cast<QInputDialog*>(&dialog))
        {
          isAxis = true;
          EXPECT_EQ(ask->textValue(), "z+") << "at first";
          ask->setTextValue("x+");
          ask->accept();
        }
        return isAxis;
      });
  action("Instrument from a file…")->trigger();
  EXPECT_TRUE(isFile && isAxis);
  ASSERT_TRUE(waitFor([this] { return action("Instrument")->isChecked(); }));
  ASSERT_TRUE(isHeld());
  EXPECT_NEAR(tool()->instrument->bounds()[1].z(), 60.0F, 1e-4F);
}
