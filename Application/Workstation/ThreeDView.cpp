#include "ThreeDView.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include "petrous/Presenters/OrbitCamera.h"
#include "petrous/Rendering/ReferenceRayCaster.h"

namespace petrous::workstation
{

namespace
{
constexpr int kTick = 16;    // ms
constexpr int kSettle = 300; // ms
constexpr double kDegreesPerPixel = 0.4;
constexpr double kDegreesPerKey = 7.5;
constexpr double kZoomPerNotch = 1.15;
} // namespace

ThreeDView::ThreeDView(QWidget* parent)
  : QVTKOpenGLNativeWidget(parent)
  , m_picture(std::make_unique<rendering::ScenePicture>())
{
  setObjectName("threeDView");
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setMinimumSize(240, 240);
  m_window->SetMultiSamples(0);
  m_window->AddRenderer(m_renderer);
  setRenderWindow(m_window);
  // The view turns the camera itself; the interactor only exists because the widget makes one.
  m_window->GetInteractor()->SetInteractorStyle(nullptr);
  m_picture->attach(m_renderer);

  for (QLabel*& letter : m_letters)
  {
    letter = new QLabel(this);
    letter->setObjectName("direction");
    letter->setAttribute(Qt::WA_TransparentForMouseEvents);
  }
  m_tick.setInterval(kTick);
  connect(&m_tick, &QTimer::timeout, this, [this] { emit drillHeld(sightLine(m_pointer)); });
  m_settle.setSingleShot(true);
  m_settle.setInterval(kSettle);
  connect(&m_settle, &QTimer::timeout, this,
          [this]
          {
            m_picture->setInteractive(false);
            redraw();
          });
}

ThreeDView::~ThreeDView()
{
  makeCurrent();
  m_picture->attach(nullptr);
  doneCurrent();
}

void ThreeDView::setDrillMode(bool on)
{
  if (!on)
    stopDrilling();
  m_drillMode = on;
  setCursor(on ? Qt::CrossCursor : Qt::ArrowCursor);
}

void ThreeDView::redraw(bool moving)
{
  if (moving)
  {
    m_picture->setInteractive(true);
    m_settle.start();
  }
  if (m_redrawPending)
    return;
  m_redrawPending = true;
  QTimer::singleShot(0, this,
                     [this]
                     {
                       m_redrawPending = false;
                       if (!isVisible())
                         return;
                       placeLetters();
                       m_window->Render();
                     });
}

void ThreeDView::placeLetters()
{
  constexpr int margin = 10;
  const auto edges = presenters::edgeDirections(m_picture->camera());
  const std::string* const texts[] = {&edges.left, &edges.right, &edges.top, &edges.bottom};
  for (std::size_t n = 0; n < m_letters.size(); ++n)
  {
    m_letters[n]->setText(QString::fromStdString(*texts[n]));
    m_letters[n]->adjustSize();
  }
  const auto middle = [](int whole, int part) { return (whole - part) / 2; };
  const auto put = [this](std::size_t n, int x, int y) { m_letters[n]->move(x, y); };
  const int across = width();
  const int down = height();
  put(0, margin, middle(down, m_letters[0]->height()));
  put(1, across - margin - m_letters[1]->width(), middle(down, m_letters[1]->height()));
  put(2, middle(across, m_letters[2]->width()), margin);
  put(3, middle(across, m_letters[3]->width()), down - margin - m_letters[3]->height());
}

void ThreeDView::resizeEvent(QResizeEvent* event)
{
  QVTKOpenGLNativeWidget::resizeEvent(event);
  placeLetters();
}

void ThreeDView::setCamera(const core::CameraPose& pose)
{
  m_picture->setCamera(pose);
  redraw(true);
}

presenters::SightLine ThreeDView::sightLine(const QPointF& position) const
{
  const rendering::PixelRays rays(m_picture->camera(), std::max(width(), 1), std::max(height(), 1));
  const bool inside = position.x() >= 0.0 && position.y() >= 0.0;
  // A Qt position counts from the corner of the first pixel; a ray from its centre.
  const auto ray = inside ? rays.through(position.x() - 0.5, position.y() - 0.5)
                          : rays.through(0.5 * (width() - 1), 0.5 * (height() - 1));
  return {ray.origin, ray.direction};
}

Eigen::Vector3d ThreeDView::axisToHand() const
{
  const core::CameraPose camera = m_picture->camera();
  const Eigen::Vector3d forward = (camera.focalPoint - camera.position).normalized();
  const Eigen::Vector3d right = forward.cross(camera.viewUp).normalized();
  const Eigen::Vector3d up = right.cross(forward);
  return (-0.62 * forward + 0.62 * right - 0.48 * up).normalized();
}

void ThreeDView::startDrilling(const QPointF& position)
{
  if (m_drilling)
    return;
  m_pointer = position;
  m_drilling = true;
  emit drillPressed(sightLine(position));
  m_tick.start();
}

void ThreeDView::stopDrilling()
{
  if (!m_drilling)
    return;
  m_tick.stop();
  emit drillHeld(sightLine(m_pointer)); // the way since the last tick was still drilled
  m_drilling = false;
  emit drillReleased();
}

void ThreeDView::mousePressEvent(QMouseEvent* event)
{
  setFocus(Qt::MouseFocusReason);
  if (event->button() == Qt::LeftButton && m_drillMode)
    startDrilling(event->localPos());
  else if (!m_drilling)
    m_turning = true;
  m_dragged = event->localPos();
}

void ThreeDView::mouseMoveEvent(QMouseEvent* event)
{
  m_pointer = event->localPos();
  if (m_drilling)
    return; // the tick follows
  if (!m_turning)
  {
    emit pointed(sightLine(m_pointer));
    return;
  }
  const QPointF step = m_pointer - m_dragged;
  m_dragged = m_pointer;
  const core::CameraPose camera = m_picture->camera();
  if (event->modifiers() & Qt::ShiftModifier)
    setCamera(presenters::shifted(camera, step.x() / height(), step.y() / height()));
  else
    setCamera(presenters::turned(camera, kDegreesPerPixel * step.x(), kDegreesPerPixel * step.y()));
}

void ThreeDView::mouseReleaseEvent(QMouseEvent* event)
{
  if (m_drilling && event->button() == Qt::LeftButton)
  {
    m_pointer = event->localPos();
    stopDrilling();
  }
  m_turning = m_turning && event->buttons() != Qt::NoButton;
}

void ThreeDView::mouseDoubleClickEvent(QMouseEvent* event)
{
  if (event->button() == Qt::LeftButton && !m_drillMode)
    emit picked(sightLine(event->localPos()));
  else
    mousePressEvent(event);
}

void ThreeDView::wheelEvent(QWheelEvent* event)
{
  const double notches = event->angleDelta().y() / 120.0;
  setCamera(presenters::zoomed(m_picture->camera(), std::pow(kZoomPerNotch, notches)));
  event->accept();
}

void ThreeDView::keyPressEvent(QKeyEvent* event)
{
  const core::CameraPose camera = m_picture->camera();
  switch (event->key())
  {
  case Qt::Key_Left:
    return setCamera(presenters::turned(camera, -kDegreesPerKey, 0.0));
  case Qt::Key_Right:
    return setCamera(presenters::turned(camera, kDegreesPerKey, 0.0));
  case Qt::Key_Up:
    return setCamera(presenters::turned(camera, 0.0, -kDegreesPerKey));
  case Qt::Key_Down:
    return setCamera(presenters::turned(camera, 0.0, kDegreesPerKey));
  case Qt::Key_Plus:
  case Qt::Key_Equal:
    return setCamera(presenters::zoomed(camera, kZoomPerNotch));
  case Qt::Key_Minus:
    return setCamera(presenters::zoomed(camera, 1.0 / kZoomPerNotch));
  case Qt::Key_Space:
    if (m_drillMode && !event->isAutoRepeat())
      startDrilling(m_pointer);
    return;
  default:
    QVTKOpenGLNativeWidget::keyPressEvent(event);
  }
}

void ThreeDView::keyReleaseEvent(QKeyEvent* event)
{
  if (event->key() == Qt::Key_Space && !event->isAutoRepeat())
    stopDrilling();
  else
    QVTKOpenGLNativeWidget::keyReleaseEvent(event);
}

void ThreeDView::focusOutEvent(QFocusEvent* event)
{
  stopDrilling(); // a release that another window gets would leave the drill on
  QVTKOpenGLNativeWidget::focusOutEvent(event);
}

void ThreeDView::leaveEvent(QEvent* event)
{
  if (!m_drilling)
  {
    m_pointer = {-1.0, -1.0};
    emit pointerLeft();
  }
  QVTKOpenGLNativeWidget::leaveEvent(event);
}

} // namespace petrous::workstation
