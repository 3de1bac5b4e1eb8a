#include "SliceView.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QScopedValueRollback>

#include "Language.h"
#include "SliceMarks.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Core/NumberText.h"

namespace petrous::workstation
{

namespace
{
using presenters::SliceOrientation;

constexpr double kHuPerPixel = 8.0;
constexpr double kMinHu = 10.0; // of a grey window
constexpr double kMaxZoom = 40.0;
constexpr int kMargin = 8;
constexpr double kClick = 3.0;        // pixels that a click may move
constexpr double kReadout = 0.68;     // of the width; the rest is the scale bar's
constexpr double kGap = 9.0;          // of the crosshair, pixels
constexpr double kSightMargin = 40.0; // pixels, of what is brought into sight
// Samples that are taken between two events: about 20 ms on two cores.
constexpr double kAtOnce = 4e6;
constexpr int kRefineAfter = 120; // ms without a change
constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kAlong = 0.7;     // cosine: a slice of the view is one of the grid
constexpr double kScaleBar = 0.28; // of the width, at most
const QColor kGuessed("#ff8c2b");  // interpolated slices

// With its text.
QRectF placeOfScaleBar(const QSize& view)
{
  constexpr double kHeight = 28.0; // px
  const double width = kScaleBar * view.width();
  return {view.width() - kMargin - width, view.height() - kMargin - kHeight, width, kHeight};
}
} // namespace

QString slabText(const presenters::Slab& slab)
{
  const QString name = slab.projection == presenters::Projection::Maximum   ? SliceView::tr("MIP")
                       : slab.projection == presenters::Projection::Minimum ? SliceView::tr("MinIP")
                                                                            : SliceView::tr("Mean");
  return SliceView::tr("%1 %2 mm").arg(name, numberText(core::plainText(slab.thickness)));
}

struct SliceView::EdgeText
{
  QPointF at; // where its baseline begins
  QString text;
  QColor color;
  QFont font;

  QRectF place() const
  {
    constexpr double kRim = 2.0; // px, of the halo
    return QFontMetricsF(font).boundingRect(text).translated(at).adjusted(-kRim, -kRim, kRim, kRim);
  }
};

SliceView::SliceView(SliceOrientation orientation, QWidget* parent)
  : QWidget(parent)
  , m_orientation(orientation)
{
  setObjectName(QString(presenters::nameOf(orientation)).toLower() + "View");
  setAccessibleName(QString(presenters::nameOf(orientation)) + " slice");
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setMinimumSize(140, 120);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setCursor(Qt::CrossCursor);
  m_refine.setSingleShot(true);
  connect(&m_refine, &QTimer::timeout, this, &SliceView::refine);
}

void SliceView::setPresenter(std::shared_ptr<const presenters::SlicePresenter> presenter,
                             const core::GridGeometry& grid)
{
  m_presenter = std::move(presenter);
  m_grid = grid;
  stale();
}

void SliceView::fit()
{
  m_zoom = 1.0;
  m_offset.setZero();
  stale();
}

void SliceView::frame(const core::PatientBox& box)
{
  constexpr double kMuchSmaller = 1.5;
  constexpr double kMargin = 1.1;
  if (!m_presenter || m_zoom != 1.0)
    return;
  const presenters::SliceGeometry whole = slice();
  const Eigen::Vector3d sizes = kMargin * box.sizes();
  const double mmPerPixel = std::max(sizes.dot(axes().right.cwiseAbs()) / whole.width(),
                                     sizes.dot(axes().down.cwiseAbs()) / whole.height());
  const double zoom = whole.mmPerPixel() / mmPerPixel;
  if (!(zoom >= kMuchSmaller))
    return;
  m_zoom = std::min(zoom, kMaxZoom);
  const Eigen::Vector3d off = box.center() - m_grid.patientBounds().center();
  m_offset = off - axes().next.dot(off) * axes().next;
  stale();
}

void SliceView::setPlane(const scene::ViewState::Slices::Plane& plane)
{
  m_zoom = std::clamp(plane.zoom, 1.0, kMaxZoom);
  m_offset = plane.offset;
  stale();
}

void SliceView::setPlanes(const presenters::SlicePlanes& planes)
{
  const presenters::SliceAxes before = axes();
  const bool keeps = m_presenter && m_zoom > 1.0;
  const Eigen::Vector2d crosshair =
      keeps ? slice().pixelFromPatient(m_crosshair) : Eigen::Vector2d::Zero();
  m_planes = planes;
  if (before.right != axes().right || before.down != axes().down)
  {
    // An offset of the former plane has a part across this one.
    m_offset -= axes().next.dot(m_offset) * axes().next;
    if (keeps)
      putCrosshairAt(crosshair);
    stale();
  }
  update(); // the others' lines
}

void SliceView::setSlab(const presenters::Slab& slab)
{
  if (slab == m_slab)
    return;
  m_slab = slab;
  stale();
}

void SliceView::setScale(double mmPerPixel)
{
  if (m_presenter && mmPerPixel > 0.0)
    applyZoom(m_zoom * slice().mmPerPixel() / mmPerPixel);
}

void SliceView::setCrosshair(const Eigen::Vector3d& patient)
{
  const Eigen::Vector3d next = axes().next;
  const Eigen::Vector3d step = patient - m_crosshair;
  const double across = next.dot(step);
  if (std::abs(across) > 1e-9)
    stale();
  m_crosshair = patient;
  if ((step - across * next).norm() > 1e-9 && !m_pointing)
    revealCrosshair();
  update();
}

void SliceView::revealCrosshair()
{
  m_reveals = true;
  update();
}

// By the least that the crosshair is seen, away from the edge.
void SliceView::pan()
{
  if (!std::exchange(m_reveals, false) || !m_presenter)
    return;
  const Eigen::Vector2d at = slice().pixelFromPatient(m_crosshair);
  const Eigen::Vector2d size(width(), height());
  const Eigen::Vector2d margin = (size / 4.0).cwiseMin(kSightMargin);
  if ((at.array() >= -0.5).all() && (at.array() <= size.array() - 0.5).all())
    return;
  putCrosshairAt(at.cwiseMax(margin).cwiseMin(size - margin));
  stale();
}

void SliceView::setGreyWindow(const presenters::GreyWindow& window)
{
  m_window = window;
  recolour();
}

void SliceView::setIntensityDisplay(const presenters::IntensityDisplay& display)
{
  m_display = display;
  update();
}

void SliceView::setOverlay(std::shared_ptr<const presenters::SliceOverlay> overlay,
                           const std::optional<presenters::IntensityDisplay>& alone)
{
  if (!overlay && !m_overlay)
    return;
  m_overlay = std::move(overlay);
  m_overlayAlone = alone;
  stale();
  if (m_pointer && m_presenter) // another image lies under it now
    emit pointed(pointedAt(*m_pointer));
}

const presenters::GreyWindow& SliceView::seenWindow() const
{
  return m_overlay && m_overlayAlone ? m_overlay->window : m_window;
}

const presenters::IntensityDisplay& SliceView::intensityDisplay() const
{
  return m_overlay && m_overlayAlone ? *m_overlayAlone : m_display;
}

void SliceView::setNotice(const QString& text)
{
  m_notice = text;
  update();
}

void SliceView::setCovered(int pixels)
{
  if (pixels == std::exchange(m_covered, pixels))
    return;
  update();
}

void SliceView::setMarks(std::vector<SliceMark> marks)
{
  m_marks = std::move(marks);
  update();
}

void SliceView::setInterpolated(std::vector<volume::SliceRange> slices)
{
  m_interpolated = std::move(slices);
  update();
}

void SliceView::setRegion(double edge)
{
  m_region = edge;
  update();
}

void SliceView::setReadout(const QString& text)
{
  m_readout = text;
  update();
}

void SliceView::maskChanged(const core::PatientBox& box)
{
  const Eigen::Vector3d next = axes().next;
  if (std::abs(next.dot(m_crosshair - box.center())) <= 0.5 * next.cwiseAbs().dot(box.sizes()))
    recolour();
}

void SliceView::setTool(const std::optional<SliceTool>& tool)
{
  if (m_toolDown && !tool)
  {
    m_toolDown = false;
    emit toolReleased();
  }
  m_tool = tool;
  update();
}

void SliceView::setDrawing(SliceDrawing drawing)
{
  m_drawing = std::move(drawing);
  update();
}

void SliceView::setDraft(std::shared_ptr<const presenters::DraftLayer> draft)
{
  if (!draft && !m_draft)
    return;
  m_draft = std::move(draft);
  recolour();
}

void SliceView::setDifference(std::shared_ptr<const presenters::DraftLayer> difference)
{
  if (!difference && !m_difference)
    return;
  m_difference = std::move(difference);
  recolour();
}

void SliceView::draftChanged(const core::PatientBox& box)
{
  maskChanged(box);
}

void SliceView::stale()
{
  m_stale = true;
  m_sampling.reset();
  m_refine.stop();
  update();
}

void SliceView::recolour()
{
  m_isPale = true;
  update();
}

double SliceView::samplesOf(const presenters::SliceGeometry& picture) const
{
  const auto& image = m_presenter->image();
  const double pixels = static_cast<double>(picture.width()) * picture.height();
  return !image || !(m_slab.thickness > 0.0)
             ? pixels
             : pixels * (m_overlay ? 2.0 : 1.0) *
                   static_cast<double>(
                       presenters::slabNodes(image->geometry(), picture, {}, m_slab.thickness)
                           .size());
}

// In the screen's own pixels, which are finer than Qt's, unless those are too many to be drawn at
// once.
presenters::SliceGeometry SliceView::sharpSlice() const
{
  const auto picture = slice();
  const double most = kAtOnce / (static_cast<double>(picture.width()) * picture.height());
  const double ratio = std::min(devicePixelRatioF(), std::sqrt(most));
  if (!(ratio > 1.0))
    return picture;
  const auto finer = [ratio](int size) { return static_cast<int>(std::ceil(ratio * size)); };
  return {picture.orientation(),        picture.axes(),         picture.center(),
          picture.mmPerPixel() / ratio, finer(picture.width()), finer(picture.height())};
}

// Pixels so large that a picture is drawn at once.
void SliceView::drawCoarse()
{
  const auto whole = sharpSlice();
  const double samples = samplesOf(whole);
  const int edge = m_slab.thickness > 0.0 && m_presenter->image()
                       ? static_cast<int>(std::ceil(std::sqrt(std::max(samples / kAtOnce, 1.0))))
                       : 1;
  const auto part = [edge](int size) { return (size + edge - 1) / edge; };
  const presenters::SliceGeometry picture(whole.orientation(), whole.axes(), whole.center(),
                                          edge * whole.mmPerPixel(), part(whole.width()),
                                          part(whole.height()));
  m_drawn = Drawn{picture, m_presenter->sample(picture, m_overlay.get(), m_slab)};
  m_stale = false;
  m_isPale = true;
  if (edge == 1)
    return;
  m_sampling = Sampling{
      whole, std::make_unique<presenters::SlabSampling>(m_presenter->image(), whole, m_slab),
      m_overlay && m_overlay->mr ? std::make_unique<presenters::SlabSampling>(
                                       m_overlay->mr, whole, m_slab, m_overlay->mrFromCt)
                                 : nullptr};
  m_refine.start(kRefineAfter);
}

// Given up by whatever makes the picture stale.
void SliceView::refine()
{
  if (!m_sampling)
    return;
  const auto advance = [](presenters::SlabSampling* sampling)
  {
    if (!sampling || sampling->isDone())
      return false;
    sampling->advance(std::max(1, static_cast<int>(kAtOnce / sampling->samplesPerRow())));
    return true;
  };
  if (advance(m_sampling->ct.get()) || advance(m_sampling->mr.get()))
    return m_refine.start(0);
  m_drawn = Drawn{m_sampling->picture, {m_sampling->ct->take(), std::nullopt}};
  if (m_sampling->mr)
    m_drawn->samples.mr = m_sampling->mr->take();
  m_sampling.reset();
  recolour();
}

void SliceView::draw()
{
  const presenters::SliceGeometry& picture = m_drawn->picture;
  auto pixels = m_presenter->draw(picture, m_window, m_overlay.get(), m_drawn->samples);
  if (m_difference)
    m_difference->paint(picture, pixels);
  if (m_draft)
    m_draft->paint(picture, pixels);
  m_image = QImage(pixels.rgb.data(), pixels.width, pixels.height, 3 * pixels.width,
                   QImage::Format_RGB888)
                .copy();
  const double edge = picture.mmPerPixel() / slice().mmPerPixel();
  const QSizeF size(edge * picture.width(), edge * picture.height());
  m_imageRect =
      QRectF(QPointF(0.5 * (width() - size.width()), 0.5 * (height() - size.height())), size);
  m_isPale = false;
}

presenters::SliceGeometry SliceView::slice() const
{
  return presenters::zoomed(presenters::SliceGeometry::fitting(m_orientation, axes(), m_grid,
                                                               m_crosshair, std::max(width(), 1),
                                                               std::max(height(), 1)),
                            m_zoom, m_offset);
}

Eigen::Vector3d SliceView::patientAt(const QPointF& position) const
{
  return slice().patientFromPixel(position.x() - 0.5, position.y() - 0.5);
}

// Of the pixel under the pointer, in the image that is measured in (SliceColumn::mrAlone).
Eigen::Vector3d SliceView::shownAt(const QPointF& position) const
{
  const Eigen::Vector3d inSlice = patientAt(position);
  const bool isMr = m_overlay && m_overlay->mr && m_overlayAlone;
  const auto& image = isMr ? m_overlay->mr : m_presenter->image();
  if (!image)
    return inSlice;
  const Eigen::Vector2d pixel(std::floor(position.x()), std::floor(position.y()));
  return inSlice + presenters::shownDepth(*image, slice(), m_slab, pixel,
                                          isMr ? m_overlay->mrFromCt : core::RigidTransform()) *
                       axes().next;
}

Eigen::Vector3d SliceView::pointedAt(const QPointF& position) const
{
  return m_tool && m_tool->measures ? shownAt(position) : patientAt(position);
}

double SliceView::shownReach() const
{
  return m_slab.projection == presenters::Projection::Mean ? 0.0 : 0.5 * m_slab.thickness;
}

void SliceView::paintEvent(QPaintEvent*)
{
  QPainter painter(this);
  painter.fillRect(rect(), QColor("#0b0d10"));
  if (!m_presenter)
    return;
  pan();
  const auto picture = slice();
  if (m_stale || !m_drawn)
    drawCoarse();
  if (m_isPale)
    draw();
  const QSizeF onScreen = devicePixelRatioF() * m_imageRect.size();
  painter.setRenderHint(QPainter::SmoothPixmapTransform, m_image.size() != onScreen.toSize());
  painter.drawImage(m_imageRect, m_image);
  painter.setRenderHint(QPainter::Antialiasing);
  if (m_region > 0.0)
    paintCube(painter, m_region, picture, m_crosshair);
  paintMarks(painter, m_marks, picture, m_crosshair);
  paintCurve(painter, m_drawing.curve, m_drawing.color, picture, m_crosshair);
  paintMarks(painter, m_drawing.marks, picture, m_crosshair);
  paintInterpolated(painter);
  paintCrosshair(painter);
  for (const SliceCut& cut : m_cuts)
    paintCut(painter, cut.plane, picture);
  const std::vector<EdgeText> texts = edgeTexts(painter.font());
  std::vector<QRectF> taken{placeOfScaleBar(size())};
  for (const EdgeText& one : texts)
    taken.push_back(one.place());
  for (const QWidget* badge : findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly))
    if (!badge->isHidden())
      taken.emplace_back(badge->geometry());
  if (m_box)
    taken.push_back(paintBox(painter, m_box->handled, m_box->dims, picture, taken));
  paintCutReading(painter, taken);
  paintMeasures(painter, m_measures, picture, m_crosshair, shownReach(), std::move(taken));
  QFont font = painter.font();
  font.setPixelSize(12);
  for (const EdgeText& one : texts)
  {
    painter.setFont(one.font);
    drawText(painter, one.at, one.text, one.color);
  }
  painter.setFont(font);
  paintScaleBar(painter);
  paintTool(painter);
  if (hasFocus())
  {
    QPen frame(planeColor(m_orientation), 2.0);
    frame.setJoinStyle(Qt::MiterJoin);
    painter.setPen(frame);
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(QRectF(rect()).adjusted(1.0, 1.0, -1.0, -1.0));
  }
}

void SliceView::paintCrosshair(QPainter& painter) const
{
  const Eigen::Vector2d at = slice().pixelFromPatient(m_crosshair) + Eigen::Vector2d(0.5, 0.5);
  const double reach = width() + height() + std::abs(at[0]) + std::abs(at[1]);
  for (const SliceOrientation other :
       {SliceOrientation::Axial, SliceOrientation::Coronal, SliceOrientation::Sagittal})
  {
    if (other == m_orientation)
      continue;
    const Eigen::Vector3d line = axes().next.cross(m_planes.axes(other).next);
    const Eigen::Vector2d along =
        Eigen::Vector2d(line.dot(axes().right), line.dot(axes().down)).normalized();
    QColor color = planeColor(other);
    color.setAlpha(190);
    painter.setPen(QPen(color, 1.0));
    for (const double side : {-1.0, 1.0})
    {
      const Eigen::Vector2d from = at + side * kGap * along;
      const Eigen::Vector2d to = at + side * reach * along;
      painter.drawLine(QPointF(from[0], from[1]), QPointF(to[0], to[1]));
    }
  }
}

// Whether the slice under the crosshair was interpolated when the scan was repaired.
bool SliceView::showsInterpolated() const
{
  const int slice = static_cast<int>(std::lround(m_grid.voxelFromPatient(m_crosshair)[2]));
  return volume::contains(m_interpolated, slice);
}

// An edge around the view if it shows such a slice itself, and bands where it crosses them.
void SliceView::paintInterpolated(QPainter& painter) const
{
  if (m_interpolated.empty())
    return;
  const Eigen::Vector3d next = axes().next;
  const Eigen::Matrix3d& axes = m_grid.direction();
  if (std::abs(axes.col(2).dot(next)) > kAlong)
  {
    if (!showsInterpolated())
      return;
    painter.setPen(QPen(kGuessed, 5.0));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(QRectF(rect()).adjusted(2.5, 2.5, -2.5, -2.5));
    return;
  }
  if (m_planes.isTurned(m_orientation))
    return; // the bands would be wrong; the text under the crosshair is not
  const Eigen::Index along =
      std::abs(axes.col(0).dot(next)) < std::abs(axes.col(1).dot(next)) ? 0 : 1;
  const auto picture = slice();
  const auto at = [&](double end, double k)
  {
    Eigen::Vector3d voxel = m_grid.voxelFromPatient(m_grid.center());
    voxel[along] = end * (m_grid.dims()[static_cast<std::size_t>(along)] - 1);
    voxel[2] = k;
    const Eigen::Vector2d pixel = picture.pixelFromPatient(m_grid.patientFromVoxel(voxel));
    return QPointF(pixel[0] + 0.5, pixel[1] + 0.5);
  };
  QColor fill = kGuessed;
  fill.setAlpha(50);
  QColor edge = kGuessed;
  edge.setAlpha(170);
  painter.setPen(QPen(edge, 1.0));
  painter.setBrush(fill);
  for (const volume::SliceRange& range : m_interpolated)
  {
    const double from = range.first - 0.5;
    const double to = range.last + 0.5;
    painter.drawPolygon(QPolygonF({at(0.0, from), at(1.0, from), at(1.0, to), at(0.0, to)}));
  }
}

std::vector<SliceView::EdgeText> SliceView::edgeTexts(const QFont& base) const
{
  std::vector<EdgeText> texts;
  QFont font = base;
  const auto add = [&](const QPointF& at, const QString& text, const QColor& color)
  {
    if (!text.isEmpty())
      texts.push_back({at, text, color, font});
  };
  font.setPixelSize(15);
  font.setBold(true);
  const QFontMetricsF metrics(font);
  const QColor color("#f2f5f8");
  const presenters::SliceGeometry seen = slice();
  const Eigen::Matrix3d toPatient = m_correction.matrix();
  const presenters::SliceAxes directions{
      toPatient * seen.axes().right, toPatient * seen.axes().down, toPatient * seen.axes().next};
  const auto letters = presenters::SliceGeometry(m_orientation, directions, seen.center(),
                                                 seen.mmPerPixel(), seen.width(), seen.height())
                           .edgeLetters();
  const double top = m_covered + kMargin;
  const double middle = 0.5 * height() + 0.35 * metrics.ascent();
  const auto letter = [](const std::string& text) { return words(text); };
  add({double(kMargin), middle}, letter(letters.left), color);
  const double right = width() - kMargin - metrics.horizontalAdvance(letter(letters.right));
  add({right, middle}, letter(letters.right), color);
  const double across = 0.5 * (width() - metrics.horizontalAdvance(letter(letters.top)));
  add({across, top + metrics.ascent()}, letter(letters.top), color);
  add({across, double(height() - kMargin)}, letter(letters.bottom), color);

  font.setPixelSize(12);
  QString name = phrase(m_planes.name(m_orientation));
  if (m_slab.thickness > 0.0)
    name += "  " + slabText(m_slab);
  add({double(kMargin), top + 11.0}, name, planeColor(m_orientation));
  font.setBold(false);
  const QFontMetricsF small(font);
  const double whole = width() - 2.0 * kMargin;
  add({double(kMargin), top + 27.0}, small.elidedText(m_notice, Qt::ElideMiddle, whole),
      QColor("#f0a04d"));
  if (showsInterpolated())
    add({double(kMargin), top + 43.0},
        small.elidedText(tr("interpolated slice: not measured here"), Qt::ElideRight, whole),
        kGuessed);
  // Above the letter where it is too long to stand beside it, and always left of the scale bar.
  const bool beside = small.horizontalAdvance(m_readout) <= across - 2.0 * kMargin;
  add({double(kMargin), height() - kMargin - (beside ? 0.0 : 1.4 * small.height())},
      small.elidedText(m_readout, Qt::ElideMiddle, kReadout * whole), color);
  if (underMouse())
  {
    const QString grey = QString("W %1  L %2")
                             .arg(numberText(intensityDisplay().number(seenWindow().width)),
                                  numberText(intensityDisplay().number(seenWindow().level)));
    add({width() - kMargin - small.horizontalAdvance(grey), top + 11.0}, grey, QColor("#b6c0ca"));
  }
  return texts;
}

void SliceView::paintScaleBar(QPainter& painter) const
{
  const auto picture = slice();
  const double length = presenters::scaleBarLength(kScaleBar * width() * picture.mmPerPixel());
  if (length <= 0.0)
    return;
  const double pixels = length / picture.mmPerPixel();
  const double right = width() - kMargin - 1.0;
  const double bottom = height() - kMargin - 1.0;
  QPainterPath bar;
  bar.moveTo(right - pixels, bottom - 5.0);
  bar.lineTo(right - pixels, bottom);
  bar.lineTo(right, bottom);
  bar.lineTo(right, bottom - 5.0);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(QColor(0, 0, 0, 200), 3.5));
  painter.drawPath(bar);
  painter.setPen(QPen(QColor("#f2f5f8"), 1.5));
  painter.drawPath(bar);
  const QString text = QString("%1 mm").arg(numberLocale().toString(length));
  const double at = right - 0.5 * (pixels + QFontMetricsF(painter.font()).horizontalAdvance(text));
  drawText(painter, {at, bottom - 8.0}, text, QColor("#f2f5f8"));
}

void SliceView::paintTool(QPainter& painter) const
{
  if (!m_tool || !m_pointer || m_tool->radius <= 0.0)
    return;
  const double radius = m_tool->radius / slice().mmPerPixel();
  painter.setBrush(Qt::NoBrush);
  for (const auto& pen : {QPen(QColor(0, 0, 0, 200), 3.0), QPen(m_tool->color, 1.5)})
  {
    painter.setPen(pen);
    painter.drawEllipse(*m_pointer, radius, radius);
  }
}

void SliceView::resizeEvent(QResizeEvent*)
{
  stale();
}

void SliceView::mousePressEvent(QMouseEvent* event)
{
  setFocus(Qt::MouseFocusReason);
  m_dragged = event->localPos();
  m_mayMenu = m_presenter && event->button() == Qt::RightButton;
  if (!m_presenter || event->button() != Qt::LeftButton)
    return;
  const auto handle = handleAt(event->localPos());
  if (handle && !(event->modifiers() & (Qt::ShiftModifier | Qt::ControlModifier)))
  {
    m_handleDown = true;
    m_pressed = event->localPos();
    emit handleTaken(handle->measurement, handle->point);
  }
  else if (event->modifiers() & Qt::ControlModifier)
    m_turning = true;
  else if (takeBox(event->localPos(), event->modifiers() & Qt::ShiftModifier))
    return;
  else if (event->modifiers() == Qt::NoModifier && takeCut(event->localPos()))
    return;
  else if (m_tool && !(event->modifiers() & Qt::ShiftModifier))
  {
    m_toolDown = true;
    emit toolPressed(pointedAt(event->localPos()), m_orientation);
  }
  else
    pointCrosshair(event->localPos());
}

// A tool's clicks may follow each other fast.
void SliceView::mouseDoubleClickEvent(QMouseEvent* event)
{
  const bool isTools = m_tool && !(event->modifiers() & Qt::ShiftModifier);
  const bool turns = event->modifiers() & Qt::ControlModifier;
  if (event->button() == Qt::LeftButton && !isTools && !turns)
    return facesAt(event->localPos()).any() ? emit boxResetAsked()
                                            : emit enlargeAsked(m_orientation);
  // A point of a measurement was set by the first click already.
  if (isTools && !turns && m_tool->measures && event->button() == Qt::LeftButton)
    return emit toolDoubleClicked();
  mousePressEvent(event);
}

void SliceView::mouseReleaseEvent(QMouseEvent* event)
{
  if (event->button() == Qt::LeftButton && m_handleDown)
  {
    m_handleDown = false;
    emit handleReleased();
    return;
  }
  if (event->button() == Qt::LeftButton && m_boxDown)
  {
    m_boxDown = false;
    emit boxReleased();
    return;
  }
  if (event->button() == Qt::LeftButton && m_cutDown)
  {
    m_cutDown = false;
    emit cutReleased();
    if (std::exchange(m_pressed, std::nullopt)) // a click, as beside the line
      pointCrosshair(event->localPos());
    return update(); // without its reading
  }
  if (event->button() == Qt::RightButton && std::exchange(m_mayMenu, false))
    emit menuAsked(event->globalPos());
  if (event->button() == Qt::LeftButton)
    m_turning = false;
  if (event->button() != Qt::LeftButton || !m_toolDown)
    return;
  m_toolDown = false;
  emit toolReleased();
}

// The nearest of those that are seen in full, of one that lies over another the chosen one's.
std::optional<SliceView::Handle> SliceView::handleAt(const QPointF& position) const
{
  constexpr double kReach = 7.0; // px
  if (!m_presenter || (m_tool && !m_tool->measures))
    return std::nullopt;
  const auto picture = slice();
  std::optional<Handle> found;
  double best = kReach;
  for (const DrawnMeasure& measure : m_measures)
    for (const std::size_t n : measure.handles)
    {
      if (measure.draft || !isInSlice(measure.points[n], picture, m_crosshair, shownReach()))
        continue;
      const Eigen::Vector2d at =
          picture.pixelFromPatient(measure.points[n]) + Eigen::Vector2d(0.5, 0.5);
      const double away =
          std::hypot(at[0] - position.x(), at[1] - position.y()) - (measure.chosen ? 2.0 : 0.0);
      if (away >= best)
        continue;
      best = away;
      found = Handle{measure.index, n};
    }
  return found;
}

void SliceView::setBox(const std::optional<SliceBox>& box)
{
  m_box = box;
  if (!box && std::exchange(m_boxDown, false))
    emit boxReleased();
  update();
}

void SliceView::setCorrection(const core::AxesCorrection& axes)
{
  m_correction = axes;
  update();
}

void SliceView::setCuts(std::vector<SliceCut> cuts)
{
  m_cuts = std::move(cuts);
  if (m_cuts.empty() && std::exchange(m_cutDown, false))
    emit cutReleased();
  update();
}

// As facesAt.
std::optional<SliceView::Cut> SliceView::cutAt(const QPointF& position) const
{
  constexpr double kReach = 6.0; // px
  if (!m_presenter || m_tool)
    return std::nullopt;
  std::optional<Cut> found;
  for (std::size_t n = 0; n < m_cuts.size(); ++n)
    if (const auto line = presenters::lineInSlice(m_cuts[n].plane, slice()))
      if (const auto part =
              presenters::partAt(*line, {position.x() - 0.5, position.y() - 0.5}, kReach);
          part && (!found || *part == presenters::CutPart::End))
        found = Cut{n, *part};
  return found;
}

bool SliceView::takeCut(const QPointF& position)
{
  const auto cut = cutAt(position);
  if (!cut)
    return false;
  m_cutDown = true;
  m_pressed = position;
  emit cutTaken(cut->plane, cut->part, patientAt(position), m_orientation);
  return true;
}

// In the slice in which it is dragged.
void SliceView::paintCutReading(QPainter& painter, std::vector<QRectF>& taken) const
{
  if (!m_cutDown || !m_pointer)
    return;
  for (const SliceCut& cut : m_cuts)
    if (!cut.reading.isEmpty())
      taken.push_back(paintReading(painter, cut.reading, *m_pointer, cutColor(), taken));
}

// A tool has the left button for itself.
presenters::BoxFaces SliceView::facesAt(const QPointF& position) const
{
  constexpr double kReach = 7.0; // px
  if (!m_presenter || !m_box || m_tool)
    return {};
  return presenters::BoxInSlice(m_box->handled, slice())
      .facesAt({position.x() - 0.5, position.y() - 0.5}, kReach);
}

bool SliceView::takeBox(const QPointF& position, bool whole)
{
  if (!m_box || m_tool)
    return false;
  if (whole && !m_box->shiftMoves)
    return false;
  presenters::BoxFaces faces = facesAt(position);
  if (whole || (!faces.any() && m_box->moves))
    if (const presenters::BoxInSlice section(m_box->handled, slice());
        faces.any() || section.contains({position.x() - 0.5, position.y() - 0.5}))
      faces = section.insideFaces();
  if (!faces.any())
    return false;
  m_boxDown = true;
  m_pressed = position;
  emit boxTaken(faces, patientAt(position));
  return true;
}

void SliceView::showCursorAt(const QPointF& position)
{
  const bool isHandle = handleAt(position) || facesAt(position).any() || cutAt(position);
  setCursor(isHandle ? Qt::SizeAllCursor : Qt::CrossCursor);
}

void SliceView::setMeasures(std::vector<DrawnMeasure> measures)
{
  m_measures = std::move(measures);
  update();
}

void SliceView::leaveEvent(QEvent* event)
{
  QWidget::leaveEvent(event);
  m_pointer.reset();
  update();
}

void SliceView::mouseMoveEvent(QMouseEvent* event)
{
  if (!m_presenter)
    return;
  m_pointer = event->localPos();
  if (m_tool)
    update();
  if (event->buttons() == Qt::NoButton)
    showCursorAt(event->localPos());
  if (m_mayMenu && (event->localPos() - m_dragged).manhattanLength() < kClick)
    return;
  m_mayMenu = false;
  const double turned = std::remainder(angleAt(event->localPos()) - angleAt(m_dragged), 360.0);
  const QPointF step = event->localPos() - m_dragged;
  m_dragged = event->localPos();
  if (m_turning)
  {
    if (turned != 0.0)
      emit turnOthersAsked(m_orientation, turned);
    return;
  }
  if (m_handleDown || m_boxDown || m_cutDown)
  {
    if (m_pressed && (event->localPos() - *m_pressed).manhattanLength() < kClick)
      return;
    m_pressed.reset();
    if (m_boxDown)
      emit boxDragged(patientAt(event->localPos()));
    else if (m_cutDown)
      emit cutDragged(patientAt(event->localPos()));
    else
      emit handleDragged(shownAt(event->localPos()));
  }
  else if (m_toolDown)
    emit toolDragged(pointedAt(event->localPos()));
  else if (event->buttons() & Qt::LeftButton)
    pointCrosshair(event->localPos());
  else if (event->buttons() & Qt::RightButton)
  {
    const double unit = intensityDisplay().unit;
    const double perPixel = kHuPerPixel * unit;
    const double width = std::max(seenWindow().width + perPixel * step.x(), kMinHu * unit);
    emit greyWindowChanged({width, seenWindow().level - 0.5 * perPixel * step.y()});
  }
  else if (event->buttons() & Qt::MiddleButton)
  {
    const presenters::SliceAxes& axes = this->axes();
    m_offset -= slice().mmPerPixel() * (step.x() * axes.right + step.y() * axes.down);
    stale();
  }
  emit pointed(pointedAt(event->localPos()));
}

void SliceView::wheelEvent(QWheelEvent* event)
{
  const double notches = event->angleDelta().y() / 120.0;
  if (event->modifiers() & Qt::ControlModifier)
    zoom(std::pow(1.2, notches));
  else if (notches != 0.0)
    scroll(notches > 0.0 ? std::max(1, static_cast<int>(notches))
                         : std::min(-1, static_cast<int>(notches)));
  event->accept();
  if (m_pointer && m_presenter) // another place lies under it now
    emit pointed(pointedAt(event->position()));
}

void SliceView::scroll(int slices)
{
  if (!m_presenter)
    return;
  const Eigen::Vector3d next = axes().next;
  // One voxel along the grid axis closest to the slice normal.
  const double step = 1.0 / (m_grid.voxelFromPatientLinear() * next).cwiseAbs().maxCoeff();
  emit crosshairMoved(m_crosshair + slices * step * next);
}

void SliceView::zoom(double factor)
{
  if (!m_presenter)
    return;
  applyZoom(m_zoom * factor);
  emit zoomed();
}

void SliceView::putCrosshairAt(const Eigen::Vector2d& pixel)
{
  const auto picture = slice();
  const Eigen::Vector2d off = picture.pixelFromPatient(m_crosshair) - pixel;
  m_offset += picture.mmPerPixel() * (off[0] * axes().right + off[1] * axes().down);
}

// The picture stays under the pointer.
void SliceView::pointCrosshair(const QPointF& position)
{
  const QScopedValueRollback<bool> pointing(m_pointing, true);
  emit crosshairMoved(patientAt(position));
}

// What is under the crosshair stays there.
void SliceView::applyZoom(double zoom)
{
  const Eigen::Vector2d before = slice().pixelFromPatient(m_crosshair);
  m_zoom = std::clamp(zoom, 1.0, kMaxZoom);
  putCrosshairAt(before);
  if (m_zoom == 1.0)
    m_offset.setZero();
  stale();
}

double SliceView::angleAt(const QPointF& position) const
{
  const Eigen::Vector2d middle = slice().pixelFromPatient(m_crosshair) + Eigen::Vector2d(0.5, 0.5);
  return std::atan2(position.y() - middle[1], position.x() - middle[0]) / kDegree;
}

// By a degree.
bool SliceView::turnPlanes(const QKeyEvent& event)
{
  if (!(event.modifiers() & Qt::ControlModifier) || !m_presenter)
    return false;
  const bool tilts = event.modifiers() & Qt::ShiftModifier;
  switch (event.key())
  {
  case Qt::Key_Left:
  case Qt::Key_Right:
  {
    const double degrees = event.key() == Qt::Key_Left ? -1.0 : 1.0;
    if (tilts)
      emit tiltAsked(m_orientation, degrees, 0.0);
    else
      emit turnOthersAsked(m_orientation, degrees);
    return true;
  }
  case Qt::Key_Up:
    emit tiltAsked(m_orientation, 0.0, -1.0);
    return true;
  case Qt::Key_Down:
    emit tiltAsked(m_orientation, 0.0, 1.0);
    return true;
  default:
    return false;
  }
}

// Steps of 0.1, with Shift 1, millimetre or degree.
bool SliceView::moveMr(const QKeyEvent& event)
{
  if (!(event.modifiers() & Qt::AltModifier) || !m_overlay)
    return false;
  const presenters::SliceAxes& axes = this->axes();
  const double step = event.modifiers() & Qt::ShiftModifier ? 1.0 : 0.1;
  switch (event.key())
  {
  case Qt::Key_Left:
    emit moveAsked(-step * axes.right);
    return true;
  case Qt::Key_Right:
    emit moveAsked(step * axes.right);
    return true;
  case Qt::Key_Up:
    emit moveAsked(-step * axes.down);
    return true;
  case Qt::Key_Down:
    emit moveAsked(step * axes.down);
    return true;
  case Qt::Key_PageUp: // counterclockwise on the screen
    emit turnAsked(axes.right.cross(axes.down), -step);
    return true;
  case Qt::Key_PageDown:
    emit turnAsked(axes.right.cross(axes.down), step);
    return true;
  default:
    return false;
  }
}

// The keys that move the MR are the slice's while one lies over it, and not an action's.
bool SliceView::event(QEvent* event)
{
  if (event->type() == QEvent::ShortcutOverride && m_overlay)
  {
    const auto& key = static_cast<QKeyEvent&>(*event);
    constexpr std::array<int, 6> kMoves{Qt::Key_Left, Qt::Key_Right,  Qt::Key_Up,
                                        Qt::Key_Down, Qt::Key_PageUp, Qt::Key_PageDown};
    if (key.modifiers() & Qt::AltModifier &&
        std::find(kMoves.begin(), kMoves.end(), key.key()) != kMoves.end())
    {
      event->accept();
      return true;
    }
  }
  return QWidget::event(event);
}

void SliceView::keyPressEvent(QKeyEvent* event)
{
  if (moveMr(*event) || turnPlanes(*event))
    return;
  if (event->key() == Qt::Key_Menu)
    return emit menuAsked(mapToGlobal(rect().center()));
  const presenters::SliceAxes& axes = this->axes();
  const double step = m_grid.minSpacing();
  switch (event->key())
  {
  case Qt::Key_PageUp:
    return scroll(1);
  case Qt::Key_PageDown:
    return scroll(-1);
  case Qt::Key_Left:
    emit crosshairMoved(m_crosshair - step * axes.right);
    return;
  case Qt::Key_Right:
    emit crosshairMoved(m_crosshair + step * axes.right);
    return;
  case Qt::Key_Up:
    emit crosshairMoved(m_crosshair - step * axes.down);
    return;
  case Qt::Key_Down:
    emit crosshairMoved(m_crosshair + step * axes.down);
    return;
  case Qt::Key_Plus:
  case Qt::Key_Equal:
    return zoom(1.2);
  case Qt::Key_Minus:
    return zoom(1.0 / 1.2);
  default:
    QWidget::keyPressEvent(event);
  }
}

} // namespace petrous::workstation
