#include "ShareDialogs.h"

#include <algorithm>
#include <cmath>

#include <QCheckBox>
#include <QComboBox>
#include <QDate>
#include <QDialogButtonBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFile>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>

#include "AskName.h"
#include "Language.h"
#include "PanelLayout.h"
#include "PathRow.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Presenters/CameraPaths.h"
#include "petrous/Presenters/FilmFile.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/StructureList.h"
#include "petrous/Rendering/PixelSamples.h"

namespace petrous::workstation
{

namespace
{

// In the user's folder, named after the case.
QString proposed(const scene::Case& value, const QString& what, const QString& ending)
{
  QString name = words(value.name) + ' ' + what + ending;
  name.replace('/', '_');
  return QDir::home().filePath(name);
}

// What a report lacks of the structures, or has where it was made, and why; as `petrous report`
// warns.
QStringList withheldFrom(const scene::Case& value, const std::vector<std::string>& leftOut)
{
  QStringList lines;
  for (const std::string& why : leftOut)
    lines += sentence(phrase(why));
  const std::vector<presenters::StructureRow> rows = presenters::structureRows(value);
  for (const presenters::StructureRow& row : rows)
    if (!row.missing.empty())
      lines += ReportDialog::tr("“%1” is left out, as it is nowhere on the %2: %3")
                   .arg(shownName(row.part), presenters::primaryName(value), phrase(row.missing));
    else if (!row.outdated.empty())
      lines += ReportDialog::tr("“%1” stays where it was made: %2")
                   .arg(shownName(row.part), phrase(row.outdated));
  return lines;
}

constexpr int kNoteLines = 3; // whatever stands in it, so that no change makes the dialog grow

QComboBox* backgroundBox(const char* name)
{
  auto* box = new QComboBox;
  box->setObjectName(name);
  box->addItem(ShareDialog::tr("As in the 3D view"));
  box->addItem(ShareDialog::tr("White"));
  box->setToolTip(ShareDialog::tr("White saves ink, and goes with the paper"));
  return box;
}

rendering::BackgroundColor chosenBackground(const QComboBox& box,
                                            const rendering::BackgroundColor& ofView)
{
  return box.currentIndex() == 1 ? rendering::BackgroundColor{1.0, 1.0, 1.0} : ofView;
}

} // namespace

ShareDialog::ShareDialog(const char* name, const QString& title, const QString& accept,
                         QWidget* parent)
  : QDialog(parent)
  , m_form(new QFormLayout)
  , m_note(new QLabel)
  , m_path(new PathRow(QByteArray(name).append("File").constData(), PathRow::Kind::NewFile, title))
  , m_advice(new QLabel)
{
  setObjectName(name);
  setWindowTitle(title);
  m_note->setObjectName("dim");
  m_note->setTextFormat(Qt::PlainText);
  wrapWords(*m_note, kNoteLines);
  m_advice->setObjectName("shareAdvice");
  m_advice->setStyleSheet(kWarningStyle);
  m_advice->setTextFormat(Qt::PlainText);
  wrapWords(*m_advice, 1);
  m_form->addRow(tr("&File:"), m_path);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  m_accept = buttons->addButton(accept, QDialogButtonBox::AcceptRole);
  m_accept->setObjectName("primary");
  m_accept->setDefault(true);
  connect(buttons, &QDialogButtonBox::accepted, this, &ShareDialog::askAndAccept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(m_path, &PathRow::changed, this, &ShareDialog::check);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(m_form);
  layout->addWidget(m_note);
  layout->addWidget(m_advice);
  layout->addStretch(1);
  layout->addWidget(buttons);
  resize(620, 260);
}

std::filesystem::path ShareDialog::file() const
{
  return m_path->path();
}

void ShareDialog::setFile(const QString& file)
{
  m_path->setText(file);
}

void ShareDialog::check()
{
  const QFileInfo target(m_path->text());
  QString advice;
  if (m_path->text().isEmpty() || target.isDir())
    advice = tr("Give the file a name.");
  else if (!target.absoluteDir().exists())
    advice = tr("There is no such folder.");
  else
    advice = problem();
  m_advice->setText(advice);
  m_accept->setEnabled(advice.isEmpty());
}

void ShareDialog::askAndAccept()
{
  if (mayReplace(*this, files()))
    accept();
}

ReportDialog::ReportDialog(const scene::Case& value, const rendering::BackgroundColor& ofView,
                           const std::vector<std::string>& leftOut, QWidget* parent)
  : ShareDialog("planReport", tr("Report of the plan"), tr("&Write the report"), parent)
  , m_approach(new QComboBox)
  , m_language(new QComboBox)
  , m_ofView(ofView)
  , m_background(backgroundBox("reportBackground"))
  , m_date(new QCheckBox(tr("with the &date of the planned operation")))
  , m_identity(new QCheckBox(tr("with &names and the note as typed, and who signed")))
{
  m_approach->setObjectName("reportApproach");
  const dissection::History& history = value.dissection.history();
  for (const auto& branch : history.branches())
  {
    m_approach->addItem(approachName(branch.name), words(branch.name));
    if (&branch == &history.branch())
      m_approach->setCurrentIndex(m_approach->count() - 1);
  }
  m_approach->setEnabled(m_approach->count() > 1);
  m_language->setObjectName("reportLanguage");
  m_language->addItem("English", static_cast<int>(presenters::ReportLanguage::English));
  m_language->addItem("Deutsch", static_cast<int>(presenters::ReportLanguage::German));
  m_language->setCurrentIndex(
      shownLanguage() == "de" || QLocale::system().language() == QLocale::German ? 1 : 0);
  m_date->setObjectName("reportDate");
  m_date->setEnabled(!value.description.date.empty());
  m_date->setChecked(m_date->isEnabled());
  m_date->setToolTip(tr("Who has the list of that day's operations knows the patient by it"));
  m_identity->setObjectName("reportIdentity");
  m_identity->setToolTip(
      tr("For a report that stays here. Otherwise a name that may tell who the patient is becomes "
         "a number"));
  m_form->addRow(tr("&Approach:"), m_approach);
  m_form->addRow(tr("&Language:"), m_language);
  m_form->addRow(tr("&Background:"), m_background);
  m_form->addRow(tr("What:"), m_date);
  m_form->addRow({}, m_identity);
  m_note->setText(tr("Pictures, slices at the key places, distances of the dissection, strokes, "
                     "measurements, structures, registration, and what was assumed at import. A "
                     "name that ends in .html writes one page for a browser."));
  if (const QStringList without = withheldFrom(value, leftOut); !without.isEmpty())
  {
    auto* label = new QLabel(without.join('\n'));
    label->setObjectName("reportWithout");
    label->setStyleSheet(kWarningStyle);
    label->setTextFormat(Qt::PlainText);
    wrapWords(*label);
    label->setToolTip(tr("The report says so, too"));
    m_form->addRow(tr("Without:"), label);
  }
  connect(m_identity, &QCheckBox::toggled, this, &ReportDialog::check);
  setFile(proposed(value, tr("plan"), ".pdf"));
}

bool ReportDialog::isPdf() const
{
  return scene::lowerCase(file().extension().string()) == ".pdf";
}

QString ReportDialog::problem() const
{
  return isPdf() || scene::lowerCase(file().extension().string()) == ".html"
             ? QString()
             : tr("Let the name end in .pdf or .html.");
}

presenters::ReportOptions ReportDialog::options() const
{
  presenters::ReportOptions options;
  options.approach = bytes(m_approach->currentData().toString());
  options.language = static_cast<presenters::ReportLanguage>(m_language->currentData().toInt());
  options.background = chosenBackground(*m_background, m_ofView);
  options.withDate = m_date->isChecked();
  options.keepIdentity = m_identity->isChecked();
  options.made = bytes(QDate::currentDate().toString(Qt::ISODate));
  options.version = PETROUS_VERSION;
  return options;
}

PrintDialog::PrintDialog(const scene::Case& value, double heightToWidth,
                         const rendering::BackgroundColor& ofView, QWidget* parent)
  : ShareDialog("printPicture", tr("Picture for print"), tr("&Write the picture"), parent)
  , m_heightToWidth(heightToWidth)
  , m_width(new QDoubleSpinBox)
  , m_dots(new QSpinBox)
  , m_samples(new QSpinBox)
  , m_ofView(ofView)
  , m_background(backgroundBox("printBackground"))
{
  m_width->setObjectName("printWidth");
  m_width->setRange(10.0, 1000.0);
  m_width->setDecimals(0);
  m_width->setSuffix(tr(" mm"));
  m_width->setValue(160.0);
  m_width->setToolTip(tr("On paper"));
  m_dots->setObjectName("printDots");
  m_dots->setRange(50, 1200);
  m_dots->setSingleStep(50);
  m_dots->setSuffix(tr(" dpi"));
  m_dots->setValue(300);
  m_dots->setToolTip(tr("Dots per inch: 300 for print, 600 for a journal's line art"));
  m_form->addRow(tr("W&idth:"), m_width);
  m_samples->setObjectName("printSamples");
  m_samples->setRange(1, rendering::kPixelSamples);
  m_samples->setSuffix(tr(" rays a pixel"));
  m_samples->setSpecialValueText(tr("1 ray a pixel")); // the least
  m_samples->setToolTip(tr("More smooth the edges and take as much longer"));
  m_form->addRow(tr("&Resolution:"), m_dots);
  m_form->addRow(tr("&Smoothness:"), m_samples);
  m_form->addRow(tr("&Background:"), m_background);
  connect(m_width, qOverload<double>(&QDoubleSpinBox::valueChanged), this, &PrintDialog::check);
  connect(m_dots, qOverload<int>(&QSpinBox::valueChanged), this, &PrintDialog::check);
  setFile(proposed(value, tr("view"), ".png"));
}

rendering::PrintSize PrintDialog::size() const
{
  rendering::PrintSize size;
  size.widthMillimetres = m_width->value();
  size.dotsPerInch = m_dots->value();
  size.heightToWidth = m_heightToWidth;
  return size;
}

int PrintDialog::samples() const
{
  return m_samples->value();
}

rendering::BackgroundColor PrintDialog::background() const
{
  return chosenBackground(*m_background, m_ofView);
}

QString PrintDialog::problem() const
{
  const rendering::PrintSize wanted = size();
  m_note->setText(tr("%1 x %2 pixels, of the 3D view with scale bar, side and the patient's "
                     "directions. Measurements, bone thickness and tool are left out.")
                      .arg(numberText(wanted.width(), 0), numberText(wanted.height(), 0)));
  if (std::max(wanted.width(), wanted.height()) > rendering::PrintSize::kMaxEdge)
    return tr("At most %1 pixels: choose a smaller width or resolution.")
        .arg(numberText(rendering::PrintSize::kMaxEdge, 0));
  if (scene::lowerCase(file().extension().string()) != ".png")
    return tr("Let the name end in .png.");
  return {};
}

FilmDialog::FilmDialog(const scene::Case& value, QWidget* parent)
  : ShareDialog("film", tr("Film"), tr("&Write the film"), parent)
  , m_path(new QComboBox)
  , m_frames(new QSpinBox)
{
  m_path->setObjectName("filmPath");
  m_path->addItem(tr("Once around the patient"), QString());
  for (const scene::LabelPart& part : value.labels)
    for (const scene::StructurePart& structure : part.structures)
      m_path->addItem(tr("Along “%1”").arg(shownName(structure.name)), words(structure.name));
  for (const scene::MeshPart& mesh : value.meshes)
    m_path->addItem(tr("Along “%1”").arg(shownName(mesh.name)), words(mesh.name));
  m_path->setToolTip(tr("A flight goes along the centre line of a canal or nerve, which is not "
                        "drawn then"));
  m_frames->setObjectName("filmFrames");
  m_frames->setRange(2, presenters::kMaxFrames);
  m_frames->setValue(180);
  m_frames->setToolTip(tr("25 a second in a video"));
  m_form->addRow(tr("&Camera:"), m_path);
  m_form->addRow(tr("F&rames:"), m_frames);
  m_note->setText(tr("A name that ends in .mp4 writes a video, in .png a picture for each frame."));
  setFile(proposed(value, tr("film"), presenters::videoRefusal().empty() ? ".mp4" : ".png"));
}

std::string FilmDialog::along() const
{
  return bytes(m_path->currentData().toString());
}

int FilmDialog::frames() const
{
  return m_frames->value();
}

QString FilmDialog::problem() const
{
  const std::string ending = scene::lowerCase(file().extension().string());
  if (ending == ".png")
    return {};
  if (ending != ".mp4")
    return tr("Let the name end in .mp4 or .png.");
  return presenters::videoRefusal().empty()
             ? QString()
             : tr("A video needs the program ffmpeg, which is not installed (Debian's package "
                  "ffmpeg). Let the name end in .png.");
}

std::vector<std::filesystem::path> FilmDialog::files() const
{
  const auto count = static_cast<std::size_t>(frames());
  auto all = presenters::filmFiles(file(), count);
  for (std::filesystem::path& beyond : presenters::framesBeyond(file(), count)) // they are removed
    all.push_back(std::move(beyond));
  return all;
}

} // namespace petrous::workstation
