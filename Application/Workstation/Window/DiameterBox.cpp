#include "DiameterBox.h"

#include <algorithm>
#include <cmath>

namespace petrous::workstation
{

DiameterBox::DiameterBox(QWidget* parent)
  : QDoubleSpinBox(parent)
{
  setDecimals(1);
  setKeyboardTracking(false); // no values from partial input
}

void DiameterBox::setDiameters(std::vector<double> diameters)
{
  std::sort(diameters.begin(), diameters.end());
  m_diameters = std::move(diameters);
  const double present = *nearest(value());
  setRange(m_diameters.front(), m_diameters.back());
  setValue(present);
}

std::vector<double>::const_iterator DiameterBox::nearest(double diameter) const
{
  return std::min_element(m_diameters.begin(), m_diameters.end(),
                          [diameter](double a, double b)
                          { return std::abs(a - diameter) < std::abs(b - diameter); });
}

void DiameterBox::stepBy(int steps)
{
  if (m_diameters.empty())
    return QDoubleSpinBox::stepBy(steps);
  const auto last = static_cast<int>(m_diameters.size()) - 1;
  const auto place = static_cast<int>(nearest(value()) - m_diameters.begin());
  setValue(m_diameters[static_cast<std::size_t>(std::clamp(place + steps, 0, last))]);
}

double DiameterBox::valueFromText(const QString& text) const
{
  const double typed = QDoubleSpinBox::valueFromText(text);
  return m_diameters.empty() ? typed : *nearest(typed);
}

} // namespace petrous::workstation
