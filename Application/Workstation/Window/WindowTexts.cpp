#include "WindowTexts.h"

#include <cmath>

#include <QCache>
#include <QDate>
#include <QFile>
#include <QObject>
#include <QRegularExpression>
#include <QStringList>

#include "Language.h"
#include "Theme.h"
#include "petrous/Imaging/FileFormats.h"
#include "petrous/Presenters/CaseNaming.h"
#include "petrous/Presenters/Phrasebook.h"
#include "petrous/Scene/PlainText.h"

namespace petrous::workstation
{

QString numberText(double value, int decimals)
{
  const double unit = std::pow(10.0, -decimals);
  const bool isZero = std::abs(value) < 0.5 * unit;
  const QString digits = numberLocale().toString(isZero ? 0.0 : value, 'f', decimals);
  return words(presenters::withGroupedDigits(bytes(digits)));
}

QString numberText(const std::string& text)
{
  QString shown = words(presenters::withGroupedDigits(text));
  const QChar point = numberLocale().decimalPoint();
  if (point == '.')
    return shown;
  static const QRegularExpression decimal("(?<=\\d)\\.(?=\\d)");
  return shown.replace(", ", "; ").replace(decimal, point);
}

QString boxSizeText(const Eigen::Vector3d& millimetres)
{
  return QString("%1 × %2 × %3 mm")
      .arg(numberText(millimetres[0], 1), numberText(millimetres[1], 1),
           numberText(millimetres[2], 1));
}

QString cutAwayText()
{
  return QObject::tr("The view is cut away there; nothing is drawn under the pointer.");
}

QString volumeText(double volume)
{
  const int decimals = volume < 100.0 ? 2 : volume < 10000.0 ? 1 : 0;
  return QObject::tr("%1 mm³").arg(numberText(volume, decimals));
}

QString shownName(const std::string& part)
{
  return words(presenters::shownName(part));
}

QString caseName(const std::string& name)
{
  return words(scene::withVisible(name));
}

QString listed(const std::vector<std::string>& names)
{
  QStringList list;
  for (const std::string& name : names)
    list += words(name);
  return list.join(", ");
}

QString approachName(const std::string& name)
{
  return name == dissection::History::kMain ? QObject::tr("main") : words(name);
}

QString patternsOf(unsigned contents)
{
  QStringList patterns;
  for (const std::string_view ending : imaging::readEndings(contents))
    patterns += "*" + words(std::string(ending));
  return patterns.join(' ');
}

QString durationText(double seconds)
{
  constexpr double kShown = 0.1; // s
  if (seconds < 60.0 - 0.5 * kShown)
    return QObject::tr("%1 s").arg(numberText(seconds, 1));
  const auto whole = static_cast<long long>(seconds + 0.5 * kShown);
  return QObject::tr("%1 min %2 s").arg(whole / 60).arg(whole % 60);
}

QString removedText(const scene::Case& value, bool drilling)
{
  if (value.applied() == 0)
    return drilling ? QObject::tr("drilling the first stroke") : QObject::tr("nothing drilled");
  const QString text =
      QObject::tr("%1 %2, %3 mm³ removed")
          .arg(value.applied())
          .arg(value.applied() == 1 ? QObject::tr("stroke") : QObject::tr("strokes"))
          .arg(numberText(value.removedVolume(), 1));
  const dissection::History& history = value.dissection.history();
  const QString where = history.branches().size() > 1
                            ? QObject::tr("%1: %2").arg(approachName(history.branch().name), text)
                            : text;
  return drilling ? QObject::tr("%1, drilling").arg(where) : where;
}

QString strokeText(const dissection::Stroke* stroke)
{
  if (!stroke)
    return QObject::tr("Nothing was cut");
  QString text = QObject::tr("Removed %1 mm³").arg(numberText(stroke->info.removed, 2));
  for (const auto& touched : stroke->info.structures)
    text += QObject::tr("  ·  %1 %2 mm³")
                .arg(shownName(touched.name))
                .arg(numberText(touched.volume, 2));
  return text;
}

namespace
{

struct Hint
{
  QRegularExpression command;
  QString window;
};

// What the command's sentences advise, and what the window's do instead.
const std::vector<Hint>& hints()
{
  struct Text
  {
    const char* command; ///< a regular expression
    const char* window;
  };
  static constexpr Text kTexts[] = {
      {"; NAME=FILE gives another name", "; F2 in the list gives it another name"},
      {"; give it another name with NAME=FILE", "; give it another name"},
      {"; give one with NAME=FILE", ""},
      {", or give one another name with NAME=FILE, or a number with --rename-taken",
       ", or give one another name"},
      {"; 'petrous scan' says what\\.", "."},
      {"; 'petrous scan' lists them, --series takes one\\.", "."},
      {": series [0-9.]+: ", ": "},
      {"\\b(gantry-tilt|missing-slice|uneven-spacing|duplicate-slice|side-by-side|odd-orientation|"
       "odd-size|mixed-rescale|modality-lut|mixed-patients|mixed-studies|mixed-acquisitions|"
       "no-geometry|localizer-mixed-in|missing-end|missing-between|multi-frame|not-an-image|"
       "unreadable): ",
       ""},
      {" \\(needs --repair\\)", " (needs repair)"},
      {" Give a series that 'petrous scan' finds ok\\.", ""},
      {" With --repair it is resampled to a straight volume\\.",
       " Opened alone, it can be repaired."},
      {"; what is drilled is this tissue, not bone\\. 'petrous appearance --iso' moves the surface",
       "; what is drilled is this tissue, not bone. Surface threshold (F9) moves the surface"},
      {"; 'petrous appearance --iso' moves the surface", "; Bone threshold (F9) moves the surface"},
      {" Build the case with --modality MR if it is an MR, --modality CT if it is not\\.",
       " If it is an MR, open it again and say so when you are asked."},
      {"; 'petrous library verify' lists (all that|what) is damaged", ""},
      {"; or go back to before it, which loses nothing: petrous undo '.*' [0-9]+$",
       "; or undo the strokes from it on, which loses nothing"},
      {"; give it another one \\(appearance --tissue\\)",
       "; give it another one (“The drill meets” in the list's menu, F9)"},
      {"; a DICOM segmentation is read as structures \\(--labels\\)",
       "; a DICOM segmentation is read as structures"},
      {"; state its coordinate system and unit \\(--mesh-frame, --mesh-unit\\)", ""},
      {"; --mesh-parts gives one of each",
       "; to have one of each, add it again with “One structure per object”"},
      {"; add it as one, without --mesh-parts", "; add it as one structure"},
      {"region of it \\(--roi\\)", "region of it"},
      {", or say --(ct|mr|labels)-frame ras \\(NIfTI's own\\) or lps \\(DICOM, ITK\\) if you know "
       "it",
       ""},
      {"; give its structures other names with NAME=FILE, which puts NAME before each, or numbers "
       "with --rename-taken(, or leave .* with --skip-taken)?",
       "; rename those of the case first (F2 in the list)"},
      {" Export it again with its unit, or say it with --(ct|mr|labels)-unit", ""},
      {", and say --other-patient if it is to be added all the same", ""},
      {"labels on the grid of the whole image lie on it only as FILE@.*\\.$",
       "when labels on the grid of the whole image are added, choose it as the one on which they "
       "were drawn."},
      {"say FILE@ct, or add", "add it again and choose “on the CT”, or add"},
      {"; say on which it was drawn with FILE@.* or FILE@.*$",
       "; add it again and choose the one on which it was drawn"},
      {"; remove it and add it again as FILE@MR",
       "; remove it, add it again and choose the one on which it was drawn"},
      {"; name one by --series.*$", ""},
      {"; give the restored one another name \\(--as NAME\\)", "; restore it under another name"},
      {"; choose another name with --as", "; rename that one first (F2 in the library panel)"},
      {"; see 'petrous nodes add --help'", ""},
      {"; see 'petrous nodes add --tls-(ca|cert)'", "; see Library > DICOM nodes"},
      {"; add it with --move-port", "; give it a port for C-MOVE (Library > DICOM nodes)"},
      {" \\(--(tls-name|move-host)\\)", " (Library > DICOM nodes)"},
      {" \\('petrous library copy'\\)", " (Copy in the library panel)"},
      {" \\('petrous library undelete'\\)", " (Bring back in the library panel)"},
      {"; export it alone with --part, or all on the (CT|MR)'s grid with --on-ct",
       "; export it alone, or all on the \\1's grid"},
      {"; register the MR first, or export it alone with --part",
       "; register the MR first (F5), or export it alone"},
      {"make it anew: petrous describe '.*' --thumbnail", "make it anew (Library > Draw pictures)"},
      {" \\('petrous attachments .* --remove[^)]*\\)", " (Attachments, F12)"},
      {" \\(--with-(documents|videos) takes it along\\)", " (a box of the dialog takes it along)"},
      {"; link it \\(--link\\)", "; attach it as a link"},
      {"name its series \\(--series, 'petrous scan' lists them\\)", "choose its series"},
      {", needs --repair\\)", ", needs repair)"},
      {"begin a case with it \\(petrous new --ct\\)", "begin a case with it (File > Open DICOM)"},
      {" \\((--replace|--roi|--bits stored|--bits allocated)\\)", ""},
      {"\\(--(mask-face|roi); (?:in the window|im Fenster): ([^)]*)\\)", "(\\2)"},
      {"\\bmm3\\b", "mm³"},
  };
  static const std::vector<Hint> kHints = []
  {
    std::vector<Hint> made;
    for (const Text& text : kTexts)
      made.push_back({QRegularExpression(text.command), QString::fromUtf8(text.window)});
    return made;
  }();
  return kHints;
}

QString translatedText(const QString& text)
{
  QString result = text;
  if (shownLanguage() == "de")
    result = words(presenters::germanPhrases().text(bytes(text)));
  for (const Hint& hint : hints())
    result.replace(hint.command, hint.window);
  return shownLanguage() == "de" ? words(presenters::withDecimalCommas(bytes(result))) : result;
}

} // namespace

// Panels ask for the same sentences at each change of the case.
QString windowText(const QString& text)
{
  if (text.isEmpty())
    return text;
  constexpr int kKept = 256;
  thread_local QCache<QString, QString> known(kKept);
  const QString key = shownLanguage() + '\n' + text;
  if (const QString* found = known.object(key))
    return *found;
  const QString result = translatedText(text);
  known.insert(key, new QString(result));
  return result;
}

QString phrase(const std::string& text)
{
  return windowText(words(text));
}

QString dateFormat()
{
  return shownLanguage() == "de" ? "dd.MM.yyyy" : "yyyy-MM-dd";
}

QString dateText(const std::string& iso)
{
  const QDate date = QDate::fromString(words(iso), Qt::ISODate);
  return date.isValid() ? date.toString(dateFormat()) : words(iso);
}

std::filesystem::path pathOf(const QString& file)
{
  return QFile::encodeName(file).toStdString();
}

QString capitalized(const QString& text)
{
  return text.left(1).toUpper() + text.mid(1);
}

QString withTimeLeft(const QString& text, const QString& left)
{
  return left.isEmpty() ? text : text + QString::fromUtf8(" · ") + left;
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
