#include "ThreeDView.h"

#include <algorithm>
#include <cmath>

#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include "petrous/Presenters/OrbitCamera.h"
#include "petrous/Rendering/PixelRays.h"

namespace petrous::workstation
{

namespace
{
constexpr int kTick = 16; // ms
constexpr double kDegreesPerPixel = 0.4;
constexpr double kDegreesPerKey = 7.5;
constexpr double kZoomPerNotch = 1.15;
} // namespace

ThreeDView::ThreeDView(QWidget* parent)
  : QVTKOpenGLNativeWidget(parent)
  , m_display(std::make_unique<SceneDisplay>(*m_window, [this] { return isVisible(); }))
{
  setObjectName("threeDView");
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setMinimumSize(240, 240);
  setRenderWindow(m_window);
  // The view controls the camera itself; the interactor only exists because the widget creates one.
  m_window->GetInteractor()->SetInteractorStyle(nullptr);
  connect(m_display.get(), &SceneDisplay::aboutToDraw, this, &ThreeDView::placeLetters);

  for (QLabel*& letter : m_letters)
  {
    letter = new QLabel(this);
    letter->setObjectName("direction");
    letter->setAttribute(Qt::WA_TransparentForMouseEvents);
  }
  m_tick.setInterval(kTick);
  connect(&m_tick, &QTimer::timeout, this, [this] { emit drillHeld(sightLine(m_pointer)); });
}

ThreeDView::~ThreeDView()
{
  makeCurrent();
  m_display->release();
  doneCurrent();
}

void ThreeDView::setDrillMode(bool on)
{
  if (!on)
    stopDrilling();
  m_drillMode = on;
  showCursor();
  emit drillModeSet(on);
}

void ThreeDView::setButtonDrills(bool on)
{
  m_buttonDrills = on;
  showCursor();
  emit buttonDrillsSet(on);
}

void ThreeDView::setPointing(bool on)
{
  m_pointing = on;
  showCursor();
  emit pointingSet(on);
}

void ThreeDView::showCursor()
{
  const bool leads = m_buttonDrills && (m_drillMode || m_pointing);
  setCursor(leads ? Qt::CrossCursor : Qt::ArrowCursor);
}

void ThreeDView::holdClutch(bool on)
{
  if (on == m_clutch)
    return;
  m_clutch = on;
  emit clutchHeld(on);
}

void ThreeDView::setWheelLeads(bool on)
{
  m_wheelLeads = on;
  emit wheelLeadsSet(on);
}

void ThreeDView::placeLetters()
{
  constexpr int margin = 10;
  // In stereo they would float in front of or behind the patient.
  const bool mono = m_display->stereo() == rendering::StereoMode::None;
  for (QLabel* letter : m_letters)
    letter->setVisible(mono);
  m_display->setFirstRow(mapToGlobal(QPoint(0, 0)).y());
  if (!mono)
    return;
  const auto edges = presenters::edgeDirections(picture().camera());
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
  m_display->setCamera(pose);
  emit cameraMoved(pose);
}

interaction::PickRay ThreeDView::sightLine(const std::optional<QPointF>& position) const
{
  core::CameraPose camera = m_display->picture().camera();
  int across = std::max(width(), 1);
  QPointF at = position.value_or(QPointF(0.5 * width(), 0.5 * height()));
  if (m_display->stereo() == rendering::StereoMode::SideBySide && position)
  {
    const auto eyes =
        rendering::eyesOf(camera, rendering::fittedStereoGeometry(camera, m_display->rig()));
    const int half = across / 2;
    const bool right = at.x() >= half;
    camera = right ? eyes.right : eyes.left;
    at.rx() -= right ? half : 0;
    across = std::max(across - half, 1);
  }
  // A Qt position is relative to the first pixel's corner; a ray's to its centre.
  const auto ray = rendering::PixelRays(camera, across, std::max(height(), 1))
                       .through(at.x() - 0.5, at.y() - 0.5);
  return {ray.origin, ray.direction};
}

void ThreeDView::startDrilling(const std::optional<QPointF>& position)
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
  emit drillHeld(sightLine(m_pointer)); // the path since the last tick was still drilled
  m_drilling = false;
  emit drillReleased();
}

void ThreeDView::mousePressEvent(QMouseEvent* event)
{
  setFocus(Qt::MouseFocusReason);
  if (event->button() == Qt::LeftButton && m_drillMode && m_buttonDrills)
    startDrilling(event->localPos());
  else if (!m_drilling || !m_buttonDrills)
    m_turning = true;
  m_dragged = event->localPos();
}

void ThreeDView::mouseMoveEvent(QMouseEvent* event)
{
  const QPointF at = event->localPos();
  if (!m_turning && !rect().contains(event->pos()))
  {
    if (m_buttonDrills)
      stopDrilling(); // beyond the edge the burr's target is invisible
    return;
  }
  m_pointer = at;
  if (m_drilling && m_buttonDrills)
    return; // handled by the tick
  if (!m_turning)
  {
    emit pointed(sightLine(m_pointer));
    return;
  }
  const QPointF step = at - m_dragged;
  m_dragged = at;
  const core::CameraPose camera = m_display->picture().camera();
  if (event->modifiers() & Qt::ShiftModifier)
    setCamera(presenters::shifted(camera, step.x() / height(), step.y() / height()));
  else
    setCamera(presenters::turned(camera, kDegreesPerPixel * step.x(), kDegreesPerPixel * step.y()));
}

void ThreeDView::mouseReleaseEvent(QMouseEvent* event)
{
  if (m_drilling && m_buttonDrills && event->button() == Qt::LeftButton)
  {
    if (rect().contains(event->pos()))
      m_pointer = event->localPos();
    stopDrilling();
  }
  m_turning = m_turning && event->buttons() != Qt::NoButton;
}

void ThreeDView::mouseDoubleClickEvent(QMouseEvent* event)
{
  if (event->button() == Qt::LeftButton && !(m_drillMode && m_buttonDrills))
    emit picked(sightLine(event->localPos()));
  else
    mousePressEvent(event);
}

void ThreeDView::wheelEvent(QWheelEvent* event)
{
  // With Shift, some systems report horizontal scrolling.
  const QPoint delta = event->angleDelta();
  const double notches = (delta.y() != 0 ? delta.y() : delta.x()) / 120.0;
  event->accept();
  if (m_drillMode && m_wheelLeads && !(event->modifiers() & Qt::ControlModifier))
    return emit wheelLed(notches, event->modifiers() & Qt::ShiftModifier);
  setCamera(presenters::zoomed(m_display->picture().camera(), std::pow(kZoomPerNotch, notches)));
}

void ThreeDView::keyPressEvent(QKeyEvent* event)
{
  const core::CameraPose camera = m_display->picture().camera();
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
  case Qt::Key_X:
    if (!event->isAutoRepeat())
      holdClutch(true);
    return;
  default:
    QVTKOpenGLNativeWidget::keyPressEvent(event);
  }
}

void ThreeDView::keyReleaseEvent(QKeyEvent* event)
{
  if (event->key() == Qt::Key_Space && !event->isAutoRepeat())
    stopDrilling();
  else if (event->key() == Qt::Key_X && !event->isAutoRepeat())
    holdClutch(false);
  else
    QVTKOpenGLNativeWidget::keyReleaseEvent(event);
}

void ThreeDView::focusOutEvent(QFocusEvent* event)
{
  stopDrilling(); // a release event sent to another window would leave the drill on
  holdClutch(false);
  QVTKOpenGLNativeWidget::focusOutEvent(event);
}

void ThreeDView::leaveEvent(QEvent* event)
{
  if (m_buttonDrills)
    stopDrilling(); // if started by the key
  m_pointer.reset();
  emit pointerLeft();
  QVTKOpenGLNativeWidget::leaveEvent(event);
}

} // namespace petrous::workstation
