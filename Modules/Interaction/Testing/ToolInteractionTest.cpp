#include "petrous/Interaction/ToolInteraction.h"

#include <string>

#include <gtest/gtest.h>

#include <vtkCallbackCommand.h>
#include <vtkGenericRenderWindowInteractor.h>
#include <vtkInteractorStyleTrackballCamera.h>

#include "Tissue.h"
#include "Window.h"
#include "petrous/Core/Error.h"
#include "petrous/Interaction/PointerDevice.h"
#include "petrous/Interaction/PointerToolController.h"

using namespace petrous;
using namespace petrous::interaction;
using namespace petrous::interaction::testing;
using Eigen::Vector3d;
using Mode = AimSettings::Mode;

namespace
{

constexpr int kHovers = session::ServoParameters::kPointer;
constexpr int kPresses = kHovers | session::ServoParameters::kPressed;

/// A window with a trackball style, whose pointer controls the tool over a plane at z = 0.
struct Program
{
  Window window;
  vtkNew<vtkGenericRenderWindowInteractor> interactor;
  PointerToolController aim{plane(0.0)};
  PointerDevice device;
  vtkNew<vtkPetrousToolInteraction> tool;
  int changes = 0;
  double now = 1.0;

  Program()
  {
    interactor->SetRenderWindow(window.window);
    vtkNew<vtkInteractorStyleTrackballCamera> style;
    interactor->SetInteractorStyle(style);
    interactor->Enable();
    tool->SetInteractor(interactor);
    tool->SetDefaultRenderer(window.renderer);
    tool->SetPointer(&aim, &device);
    tool->EnabledOn();
    tool->DrillModeOn();
    vtkNew<vtkCallbackCommand> count;
    count->SetClientData(&changes);
    count->SetCallback([](vtkObject*, unsigned long, void* counter, void*)
                       { ++*static_cast<int*>(counter); });
    tool->AddObserver(vtkCommand::InteractionEvent, count);
  }
  ~Program() { tool->SetInteractor(nullptr); }

  // x and y in pixels from the window's centre.
  void mouse(unsigned long event, int x, int y, int control = 0, int shift = 0)
  {
    interactor->SetEventInformation(Window::kWidth / 2 + x, Window::kHeight / 2 + y, control,
                                    shift);
    interactor->InvokeEvent(event);
  }
  void key(unsigned long event, const std::string& sym, int shift = 0, int control = 0)
  {
    interactor->SetKeyEventInformation(control, shift, sym.size() == 1 ? sym[0] : '\0', 0,
                                       sym.c_str());
    interactor->InvokeEvent(event);
  }
  void type(const std::string& sym, int shift = 0)
  {
    key(vtkCommand::KeyPressEvent, sym, shift);
    key(vtkCommand::CharEvent, sym, shift);
    key(vtkCommand::KeyReleaseEvent, sym, shift);
  }
  void setMode(Mode mode)
  {
    AimSettings settings = aim.settings();
    settings.mode = mode;
    aim.setSettings(settings);
  }
  Vector3d eye() const { return Vector3d(window.renderer->GetActiveCamera()->GetPosition()); }
  haptics::DeviceReading hand()
  {
    haptics::DeviceReading reading;
    for (int n = 0; n < 1000; ++n)
      reading = device.read(now += 0.001);
    device.see({});
    return device.read(now);
  }
  // Hover position of the centre of a 2 mm burr at a pixel: 3 mm in front of the plane.
  Vector3d hoverOver(int x, int y, double before = 3.0) const
  {
    const Vector3d target((x + 0.5) * Window::pixel(), (y + 0.5) * Window::pixel(), 0.0);
    return target + before * (Vector3d(0.0, 0.0, 200.0) - target).normalized();
  }
};

void expectNear(const Vector3d& one, const Vector3d& other, double tolerance = 1e-5)
{
  EXPECT_LT((one - other).norm(), tolerance) << one.transpose() << " / " << other.transpose();
}

} // namespace

TEST(ToolInteraction, LeadsTheToolWithThePointer)
{
  Program program;
  program.mouse(vtkCommand::MouseMoveEvent, 40, -25);
  EXPECT_EQ(program.changes, 1);
  const haptics::DeviceReading hand = program.hand();
  EXPECT_EQ(hand.health, haptics::DeviceHealth::Good);
  expectNear(hand.pose.position, program.hoverOver(40, -25));
  EXPECT_EQ(hand.buttons, 0U);
  EXPECT_EQ(program.tool->GetParameters().constantThrust, kHovers);
}

TEST(ToolInteraction, DrillsWhileTheLeftButtonIsDown)
{
  Program program;
  const Vector3d eye = program.eye();
  program.mouse(vtkCommand::LeftButtonPressEvent, 10, 5);
  EXPECT_TRUE(program.tool->GetDrilling());
  EXPECT_EQ(program.hand().buttons, program.tool->GetParameters().drillButtons);
  EXPECT_EQ(program.tool->GetParameters().constantThrust, kPresses);
  program.mouse(vtkCommand::MouseMoveEvent, 50, 30);
  expectNear(program.hand().pose.position, program.hoverOver(50, 30, 2.0));
  program.mouse(vtkCommand::LeftButtonReleaseEvent, 50, 30);
  EXPECT_FALSE(program.tool->GetDrilling());
  EXPECT_EQ(program.hand().buttons, 0U);
  EXPECT_EQ(program.tool->GetParameters().constantThrust, kHovers);
  EXPECT_EQ(program.eye(), eye); // no event reached the trackball
}

TEST(ToolInteraction, PressesWithoutTheDrillWithCtrl)
{
  Program program;
  program.mouse(vtkCommand::LeftButtonPressEvent, 0, 0, 1);
  EXPECT_FALSE(program.tool->GetDrilling());
  EXPECT_EQ(program.hand().buttons, 0U);
  EXPECT_EQ(program.tool->GetParameters().constantThrust, kPresses);
}

TEST(ToolInteraction, LeavesTheMouseToTheStyleOutOfDrillMode)
{
  Program program;
  program.tool->DrillModeOff();
  const Vector3d eye = program.eye();
  program.mouse(vtkCommand::LeftButtonPressEvent, 0, 0);
  program.mouse(vtkCommand::MouseMoveEvent, 30, 10);
  program.mouse(vtkCommand::LeftButtonReleaseEvent, 30, 10);
  EXPECT_GT((program.eye() - eye).norm(), 1.0);
  EXPECT_FALSE(program.aim.wanted());
  EXPECT_FALSE(program.tool->GetDrilling());
}

TEST(ToolInteraction, KeepsTheToolWhileAnotherButtonTurnsTheCamera)
{
  Program program;
  program.mouse(vtkCommand::MouseMoveEvent, 20, 0);
  const Vector3d place = program.aim.wanted()->position;
  const Vector3d eye = program.eye();
  program.mouse(vtkCommand::MiddleButtonPressEvent, 20, 0);
  program.mouse(vtkCommand::MouseMoveEvent, 60, 30);
  EXPECT_GT((program.eye() - eye).norm(), 1.0);
  EXPECT_EQ(program.aim.wanted()->position, place);
  program.mouse(vtkCommand::MiddleButtonReleaseEvent, 60, 30);
  program.mouse(vtkCommand::MouseMoveEvent, 60, 30);
  EXPECT_NE(program.aim.wanted()->position, place);
}

TEST(ToolInteraction, StopsTheDrillAlsoWhileTheStyleTurnsTheCamera)
{
  Program program;
  program.mouse(vtkCommand::MouseMoveEvent, 0, 0);
  program.key(vtkCommand::KeyPressEvent, "space");
  program.mouse(vtkCommand::LeftButtonPressEvent, 0, 0);
  program.mouse(vtkCommand::MiddleButtonPressEvent, 0, 0); // grabs all events from now on
  EXPECT_EQ(program.hand().buttons, PointerDevice::kDrill);
  program.key(vtkCommand::KeyReleaseEvent, "space");
  EXPECT_EQ(program.hand().buttons, PointerDevice::kDrill);
  program.mouse(vtkCommand::LeftButtonReleaseEvent, 5, 0);
  EXPECT_EQ(program.hand().buttons, 0U);
  EXPECT_FALSE(program.tool->GetDrilling());
}

TEST(ToolInteraction, TurnsTheWheelIntoDepthInThatMode)
{
  Program program;
  program.setMode(Mode::Depth);
  program.mouse(vtkCommand::MouseMoveEvent, 0, 0);
  const Vector3d before = program.aim.wanted()->position;
  const Vector3d away = (before - program.eye()).normalized();
  program.mouse(vtkCommand::MouseWheelForwardEvent, 0, 0);
  expectNear(program.aim.wanted()->position, before + 0.25 * away, 1e-9);
  program.mouse(vtkCommand::MouseWheelBackwardEvent, 0, 0, 0, 1);
  expectNear(program.aim.wanted()->position, before + 0.20 * away, 1e-9);
  expectNear(program.hand().pose.position, before + 0.20 * away);
}

TEST(ToolInteraction, LeavesTheWheelToTheStyleOnTheSurface)
{
  Program program;
  program.mouse(vtkCommand::MouseMoveEvent, 0, 0);
  const Vector3d eye = program.eye();
  program.mouse(vtkCommand::MouseWheelForwardEvent, 0, 0);
  EXPECT_GT((program.eye() - eye).norm(), 1.0);
}

TEST(ToolInteraction, NudgesByArrowsAndLetters)
{
  const struct
  {
    const char* sym;
    double x, y;
  } keys[] = {{"Left", -1, 0}, {"a", -1, 0}, {"Right", 1, 0}, {"d", 1, 0},
              {"Up", 0, 1},    {"w", 0, 1},  {"Down", 0, -1}, {"s", 0, -1}};
  for (const auto& key : keys)
  {
    Program program;
    program.mouse(vtkCommand::MouseMoveEvent, 0, 0);
    const Vector3d before = program.aim.wanted()->position;
    program.type(key.sym);
    expectNear(program.aim.wanted()->position, before + 0.25 * Vector3d(key.x, key.y, 0.0), 1e-3);
    program.type("Home");
    expectNear(program.aim.wanted()->position, before, 1e-9);
  }
}

TEST(ToolInteraction, ChangesDepthModeAndHeadingByKeys)
{
  Program program;
  program.mouse(vtkCommand::MouseMoveEvent, 0, 0);
  program.type("m");
  EXPECT_EQ(program.aim.settings().mode, Mode::Depth);
  const double height = program.aim.wanted()->position.z();
  program.type("Next");
  EXPECT_LT(program.aim.wanted()->position.z(), height);
  program.type("Prior");
  program.type("Prior", 1);
  EXPECT_NEAR(program.aim.wanted()->position.z(), height + 0.05, 1e-3);
  program.type("f");
  EXPECT_EQ(program.aim.settings().tilt, 25.0);
  program.type("R", 1);
  EXPECT_EQ(program.aim.settings().tilt, 24.0);
  program.type("q");
  EXPECT_EQ(program.aim.settings().turn, -25.0);
  program.type("e");
  program.type("e");
  EXPECT_EQ(program.aim.settings().turn, -55.0);
}

TEST(ToolInteraction, DrillsWhileSpaceAndFreezesWhileCIsHeld)
{
  Program program;
  program.mouse(vtkCommand::MouseMoveEvent, 0, 0);
  program.key(vtkCommand::KeyPressEvent, "space");
  program.key(vtkCommand::KeyPressEvent, "space"); // key repeat
  EXPECT_EQ(program.hand().buttons, PointerDevice::kDrill);
  program.key(vtkCommand::KeyPressEvent, "c");
  EXPECT_EQ(program.hand().buttons, PointerDevice::kDrill | PointerDevice::kFreeze);
  EXPECT_EQ(program.tool->GetParameters().clutchButtons, PointerDevice::kFreeze);
  program.key(vtkCommand::KeyReleaseEvent, "c");
  program.key(vtkCommand::KeyReleaseEvent, "space");
  EXPECT_EQ(program.hand().buttons, 0U);
}

TEST(ToolInteraction, ReleasesWhatIsHeldWhenItIsSwitchedOff)
{
  const auto drilling = [](Program& program)
  {
    program.mouse(vtkCommand::LeftButtonPressEvent, 0, 0);
    ASSERT_EQ(program.hand().buttons, PointerDevice::kDrill);
  };
  const auto expectReleased = [](Program& program)
  {
    EXPECT_EQ(program.hand().buttons, 0U);
    EXPECT_EQ(program.tool->GetParameters().constantThrust, kHovers);
    EXPECT_FALSE(program.tool->GetDrilling());
  };
  Program off;
  drilling(off);
  off.tool->DrillModeOff();
  expectReleased(off);
  Program disabled;
  drilling(disabled);
  disabled.tool->EnabledOff();
  expectReleased(disabled);
  Program unfocused;
  drilling(unfocused);
  unfocused.tool->Release();
  expectReleased(unfocused);
}

TEST(ToolInteraction, LeavesNoObserverBehind)
{
  Window window;
  vtkNew<vtkGenericRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window.window);
  interactor->SetInteractorStyle(nullptr); // which observes as well
  {
    vtkNew<vtkPetrousToolInteraction> tool;
    tool->SetInteractor(interactor);
    tool->SetDefaultRenderer(window.renderer);
    tool->EnabledOn();
    EXPECT_TRUE(interactor->HasObserver(vtkCommand::MouseMoveEvent));
  }
  for (const unsigned long event :
       {vtkCommand::MouseMoveEvent, vtkCommand::LeftButtonReleaseEvent, vtkCommand::KeyReleaseEvent,
        vtkCommand::CharEvent, vtkCommand::DeleteEvent})
    EXPECT_FALSE(interactor->HasObserver(event)) << event;
}

TEST(ToolInteraction, KeepsItsKeysFromTheStyle)
{
  Program program;
  int seen = 0;
  vtkNew<vtkCallbackCommand> count;
  count->SetClientData(&seen);
  count->SetCallback([](vtkObject*, unsigned long, void* counter, void*)
                     { ++*static_cast<int*>(counter); });
  program.interactor->AddObserver(vtkCommand::CharEvent, count); // as the style does
  program.mouse(vtkCommand::MouseMoveEvent, 0, 0);
  program.type("w");
  program.type("space");
  EXPECT_EQ(seen, 0);
  program.type("x"); // not one of our keys
  EXPECT_EQ(seen, 1);
  program.tool->DrillModeOff();
  program.type("w");
  EXPECT_EQ(seen, 2);
}

TEST(ToolInteraction, GivesADeviceTheCamerasAxesScaleClutchAndDrill)
{
  Program program;
  program.tool->PointerHandOff();
  session::ServoParameters own;
  own.forceGain = 2.0;
  program.tool->SetParameters(own);
  vtkCamera* camera = program.window.renderer->GetActiveCamera();
  camera->SetPosition(0.0, -200.0, 0.0); // right is x, up is z, back is -y
  camera->SetViewUp(0.0, 0.0, 1.0);
  program.tool->See({});
  const session::ServoParameters& p = program.tool->GetParameters();
  const Eigen::Quaterniond axes(p.camera[0], p.camera[1], p.camera[2], p.camera[3]);
  expectNear(axes * Vector3d::UnitX(), Vector3d(1.0, 0.0, 0.0), 1e-9);
  expectNear(axes * Vector3d::UnitY(), Vector3d(0.0, 0.0, 1.0), 1e-9);
  EXPECT_EQ(p.forceGain, 2.0);

  program.mouse(vtkCommand::MouseWheelBackwardEvent, 0, 0, 1);
  EXPECT_NEAR(program.tool->GetParameters().scale, 0.8, 1e-12);
  program.key(vtkCommand::KeyPressEvent, "c");
  program.key(vtkCommand::KeyPressEvent, "space");
  EXPECT_EQ(program.tool->GetParameters().clutch, 1);
  EXPECT_EQ(program.tool->GetParameters().drill, 1);
  program.tool->Release();
  EXPECT_EQ(program.tool->GetParameters().clutch, 0);
  EXPECT_EQ(program.tool->GetParameters().drill, 0);

  const Vector3d eye = program.eye();
  program.mouse(vtkCommand::LeftButtonPressEvent, 0, 0);
  program.mouse(vtkCommand::MouseMoveEvent, 30, 10);
  program.mouse(vtkCommand::LeftButtonReleaseEvent, 30, 10);
  EXPECT_GT((program.eye() - eye).norm(), 1.0); // the mouse rotates the view

  own.scale = 100.0;
  EXPECT_THROW(program.tool->SetParameters(own), core::InvalidParameter);
}

TEST(ToolInteraction, FollowsTheServosRecords)
{
  Program program;
  program.setMode(Mode::Depth);
  program.mouse(vtkCommand::MouseMoveEvent, 0, 0);
  program.hand();
  // The servo re-anchored the tool 4 mm to the side, at another height.
  session::TickRecord record;
  record.input = session::TickInput::of(program.now, program.device.read(program.now), {});
  haptics::Pose held = record.input.device.pose();
  held.position += Vector3d(4.0, 0.0, 6.0);
  record.mapped = record.proxy = session::PoseValues::of(held);
  program.tool->See(record);
  const Vector3d wanted = program.aim.wanted()->position;
  EXPECT_NEAR(wanted.z(), held.position.z(), 1e-9);
  // The servo's new offset is compensated.
  expectNear(program.hand().pose.position, wanted - Vector3d(4.0, 0.0, 6.0));
}
