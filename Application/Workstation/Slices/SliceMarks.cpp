#include "SliceMarks.h"

#include <algorithm>
#include <cmath>

#include <QPainter>
#include <QPainterPath>

namespace petrous::workstation
{

namespace
{
constexpr double kReach = 1.0; // mm from the slice
constexpr double kMark = 5.0;  // pixels
constexpr double kFaded = 4.0; // mm from the slice, where a curve is not seen any more
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
  const Eigen::Vector3d next = slice.axes().next;
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

void paintCurve(QPainter& painter, const std::vector<Eigen::Vector3d>& points, const QColor& color,
                const presenters::SliceGeometry& slice, const Eigen::Vector3d& at)
{
  const Eigen::Vector3d next = slice.axes().next;
  const auto pixelOf = [&slice](const Eigen::Vector3d& point)
  {
    const Eigen::Vector2d pixel = slice.pixelFromPatient(point) + Eigen::Vector2d(0.5, 0.5);
    return QPointF(pixel[0], pixel[1]);
  };
  for (std::size_t n = 1; n < points.size(); ++n)
  {
    const double off = std::abs(next.dot(0.5 * (points[n - 1] + points[n]) - at));
    const double seen = std::clamp((kFaded - off) / (kFaded - kReach), 0.0, 1.0);
    if (seen <= 0.0)
      continue;
    QColor dark(0, 0, 0);
    QColor bright(color);
    dark.setAlphaF(0.7 * seen);
    bright.setAlphaF(seen);
    for (const auto& pen : {QPen(dark, 3.0, Qt::SolidLine, Qt::FlatCap),
                            QPen(bright, 1.5, Qt::SolidLine, Qt::FlatCap)})
    {
      painter.setPen(pen);
      painter.drawLine(pixelOf(points[n - 1]), pixelOf(points[n]));
    }
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
