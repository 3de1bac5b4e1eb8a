#include "ProbeLabel.h"

#include <cmath>

#include "Theme.h"
#include "petrous/Presenters/IntensityDisplay.h"

namespace petrous::workstation
{

namespace
{

// "R 32.1  P 12.0  S 45.3 mm": direction letters relative to the scanner's origin.
QString positionText(const Eigen::Vector3d& patient)
{
  constexpr char towards[3][2] = {{'R', 'L'}, {'A', 'P'}, {'I', 'S'}};
  QString text;
  for (int a = 0; a < 3; ++a)
    text += QString("%1 %2  ")
                .arg(QLatin1Char(towards[a][patient[a] > 0.0 ? 1 : 0]))
                .arg(std::abs(patient[a]), 0, 'f', 1);
  return text.trimmed() + " mm";
}

} // namespace

ProbeLabel::ProbeLabel(const presenters::WorkstationModel& model, QWidget* parent)
  : QLabel(parent)
  , m_model(model)
{
  setObjectName("place");
  setToolTip(
      tr("Under the pointer: patient position from the scanner's zero (mm; R right, "
         "L left, A anterior, P posterior, I inferior, S superior), value of the image that is "
         "seen, structure"));
  setContentsMargins(8, 0, 8, 0);
}

void ProbeLabel::showPlace(const Eigen::Vector3d& patient)
{
  const auto hounsfield = m_model.hounsfieldAt(patient);
  showValues(patient, hounsfield ? words(presenters::displayOf(m_model.value()).text(*hounsfield))
                                 : QString());
}

void ProbeLabel::showValues(const Eigen::Vector3d& patient, const QString& values)
{
  QString text = positionText(patient);
  if (!values.isEmpty())
    text += "   " + values;
  const std::string structure = m_model.structureAt(patient);
  if (!structure.empty())
    text += "   " + words(structure).replace('_', ' ');
  setText(text);
}

} // namespace petrous::workstation
