#pragma once

#include <vector>

#include <QDoubleSpinBox>

namespace petrous::workstation
{

/// Diameter of a burr, mm, of those that are sold: steps go from one to the next, and what is typed
/// becomes the nearest.
class DiameterBox : public QDoubleSpinBox
{
  Q_OBJECT
public:
  explicit DiameterBox(QWidget* parent = nullptr);

  /// Not empty. The present one becomes the nearest of them.
  void setDiameters(std::vector<double> diameters);

  void stepBy(int steps) override;
  double valueFromText(const QString& text) const override;

private:
  std::vector<double>::const_iterator nearest(double diameter) const;

  std::vector<double> m_diameters; // rising
};

} // namespace petrous::workstation
