#include "SharePanel.h"

#include <QGroupBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "Bind.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::workstation
{

namespace
{

enum Column
{
  Name,
  As,
  Columns
};
constexpr int kWhat = Qt::UserRole;
constexpr int kPart = Qt::UserRole + 1;

QGroupBox* group(const QString& title, const std::vector<QWidget*>& widgets)
{
  auto* box = new QGroupBox(title);
  auto* layout = new QVBoxLayout(box);
  auto* row = new QHBoxLayout;
  for (QWidget* widget : widgets)
    row->addWidget(widget);
  row->addStretch(1);
  layout->addLayout(row);
  return box;
}

} // namespace

SharePanel::SharePanel(presenters::WorkstationModel& model, QWidget* parent)
  : Panel(parent)
  , m_model(model)
  , m_objects(new QTreeWidget)
{
  auto* report = button(tr("&Report…"), "shareReport",
                        tr("The plan as PDF or HTML: pictures, distances, strokes, measurements "
                           "(Ctrl+P)"));
  auto* picture = button(tr("&Picture…"), "sharePicture",
                         tr("The 3D view as a PNG for print, with scale bar and side"));
  auto* film = button(tr("&Film…"), "shareFilm",
                      tr("Once around the patient, or a flight along a canal or nerve"));
  m_objects->setObjectName("shareObjects");
  m_objects->setAccessibleName(tr("Objects of the case for other programs"));
  m_objects->setColumnCount(Columns);
  m_objects->setHeaderLabels({tr("Object"), tr("Written as")});
  m_objects->setRootIsDecorated(false);
  m_objects->setUniformRowHeights(true);
  m_objects->header()->setSectionResizeMode(Name, QHeaderView::Stretch);
  m_objects->header()->setSectionResizeMode(As, QHeaderView::ResizeToContents);
  m_objects->header()->setStretchLastSection(false);
  m_export = button(tr("&Export…"), "shareExport",
                    tr("The chosen object as a file for other programs (Return, double click)"));
  auto* archive = button(tr("Archi&ve…"), "shareArchive",
                         tr("The case in one file; what is in it, and what may tell who the "
                            "patient is, is shown before"));
  auto* send = button(tr("&Send to a node…"), "shareSend",
                      tr("To a DICOM node; what leaves is shown before"));
  m_ofCase = {report, picture, film, archive, send};

  auto* objects = new QGroupBox(tr("For other programs"));
  auto* list = new QVBoxLayout(objects);
  list->addWidget(m_objects, 1);
  auto* row = new QHBoxLayout;
  row->addWidget(m_export);
  row->addStretch(1);
  list->addLayout(row);
  auto* note =
      new QLabel(tr("Before the case leaves, a report says what is in it, what stays here, "
                    "and what may tell who the patient is."));
  note->setObjectName("dim");
  note->setWordWrap(true); // where it has room: the panel fits the smallest screen
  auto* whole = group(tr("The whole case"), {archive, send});
  static_cast<QVBoxLayout*>(whole->layout())->addWidget(note);

  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(10, 7, 10, 7);
  layout->addWidget(group(tr("To look at"), {report, picture, film}));
  layout->addWidget(objects, 1);
  layout->addWidget(whole);

  connect(report, &QPushButton::clicked, this, &SharePanel::reportAsked);
  connect(picture, &QPushButton::clicked, this, &SharePanel::pictureAsked);
  connect(film, &QPushButton::clicked, this, &SharePanel::filmAsked);
  connect(archive, &QPushButton::clicked, this, &SharePanel::archiveAsked);
  connect(send, &QPushButton::clicked, this, &SharePanel::sendAsked);
  connect(m_export, &QPushButton::clicked, this, &SharePanel::exportChosen);
  connect(m_objects, &QTreeWidget::itemActivated, this, &SharePanel::exportChosen);
  connect(m_objects, &QTreeWidget::itemSelectionChanged, this, &SharePanel::enable);
  caseChanged();
}

QWidget* SharePanel::mainControl()
{
  return m_objects;
}

void SharePanel::caseChanged()
{
  const QTreeWidgetItem* chosen = m_objects->currentItem();
  const QVariant what = chosen ? chosen->data(Name, kWhat) : QVariant();
  const QVariant part = chosen ? chosen->data(Name, kPart) : QVariant();
  m_objects->clear();
  const auto add =
      [&](const QString& name, const QString& as, const char* kind, const std::string& of = {})
  {
    auto* item = new QTreeWidgetItem(m_objects, {name, as});
    item->setData(Name, kWhat, kind);
    item->setData(Name, kPart, words(of));
    item->setToolTip(Name, name);
    if (item->data(Name, kWhat) == what && item->data(Name, kPart) == part)
      m_objects->setCurrentItem(item);
  };
  if (m_model.hasCase())
  {
    const scene::Case& value = m_model.value();
    const QString primary = presenters::primaryName(value);
    const QString voxels = tr("voxels, DICOM");
    const QString surface = tr("surface");
    add(primary, voxels, "ct");
    for (const scene::ImagePart& mr : value.mr)
      add(shownName(mr.name), voxels, "mr", mr.name);
    std::size_t structures = 0;
    for (const scene::LabelPart& one : value.labels)
      structures += one.structures.size();
    if (structures > 0)
      add(tr("All structures"), tr("labels, DICOM"), "labels");
    for (const scene::LabelPart& one : value.labels)
      for (const scene::StructurePart& structure : one.structures)
        add(shownName(structure.name), surface, "structure", structure.name);
    for (const scene::MeshPart& mesh : value.meshes)
      add(shownName(mesh.name), surface, "structure", mesh.name);
    add(tr("%1 after drilling").arg(primary), voxels, "dissected");
    add(tr("Bone after drilling"), surface, "surface");
    add(tr("What is left of each voxel"), tr("mask"), "mask");
  }
  for (QPushButton* one : m_ofCase)
    one->setEnabled(m_model.hasCase());
  enable();
}

void SharePanel::enable()
{
  m_export->setEnabled(m_objects->currentItem() != nullptr);
}

void SharePanel::exportChosen()
{
  if (const QTreeWidgetItem* item = m_objects->currentItem())
    emit exportAsked(item->data(Name, kWhat).toString(), item->data(Name, kPart).toString());
}

} // namespace petrous::workstation
