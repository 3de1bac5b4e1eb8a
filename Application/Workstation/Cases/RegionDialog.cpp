#include "RegionDialog.h"

#include <algorithm>
#include <cmath>

#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "Bind.h"
#include "PanelLayout.h"
#include "PreviewBar.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Presenters/IntensityDisplay.h"

namespace petrous::workstation
{

namespace
{

constexpr double kReach = 7.0; // px, from an edge that is dragged
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

RegionView::RegionView(SliceOrientation orientation, QWidget* parent)
  : SliceView(orientation, parent)
{
  setToolTip(tr("Drag an edge of the box, or the box.  Outside it: move the crosshair.  Wheel: "
                "scroll."));
}

void RegionView::setBox(const core::PatientBox& box, const core::PatientBox& bounds)
{
  m_box = box;
  m_bounds = bounds;
  update();
}

Eigen::Vector3d RegionView::at(const QPointF& position) const
{
  return slice().patientFromPixel(position.x() - 0.5, position.y() - 0.5);
}

void RegionView::paintEvent(QPaintEvent* event)
{
  SliceView::paintEvent(event);
  if (m_box.isEmpty())
    return;
  const Eigen::Vector2d a = slice().pixelFromPatient(m_box.min());
  const Eigen::Vector2d b = slice().pixelFromPatient(m_box.max());
  const QRectF box =
      QRectF(QPointF(a[0], a[1]), QPointF(b[0], b[1])).normalized().translated(0.5, 0.5);
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  QPainterPath outside;
  outside.addRect(QRectF(rect()));
  outside.addRect(box);
  painter.fillPath(outside, QColor(0, 0, 0, 110));
  painter.setPen(QPen(QColor("#5ec8ff"), 1.5));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(box);
}

void RegionView::pick(const QPointF& position)
{
  m_lower = m_upper = {};
  const auto picture = slice();
  const Eigen::Vector3d here = at(position);
  const presenters::SliceAxes& axes = picture.axes();
  bool isEdge = false;
  bool isInside = true;
  for (std::size_t n = 0; n < 3; ++n)
  {
    const auto axis = static_cast<Eigen::Index>(n);
    if (std::abs(axes.next[axis]) > 0.5)
      continue;
    const double reach = kReach * picture.mmPerPixel();
    m_lower[n] = std::abs(here[axis] - m_box.min()[axis]) < reach;
    m_upper[n] = !m_lower[n] && std::abs(here[axis] - m_box.max()[axis]) < reach;
    isEdge = isEdge || m_lower[n] || m_upper[n];
    isInside = isInside && here[axis] > m_box.min()[axis] - reach &&
               here[axis] < m_box.max()[axis] + reach;
  }
  if (!isInside)
    m_lower = m_upper = {};
  else if (!isEdge)
    for (std::size_t n = 0; n < 3; ++n)
      m_lower[n] = m_upper[n] = std::abs(axes.next[static_cast<Eigen::Index>(n)]) < 0.5;
}

void RegionView::mousePressEvent(QMouseEvent* event)
{
  if (event->button() == Qt::LeftButton && !m_box.isEmpty())
  {
    pick(event->localPos());
    m_from = at(event->localPos());
    const auto any = [](const std::array<bool, 3>& sides)
    { return sides[0] || sides[1] || sides[2]; };
    if (any(m_lower) || any(m_upper))
      return;
  }
  SliceView::mousePressEvent(event);
}

void RegionView::mouseMoveEvent(QMouseEvent* event)
{
  const auto any = [](const std::array<bool, 3>& sides)
  { return sides[0] || sides[1] || sides[2]; };
  if (!(event->buttons() & Qt::LeftButton) || !(any(m_lower) || any(m_upper)))
    return SliceView::mouseMoveEvent(event);
  const Eigen::Vector3d to = at(event->localPos());
  core::PatientBox box = m_box;
  for (std::size_t n = 0; n < 3; ++n)
  {
    const auto axis = static_cast<Eigen::Index>(n);
    double step = to[axis] - m_from[axis];
    if (m_lower[n] && m_upper[n]) // moved as a whole, up to the bounds
      step = std::clamp(step, std::min(0.0, m_bounds.min()[axis] - box.min()[axis]),
                        std::max(0.0, m_bounds.max()[axis] - box.max()[axis]));
    if (m_lower[n])
      box.min()[axis] += step;
    if (m_upper[n])
      box.max()[axis] += step;
    if (m_lower[n] && !m_upper[n])
      box.min()[axis] = std::min(box.min()[axis], box.max()[axis] - kLeast);
    if (m_upper[n] && !m_lower[n])
      box.max()[axis] = std::max(box.max()[axis], box.min()[axis] + kLeast);
  }
  m_from = to;
  emit boxDragged(box);
}

void RegionView::mouseReleaseEvent(QMouseEvent* event)
{
  m_lower = m_upper = {};
  SliceView::mouseReleaseEvent(event);
}

RegionDialog::RegionDialog(const std::filesystem::path& path, const std::string& selector,
                           bool repair, const std::optional<bool>& assumeRas,
                           const std::optional<double>& unit, QWidget* parent)
  : QDialog(parent)
  , m_views{new RegionView(SliceOrientation::Axial), new RegionView(SliceOrientation::Coronal),
            new RegionView(SliceOrientation::Sagittal)}
  , m_size(new QLabel)
  , m_progress(new PreviewBar(*m_size))
  , m_reset(new QPushButton(tr("&Whole scan")))
{
  setObjectName("chooseRegion");
  setWindowTitle(tr("Region of the scan"));
  resizeOnScreen(*this, {1000, 560});
  auto* title = new QLabel(
      tr("Only what lies in the box is read: drag its edges, or give it in mm (patient LPS)."));
  wrapWords(*title);
  auto* views = new QHBoxLayout;
  views->setSpacing(3);
  for (RegionView* view : m_views)
  {
    views->addWidget(view, 1);
    connect(view, &RegionView::boxDragged, this, &RegionDialog::setBox);
    connect(view, &SliceView::crosshairMoved, this,
            [this](const Eigen::Vector3d& patient)
            {
              for (RegionView* each : m_views)
                each->setCrosshair(patient);
            });
    connect(view, &SliceView::greyWindowChanged, this,
            [this](const presenters::GreyWindow& window)
            {
              for (RegionView* each : m_views)
                each->setGreyWindow(window);
            });
  }
  auto* numbers = new QGridLayout;
  const QString axes[] = {tr("&x, to the left"), tr("&y, to the back"), tr("&z, to the head")};
  for (int axis = 0; axis < 3; ++axis)
  {
    auto* label = new QLabel(axes[axis]);
    numbers->addWidget(label, axis, 0);
    for (int end = 0; end < 2; ++end)
    {
      const QByteArray name = QString("%1%2").arg("xyz"[axis]).arg(end).toLatin1();
      QDoubleSpinBox* box = numberBox(name.constData(), {}, {0.0, 99.9, tr(" mm"), 1, 1.0});
      box->setEnabled(false);
      m_numbers[static_cast<std::size_t>(2 * axis + end)] = box;
      numbers->addWidget(box, axis, 1 + end);
      if (end == 0)
        label->setBuddy(box);
      connect(box, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
              [this, axis, end](double value)
              {
                core::PatientBox changed = m_box;
                (end == 0 ? changed.min() : changed.max())[axis] = value;
                setBox(changed);
              });
    }
  }
  numbers->setColumnStretch(3, 1);
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
  layout->addLayout(numbers);
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
  for (RegionView* view : m_views)
  {
    view->setPresenter(presenter, m_preview->grid);
    view->setIntensityDisplay(display);
    view->setGreyWindow(display.bone);
    view->setCrosshair(m_preview->grid.center());
  }
  const core::PatientBox bounds = m_preview->grid.patientBounds();
  for (std::size_t n = 0; n < 6; ++n)
  {
    const auto axis = static_cast<Eigen::Index>(n / 2);
    const QSignalBlocker blocker(m_numbers[n]);
    m_numbers[n]->setRange(bounds.min()[axis] - 0.05, bounds.max()[axis] + 0.05);
    m_numbers[n]->setEnabled(true);
  }
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
  for (RegionView* view : m_views)
    view->setBox(m_box, bounds);
  for (std::size_t n = 0; n < 6; ++n)
  {
    const QSignalBlocker blocker(m_numbers[n]);
    const auto axis = static_cast<Eigen::Index>(n / 2);
    m_numbers[n]->setValue(n % 2 == 0 ? m_box.min()[axis] : m_box.max()[axis]);
  }
  const std::size_t voxels = m_preview->voxelsIn(m_box);
  const std::size_t all = m_preview->grid.voxelCount();
  m_size->setText(tr("%1 × %2 × %3 mm: %4, of %5")
                      .arg(numberText(m_box.sizes()[0], 1))
                      .arg(numberText(m_box.sizes()[1], 1))
                      .arg(numberText(m_box.sizes()[2], 1))
                      .arg(sizeText(voxels, voxels * m_preview->bytesPerVoxel),
                           sizeText(all, all * m_preview->bytesPerVoxel)));
}

std::optional<core::PatientBox> RegionDialog::region() const
{
  if (!m_preview || m_preview->voxelsIn(m_box) == m_preview->grid.voxelCount())
    return std::nullopt;
  return m_box;
}

} // namespace petrous::workstation
