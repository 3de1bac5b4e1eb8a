#pragma once

#include <array>
#include <memory>
#include <optional>

#include <QTimer>

#include <QVTKOpenGLNativeWidget.h>
#include <vtkNew.h>

#include "SceneDisplay.h"
#include "petrous/Interaction/PickRay.h"

class vtkGenericOpenGLRenderWindow;
class QLabel;

namespace petrous::workstation
{

/// The scene in 3D, turned and zoomed by mouse and keys; tells where the pointer looks.
///
/// Left drag turns, or drills in drill mode where the mouse leads the tool; right and middle drag
/// turn, with Shift they move. The wheel zooms, or leads the burr in depth where that is set; with
/// Ctrl it always zooms. Space drills and X is the clutch, while they are held. Where the mouse
/// leads the tool, the drill goes off when the pointer leaves the view, by whatever edge; a button
/// that is still held when it comes back does not put it on again.
class ThreeDView : public QVTKOpenGLNativeWidget
{
  Q_OBJECT
public:
  explicit ThreeDView(QWidget* parent = nullptr);
  ~ThreeDView() override;

  SceneDisplay& display() noexcept { return *m_display; }
  rendering::ScenePicture& picture() noexcept { return m_display->picture(); }
  void setDrillMode(bool on);
  bool drillMode() const noexcept { return m_drillMode; }
  void setWheelLeads(bool on); ///< in drill mode
  bool wheelLeads() const noexcept { return m_wheelLeads; }
  void setButtonDrills(bool on); ///< false: the left button turns in drill mode, too
  bool buttonDrills() const noexcept { return m_buttonDrills; }
  void setPointing(bool on); ///< a pointer is in the hand: the mouse shows as a cross
  bool pointing() const noexcept { return m_pointing; }
  bool drilling() const noexcept { return m_drilling; }
  void setCamera(const core::CameraPose& pose);

  /// Through a pixel; side by side, the ray of the eye whose half it lies in. Nothing: through the
  /// middle of the view.
  interaction::PickRay sightLine(const std::optional<QPointF>& position) const;

  /// Nothing: it is not in the view.
  const std::optional<QPointF>& pointer() const noexcept { return m_pointer; }

signals:
  void pointed(const petrous::interaction::PickRay& line); ///< moved with no button down
  void pointerLeft();
  void picked(const petrous::interaction::PickRay& line); ///< double click
  void drillPressed(const petrous::interaction::PickRay& line);
  void drillHeld(const petrous::interaction::PickRay& line); ///< at each tick while it is on
  void drillReleased();
  void clutchHeld(bool on);
  void drillModeSet(bool on);
  void buttonDrillsSet(bool on);
  void pointingSet(bool on);
  void wheelLeadsSet(bool on);
  void wheelLed(double notches, bool fine); ///< > 0: away from the eye
  void cameraMoved(const petrous::core::CameraPose& pose);

protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void keyReleaseEvent(QKeyEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

private:
  void startDrilling(const std::optional<QPointF>& position);
  void stopDrilling();
  void holdClutch(bool on);
  void showCursor();
  void placeLetters();

  vtkNew<vtkGenericOpenGLRenderWindow> m_window;
  std::unique_ptr<SceneDisplay> m_display;
  std::array<QLabel*, 4> m_letters; // left, right, top, bottom
  QTimer m_tick;                    // while drilling
  std::optional<QPointF> m_pointer;
  QPointF m_dragged;
  bool m_drillMode = false;
  bool m_wheelLeads = false;
  bool m_buttonDrills = true;
  bool m_pointing = false;
  bool m_clutch = false;
  bool m_drilling = false;
  bool m_turning = false;
};

} // namespace petrous::workstation
