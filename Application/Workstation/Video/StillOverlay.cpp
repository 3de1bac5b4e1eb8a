#include "StillOverlay.h"

#include <utility>

#include <QEvent>
#include <QPainter>

#include <Eigen/Geometry>

#include "ThreeDView.h"

namespace petrous::workstation
{

namespace
{

// As far as a picture shows.
bool isSameView(const core::CameraPose& a, const core::CameraPose& b)
{
  constexpr double kDirection = 1e-5, kPlace = 1e-3;
  const auto axes = [](const core::CameraPose& c)
  {
    const Eigen::Vector3d into = (c.focalPoint - c.position).normalized();
    const Eigen::Vector3d right = into.cross(c.viewUp).normalized();
    return std::pair(into, right);
  };
  const auto [intoA, rightA] = axes(a);
  const auto [intoB, rightB] = axes(b);
  return (a.position - b.position).norm() < kPlace && (intoA - intoB).norm() < kDirection &&
         (rightA - rightB).norm() < kDirection && std::abs(a.viewAngle - b.viewAngle) < kPlace &&
         !a.parallelScale && !b.parallelScale;
}

} // namespace

StillOverlay::StillOverlay(ThreeDView& view)
  : QWidget(&view)
  , m_view(view)
{
  setObjectName("stillOverlay");
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setFocusPolicy(Qt::NoFocus);
  hide();
  view.installEventFilter(this);
  connect(&view, &ThreeDView::cameraMoved, this, &StillOverlay::follow);
}

void StillOverlay::setStill(const QImage& still, const std::optional<core::CameraPose>& camera,
                            double opacity)
{
  m_still = still;
  m_camera = camera;
  m_opacity = opacity;
  follow();
  update();
}

void StillOverlay::follow()
{
  const bool isOver = m_camera && !m_still.isNull() &&
                      m_view.display().stereo() == rendering::StereoMode::None &&
                      isSameView(*m_camera, m_view.picture().camera());
  if (isOver && !m_isOver)
  {
    setGeometry(m_view.rect());
    lower(); // below letters and stamp
  }
  setVisible(isOver);
  if (std::exchange(m_isOver, isOver) != isOver)
    emit overChanged();
}

bool StillOverlay::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() == QEvent::Resize)
    setGeometry(m_view.rect());
  return QWidget::eventFilter(watched, event);
}

void StillOverlay::paintEvent(QPaintEvent* /*event*/)
{
  QPainter painter(this);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  painter.setOpacity(m_opacity);
  const double wide = static_cast<double>(height()) * m_still.width() / m_still.height();
  painter.drawImage(QRectF(0.5 * (width() - wide), 0.0, wide, height()), m_still);
}

} // namespace petrous::workstation
