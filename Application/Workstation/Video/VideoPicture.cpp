#include "VideoPicture.h"

#include <algorithm>
#include <cmath>

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include "Theme.h"

namespace petrous::workstation
{

namespace
{

constexpr double kMostZoom = 32.0;
constexpr double kClickMoves = 4.0; // px, that a click may move
constexpr double kNotch = 1.25;
constexpr int kArm = 7; // px, of a cross

bool isOfCross(int key)
{
  switch (key)
  {
  case Qt::Key_Left:
  case Qt::Key_Right:
  case Qt::Key_Up:
  case Qt::Key_Down:
  case Qt::Key_Return:
  case Qt::Key_Enter:
  case Qt::Key_Plus:
  case Qt::Key_Minus:
    return true;
  default:
    return false;
  }
}

} // namespace

VideoPicture::VideoPicture(QWidget* parent)
  : QWidget(parent)
{
  setObjectName("videoPicture");
  setAccessibleName(tr("Video"));
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(160, 90);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding); // it shrinks first
}

QSize VideoPicture::sizeHint() const
{
  const double ratio =
      m_frame.isNull() ? 9.0 / 16.0 : static_cast<double>(m_frame.height()) / m_frame.width();
  return {420, static_cast<int>(420 * std::min(ratio, 1.0))};
}

void VideoPicture::setFrame(const QImage& frame)
{
  const bool isOther = frame.size() != m_frame.size();
  m_frame = frame;
  if (isOther)
  {
    m_zoom = 1.0;
    m_cross.reset();
    m_middle = 0.5 * Eigen::Vector2d(frame.width(), frame.height());
    updateGeometry();
  }
  update();
}

void VideoPicture::setText(const QString& text)
{
  m_text = text;
  update();
}

void VideoPicture::setMarks(const std::vector<StillMark>& marks,
                            std::optional<Eigen::Vector2d> next)
{
  m_marks = marks;
  m_next = next;
  update();
}

double VideoPicture::scale() const
{
  return m_zoom * std::min(static_cast<double>(width()) / std::max(m_frame.width(), 1),
                           static_cast<double>(height()) / std::max(m_frame.height(), 1));
}

QPointF VideoPicture::place(const Eigen::Vector2d& pixel) const
{
  const Eigen::Vector2d from = scale() * (pixel - m_middle);
  return {0.5 * width() + from.x(), 0.5 * height() + from.y()};
}

Eigen::Vector2d VideoPicture::pixelAt(const QPointF& position) const
{
  return m_middle + Eigen::Vector2d(position.x() - 0.5 * width(), position.y() - 0.5 * height()) /
                        std::max(scale(), 1e-9);
}

void VideoPicture::magnify(double factor, const QPointF& around)
{
  const Eigen::Vector2d there = pixelAt(around);
  m_zoom = std::clamp(m_zoom * factor, 1.0, kMostZoom);
  m_middle += there - pixelAt(around);
  keepInside();
}

void VideoPicture::keepInside()
{
  const Eigen::Vector2d size(m_frame.width(), m_frame.height());
  const Eigen::Vector2d half = 0.5 * Eigen::Vector2d(width(), height()) / std::max(scale(), 1e-9);
  for (int n = 0; n < 2; ++n)
    m_middle[n] = half[n] >= 0.5 * size[n] ? 0.5 * size[n]
                                           : std::clamp(m_middle[n], half[n], size[n] - half[n]);
  update();
}

bool VideoPicture::event(QEvent* event)
{
  if (event->type() == QEvent::ShortcutOverride && !m_frame.isNull() &&
      isOfCross(static_cast<QKeyEvent*>(event)->key()) &&
      !(static_cast<QKeyEvent*>(event)->modifiers() & (Qt::ControlModifier | Qt::AltModifier)))
  {
    event->accept();
    return true;
  }
  return QWidget::event(event);
}

void VideoPicture::paintEvent(QPaintEvent* /*event*/)
{
  QPainter painter(this);
  painter.fillRect(rect(), QColor(12, 14, 16));
  if (m_frame.isNull())
  {
    painter.setPen(QColor(190, 190, 190));
    painter.drawText(rect().adjusted(12, 8, -12, -8), Qt::AlignCenter | Qt::TextWordWrap, m_text);
    return;
  }
  painter.setRenderHint(QPainter::SmoothPixmapTransform, scale() < 3.0);
  painter.drawImage(
      QRectF(place({0.0, 0.0}), place({1.0 * m_frame.width(), 1.0 * m_frame.height()})), m_frame);
  painter.setRenderHint(QPainter::Antialiasing);
  const auto cross = [&painter](const QPointF& at, const QColor& color)
  {
    for (const auto& [pen, width] : {std::pair(QColor(0, 0, 0, 190), 4.0), {color, 2.0}})
    {
      painter.setPen(QPen(pen, width));
      painter.drawLine(at - QPointF(kArm, 0), at + QPointF(kArm, 0));
      painter.drawLine(at - QPointF(0, kArm), at + QPointF(0, kArm));
    }
  };
  for (std::size_t n = 0; n < m_marks.size(); ++n)
  {
    const StillMark& mark = m_marks[n];
    const QColor color = mark.isBad ? warningColor() : QColor(90, 220, 130);
    const QPointF at = place(mark.at);
    if (mark.seenAt)
    {
      painter.setPen(QPen(color, 1.5));
      painter.drawLine(at, place(*mark.seenAt));
    }
    cross(at, color);
    painter.drawText(at + QPointF(kArm + 2, -kArm), QString::number(n + 1));
  }
  if (m_next)
    cross(place(*m_next), QColor(255, 214, 80));
  if (m_cross && hasFocus())
    cross(place(*m_cross), QColor(120, 190, 255));
  if (hasFocus())
  {
    painter.setRenderHint(QPainter::Antialiasing, false);
    painter.setPen(QColor(120, 190, 255));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(rect().adjusted(0, 0, -1, -1));
  }
}

void VideoPicture::mousePressEvent(QMouseEvent* event)
{
  m_pressed = event->localPos();
  m_isClick = event->button() == Qt::LeftButton;
}

void VideoPicture::mouseMoveEvent(QMouseEvent* event)
{
  const QPointF moved = event->localPos() - m_pressed;
  if (std::hypot(moved.x(), moved.y()) > kClickMoves)
    m_isClick = false;
  if (!(event->buttons() & (Qt::RightButton | Qt::MiddleButton)))
    return;
  m_middle -= Eigen::Vector2d(moved.x(), moved.y()) / std::max(scale(), 1e-9);
  m_pressed = event->localPos();
  keepInside();
}

void VideoPicture::mouseReleaseEvent(QMouseEvent* event)
{
  if (!m_isClick || event->button() != Qt::LeftButton || m_frame.isNull())
    return;
  m_isClick = false;
  const Eigen::Vector2d pixel = pixelAt(event->localPos());
  if (pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() <= m_frame.width() &&
      pixel.y() <= m_frame.height())
    emit pointed(pixel);
}

void VideoPicture::wheelEvent(QWheelEvent* event)
{
  if (m_frame.isNull())
    return event->ignore();
  magnify(std::pow(kNotch, event->angleDelta().y() / 120.0), event->position());
  event->accept();
}

void VideoPicture::keyPressEvent(QKeyEvent* event)
{
  if (m_frame.isNull() || !isOfCross(event->key()) ||
      (event->modifiers() & (Qt::ControlModifier | Qt::AltModifier)))
    return QWidget::keyPressEvent(event);
  if (!m_cross)
    m_cross = m_next.value_or(m_middle);
  const double step = event->modifiers() & Qt::ShiftModifier ? 10.0 : 1.0;
  switch (event->key())
  {
  case Qt::Key_Left:
    m_cross->x() -= step;
    break;
  case Qt::Key_Right:
    m_cross->x() += step;
    break;
  case Qt::Key_Up:
    m_cross->y() -= step;
    break;
  case Qt::Key_Down:
    m_cross->y() += step;
    break;
  case Qt::Key_Plus:
    magnify(kNotch, place(*m_cross));
    break;
  case Qt::Key_Minus:
    magnify(1.0 / kNotch, place(*m_cross));
    break;
  default:
    emit pointed(*m_cross);
    break;
  }
  m_cross->x() = std::clamp(m_cross->x(), 0.0, 1.0 * m_frame.width());
  m_cross->y() = std::clamp(m_cross->y(), 0.0, 1.0 * m_frame.height());
  update();
}

} // namespace petrous::workstation
