#include "petrous/Interaction/CameraStyle.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <vtkCallbackCommand.h>
#include <vtkGenericRenderWindowInteractor.h>

#include "Window.h"
#include "petrous/Interaction/RendererPickRay.h"

using namespace petrous::interaction;
using Eigen::Vector3d;
using petrous::core::CameraPose;
using petrous::interaction::testing::Window;

namespace
{

struct Program
{
  Window window;
  vtkNew<vtkGenericRenderWindowInteractor> interactor;
  vtkNew<vtkPetrousCameraStyle> style;

  Program()
  {
    interactor->SetRenderWindow(window.window);
    interactor->SetInteractorStyle(style);
    interactor->Enable();
  }
  ~Program() { interactor->SetInteractorStyle(nullptr); }

  void mouse(unsigned long event, int x, int y, int shift = 0)
  {
    interactor->SetEventInformation(x, y, 0, shift);
    interactor->InvokeEvent(event);
  }
  void drag(int x, int y, int shift = 0)
  {
    mouse(vtkCommand::LeftButtonPressEvent, 100, 80, shift);
    mouse(vtkCommand::MouseMoveEvent, 100 + x, 80 + y, shift);
    mouse(vtkCommand::LeftButtonReleaseEvent, 100 + x, 80 + y, shift);
  }
  void key(const char* sym)
  {
    interactor->SetKeyEventInformation(0, 0, sym[0], 0, sym);
    interactor->InvokeEvent(vtkCommand::KeyPressEvent);
    interactor->InvokeEvent(vtkCommand::CharEvent);
    interactor->InvokeEvent(vtkCommand::KeyReleaseEvent);
  }
  CameraPose camera() { return cameraOf(*window.renderer); }
};

double radians(double degrees)
{
  return degrees * std::acos(-1.0) / 180.0;
}

} // namespace

TEST(CameraStyle, ADragRotatesSoThatWhatIsNearFollows)
{
  Program program;
  program.drag(50, 0); // 20 degrees: the camera goes to the left, which is -x
  const Vector3d expected(-200.0 * std::sin(radians(20.0)), 0.0, 200.0 * std::cos(radians(20.0)));
  EXPECT_LT((program.camera().position - expected).norm(), 1e-9);
  program.drag(-50, 0);
  program.drag(0, 50); // upwards: the camera goes down
  EXPECT_LT((program.camera().position - Vector3d(0.0, expected.x(), expected.z())).norm(), 1e-9);
}

TEST(CameraStyle, ADragIsAsFarOnAHighDpiScreen)
{
  Program program;
  program.window.window->SetDPI(144);
  program.drag(100, 0);
  EXPECT_NEAR(program.camera().position.x(), -200.0 * std::sin(radians(20.0)), 1e-9);
}

// A point in the focal plane stays under the pointer.
TEST(CameraStyle, ADragWithShiftPans)
{
  Program program;
  const PickRay before = pickRayThrough(*program.window.renderer, 100, 80);
  const Vector3d point = before.at(-before.origin.z() / before.direction.z());
  program.drag(31, -17, 1);
  const PickRay after = pickRayThrough(*program.window.renderer, 131, 63);
  EXPECT_LT((point - after.origin).cross(after.direction).norm(), 1e-9);
  EXPECT_LT(
      (program.camera().position - program.camera().focalPoint - Vector3d(0.0, 0.0, 200.0)).norm(),
      1e-9);
}

TEST(CameraStyle, EveryButtonRotatesUntilTheLastIsReleased)
{
  Program program;
  program.mouse(vtkCommand::MiddleButtonPressEvent, 100, 80);
  program.mouse(vtkCommand::RightButtonPressEvent, 100, 80);
  program.mouse(vtkCommand::MiddleButtonReleaseEvent, 100, 80);
  program.mouse(vtkCommand::MouseMoveEvent, 150, 80);
  EXPECT_NEAR(program.camera().position.x(), -200.0 * std::sin(radians(20.0)), 1e-9);
  EXPECT_NE(program.style->GetState(), VTKIS_NONE);
  program.mouse(vtkCommand::RightButtonReleaseEvent, 150, 80);
  EXPECT_EQ(program.style->GetState(), VTKIS_NONE);
  const Vector3d there = program.camera().position;
  program.mouse(vtkCommand::MouseMoveEvent, 10, 10);
  EXPECT_EQ(program.camera().position, there);
}

TEST(CameraStyle, TheWheelDolliesByItsFactor)
{
  Program program;
  program.mouse(vtkCommand::MouseWheelForwardEvent, 100, 80);
  EXPECT_NEAR(program.camera().position.z(), 200.0 / 1.15, 1e-9);
  program.mouse(vtkCommand::MouseWheelBackwardEvent, 100, 80);
  EXPECT_NEAR(program.camera().position.z(), 200.0, 1e-9);
  program.style->SetMouseWheelMotionFactor(0.5); // of a touchpad
  program.mouse(vtkCommand::MouseWheelBackwardEvent, 100, 80);
  EXPECT_NEAR(program.camera().position.z(), 200.0 * std::sqrt(1.15), 1e-9);
}

TEST(CameraStyle, KeysRotateAndDolly)
{
  const double side = 200.0 * std::sin(radians(7.5));
  const double back = 200.0 * std::cos(radians(7.5));
  const struct
  {
    const char* sym;
    Vector3d position;
  } keys[] = {{"Left", {side, 0.0, back}},         {"Right", {-side, 0.0, back}},
              {"Up", {0.0, -side, back}},          {"Down", {0.0, side, back}},
              {"plus", {0.0, 0.0, 200.0 / 1.15}},  {"equal", {0.0, 0.0, 200.0 / 1.15}},
              {"minus", {0.0, 0.0, 200.0 * 1.15}}, {"w", {0.0, 0.0, 200.0}},
              {"KP_Add", {0.0, 0.0, 200.0 / 1.15}}};
  for (const auto& key : keys)
  {
    Program program;
    program.key(key.sym);
    EXPECT_LT((program.camera().position - key.position).norm(), 1e-9) << key.sym;
  }
}

TEST(CameraStyle, AProgramThatRendersItselfAborts)
{
  Program program;
  int drawn = 0;
  vtkNew<vtkCallbackCommand> count;
  count->SetClientData(&drawn);
  count->SetCallback([](vtkObject*, unsigned long, void* counter, void*)
                     { ++*static_cast<int*>(counter); });
  program.window.window->AddObserver(vtkCommand::EndEvent, count);
  program.drag(10, 0);
  EXPECT_EQ(drawn, 1);
  vtkNew<vtkCallbackCommand> render;
  render->SetCallback([](vtkObject*, unsigned long, void* self, void*)
                      { static_cast<vtkCommand*>(self)->SetAbortFlag(1); });
  render->SetClientData(render);
  program.style->AddObserver(vtkCommand::InteractionEvent, render);
  program.drag(10, 0);
  EXPECT_EQ(drawn, 1);
}
