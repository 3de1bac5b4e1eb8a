#include "ProbeLabel.h"

#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Core/PositionText.h"
#include "petrous/Presenters/IntensityDisplay.h"

namespace petrous::workstation
{

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
  showValues(patient, hounsfield
                          ? numberText(presenters::displayOf(m_model.value()).text(*hounsfield))
                          : QString());
}

void ProbeLabel::showValues(const Eigen::Vector3d& patient, const QString& values)
{
  QString text = numberText(core::positionText(patient));
  if (!values.isEmpty())
    text += "   " + values;
  const std::string structure = m_model.structureAt(patient);
  if (!structure.empty())
    text += "   " + shownName(structure);
  setText(text);
}

} // namespace petrous::workstation
