#include "GuiTest.h"

#include <algorithm>
#include <future>

#include <QAbstractItemView>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPointer>
#include <QPushButton>
#include <QRegularExpression>
#include <QSpinBox>
#include <QStatusBar>
#include <QTableView>
#include <QTimer>
#include <QTreeWidget>

#include "BackgroundWork.h"
#include "Banner.h"
#include "Commands.h"
#include "LandmarkModel.h"
#include "MetricCurve.h"
#include "MrOverlay.h"
#include "RegistrationController.h"
#include "RegistrationTargetBox.h"
#include "SliceColumn.h"
#include "SliceView.h"
#include "petrous/Phantom/Phantom.h"
#include "petrous/Scene/ApplyRegistration.h"

using namespace petrous;
using namespace petrous::workstation;
using Eigen::Vector3d;
using phantom::Phantom;

namespace
{

// The phantom's ear as CT and, moved by a known motion, as MR.
class RegistrationWindow : public GuiTest
{
protected:
  void SetUp() override
  {
    scene::Case value;
    value.name = "ear";
    value.ct = scan(Phantom::Modality::Ct, {}, 0.9);
    value.ct.name = "ct";
    value.mr = {scan(Phantom::Modality::Mr, phantom.mrFromCt(), 1.1)};
    value.mr.front().name = "T2";
    library().save(value);
    openWindow("ear");
    picture(); // until it is at rest
  }

  scene::ImagePart scan(Phantom::Modality modality, const core::RigidTransform& motion,
                        double spacing)
  {
    const Vector3d center = motion * Phantom::center();
    const core::GridGeometry grid({64, 64, 56}, Vector3d::Constant(spacing),
                                  center - 0.5 * spacing * Vector3d(63, 63, 55));
    phantom::ScanSettings settings;
    settings.modality = modality;
    settings.patientFromScan = motion.inverse();
    scene::ImagePart part;
    part.geometry = grid;
    part.volume = std::make_shared<const volume::IntensityVolume>(
        std::make_shared<const volume::Volume<std::int16_t>>(
            phantom::samplePhantom(phantom, grid, settings)));
    part.range = part.volume.get()->range();
    return part;
  }

  template <class Widget>
  Widget& find(const char* name)
  {
    return *window().findChild<Widget*>(name);
  }
  void click(const char* name) { find<QAbstractButton>(name).click(); }
  /// Starts a registration and cancels it; `react` handles the message box.
  void stop(const std::function<void(QMessageBox&)>& react)
  {
    if (find<QAbstractButton>("register").isEnabled())
      click("register");
    ASSERT_TRUE(waitFor([this] { return find<MetricCurve>("metricCurve").points() > 3; }));
    bool asked = false;
    onMessage(
        [&](QMessageBox& box)
        {
          asked = true;
          react(box);
        });
    click("cancelRegistration");
    ASSERT_TRUE(waitFor([&] { return asked; }));
    QTest::qWait(50);
  }
  /// Leaves the case or the window during a run, and answers the question about it.
  void leaveBy(QMessageBox::ButtonRole role, const std::function<void()>& leave)
  {
    int asked = 0;
    onMessage(
        [&](QMessageBox& box)
        {
          ++asked;
          EXPECT_EQ(box.objectName(), "askJobs");
          EXPECT_TRUE(box.text().contains("registration of the MR")) << box.text().toStdString();
          EXPECT_TRUE(box.text().contains("T2")) << box.text().toStdString();
          clickOn(box, role);
        });
    leave();
    EXPECT_EQ(asked, 1);
  }
  /// Or hides it.
  void showPanel()
  {
    // Without a window manager a late focus event can have taken it: then no shortcut works.
    QApplication::setActiveWindow(&window());
    QTest::keyClick(&window(), Qt::Key_F5);
    layOut();
  }
  /// The dock's coming changes the slices' size by posted events, which a grab does not wait for.
  static void layOut()
  {
    QApplication::sendPostedEvents(nullptr, QEvent::LayoutRequest);
    QApplication::processEvents();
  }
  const scene::ImagePart& mr() { return window().model().value().mr.front(); }
  QString state() { return find<QLabel>("registrationState").text(); }
  QImage axial()
  {
    awaitMr();
    return find<SliceView>("axialView").grab().toImage();
  }
  static bool same(const QImage& a, const QImage& b)
  {
    return differentPixels(a, b, kSmoothing) == 0;
  }
  static double differing(const QImage& a, const QImage& b) // share of pixels
  {
    if (a.size() != b.size())
      return 1.0;
    int count = 0;
    for (int y = 0; y < a.height(); ++y)
      for (int x = 0; x < a.width(); ++x)
        count += a.pixel(x, y) != b.pixel(x, y) ? 1 : 0;
    return static_cast<double>(count) / (a.width() * a.height());
  }
  MrOverlay& overlay() { return *window().findChild<MrOverlay*>(); }
  /// Until the MR is read that is to be seen.
  void awaitMr()
  {
    EXPECT_TRUE(waitFor([this] { return !overlay().reading(); }));
  }
  void choose(int mode)
  {
    find<QComboBox>("overlayMode").setCurrentIndex(mode);
    awaitMr();
  }
  void flick(QWidget& from)
  {
    QTest::keyClick(&from, Qt::Key_V);
    awaitMr();
  }
  double error() // at the ear, mm
  {
    return (mr().mrFromCt * Phantom::center() - phantom.mrFromCt() * Phantom::center()).norm();
  }

  Phantom phantom;
};

} // namespace

// What is not registered is not seen: it is said, with the way to it.
TEST_F(RegistrationWindow, SaysThatAnMrCameAlongThatIsNotRegistered)
{
  auto& banner = find<Banner>("mrBanner");
  ASSERT_TRUE(banner.isVisible());
  EXPECT_TRUE(banner.text().contains("T2") && banner.text().contains("Register the MR"))
      << banner.text().toStdString();
  auto* dock = window().findChild<QDockWidget*>("registrationDock");
  EXPECT_FALSE(dock->isVisible());
  showPanel();
  EXPECT_TRUE(dock->isVisible());
  EXPECT_FALSE(banner.isVisible()) << "the panel says so itself";
  showPanel(); // hides it
  EXPECT_FALSE(dock->isVisible());
  banner.show();
  click("registerMr");
  EXPECT_TRUE(dock->isVisible());
  EXPECT_FALSE(banner.isVisible());
  closeWindow();

  scene::Case value = library().open("ear");
  value.mr.front().registered = true;
  library().save(value);
  openWindow("ear");
  EXPECT_FALSE(find<Banner>("mrBanner").isVisible());
}

TEST_F(RegistrationWindow, LoadsNothingOfTheMrUntilItIsShown)
{
  EXPECT_FALSE(find<QDockWidget>("registrationDock").isVisible());
  showPanel();
  EXPECT_TRUE(find<QDockWidget>("registrationDock").isVisible());
  EXPECT_EQ(state(), "not registered");
  EXPECT_EQ(mr().volume.peek(), nullptr);
  ASSERT_TRUE(waitFor([this] { return settled(); }));
  const QImage ct = steady([this] { return axial(); });
  choose(2); // edges
  EXPECT_NE(mr().volume.peek(), nullptr);
  EXPECT_NE(axial(), ct);
  choose(0);
  EXPECT_TRUE(waitFor([&] { return same(axial(), ct); }));
}

TEST_F(RegistrationWindow, AnMrThatIsSlowToReadDoesNotHoldTheWindow)
{
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  std::promise<void> gate;
  const auto opened = gate.get_future().share();
  const scene::Case before = model.value();
  scene::Case with = before;
  scene::ImagePart slow = scan(Phantom::Modality::Mr, phantom.mrFromCt(), 1.4);
  slow.name = "slow";
  slow.volume = core::Lazy<volume::IntensityVolume>(
      [opened, voxels = slow.volume.get()]
      {
        opened.wait_for(std::chrono::seconds(20)); // not for ever, should the window wait for it
        return voxels;
      });
  with.mr.push_back(slow);
  model.takeParts(before, std::move(with));
  find<QComboBox>("registrationMr").setCurrentText("slow");
  find<QComboBox>("overlayMode").setCurrentIndex(2);
  EXPECT_TRUE(overlay().reading());
  EXPECT_TRUE(overlay().shown().ct && overlay().shown().mr.empty()) << "what is seen until then";
  gate.set_value();
  EXPECT_TRUE(waitFor([this] { return overlay().shown().mr == "slow"; }));
  EXPECT_FALSE(overlay().reading());
}

TEST_F(RegistrationWindow, KeysFlickBetweenCtAndMrAndGoThroughTheWays)
{
  const QImage ct = steady([this] { return axial(); });
  flick(view());
  const QImage mrAlone = axial();
  EXPECT_NE(mrAlone, ct);
  flick(view());
  const QImage ctAlone = axial();
  EXPECT_NE(ctAlone, mrAlone);
  flick(view());
  EXPECT_TRUE(same(axial(), mrAlone));
  picture();
  QTest::keyClick(&view(), Qt::Key_O); // back to the initial mode
  EXPECT_TRUE(same(axial(), ct));
  std::vector<QImage> ways;
  for (int n = 0; n < 3; ++n)
  {
    QTest::keyClick(&view(), Qt::Key_O);
    ways.push_back(axial());
    EXPECT_EQ(find<QComboBox>("overlayMode").currentIndex(), n + 1);
  }
  EXPECT_NE(ways[0], ways[1]);
  EXPECT_NE(ways[1], ways[2]);
  QTest::keyClick(&view(), Qt::Key_O);
  EXPECT_TRUE(same(axial(), ct));
}

TEST_F(RegistrationWindow, TheValueUnderThePointerIsThatOfTheImageSeen)
{
  auto& slice = find<SliceView>("axialView");
  auto& place = find<QLabel>("place");
  QTest::mouseMove(&slice, QPoint(slice.width() / 3, slice.height() / 2));
  ASSERT_TRUE(waitFor([&] { return place.text().contains("HU"); })) << place.text().toStdString();
  const QString ct = place.text();
  flick(view());
  ASSERT_TRUE(waitFor([&] { return place.text() != ct; })) << "the MR";
  flick(view());
  EXPECT_TRUE(waitFor([&] { return place.text() == ct; })) << place.text().toStdString();
}

TEST_F(RegistrationWindow, SaysThatNoEarIsKnown)
{
  auto& note = find<QLabel>("registrationPlaceNote");
  EXPECT_FALSE(note.isHidden());
  EXPECT_TRUE(note.text().startsWith("The case has no ossicle")) << note.text().toStdString();
  find<QComboBox>("registrationPlace").setCurrentIndex(1); // the crosshair
  EXPECT_TRUE(note.isHidden());
}

TEST_F(RegistrationWindow, PlacesOfTheErrorAreToldApart)
{
  scene::Case value = ballCase("two");
  auto& structures = value.labels[0].structures;
  const std::string canal = "superior_semicircular_canal_of_the_temporal_bone_";
  scene::StructurePart one = structures.front();
  structures.clear();
  for (const auto& [name, volume] : {std::pair(std::string("cochlea"), 74.0),
                                     {"cochlea 2", 80.0},
                                     {canal + "a", 15.0},
                                     {canal + "b", 15.0}})
  {
    one.name = name;
    one.volume = volume;
    structures.push_back(one);
    ++one.index;
  }
  presenters::WorkstationModel model(library());
  model.adopt(std::move(value));
  presenters::RegistrationSession session(model);
  session.caseChanged();
  RegistrationTargetBox box(session);
  box.refresh();
  box.refresh(); // again the same ones
  auto& places = *box.findChild<QComboBox*>("registrationPlace");
  ASSERT_EQ(places.count(), 6);
  EXPECT_EQ(places.itemText(2), QString::fromUtf8("cochlea (74.00 mm³)"));
  EXPECT_EQ(places.itemText(3), QString::fromUtf8("cochlea 2 (80.00 mm³)"));
  EXPECT_EQ(places.itemText(4), QString::fromStdString(canal + "a").replace('_', ' '));
  EXPECT_TRUE(places.itemData(4, Qt::ToolTipRole).toString().contains("mm³"));

  box.resize(280, box.sizeHint().height());
  box.show();
  const auto seen = [&places](int row)
  {
    places.setCurrentIndex(row);
    return places.grab().toImage();
  };
  const QString whole = places.itemText(5);
  ASSERT_GT(places.fontMetrics().horizontalAdvance(whole), places.width());
  const QImage fourth = seen(4);
  EXPECT_NE(seen(5), fourth) << "elided before what differs";
  EXPECT_EQ(session.aim().structure, canal + "b");
  EXPECT_TRUE(places.toolTip().contains(whole)) << places.toolTip().toStdString();
  places.showPopup();
  EXPECT_GT(places.view()->width(), places.fontMetrics().horizontalAdvance(whole));
  places.hidePopup();
}

TEST_F(RegistrationWindow, RegistersWithProgressAndStatesTheError)
{
  showPanel();
  EXPECT_GT(error(), 5.0);
  click("register");
  EXPECT_FALSE(find<QPushButton>("register").isEnabled());
  EXPECT_TRUE(find<QPushButton>("cancelRegistration").isEnabled());
  ASSERT_TRUE(waitFor([this] { return mr().registered; }, 240000)) << state().toStdString();
  EXPECT_LT(error(), 0.5);
  EXPECT_GT(find<MetricCurve>("metricCurve").points(), 5U);
  EXPECT_TRUE(state().contains("mutual information")) << state().toStdString();
  EXPECT_TRUE(state().contains("p95")) << state().toStdString();
  EXPECT_TRUE(find<QPushButton>("register").isEnabled());
  EXPECT_EQ(find<QComboBox>("overlayMode").currentIndex(), 2) << "what came of it is seen";
  picture();
  QTest::keyClick(&window(), Qt::Key_S, Qt::ControlModifier);
  EXPECT_TRUE(settled());
  const scene::Case saved = library().open("ear");
  ASSERT_TRUE(saved.mr.front().registered);
  EXPECT_TRUE(saved.mr.front().registration.has_value());
}

TEST_F(RegistrationWindow, TheSegmentPanelWorksOnWhatTheSlicesShow)
{
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  model.changeMr(
      [this](scene::Case& value)
      { scene::applyRegistration(value, "T2", phantom.mrFromCt(), scene::Registration()); });
  auto& source = find<QComboBox>("segmentSource");
  auto& note = find<QLabel>("segmentShown");
  showPanel();
  const QImage ct = axial();
  choose(2); // as after a registration
  EXPECT_EQ(source.currentText(), "T2");
  choose(0);
  EXPECT_EQ(source.currentText(), "CT");
  source.setCurrentIndex(1);
  EXPECT_NE(axial(), ct);
  EXPECT_TRUE(note.isHidden());
  source.setCurrentIndex(0);
  EXPECT_TRUE(waitFor([&] { return same(axial(), ct); }));

  QTest::keyClick(&window(), Qt::Key_N, Qt::ShiftModifier);
  EXPECT_TRUE(note.isHidden());
  flick(view()); // the MR alone
  EXPECT_FALSE(note.isHidden());
  EXPECT_TRUE(note.text().contains("T2")) << note.text().toStdString();
  auto& slice = find<SliceView>("axialView");
  QTest::mouseClick(&slice, Qt::LeftButton, Qt::NoModifier, slice.rect().center());
  EXPECT_EQ(find<QTreeWidget>("nervePoints").topLevelItemCount(), 0) << "not on an unseen image";
  EXPECT_FALSE(find<QLabel>("segmentRemark").text().isEmpty());
  click("segmentTakeShown");
  EXPECT_TRUE(note.isHidden());
  EXPECT_EQ(source.currentText(), "T2");
  QTest::mouseClick(&slice, Qt::LeftButton, Qt::NoModifier, slice.rect().center());
  EXPECT_EQ(find<QTreeWidget>("nervePoints").topLevelItemCount(), 1);
  flick(view()); // the CT alone
  EXPECT_FALSE(note.isHidden());
  click("segmentShowSource");
  EXPECT_TRUE(note.isHidden());
  find<QPushButton>("segmentUndo").click(); // no draft that the window asks about
}

TEST_F(RegistrationWindow, SaysWhatItDoesWhereItCanBeSeen)
{
  EXPECT_FALSE(find<QDockWidget>("registrationDock").isVisible());
  action("Register the MR")->trigger();
  EXPECT_TRUE(find<QDockWidget>("registrationDock").isVisible());
  EXPECT_FALSE(find<QDockWidget>("registrationDock").visibleRegion().isEmpty());
  stop([](QMessageBox& box) { clickOn(box, QMessageBox::RejectRole); });
}

TEST_F(RegistrationWindow, CancelOffersToKeepWhatWasReached)
{
  showPanel();
  for (const bool keep : {false, true})
  {
    stop([keep](QMessageBox& box)
         { clickOn(box, keep ? QMessageBox::AcceptRole : QMessageBox::RejectRole); });
    EXPECT_EQ(mr().registered, keep);
    EXPECT_TRUE(find<QPushButton>("register").isEnabled());
  }
  EXPECT_NE(mr().registration->verdict, scene::Registration::Verdict::Good);
  click("undoMr");
  EXPECT_FALSE(mr().registered);
}

TEST_F(RegistrationWindow, WhatWasReachedCanBeKeptAlsoUnderAnotherNameButNotInAnotherCase)
{
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  showPanel();
  stop(
      [&](QMessageBox& box)
      {
        model.saveAs("left ear");
        clickOn(box, QMessageBox::AcceptRole);
      });
  EXPECT_EQ(model.value().name, "left ear");
  EXPECT_TRUE(mr().registered) << "kept";
  click("undoMr");
  EXPECT_FALSE(mr().registered);
  QPointer<QMessageBox> question;
  stop(
      [&](QMessageBox& box)
      {
        question = &box;
        model.open("ear");
      });
  EXPECT_TRUE(question.isNull()) << "the question was about the case before";
  EXPECT_FALSE(mr().registered);
}

TEST_F(RegistrationWindow, AsksForNoMoreThanFitsAndStatesTheErrorWhereItIsWanted)
{
  window().resize(1440, 900);
  showPanel();
  EXPECT_FALSE(find<QPushButton>("sign").visibleRegion().isEmpty()) << "in reach at once";
  EXPECT_FALSE(find<QPushButton>("register").visibleRegion().isEmpty());
  EXPECT_FALSE(find<QComboBox>("registrationOnto").isVisible()) << "there is one MR";
  EXPECT_FALSE(find<QTableView>("landmarks").isVisible());
  QTest::keyClick(&view(), Qt::Key_K);
  EXPECT_TRUE(find<QTableView>("landmarks").isVisible());
  click("handFold");
  EXPECT_FALSE(find<QPushButton>("sign").visibleRegion().isEmpty());

  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  const Vector3d there = Phantom::center() + Vector3d(5, 4, 3);
  model.setCrosshair(there);
  find<QComboBox>("registrationPlace").setCurrentIndex(1);
  find<QSpinBox>("registrationBox").setValue(40);
  click("register");
  ASSERT_TRUE(waitFor([this] { return mr().registered; }, 240000)) << state().toStdString();
  ASSERT_TRUE(mr().registration->error);
  EXPECT_LT((mr().registration->error->point - there).norm(), 1e-9);
  EXPECT_LT(error(), 1.0);
}

TEST_F(RegistrationWindow, TheSlicesShowTheRegionThatCountsWhileThePanelIsOpen)
{
  showPanel();
  const QImage whole = steady([this] { return axial(); });
  find<QSpinBox>("registrationBox").setValue(30);
  const QImage box = axial();
  const presenters::SliceGeometry slice = find<SliceView>("axialView").slice();
  const Eigen::Vector2d middle = slice.pixelFromPatient(window().model().crosshair());
  QRect changed;
  for (int y = 0; y < box.height(); ++y)
    for (int x = 0; x < box.width(); ++x)
      if (box.pixel(x, y) != whole.pixel(x, y))
        changed |= QRect(x, y, 1, 1);
  const double edge = 30.0 / slice.mmPerPixel();
  EXPECT_NEAR(changed.width(), edge, 5.0);
  EXPECT_NEAR(changed.height(), edge, 5.0);
  EXPECT_NEAR(changed.center().x(), middle.x(), 3.0);
  EXPECT_NEAR(changed.center().y(), middle.y(), 3.0);
  showPanel(); // hides it
  EXPECT_TRUE(waitFor([&] { return same(axial(), whole); }));
}

TEST_F(RegistrationWindow, TheHandMovesTheMrByKeyAndButtonAndCanBeUndone)
{
  showPanel();
  choose(2);
  auto& slice = find<SliceView>("axialView");
  const QImage before = axial();
  QTest::keyClick(&slice, Qt::Key_Right, Qt::AltModifier | Qt::ShiftModifier);
  EXPECT_TRUE(mr().registered);
  EXPECT_TRUE(state().contains("by hand")) << state().toStdString();
  // The overlay moves to the picture's right, the patient's left: what was at p is at p + 1 mm.
  EXPECT_LT((mr().mrFromCt * Vector3d(1, 0, 0)).norm(), 1e-9);
  EXPECT_NE(axial(), before);
  QTest::keyClick(&slice, Qt::Key_Down, Qt::AltModifier);
  EXPECT_LT((mr().mrFromCt * Vector3d(1, 0.1, 0)).norm(), 1e-9);
  QTest::keyClick(&slice, Qt::Key_PageDown, Qt::AltModifier);
  EXPECT_NEAR(Eigen::AngleAxisd(mr().mrFromCt.rotation()).angle(), 0.1 * 3.14159265 / 180.0, 1e-9);
  find<QComboBox>("nudgeStep").setCurrentIndex(1);
  click("handle30"); // inferior
  ASSERT_TRUE(waitFor([this] { return find<QLabel>("liveMetric").text().contains("by hand"); }))
      << find<QLabel>("liveMetric").text().toStdString();
  for (int n = 0; n < 4; ++n)
    QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier | Qt::AltModifier);
  EXPECT_FALSE(mr().registered);
  EXPECT_FALSE(find<QPushButton>("undoMr").isEnabled());
  picture();
}

// 500 mm beside the CT it may lie, and no farther.
TEST_F(RegistrationWindow, AMoveToNowhereIsRefusedInWords)
{
  showPanel();
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  const core::PatientBox box = mr().geometry.patientBounds();
  Vector3d at = box.center();
  at.x() = box.max().x() + 499.5;
  const core::RigidTransform far(Eigen::Quaterniond::Identity(),
                                 at - model.value().ct.geometry.center());
  model.changeMr([&far](scene::Case& value)
                 { scene::applyRegistration(value, "T2", far, scene::Registration()); });
  ASSERT_TRUE(mr().registered);
  choose(2);
  const auto& line = find<QLabel>("registrationLine");
  find<QComboBox>("nudgeStep").setCurrentIndex(1);
  click("handle10"); // to the right
  EXPECT_TRUE(line.text().contains("cannot be registered so")) << line.text().toStdString();
  EXPECT_EQ(mr().mrFromCt.matrix(), far.matrix());
  click("handle11");
  EXPECT_EQ(line.text(), "");
  EXPECT_NEAR((mr().mrFromCt * Vector3d::Zero() - far * Vector3d::Zero()).norm(), 1.0, 1e-9);
  auto& slice = find<SliceView>("axialView");
  for (int n = 0; n < 2; ++n)
    QTest::keyClick(&slice, Qt::Key_Left, Qt::AltModifier | Qt::ShiftModifier);
  EXPECT_TRUE(line.text().contains("cannot be registered so")) << line.text().toStdString();
  EXPECT_FALSE(find<Banner>("faultBanner").isVisible());
}

TEST_F(RegistrationWindow, ASettingThatIsFoldedIsUnfoldedWhenItIsFound)
{
  auto& step = find<QComboBox>("nudgeStep");
  EXPECT_FALSE(step.isVisible());
  const auto settings = settingsOf(window(), true);
  const auto found = std::find_if(settings.begin(), settings.end(),
                                  [&step](const Command& one) { return one.control == &step; });
  ASSERT_NE(found, settings.end());
  EXPECT_EQ(found->name, "Step");
  EXPECT_EQ(found->menu, QString::fromUtf8("Registration › By hand"));
  EXPECT_TRUE(found->isEnabled);
  showSetting(step);
  EXPECT_TRUE(waitFor([&step] { return !step.visibleRegion().isEmpty(); }));
  EXPECT_EQ(window().focusWidget(), &step);
}

TEST_F(RegistrationWindow, LaysTheMrByPairsOfPointsThatWerePickedInTheSlices)
{
  showPanel();
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  const core::RigidTransform truth = phantom.mrFromCt();
  for (const Vector3d& off : {Vector3d(8, 0, 2), Vector3d(-6, 7, 0), Vector3d(0, -8, -7)})
  {
    const Vector3d ct = Phantom::center() + off;
    model.setCrosshair(ct);
    QTest::keyClick(&view(), Qt::Key_K);
    model.setCrosshair(truth * ct); // not registered: the MR appears as in its header
    QTest::keyClick(&view(), Qt::Key_K);
  }
  auto& rows = *find<QTableView>("landmarks").model();
  ASSERT_EQ(rows.rowCount(), 3);
  EXPECT_GT(rows.index(0, LandmarkModel::Residual).data().toString().split(' ')[0].toDouble(), 3.0);
  picture();
  click("fitLandmarks");
  ASSERT_TRUE(waitFor([this] { return mr().registered; }));
  EXPECT_LT(error(), 1e-6);
  EXPECT_EQ(mr().registration->verdict, scene::Registration::Verdict::Doubtful);
  EXPECT_EQ(rows.index(2, LandmarkModel::Residual).data().toString(), "0.00 mm");
  EXPECT_TRUE(state().contains("landmarks")) << state().toStdString();
  EXPECT_TRUE(find<QPushButton>("undoMr").toolTip().contains("registration of T2"));
  QAction* undo = action("Undo registration of T2");
  ASSERT_TRUE(undo) << "the last thing done";
  EXPECT_EQ(undo->shortcut(), QKeySequence(Qt::CTRL + Qt::Key_Z));
  undo->trigger();
  EXPECT_FALSE(mr().registered);
  EXPECT_FALSE(find<QPushButton>("undoMr").isEnabled());
  EXPECT_TRUE(find<QPushButton>("redoMr").isEnabled()) << "the same step";
  ASSERT_TRUE(action("Redo registration of T2"));
  click("redoMr");
  EXPECT_LT(error(), 1e-6);
  EXPECT_FALSE(find<QPushButton>("redoMr").isEnabled());
  find<QTableView>("landmarks").selectRow(1);
  click("removeLandmark");
  EXPECT_EQ(find<QTableView>("landmarks").currentIndex().row(), 1) << "the next one is chosen";
  EXPECT_EQ(rows.rowCount(), 2);
  EXPECT_FALSE(find<QPushButton>("fitLandmarks").isEnabled());
}

TEST_F(RegistrationWindow, IsSignedWithANameThatIsTypedAndOnlyForAsLongAsItLiesSo)
{
  showPanel();
  auto& name = find<QLineEdit>("signName");
  EXPECT_FALSE(name.isEnabled()) << "nothing to sign yet";
  EXPECT_TRUE(name.text().isEmpty());
  find<QComboBox>("nudgeStep").setCurrentIndex(1);
  click("handle10");
  EXPECT_FALSE(find<QPushButton>("sign").isEnabled()) << "no name, no signature";
  QTest::keyClicks(&name, "A. Surgeon");
  click("sign");
  ASSERT_NE(scene::validSignOff(mr()), nullptr);
  EXPECT_TRUE(state().contains("A. Surgeon")) << state().toStdString();
  EXPECT_TRUE(name.text().isEmpty());
  QTest::keyClick(&window(), Qt::Key_S, Qt::ControlModifier);
  EXPECT_TRUE(settled());
  ASSERT_NE(scene::validSignOff(library().open("ear").mr.front()), nullptr);
  click("handle11");
  EXPECT_EQ(scene::validSignOff(mr()), nullptr);
  EXPECT_FALSE(state().contains("A. Surgeon")) << state().toStdString();
}

TEST_F(RegistrationWindow, AResultWaitsForTheDrill)
{
  showPanel();
  bool drilled = false;
  bool waited = false;
  bool moved = false;
  QTimer watch;
  QObject::connect(&watch, &QTimer::timeout, &watch,
                   [&]
                   {
                     drilled |= window().model().drilling();
                     moved |= window().model().drilling() && mr().registered;
                     waited |= find<QLabel>("registrationLine").text().contains("drill");
                     if (waited)
                       view().tool().DrillModeOff(); // ends the stroke
                   });
  watch.start(5);
  QTest::keyClick(&view(), Qt::Key_D);
  QTest::mouseMove(&view(), view().rect().center());
  ASSERT_TRUE(waitFor([this] { return window().model().touching(); }));
  click("register");
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, view().rect().center());
  ASSERT_TRUE(waitFor([&] { return drilled; }));
  EXPECT_TRUE(waitFor([&] { return waited || mr().registered; }, 240000));
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, view().rect().center());
  ASSERT_TRUE(waitFor([&] { return mr().registered; })) << state().toStdString();
  EXPECT_TRUE(waited);
  EXPECT_FALSE(moved);
  EXPECT_LT(error(), 0.5);
  EXPECT_TRUE(find<QPushButton>("register").isEnabled());
}

TEST_F(RegistrationWindow, ARunThatTheUserStopsEndsWithItsCase)
{
  showPanel();
  click("register");
  ASSERT_TRUE(window().findChild<RegistrationController*>()->running());
  leaveBy(QMessageBox::DestructiveRole, [this] { action("Close the case")->trigger(); });
  EXPECT_TRUE(waitFor([this] { return !window().model().hasCase(); }));
  EXPECT_FALSE(library().open("ear").mr.front().registered);
}

TEST_F(RegistrationWindow, ACaseThatIsToBeClosedAfterARunIsClosedWithItsResult)
{
  showPanel();
  click("register");
  leaveBy(QMessageBox::AcceptRole, [this] { action("Close the case")->trigger(); });
  EXPECT_TRUE(waitFor([this] { return !window().model().hasCase(); }, 240000));
  EXPECT_TRUE(find<Banner>("leaveBanner").isHidden());
  EXPECT_TRUE(library().open("ear").mr.front().registered);
}

TEST_F(RegistrationWindow, ACaseThatIsToBeClosedSaysSoAndCanBeKeptOpen)
{
  showPanel();
  auto& banner = find<Banner>("leaveBanner");
  EXPECT_FALSE(banner.isVisible());
  click("register");
  leaveBy(QMessageBox::AcceptRole, [this] { action("Close the case")->trigger(); });
  EXPECT_TRUE(banner.isVisible());
  EXPECT_TRUE(banner.text().contains("registration of the MR")) << banner.text().toStdString();
  EXPECT_TRUE(banner.text().startsWith("The case is closed as soon as"))
      << banner.text().toStdString();
  click("stayInCase");
  EXPECT_FALSE(banner.isVisible());
  EXPECT_TRUE(waitFor([this] { return mr().registered; }, 240000)) << "the run goes on";
  EXPECT_TRUE(settled());
  EXPECT_TRUE(window().model().hasCase());
}

TEST_F(RegistrationWindow, AWindowThatIsNotToBeClosedDuringARunStaysAndTheRunGoesOn)
{
  showPanel();
  click("register");
  leaveBy(QMessageBox::RejectRole, [this] { EXPECT_FALSE(window().close()); });
  EXPECT_TRUE(window().isVisible());
  EXPECT_TRUE(waitFor([this] { return mr().registered; }, 240000));
  EXPECT_TRUE(window().isVisible()) << "nobody asked for more";
}

TEST_F(RegistrationWindow, AWindowThatIsToBeClosedAfterARunClosesByItself)
{
  showPanel();
  click("register");
  leaveBy(QMessageBox::AcceptRole, [this] { window().close(); });
  const QString told = find<Banner>("leaveBanner").text();
  EXPECT_TRUE(told.startsWith("Petrous is closed as soon as")) << told.toStdString();
  EXPECT_TRUE(waitFor([this] { return !window().isVisible(); }, 240000));
  EXPECT_TRUE(library().open("ear").mr.front().registered);
}

TEST_F(RegistrationWindow, TheKeyTakesTheMrThatIsNotRegisteredUnlessThePanelShowsAnother)
{
  scene::Case value = library().open("ear");
  scene::applyRegistration(value, "T2", phantom.mrFromCt(), {});
  scene::ImagePart second = value.mr.front();
  second.name = "DWI";
  second.registered = false;
  second.registration.reset();
  second.mrFromCt = core::RigidTransform();
  value.mr.push_back(second);
  library().save(value);
  const_cast<presenters::WorkstationModel&>(window().model()).open("ear");
  auto& chosen = find<QComboBox>("registrationMr");
  ASSERT_EQ(chosen.currentText(), "T2");
  ASSERT_FALSE(window().findChild<QDockWidget*>("registrationDock")->isVisible());
  action("Register the MR")->trigger();
  EXPECT_EQ(chosen.currentText(), "DWI");
  const auto& mrs = window().model().value().mr;
  ASSERT_TRUE(waitFor([&] { return mrs.back().registered; }, 240000)) << state().toStdString();
  EXPECT_LT(error(), 1e-9) << "stays as it was";

  ASSERT_TRUE(window().findChild<QDockWidget*>("registrationDock")->isVisible());
  chosen.setCurrentText("T2");
  action("Register the MR")->trigger();
  EXPECT_EQ(chosen.currentText(), "T2") << "it is seen there";
}

TEST_F(RegistrationWindow, AnMrGoesToTheCtThroughOneThatIsThere)
{
  scene::Case value = library().open("ear");
  scene::ImagePart second = scan(Phantom::Modality::Mr, phantom.mrFromCt(), 1.4);
  second.name = "DWI";
  value.mr.push_back(second);
  for (scene::ImagePart& each : value.mr)
    each.frameOfReference = std::string(64, 'f');
  scene::applyRegistration(value, "T2", phantom.mrFromCt(), {});
  library().save(value);
  const_cast<presenters::WorkstationModel&>(window().model()).open("ear");
  showPanel();
  auto& onto = find<QComboBox>("registrationOnto");
  EXPECT_FALSE(onto.isVisible()) << "there is no MR but itself that is registered";
  find<QComboBox>("registrationMr").setCurrentText("DWI");
  ASSERT_TRUE(onto.isVisible());
  ASSERT_EQ(onto.count(), 2);
  onto.setCurrentIndex(1);
  click("register");
  const auto& dwi = window().model().value().mr.back();
  ASSERT_TRUE(waitFor([&] { return dwi.registered; }, 240000)) << state().toStdString();
  EXPECT_EQ(dwi.registration->through, "T2");
  EXPECT_LT((dwi.mrFromCt * Phantom::center() - phantom.mrFromCt() * Phantom::center()).norm(),
            0.5);
  EXPECT_TRUE(state().contains("through 'T2'")) << state().toStdString();
}

// Its result is chained through the place that the other MR had when it began.
TEST_F(RegistrationWindow, NoStepMovesAnMrWhileARegistrationIsUnderWay)
{
  scene::Case value = library().open("ear");
  scene::ImagePart second = scan(Phantom::Modality::Mr, phantom.mrFromCt(), 1.4);
  second.name = "DWI";
  value.mr.push_back(second);
  scene::applyRegistration(value, "T2", phantom.mrFromCt(), {});
  library().save(value);
  const_cast<presenters::WorkstationModel&>(window().model()).open("ear");
  showPanel();
  auto& slice = find<SliceView>("axialView");
  choose(2);
  QTest::keyClick(&slice, Qt::Key_Right, Qt::AltModifier | Qt::ShiftModifier);
  const auto place = [this] { return mr().mrFromCt.matrix(); };
  const Eigen::Matrix4d moved = place();
  ASSERT_NE(moved, phantom.mrFromCt().matrix());
  const auto step = [this](const QString& name) -> const Command
  {
    for (const Command& command : commandsOf(window(), true))
      if (command.name.startsWith(name))
        return command;
    return {};
  };
  ASSERT_TRUE(step("Undo move").isEnabled);

  find<QComboBox>("registrationMr").setCurrentText("DWI");
  find<QComboBox>("registrationOnto").setCurrentIndex(1);
  click("register");
  ASSERT_TRUE(find<QPushButton>("cancelRegistration").isEnabled());
  EXPECT_FALSE(step("Undo move").isEnabled);
  EXPECT_TRUE(step("Undo move").whyNot.contains("registration"))
      << step("Undo move").whyNot.toStdString();
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(place(), moved);
  stop([](QMessageBox& box) { clickOn(box, QMessageBox::RejectRole); });
  ASSERT_FALSE(find<QPushButton>("cancelRegistration").isEnabled());
  EXPECT_EQ(place(), moved);
  ASSERT_TRUE(step("Undo move").isEnabled);
  step("Undo move").action->trigger();
  EXPECT_LT((place() - phantom.mrFromCt().matrix()).norm(), 1e-12);

  click("register");
  ASSERT_TRUE(find<QPushButton>("cancelRegistration").isEnabled());
  EXPECT_FALSE(step("Redo move").isEnabled);
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_LT((place() - phantom.mrFromCt().matrix()).norm(), 1e-12);
  // Nor do its axes.
  auto* menu = qobject_cast<QMenu*>(action("Correct the axes…")->associatedWidgets().value(0));
  ASSERT_TRUE(menu);
  emit menu->aboutToShow();
  action("Correct the axes of the MR “T2”…")->trigger();
  EXPECT_TRUE(window().statusBar()->currentMessage().contains("registration is under way"))
      << window().statusBar()->currentMessage().toStdString();
  stop([](QMessageBox& box) { clickOn(box, QMessageBox::RejectRole); });
  EXPECT_TRUE(step("Redo move").isEnabled);
}

TEST_F(RegistrationWindow, AStructureThatIsCreatedLeavesTheViewsAsTheyAre)
{
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  showPanel();
  choose(2);
  model.setCrosshair(Phantom::center() + Vector3d(3, 2, 1));
  const Vector3d crosshair = model.crosshair();
  const auto before = find<SliceView>("axialView").slice();
  QTest::keyClick(&window(), Qt::Key_P, Qt::ShiftModifier);
  auto& slice = find<SliceView>("axialView");
  QTest::mouseClick(&slice, Qt::LeftButton, Qt::NoModifier, slice.rect().center());
  QTest::keyClicks(&find<QLineEdit>("segmentName"), "Sigmoid sinus");
  EXPECT_TRUE(action("Undo paint stroke"));
  find<QPushButton>("segmentCreate").click();
  ASSERT_TRUE(waitFor([&] { return scene::findStructure(model.value(), "Sigmoid sinus"); }));
  const double volume =
      static_cast<double>(scene::findStructure(model.value(), "Sigmoid sinus")->voxels) *
      model.value().ct.geometry.voxelVolume();
  for (const QString& said :
       {window().statusBar()->currentMessage(), find<QLabel>("segmentLine").text()})
  {
    EXPECT_TRUE(said.contains("Sigmoid sinus")) << said.toStdString();
    EXPECT_TRUE(said.contains(QString::number(volume, 'f', volume < 100.0 ? 2 : 1) +
                              QString::fromUtf8(" mm³")))
        << said.toStdString();
    EXPECT_TRUE(said.contains("Undo")) << said.toStdString();
  }
  EXPECT_TRUE(settled());
  EXPECT_EQ(find<QComboBox>("overlayMode").currentIndex(), 2);
  EXPECT_EQ(model.crosshair(), crosshair);
  EXPECT_EQ(find<SliceView>("axialView").slice().mmPerPixel(), before.mmPerPixel());
  QAction* undo = action("Undo create Sigmoid sinus");
  ASSERT_TRUE(undo);
  EXPECT_EQ(undo->shortcut(), QKeySequence(Qt::CTRL + Qt::Key_Z));
  undo->trigger();
  EXPECT_FALSE(scene::findStructure(model.value(), "Sigmoid sinus"));
  EXPECT_EQ(find<QComboBox>("overlayMode").currentIndex(), 2);
  action("Redo create Sigmoid sinus")->trigger();
  EXPECT_TRUE(scene::findStructure(model.value(), "Sigmoid sinus"));
}

TEST_F(RegistrationWindow, AnotherMrLeavesTheViewsAsTheyAre)
{
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  auto& slice = find<SliceView>("axialView");
  showPanel();
  choose(2);
  model.setCrosshair(Phantom::center() + Vector3d(3, 2, 1));
  for (int n = 0; n < 4; ++n)
    QTest::keyClick(&slice, Qt::Key_Plus);
  action("Soft tissue window")->trigger();
  view().setFocus();
  const Vector3d crosshair = model.crosshair();
  const auto before = slice.slice();
  const double across = before.mmPerPixel() * before.height(); // the view may be resized
  layOut();
  const QImage seen = axial();
  const auto isAsBefore = [&](const char* what)
  {
    layOut();
    EXPECT_EQ(find<QComboBox>("overlayMode").currentIndex(), 2) << what;
    EXPECT_EQ(find<QComboBox>("registrationMr").currentText(), "T2") << what;
    EXPECT_EQ(model.crosshair(), crosshair) << what;
    EXPECT_NEAR(slice.slice().mmPerPixel() * slice.slice().height(), across, 0.01 * across) << what;
    EXPECT_EQ(slice.slice().center(), before.center()) << what;
    if (axial().size() == seen.size())
    {
      EXPECT_LT(differing(axial(), seen), 0.02) << what;
    }
    // Qt may shift glyphs by parts of a pixel
  };
  const scene::Case caseBefore = model.value();
  scene::Case with = caseBefore;
  scene::ImagePart second = scan(Phantom::Modality::Mr, phantom.mrFromCt(), 1.4);
  second.name = "DWI";
  with.mr.push_back(second);
  model.takeParts(caseBefore, std::move(with));
  ASSERT_EQ(model.value().mr.size(), 2U);
  isAsBefore("added");
  model.removePart("DWI");
  isAsBefore("removed");
  model.restorePart();
  isAsBefore("put back");
  // The one that is shown: the CT alone is left, in the same place.
  model.removePart("T2");
  layOut();
  EXPECT_EQ(find<QComboBox>("overlayMode").currentIndex(), 0);
  EXPECT_EQ(model.crosshair(), crosshair);
  EXPECT_NEAR(slice.slice().mmPerPixel() * slice.slice().height(), across, 0.01 * across);
  EXPECT_EQ(slice.slice().center(), before.center());
  EXPECT_EQ(find<SliceColumn>("slices").shown().width, 400.0);
}

TEST_F(RegistrationWindow, ARunEndsWithTheMrOntoWhichItWasAndGoesOnOtherwise)
{
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  const scene::Case caseBefore = model.value();
  scene::Case with = caseBefore;
  scene::ImagePart second = scan(Phantom::Modality::Mr, phantom.mrFromCt(), 1.4);
  second.name = "DWI";
  with.mr.push_back(second);
  showPanel();
  click("register");
  model.takeParts(caseBefore, std::move(with));
  EXPECT_TRUE(find<QPushButton>("cancelRegistration").isEnabled()) << "it goes on";
  ASSERT_TRUE(waitFor([this] { return mr().registered; }, 240000)) << state().toStdString();
  find<QComboBox>("registrationMr").setCurrentText("DWI");
  find<QComboBox>("registrationOnto").setCurrentIndex(1);
  click("register");
  ASSERT_TRUE(find<QPushButton>("cancelRegistration").isEnabled());
  model.removePart("T2");
  EXPECT_FALSE(find<QPushButton>("cancelRegistration").isEnabled());
  EXPECT_TRUE(find<QLabel>("registrationLine").text().contains("is gone"))
      << find<QLabel>("registrationLine").text().toStdString();
  EXPECT_FALSE(model.value().mr.front().registered);
}

TEST_F(RegistrationWindow, TheReadoutIsThatOfTheImageThatIsSeen)
{
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  const auto& slices = find<SliceColumn>("slices");
  // In the middle of a voxel of the MR, which lies as its header has it.
  const auto& grid = mr().geometry;
  const Vector3d voxel = grid.voxelFromPatient(Phantom::center()).array().round();
  model.setCrosshair(grid.patientFromVoxel(voxel));
  const auto said = [&] { return slices.valuesAt(model.crosshair()); };
  const QString ct = said();
  EXPECT_TRUE(QRegularExpression("^-?\\d+ HU$").match(ct).hasMatch()) << ct.toStdString();
  flick(view());
  phantom::ScanSettings settings;
  settings.modality = Phantom::Modality::Mr;
  settings.patientFromScan = phantom.mrFromCt().inverse();
  const auto truth = phantom::samplePhantom(phantom, grid, settings);
  const QString value = QString::number(
      truth.at(static_cast<int>(voxel[0]), static_cast<int>(voxel[1]), static_cast<int>(voxel[2])));
  EXPECT_EQ(said().split('.').front(), "T2 " + value);
  EXPECT_FALSE(said().contains("HU"));
  // The status bar says so of the point under the pointer, and of a point of the 3D view the CT's.
  auto& slice = find<SliceView>("axialView");
  emit slice.pointed(model.crosshair());
  EXPECT_TRUE(find<QLabel>("place").text().contains("T2 " + value))
      << find<QLabel>("place").text().toStdString();
  flick(view());
  EXPECT_EQ(said(), ct);
  choose(1); // blend
  EXPECT_TRUE(said().startsWith("CT " + ct + "  T2 " + value)) << said().toStdString();
}

TEST_F(RegistrationWindow, ARightDragChangesTheGreyWindowOfTheImageThatIsSeen)
{
  auto& slice = find<SliceView>("axialView");
  const auto drag = [&]
  {
    QTest::mousePress(&slice, Qt::RightButton, Qt::NoModifier, slice.rect().center());
    const QImage before = axial();
    QMouseEvent move(QEvent::MouseMove, slice.rect().center() + QPoint(60, 0), Qt::NoButton,
                     Qt::RightButton, Qt::NoModifier);
    QApplication::sendEvent(&slice, &move);
    EXPECT_NE(axial(), before);
    QTest::mouseRelease(&slice, Qt::RightButton, Qt::NoModifier,
                        slice.rect().center() + QPoint(60, 0));
  };
  const double width = find<SliceColumn>("slices").shown().width;
  flick(view()); // the MR alone
  drag();
  EXPECT_EQ(find<SliceColumn>("slices").shown().width, width);
  flick(slice); // the CT alone
  drag();
  EXPECT_GT(find<SliceColumn>("slices").shown().width, width);
}

TEST_F(RegistrationWindow, ItsMenuNeedsAnMr)
{
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  const auto isOffered = [this]
  {
    const bool isOne = action("Register the MR")->isEnabled();
    for (const char* name : {"Refine", "Next way to show the MR", "Point here"})
      for (QAction* candidate : window().findChildren<QAction*>())
        if (candidate->text().remove('&') == name)
        {
          EXPECT_EQ(candidate->isEnabled(), isOne) << name;
        }
    return isOne;
  };
  EXPECT_TRUE(isOffered());
  model.removePart("T2");
  EXPECT_FALSE(isOffered());
  model.restorePart();
  EXPECT_TRUE(isOffered());
  model.close();
  EXPECT_FALSE(isOffered());
}
