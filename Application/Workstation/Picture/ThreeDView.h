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

/// 3D view of the scene with mouse and keyboard camera control; reports pick rays.
///
/// Left drag rotates, or drills in drill mode if the mouse controls the tool; right and middle drag
/// rotate, with Shift they pan. The wheel zooms, or moves the burr in depth if so set; with Ctrl it
/// always zooms. Space drills and X is the clutch, while held. If the mouse controls the tool, the
/// drill stops when the pointer leaves the view by any edge; a button still held when it comes back
/// does not restart it.
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
  void setButtonDrills(bool on); ///< false: the left button rotates in drill mode, too
  bool buttonDrills() const noexcept { return m_buttonDrills; }
  void setPointing(bool on); ///< the pointer tool is in use: cross cursor
  bool pointing() const noexcept { return m_pointing; }
  bool drilling() const noexcept { return m_drilling; }
  void setCamera(const core::CameraPose& pose);

  /// Pick ray through a pixel; side by side, of the eye whose half contains it. None: through the
  /// centre of the view.
  interaction::PickRay sightLine(const std::optional<QPointF>& position) const;

  /// None if it is not in the view.
  const std::optional<QPointF>& pointer() const noexcept { return m_pointer; }

signals:
  void pointed(const petrous::interaction::PickRay& line); ///< moved with no button pressed
  void pointerLeft();
  void picked(const petrous::interaction::PickRay& line); ///< double click
  void drillPressed(const petrous::interaction::PickRay& line);
  void drillHeld(const petrous::interaction::PickRay& line); ///< at each tick while drilling
  void drillReleased();
  void clutchHeld(bool on);
  void drillModeSet(bool on);
  void buttonDrillsSet(bool on);
  void pointingSet(bool on);
  void wheelLeadsSet(bool on);
  void wheelLed(double notches, bool fine); ///< > 0: away from the camera
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
