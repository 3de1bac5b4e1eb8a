#include "WindowTexts.h"

#include <cmath>

#include <QObject>

#include "Theme.h"

namespace petrous::workstation
{

namespace
{
// "R 32.1  P 12.0  S 45.3 mm": the letters of the directions from the scanner's zero.
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

QString placeText(const presenters::WorkstationModel& model, const Eigen::Vector3d& patient)
{
  QString text = positionText(patient);
  if (const auto hounsfield = model.hounsfieldAt(patient))
    text += QObject::tr("   %1 HU").arg(std::lround(*hounsfield));
  const std::string structure = model.structureAt(patient);
  if (!structure.empty())
    text += "   " + words(structure).replace('_', ' ');
  return text;
}

QString removedText(const scene::Case& value)
{
  return value.applied() == 0
             ? QObject::tr("nothing drilled")
             : QObject::tr("%1 %2, %3 mm³ removed")
                   .arg(value.applied())
                   .arg(value.applied() == 1 ? QObject::tr("stroke") : QObject::tr("strokes"))
                   .arg(value.removedVolume(), 0, 'f', 1);
}

QString strokeText(const dissection::Stroke* stroke)
{
  if (!stroke)
    return QObject::tr("Nothing was cut");
  QString text = QObject::tr("Removed %1 mm³").arg(stroke->info.removed, 0, 'f', 2);
  for (const auto& touched : stroke->info.structures)
    text += QObject::tr("  ·  %1 %2 mm³")
                .arg(words(touched.name).replace('_', ' '))
                .arg(touched.volume, 0, 'f', 2);
  return text;
}

QString aboutText()
{
  return QObject::tr("<h3>Petrous %1</h3><p>Rehearsal of operations on the temporal bone and the "
                     "skull base on the patient's own images.</p><p>For rehearsal and teaching; "
                     "not a medical device, and no guide for an instrument in a patient.</p>"
                     "<p>Apache License 2.0. Made with VTK, ITK, GDCM and Qt.</p>")
      .arg(PETROUS_VERSION);
}

} // namespace petrous::workstation
