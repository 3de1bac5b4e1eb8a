#include "SliceColumn.h"

#include <algorithm>
#include <cmath>

#include "SliceView.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Volume/TissueExtent.h"

namespace petrous::workstation
{

using presenters::SliceOrientation;

SliceColumn::SliceColumn(presenters::WorkstationModel& model, QWidget* parent)
  : QWidget(parent)
  , m_model(model)
  , m_views{new SliceView(SliceOrientation::Axial, this),
            new SliceView(SliceOrientation::Coronal, this),
            new SliceView(SliceOrientation::Sagittal, this)}
{
  setObjectName("slices");
  for (SliceView* view : m_views)
  {
    view->setToolTip(tr("Drag: move the crosshair.  Wheel: scroll.  Right drag: grey window.\n"
                        "Ctrl+wheel: zoom.  Middle drag: move.  Double click (E): enlarge, and "
                        "back.\nRed and hatched: drilled away."));
    connect(view, &SliceView::enlargeAsked, this, &SliceColumn::enlargeAsked);
    connect(view, &SliceView::crosshairMoved, this,
            [this](const Eigen::Vector3d& patient) { m_model.setCrosshair(patient); });
    connect(view, &SliceView::greyWindowChanged, this, &SliceColumn::setSeenWindow);
    connect(view, &SliceView::menuAsked, this, &SliceColumn::menuAsked);
    connect(view, &SliceView::turnOthersAsked, this,
            [this](SliceOrientation slice, double degrees)
            {
              presenters::SlicePlanes planes = m_planes;
              planes.turnOthers(slice, degrees);
              setPlanes(planes);
            });
    connect(view, &SliceView::tiltAsked, this,
            [this](SliceOrientation slice, double right, double down)
            {
              presenters::SlicePlanes planes = m_planes;
              planes.tilt(slice, right, down);
              setPlanes(planes);
            });
    connect(view, &SliceView::zoomed, this,
            [this, view]
            {
              m_zoomed = view;
              zoomTogether();
            });
    connect(view, &SliceView::pointed, this, &SliceColumn::pointed);
    connect(view, &SliceView::moveAsked, this, &SliceColumn::moveAsked);
    connect(view, &SliceView::turnAsked, this, &SliceColumn::turnAsked);
    connect(view, &SliceView::toolPressed, this, &SliceColumn::toolPressed);
    connect(view, &SliceView::toolDragged, this, &SliceColumn::toolDragged);
    connect(view, &SliceView::toolReleased, this, &SliceColumn::toolReleased);
    connect(view, &SliceView::toolDoubleClicked, this, &SliceColumn::toolDoubleClicked);
    connect(view, &SliceView::handleTaken, this, &SliceColumn::handleTaken);
    connect(view, &SliceView::handleDragged, this, &SliceColumn::handleDragged);
    connect(view, &SliceView::handleReleased, this, &SliceColumn::handleReleased);
    connect(view, &SliceView::boxTaken, this, &SliceColumn::boxTaken);
    connect(view, &SliceView::boxDragged, this, &SliceColumn::boxDragged);
    connect(view, &SliceView::boxReleased, this, &SliceColumn::boxReleased);
    connect(view, &SliceView::boxResetAsked, this, &SliceColumn::boxResetAsked);
    connect(view, &SliceView::cutTaken, this, &SliceColumn::cutTaken);
    connect(view, &SliceView::cutDragged, this, &SliceColumn::cutDragged);
    connect(view, &SliceView::cutReleased, this, &SliceColumn::cutReleased);
  }
}

void SliceColumn::caseChanged()
{
  setOverlay(nullptr, {}); // of the case before
  m_suggestedOf.clear();
  setPlanes({});
  setSlab({});
  fit();
  boneWindow();
  appearanceChanged();
  crosshairMoved();
  frameTissue();
}

// Of a head in a wide reconstruction the slices begin with the head. What is not calibrated has no
// value of air. Apart, as all of the image is read.
void SliceColumn::frameTissue()
{
  constexpr double kAir = -500.0;     // HU, above
  constexpr double kOutliers = 0.025; // the ends of a table, beside the head
  m_framing.abandon();
  const scene::Case& value = m_model.value();
  if (value.view.slices || !presenters::displayOf(value).hounsfield)
    return;
  m_framing.replace(
      [this, volume = value.ct.volume.get(),
       crosshair = m_model.crosshair()](const core::Progress&) -> BackgroundWork::Reply
      {
        core::PatientBox box = volume::tissueBox(*volume, kAir, kOutliers);
        box.extend(crosshair);
        return [this, box]
        {
          for (SliceView* view : m_views)
            view->frame(box);
        };
      });
}

void SliceColumn::appearanceChanged()
{
  scene::Case value = m_model.presentable();
  if (auto* hidden = scene::findStructure(value, m_hidden))
    hidden->look.shown = false;
  auto presenter = std::make_shared<const presenters::SlicePresenter>(
      value, m_model.value().dissection.sharedMask());
  const bool isNew = !m_presenter || !presenter->drawsAs(*m_presenter);
  if (isNew)
    m_presenter = std::move(presenter);
  for (SliceView* view : m_views)
  {
    if (isNew) // the views draw anew
      view->setPresenter(m_presenter, m_model.value().ct.geometry);
    view->setIntensityDisplay(presenters::displayOf(m_model.value()));
    view->setInterpolated(m_model.value().ct.provenance.interpolated);
  }
  showReadout(); // structures may be loaded only now, or have other names
}

void SliceColumn::clear()
{
  m_framing.abandon();
  m_presenter.reset();
  for (SliceView* view : m_views)
    view->setPresenter(nullptr, {});
}

void SliceColumn::crosshairMoved()
{
  for (SliceView* view : m_views)
    view->setCrosshair(m_model.crosshair());
  showReadout();
}

QString SliceColumn::valuesAt(const Eigen::Vector3d& patient) const
{
  return m_model.hasCase()
             ? words(presenters::shownValues(m_model.value(), m_shown, m_overlay.get(), patient))
             : QString();
}

void SliceColumn::showReadout()
{
  QString text = valuesAt(m_model.crosshair());
  const std::string structure = m_model.structureAt(m_model.crosshair());
  if (!structure.empty())
    text += "  " + shownName(structure);
  for (SliceView* view : m_views)
    view->setReadout(text);
}

void SliceColumn::maskChanged(const core::IndexBox& box)
{
  if (box.empty())
    return;
  const core::PatientBox changed = m_model.value().ct.geometry.cropped(box).patientBounds();
  for (SliceView* view : m_views)
    view->maskChanged(changed);
}

void SliceColumn::setGreyWindow(const presenters::GreyWindow& window)
{
  m_window = window;
  for (SliceView* view : m_views)
    view->setGreyWindow(window);
  emit windowChanged();
}

void SliceColumn::setPlanes(const presenters::SlicePlanes& planes)
{
  m_planes = planes;
  for (SliceView* view : m_views)
    view->setPlanes(planes);
  emit planesChanged();
}

void SliceColumn::setSlab(const presenters::Slab& slab)
{
  m_slab = slab;
  for (SliceView* view : m_views)
    view->setSlab(slab);
  emit slabChanged();
}

void SliceColumn::setZoomTogether(bool together)
{
  m_isZoomTogether = together;
  for (const SliceView* view : m_views)
    if (view->hasFocus())
      m_zoomed = view;
  for (const SliceView* view : m_views) // as a kept view has it
    if (!m_zoomed && view->plane().zoom > 1.0)
      m_zoomed = view;
  zoomTogether();
}

void SliceColumn::zoomTogether()
{
  for (SliceView* view : m_views)
    if (m_isZoomTogether && m_zoomed && view != m_zoomed)
      view->setScale(m_zoomed->slice().mmPerPixel());
}

void SliceColumn::setScale(double mmPerPixel)
{
  for (SliceView* view : m_views)
    view->setScale(mmPerPixel);
}

const scene::ImagePart* SliceColumn::seenMr() const
{
  return m_overlay && !m_shown.ct && m_model.hasCase() ? scene::findMr(m_model.value(), m_shown.mr)
                                                       : nullptr;
}

bool SliceColumn::seesMr() const
{
  return seenMr() || (m_model.hasCase() && m_model.value().ct.modality == scene::Modality::Mr);
}

const presenters::GreyWindow& SliceColumn::seenWindow() const
{
  return seenMr() ? m_overlay->window : m_window;
}

void SliceColumn::setSeenWindow(const presenters::GreyWindow& window)
{
  if (m_shown.ct)
    setGreyWindow(window);
  else
    emit overlayWindowAsked(window);
}

std::vector<presenters::NamedWindow> SliceColumn::seenWindows() const
{
  if (!m_model.hasCase())
    return {};
  return seenMr() ? presenters::mrWindows(m_suggested) : presenters::greyWindows(m_model.value());
}

presenters::IntensityDisplay SliceColumn::seenDisplay() const
{
  const scene::ImagePart* mr = seenMr();
  return mr                  ? presenters::displayOf(*mr)
         : m_model.hasCase() ? presenters::displayOf(m_model.value())
                             : presenters::IntensityDisplay();
}

void SliceColumn::boneWindow()
{
  setGreyWindow(presenters::displayOf(m_model.value()).bone);
}

void SliceColumn::softWindow()
{
  setGreyWindow(presenters::displayOf(m_model.value()).soft);
}

void SliceColumn::temporalWindow()
{
  setGreyWindow(presenters::displayOf(m_model.value()).temporal);
}

void SliceColumn::setOverlay(const std::shared_ptr<const presenters::SliceOverlay>& overlay,
                             const presenters::ShownImages& shown)
{
  m_overlay = overlay;
  m_shown = shown;
  if (overlay && m_suggestedOf != shown.mr)
  {
    m_suggestedOf = shown.mr;
    m_suggested = overlay->window;
  }
  const scene::ImagePart* mr =
      m_model.hasCase() ? scene::findMr(m_model.value(), shown.mr) : nullptr;
  for (SliceView* view : m_views)
    view->setOverlay(overlay,
                     mr && !shown.ct ? std::optional(presenters::displayOf(*mr)) : std::nullopt);
  if (m_model.hasCase())
    showReadout();
  emit windowChanged();
}

void SliceColumn::setNotice(const QString& text)
{
  for (SliceView* view : m_views)
    view->setNotice(text);
}

void SliceColumn::setRegion(double edge)
{
  for (SliceView* view : m_views)
    view->setRegion(edge);
}

void SliceColumn::setMarks(const std::vector<SliceMark>& marks)
{
  for (SliceView* view : m_views)
    view->setMarks(marks);
}

SliceColumn::~SliceColumn() = default;

void SliceColumn::setTool(const std::optional<SliceTool>& tool)
{
  m_tool = tool ? std::make_unique<const SliceTool>(*tool) : nullptr;
  passTool();
}

void SliceColumn::setMeasuring(bool on)
{
  if (on == m_measuring)
    return;
  m_measuring = on;
  passTool();
}

void SliceColumn::passTool()
{
  std::optional<SliceTool> tool;
  if (m_tool)
    tool = *m_tool;
  else if (m_measuring)
    tool = SliceTool{0.0, {}, true};
  for (SliceView* view : m_views)
    view->setTool(tool);
}

void SliceColumn::setDrawing(const SliceDrawing& drawing)
{
  for (SliceView* view : m_views)
    view->setDrawing(drawing);
}

void SliceColumn::setMeasures(const std::vector<DrawnMeasure>& measures)
{
  for (SliceView* view : m_views)
    view->setMeasures(measures);
}

void SliceColumn::setBox(const std::optional<SliceBox>& box)
{
  for (SliceView* view : m_views)
    view->setBox(box);
}

void SliceColumn::setCuts(const std::vector<SliceCut>& cuts)
{
  for (SliceView* view : m_views)
    view->setCuts(cuts);
}

double SliceColumn::mmPerPixel(SliceOrientation plane) const
{
  return m_views[static_cast<std::size_t>(plane)]->slice().mmPerPixel();
}

void SliceColumn::setDraft(const std::shared_ptr<const presenters::DraftLayer>& draft)
{
  for (SliceView* view : m_views)
    view->setDraft(draft);
}

void SliceColumn::setHidden(const std::string& structure)
{
  if (structure == m_hidden)
    return;
  m_hidden = structure;
  if (m_model.hasCase())
    appearanceChanged();
}

void SliceColumn::setDifference(const std::shared_ptr<const presenters::DraftLayer>& difference)
{
  for (SliceView* view : m_views)
    view->setDifference(difference);
}

void SliceColumn::draftChanged(const core::PatientBox& box)
{
  for (SliceView* view : m_views)
    view->draftChanged(box);
}

void SliceColumn::fit()
{
  m_zoomed = nullptr;
  keepAsSeen();
  for (SliceView* view : m_views)
    view->fit();
}

void SliceColumn::showWhole()
{
  const std::optional<std::array<scene::ViewState::Slices::Plane, 3>> before = shown().planes;
  fit();
  std::copy(before->begin(), before->end(), m_before.begin());
}

// As showWhole left it: it was not zoomed since.
bool SliceColumn::isStillWhole(std::size_t slice) const
{
  const scene::ViewState::Slices::Plane now = m_views[slice]->plane();
  return now.zoom == 1.0 && now.offset.isZero(0.0);
}

void SliceColumn::showAsBefore()
{
  for (std::size_t n = 0; n < m_views.size(); ++n)
    if (m_before[n] && isStillWhole(n))
      m_views[n]->setPlane(*m_before[n]);
  keepAsSeen();
}

void SliceColumn::keepAsSeen()
{
  m_before = {};
}

void SliceColumn::setShown(const scene::ViewState::Slices& slices)
{
  keepAsSeen();
  setGreyWindow({slices.width, slices.level});
  setPlanes(presenters::SlicePlanes::from(slices));
  presenters::Slab slab;
  if (slices.slab)
    slab = {slices.slab->thickness, presenters::parseProjection(slices.slab->projection)
                                        .value_or(presenters::Projection::Maximum)};
  setSlab(slab);
  for (std::size_t n = 0; slices.planes && n < m_views.size(); ++n)
    m_views[n]->setPlane((*slices.planes)[n]);
  m_model.setCrosshair(slices.crosshair);
  for (SliceView* view : m_views)
    view->revealCrosshair();
}

scene::ViewState::Slices SliceColumn::shown() const
{
  scene::ViewState::Slices slices{m_model.crosshair(), m_window.width, m_window.level};
  slices.planes.emplace();
  for (std::size_t n = 0; n < m_views.size(); ++n)
    (*slices.planes)[n] = m_views[n]->plane();
  m_planes.store(slices);
  if (m_slab.thickness > 0.0)
    slices.slab = {m_slab.thickness, nameOf(m_slab.projection)};
  return slices;
}

scene::ViewState::Slices SliceColumn::lasting() const
{
  scene::ViewState::Slices slices = shown();
  for (std::size_t n = 0; n < m_views.size(); ++n)
    if (m_before[n] && isStillWhole(n))
      (*slices.planes)[n] = *m_before[n];
  return slices;
}

} // namespace petrous::workstation
