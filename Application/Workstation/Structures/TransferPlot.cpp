#include "TransferPlot.h"

#include <algorithm>
#include <cmath>

#include <QAccessible>
#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>

#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Core/NumberText.h"

namespace petrous::workstation
{

using appearance::ControlPoint;
using presenters::AppearanceEditor;
using presenters::OpacityAxis;

namespace
{

constexpr double kTop = 12.0, kRight = 14.0, kGap = 6.0; // px
constexpr double kStrip = 9.0;                           // px, height of the colours
constexpr double kPoint = 6.0;                           // px, radius
constexpr double kReach = 10.0;                          // px, of a click
constexpr double kCurveReach = 7.0;                      // px
constexpr double kLowest = 0.02;                         // share of the axis that zooms furthest in
constexpr double kNudge = 0.02;                          // of the height, an arrow key
constexpr double kFiner = 0.1;                           // of that, with Shift
constexpr double kTickRoom = 64.0;                       // px between two numbers
constexpr double kHistogramHeight = 0.88;                // of the area
const QColor kAccent("#62b0ec");

QColor toColor(const std::array<float, 3>& color, double alpha = 1.0)
{
  return QColor::fromRgbF(double(color[0]), double(color[1]), double(color[2]), alpha);
}

QColor mixed(const QColor& a, const QColor& b, double share)
{
  const auto mix = [share](int x, int y)
  { return static_cast<int>(std::lround(x + (y - x) * share)); };
  return {mix(a.red(), b.red()), mix(a.green(), b.green()), mix(a.blue(), b.blue())};
}

// 1, 2 or 5 times a power of ten.
double tickStep(double least)
{
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least)
      return factor * power;
  return 10.0 * power;
}

double distance(const QPointF& a, const QPointF& b)
{
  return std::hypot(a.x() - b.x(), a.y() - b.y());
}

} // namespace

TransferPlot::TransferPlot(AppearanceEditor& editor, QWidget* parent)
  : QWidget(parent)
  , m_editor(editor)
{
  setObjectName("transferPlot");
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  refresh();
}

void TransferPlot::refresh()
{
  const AppearanceEditor::Axis before = m_axis;
  m_axis = m_editor.axis();
  if (m_axis.image != before.image || m_axis.unit != before.unit)
    m_isWhole = true;
  // While a point is dragged the axis stays, so that the pointer does.
  if (m_isWhole && !m_drag)
    showAll();
  announce();
  update();
}

void TransferPlot::showAll()
{
  m_isWhole = true;
  const double margin = 0.015 * (m_axis.most - m_axis.least);
  m_least = m_axis.least - margin;
  m_most = m_axis.most + margin;
  update();
}

void TransferPlot::setView(double least, double most)
{
  const double whole = m_axis.most - m_axis.least;
  const double margin = 0.015 * whole;
  const double size = std::min(std::max(most - least, kLowest * whole), whole + 2.0 * margin);
  const double middle = 0.5 * (least + most);
  m_least = std::clamp(middle - 0.5 * size, m_axis.least - margin,
                       std::max(m_axis.most + margin - size, m_axis.least - margin));
  m_most = m_least + size;
  m_isWhole = size >= whole + 1.99 * margin;
  update();
}

void TransferPlot::zoom(double factor, double x)
{
  const double at = valueAt(x);
  setView(at + (m_least - at) * factor, at + (m_most - at) * factor);
}

void TransferPlot::pan(double pixels)
{
  const double by = pixels * (m_most - m_least) / std::max(area().width(), 1.0);
  setView(m_least + by, m_most + by);
}

QRectF TransferPlot::area() const
{
  const QFontMetricsF metrics(font());
  const double left = std::ceil(metrics.horizontalAdvance("0.001")) + 2.0 * kGap + 2.0;
  const double bottom = std::ceil(metrics.height()) + kStrip + 2.0 * kGap + 3.0;
  return {left, kTop, std::max(width() - left - kRight, 10.0),
          std::max(height() - kTop - bottom, 10.0)};
}

QRectF TransferPlot::strip() const
{
  const QRectF plot = area();
  return {plot.left(), plot.bottom() + 4.0, plot.width(), kStrip};
}

QPointF TransferPlot::positionOf(double value, double opacity) const
{
  const QRectF plot = area();
  return {plot.left() + plot.width() * (value - m_least) / (m_most - m_least),
          plot.bottom() - plot.height() * OpacityAxis::height(opacity)};
}

double TransferPlot::valueAt(double x) const
{
  const QRectF plot = area();
  return m_least + (m_most - m_least) * (x - plot.left()) / plot.width();
}

double TransferPlot::opacityAt(double y) const
{
  const QRectF plot = area();
  return OpacityAxis::rounded(OpacityAxis::opacity((plot.bottom() - y) / plot.height()));
}

// The nearest of the selected part.
std::optional<std::size_t> TransferPlot::pointAt(const QPointF& position) const
{
  std::optional<std::size_t> nearest;
  double least = kReach;
  if (const Part* part = m_editor.selected())
    for (std::size_t n = 0; n < part->points.size(); ++n)
    {
      const ControlPoint& point = part->points[n];
      const double d = distance(position, positionOf(point.value, double(point.opacity)));
      if (d <= least)
      {
        least = d;
        nearest = n;
      }
    }
  return nearest;
}

const AppearanceEditor::Part* TransferPlot::curveAt(const QPointF& position) const
{
  const Part* nearest = nullptr;
  double least = kCurveReach;
  if (!area().adjusted(-2, -kReach, 2, kReach).contains(position))
    return nullptr;
  for (const Part* part : m_editor.onAxis())
  {
    double d = 2.0 * kCurveReach;
    for (double x = -kCurveReach; x <= kCurveReach; x += 1.0)
    {
      const double value = valueAt(position.x() + x);
      const double opacity = -std::expm1(-part->transfer.at(value).extinction);
      d = std::min(d, distance(position, positionOf(value, opacity)));
    }
    // A tie goes to the selected one.
    if (d < least || (d <= least + 1.0 && part == m_editor.selected()))
    {
      least = d;
      nearest = part;
    }
  }
  return nearest;
}

// ---- painting

QPainterPath TransferPlot::curve(const Part& part) const
{
  constexpr double kStep = 2.0; // px; between two points it is bent on the logarithmic axis
  const QRectF plot = area();
  std::vector<double> xs;
  for (double x = plot.left(); x < plot.right(); x += kStep)
    xs.push_back(x);
  xs.push_back(plot.right());
  for (const ControlPoint& point : part.points)
    if (const double x = positionOf(point.value, 0.0).x(); x > plot.left() && x < plot.right())
      xs.push_back(x);
  std::sort(xs.begin(), xs.end());
  QPainterPath path;
  for (const double x : xs)
  {
    const double opacity = -std::expm1(-part.transfer.at(valueAt(x)).extinction);
    const double y = positionOf(0.0, opacity).y();
    path.elementCount() == 0 ? path.moveTo(x, y) : path.lineTo(x, y);
  }
  return path;
}

// Logarithmic counts, in steps as fine as their number bears.
QPainterPath TransferPlot::histogram(const volume::IntensityHistogram& counts) const
{
  constexpr double kFewest = 32.0; // steps
  QPainterPath path;
  const auto& bins = counts.bins();
  const QRectF plot = area();
  if (bins.empty())
    return path;
  std::vector<double> upTo(bins.size() + 1, 0.0); // values below each bin
  for (std::size_t bin = 0; bin < bins.size(); ++bin)
    upTo[bin + 1] = upTo[bin] + static_cast<double>(bins[bin]);
  const auto below = [&](double x)
  {
    const double at = std::clamp((valueAt(x) - counts.lower()) / counts.binWidth(), 0.0,
                                 static_cast<double>(bins.size()));
    const auto bin = std::min(static_cast<std::size_t>(at), bins.size() - 1);
    return upTo[bin] + (at - static_cast<double>(bin)) * static_cast<double>(bins[bin]);
  };
  const double pixels = plot.width() * devicePixelRatioF();
  const double range = static_cast<double>(bins.size()) * counts.binWidth();
  const double wanted = std::max(2.0 * std::sqrt(static_cast<double>(counts.count())), kFewest) *
                        (m_most - m_least) / range;
  const double steps = std::max(std::floor(std::min(pixels, wanted)), 1.0);
  const double step = plot.width() / steps;
  std::vector<double> heights;
  for (double n = 0.0; n < steps; n += 1.0)
    heights.push_back(below(plot.left() + (n + 1.0) * step) - below(plot.left() + n * step));
  const double largest = std::max(*std::max_element(heights.begin(), heights.end()), 1.0);
  path.moveTo(plot.bottomLeft());
  for (std::size_t n = 0; n < heights.size(); ++n)
  {
    const double x = plot.left() + static_cast<double>(n) * step;
    const double y = plot.bottom() - kHistogramHeight * plot.height() * std::log1p(heights[n]) /
                                         std::log1p(largest);
    path.lineTo(x, y);
    path.lineTo(x + step, y);
  }
  path.lineTo(plot.bottomRight());
  path.closeSubpath();
  return path;
}

QLinearGradient TransferPlot::colors(const Part& part, double opacity) const
{
  const QRectF plot = area();
  QLinearGradient gradient(plot.left(), 0.0, plot.right(), 0.0);
  const auto at = [&](double value)
  {
    const auto optics = part.transfer.at(value);
    return QColor::fromRgbF(optics.color[0], optics.color[1], optics.color[2], opacity);
  };
  gradient.setColorAt(0.0, at(m_least));
  gradient.setColorAt(1.0, at(m_most));
  for (const ControlPoint& point : part.points)
    if (point.value > m_least && point.value < m_most)
      gradient.setColorAt((point.value - m_least) / (m_most - m_least),
                          toColor(point.color, opacity));
  return gradient;
}

void TransferPlot::paintAxes(QPainter& painter) const
{
  const QRectF plot = area();
  const QColor base = palette().color(QPalette::Base);
  const QColor text = palette().color(QPalette::Text);
  const QColor ink = mixed(base, text, 0.62);
  const QFontMetricsF metrics(font());
  const auto crisp = [this](double at)
  {
    const double pixel = 1.0 / devicePixelRatioF();
    return (std::floor(at / pixel) + 0.5) * pixel;
  };
  const double pixel = 1.0 / devicePixelRatioF();
  for (const double opacity : {0.0, 0.001, 0.01, 0.1, 1.0})
  {
    const double y = crisp(positionOf(0.0, opacity).y());
    painter.setPen(QPen(mixed(base, text, opacity == 0.0 ? 0.34 : 0.13), pixel));
    painter.drawLine(QPointF(plot.left(), y), QPointF(plot.right(), y));
    painter.setPen(ink);
    painter.drawText(QRectF(0.0, y - metrics.height() / 2.0, plot.left() - kGap, metrics.height()),
                     Qt::AlignRight | Qt::AlignVCenter, numberText(core::plainText(opacity)));
  }
  const double room =
      std::max(kTickRoom, metrics.horizontalAdvance(numberText(m_axis.number(m_axis.most))) + 16.0);
  const double step = std::max(tickStep((m_most - m_least) * room / plot.width()), m_axis.gap);
  const double below = strip().bottom() + 3.0;
  const QString unit = words(m_axis.unit.empty() ? m_axis.image : m_axis.unit);
  const double unitLeft = plot.right() + kRight - metrics.horizontalAdvance(unit) - 4.0;
  for (double value = std::ceil(m_least / step) * step; value <= m_most; value += step)
  {
    const double x = crisp(positionOf(value, 0.0).x());
    painter.setPen(QPen(mixed(base, text, 0.13), pixel));
    painter.drawLine(QPointF(x, plot.top()), QPointF(x, plot.bottom()));
    const QString number = numberText(m_axis.number(value));
    const double width = metrics.horizontalAdvance(number);
    if (x + width / 2.0 > unitLeft - 6.0)
      continue;
    painter.setPen(ink);
    painter.drawText(QRectF(x - room / 2.0, below, room, metrics.height()), Qt::AlignCenter,
                     number);
  }
  painter.setPen(ink);
  painter.drawText(QPointF(unitLeft, below + metrics.ascent()), unit);
}

void TransferPlot::paintSelected(QPainter& painter, const Part& part) const
{
  const QColor base = palette().color(QPalette::Base);
  const QColor text = palette().color(QPalette::Text);
  const QPainterPath path = curve(part);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(mixed(base, text, 0.85), 4.6, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPath(path);
  painter.setPen(QPen(colors(part, 1.0), 2.8, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPath(path);
  const QRectF plot = area();
  for (std::size_t n = 0; n < part.points.size(); ++n)
  {
    const ControlPoint& point = part.points[n];
    const QPointF at = positionOf(point.value, double(point.opacity));
    if (at.x() < plot.left() - 1.0 || at.x() > plot.right() + 1.0)
      continue;
    const bool isSelected = m_editor.point() == n;
    if (isSelected)
    {
      painter.setBrush(Qt::NoBrush);
      painter.setPen(QPen(base, 5.0));
      painter.drawEllipse(at, kPoint + 4.0, kPoint + 4.0);
      painter.setPen(QPen(kAccent, 2.0));
      painter.drawEllipse(at, kPoint + 4.0, kPoint + 4.0);
    }
    painter.setPen(QPen(base, 3.6));
    painter.setBrush(toColor(point.color));
    painter.drawEllipse(at, kPoint, kPoint);
    painter.setPen(QPen(mixed(base, text, 1.0), 1.6));
    painter.drawEllipse(at, kPoint, kPoint);
    // The highlight, as large as it is strong.
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(255, 255, 255, 220));
    const double gloss = 2.6 * std::sqrt(double(point.specular));
    painter.drawEllipse(at - QPointF(1.6, 1.6), gloss, gloss);
  }
}

void TransferPlot::paintEvent(QPaintEvent*)
{
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QColor base = palette().color(QPalette::Base);
  const QColor text = palette().color(QPalette::Text);
  painter.fillRect(rect(), base);
  const Part* selected = m_editor.selected();
  if (!selected)
    return;
  const QRectF plot = area();
  painter.setPen(Qt::NoPen);
  if (const auto image = m_editor.imageHistogram())
  {
    painter.setBrush(mixed(base, text, 0.15));
    painter.drawPath(histogram(*image));
  }
  if (const auto inside = m_editor.insideHistogram())
  {
    QLinearGradient fill = colors(*selected, 0.42);
    painter.setBrush(fill);
    const QPainterPath path = histogram(*inside);
    painter.drawPath(path);
    painter.strokePath(path, QPen(toColor(selected->look.color, 0.75), 1.0));
  }
  paintAxes(painter);
  painter.setPen(Qt::NoPen);
  painter.setBrush(colors(*selected, 1.0));
  painter.drawRoundedRect(strip(), 2.0, 2.0);

  painter.save();
  painter.setClipRect(plot.adjusted(-kPoint - 6.0, -kTop, kPoint + 6.0, kPoint + 3.0));
  for (const Part* part : m_editor.onAxis())
  {
    if (part == selected)
      continue;
    const bool isHovered = part->name == m_hovered;
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(toColor(part->look.color, isHovered ? 1.0 : 0.6), isHovered ? 2.6 : 1.3));
    painter.drawPath(curve(*part));
    painter.setPen(Qt::NoPen);
    painter.setBrush(toColor(part->look.color, isHovered ? 1.0 : 0.75));
    for (const ControlPoint& point : part->points)
      if (point.value >= m_least && point.value <= m_most)
        painter.drawEllipse(positionOf(point.value, double(point.opacity)), 2.4, 2.4);
  }
  paintSelected(painter, *selected);
  painter.restore();

  painter.setPen(mixed(base, text, 0.62));
  const QRectF line = plot.adjusted(kGap, 2.0, -kGap, 0.0);
  if (m_editor.counts() && !m_editor.imageHistogram())
    painter.drawText(line, Qt::AlignRight | Qt::AlignTop, tr("Counting…"));
  if (hasFocus())
  {
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(kAccent, 1.0));
    painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
  }
}

// ---- mouse

void TransferPlot::mousePressEvent(QMouseEvent* event)
{
  const QPointF position = event->localPos();
  if (event->button() == Qt::MiddleButton)
  {
    m_panned = position;
    return;
  }
  if (event->button() != Qt::LeftButton || !m_editor.selected())
    return;
  if (const auto point = pointAt(position))
  {
    m_editor.selectPoint(point);
    const ControlPoint& before = m_editor.selected()->points[*point];
    m_drag =
        Drag{before, position, positionOf(before.value, double(before.opacity)) - position, false};
  }
  else if (const Part* part = curveAt(position); part && part != m_editor.selected())
    m_editor.select(part->name);
  else
    m_editor.selectPoint({});
  emit changed();
}

void TransferPlot::mouseMoveEvent(QMouseEvent* event)
{
  const QPointF position = event->localPos();
  if (m_panned)
  {
    pan(m_panned->x() - position.x());
    m_panned = position;
    return;
  }
  if (m_drag)
    return moveTo(position, event->modifiers() & Qt::ShiftModifier);
  const bool isOnPoint = pointAt(position).has_value();
  const Part* part = isOnPoint ? nullptr : curveAt(position);
  const std::string hovered = part && part != m_editor.selected() ? part->name : std::string();
  setCursor(isOnPoint                   ? Qt::SizeAllCursor
            : !hovered.empty()          ? Qt::PointingHandCursor
            : area().contains(position) ? Qt::CrossCursor
                                        : Qt::ArrowCursor);
  if (hovered == m_hovered)
    return;
  m_hovered = hovered;
  update();
}

void TransferPlot::moveTo(const QPointF& position, bool alongOneAxis)
{
  constexpr double kStart = 2.0; // px, so that a click moves nothing
  QPointF by = position - m_drag->pressed;
  if (!m_drag->moved && std::hypot(by.x(), by.y()) < kStart)
    return;
  m_drag->moved = true;
  if (alongOneAxis)
    (std::abs(by.x()) > std::abs(by.y()) ? by.ry() : by.rx()) = 0.0;
  const QPointF to = m_drag->pressed + m_drag->offset + by;
  ControlPoint point = m_drag->before;
  if (by.x() != 0.0)
    point.value = valueAt(to.x());
  if (by.y() != 0.0)
    point.opacity = static_cast<float>(opacityAt(to.y()));
  m_editor.setPoint(point);
  emit changed();
}

void TransferPlot::mouseReleaseEvent(QMouseEvent* event)
{
  if (event->button() == Qt::MiddleButton)
    m_panned.reset();
  if (event->button() != Qt::LeftButton || !m_drag)
    return;
  if (m_drag->moved)
    moveTo(event->localPos(), event->modifiers() & Qt::ShiftModifier);
  m_drag.reset();
  emit changed();
}

void TransferPlot::mouseDoubleClickEvent(QMouseEvent* event)
{
  const QPointF position = event->localPos();
  if (event->button() != Qt::LeftButton || !m_editor.selected())
    return;
  if (pointAt(position))
  {
    m_drag.reset();
    emit colorAsked();
    return;
  }
  if (!area().adjusted(0, -kTop, 0, kPoint).contains(position))
    return;
  if (m_editor.addPoint(valueAt(position.x()), opacityAt(position.y())))
  {
    // It can be dragged on.
    const ControlPoint& added = m_editor.selected()->points[*m_editor.point()];
    m_drag =
        Drag{added, position, positionOf(added.value, double(added.opacity)) - position, false};
  }
  emit changed();
}

void TransferPlot::wheelEvent(QWheelEvent* event)
{
  event->accept();
  if (event->modifiers() & Qt::ShiftModifier || event->angleDelta().x() != 0)
    return pan(-0.3 * (event->angleDelta().x() + event->angleDelta().y()));
  zoom(std::pow(0.8, event->angleDelta().y() / 120.0), event->position().x());
}

void TransferPlot::leaveEvent(QEvent*)
{
  m_hovered.clear();
  update();
}

// ---- keys

void TransferPlot::nudge(double steps, double heights)
{
  const Part* part = m_editor.selected();
  if (!part || part->points.empty())
    return;
  if (!m_editor.point())
    m_editor.selectPoint(0);
  else
  {
    ControlPoint point = part->points[*m_editor.point()];
    if (steps != 0.0)
      point.value += steps * m_axis.step;
    if (heights != 0.0)
    {
      const double before = OpacityAxis::rounded(double(point.opacity));
      double next = OpacityAxis::rounded(
          OpacityAxis::opacity(OpacityAxis::height(double(point.opacity)) + heights));
      if (next == before) // finer than its digits
        next = before + (heights > 0.0 ? 1e-4 : -1e-4);
      point.opacity = static_cast<float>(std::clamp(next, 0.0, 1.0));
    }
    m_editor.setPoint(point);
  }
  emit changed();
}

void TransferPlot::stepPoint(int step)
{
  const Part* part = m_editor.selected();
  if (!part || part->points.empty())
    return;
  const auto count = static_cast<int>(part->points.size());
  const int at = m_editor.point() ? static_cast<int>(*m_editor.point()) : step > 0 ? -1 : count;
  m_editor.selectPoint(static_cast<std::size_t>(std::clamp(at + step, 0, count - 1)));
  emit changed();
}

void TransferPlot::keyPressEvent(QKeyEvent* event)
{
  const bool isControl = event->modifiers() & Qt::ControlModifier;
  const double fine = event->modifiers() & Qt::ShiftModifier ? kFiner : 1.0;
  switch (event->key())
  {
  case Qt::Key_Left:
    return isControl ? stepPoint(-1) : nudge(-fine, 0.0);
  case Qt::Key_Right:
    return isControl ? stepPoint(1) : nudge(fine, 0.0);
  case Qt::Key_Up:
    return nudge(0.0, fine * kNudge);
  case Qt::Key_Down:
    return nudge(0.0, -fine * kNudge);
  case Qt::Key_Home:
    return stepPoint(-1'000'000);
  case Qt::Key_End:
    return stepPoint(1'000'000);
  case Qt::Key_PageUp:
  case Qt::Key_PageDown:
    m_editor.selectNext(event->key() == Qt::Key_PageUp ? -1 : 1);
    emit changed();
    return;
  case Qt::Key_Insert:
    m_editor.addPointAfterSelected();
    emit changed();
    return;
  case Qt::Key_Delete:
  case Qt::Key_Backspace:
    m_editor.removePoint();
    emit changed();
    return;
  case Qt::Key_Return:
  case Qt::Key_Enter:
    emit colorAsked();
    return;
  case Qt::Key_Plus:
    return zoom(0.8, area().center().x());
  case Qt::Key_Minus:
    return zoom(1.25, area().center().x());
  case Qt::Key_0:
    return showAll();
  case Qt::Key_Escape:
    if (m_drag)
    {
      m_editor.setPoint(m_drag->before);
      m_drag.reset();
      emit changed();
      return;
    }
    if (m_editor.point())
    {
      m_editor.selectPoint({});
      emit changed();
      return;
    }
    break;
  default:
    break;
  }
  if (event->matches(QKeySequence::Copy))
    emit copyAsked();
  else if (event->matches(QKeySequence::Paste))
    emit pasteAsked();
  else
    QWidget::keyPressEvent(event);
}

bool TransferPlot::event(QEvent* event)
{
  if (event->type() == QEvent::ShortcutOverride) // these keys are the plot's while it has the focus
  {
    auto* key = static_cast<QKeyEvent*>(event);
    switch (key->key())
    {
    case Qt::Key_Left:
    case Qt::Key_Right:
    case Qt::Key_Up:
    case Qt::Key_Down:
    case Qt::Key_Home:
    case Qt::Key_End:
    case Qt::Key_PageUp:
    case Qt::Key_PageDown:
    case Qt::Key_Insert:
    case Qt::Key_Delete:
    case Qt::Key_Backspace:
    case Qt::Key_Return:
    case Qt::Key_Enter:
    case Qt::Key_Plus:
    case Qt::Key_Minus:
    case Qt::Key_0:
      event->accept();
      return true;
    case Qt::Key_Escape:
      if (m_drag || m_editor.point())
        event->accept();
      return true;
    default:
      if (key->matches(QKeySequence::Copy) || key->matches(QKeySequence::Paste))
      {
        event->accept();
        return true;
      }
    }
  }
  if (event->type() == QEvent::ToolTip)
  {
    const auto* help = static_cast<QHelpEvent*>(event);
    QString tip = tr("Drag a point: intensity and opacity of 1 mm; Shift: one of them.\n"
                     "Double click: a new point.  Del: remove.  Arrows: move, Shift: finer.\n"
                     "Ctrl+arrows: another point.  Page up, down: another structure.\n"
                     "Wheel, + and -: zoom.  Middle drag: move.  0: the whole axis.");
    if (const auto point = pointAt(help->pos()))
      tip = pointText(*point);
    else if (const Part* part = curveAt(help->pos()); part && part != m_editor.selected())
      tip = part->name == AppearanceEditor::kBone         ? tr("Bone")
            : part->name == AppearanceEditor::kSoftTissue ? tr("Soft tissue")
                                                          : shownName(part->name);
    QToolTip::showText(help->globalPos(), tip, this);
    return true;
  }
  return QWidget::event(event);
}

void TransferPlot::focusInEvent(QFocusEvent* event)
{
  QWidget::focusInEvent(event);
  update();
}

void TransferPlot::focusOutEvent(QFocusEvent* event)
{
  QWidget::focusOutEvent(event);
  update();
}

QString TransferPlot::pointText(std::size_t n) const
{
  const Part* part = m_editor.selected();
  const ControlPoint& point = part->points[n];
  return tr("Point %1 of %2: %3, opacity %4 of 1 mm, specular %5")
      .arg(n + 1)
      .arg(part->points.size())
      .arg(numberText(m_axis.text(point.value)))
      .arg(numberText(core::plainText(double(point.opacity), 3)))
      .arg(numberText(core::fixedText(double(point.specular), 2)));
}

// For screen readers.
void TransferPlot::announce()
{
  const Part* part = m_editor.selected();
  if (!part)
    return;
  const QString name = part->name == AppearanceEditor::kBone         ? tr("bone")
                       : part->name == AppearanceEditor::kSoftTissue ? tr("soft tissue")
                                                                     : shownName(part->name);
  const QString text = m_editor.point() ? pointText(*m_editor.point())
                       : part->points.empty()
                           ? tr("One colour at every intensity")
                           : tr("%1 points, none is selected").arg(part->points.size());
  setAccessibleName(tr("Transfer function of %1").arg(name));
  if (text == accessibleDescription())
    return;
  setAccessibleDescription(text);
  QAccessibleEvent event(this, QAccessible::DescriptionChanged);
  QAccessible::updateAccessibility(&event);
}

} // namespace petrous::workstation
