#include "ExportDialog.h"

#include <algorithm>

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QStorageInfo>
#include <QVBoxLayout>

#include "Application.h"
#include "AskName.h"
#include "PanelLayout.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Imaging/FileFormats.h"
#include "petrous/Presenters/IntensityDisplay.h"

namespace petrous::workstation
{

namespace
{

constexpr int kTriangleStep = 10000;
constexpr int kMostTriangles = 100000000;

// The table's data: a format's ending, or this for a folder of DICOM files.
const QString kSeries = QStringLiteral("/");

/// Of names that are another format's as well ("x.seg.nrrd"); empty: it can be written.
QString whyNoFile(const presenters::ExportOptions& options)
{
  try
  {
    presenters::exportedFiles(options);
    return {};
  }
  catch (const core::Error& error)
  {
    return toString(error);
  }
}

} // namespace

ExportDialog::ExportDialog(const scene::Case& value, const FaceCheck& faces,
                           const std::optional<Choices>& last, QWidget* parent)
  : QDialog(parent)
  , m_caseName(words(value.name))
  , m_what(new QComboBox)
  , m_part(new QComboBox)
  , m_format(new QComboBox)
  , m_onCt(new QCheckBox(value.ct.modality == scene::Modality::Mr
                             ? tr("Resampled on the &primary MR's grid")
                             : tr("Resampled on the &CT's grid")))
  , m_maskFace(new QCheckBox(tr("Put a&ir in place of the face")))
  , m_face(new QLabel)
  , m_triangles(new QSpinBox)
  , m_coordinates(new QLabel)
  , m_path(new QLineEdit)
  , m_advice(new QLabel)
{
  setObjectName("exportCase");
  setWindowTitle(tr("Export from “%1”").arg(m_caseName));
  for (const scene::ImagePart& mr : value.mr)
    m_mr.emplace_back(mr.name, mr.registered);
  for (const scene::LabelPart& part : value.labels)
    for (const scene::StructurePart& structure : part.structures)
      m_labels.push_back(structure.name);
  m_surfaces = m_labels;
  for (const scene::MeshPart& mesh : value.meshes)
    m_surfaces.push_back(mesh.name);

  m_what->setObjectName("exportWhat");
  const bool isOnMr = value.ct.modality == scene::Modality::Mr;
  const QString primary =
      isOnMr && !m_mr.empty() ? tr("MR of the case") : QString(presenters::primaryName(value));
  m_what->addItem(primary, "ct");
  m_what->addItem(tr("%1 after drilling").arg(primary), "dissected");
  if (!m_mr.empty())
    m_what->addItem(isOnMr ? tr("MR beside it") : tr("MR"), "mr");
  if (!m_labels.empty())
    m_what->addItem(tr("Structures as labels"), "labels");
  if (!m_surfaces.empty())
    m_what->addItem(tr("Surface of a structure"), "structure");
  m_what->addItem(isOnMr ? tr("Surface of the tissue after drilling")
                         : tr("Surface of the bone after drilling"),
                  "surface");
  m_what->addItem(tr("What is left of each voxel (mask)"), "mask");
  m_part->setObjectName("exportPart");
  m_format->setObjectName("exportFormat");
  m_onCt->setObjectName("exportOnCt");
  m_onCt->setToolTip(tr("Otherwise on its own grid"));
  m_maskFace->setObjectName("exportMaskFace");
  m_maskFace->setToolTip(tr("In front of a plane about 50 mm behind the tip of the nose. What is "
                            "segmented or drilled and the temporal bones stay; the case here does "
                            "not change"));
  m_face->setObjectName("exportFace");
  m_face->setTextFormat(Qt::PlainText);
  wrapWords(*m_face);
  m_hasFace = faces.mayHave();
  m_face->setText(textOf(faces));
  m_face->setVisible(m_hasFace);
  m_triangles->setObjectName("exportTriangles");
  m_triangles->setRange(0, kMostTriangles);
  m_triangles->setSingleStep(kTriangleStep);
  m_triangles->setGroupSeparatorShown(true);
  m_triangles->setSpecialValueText(tr("all"));
  m_triangles->setToolTip(tr("With fewer triangles than it has, how far the surface lies off is "
                             "stated in mm"));
  m_coordinates->setObjectName("exportCoordinates");
  m_coordinates->setTextFormat(Qt::PlainText);
  m_path->setObjectName("exportPath");
  m_path->setMinimumWidth(320);
  auto* browse = new QPushButton(tr("&Browse…"));
  browse->setAutoDefault(false);
  auto* place = new QHBoxLayout;
  place->addWidget(m_path, 1);
  place->addWidget(browse);
  m_advice->setObjectName("dim");
  m_advice->setTextFormat(Qt::PlainText);
  wrapWords(*m_advice);

  auto* form = new QFormLayout;
  form->addRow(tr("&What:"), m_what);
  form->addRow(tr("&Part:"), m_part);
  form->addRow(tr("&Format:"), m_format);
  form->addRow({}, m_onCt);
  form->addRow({}, m_maskFace);
  form->addRow({}, m_face);
  form->addRow(tr("At most triangle&s:"), m_triangles);
  form->addRow(tr("Coordinates:"), m_coordinates);
  form->addRow(tr("&To:"), place);
  static_cast<QLabel*>(form->labelForField(place))->setBuddy(m_path);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  m_accept = buttons->addButton(tr("&Export"), QDialogButtonBox::AcceptRole);
  m_accept->setObjectName("primary");
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(form);
  layout->addWidget(m_advice);
  layout->addWidget(buttons);

  connect(m_what, qOverload<int>(&QComboBox::currentIndexChanged), this,
          &ExportDialog::whatChanged);
  connect(m_part, qOverload<int>(&QComboBox::currentIndexChanged), this,
          &ExportDialog::formatChanged);
  connect(m_format, qOverload<int>(&QComboBox::currentIndexChanged), this,
          &ExportDialog::formatChanged);
  connect(m_path, &QLineEdit::textChanged, this, &ExportDialog::check);
  connect(browse, &QPushButton::clicked, this, &ExportDialog::browse);
  connect(buttons, &QDialogButtonBox::accepted, this, &ExportDialog::askAndAccept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  whatChanged();
  if (last)
    choose(*last);
}

void ExportDialog::choose(const Choices& last)
{
  const auto pick = [](QComboBox* box, const QString& wanted)
  {
    if (const int index = box->findData(wanted); index >= 0)
      box->setCurrentIndex(index);
  };
  pick(m_what, last.what);
  pick(m_part, last.part);
  pick(m_format, last.format);
  m_onCt->setChecked(last.onCt);
  m_triangles->setValue(last.triangles);
  m_maskFace->setChecked(last.maskFace);
  const QFileInfo file(last.path);
  if (QFileInfo(file.absolutePath()).isDir())
    m_path->setText(last.caseName == m_caseName
                        ? last.path
                        : QDir(file.absolutePath()).filePath(QFileInfo(m_path->text()).fileName()));
}

ExportDialog::Choices ExportDialog::choices() const
{
  return {m_caseName,
          m_what->currentData().toString(),
          m_part->currentData().toString(),
          m_format->currentData().toString(),
          QDir::cleanPath(m_path->text().trimmed()),
          m_onCt->isChecked(),
          m_triangles->value(),
          m_maskFace->isChecked()};
}

bool ExportDialog::isSeries() const
{
  return m_format->currentData().toString() == kSeries;
}

void ExportDialog::whatChanged()
{
  const std::string what = bytes(m_what->currentData().toString());
  const QSignalBlocker quietPart(m_part);
  const QSignalBlocker quietFormat(m_format);
  m_part->clear();
  if (what == "labels")
    m_part->addItem(tr("all structures"), QString());
  if (what == "mr")
    for (const auto& [name, registered] : m_mr)
      m_part->addItem(shownName(name), words(name));
  else if (what == "labels" || what == "structure")
    for (const std::string& name : what == "labels" ? m_labels : m_surfaces)
      m_part->addItem(shownName(name), words(name));
  m_part->setEnabled(m_part->count() > 0);
  m_format->clear();
  for (const std::string_view ending : imaging::writtenEndings(presenters::exportContent(what)))
  {
    const QString text = words(std::string(ending));
    const imaging::FileFormat* format = imaging::formatOf("x" + std::string(ending));
    m_format->addItem(QString("%1 (%2)").arg(words(std::string(format->name)), text), text);
  }
  if (what == "ct" || what == "mr" || what == "dissected")
    m_format->addItem(tr("DICOM series (a folder)"), kSeries);
  m_triangles->setEnabled(what == "surface" || what == "structure");
  m_maskFace->setEnabled(
      m_hasFace && (what == "ct" || what == "mr" || what == "dissected" || what == "surface"));
  formatChanged();
}

// The proposed name follows the choice; the folder is kept.
void ExportDialog::formatChanged()
{
  const QString what = m_what->currentData().toString();
  const std::string part = bytes(m_part->currentData().toString());
  bool canBeOnCt = what == "labels";
  for (const auto& [name, registered] : m_mr)
    canBeOnCt = canBeOnCt || (what == "mr" && name == part && registered);
  m_onCt->setEnabled(canBeOnCt);
  const QString folder = m_path->text().isEmpty()
                             ? QDir::homePath()
                             : QFileInfo(QDir::cleanPath(m_path->text())).absolutePath();
  QString name = m_caseName + ' ' + (part.empty() ? what : words(part));
  name.replace('/', '_');
  m_path->setText(
      QDir(folder).filePath(isSeries() ? name : name + m_format->currentData().toString()));
  m_coordinates->setText(phrase(presenters::coordinatesOf(options())));
  check();
}

presenters::ExportOptions ExportDialog::options() const
{
  presenters::ExportOptions options;
  options.what = bytes(m_what->currentData().toString());
  options.part = bytes(m_part->currentData().toString());
  options.out = pathOf(QDir::cleanPath(m_path->text().trimmed()));
  if (isSeries())
    options.out += '/';
  options.onCt = m_onCt->isEnabled() && m_onCt->isChecked();
  options.mask.face = m_maskFace->isEnabled() && m_maskFace->isChecked();
  if (m_triangles->isEnabled() && m_triangles->value() > 0)
    options.triangles = static_cast<std::size_t>(std::max(m_triangles->value(), 4));
  return options;
}

void ExportDialog::check()
{
  const QString path = m_path->text().trimmed();
  const QFileInfo folder(QFileInfo(QDir::cleanPath(path)).absolutePath());
  QString advice;
  bool isFine = false;
  if (path.isEmpty() || !QDir::isAbsolutePath(path))
    advice = tr("Give a file with its whole path, or choose one.");
  else if (!folder.isDir())
    advice = tr("There is no folder %1.").arg(folder.filePath());
  else if (!folder.isWritable())
    advice = tr("Nothing can be written in %1.").arg(folder.filePath());
  else if (!isSeries() && !path.endsWith(m_format->currentData().toString(), Qt::CaseInsensitive))
    advice = tr("The name must end in %1.").arg(m_format->currentData().toString());
  else if (const QString why = whyNoFile(options()); !why.isEmpty())
    advice = why;
  else
  {
    isFine = true;
    const QStorageInfo disk(folder.filePath());
    advice = tr("%1 GB are free there.")
                 .arg(numberText(1e-9 * static_cast<double>(disk.bytesAvailable()), 1));
  }
  m_advice->setText(advice);
  m_accept->setEnabled(isFine);
}

void ExportDialog::browse()
{
  QFileDialog dialog(this, windowTitle());
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setOption(QFileDialog::DontConfirmOverwrite); // asked when this dialog is accepted
  if (!isSeries())
    dialog.setNameFilter(
        QString("%1 (*%2)")
            .arg(m_format->currentText().section(" (", 0, 0), m_format->currentData().toString()));
  dialog.setDirectory(QFileInfo(m_path->text()).absolutePath());
  dialog.selectFile(QFileInfo(m_path->text()).fileName());
  if (const QString file = chosenFile(dialog); !file.isEmpty())
    m_path->setText(file);
}

void ExportDialog::askAndAccept()
{
  // A folder with files in it is refused.
  const auto files = isSeries() ? std::vector<std::string>() : presenters::exportedFiles(options());
  if (mayReplace(*this, {files.begin(), files.end()}))
    accept();
}

} // namespace petrous::workstation
