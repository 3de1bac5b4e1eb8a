#include "DeviceTest.h"

#include <algorithm>
#include <cmath>

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>

#include <vtkCamera.h>
#include <vtkGenericRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include "DrillController.h"
#include "petrous/Haptics/ConstrainedProxy.h"
#include "petrous/Interaction/CameraStyle.h"
#include "petrous/Interaction/PointerDevice.h"
#include "petrous/Interaction/PointerToolController.h"
#include "petrous/Interaction/RendererPickRay.h"
#include "petrous/Rendering/EglRenderWindow.h"
#include "petrous/Session/Servo.h"

using namespace petrous;
using namespace petrous::workstation;
using Eigen::Vector3d;

namespace
{

class Pointer : public DeviceTest
{
protected:
  void pointAt(const QPoint& pixel)
  {
    QTest::mouseMove(&view(), pixel + QPoint(3, 0));
    QTest::mouseMove(&view(), pixel);
  }

  // The slices follow it.
  Vector3d tip() { return window().model().crosshair(); }

  // Output of the command for the same point.
  QJsonObject probed(const Vector3d& place)
  {
    const auto file = folder() / "points.csv";
    std::ofstream points(file);
    points.precision(17);
    points << "x_mm,y_mm,z_mm\n" << place.x() << "," << place.y() << "," << place.z() << "\n";
    points.close();
    QProcess command;
    command.start(PETROUS_COMMAND,
                  {"probe", "ball", "--points", QString::fromStdString(file.string()), "--library",
                   QString::fromStdString((folder() / "library").string()), "--json"});
    EXPECT_TRUE(command.waitForFinished(60000));
    const QByteArray out = command.readAllStandardOutput();
    return QJsonDocument::fromJson(out).object()["points"].toArray()[0].toObject();
  }
};

/// A pointer's tool over a ball of bone, in simulated time: 1000 ticks per second, one frame
/// per 16.
class LedTool
{
public:
  LedTool(vtkPetrousToolInteraction& interaction,
          const std::shared_ptr<const volume::TissueField>& bone)
    : m_interaction(interaction)
    , m_proxy(std::make_shared<haptics::HapticField>(*bone, std::make_shared<volume::PublishedMask>(
                                                                volume::CutMask(bone->geometry()))),
              haptics::makeBurrShell(haptics::BurrShape(), 0.5, 300))
    , m_servo(m_proxy, setup(m_proxy))
    , m_aim([bone](const interaction::PickRay& line)
            { return interaction::firstTissue(*bone, line); })
  {
    interaction.SetPointer(&m_aim, &m_device);
    interaction.DrillModeOn();
  }
  ~LedTool() { m_interaction.SetPointer(nullptr, nullptr); }

  void depthByWheel()
  {
    auto settings = m_aim.settings();
    settings.mode = interaction::AimSettings::Mode::Depth;
    m_aim.setSettings(settings);
  }

  std::vector<session::TickRecord> run(int frames)
  {
    std::vector<session::TickRecord> records;
    for (int n = 0; n < 16 * frames; ++n)
    {
      if (n % 16 == 0)
        m_interaction.See(m_record);
      m_now += 0.001;
      m_record = m_servo.tick(
          session::TickInput::of(m_now, m_device.read(m_now), m_interaction.GetParameters()));
      records.push_back(m_record);
    }
    return records;
  }

private:
  static session::ServoSetup setup(const haptics::ConstrainedProxy& tool)
  {
    session::ServoSetup setup;
    setup.burrPoints = tool.shell().burrCount;
    return setup;
  }

  vtkPetrousToolInteraction& m_interaction;
  haptics::ConstrainedProxy m_proxy;
  session::Servo m_servo;
  interaction::PointerDevice m_device;
  interaction::PointerToolController m_aim;
  session::TickRecord m_record;
  double m_now = 10.0;
};

/// The window's view and a plain VTK window of the same size: each event is sent to both, in Qt's
/// words and in VTK's, and their tools' records are compared.
class TwinWindows
{
public:
  TwinWindows()
  {
    core::CameraPose camera;
    camera.position = {0.0, 0.0, 150.0};
    camera.focalPoint = {0.0, 0.0, 0.0};
    camera.viewUp = {0.0, 1.0, 0.0};
    m_view.resize(kWidth, kHeight);
    m_view.show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&m_view));
    EXPECT_TRUE(QTest::qWaitFor([this] { return m_view.renderWindow()->GetSize()[0] == kWidth; }));
    m_view.setCamera(camera);
    m_plain->SetSize(kWidth, kHeight);
    m_plain->AddRenderer(m_renderer);
    auto* plainCamera = m_renderer->GetActiveCamera();
    plainCamera->SetPosition(camera.position.data());
    plainCamera->SetFocalPoint(camera.focalPoint.data());
    plainCamera->SetViewUp(camera.viewUp.data());
    plainCamera->SetViewAngle(camera.viewAngle);
    m_interactor->SetRenderWindow(m_plain);
    m_interactor->EnableRenderOff(); // for lack of anything to see
    m_interactor->SetInteractorStyle(m_style);
    m_interactor->Enable();
    m_tool->SetInteractor(m_interactor);
    m_tool->SetDefaultRenderer(m_renderer);
    m_tool->ShortcutsOff();
    m_tool->SetFreezeKey("x");
    m_tool->EnabledOn();
    const auto bone = ball();
    m_window = std::make_unique<LedTool>(m_view.tool(), bone);
    m_program = std::make_unique<LedTool>(*m_tool, bone);
  }
  ~TwinWindows()
  {
    m_tool->SetInteractor(nullptr);
    m_interactor->SetInteractorStyle(nullptr);
  }

  void move(int x, int y, Qt::MouseButtons held = {}, Qt::KeyboardModifiers keys = {})
  {
    QMouseEvent event(QEvent::MouseMove, QPointF(x, y), Qt::NoButton, held, keys);
    QApplication::sendEvent(&m_view, &event);
    plain(vtkCommand::MouseMoveEvent, x, y, keys);
  }
  void button(QEvent::Type type, Qt::MouseButton which, unsigned long vtk, int x, int y,
              Qt::KeyboardModifiers keys = {})
  {
    QMouseEvent event(type, QPointF(x, y), which,
                      type == QEvent::MouseButtonRelease ? Qt::NoButton : which, keys);
    QApplication::sendEvent(&m_view, &event);
    plain(vtk, x, y, keys);
  }
  void press(int x, int y, Qt::KeyboardModifiers keys = {})
  {
    button(QEvent::MouseButtonPress, Qt::LeftButton, vtkCommand::LeftButtonPressEvent, x, y, keys);
  }
  void release(int x, int y)
  {
    button(QEvent::MouseButtonRelease, Qt::LeftButton, vtkCommand::LeftButtonReleaseEvent, x, y);
  }
  void wheel(double notches, int x, int y, Qt::KeyboardModifiers keys = {})
  {
    const QPointF at(x, y);
    QWheelEvent event(at, m_view.mapToGlobal(at.toPoint()), {},
                      {0, static_cast<int>(std::lround(120.0 * notches))}, Qt::NoButton, keys,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(&m_view, &event);
    m_style->SetMouseWheelMotionFactor(std::abs(notches));
    plain(notches > 0.0 ? vtkCommand::MouseWheelForwardEvent : vtkCommand::MouseWheelBackwardEvent,
          x, y, keys);
  }
  void key(QEvent::Type type, Qt::Key qt, const QString& text, const char* vtk,
           bool repeats = false)
  {
    QKeyEvent event(type, qt, Qt::NoModifier, text, repeats);
    QApplication::sendEvent(&m_view, &event);
    if (repeats && type == QEvent::KeyRelease)
      return compare(); // VTK's own windows send none
    m_interactor->SetKeyEventInformation(0, 0, text.isEmpty() ? '\0' : text[0].toLatin1(),
                                         repeats ? 2 : 1, vtk);
    m_interactor->InvokeEvent(type == QEvent::KeyPress ? vtkCommand::KeyPressEvent
                                                       : vtkCommand::KeyReleaseEvent);
    compare();
  }
  void leave()
  {
    QEvent event(QEvent::Leave);
    QApplication::sendEvent(&m_view, &event);
    m_interactor->InvokeEvent(vtkCommand::LeaveEvent);
    compare();
  }
  void loseFocus()
  {
    QFocusEvent event(QEvent::FocusOut);
    QApplication::sendEvent(&m_view, &event);
    m_tool->Release();
    compare();
  }
  void depthByWheel()
  {
    m_window->depthByWheel();
    m_program->depthByWheel();
  }

  int strokes() const { return m_strokes; }
  int pressedTicks() const { return m_pressed; } ///< with thrust and without the drill
  core::CameraPose camera() { return m_view.picture().camera(); }

private:
  static constexpr int kWidth = 360;
  static constexpr int kHeight = 280;

  static std::shared_ptr<const volume::TissueField> ball()
  {
    const core::GridGeometry grid({61, 61, 61}, {0.5, 0.5, 0.5}, {-15.0, -15.0, -15.0});
    auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid);
    for (int k = 0; k < 61; ++k)
      for (int j = 0; j < 61; ++j)
        for (int i = 0; i < 61; ++i)
          voxels->at(i, j, k) = static_cast<std::int16_t>(
              std::clamp(300.0 + 400.0 * (12.0 - grid.patientFromVoxel(Vector3d(i, j, k)).norm()),
                         -1000.0, 1500.0));
    return std::make_shared<volume::TissueField>(
        std::make_shared<volume::IntensityVolume>(std::move(voxels)),
        std::vector<volume::TissueField::SolidUnion>(), nullptr, volume::TissueField::Parameters());
  }

  void plain(unsigned long event, int x, int y, Qt::KeyboardModifiers keys)
  {
    m_interactor->SetEventInformation(x, kHeight - 1 - y, keys & Qt::ControlModifier ? 1 : 0,
                                      keys & Qt::ShiftModifier ? 1 : 0);
    m_interactor->InvokeEvent(event);
    compare();
  }

  void compare()
  {
    const core::CameraPose shown = camera();
    const core::CameraPose plainly = interaction::cameraOf(*m_renderer);
    EXPECT_LT((shown.position - plainly.position).norm(), 1e-9);
    EXPECT_LT((shown.focalPoint - plainly.focalPoint).norm(), 1e-9);
    EXPECT_LT((shown.viewUp - plainly.viewUp).norm(), 1e-9);
    EXPECT_EQ(m_view.tool().GetDrilling(), m_tool->GetDrilling());
    const auto one = m_window->run(8);
    const auto other = m_program->run(8);
    for (std::size_t n = 0; n < one.size(); ++n)
    {
      ASSERT_EQ(one[n].drill, other[n].drill) << n;
      ASSERT_EQ(one[n].fault, other[n].fault) << n;
      ASSERT_EQ(one[n].input.buttons, other[n].input.buttons) << n;
      ASSERT_EQ(one[n].input.parameters.constantThrust, other[n].input.parameters.constantThrust);
      ASSERT_LT((one[n].proxy.pose().position - other[n].proxy.pose().position).norm(), 1e-6) << n;
      m_strokes += one[n].drill && !m_drilled;
      m_drilled = one[n].drill != 0;
      m_pressed += !m_drilled && (one[n].input.parameters.constantThrust &
                                  session::ServoParameters::kPressed) != 0;
    }
  }

  ThreeDView m_view;
  vtkNew<vtkPetrousEGLRenderWindow> m_plain;
  vtkNew<vtkRenderer> m_renderer;
  vtkNew<vtkGenericRenderWindowInteractor> m_interactor;
  vtkNew<vtkPetrousCameraStyle> m_style;
  vtkNew<vtkPetrousToolInteraction> m_tool;
  std::unique_ptr<LedTool> m_window, m_program;
  int m_strokes = 0;
  int m_pressed = 0;
  bool m_drilled = false;
};

} // namespace

TEST(PointerEvents, GiveTheSameStrokesInTheWindowAndInAnyVtkProgram)
{
  TwinWindows both;
  both.move(150, 140);
  both.move(180, 140);
  both.press(180, 140); // 1: with a drag
  for (int n = 1; n <= 5; ++n)
    both.move(180 + 3 * n, 140 - 2 * n, Qt::LeftButton);
  both.release(195, 130);
  EXPECT_EQ(both.strokes(), 1);

  both.press(180, 140, Qt::ControlModifier); // without the drill
  EXPECT_GT(both.pressedTicks(), 0);
  both.release(180, 140);
  EXPECT_EQ(both.strokes(), 1);

  both.press(20, 140); // 2: dragged over the edge, where there is no tissue
  both.move(180, 140, Qt::LeftButton);
  both.move(-1, 140, Qt::LeftButton);
  both.move(180, 140, Qt::LeftButton);
  both.release(180, 140);
  EXPECT_EQ(both.strokes(), 2);

  both.key(QEvent::KeyPress, Qt::Key_Space, " ", "space"); // 3: by the key, which repeats
  both.key(QEvent::KeyRelease, Qt::Key_Space, " ", "space", true);
  both.key(QEvent::KeyPress, Qt::Key_Space, " ", "space", true);
  both.key(QEvent::KeyPress, Qt::Key_Left, {}, "Left"); // the camera turns, the tool follows
  EXPECT_GT(std::abs(both.camera().position.x()), 10.0);
  both.leave();
  both.key(QEvent::KeyPress, Qt::Key_Space, " ", "space", true);
  both.key(QEvent::KeyRelease, Qt::Key_Space, " ", "space");
  EXPECT_EQ(both.strokes(), 3);

  const auto before = both.camera(); // right drag; with Shift it pans
  both.button(QEvent::MouseButtonPress, Qt::RightButton, vtkCommand::RightButtonPressEvent, 100,
              90);
  both.move(140, 110, Qt::RightButton);
  both.move(150, 100, Qt::RightButton, Qt::ShiftModifier);
  both.button(QEvent::MouseButtonRelease, Qt::RightButton, vtkCommand::RightButtonReleaseEvent, 150,
              100);
  EXPECT_GT((both.camera().position - before.position).norm(), 10.0);
  EXPECT_GT((both.camera().focalPoint - before.focalPoint).norm(), 1.0);
  both.wheel(1.5, 180, 140);
  both.wheel(-1.5, 180, 140);

  both.move(180, 140); // 4: a double click presses twice
  both.press(180, 140);
  both.release(180, 140);
  both.button(QEvent::MouseButtonDblClick, Qt::LeftButton, vtkCommand::LeftButtonDoubleClickEvent,
              180, 140);
  both.loseFocus();
  EXPECT_EQ(both.strokes(), 5);
  both.release(180, 140);

  both.key(QEvent::KeyPress, Qt::Key_X, "x", "x"); // the clutch holds the tool still
  both.move(150, 150);
  both.key(QEvent::KeyRelease, Qt::Key_X, "x", "x");

  both.depthByWheel();
  both.move(170, 145);
  both.wheel(9.0, 170, 145);
  both.wheel(0.25, 170, 145, Qt::ShiftModifier);
  both.press(170, 145);
  both.wheel(4.0, 170, 145);
  both.release(170, 145);
  EXPECT_EQ(both.strokes(), 6);
  const auto distance = (both.camera().position - both.camera().focalPoint).norm();
  both.wheel(2.0, 170, 145, Qt::ControlModifier);
  EXPECT_NEAR((both.camera().position - both.camera().focalPoint).norm(), distance / (1.15 * 1.15),
              1e-6);
}

TEST_F(Pointer, ReadsAtItsTipWhatTheCommandReadsThere)
{
  saveBall("ball");
  openWindow();
  QTest::keyClick(&view(), Qt::Key_P);
  EXPECT_TRUE(action("Pointer")->isChecked());
  for (const QPoint aside : {QPoint(0, 0), QPoint(60, -40), QPoint(-90, 30)})
  {
    pointAt(view().rect().center() + aside);
    ASSERT_TRUE(hasTool());
    ASSERT_TRUE(waitFor([this] { return view().display().reading().contains(" to nerve"); }));
    Vector3d there = tip();
    const auto isAtRest = [&]
    {
      there = tip();
      QTest::qWait(500);
      return tip() == there;
    };
    ASSERT_TRUE(waitFor(isAtRest));
    const QJsonObject truth = probed(there);
    ASSERT_TRUE(truth.contains("hu"));
    const QString surface =
        QString("%1 mm to the surface").arg(truth["distance_mm"].toDouble(), 0, 'f', 1);
    EXPECT_TRUE(waitFor([&] { return view().display().reading().contains(surface); }));
    const QStringList read = view().display().reading().split('\n');
    EXPECT_EQ(read.front(), QString("%1 HU").arg(std::lround(truth["hu"].toDouble())));
    ASSERT_EQ(read.size(), 3);
    EXPECT_TRUE(read[2].endsWith(" mm to nerve")) << read[2].toStdString();
    EXPECT_NEAR(read[2].split(' ').front().toDouble(), (tip() - kBallCenter).norm() - 4.0, 0.3);
    EXPECT_EQ(read[1], surface);
    EXPECT_LT(std::abs(truth["distance_mm"].toDouble()), 0.5) << "it touches";
  }
  picture();
}

TEST_F(Pointer, ModelAndCommandAgreeAtAnyPlace)
{
  saveBall("ball");
  openWindow();
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  for (const Vector3d& offset :
       {Vector3d(0.0, 0.0, 0.0), Vector3d(3.0, 1.0, -2.0), Vector3d(6.0, -7.0, 2.0),
        Vector3d(10.0, 9.0, -3.0), Vector3d(200.0, 0.0, 0.0)})
  {
    const Vector3d place = kBallCenter + offset;
    const presenters::PlaceReading reading = model.readPlace(place);
    const QJsonObject truth = probed(place);
    EXPECT_EQ(reading.structure, truth["structure"].toString().toStdString());
    ASSERT_EQ(reading.hounsfield.has_value(), truth["hu"].isDouble()) << offset.transpose();
    if (reading.hounsfield)
    {
      EXPECT_NEAR(*reading.hounsfield, truth["hu"].toDouble(), 1e-6);
    }
    ASSERT_EQ(reading.surface.has_value(), truth["distance_mm"].isDouble()) << offset.transpose();
    if (reading.surface)
    {
      EXPECT_NEAR(*reading.surface, truth["distance_mm"].toDouble(), 1e-9);
      EXPECT_NEAR(*reading.surface, offset.norm() - kBallRadius, 0.1); // the sphere itself
    }
  }
  EXPECT_EQ(model.readPlace(kBallCenter).structure, "nerve");
  // A ball as well, measured in another thread.
  presenters::PlaceReading beside;
  ASSERT_TRUE(waitFor(
      [&]
      {
        beside = model.readPlace(kBallCenter + Vector3d(6.0, 0.0, 0.0));
        EXPECT_TRUE(beside.isNearKnown || !beside.near);
        return beside.isNearKnown;
      }));
  ASSERT_TRUE(beside.near);
  EXPECT_EQ(beside.near->name, "nerve");
  EXPECT_NEAR(beside.near->distance, 2.0, 0.2);
}

TEST_F(Pointer, CutsNothingWhateverAsksForTheDrill)
{
  saveBall("ball");
  bench.play(std::string(kPlugFoot) + kPlugCap);
  openWindow();
  choose("SpaceMouse Compact");
  QTest::keyClick(&view(), Qt::Key_P);
  ASSERT_TRUE(hasTool());
  bench.play("await foot\nreport foot 02 00\n");
  QTest::keyPress(&view(), Qt::Key_Space);
  const Vector3d begin = tool();
  ASSERT_TRUE(holdCapUntil(capHeld(0, -350, 0, 1),
                           [&] { return (tool() - kBallCenter).norm() < kBallRadius + 0.7; }));
  for (int n = 0; n < 8; ++n)
  {
    bench.play(capHeld(0, -350, 0, 1));
    QTest::qWait(110);
  }
  EXPECT_NE(begin, tool());
  QTest::keyRelease(&view(), Qt::Key_Space);
  QTest::keyClick(&view(), Qt::Key_P);
  EXPECT_TRUE(window().model().value().dissection.mask().untouched());
  EXPECT_TRUE(window().model().value().dissection.strokes().empty());
  EXPECT_TRUE(view().display().reading().isEmpty());
}

TEST_F(Pointer, OneToolIsInTheHand)
{
  saveBall("ball");
  openWindow();
  QTest::keyClick(&view(), Qt::Key_P);
  QTest::keyClick(&view(), Qt::Key_D);
  EXPECT_TRUE(action("Drill")->isChecked());
  EXPECT_FALSE(action("Pointer")->isChecked());
  QTest::keyClick(&view(), Qt::Key_P);
  EXPECT_FALSE(action("Drill")->isChecked());
  EXPECT_TRUE(action("Pointer")->isChecked());
  // The left button rotates the patient, as without a tool.
  const auto before = view().picture().camera().position;
  const QPoint middle = view().rect().center();
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  QMouseEvent move(QEvent::MouseMove, middle + QPoint(40, 0), Qt::LeftButton, Qt::LeftButton,
                   Qt::NoModifier);
  QApplication::sendEvent(&view(), &move);
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, middle + QPoint(40, 0));
  EXPECT_NE(view().picture().camera().position, before);
  EXPECT_TRUE(window().model().value().dissection.strokes().empty());
}
