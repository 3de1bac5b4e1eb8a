#include "SliceMarks.h"

#include <algorithm>
#include <cmath>

#include <QPainter>
#include <QPainterPath>
#include <QPolygonF>

#include "Theme.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

namespace
{
constexpr double kReach = 1.0;       // mm from the slice
constexpr double kMark = 5.0;        // pixels
constexpr double kFaded = 4.0;       // mm from the slice, where a curve is not seen any more
constexpr double kFaintReach = 15.0; // mm from the slice, of a measurement
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

bool isInSlice(const Eigen::Vector3d& point, const presenters::SliceGeometry& slice,
               const Eigen::Vector3d& at, double beyond)
{
  return std::abs(slice.axes().next.dot(point - at)) <= kReach + beyond;
}

namespace
{

QPointF pixelOf(const presenters::SliceGeometry& slice, const Eigen::Vector3d& point)
{
  const Eigen::Vector2d pixel = slice.pixelFromPatient(point) + Eigen::Vector2d(0.5, 0.5);
  return {pixel[0], pixel[1]};
}

// 1 in the slice, less beside it, 0 where it is not seen. `away`: mm from it; what lies up to
// `beyond` from it is in it.
double strengthOf(double away, double beyond)
{
  constexpr double kFaint = 0.4;
  const double off = away - beyond;
  if (off <= kReach)
    return 1.0;
  return off < kFaintReach ? kFaint * (kFaintReach - off) / (kFaintReach - kReach) : 0.0;
}

void paintLine(QPainter& painter, const DrawnMeasure& measure,
               const presenters::SliceGeometry& slice, const Eigen::Vector3d& at, double beyond)
{
  const Eigen::Vector3d next = slice.axes().next;
  const std::size_t edges = measure.points.size() - (measure.closed ? 0 : 1);
  for (const bool halo : {true, false})
    for (std::size_t n = 0; n < edges; ++n)
    {
      const Eigen::Vector3d& from = measure.points[n];
      const Eigen::Vector3d& to = measure.points[(n + 1) % measure.points.size()];
      // In parts, as an oblique edge leaves the slice.
      const double steep = std::abs(next.dot(to - from));
      const int parts = std::clamp(static_cast<int>(std::ceil(steep)), 1, 200);
      for (int part = 0; part < parts; ++part)
      {
        const Eigen::Vector3d a = from + (to - from) * part / parts;
        const Eigen::Vector3d b = from + (to - from) * (part + 1) / parts;
        const double strength = strengthOf(std::abs(next.dot(0.5 * (a + b) - at)), beyond);
        if (strength <= 0.0)
          continue;
        QColor color = halo ? QColor(0, 0, 0) : measure.color;
        color.setAlphaF((halo ? 0.75 : 1.0) * strength);
        const double width = measure.chosen ? 2.4 : 1.6;
        painter.setPen(QPen(color, halo ? width + 2.0 : width,
                            strength < 1.0 || measure.draft ? Qt::DashLine : Qt::SolidLine,
                            Qt::FlatCap));
        painter.drawLine(pixelOf(slice, a), pixelOf(slice, b));
      }
    }
}

void paintHandles(QPainter& painter, const DrawnMeasure& measure,
                  const presenters::SliceGeometry& slice, const Eigen::Vector3d& at, double beyond)
{
  const Eigen::Vector3d next = slice.axes().next;
  for (const std::size_t n : measure.handles)
  {
    const double strength = strengthOf(std::abs(next.dot(measure.points[n] - at)), beyond);
    if (strength <= 0.0)
      continue;
    const bool inside = strength == 1.0;
    const double radius = inside ? (measure.chosen ? 4.5 : 3.5) : 2.5;
    QColor edge(0, 0, 0);
    QColor fill(measure.color);
    edge.setAlphaF(0.8 * strength);
    fill.setAlphaF(strength);
    painter.setPen(QPen(edge, 1.4));
    painter.setBrush(fill);
    painter.drawEllipse(pixelOf(slice, measure.points[n]), radius, radius);
  }
  painter.setBrush(Qt::NoBrush);
}

constexpr double kRim = 4.0; // px, about a label's text and from the picture's edge

// Words that do not fit into the picture go into further lines.
int flagsOf(const QPainter& painter, const QString& text)
{
  const double room = painter.viewport().width() - 4.0 * kRim;
  const QFontMetricsF metrics(painter.font());
  if (metrics.horizontalAdvance(text) <= room)
    return Qt::AlignCenter;
  for (const QString& word : text.split(' '))
    if (metrics.horizontalAdvance(word) > room)
      return Qt::AlignCenter | Qt::TextWrapAnywhere;
  return Qt::AlignCenter | Qt::TextWordWrap;
}

QSizeF sizeOfLabel(const QPainter& painter, const QString& text)
{
  constexpr double kHighest = 1e4; // px
  const QFontMetricsF metrics(painter.font());
  const int flags = flagsOf(painter, text);
  if (flags == Qt::AlignCenter)
    return {metrics.horizontalAdvance(text) + 2.0 * kRim, metrics.height() + 2.0};
  const QRectF room(0.0, 0.0, painter.viewport().width() - 4.0 * kRim, kHighest);
  return {room.width() + 2.0 * kRim, metrics.boundingRect(room, flags, text).height() + 2.0};
}

// Right above the handle, in the picture.
QRectF placeOfLabel(const QPainter& painter, const QString& label, const QPointF& handle)
{
  constexpr double kAway = 8.0; // px
  QRectF box(QPointF(), sizeOfLabel(painter, label));
  box.moveBottomLeft(handle + QPointF(kAway, 2.0 - kAway));
  const QRectF picture = painter.viewport();
  if (box.right() > picture.right() - kRim)
    box.moveRight(std::max(handle.x() - kAway, box.width() + kRim));
  if (box.right() > picture.right() - kRim)
    box.moveRight(picture.right() - kRim);
  if (box.top() < kRim)
    box.moveTop(handle.y() + kAway);
  return box;
}

// In the picture, below what is in the way, or above it where there is no room left. Where there is
// none at all it lies on something, and is whole.
QRectF freePlace(QRectF wanted, const std::vector<QRectF>& taken, const QRectF& picture)
{
  const auto inside = [](double at, double from, double to)
  { return std::max(from, std::min(at, to)); };
  wanted.moveLeft(inside(wanted.left(), picture.left(), picture.right() - wanted.width()));
  wanted.moveTop(inside(wanted.top(), picture.top(), picture.bottom() - wanted.height()));
  const auto moved = [&](bool down)
  {
    QRectF box = wanted;
    for (std::size_t n = 0; n < taken.size(); ++n)
      if (taken[n].intersects(box))
      {
        down ? box.moveTop(taken[n].bottom() + 1.0) : box.moveBottom(taken[n].top() - 1.0);
        n = static_cast<std::size_t>(-1);
      }
    return box;
  };
  const QRectF below = moved(true);
  if (below.bottom() <= picture.bottom())
    return below;
  const QRectF above = moved(false);
  return above.top() >= picture.top() ? above : wanted;
}

void paintLabel(QPainter& painter, const QRectF& box, const QString& text, const QColor& color,
                bool framed)
{
  QColor back(10, 12, 15);
  back.setAlphaF(0.72);
  painter.setPen(framed ? QPen(color, 1.0) : QPen(Qt::NoPen));
  painter.setBrush(back);
  painter.drawRoundedRect(box, 3.0, 3.0);
  painter.setPen(color.lighter(115));
  painter.drawText(box.adjusted(kRim, 0.0, -kRim, 0.0), flagsOf(painter, text), text);
  painter.setBrush(Qt::NoBrush);
}

} // namespace

void paintMeasures(QPainter& painter, const std::vector<DrawnMeasure>& measures,
                   const presenters::SliceGeometry& slice, const Eigen::Vector3d& at, double beyond,
                   std::vector<QRectF> taken)
{
  for (const DrawnMeasure& measure : measures)
    if (!measure.points.empty())
    {
      paintLine(painter, measure, slice, at, beyond);
      paintHandles(painter, measure, slice, at, beyond);
    }
  // On top of all lines, none on another.
  QFont font = painter.font();
  font.setPixelSize(12);
  painter.setFont(font);
  for (const DrawnMeasure& measure : measures)
  {
    const auto handle = std::find_if(measure.handles.rbegin(), measure.handles.rend(),
                                     [&](std::size_t n)
                                     { return isInSlice(measure.points[n], slice, at, beyond); });
    if (measure.label.isEmpty() || handle == measure.handles.rend())
      continue;
    QRectF box = placeOfLabel(painter, measure.label, pixelOf(slice, measure.points[*handle]));
    const QRectF picture = painter.viewport();
    if (!picture.intersects(QRectF(pixelOf(slice, measure.points[*handle]), QSizeF(1.0, 1.0))))
      continue;
    box = freePlace(box, taken, picture);
    taken.push_back(box);
    paintLabel(painter, box, measure.label, measure.color, measure.chosen);
  }
}

QRectF paintReading(QPainter& painter, const QString& text, const QPointF& pointer,
                    const QColor& color, const std::vector<QRectF>& taken)
{
  QFont font = painter.font();
  font.setPixelSize(12);
  painter.setFont(font);
  const QRectF box =
      freePlace(placeOfLabel(painter, text, pointer), taken, QRectF(painter.viewport()));
  paintLabel(painter, box, text, color, true);
  return box;
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

QRectF paintBox(QPainter& painter, const presenters::HandledBox& box, bool dims,
                const presenters::SliceGeometry& slice, const std::vector<QRectF>& taken)
{
  constexpr double kHalf = 3.5;  // px, of a handle
  constexpr double kSize = 40.0; // px, from which on it is written
  const presenters::BoxInSlice shown(box, slice);
  QPolygonF outline;
  std::vector<QPointF> handles;
  for (const presenters::BoxInSlice::Edge& edge : shown.edges())
  {
    const Eigen::Vector2d middle = 0.5 * (edge.from + edge.to);
    outline << QPointF(edge.from[0] + 0.5, edge.from[1] + 0.5);
    handles.push_back(outline.last());
    handles.emplace_back(middle[0] + 0.5, middle[1] + 0.5);
  }
  if (dims)
  {
    QPainterPath outside;
    outside.addRect(QRectF(painter.viewport()));
    outside.addPolygon(outline);
    outside.closeSubpath();
    painter.fillPath(outside, QColor(0, 0, 0, 110));
  }
  const QColor color = boxColor();
  const Qt::PenStyle style = shown.isSection() ? Qt::SolidLine : Qt::DashLine;
  painter.setBrush(Qt::NoBrush);
  for (const auto& pen : {QPen(QColor(0, 0, 0, 200), 3.5), QPen(color, 1.5, style)})
  {
    painter.setPen(pen);
    painter.drawPolygon(outline);
  }
  painter.setPen(QPen(QColor(0, 0, 0, 200), 1.0));
  painter.setBrush(color);
  for (const QPointF& at : handles)
    painter.drawRect(QRectF(at.x() - kHalf, at.y() - kHalf, 2.0 * kHalf, 2.0 * kHalf));
  painter.setBrush(Qt::NoBrush);

  const QRectF bounds = outline.boundingRect();
  if (shown.edges().size() != 4 || bounds.width() < kSize)
    return {};
  const auto length = [&](std::size_t n)
  {
    const presenters::BoxInSlice::Edge& edge = shown.edges()[n];
    return (edge.to - edge.from).norm() * slice.mmPerPixel();
  };
  const presenters::BoxInSlice::Edge& first = shown.edges()[0];
  const bool isAcross =
      std::abs(first.to[0] - first.from[0]) > std::abs(first.to[1] - first.from[1]);
  const QString text =
      QString("%1 × %2 mm")
          .arg(numberText(length(isAcross ? 0 : 1), 1), numberText(length(isAcross ? 1 : 0), 1));
  QFont font = painter.font();
  font.setPixelSize(12);
  painter.setFont(font);
  const QRectF seen = bounds.intersected(QRectF(painter.viewport()));
  if (seen.isEmpty())
    return {};
  const QFontMetricsF metrics(font);
  QRectF place(QPointF(), QSizeF(metrics.horizontalAdvance(text), metrics.height()));
  place.moveBottomRight(seen.bottomRight() - QPointF(2.0 * kHalf, 2.0 * kHalf));
  place = freePlace(place, taken, painter.viewport());
  drawText(painter, place.bottomLeft() - QPointF(0.0, metrics.descent()), text, color);
  return place;
}

void paintCut(QPainter& painter, const scene::ViewState::Clipping::Plane& plane,
              const presenters::SliceGeometry& slice)
{
  constexpr double kTick = 7.0;   // px
  constexpr double kApart = 40.0; // px, from tick to tick
  constexpr double kEnd = 4.0;    // px, of the disc at an end
  const auto line = presenters::lineInSlice(plane, slice);
  if (!line)
    return;
  const auto at = [](const Eigen::Vector2d& pixel)
  { return QPointF(pixel[0] + 0.5, pixel[1] + 0.5); };
  const double length = (line->to - line->from).norm();
  const Eigen::Vector2d along = (line->to - line->from) / length;
  for (const auto& pen : {QPen(QColor(0, 0, 0, 200), 3.0), QPen(cutColor(), 1.3, Qt::DashLine)})
  {
    painter.setPen(pen);
    painter.drawLine(at(line->from), at(line->to));
  }
  painter.setPen(QPen(cutColor(), 1.3));
  for (double on = 0.5 * kApart; on < length; on += kApart)
  {
    const Eigen::Vector2d foot = line->from + on * along;
    painter.drawLine(at(foot), at(foot + kTick * line->kept));
  }
  painter.setPen(QPen(QColor(0, 0, 0, 200), 1.0));
  painter.setBrush(cutColor());
  for (const Eigen::Vector2d& end : presenters::endsOf(*line))
    painter.drawEllipse(at(end), kEnd, kEnd);
  painter.setBrush(Qt::NoBrush);
}

} // namespace petrous::workstation
