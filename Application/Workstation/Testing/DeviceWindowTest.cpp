#include "DeviceTest.h"
#include "DeviceTestDialog.h"
#include "DeviceToolBar.h"

#include <csignal>
#include <iterator>
#include <optional>

#include <dlfcn.h>

#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>

#include "petrous/Devices/DeviceCatalogue.h"
#include "petrous/Presenters/DeviceLimits.h"

using namespace petrous;
using namespace petrous::workstation;
using devices::testing::FakeServer;
using Eigen::Vector3d;

namespace
{

// A device of 3 N that senses its orientation and renders 0.5 N/mm.
void describe(petrous_device_block& block)
{
  block.flags = PETROUS_SENSES_ROTATION | PETROUS_GIVES_FORCE;
  block.max_force = 3.0;
  block.max_stiffness = 0.5;
}

Vector3d forceOf(const petrous_device_wrench& wrench)
{
  return {wrench.force[0], wrench.force[1], wrench.force[2]};
}

bool hasDeviceThread()
{
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task"))
  {
    std::ifstream file(task.path() / "comm"); // one that has just ended has none
    std::string name;
    if (std::getline(file, name) && name == "petrous-devices")
      return true;
  }
  return false;
}

bool isHidapiLoaded()
{
  void* handle = ::dlopen("libhidapi-hidraw.so.0", RTLD_LAZY | RTLD_NOLOAD);
  if (handle)
    ::dlclose(handle);
  return handle != nullptr;
}

// Process id of the server of that name; 0 if there is none.
int processOf(const std::string& name)
{
  for (const auto& entry : std::filesystem::directory_iterator("/proc"))
  {
    std::ifstream file(entry.path() / "cmdline");
    const std::string line{std::istreambuf_iterator<char>(file), {}};
    if (line.find("/petrous-device-" + name) != std::string::npos)
      return std::stoi(entry.path().filename().string());
  }
  return 0;
}

class InputDevices : public DeviceTest
{
protected:
  void TearDown() override
  {
    served.reset();
    DeviceTest::TearDown();
  }

  /// Opens the ball with the burr on a server device, which is the test itself.
  void drillByServer()
  {
    saveBall("ball");
    installServer(serverName());
    openWindow();
    choose(QString::fromStdString(serverName()));
    ASSERT_TRUE(waitFor([this] { return started(serverName()); }));
    served.emplace(serverName(), describe);
    QTest::keyClick(&view(), Qt::Key_D);
    ASSERT_TRUE(hasTool());
  }

  /// Installs the example server with these options.
  void installExample(const std::string& options)
  {
    const auto program = servers() / serverName();
    std::ofstream(program) << "#!/bin/sh\nexec '" << PETROUS_EXAMPLE_SERVER << "' " << options
                           << " \"$@\"\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  }

  /// Drills by the cap until bone is gone, with Space still held when it is unplugged.
  void unplugWhileDrilling()
  {
    QTest::keyPress(&view(), Qt::Key_Space);
    ASSERT_TRUE(holdCapUntil(capHeld(0, -350, 0), [this]
                             { return !window().model().value().dissection.mask().untouched(); }));
    bench.play("unplug cap\n");
    ASSERT_TRUE(waitFor([this] { return choice().currentText() == "Mouse"; }));
  }

  std::optional<FakeServer> served;
};

} // namespace

TEST_F(InputDevices, WhatIsPluggedInComesUpInTheListAndGoes)
{
  saveBall("ball");
  openWindow();
  EXPECT_EQ(choice().count(), 1);
  EXPECT_EQ(choice().currentText(), "Mouse");
  bench.play(kPlugCap);
  EXPECT_TRUE(offers("SpaceMouse Compact"));
  EXPECT_EQ(choice().currentText(), "Mouse") << "nothing is taken unasked";
  bench.play("unplug cap\n");
  EXPECT_TRUE(waitFor([this] { return choice().count() == 1; }));
  installServer("omega.7");
  EXPECT_TRUE(offers("omega.7"));
  EXPECT_FALSE(started("omega.7"));
}

TEST_F(InputDevices, AnIdleWindowHasNoDeviceThreadAndLoadsNothingUntilTheListIsOpened)
{
  if (devices::isKnownPluggedIn())
    GTEST_SKIP() << "a SpaceMouse or a pedal is plugged into this computer";
  saveBall("ball");
  devices.hid = std::make_shared<const devices::HidLibrary>();
  lookForDevicesEvery = 0;
  openWindow("ball");
  EXPECT_TRUE(waitFor([] { return !hasDeviceThread(); })) << "the first look at the servers ends";
  EXPECT_FALSE(isHidapiLoaded());

  // What is installed comes up by itself, and the thread goes again.
  installServer("omega.7");
  EXPECT_TRUE(offers("omega.7"));
  EXPECT_TRUE(waitFor([] { return !hasDeviceThread(); }));
  EXPECT_FALSE(isHidapiLoaded());

  choice().showPopup();
  EXPECT_TRUE(waitFor([] { return isHidapiLoaded(); }));
  EXPECT_TRUE(waitFor([] { return !hasDeviceThread(); }));
  choice().hidePopup();
}

TEST_F(InputDevices, OpeningTheListFindsWhatIsPluggedIn)
{
  saveBall("ball");
  lookForDevicesEvery = 0;
  openWindow();
  bench.playAll(kPlugCap);
  choice().showPopup();
  EXPECT_TRUE(offers("SpaceMouse Compact"));
  choice().hidePopup();
}

TEST_F(InputDevices, WhatMayNotBeOpenedSaysWhyAndCannotBeChosen)
{
  saveBall("ball");
  openWindow();
  bench.play("plug /nowhere/hidraw9 256f c635 1 8 SpaceMouse Compact\n");
  ASSERT_TRUE(offers("SpaceMouse Compact"));
  EXPECT_TRUE(message().contains("/nowhere/hidraw9")) << message().toStdString();
  const auto* items = qobject_cast<QStandardItemModel*>(choice().model());
  EXPECT_FALSE(items->item(choice().findText("SpaceMouse Compact"))->isEnabled());
}

TEST_F(InputDevices, ASpaceMouseLeadsTheToolAlongTheViewAndDrillsWithItsButton)
{
  saveBall("ball");
  bench.play(kPlugCap);
  openWindow();
  choose("SpaceMouse Compact");
  QTest::keyClick(&view(), Qt::Key_D);
  ASSERT_TRUE(hasTool());
  const Vector3d begin = tool();
  // It starts on the ray through the view's centre, a millimetre in front of the ball.
  const auto line = view().sightLine(std::nullopt);
  EXPECT_LT((begin - line.origin).cross(line.direction).norm(), 0.01);
  EXPECT_NEAR((begin - kBallCenter).norm(), kBallRadius + 2.0 + 1.0, 0.2);

  ASSERT_TRUE(holdCapUntil(capHeld(350, 0, 0),
                           [&] { return (axes().transpose() * (tool() - begin)).x() > 1.0; }));
  const Vector3d way = axes().transpose() * (tool() - begin);
  EXPECT_LT(std::hypot(way.y(), way.z()), 0.05) << way.transpose();

  // Into the bone, with its first button: 1 N presses, whatever the deflection.
  ASSERT_TRUE(holdCapUntil(capHeld(0, -350, 0, 1),
                           [this]
                           {
                             return window().model().value().applied() > 0 ||
                                    !window().model().value().dissection.mask().untouched();
                           }));
  bench.play(capHeld(0, 350, 0, 0));
  ASSERT_TRUE(waitFor([this] { return !window().model().value().dissection.strokes().empty(); }));
  ASSERT_TRUE(settled()); // it is saved by another thread
  EXPECT_GT(library().open("ball").dissection.strokes().front()->info.removed, 0.0);
}

TEST_F(InputDevices, ADeviceThatIsUnpluggedLeavesTheStrokeSavedAndTheMouseInCharge)
{
  saveBall("ball");
  bench.play(kPlugCap);
  openWindow();
  choose("SpaceMouse Compact");
  QTest::keyClick(&view(), Qt::Key_D);
  ASSERT_TRUE(hasTool());
  ASSERT_NO_FATAL_FAILURE(unplugWhileDrilling());
  EXPECT_TRUE(message().contains("unplugged")) << message().toStdString();
  EXPECT_TRUE(message().contains("The mouse leads the tool")) << message().toStdString();
  ASSERT_TRUE(settled());
  // One, or more if the cap's reports were late on a busy machine: a silent device ends a stroke.
  const auto strokes = library().open("ball").dissection.strokes();
  ASSERT_FALSE(strokes.empty());
  EXPECT_GT(strokes.front()->info.removed, 0.0);
  QTest::keyRelease(&view(), Qt::Key_Space);

  EXPECT_TRUE(action("Drill")->isChecked());
  drill(600, 20);
  EXPECT_EQ(library().open("ball").dissection.strokes().size(), strokes.size() + 1);
}

TEST_F(InputDevices, ARecordingEndsWithItsDeviceAndTheCommandRepeatsItToTheBit)
{
  saveBall("copy");
  saveBall("ball");
  bench.play(kPlugCap);
  openWindow("ball");
  choose("SpaceMouse Compact");
  QTest::keyClick(&view(), Qt::Key_D);
  ASSERT_TRUE(hasTool());
  const auto file = record();
  ASSERT_TRUE(waitFor([&] { return std::filesystem::exists(file); }));
  ASSERT_TRUE(hasTool());
  ASSERT_NO_FATAL_FAILURE(unplugWhileDrilling());
  QTest::keyRelease(&view(), Qt::Key_Space);
  EXPECT_TRUE(window().model().recording().empty());
  EXPECT_FALSE(action(QString::fromUtf8("Record session…"))->isChecked());
  EXPECT_FALSE(window().findChild<QLabel*>("recording")->isVisible());
  EXPECT_TRUE(settled());

  const QJsonObject replay = replayed(file, "copy");
  EXPECT_TRUE(replay["equal"].toBool());
  EXPECT_TRUE(replay["complete"].toBool());
  const auto ball = library().open("ball");
  const auto copy = library().open("copy");
  // One, or more if the cap's reports were late on a busy machine: a silent device ends a stroke.
  const auto& drilled = ball.dissection.strokes();
  const auto& repeated = copy.dissection.strokes();
  ASSERT_FALSE(drilled.empty());
  ASSERT_EQ(repeated.size(), drilled.size());
  EXPECT_GT(ball.removedVolume(), 0.0);
  for (std::size_t n = 0; n < drilled.size(); ++n)
    EXPECT_EQ(repeated[n]->info.removed, drilled[n]->info.removed) << n;
}

TEST_F(InputDevices, ADevicesOriginIsThePlaceLookedAtAndItsWayIsScaled)
{
  ASSERT_NO_FATAL_FAILURE(drillByServer());
  FakeServer& server = *served;
  const Vector3d begin = tool();
  EXPECT_NEAR((begin - kBallCenter).norm(), kBallRadius + 2.0 + 1.0, 0.2);

  auto* scale = window().findChild<QDoubleSpinBox*>("deviceScale");
  EXPECT_TRUE(scale->isVisible());
  EXPECT_EQ(scale->value(), 0.5);
  const Vector3d hand(6.0, 4.0, 8.0);
  glide(server, Vector3d::Zero(), hand);
  const auto at = [&](const Vector3d& wanted)
  {
    return waitFor([&] { return (axes().transpose() * (tool() - begin) - wanted).norm() < 0.05; },
                   10000);
  };
  EXPECT_TRUE(at(0.5 * hand)) << (axes().transpose() * (tool() - begin)).transpose();

  // Changing the scale does not move the tool; it applies from there on.
  scale->setValue(1.0);
  ASSERT_TRUE(hasTool());
  EXPECT_TRUE(at(0.5 * hand));
  const Vector3d back(0.0, 0.0, 8.0);
  const Vector3d there = 0.5 * hand + back - hand;
  glide(server, hand, back);
  EXPECT_TRUE(at(there)) << (axes().transpose() * (tool() - begin)).transpose();

  // While X is held the device moves without the tool.
  QTest::keyPress(&view(), Qt::Key_X);
  QTest::qWait(100);
  const Vector3d aside = back + Vector3d(10.0, 0.0, 0.0);
  glide(server, back, aside);
  QTest::qWait(200);
  EXPECT_TRUE(at(there));
  QTest::keyRelease(&view(), Qt::Key_X);
  QTest::qWait(100);
  const Vector3d on(2.0, 0.0, 0.0);
  glide(server, aside, aside + on);
  EXPECT_TRUE(at(there + on));

  // In front of the view's centre, wherever the device is.
  QTest::keyClick(&view(), Qt::Key_H);
  ASSERT_TRUE(hasTool());
  EXPECT_TRUE(at(Vector3d::Zero()));
}

TEST_F(InputDevices, TheForceStaysWithinTheUsersLimit)
{
  ASSERT_NO_FATAL_FAILURE(drillByServer());
  FakeServer& server = *served;
  auto* limit = window().findChild<QDoubleSpinBox*>("forceLimit");
  ASSERT_TRUE(limit->isVisible());
  EXPECT_EQ(limit->value(), 3.0) << "what the device can";
  EXPECT_EQ(limit->maximum(), 3.0);
  EXPECT_FALSE(window().findChild<QDoubleSpinBox*>("thrust")->isEnabled());

  // 1 mm in front of the bone, then 2 mm of the tool into it: 0.4 N/mm there, 0.2 N/mm at the
  // device, which nobody has tested.
  const auto feels = [&](double newtons)
  {
    return waitFor(
        [&] { return (forceOf(server.wrench()) - Vector3d(0.0, 0.0, newtons)).norm() < 0.15; });
  };
  glide(server, Vector3d::Zero(), {0.0, 0.0, -6.0});
  picture();
  EXPECT_TRUE(feels(0.8)) << forceOf(server.wrench()).transpose();
  // Another limit takes the tool up in place, without force until the device presses on.
  limit->setValue(0.7);
  EXPECT_TRUE(feels(0.0));
  ASSERT_TRUE(waitFor([this] { return window().model().touching(); }));
  ASSERT_TRUE(hasTool());
  glide(server, {0.0, 0.0, -6.0}, {0.0, 0.0, -10.0});
  EXPECT_TRUE(feels(0.7)) << forceOf(server.wrench()).transpose();

  QTest::keyClick(&view(), Qt::Key_D);
  EXPECT_TRUE(feels(0.0));
}

TEST_F(InputDevices, AServerWithoutItsDeviceGivesTheToolBackToTheMouse)
{
  ASSERT_NO_FATAL_FAILURE(drillByServer());
  FakeServer& server = *served;
  glide(server, Vector3d::Zero(), {0.0, 0.0, -6.0});
  ASSERT_TRUE(waitFor([&] { return forceOf(server.wrench()).z() > 0.5; }));
  server.say(PETROUS_SERVER_NO_DEVICE, "its plug was pulled");
  EXPECT_TRUE(waitFor([&] { return forceOf(server.wrench()).norm() == 0.0; }));
  EXPECT_TRUE(waitFor([this] { return choice().currentText() == "Mouse"; }));
  EXPECT_TRUE(message().contains("its plug was pulled")) << message().toStdString();
}

TEST_F(InputDevices, AServerThatCannotBeUsedIsNamedAndTheWindowGoesOnMeanwhile)
{
  saveBall("ball");
  const auto broken = servers() / serverName();
  std::ofstream(broken) << "#!/bin/sh\nexit 3\n";
  std::filesystem::permissions(broken, std::filesystem::perms::owner_all);
  installServer("silent-" + serverName());
  openWindow();
  choose(QString::fromStdString(serverName()));
  EXPECT_TRUE(waitFor([this] { return choice().currentText() == "Mouse"; }));
  EXPECT_TRUE(message().contains("ended by itself with status 3")) << message().toStdString();

  // This server never answers. The mouse drills as soon as it is chosen again.
  choose(QString::fromStdString("silent-" + serverName()));
  ASSERT_TRUE(waitFor([this] { return started("silent-" + serverName()); }));
  choose("Mouse");
  drill(500, 10);
  EXPECT_EQ(window().model().value().dissection.strokes().size(), 1u);
}

TEST_F(InputDevices, APedalDrillsWithTheMouse)
{
  saveBall("ball");
  bench.play(kPlugFoot);
  openWindow();
  QTest::keyClick(&view(), Qt::Key_D);
  QTest::mouseMove(&view(), view().rect().center());
  QTest::mouseMove(&view(), view().rect().center() + QPoint(2, 0));
  ASSERT_TRUE(hasTool());
  bench.play("await foot\nreport foot 02 00\n");
  EXPECT_TRUE(waitFor([this] { return !window().model().value().dissection.mask().untouched(); }));
  EXPECT_TRUE(window().model().value().dissection.strokes().empty());
  bench.play("report foot 00 00\n");
  ASSERT_TRUE(
      waitFor([this] { return window().model().value().dissection.strokes().size() == 1; }));
  ASSERT_TRUE(settled());
  EXPECT_GT(library().open("ball").dissection.strokes().front()->info.removed, 0.0);
  EXPECT_TRUE(library().open("ball").dissection.strokes().front()->info.camera.has_value());
}

// It is detected shortly after being plugged in; the mouse need not move for that.
TEST_F(InputDevices, APedalThatComesWhileTheBurrIsUpDrills)
{
  saveBall("ball");
  openWindow();
  QTest::keyClick(&view(), Qt::Key_D);
  QTest::mouseMove(&view(), view().rect().center());
  QTest::mouseMove(&view(), view().rect().center() + QPoint(2, 0));
  ASSERT_TRUE(hasTool());
  bench.play(kPlugFoot);
  ASSERT_TRUE(waitFor([this] { return message().contains("The pedal drills"); }));
  bench.play("await foot\nreport foot 02 00\n");
  EXPECT_TRUE(waitFor([this] { return !window().model().value().dissection.mask().untouched(); }));
  bench.play("report foot 00 00\n");
  EXPECT_TRUE(
      waitFor([this] { return window().model().value().dissection.strokes().size() == 1; }));
}

TEST_F(InputDevices, TheClutchHoldsTheMousesToolWhileThePointerGoes)
{
  saveBall("ball");
  openWindow();
  QTest::keyClick(&view(), Qt::Key_D);
  const QPoint middle = view().rect().center();
  const auto pointAt = [this](const QPoint& pixel)
  {
    QTest::mouseMove(&view(), pixel + QPoint(1, 0));
    QTest::mouseMove(&view(), pixel);
  };
  const auto across = [this] { return (axes().transpose() * (tool() - kBallCenter)).x(); };
  pointAt(middle);
  ASSERT_TRUE(hasTool());
  ASSERT_TRUE(waitFor([&] { return std::abs(across()) < 0.5; })) << across();
  QTest::keyPress(&view(), Qt::Key_X);
  QTest::qWait(200);
  pointAt(middle + QPoint(90, 0));
  QTest::qWait(500);
  EXPECT_LT(std::abs(across()), 0.5);
  QTest::keyRelease(&view(), Qt::Key_X);
  EXPECT_TRUE(waitFor([&] { return across() > 3.0; })) << "it comes under the pointer";
}

TEST_F(InputDevices, AnotherBurrGoesOnFromWhereADevicesToolWas)
{
  ASSERT_NO_FATAL_FAILURE(drillByServer());
  FakeServer& server = *served;
  const Vector3d begin = tool();
  const Vector3d hand(8.0, 6.0, 4.0);
  glide(server, Vector3d::Zero(), hand);
  const auto at = [&]
  { return (axes().transpose() * (tool() - begin) - 0.5 * hand).norm() < 0.05; };
  ASSERT_TRUE(waitFor(at));
  window().findChild<QDoubleSpinBox*>("burrDiameter")->setValue(3.0);
  ASSERT_TRUE(waitFor([this] { return window().model().touching(); }));
  ASSERT_TRUE(hasTool());
  EXPECT_EQ(view().display().tool()->radius, 1.5);
  EXPECT_TRUE(waitFor(at)) << (axes().transpose() * (tool() - begin)).transpose();
}

TEST_F(InputDevices, AServerThatIsKilledComesBackAndEndsWithTheWindow)
{
  saveBall("ball");
  std::filesystem::create_symlink(PETROUS_EXAMPLE_SERVER, servers() / serverName());
  openWindow();
  choose(QString::fromStdString(serverName()));
  QTest::keyClick(&view(), Qt::Key_D);
  ASSERT_TRUE(hasTool());
  const int first = processOf(serverName());
  ASSERT_GT(first, 0);
  QTest::qWait(700); // longer than the startup time, in which there is no fault
  ASSERT_EQ(::kill(first, SIGKILL), 0);
  auto& fault = *window().findChild<QLabel*>("touchFault");
  EXPECT_TRUE(waitFor([&] { return !fault.text().isEmpty(); }));
  EXPECT_TRUE(waitFor([&] { return fault.text().isEmpty(); }));
  const int second = processOf(serverName());
  EXPECT_GT(second, 0);
  EXPECT_NE(second, first);
  EXPECT_EQ(choice().currentText(), QString::fromStdString(serverName()));
  const Vector3d before = tool();
  EXPECT_TRUE(waitFor([&] { return (tool() - before).norm() > 1.0; })) << "it goes on";
  closeWindow();
  EXPECT_EQ(processOf(serverName()), 0);
  openWindow();
}

TEST_F(InputDevices, AServerThatIsKilledInContactLeavesTheStrokeSavedAndTheMouseInCharge)
{
  ASSERT_NO_FATAL_FAILURE(drillByServer());
  FakeServer& server = *served;
  QTest::keyPress(&view(), Qt::Key_Space);
  glide(server, Vector3d::Zero(), {0.0, 0.0, -6.0}); // 2 mm of the tool into the bone
  ASSERT_TRUE(waitFor([this] { return !window().model().value().dissection.mask().untouched(); }));
  ASSERT_TRUE(window().model().drilling());
  std::ifstream file(folder() / (serverName() + ".pid"));
  int pid = 0;
  ASSERT_TRUE(file >> pid);
  ASSERT_EQ(::kill(pid, SIGKILL), 0);
  served.reset(); // its block speaks no more
  EXPECT_TRUE(waitFor([this] { return choice().currentText() == "Mouse"; }));
  QTest::keyRelease(&view(), Qt::Key_Space);
  EXPECT_FALSE(window().model().drilling());
  ASSERT_TRUE(settled());
  const auto ball = library().open("ball");
  ASSERT_FALSE(ball.dissection.strokes().empty());
  EXPECT_GT(ball.dissection.strokes().front()->info.removed, 0.0);
}

// The example's handle goes by 7.1 mm for each newton, at once: it oscillates beyond 0.141 N/mm.
TEST_F(InputDevices, TheTestOfADeviceShowsWhatItBearsAndKeepsIt)
{
  installExample("--radius 0 --compliance 7.1");
  presenters::DeviceSources sources;
  sources.limits = folder() / "device-limits.json";
  presenters::InputDevice input;
  input.kind = presenters::InputDevice::Kind::Server;
  input.name = serverName();
  input.program = servers() / serverName();
  devices::DeviceCheck::Options options;
  options.workspaceTime = 0.5;
  DeviceTestDialog dialog(sources, input, nullptr, options);
  dialog.show();
  auto& start = *dialog.findChild<QPushButton*>("deviceTestStart");
  auto& keep = *dialog.findChild<QPushButton*>("deviceTestKeep");
  const auto result = [&] { return dialog.findChild<QLabel*>("deviceTestResult")->text(); };
  EXPECT_FALSE(keep.isEnabled());
  start.click();
  EXPECT_EQ(start.text(), "&Stop");
  const auto& advice = *dialog.findChild<QLabel*>("deviceTestAdvice");
  EXPECT_TRUE(waitFor([&] { return advice.text().contains("keep it still"); }));
  ASSERT_TRUE(waitFor([&] { return keep.isEnabled(); })) << result().toStdString();
  EXPECT_EQ(start.text(), "S&tart");
  EXPECT_TRUE(result().contains("Up: stable up to 0.13 N/mm, oscillates at 0.15"))
      << result().toStdString();
  EXPECT_TRUE(result().contains("Proposed: 0.07 N/mm")) << result().toStdString();
  keep.click();
  EXPECT_NEAR(presenters::keptStiffness(sources.limits, input.name, "Petrous example device", 0.4)
                  .value_or(0.0),
              0.066125, 1e-9);
}

TEST_F(InputDevices, ADeviceIsLentToItsTestAndComesBack)
{
  saveBall("ball");
  installExample("--radius 0");
  openWindow();
  auto& bar = *window().findChild<DeviceToolBar*>("deviceBar");
  EXPECT_FALSE(bar.testAction()->isEnabled()) << "the mouse has no forces";
  choose(QString::fromStdString(serverName()));
  ASSERT_TRUE(waitFor([this] { return message().contains("is there"); }));
  ASSERT_TRUE(bar.testAction()->isEnabled());
  bar.testAction()->trigger();
  auto* dialog = window().findChild<QDialog*>("deviceTest");
  ASSERT_TRUE(dialog);
  EXPECT_EQ(choice().currentText(), "Mouse");
  dialog->findChild<QPushButton*>("deviceTestStart")->click();
  const auto& advice = *dialog->findChild<QLabel*>("deviceTestAdvice");
  ASSERT_TRUE(waitFor([&] { return advice.text().contains("move the handle"); }))
      << dialog->findChild<QLabel*>("deviceTestResult")->text().toStdString();
  dialog->reject();
  EXPECT_TRUE(
      waitFor([this] { return choice().currentText() == QString::fromStdString(serverName()); }));
  EXPECT_TRUE(waitFor([this] { return message().contains("is there"); }));
}

TEST_F(InputDevices, WhatADeviceWaitsForIsSaidWithTheWindowsWords)
{
  saveBall("ball");
  installServer(serverName());
  openWindow();
  choose(QString::fromStdString(serverName()));
  ASSERT_TRUE(waitFor([this] { return started(serverName()); }));
  std::atomic<bool> done{false};
  served.emplace(serverName(),
                 [&](petrous_device_block& block)
                 {
                   describe(block);
                   petrous_device_text(block.error, sizeof block.error, "it needs 1 mm3 of room");
                   __atomic_store_n(&block.server_state, std::uint32_t{PETROUS_SERVER_STARTING},
                                    __ATOMIC_RELEASE);
                   devices::testing::eventually([&] { return done.load(); });
                 });
  EXPECT_TRUE(waitFor([this] { return message().contains("needs 1 mm³ of room"); }))
      << message().toStdString();
  done = true;
  EXPECT_TRUE(waitFor([this] { return message().contains("is there"); }));
}
