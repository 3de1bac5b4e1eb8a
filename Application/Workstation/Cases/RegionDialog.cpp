#include "RegionDialog.h"

#include <algorithm>
#include <cmath>

#include <QDialogButtonBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "BoxNumbers.h"
#include "PanelLayout.h"
#include "PreviewBar.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Presenters/IntensityDisplay.h"

namespace petrous::workstation
{

namespace
{

constexpr double kLeast = 2.0; // mm, of the box

using presenters::SliceOrientation;

QString sizeText(std::size_t voxels, std::size_t bytes)
{
  const double mb = static_cast<double>(bytes) / 1e6;
  return RegionDialog::tr("%1 million voxels, %2 MB")
      .arg(numberText(static_cast<double>(voxels) / 1e6, voxels < 10000000 ? 2 : 0))
      .arg(numberText(mb, mb < 10.0 ? 2 : 0));
}

} // namespace

RegionDialog::RegionDialog(const std::filesystem::path& path, const std::string& selector,
                           bool repair, const std::optional<bool>& assumeRas,
                           const std::optional<double>& unit, QWidget* parent,
                           const core::AxesCorrection& axes)
  : QDialog(parent)
  , m_views{new SliceView(SliceOrientation::Axial), new SliceView(SliceOrientation::Coronal),
            new SliceView(SliceOrientation::Sagittal)}
  , m_numbers(new BoxNumbers)
  , m_size(new QLabel)
  , m_progress(new PreviewBar(*m_size))
  , m_reset(new QPushButton(tr("&Whole scan")))
{
  setObjectName("chooseRegion");
  setWindowTitle(tr("Region of the scan"));
  resizeOnScreen(*this, {1000, 560});
  auto* title = new QLabel(
      axes.isIdentity()
          ? tr("Only what lies in the box is read: drag its edges, or give it in mm (patient LPS).")
          : tr("Only what lies in the box is read: drag its edges, or give it in mm (the file's "
               "LPS). The letters at the slices are the patient's, by the corrected axes."));
  wrapWords(*title);
  auto* views = new QHBoxLayout;
  views->setSpacing(3);
  for (SliceView* view : m_views)
  {
    view->setToolTip(tr("Drag an edge of the box, or the box.  Outside it: move the crosshair.  "
                        "Wheel: scroll."));
    view->setCorrection(axes);
    views->addWidget(view, 1);
    connect(view, &SliceView::boxTaken, this,
            [this](const presenters::BoxFaces& faces, const Eigen::Vector3d& patient)
            {
              m_faces = faces;
              m_from = patient;
              m_takenBox = m_box;
            });
    connect(view, &SliceView::boxDragged, this,
            [this](const Eigen::Vector3d& patient)
            {
              setBox(presenters::moved(m_takenBox, m_faces, patient - m_from,
                                       m_preview->grid.patientBounds(),
                                       Eigen::Vector3d::Constant(kLeast)));
            });
    connect(view, &SliceView::crosshairMoved, this,
            [this](const Eigen::Vector3d& patient)
            {
              for (SliceView* each : m_views)
                each->setCrosshair(patient);
            });
    connect(view, &SliceView::greyWindowChanged, this,
            [this](const presenters::GreyWindow& window)
            {
              for (SliceView* each : m_views)
                each->setGreyWindow(window);
            });
  }
  connect(m_numbers, &BoxNumbers::edited, this, &RegionDialog::setBox);
  m_size->setObjectName("regionSize");
  m_reset->setObjectName("wholeScan");
  m_reset->setEnabled(false);
  connect(m_reset, &QPushButton::clicked, this,
          [this] { setBox(m_preview->grid.patientBounds()); });
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Open | QDialogButtonBox::Cancel);
  buttons->addButton(m_reset, QDialogButtonBox::ActionRole);
  m_open = buttons->button(QDialogButtonBox::Open);
  m_open->setEnabled(false);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(title);
  layout->addLayout(views, 1);
  layout->addWidget(m_progress);
  layout->addWidget(m_numbers);
  layout->addWidget(m_size);
  layout->addWidget(buttons);

  m_progress->start(
      [path, selector, repair, assumeRas, unit](const core::Progress& progress)
      { return presenters::previewScan(path, selector, repair, progress, assumeRas, unit); },
      [this](std::shared_ptr<const presenters::ScanPreview> preview) { show(std::move(preview)); });
}

void RegionDialog::show(std::shared_ptr<const presenters::ScanPreview> preview)
{
  m_preview = std::move(preview);
  const auto display = presenters::displayOf(m_preview->value);
  const auto presenter = std::make_shared<const presenters::SlicePresenter>(m_preview->value);
  for (SliceView* view : m_views)
  {
    view->setPresenter(presenter, m_preview->grid);
    view->setIntensityDisplay(display);
    view->setGreyWindow(display.bone);
    view->setCrosshair(m_preview->grid.center());
  }
  const core::PatientBox bounds = m_preview->grid.patientBounds();
  m_numbers->setBounds(bounds);
  m_reset->setEnabled(true);
  m_open->setEnabled(true);
  setBox(bounds);
}

// Within the scan, and of some size.
void RegionDialog::setBox(core::PatientBox box)
{
  const core::PatientBox bounds = m_preview->grid.patientBounds();
  for (Eigen::Index a = 0; a < 3; ++a)
  {
    const double least = std::min(kLeast, bounds.sizes()[a]);
    box.min()[a] = std::clamp(box.min()[a], bounds.min()[a], bounds.max()[a] - least);
    box.max()[a] = std::clamp(box.max()[a], box.min()[a] + least, bounds.max()[a]);
  }
  m_box = box;
  for (SliceView* view : m_views)
    view->setBox(SliceBox{{m_box}, true, true});
  m_numbers->setBox(m_box);
  const std::size_t voxels = m_preview->voxelsIn(m_box);
  const std::size_t all = m_preview->grid.voxelCount();
  m_size->setText(tr("%1: %2, of %3")
                      .arg(boxSizeText(m_box.sizes()),
                           sizeText(voxels, voxels * m_preview->bytesPerVoxel),
                           sizeText(all, all * m_preview->bytesPerVoxel)));
}

std::optional<core::PatientBox> RegionDialog::region() const
{
  if (!m_preview || m_preview->voxelsIn(m_box) == m_preview->grid.voxelCount())
    return std::nullopt;
  return m_box;
}

} // namespace petrous::workstation
