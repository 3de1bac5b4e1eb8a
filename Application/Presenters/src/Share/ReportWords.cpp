#include "ReportWords.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "petrous/Presenters/Phrasebook.h"

namespace petrous::presenters
{

namespace
{

const std::map<std::string, std::string>& germanTexts()
{
  static const std::map<std::string, std::string> kTexts{
      {"Operation plan", "Operationsplan"},
      {"Case", "Fall"},
      {"Side", "Seite"},
      {"Planned for", "Geplant für"},
      {"Diagnosis", "Diagnose"},
      {"Procedure", "Eingriff"},
      {"Approach", "Zugang"},
      {"Note", "Notiz"},
      {"Image", "Bild"},
      {"Report of", "Bericht vom"},
      {"left", "links"},
      {"right", "rechts"},
      {"both sides", "beide Seiten"},
      {"not stated", "nicht angegeben"},
      {"Page %1 of %2", "Seite %1 von %2"},
      {"A plan, not a measurement of the patient: distances hold as far as the images and their "
       "registration do.",
       "Ein Plan, keine Messung am Patienten: Abstände gelten, soweit die Bilder und ihre "
       "Registrierung gelten."},
      {"Views", "Ansichten"},
      {"3D view as saved", "3D-Ansicht wie gespeichert"},
      {"Lateral view", "Ansicht von lateral"},
      {"Lateral view from the patient's left; the case does not tell which ear it is",
       "Ansicht von lateral, von der linken Seite des Patienten; der Fall sagt nicht, welches Ohr "
       "es ist"},
      {"Lateral view from the patient's right; the case does not tell which ear it is",
       "Ansicht von lateral, von der rechten Seite des Patienten; der Fall sagt nicht, welches Ohr "
       "es ist"},
      {"Cut away for the view, not drilled", "Für die Ansicht weggeschnitten, nicht gebohrt"},
      {"Only a part of the image is shown", "Nur ein Teil des Bildes wird gezeigt"},
      {"Surgical position, left ear", "Operationslage, linkes Ohr"},
      {"Surgical position, right ear", "Operationslage, rechtes Ohr"},
      {"Surgical position; the side is taken from where the image lies",
       "Operationslage; die Seite folgt aus der Lage des Bildes"},
      {"There are no 3D pictures: OpenGL is missing on this computer.",
       "Ohne 3D-Bilder: Auf diesem Rechner fehlt OpenGL."},
      {"Nothing of the case is shown in 3D.", "Nichts vom Fall wird in 3D gezeigt."},
      {"Distances of the dissection", "Abstände der Präparation"},
      {"Shortest distance between what was removed and the surface of each structure, "
       "nearest first. ± is a half-width: half a voxel of structure and wall, and the error of the "
       "registration where a structure was drawn on an MR.",
       "Kürzester Abstand zwischen dem Abgetragenen und der Oberfläche jeder Struktur, die "
       "nächste zuerst. ± ist eine halbe Breite: ein halbes Voxel von Struktur und Wand, dazu der "
       "Fehler der Registrierung, wo eine Struktur im MR gezeichnet wurde."},
      {"Nothing was drilled yet.", "Noch wurde nichts gebohrt."},
      {"Nothing was drilled on this approach.", "Auf diesem Zugang wurde nichts gebohrt."},
      {"The case has no structures to measure to.",
       "Der Fall hat keine Strukturen, zu denen gemessen werden könnte."},
      {"Left out:", "Ausgelassen:"},
      {"left out", "ausgelassen"},
      {"it is not stated on which MR it was drawn",
       "es ist nicht angegeben, in welchem MR sie gezeichnet wurde"},
      {"drawn on the MR '%1', which is not registered",
       "im MR '%1' gezeichnet, das nicht registriert ist"},
      {"drawn on the MR '%1', which is not in the case",
       "im MR '%1' gezeichnet, das nicht im Fall ist"},
      {"its data are missing or damaged in the library",
       "ihre Daten fehlen in der Bibliothek oder sind beschädigt"},
      {"it has no voxels", "sie hat keine Voxel"},
      {"a surface, which is not measured as a volume",
       "eine Oberfläche, die nicht als Volumen gemessen wird"},
      {"a note", "ein Vermerk"},
      {"Structure", "Struktur"},
      {"Distance", "Abstand"},
      {"Removed from it", "Davon abgetragen"},
      {"reached", "erreicht"},
      {"uncertainty unknown", "Unsicherheit unbekannt"},
      {"unknown", "unbekannt"},
      {"nothing", "nichts"},
      {"Nearest to structures", "Nächste Stellen an Strukturen"},
      {"The dissection comes near no structure that is warned of or kept from the drill.",
       "Die Präparation kommt keiner Struktur nahe, vor der gewarnt wird oder die vor der Fräse "
       "geschützt ist."},
      {"Each row has slices through the place of the cavity, marked by the cross, that is nearest "
       "to a structure. Structures are tinted and outlined, what was drilled is red and hatched; "
       "the line is the distance, in a plane that contains it.",
       "Jede Zeile hat Schichten durch die Stelle der Höhle, die einer Struktur am nächsten ist; "
       "das Kreuz zeigt sie. Strukturen sind getönt und umrandet, Gebohrtes ist rot und "
       "schraffiert; die Linie ist der Abstand, in einer Ebene, die ihn enthält."},
      {"Farther than %1 mm, and without slices: %2.",
       "Weiter als %1 mm entfernt und ohne Schichten: %2."},
      {"Only the first %1 have slices; without are: %2.",
       "Nur die ersten %1 haben Schichten; ohne sind: %2."},
      {"Along the distance", "Entlang des Abstands"},
      {"bone made translucent", "Knochen durchscheinend gemacht"},
      {"Guessed", "Geschätzt"},
      {"guessed:", "geschätzt:"},
      {"traced between points alone along %1 of %2 mm, as the image does not resolve it there",
       "auf %1 von %2 mm allein zwischen Punkten verfolgt, da das Bild sie dort nicht auflöst"},
      {"thinner than the voxels, and drawn one voxel wide in %1 of them",
       "dünner als die Voxel und in %1 von ihnen ein Voxel breit gezeichnet"},
      {"slices %1 of %2, in which it lies, are interpolated",
       "Schichten %1 von %2, in denen sie liegt, sind interpoliert"},
      {"Guessed at import of the %1, and distances with it",
       "Beim Import des %1 geschätzt, und damit auch Abstände"},
      {"Key places", "Wichtige Stellen"},
      {"mark", "Marke"},
      {"crosshair", "Fadenkreuz"},
      {"Axial", "Axial"},
      {"Coronal", "Koronar"},
      {"Sagittal", "Sagittal"},
      {"Each row has the three slices through a place, which the yellow cross marks.",
       "Jede Zeile hat die drei Schichten durch eine Stelle, die das gelbe Kreuz zeigt."},
      {"interpolated slice: not measured here", "interpolierte Schicht: hier nicht gemessen"},
      {"Approaches", "Zugänge"},
      {"Strokes", "Bohrzüge"},
      {"Drilling time", "Bohrzeit"},
      {"Removed", "Abgetragen"},
      {"Of structures", "Von Strukturen"},
      {"reported here", "hier berichtet"},
      {"Stroke", "Bohrzug"},
      {"Burr", "Fräse"},
      {"cutting", "schneidend"},
      {"diamond", "Diamant"},
      {"Set speed", "Eingestellte Drehzahl"},
      {"Mean speed", "Mittlere Drehzahl"},
      {"Highest speed", "Höchste Drehzahl"},
      {"Time", "Zeit"},
      {"All together", "Zusammen"},
      {"Measurements and marks", "Messungen und Marken"},
      {"Nothing was measured or marked.", "Nichts wurde gemessen oder markiert."},
      {"Name", "Name"},
      {"Kind", "Art"},
      {"Quantity", "Größe"},
      {"Value", "Wert"},
      {"Remark", "Bemerkung"},
      {"distance", "Abstand"},
      {"length", "Länge"},
      {"angle", "Winkel"},
      {"area", "Fläche"},
      {"thickness", "Dicke"},
      {"thickness along the normal", "Dicke entlang der Normalen"},
      {"shortest thickness", "kürzeste Dicke"},
      {"Structures", "Strukturen"},
      {"The case has no structures.", "Der Fall hat keine Strukturen."},
      {"Volume", "Volumen"},
      {"Thickness", "Dicke"},
      {"Voxel edge", "Voxelkante"},
      {"Resolved", "Aufgelöst"},
      {"yes", "ja"},
      {"Drawn on", "Gezeichnet auf"},
      {"Thickness: of the largest ball that fits inside, or of a tube at its narrowest. Resolved: "
       "this is two voxels or more, and its volume is known to a half. Of what is not, volume and "
       "distances say little; thin parts of what is may be missing.",
       "Dicke: der größten Kugel, die hineinpasst, oder eines Rohrs an seiner engsten Stelle. "
       "Aufgelöst: sie misst mindestens zwei Voxel, und das Volumen ist auf die Hälfte bekannt. "
       "Von "
       "anderem sagen Volumen und Abstände wenig; dünne Teile von Aufgelöstem können fehlen."},
      {"Registration", "Registrierung"},
      {"Verdict", "Urteil"},
      {"good", "gut"},
      {"doubtful", "zweifelhaft"},
      {"not judged", "nicht beurteilt"},
      {"not registered", "nicht registriert"},
      {"Method", "Verfahren"},
      {"Error, median", "Fehler, Median"},
      {"95 %", "95 %"},
      {"largest", "größter"},
      {"At", "Ort"},
      {"Signed off", "Freigegeben"},
      {"yes, by ", "ja, von "},
      {"no", "nein"},
      {"The case has no MR beside its primary image.",
       "Der Fall hat kein MR neben seinem Hauptbild."},
      {"mutual information", "Transinformation"},
      {"landmarks", "Landmarken"},
      {"by hand", "von Hand"},
      {"transform of a file", "Transformation aus einer Datei"},
      {"made from the MR %1", "aus dem MR %1 gemacht"},
      {"which lies elsewhere since: error unknown", "die seither anders liegt: Fehler unbekannt"},
      {"frame of reference", "Bezugssystem des Geräts"},
      {", refined by mutual information", ", verfeinert durch Transinformation"},
      {", through ", ", über "},
      {"Assumed at import", "Beim Import angenommen"},
      {"Nothing: images and structures are as their files have them.",
       "Nichts: Bilder und Strukturen sind, wie ihre Dateien sie haben."},
      {"What", "Was"},
      {"slices %1 of %2 interpolated between neighbours",
       "Schichten %1 von %2 zwischen Nachbarn interpoliert"},
      {"gantry tilt of %1 degrees undone, slices shifted by up to %2 mm",
       "Gantry-Neigung von %1 Grad rückgängig gemacht, Schichten um bis zu %2 mm verschoben"},
      {"slices shifted sideways by up to %1 mm", "Schichten um bis zu %1 mm seitlich verschoben"},
      {"compressed with loss", "verlustbehaftet komprimiert"},
      {"text in the pixels", "Text in den Pixeln"},
      {"perhaps text in the pixels", "vielleicht Text in den Pixeln"},
      {"face masked", "Gesicht maskiert"},
      {"face and auricles masked", "Gesicht und Ohrmuscheln maskiert"},
      {"cropped to a region", "auf einen Bereich beschnitten"},
      {"not known to be in the frame of reference of the image on which it is shown",
       "nicht bekannt, ob im Bezugssystem des Bildes, auf dem sie gezeigt wird"},
      {"withheld", "zurückgehalten"},
      {"structure", "Struktur"},
      {"measurement", "Messung"},
      {"approach", "Zugang"},
      {"main", "Hauptzugang"},
      {"in the focal plane", "in der Fokusebene"},
      {"Left side", "Linke Seite"},
      {"Right side", "Rechte Seite"},
      {"Both sides", "Beide Seiten"},
      {"Side not stated", "Seite nicht angegeben"},
      {"The side that is operated on is not stated.",
       "Die Seite der Operation ist nicht angegeben."},
      {"Only the first %1 of %2 are listed.", "Nur die ersten %1 von %2 sind aufgeführt."},
  };
  return kTexts;
}

bool isDigit(char c) noexcept
{
  return c >= '0' && c <= '9';
}

} // namespace

std::string reportText(ReportLanguage language, const std::string& english)
{
  if (language == ReportLanguage::English)
    return english;
  const auto found = germanTexts().find(english);
  return found == germanTexts().end() ? withDecimalCommas(germanPhrases().text(english))
                                      : found->second;
}

std::string reportNumber(ReportLanguage language, std::string text)
{
  if (language == ReportLanguage::German)
    for (std::size_t at = 1; at + 1 < text.size(); ++at)
      if (text[at] == '.' && isDigit(text[at - 1]) && isDigit(text[at + 1]))
        text[at] = ',';
  return withGroupedDigits(text);
}

std::string reportDate(ReportLanguage language, const std::string& date)
{
  constexpr std::string_view kForm = "dddd-dd-dd";
  const auto fits = [](char form, char c)
  { return form == 'd' ? c >= '0' && c <= '9' : c == form; };
  if (language == ReportLanguage::English || date.size() != kForm.size() ||
      !std::equal(kForm.begin(), kForm.end(), date.begin(), fits))
    return date;
  return date.substr(8, 2) + "." + date.substr(5, 2) + "." + date.substr(0, 4);
}

} // namespace petrous::presenters
