#pragma once

#include <vector>

#include <QDoubleSpinBox>

namespace petrous::workstation
{

/// Burr diameter, mm: steps through the available ones; another one is not taken.
class DiameterBox : public QDoubleSpinBox
{
  Q_OBJECT
public:
  explicit DiameterBox(QWidget* parent = nullptr);

  /// Not empty. The value becomes the one of them that is nearest to `wanted`.
  void setDiameters(std::vector<double> diameters, double wanted);

  void stepBy(int steps) override;
  QValidator::State validate(QString& text, int& at) const override;

private:
  std::vector<double>::const_iterator nearest(double diameter) const;

  std::vector<double> m_diameters; // ascending
};

} // namespace petrous::workstation
