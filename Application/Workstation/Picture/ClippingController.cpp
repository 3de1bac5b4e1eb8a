#include "ClippingController.h"

#include <cmath>
#include <utility>

#include <QAction>
#include <QLineF>
#include <QMouseEvent>

#include "Commands.h"
#include "CropBoxDialog.h"
#include "SceneDisplay.h"
#include "SliceColumn.h"
#include "SliceView.h"
#include "Theme.h"
#include "ThreeDView.h"
#include "WindowActions.h"
#include "WindowTexts.h"
#include "petrous/Presenters/ClippingHandles.h"

namespace petrous::workstation
{

namespace
{

using presenters::CropFrame;
using presenters::FaceHandle;
using presenters::HandledBox;

constexpr double kReach = 9.0; // px, to a handle in the 3D view
constexpr double kClick = 3.0; // px, that a click may move
constexpr double kStep = 0.5;  // mm, of a key
constexpr double kArrow = 8.0; // mm, of a plane's arrow, at whose tip it is dragged

void add(std::vector<DrawnMeasure>& parts, std::vector<Eigen::Vector3d> points,
         std::vector<std::size_t> handles)
{
  DrawnMeasure part;
  part.index = parts.size();
  part.points = std::move(points);
  part.handles = std::move(handles);
  part.color = boxColor();
  parts.push_back(std::move(part));
}

// Each edge by itself, as one that reaches behind the camera is not drawn.
void addEdges(std::vector<DrawnMeasure>& parts, const HandledBox& box)
{
  using Box = Eigen::AlignedBox3d;
  const auto corner = [&box](int n) -> Eigen::Vector3d
  { return box.patientFromBox * box.box.corner(static_cast<Box::CornerType>(n)); };
  for (int from = 0; from < 8; ++from)
    for (const int along : {1, 2, 4})
      if (!(from & along))
        add(parts, {corner(from), corner(from | along)}, {});
}

} // namespace

ClippingController::ClippingController(presenters::WorkstationModel& model, SliceColumn& slices,
                                       ThreeDView& view, WindowActions& actions, QWidget& window)
  : QObject(&window)
  , m_model(model)
  , m_slices(slices)
  , m_view(view)
  , m_actions(actions)
  , m_window(window)
{
  connect(actions.clipHere, &QAction::triggered, this, &ClippingController::cutHere);
  connect(actions.clipOff, &QAction::triggered, this, [this] { change({}); });
  connect(actions.clipDeeper, &QAction::triggered, this, [this] { movePlanes(kStep); });
  connect(actions.clipLess, &QAction::triggered, this, [this] { movePlanes(-kStep); });
  connect(actions.cropBox, &QAction::triggered, this, &ClippingController::showBox);
  connect(actions.cropNumbers, &QAction::triggered, this, &ClippingController::enterBox);
  connect(&slices, &SliceColumn::boxTaken, this,
          [this](const presenters::BoxFaces& faces, const Eigen::Vector3d& from)
          {
            const CropFrame frame(m_model.value().ct.geometry);
            const Clipping before = m_model.value().view.clipping;
            beginDrag(
                [frame, before, faces, from](const Eigen::Vector3d& to)
                {
                  Clipping clipping = before;
                  clipping.crop = frame.dragged(before.crop, faces, from, to);
                  return clipping;
                });
          });
  connect(&slices, &SliceColumn::boxDragged, this, &ClippingController::drag);
  connect(&slices, &SliceColumn::boxReleased, this, &ClippingController::endDrag);
  connect(&slices, &SliceColumn::boxResetAsked, this, [this] { setCrop(std::nullopt); });
  connect(&view, &ThreeDView::toolModeSet, this, &ClippingController::refresh);
  m_view.installEventFilter(this);
  refresh();
}

ClippingController::~ClippingController()
{
  m_view.removeEventFilter(this);
}

void ClippingController::caseChanged()
{
  m_drag = {};
  m_line.reset();
  m_zooms = {};
  m_actions.cropBox->setChecked(false);
  if (m_dialog)
    m_dialog->close();
  refresh();
}

bool ClippingController::toolHasView() const
{
  return m_view.tool().GetDrillMode() || m_view.tool().GetProbeMode();
}

bool ClippingController::hasHandles() const
{
  return !toolHasView() && !(viewTaken && viewTaken());
}

bool ClippingController::showsBox() const
{
  return m_model.hasCase() && m_actions.cropBox->isChecked() && !toolHasView();
}

void ClippingController::refresh()
{
  const bool hasPlane = m_model.hasCase() && !m_model.value().view.clipping.planes.empty();
  const QString why =
      m_model.hasCase() ? tr("Nothing is cut away by a plane") : tr("Open a case first");
  enable(*m_actions.clipDeeper, hasPlane, why);
  enable(*m_actions.clipLess, hasPlane, why);
  if (!m_model.hasCase())
  {
    m_slices.setBox(std::nullopt);
    m_view.display().setHandles({});
    return;
  }
  const CropFrame frame(m_model.value().ct.geometry);
  const HandledBox box = frame.box(m_model.value().view.clipping.crop);
  const bool isShown = showsBox();
  m_slices.setBox(isShown ? std::optional(SliceBox{box}) : std::nullopt);
  std::vector<DrawnMeasure> parts;
  if (isShown)
    addEdges(parts, box);
  for (const Handle& handle : handles())
    if (handle.arrow > 0.0)
      add(parts, {handle.at - handle.arrow * handle.direction, handle.at}, {1});
    else
      add(parts, {handle.at}, {0});
  m_view.display().setHandles(parts);
  if (m_dialog && m_dialog->isVisible())
    m_dialog->show(frame, box.box);
}

// The plane through the crosshair, facing the viewer; a box that is shown alone stays.
void ClippingController::cutHere()
{
  if (!m_model.hasCase())
    return;
  const core::CameraPose camera = m_view.picture().camera();
  Clipping clipping = m_model.value().view.clipping;
  clipping.planes = {{m_model.crosshair(), (camera.focalPoint - camera.position).normalized()}};
  change(clipping);
}

void ClippingController::showBox(bool shown)
{
  if (!m_model.hasCase())
    return;
  if (shown && !m_model.value().view.clipping.crop)
    showWholeSlices(); // its edges are the image's
  else if (!shown)
    zoomAsBefore();
  refresh();
  if (shown && toolHasView())
    emit statusMessage(tr("The crop box comes when the tool is put away"));
  else if (shown)
    tellSize();
}

void ClippingController::showWholeSlices()
{
  for (std::size_t n = 0; n < m_zooms.size(); ++n)
    m_zooms[n] = m_slices.views()[n]->plane();
  m_slices.fit();
}

// But for a slice that was zoomed since.
void ClippingController::zoomAsBefore()
{
  for (std::size_t n = 0; n < m_zooms.size(); ++n)
  {
    SliceView& view = *m_slices.views()[n];
    const scene::ViewState::Slices::Plane now = view.plane();
    if (m_zooms[n] && now.zoom == 1.0 && now.offset.isZero(0.0))
      view.setPlane(*m_zooms[n]);
    m_zooms[n].reset();
  }
}

void ClippingController::enterBox()
{
  if (!m_model.hasCase())
    return;
  if (!m_dialog)
  {
    m_dialog = new CropBoxDialog(&m_window);
    connect(m_dialog, &CropBoxDialog::wholeAsked, this, [this] { setCrop(std::nullopt); });
    connect(m_dialog, &CropBoxDialog::edited, this,
            [this](const Eigen::AlignedBox3d& entered)
            {
              if (!m_model.hasCase())
                return;
              const CropFrame frame(m_model.value().ct.geometry);
              Eigen::AlignedBox3d box = frame.box(m_model.value().view.clipping.crop).box;
              // The face that was entered, by as much as the others allow.
              presenters::BoxFaces faces;
              Eigen::Vector3d step = Eigen::Vector3d::Zero();
              for (std::size_t n = 0; n < 3; ++n)
              {
                const auto axis = static_cast<Eigen::Index>(n);
                faces.lower[n] = entered.min()[axis] != box.min()[axis];
                faces.upper[n] = !faces.lower[n] && entered.max()[axis] != box.max()[axis];
                step[axis] = faces.lower[n] ? entered.min()[axis] - box.min()[axis]
                                            : entered.max()[axis] - box.max()[axis];
              }
              setCrop(
                  frame.crop(presenters::moved(box, faces, step, frame.bounds(), frame.least())));
              refresh(); // also a number that is none of a voxel
            });
  }
  const CropFrame frame(m_model.value().ct.geometry);
  m_dialog->show(frame, frame.box(m_model.value().view.clipping.crop).box);
  m_dialog->raise();
  m_dialog->activateWindow();
}

void ClippingController::setCrop(const std::optional<core::IndexBox>& crop)
{
  if (!m_model.hasCase())
    return;
  Clipping clipping = m_model.value().view.clipping;
  clipping.crop = crop;
  change(clipping);
}

// Held down, the key is one step of undo.
void ClippingController::movePlanes(double step)
{
  if (!m_model.hasCase())
    return;
  Clipping clipping = m_model.value().view.clipping;
  for (Clipping::Plane& plane : clipping.planes)
    plane = presenters::movedPlane(plane, step, m_model.value().ct.geometry);
  change(clipping, "clipping plane");
}

void ClippingController::change(const Clipping& clipping, const std::string& continues)
{
  if (!m_model.hasCase())
    return;
  const Clipping before = m_model.value().view.clipping;
  m_model.setClipping(clipping);
  record(before, continues);
}

void ClippingController::record(const Clipping& before, const std::string& continues)
{
  const Clipping after = m_model.value().view.clipping;
  if (after == before)
    return;
  const auto set = [this](const Clipping& clipping) { m_model.setClipping(clipping); };
  m_model.edits().did({presenters::clippingChange(before, after), continues,
                       [set, before] { set(before); }, [set, after] { set(after); }});
  if (m_model.events.stateChanged)
    m_model.events.stateChanged();
}

void ClippingController::beginDrag(std::function<Clipping(const Eigen::Vector3d&)> drag)
{
  m_before = m_model.value().view.clipping;
  m_drag = std::move(drag);
}

void ClippingController::drag(const Eigen::Vector3d& patient)
{
  if (!m_drag || !m_model.hasCase())
    return;
  m_model.setClipping(m_drag(patient));
  if (!(m_model.value().view.clipping.crop == m_before.crop))
    tellSize();
}

void ClippingController::endDrag()
{
  m_line.reset();
  if (std::exchange(m_drag, {}) && m_model.hasCase())
    record(m_before);
}

void ClippingController::tellSize()
{
  const Clipping& clipping = m_model.value().view.clipping;
  const CropFrame frame(m_model.value().ct.geometry);
  emit statusMessage(tr("Crop box: %1").arg(boxSizeText(frame.box(clipping.crop).box.sizes())));
}

// Of the box while it is shown, and of each plane.
std::vector<ClippingController::Handle> ClippingController::handles() const
{
  std::vector<Handle> all;
  if (!m_model.hasCase() || !hasHandles())
    return all;
  const core::GridGeometry& grid = m_model.value().ct.geometry;
  const Clipping before = m_model.value().view.clipping;
  if (showsBox())
  {
    const CropFrame frame(grid);
    for (const FaceHandle& face : presenters::faceHandles(frame.box(before.crop)))
    {
      presenters::BoxFaces faces;
      (face.isUpper ? faces.upper : faces.lower)[face.axis] = true;
      all.push_back({face.at, face.normal, 0.0,
                     tr("Turn the patient: this face is dragged along the line of sight"),
                     [frame, before, faces, face](double millimetres)
                     {
                       Clipping clipping = before;
                       clipping.crop = frame.dragged(before.crop, faces, face.at,
                                                     face.at + millimetres * face.normal);
                       return clipping;
                     }});
    }
  }
  for (std::size_t n = 0; n < before.planes.size(); ++n)
  {
    const Clipping::Plane& plane = before.planes[n];
    all.push_back({presenters::planeCenter(plane, grid) + kArrow * plane.normal, plane.normal,
                   kArrow, tr("Turn the patient: the plane is dragged along the line of sight"),
                   [before, n, grid](double millimetres)
                   {
                     Clipping clipping = before;
                     clipping.planes[n] =
                         presenters::movedPlane(before.planes[n], millimetres, grid);
                     return clipping;
                   }});
  }
  return all;
}

std::optional<ClippingController::Handle>
ClippingController::handleAt(const QPointF& position) const
{
  const double ratio = m_view.devicePixelRatioF();
  std::optional<Handle> found;
  double best = kReach;
  for (const Handle& handle : handles())
    if (const auto at = m_view.display().pixelOf(handle.at))
    {
      const double away =
          std::hypot((*at)[0] / ratio - position.x(), (*at)[1] / ratio - position.y());
      if (away >= best)
        continue;
      best = away;
      found = handle;
    }
  return found;
}

bool ClippingController::takeHandle(const QPointF& position)
{
  const std::optional<Handle> found = handleAt(position);
  if (!found)
    return false;
  const auto grabbed =
      presenters::closestAlong(found->at, found->direction, m_view.sightLine(position));
  if (!grabbed)
  {
    emit statusMessage(found->alongSight);
    return false; // the patient turns
  }
  m_line = Line{found->at, found->direction};
  m_pressed = position;
  beginDrag(
      [line = *m_line, grabbed = *grabbed, dragged = found->dragged](const Eigen::Vector3d& to)
      { return dragged(line.direction.dot(to - line.at) - grabbed); });
  return true;
}

bool ClippingController::eventFilter(QObject* watched, QEvent* event)
{
  const auto* mouse = watched == &m_view ? dynamic_cast<const QMouseEvent*>(event) : nullptr;
  return mouse && m_model.hasCase() && handleMouse(*mouse);
}

bool ClippingController::handleMouse(const QMouseEvent& event)
{
  const bool isLeft = event.button() == Qt::LeftButton;
  switch (event.type())
  {
  case QEvent::MouseButtonPress:
    return isLeft && event.modifiers() == Qt::NoModifier && takeHandle(event.localPos());
  case QEvent::MouseButtonDblClick: // the second press of who drags it again, and enlarges nothing
    return isLeft && event.modifiers() == Qt::NoModifier &&
           (takeHandle(event.localPos()) || handleAt(event.localPos()));
  case QEvent::MouseMove:
    if (!m_line)
      return false;
    if (m_pressed && QLineF(*m_pressed, event.localPos()).length() <= kClick)
      return true;
    m_pressed.reset();
    if (const auto along = presenters::closestAlong(m_line->at, m_line->direction,
                                                    m_view.sightLine(event.localPos())))
      drag(m_line->at + *along * m_line->direction);
    return true;
  case QEvent::MouseButtonRelease:
    if (!isLeft || !m_line)
      return false;
    endDrag();
    return true;
  default:
    return false;
  }
}

} // namespace petrous::workstation
