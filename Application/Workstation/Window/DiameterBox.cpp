#include "DiameterBox.h"

#include <algorithm>
#include <cmath>

#include <QLocale>
#include <QStringList>

namespace petrous::workstation
{

DiameterBox::DiameterBox(QWidget* parent)
  : QDoubleSpinBox(parent)
{
  setDecimals(1);
  setKeyboardTracking(false); // no values from partial input
}

void DiameterBox::setDiameters(std::vector<double> diameters, double wanted)
{
  std::sort(diameters.begin(), diameters.end());
  m_diameters = std::move(diameters);
  const double taken = *nearest(wanted);
  setRange(m_diameters.front(), m_diameters.back());
  const QString between = locale().decimalPoint() == ',' ? "; " : ", ";
  QStringList all;
  for (const double diameter : m_diameters)
    all += locale().toString(diameter, 'g', 3);
  setProperty("possible", tr("Burrs of %1 mm").arg(all.join(between)));
  setValue(taken);
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

QValidator::State DiameterBox::validate(QString& text, int& at) const
{
  const QValidator::State state = QDoubleSpinBox::validate(text, at);
  if (state != QValidator::Acceptable || m_diameters.empty())
    return state;
  const double typed = valueFromText(text);
  return std::abs(*nearest(typed) - typed) < 0.01 ? state : QValidator::Intermediate;
}

} // namespace petrous::workstation
