#include "GuiTest.h"

#include <cmath>
#include <fstream>

#include <QAbstractButton>
#include <QFileDialog>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QSignalSpy>
#include <QToolButton>

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
  /// What is asked on the way to an instrument.
  struct Asked
  {
    bool file = false;
    QString axis;    ///< as it is proposed; empty: not asked for
    int axes = 0;    ///< to choose from
    QString refusal; ///< of a message
  };
  enum class Axis
  {
    Accepted,
    Rejected
  };
  /// Answers the dialogs until an axis is asked for or, with a file, a message refuses it. Without
  /// a file none is chosen, though a message's offer to choose one is taken.
  std::shared_ptr<const Asked> answerDialogs(const QString& file, Axis axis = Axis::Rejected)
  {
    auto asked = std::make_shared<Asked>();
    onDialog(
        [asked, file, axis](QDialog& dialog)
        {
          if (auto* open = qobject_cast<QFileDialog*>(&dialog))
          {
            if (!asked->file && !file.isEmpty())
            {
              open->findChild<QLineEdit*>("fileNameEdit")->setText(file);
              dialog.accept();
            }
            else if (file.isEmpty())
              dialog.reject();
            asked->file = true;
            return file.isEmpty();
          }
          if (auto* ask = qobject_cast<QInputDialog*>(&dialog))
          {
            asked->axis = ask->textValue();
            asked->axes = ask->comboBoxItems().size();
            axis == Axis::Accepted ? ask->accept() : ask->reject();
            return true;
          }
          auto* box = qobject_cast<QMessageBox*>(&dialog);
          if (!box || !asked->refusal.isEmpty())
            return false;
          asked->refusal = box->text();
          if (!file.isEmpty())
          {
            box->reject();
            return true;
          }
          clickOn(*box, QMessageBox::AcceptRole);
          return false;
        });
    return asked;
  }
  DrillController& drillController() { return *window().findChild<DrillController*>(); }
  const std::optional<rendering::ToolPose>& tool() { return view().display().tool(); }
  void save()
  {
    const auto before = window().model().value().revision;
    action("Save")->trigger();
    ASSERT_TRUE(
        waitFor([&] { return window().model().value().revision > before && !window().busy(); }));
  }
  // What a message box says that comes of it, and is accepted.
  QString messageAfter(const std::function<void()>& cause)
  {
    QString text;
    onMessage(
        [&text](QMessageBox& box)
        {
          text = box.text();
          box.accept();
        });
    cause();
    EXPECT_TRUE(waitFor([&text] { return !text.isEmpty(); }));
    return text;
  }
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
  // Its tip is nearest, which points at the ball from outside.
  EXPECT_TRUE(waitFor(
      [this]
      {
        if (!tool())
          return false;
        const QStringList words = view().display().warning().split(' ');
        const double distance = (tool()->center - kBallCenter).norm() - 4.0;
        return words[0] == "nerve" && words.size() > 2 &&
               std::abs(words[1].toDouble() - distance) < 0.4;
      }))
      << view().display().warning().toStdString();
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
  const QString text = messageAfter([this] { action("Instrument")->trigger(); });
  EXPECT_TRUE(text.contains("lying.obj")) << text.toStdString();
  EXPECT_FALSE(action("Instrument")->isChecked());
}

TEST_F(InstrumentWindow, IsKeptWithTheCaseAndTakenUpThereThoughItsFileIsGone)
{
  saveBall("ball");
  saveBall("other");
  openWindow("ball");
  drillController().readInstrument(writePick("lying.obj", true), "x+");
  ASSERT_TRUE(waitFor([this] { return action("Instrument")->isChecked(); }));
  save();
  closeWindow();
  const auto kept = library().open("ball").view.instrument;
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->axis, "x+");
  EXPECT_EQ(kept->name, "lying.obj");
  EXPECT_EQ(kept->mesh.get()->triangles.size(), 6U);
  EXPECT_EQ(kept->mesh.get()->bounds()[1].x(), 60.0F) << "as its file has it";

  // The user's own is another one by now.
  std::filesystem::remove(folder() / "lying.obj");
  openWindow("other");
  drillController().readInstrument(writePick("own.obj"), "z+");
  ASSERT_TRUE(waitFor([this] { return action("Instrument")->isChecked(); }));
  closeWindow();
  EXPECT_FALSE(library().open("other").view.instrument) << "it was not saved";

  openWindow("ball");
  EXPECT_FALSE(action("Instrument")->isChecked()) << "no tool is in the hand";
  action("Instrument")->trigger();
  ASSERT_TRUE(waitFor([this] { return action("Instrument")->isChecked(); }));
  EXPECT_TRUE(action("Instrument")->toolTip().startsWith("lying.obj"));
  ASSERT_TRUE(isHeld());
  EXPECT_NEAR(tool()->instrument->bounds()[1].z(), 60.0F, 1e-4F) << "turned as before";
  save();
  EXPECT_TRUE(*library().open("ball").view.instrument == *kept) << "the same object";
  closeWindow();

  // A case without one has the user's own again.
  openWindow("other");
  action("Instrument")->trigger();
  ASSERT_TRUE(waitFor([this] { return action("Instrument")->isChecked(); }));
  EXPECT_TRUE(action("Instrument")->toolTip().startsWith("own.obj"));
}

TEST_F(InstrumentWindow, IsTakenOutOfTheCaseAndItsFileStays)
{
  saveBall("ball");
  openWindow("ball");
  QAction* out = action("Take the instrument out of the case");
  EXPECT_FALSE(out->isEnabled());
  drillController().readInstrument(writePick("pick.obj"), "z+");
  ASSERT_TRUE(waitFor([this] { return action("Instrument")->isChecked(); }));
  EXPECT_TRUE(out->isEnabled());
  save();
  ASSERT_TRUE(library().open("ball").view.instrument);

  out->trigger();
  EXPECT_FALSE(action("Instrument")->isChecked()) << "put away";
  EXPECT_FALSE(out->isEnabled());
  save();
  EXPECT_FALSE(library().open("ball").view.instrument);
  EXPECT_TRUE(std::filesystem::exists(folder() / "pick.obj"));
  closeWindow();

  openWindow("ball");
  EXPECT_FALSE(action("Take the instrument out of the case")->isEnabled());
  action("Instrument")->trigger(); // from its file
  ASSERT_TRUE(waitFor([this] { return action("Instrument")->isChecked(); }));
  EXPECT_TRUE(action("Take the instrument out of the case")->isEnabled());
  action("Close the case")->trigger();
  ASSERT_TRUE(waitFor([this] { return !window().model().hasCase(); }));
  EXPECT_FALSE(action("Take the instrument out of the case")->isEnabled());
}

TEST_F(InstrumentWindow, ThatACaseHasLostIsSaidAndStaysInIt)
{
  scene::Case value = ballCase("ball");
  value.view.instrument.emplace();
  auto mesh = std::make_shared<core::TriangleMesh>();
  mesh->vertices = {{0, 0, 0}, {20, 0, 0}, {0, 20, 0}, {0, 0, 20}};
  mesh->triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  value.view.instrument->mesh = std::shared_ptr<const core::TriangleMesh>(mesh);
  library().save(value);
  const std::string object = value.view.instrument->object;
  std::filesystem::remove(library().folder() / "objects" / object);
  openWindow("ball");
  ASSERT_FALSE(messageAfter([this] { action("Instrument")->trigger(); }).isEmpty());
  EXPECT_FALSE(action("Instrument")->isChecked());
  save();
  closeWindow();
  ASSERT_TRUE(library().open("ball").view.instrument);
  EXPECT_EQ(library().open("ball").view.instrument->object, object);

  openWindow("ball");
  action("Take the instrument out of the case")->trigger();
  save();
  EXPECT_FALSE(library().open("ball").view.instrument);
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
  const QString file = QString::fromStdString((folder() / "open.obj").string());
  const QString text = messageAfter([&] { drillController().readInstrument(file, "z+"); });
  EXPECT_TRUE(text.contains("not closed")) << text.toStdString();
  EXPECT_FALSE(action("Instrument")->isChecked());
}

TEST_F(InstrumentWindow, IsChosenWithItsAxis)
{
  saveBall("ball");
  openWindow();
  const QString file = writePick("lying.obj", true);
  const auto asked = answerDialogs(file, Axis::Accepted);
  action("Instrument from a file…")->trigger();
  ASSERT_TRUE(waitFor([this] { return action("Instrument")->isChecked(); }));
  EXPECT_TRUE(asked->file);
  // It lies along x, and its tip is at the origin.
  EXPECT_EQ(asked->axis, QString::fromUtf8("x+: 60.0 × 2.0 mm, the tip at x = 0.0 mm"));
  EXPECT_EQ(asked->axes, 6);
  ASSERT_TRUE(isHeld());
  EXPECT_NEAR(tool()->instrument->bounds()[1].z(), 60.0F, 1e-4F);
  save();
  const auto kept = library().open("ball").view.instrument;
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->axis, "x+");
  EXPECT_EQ(kept->name, "lying.obj");
  EXPECT_EQ(kept->mesh.get()->triangles.size(), 6U);

  // The same file again: as it was chosen. Another one: as is likely.
  const QString upright = writePick("upright.obj");
  drillController().readInstrument(file, "z+");
  ASSERT_TRUE(waitFor(
      [this]
      { return tool() && tool()->instrument && tool()->instrument->bounds()[1].z() < 3.0F; }));
  const auto proposedFor = [this](const QString& chosen)
  {
    const auto proposed = answerDialogs(chosen);
    action("Instrument from a file…")->trigger();
    EXPECT_TRUE(waitFor([&proposed] { return !proposed->axis.isEmpty(); }));
    return proposed->axis.left(2);
  };
  EXPECT_EQ(proposedFor(file), "z+");
  EXPECT_EQ(proposedFor(upright), "z+");
  const QString other = writePick("other.obj", true);
  EXPECT_EQ(proposedFor(other), "x+");
}

TEST_F(InstrumentWindow, IsRefusedBeforeAnythingIsAskedAboutIt)
{
  saveBall("ball");
  openWindow();
  std::ofstream(folder() / "open.obj") << "v 0 0 0\nv 1 1 60\nv -1 1 60\nf 1 2 3\n";
  const QString file = QString::fromStdString((folder() / "open.obj").string());
  const auto asked = answerDialogs(file, Axis::Rejected);
  action("Instrument from a file…")->trigger();
  ASSERT_TRUE(waitFor([&] { return !asked->axis.isEmpty() || !asked->refusal.isEmpty(); }));
  EXPECT_TRUE(asked->file);
  EXPECT_TRUE(asked->axis.isEmpty()) << "it is asked about";
  EXPECT_TRUE(asked->refusal.contains("not closed")) << asked->refusal.toStdString();
}

// Nobody typed its name: a file can be chosen from the message.
TEST_F(InstrumentWindow, OffersToChooseItsFileAgainWhereThatIsGone)
{
  saveBall("ball");
  openWindow();
  const QString file = writePick("pick.obj");
  drillController().readInstrument(file, "z+");
  ASSERT_TRUE(waitFor([this] { return action("Instrument")->isChecked(); }));
  closeWindow();
  std::filesystem::rename(folder() / "pick.obj", folder() / "renamed.obj");
  openWindow("ball");
  const auto asked = answerDialogs({});
  action("Instrument")->trigger();
  ASSERT_TRUE(waitFor([&] { return asked->file; }));
  const QString& text = asked->refusal;
  EXPECT_TRUE(text.contains("not there any more") && text.contains("pick.obj"))
      << text.toStdString();
  EXPECT_FALSE(text.contains("check the name")) << "nobody typed one";
}

TEST_F(InstrumentWindow, IsNamedInTheBarWhoseBurrDoesNotApplyToIt)
{
  saveBall("ball");
  openWindow("ball");
  auto* button = window().findChild<QToolButton*>("instrumentButton");
  ASSERT_TRUE(button);
  const auto burrIs = [this](bool enabled)
  {
    for (const char* name : {"burrDiameter", "burrKind", "spindleSpeed"})
      EXPECT_EQ(window().findChild<QWidget*>(name)->isEnabled(), enabled) << name;
    for (const char* name : {"Smaller burr", "Larger burr", "Next kind of burr"})
      EXPECT_EQ(action(name)->isEnabled(), enabled) << name;
  };
  burrIs(true);
  drillController().readInstrument(writePick("pick.obj"), "z+");
  ASSERT_TRUE(waitFor([button] { return button->isChecked(); }));
  EXPECT_EQ(button->text(), "pick.obj");
  burrIs(false);
  EXPECT_TRUE(window().findChild<QWidget*>("thrust")->isEnabled()) << "it is pressed";

  QTest::keyClick(&view(), Qt::Key_I);
  EXPECT_FALSE(button->isChecked());
  EXPECT_EQ(button->text(), "Instrument");
  burrIs(true);
  QTest::keyClick(&view(), Qt::Key_I);
  EXPECT_TRUE(button->isChecked());
  QTest::keyClick(&view(), Qt::Key_D);
  EXPECT_FALSE(button->isChecked());
  burrIs(true);
}

TEST_F(InstrumentWindow, LeadsTheSlicesByItsTip)
{
  saveBall("ball");
  openWindow("ball");
  drillController().readInstrument(writePick("pick.obj"), "z+");
  ASSERT_TRUE(waitFor([this] { return action("Instrument")->isChecked(); }));
  const auto apart = [this]
  { return tool() ? (window().model().crosshair() - tool()->center).norm() : std::nan(""); };
  ASSERT_TRUE(isHeld());
  EXPECT_TRUE(waitFor([&] { return apart() < 0.1; })) << apart();
  EXPECT_GT((window().model().crosshair() - kBallCenter).norm(), 0.5 * kBallRadius);
  action("Slices follow the burr")->trigger();
  const Eigen::Vector3d before = window().model().crosshair();
  QTest::mouseMove(&view(), view().rect().center() + QPoint(40, 0));
  EXPECT_TRUE(waitFor([&] { return apart() > 0.5; })) << "it moved, and the slices did not";
  EXPECT_EQ(window().model().crosshair(), before);
}

// It is air to a tool, and what the tool lies on must be seen: whichever tool, and whatever came
// first.
TEST_F(InstrumentWindow, SoftTissueIsLeftOutWhileAnyToolIsInTheHand)
{
  saveBall("ball");
  openWindow("ball");
  drillController().readInstrument(writePick("pick.obj"), "z+");
  ASSERT_TRUE(waitFor([this] { return action("Instrument")->isChecked(); }));
  drillController().releaseTool();
  ASSERT_TRUE(settled() && waitFor([this] { return window().model().drawable(); }));
  auto* soft = window().findChild<QAbstractButton*>("softTissue");
  auto* note = view().findChild<QLabel*>("guessed");
  ASSERT_TRUE(soft && note);
  const QString leftOut = "Soft tissue is left out while a tool is in the hand";
  const auto isShown = [&] { return !note->isHidden() && note->text().contains(leftOut); };
  const auto isDrawn = [this] { return view().display().contents().softTissue.has_value(); };
  for (const char* held : {"Drill", "Pointer", "Instrument"})
  {
    SCOPED_TRACE(held);
    soft->setChecked(true);
    EXPECT_TRUE(isDrawn());
    EXPECT_FALSE(isShown());
    action(held)->trigger();
    ASSERT_TRUE(action(held)->isChecked());
    EXPECT_FALSE(isDrawn());
    EXPECT_TRUE(isShown());
    action(held)->trigger();
    EXPECT_TRUE(isDrawn());
    EXPECT_FALSE(isShown());

    soft->setChecked(false);
    action(held)->trigger();
    EXPECT_FALSE(isShown());
    soft->setChecked(true); // with the tool in the hand
    EXPECT_FALSE(isDrawn());
    EXPECT_TRUE(isShown());
    action(held)->trigger();
    EXPECT_TRUE(soft->isChecked());
    EXPECT_TRUE(isDrawn());
    EXPECT_FALSE(isShown());
  }
}
