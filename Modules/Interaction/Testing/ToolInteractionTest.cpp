#include "petrous/Interaction/ToolInteraction.h"

#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <vtkCallbackCommand.h>
#include <vtkGenericRenderWindowInteractor.h>
#include <vtkInteractorStyleTrackballCamera.h>

#include "Tissue.h"
#include "Window.h"
#include "petrous/Core/Error.h"
#include "petrous/Interaction/CameraStyle.h"
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
  // Calls `then` with the tool's events.
  void on(unsigned long event, std::function<void()> then)
  {
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(new std::function<void()>(std::move(then)));
    command->SetClientDataDeleteCallback([](void* data)
                                         { delete static_cast<std::function<void()>*>(data); });
    command->SetCallback([](vtkObject*, unsigned long, void* data, void*)
                         { (*static_cast<std::function<void()>*>(data))(); });
    tool->AddObserver(event, command);
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

TEST(ToolInteraction, PressesTwiceAsHardWhileShiftIsHeld)
{
  Program program;
  const double set = program.aim.settings().thrust;
  const auto thrust = [&program] { return program.tool->GetParameters().thrust; };
  program.key(vtkCommand::KeyPressEvent, "Shift_L", 1);
  program.mouse(vtkCommand::MouseMoveEvent, 10, 5, 0, 1);
  EXPECT_EQ(thrust(), set) << "it hovers";
  program.mouse(vtkCommand::LeftButtonPressEvent, 10, 5, 0, 1);
  EXPECT_EQ(thrust(), 2.0 * set);
  program.key(vtkCommand::KeyReleaseEvent, "Shift_L", 0);
  program.tool->See({}); // as once a frame
  EXPECT_EQ(thrust(), set);
  program.key(vtkCommand::KeyPressEvent, "Shift_L", 1);
  program.tool->See({});
  EXPECT_EQ(thrust(), 2.0 * set);
  AimSettings settings = program.aim.settings();
  settings.thrust = 15.0;
  program.aim.setSettings(settings);
  program.mouse(vtkCommand::MouseMoveEvent, 12, 5, 0, 1);
  EXPECT_EQ(thrust(), 20.0) << "no more than may be set";
  program.mouse(vtkCommand::LeftButtonReleaseEvent, 12, 5, 0, 1);
  EXPECT_EQ(thrust(), 15.0);
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
  using Parameters = session::ServoParameters;
  EXPECT_EQ(program.tool->GetParameters().drill, Parameters::kDrill | Parameters::kPedalSpeed);
  program.tool->Release();
  EXPECT_EQ(program.tool->GetParameters().clutch, 0);
  EXPECT_EQ(program.tool->GetParameters().drill, Parameters::kPedalSpeed);

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

// At all four edges alike; x and y from the centre of 240 x 160 pixels.
TEST(ToolInteraction, StopsTheDrillAtTheEdgesOfTheWindow)
{
  const struct
  {
    int x, y, beyondX, beyondY;
  } edges[] = {{-120, 3, -121, 3}, {119, 3, 120, 3}, {4, -80, 4, -81}, {4, 79, 4, 80}};
  for (const auto& edge : edges)
  {
    SCOPED_TRACE(edge.beyondX);
    SCOPED_TRACE(edge.beyondY);
    Program program;
    int started = 0;
    program.on(vtkCommand::StartInteractionEvent, [&] { ++started; });
    program.mouse(vtkCommand::LeftButtonPressEvent, 0, 0);
    program.mouse(vtkCommand::MouseMoveEvent, edge.x, edge.y);
    EXPECT_TRUE(program.tool->GetDrilling());
    program.mouse(vtkCommand::MouseMoveEvent, edge.beyondX, edge.beyondY);
    EXPECT_FALSE(program.tool->GetDrilling());
    EXPECT_EQ(program.hand().buttons, 0U);
    expectNear(program.hand().pose.position, program.hoverOver(edge.x, edge.y)); // not beyond
    program.mouse(vtkCommand::MouseMoveEvent, 0, 0); // with the button still held
    EXPECT_FALSE(program.tool->GetDrilling());
    expectNear(program.hand().pose.position, program.hoverOver(0, 0));
    program.mouse(vtkCommand::LeftButtonReleaseEvent, 0, 0);
    EXPECT_EQ(started, 1);
  }
}

TEST(ToolInteraction, StopsTheDrillOfTheKeyWhereThePointerLeaves)
{
  Program program;
  int left = 0;
  program.on(vtkCommand::LeaveEvent, [&] { ++left; });
  program.mouse(vtkCommand::MouseMoveEvent, 70, 0);
  program.key(vtkCommand::KeyPressEvent, "space");
  EXPECT_TRUE(program.tool->GetDrilling());
  program.mouse(vtkCommand::LeaveEvent, 200, 0);
  EXPECT_FALSE(program.tool->GetDrilling());
  EXPECT_EQ(left, 1);
  program.interactor->SetKeyEventInformation(0, 0, ' ', 2, "space"); // the key repeats
  program.interactor->InvokeEvent(vtkCommand::KeyPressEvent);
  EXPECT_FALSE(program.tool->GetDrilling());
  program.key(vtkCommand::KeyReleaseEvent, "space");
}

TEST(ToolInteraction, DrillsAtTheCentreWithoutAPointer)
{
  Program program;
  program.key(vtkCommand::KeyPressEvent, "space");
  EXPECT_EQ(program.hand().buttons, PointerDevice::kDrill);
  expectNear(program.hand().pose.position, Vector3d(0.0, 0.0, 2.0));
}

TEST(ToolInteraction, KeepsOtherButtonsFromTheCameraWhileItDrills)
{
  Program program;
  const Vector3d eye = program.eye();
  program.mouse(vtkCommand::LeftButtonPressEvent, 0, 0);
  program.mouse(vtkCommand::MiddleButtonPressEvent, 0, 0);
  program.mouse(vtkCommand::MouseMoveEvent, 40, 20);
  EXPECT_EQ(program.eye(), eye);
  expectNear(program.hand().pose.position, program.hoverOver(40, 20, 2.0));
}

// A program that starts its servo when the pointer comes, or when it presses.
TEST(ToolInteraction, ADeviceMaySetItselfUpWhenItIsWanted)
{
  for (const bool press : {false, true})
  {
    Program program;
    program.tool->SetPointer(&program.aim, nullptr);
    program.mouse(vtkCommand::MouseMoveEvent, 0, 0);
    EXPECT_FALSE(program.aim.wanted());
    program.on(press ? vtkCommand::StartInteractionEvent : vtkCommand::HoverEvent,
               [&] { program.tool->SetPointer(&program.aim, &program.device); });
    program.mouse(press ? vtkCommand::LeftButtonPressEvent : vtkCommand::MouseMoveEvent, 30, 10);
    expectNear(program.hand().pose.position, program.hoverOver(30, 10, press ? 2.0 : 3.0));
    EXPECT_EQ(program.hand().buttons, press ? PointerDevice::kDrill : 0U);
    EXPECT_EQ(program.tool->GetDrilling(), press);
    program.tool->SetPointer(nullptr, nullptr);
  }
}

TEST(ToolInteraction, ReportsRaysThatHoverAndPick)
{
  Program program;
  program.tool->DrillModeOff();
  std::vector<PickRay> hovered, picked;
  program.on(vtkCommand::HoverEvent, [&] { hovered.push_back(program.tool->GetPickRay()); });
  program.on(vtkCommand::PickEvent, [&] { picked.push_back(program.tool->GetPickRay()); });
  program.mouse(vtkCommand::MouseMoveEvent, 30, 10);
  program.mouse(vtkCommand::MouseMoveEvent, 130, 10); // beyond the edge
  ASSERT_EQ(hovered.size(), 1U);
  program.mouse(vtkCommand::LeftButtonDoubleClickEvent, -20, 40);
  ASSERT_EQ(picked.size(), 1U);
  const auto meets = [](const PickRay& ray, int x, int y)
  {
    const Vector3d at = ray.at(-ray.origin.z() / ray.direction.z());
    expectNear(at, Vector3d((x + 0.5) * Window::pixel(), (y + 0.5) * Window::pixel(), 0.0), 1e-9);
  };
  meets(hovered.front(), 30, 10);
  meets(picked.front(), -20, 40);
  program.mouse(vtkCommand::LeftButtonPressEvent, 0, 0);
  program.mouse(vtkCommand::MouseMoveEvent, 20, 10);
  EXPECT_EQ(hovered.size(), 1U) << "the camera is moved";
  program.mouse(vtkCommand::LeftButtonReleaseEvent, 20, 10);
  program.tool->DrillModeOn();
  program.mouse(vtkCommand::LeftButtonDoubleClickEvent, 0, 0);
  EXPECT_EQ(picked.size(), 1U);
  EXPECT_TRUE(program.tool->GetDrilling());
}

TEST(ToolInteraction, AProbeFollowsAndIsNotPressed)
{
  Program program;
  program.tool->DrillModeOff();
  program.tool->ProbeModeOn();
  program.mouse(vtkCommand::MouseMoveEvent, 20, 0);
  expectNear(program.hand().pose.position, program.hoverOver(20, 0));
  program.key(vtkCommand::KeyPressEvent, "space");
  EXPECT_EQ(program.hand().buttons, 0U);
  EXPECT_EQ(program.tool->GetParameters().constantThrust, kHovers);
  EXPECT_EQ(program.tool->GetParameters().drillButtons, 0U);
  EXPECT_EQ(program.tool->GetParameters().drill, 0);
  program.key(vtkCommand::KeyReleaseEvent, "space");
  program.key(vtkCommand::KeyPressEvent, "c");
  EXPECT_EQ(program.hand().buttons, PointerDevice::kFreeze);
  const Vector3d eye = program.eye();
  program.mouse(vtkCommand::LeftButtonPressEvent, 20, 0);
  program.mouse(vtkCommand::MouseMoveEvent, 60, 30);
  program.mouse(vtkCommand::LeftButtonReleaseEvent, 60, 30);
  EXPECT_GT((program.eye() - eye).norm(), 1.0);
}

TEST(ToolInteraction, APedalPresses)
{
  Program program;
  program.mouse(vtkCommand::MouseMoveEvent, 0, 0);
  session::TickRecord record;
  record.proxy = session::PoseValues::of(*program.aim.wanted());
  record.input.pedal = 0.6;
  program.tool->See(record);
  EXPECT_EQ(program.hand().buttons, 0U) << "a button would drill at full speed";
  EXPECT_EQ(program.tool->GetParameters().constantThrust, kPresses);
  EXPECT_EQ(program.tool->GetParameters().drill, session::ServoParameters::kPedalSpeed);
  record.input.pedal = 0.4;
  program.tool->See(record);
  EXPECT_EQ(program.tool->GetParameters().constantThrust, kHovers);
  program.tool->DrillModeOff();
  program.tool->ProbeModeOn();
  record.input.pedal = 1.0;
  program.tool->See(record);
  EXPECT_EQ(program.tool->GetParameters().constantThrust, kHovers);
  EXPECT_EQ(program.tool->GetParameters().drill, 0);
}

TEST(ToolInteraction, AWheelsFractionsAndHeapsCount)
{
  Program program;
  program.setMode(Mode::Depth);
  program.mouse(vtkCommand::MouseMoveEvent, 0, 0);
  const double height = program.aim.wanted()->position.z();
  auto* style = vtkInteractorStyle::SafeDownCast(program.interactor->GetInteractorStyle());
  style->SetMouseWheelMotionFactor(4.0);
  program.mouse(vtkCommand::MouseWheelForwardEvent, 0, 0);
  EXPECT_NEAR(program.aim.wanted()->position.z(), height - 1.0, 1e-3);
  style->SetMouseWheelMotionFactor(0.5);
  program.mouse(vtkCommand::MouseWheelBackwardEvent, 0, 0);
  EXPECT_NEAR(program.aim.wanted()->position.z(), height - 0.875, 1e-3);
}

TEST(ToolInteraction, LeavesItsShortcutsToAProgramThatHasItsOwn)
{
  Program program;
  program.tool->ShortcutsOff();
  program.tool->SetFreezeKey("x");
  program.mouse(vtkCommand::MouseMoveEvent, 0, 0);
  const Vector3d before = program.aim.wanted()->position;
  for (const char* key : {"Left", "w", "Next", "m", "f", "c"})
    program.type(key);
  EXPECT_EQ(program.aim.wanted()->position, before);
  EXPECT_EQ(program.aim.settings().mode, Mode::Surface);
  EXPECT_EQ(program.hand().buttons, 0U);
  program.key(vtkCommand::KeyPressEvent, "X");
  EXPECT_EQ(program.hand().buttons, PointerDevice::kFreeze);
  program.tool->SetPointer(&program.aim, &program.device); // another session
  program.mouse(vtkCommand::MouseMoveEvent, 5, 0);
  EXPECT_EQ(program.hand().buttons, PointerDevice::kFreeze) << "still held";
  program.key(vtkCommand::KeyReleaseEvent, "x");
  EXPECT_EQ(program.hand().buttons, 0U);
  program.tool->PointerHandOff();
  program.mouse(vtkCommand::MouseWheelBackwardEvent, 0, 0, 1);
  EXPECT_EQ(program.tool->GetParameters().scale, session::ServoParameters().scale);
}

TEST(ToolInteraction, AimsUnderACameraThatMovesWhileItDrills)
{
  Program program;
  program.mouse(vtkCommand::MouseMoveEvent, 0, 0);
  program.key(vtkCommand::KeyPressEvent, "space");
  vtkCamera* camera = program.window.renderer->GetActiveCamera();
  camera->SetPosition(10.0, 0.0, 200.0);
  camera->SetFocalPoint(10.0, 0.0, 0.0);
  program.tool->See({});
  expectNear(program.hand().pose.position, program.hoverOver(0, 0, 2.0) + Vector3d(10.0, 0.0, 0.0));
}

TEST(ToolInteraction, ShowsACrossWhereThePointerLeadsTheTool)
{
  Program program;
  const auto cursor = [&] { return program.window.window->GetCurrentCursor(); };
  EXPECT_EQ(cursor(), VTK_CURSOR_CROSSHAIR);
  program.tool->PointerHandOff();
  EXPECT_EQ(cursor(), VTK_CURSOR_DEFAULT);
  program.tool->PointerHandOn();
  program.tool->DrillModeOff();
  EXPECT_EQ(cursor(), VTK_CURSOR_DEFAULT);
  program.tool->ProbeModeOn();
  EXPECT_EQ(cursor(), VTK_CURSOR_CROSSHAIR);
}

// Another window on the same scene, from the other side.
TEST(ToolInteraction, ASecondWindowLeadsTheSameTool)
{
  Program program;
  Program other;
  other.tool->SetPointer(nullptr, nullptr);
  other.tool->SetLeader(program.tool);
  other.window.renderer->GetActiveCamera()->SetFocalPoint(10.0, 0.0, 0.0);
  other.window.renderer->GetActiveCamera()->SetPosition(10.0, 0.0, 200.0);
  const Vector3d shift(10.0, 0.0, 0.0);
  other.mouse(vtkCommand::MouseMoveEvent, 20, 5);
  expectNear(program.hand().pose.position, program.hoverOver(20, 5) + shift);
  other.mouse(vtkCommand::LeftButtonPressEvent, 20, 5);
  EXPECT_TRUE(program.tool->GetDrilling());
  program.tool->See({});
  expectNear(program.hand().pose.position, program.hoverOver(20, 5, 2.0) + shift);
  program.mouse(vtkCommand::LeaveEvent, 0, 0); // the pointer is in the other window
  EXPECT_TRUE(program.tool->GetDrilling());
  other.mouse(vtkCommand::LeftButtonReleaseEvent, 20, 5);
  EXPECT_FALSE(program.tool->GetDrilling());
  program.tool->DrillModeOff();
  EXPECT_EQ(other.window.window->GetCurrentCursor(), VTK_CURSOR_DEFAULT);
  program.tool->DrillModeOn();
  EXPECT_EQ(other.window.window->GetCurrentCursor(), VTK_CURSOR_CROSSHAIR);
  other.key(vtkCommand::KeyPressEvent, "space");
  EXPECT_TRUE(program.tool->GetDrilling());
  other.tool->EnabledOff(); // it closes
  EXPECT_FALSE(program.tool->GetDrilling());
}

TEST(ToolInteraction, OneSessionOfEventsWithTheWindowsOwnCameraStyle)
{
  Program program;
  vtkNew<vtkPetrousCameraStyle> style;
  program.interactor->SetInteractorStyle(style);
  program.mouse(vtkCommand::RightButtonPressEvent, 0, 0);
  program.mouse(vtkCommand::MouseMoveEvent, 20, 0);
  const Vector3d eye = program.eye();
  EXPECT_LT(eye.x(), -1.0);
  EXPECT_FALSE(program.aim.wanted());
  program.key(vtkCommand::KeyPressEvent, "space"); // from here on the pointer drills
  program.mouse(vtkCommand::MouseMoveEvent, 40, 0);
  EXPECT_EQ(program.eye(), eye);
  EXPECT_TRUE(program.aim.wanted());
  program.key(vtkCommand::KeyReleaseEvent, "space");
  program.mouse(vtkCommand::RightButtonReleaseEvent, 40, 0);
  program.mouse(vtkCommand::LeftButtonPressEvent, 40, 0);
  program.tool->DrillModeOff();
  program.mouse(vtkCommand::LeftButtonReleaseEvent, 40, 0);
  program.mouse(vtkCommand::LeftButtonPressEvent, 40, 0);
  program.tool->DrillModeOn(); // by a key, in the middle of a drag
  program.mouse(vtkCommand::LeftButtonReleaseEvent, 40, 0);
  EXPECT_EQ(style->GetState(), VTKIS_NONE);
  program.interactor->SetInteractorStyle(nullptr);
}
