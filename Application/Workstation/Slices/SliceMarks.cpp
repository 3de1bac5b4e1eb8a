#include "SliceMarks.h"

#include <cmath>

#include <QPainter>
#include <QPainterPath>

namespace petrous::workstation
{

namespace
{
constexpr double kReach = 1.0; // mm from the slice
constexpr double kMark = 5.0;  // pixels
} // namespace

void drawText(QPainter& painter, const QPointF& baseline, const QString& text, const QColor& color)
{
  QPainterPath path;
  path.addText(baseline, painter.font(), text);
  painter.setPen(QPen(QColor(0, 0, 0, 200), 3.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.setBrush(Qt::NoBrush);
  painter.drawPath(path);
  painter.fillPath(path, color);
}

void paintMarks(QPainter& painter, const std::vector<SliceMark>& marks,
                const presenters::SliceGeometry& slice, const Eigen::Vector3d& at)
{
  const Eigen::Vector3d next = presenters::axesOf(slice.orientation()).next;
  for (const SliceMark& mark : marks)
  {
    if (std::abs(next.dot(mark.patient - at)) > kReach)
      continue;
    const Eigen::Vector2d pixel = slice.pixelFromPatient(mark.patient) + Eigen::Vector2d(0.5, 0.5);
    for (const auto& pen : {QPen(QColor(0, 0, 0, 200), 3.5), QPen(mark.color, 1.5)})
    {
      painter.setPen(pen);
      painter.drawLine(QPointF(pixel[0] - kMark, pixel[1]), QPointF(pixel[0] + kMark, pixel[1]));
      painter.drawLine(QPointF(pixel[0], pixel[1] - kMark), QPointF(pixel[0], pixel[1] + kMark));
    }
    drawText(painter, {pixel[0] + kMark, pixel[1] - kMark}, mark.name, mark.color);
  }
}

void paintCube(QPainter& painter, double edge, const presenters::SliceGeometry& slice,
               const Eigen::Vector3d& at)
{
  const Eigen::Vector2d pixel = slice.pixelFromPatient(at) + Eigen::Vector2d(0.5, 0.5);
  const double half = 0.5 * edge / slice.mmPerPixel();
  painter.setBrush(Qt::NoBrush);
  for (const auto& pen :
       {QPen(QColor(0, 0, 0, 200), 3.0), QPen(QColor("#f0a04d"), 1.5, Qt::DashLine)})
  {
    painter.setPen(pen);
    painter.drawRect(QRectF(pixel[0] - half, pixel[1] - half, 2.0 * half, 2.0 * half));
  }
}

} // namespace petrous::workstation
