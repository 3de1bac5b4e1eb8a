#pragma once

#include <vector>

#include <QWidget>

namespace petrous::workstation
{

/// Plot of the metric of a running registration: one curve per resolution level, since levels are
/// not comparable.
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
