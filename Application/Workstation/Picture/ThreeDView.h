#pragma once

#include <array>
#include <memory>
#include <optional>

#include <QVTKOpenGLNativeWidget.h>
#include <vtkNew.h>

#include "SceneDisplay.h"
#include "petrous/Interaction/PickRay.h"
#include "petrous/Interaction/ToolInteraction.h"

class vtkGenericOpenGLRenderWindow;
class vtkPetrousCameraStyle;
class QLabel;

namespace petrous::workstation
{

/// 3D view of the scene. What pointer and keys do is Interaction's: Qt's events go to the VTK
/// interactor, with the tool (vtkPetrousToolInteraction) and the camera (vtkPetrousCameraStyle) on
/// it; the clutch key is X.
class ThreeDView : public QVTKOpenGLNativeWidget
{
  Q_OBJECT
public:
  explicit ThreeDView(QWidget* parent = nullptr);
  ~ThreeDView() override;

  SceneDisplay& display() noexcept { return *m_display; }
  rendering::ScenePicture& picture() noexcept { return m_display->picture(); }
  vtkPetrousToolInteraction& tool() noexcept { return *m_tool; }
  void setCamera(const core::CameraPose& pose);
  void setWheelPresses(bool presses) { m_wheelPresses = presses; } ///< see thrustTurned

  /// Whose case it is, in the upper right corner; not in stereo, where it would float.
  void setStamp(const QString& text);
  const QString& stamp() const noexcept { return m_stampText; }

  /// What must be known of the picture, a line each, in the upper left corner.
  void setNotes(const QStringList& lines);
  const QStringList& notes() const noexcept { return m_noteLines; }

  /// Pixels from the upper edge that are covered: what stands there is placed below.
  void setCovered(int pixels);

  /// Pick ray through the pixel at a position in the widget; side by side, of the eye whose half
  /// contains it. None: through the centre of the view.
  interaction::PickRay sightLine(const std::optional<QPointF>& position) const;

signals:
  void pointed(const petrous::interaction::PickRay& line); ///< moved with no button pressed
  void pointerLeft();
  void picked(const petrous::interaction::PickRay& line); ///< clicked, without a tool that drills
  void enlargeAsked();                                    ///< double click
  /// The wheel was turned while the tool drills, unless it moves the tool in depth.
  void thrustTurned(double notches);
  /// Alt and the wheel while the mouse leads the tool, degrees; with Shift it tilts.
  void handpieceTurned(double turn, double tilt);
  void drillPressed(); ///< before the tool is pressed
  void toolModeSet();  ///< drills, probes, or neither
  void cameraMoved(const petrous::core::CameraPose& pose);
  void stampChanged(const QString& text);
  void notesChanged(const QStringList& lines);

protected:
  bool event(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

private:
  void observe();
  bool handleCamera(vtkObject*, unsigned long, void*);
  void handleTool(vtkObject*, unsigned long event, void*);
  std::array<int, 2> pixelAt(const QPointF& position) const;
  void sendMouse(const QMouseEvent& event);
  void followClick(const QMouseEvent& event);
  void sendWheel(const QWheelEvent& event);
  void placeLetters();
  void followBackground();
  void placeStamp();
  void placeNotes();
  void placeFocusFrame();
  void showFocusFrame();

  vtkNew<vtkGenericOpenGLRenderWindow> m_window;
  std::unique_ptr<SceneDisplay> m_display;
  vtkNew<vtkPetrousCameraStyle> m_style;
  vtkNew<vtkPetrousToolInteraction> m_tool;
  std::array<QLabel*, 4> m_letters; // left, right, top, bottom
  QLabel* m_stamp;
  bool m_wheelPresses = false;
  QString m_stampText;              // whole
  std::optional<QPointF> m_clicked; // where the left button went down, until the pointer leaves
  QLabel* m_notes;
  QWidget* m_focusFrame; // while the keyboard focus is here and came by Tab; not in stereo
  bool m_isFocused = false;
  bool m_cameByTab = false; // the focus, also while another window or a menu has it
  QStringList m_noteLines;
  int m_covered = 0;        // px, from the upper edge
  bool m_isOnLight = false; // letters, by the background
};

} // namespace petrous::workstation
