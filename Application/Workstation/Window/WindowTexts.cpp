#include "WindowTexts.h"

#include <QObject>

#include "Theme.h"

namespace petrous::workstation
{

QString removedText(const scene::Case& value, bool drilling)
{
  if (value.applied() == 0)
    return drilling ? QObject::tr("drilling the first stroke") : QObject::tr("nothing drilled");
  const QString text =
      QObject::tr("%1 %2, %3 mm³ removed")
          .arg(value.applied())
          .arg(value.applied() == 1 ? QObject::tr("stroke") : QObject::tr("strokes"))
          .arg(value.removedVolume(), 0, 'f', 1);
  return drilling ? QObject::tr("%1, drilling").arg(text) : text;
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

QString sentence(const QString& text)
{
  static const QString ends(".!?…");
  return text.isEmpty() || ends.contains(text.back()) ? text : text + '.';
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
