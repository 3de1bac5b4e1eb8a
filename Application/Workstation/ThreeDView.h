#pragma once

#include <array>
#include <memory>

#include <QTimer>

#include <QVTKOpenGLNativeWidget.h>
#include <vtkNew.h>

#include "petrous/Presenters/PointerDrill.h"
#include "petrous/Rendering/ScenePicture.h"

class vtkGenericOpenGLRenderWindow;
class QLabel;
class vtkRenderer;

namespace petrous::workstation
{

/// The scene in 3D, turned and zoomed by mouse and keys; tells where the pointer looks.
///
/// Left drag turns, or drills in drill mode; right and middle drag turn, with Shift they move.
class ThreeDView : public QVTKOpenGLNativeWidget
{
  Q_OBJECT
public:
  explicit ThreeDView(QWidget* parent = nullptr);
  ~ThreeDView() override;

  rendering::ScenePicture& picture() noexcept { return *m_picture; }
  void setDrillMode(bool on);
  bool drilling() const noexcept { return m_drilling; }

  /// Draws soon; several calls make one picture. `moving`: coarser until 300 ms after the last one.
  void redraw(bool moving = false);
  void setCamera(const core::CameraPose& pose);

  presenters::SightLine sightLine(const QPointF& position) const;
  Eigen::Vector3d axisToHand() const; ///< how a right hand holds the drill, patient LPS

signals:
  void pointed(const petrous::presenters::SightLine& line); ///< moved with no button down
  void pointerLeft();
  void picked(const petrous::presenters::SightLine& line); ///< double click
  void drillPressed(const petrous::presenters::SightLine& line);
  void drillHeld(const petrous::presenters::SightLine& line); ///< at each tick while it is on
  void drillReleased();

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
  void startDrilling(const QPointF& position);
  void stopDrilling();
  void placeLetters();

  vtkNew<vtkGenericOpenGLRenderWindow> m_window;
  vtkNew<vtkRenderer> m_renderer;
  std::unique_ptr<rendering::ScenePicture> m_picture;
  std::array<QLabel*, 4> m_letters; // left, right, top, bottom
  QTimer m_tick;                    // while drilling
  QTimer m_settle;                  // back to the fine picture
  QPointF m_pointer{-1.0, -1.0};
  QPointF m_dragged;
  bool m_drillMode = false;
  bool m_drilling = false;
  bool m_turning = false;
  bool m_redrawPending = false;
};

} // namespace petrous::workstation
