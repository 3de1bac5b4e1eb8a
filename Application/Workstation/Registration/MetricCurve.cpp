#include "MetricCurve.h"

#include <algorithm>
#include <cmath>

#include <QPainter>
#include <QPainterPath>

#include "WindowTexts.h"

namespace petrous::workstation
{

namespace
{
constexpr int kMargin = 8;
const QColor kFrame("#2e343c");
const QColor kInk("#9aa4af");
const QColor kLine("#62b0ec");
} // namespace

MetricCurve::MetricCurve(QWidget* parent)
  : QWidget(parent)
{
  setObjectName("metricCurve");
  setToolTip(
      tr("Mutual information while the registration runs, nats; within a level, higher is better. "
         "A vertical line and a number: the next finer level, with a scale of its own. Values of "
         "two levels are not comparable: on finer images it is lower"));
  setAccessibleName(tr("Metric while the registration runs"));
}

void MetricCurve::clear()
{
  m_points.clear();
  update();
}

void MetricCurve::add(int level, double metric)
{
  if (!std::isfinite(metric))
    return;
  m_points.push_back({level, metric});
  update();
}

void MetricCurve::paintEvent(QPaintEvent*)
{
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), QColor("#14171b"));
  painter.setPen(kFrame);
  painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
  if (m_points.empty())
    return;
  const QRectF area = QRectF(rect()).adjusted(kMargin, kMargin + 12, -kMargin, -kMargin - 8);
  const double step =
      m_points.size() > 1 ? area.width() / static_cast<double>(m_points.size() - 1) : 0.0;
  for (std::size_t first = 0; first < m_points.size();)
  {
    std::size_t end = first;
    double low = m_points[first].metric;
    double high = low;
    for (; end < m_points.size() && m_points[end].level == m_points[first].level; ++end)
    {
      low = std::min(low, m_points[end].metric);
      high = std::max(high, m_points[end].metric);
    }
    const double range = high > low ? high - low : 1.0;
    QPainterPath path;
    for (std::size_t n = first; n < end; ++n)
    {
      const QPointF at(area.left() + step * static_cast<double>(n),
                       area.bottom() - area.height() * (m_points[n].metric - low) / range);
      if (n == first)
        path.moveTo(at);
      else
        path.lineTo(at);
    }
    if (first > 0)
    {
      const double x = area.left() + step * (static_cast<double>(first) - 0.5);
      painter.setPen(kFrame);
      painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
    }
    painter.setPen(kInk);
    painter.drawText(QPointF(area.left() + step * static_cast<double>(first), area.bottom() + 5.0),
                     QString::number(m_points[first].level + 1));
    painter.setPen(QPen(kLine, 1.6));
    painter.drawPath(path);
    first = end;
  }
  const Point& last = m_points.back();
  painter.setPen(kInk);
  painter.drawText(QPointF(kMargin, kMargin + 7.0),
                   tr("level %1, metric %2").arg(last.level + 1).arg(numberText(last.metric, 4)));
}

} // namespace petrous::workstation
