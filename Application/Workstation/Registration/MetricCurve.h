#pragma once

#include <vector>

#include <QWidget>

namespace petrous::workstation
{

/// How the metric rises while a registration runs: one line a level of resolution, since levels do
/// not compare.
class MetricCurve : public QWidget
{
  Q_OBJECT
public:
  explicit MetricCurve(QWidget* parent = nullptr);

  void clear();
  void add(int level, double metric); ///< nats
  std::size_t points() const noexcept { return m_points.size(); }

  QSize sizeHint() const override { return {260, 84}; }
  QSize minimumSizeHint() const override { return {120, 60}; }

protected:
  void paintEvent(QPaintEvent* event) override;

private:
  struct Point
  {
    int level;
    double metric;
  };
  std::vector<Point> m_points;
};

} // namespace petrous::workstation
