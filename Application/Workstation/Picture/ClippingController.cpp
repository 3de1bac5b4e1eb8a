#include "ClippingController.h"

#include <algorithm>
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
constexpr double kTurn = 1.0;  // degrees, likewise
constexpr double kArrow = 8.0; // mm, of a plane's arrow, at whose tip it is dragged
constexpr double kDegree = 3.14159265358979323846 / 180.0;

DrawnMeasure& add(std::vector<DrawnMeasure>& parts, std::vector<Eigen::Vector3d> points)
{
  DrawnMeasure part;
  part.index = parts.size();
  part.points = std::move(points);
  part.color = boxColor();
  parts.push_back(std::move(part));
  return parts.back();
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
        add(parts, {corner(from), corner(from | along)});
}

// The clipping with these faces of its box dragged from a place to another.
auto draggedBox(const CropFrame& frame, const scene::ViewState::Clipping& before,
                const presenters::BoxFaces& faces,
                const Eigen::Vector3d& from = Eigen::Vector3d::Zero())
{
  return [=](const Eigen::Vector3d& to)
  {
    scene::ViewState::Clipping clipping = before;
    clipping.crop = frame.dragged(before.crop, faces, from, to);
    return clipping;
  };
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
  connect(actions.clipTurnLeft, &QAction::triggered, this, [this] { turnPlanes(-kTurn); });
  connect(actions.clipTurnRight, &QAction::triggered, this, [this] { turnPlanes(kTurn); });
  connect(actions.cropBox, &QAction::triggered, this, &ClippingController::showBox);
  connect(actions.cropNumbers, &QAction::triggered, this, &ClippingController::enterBox);
  connect(&slices, &SliceColumn::boxTaken, this,
          [this](const presenters::BoxFaces& faces, const Eigen::Vector3d& from)
          {
            const CropFrame frame(m_model.value().ct.geometry);
            beginDrag(draggedBox(frame, m_model.value().view.clipping, faces, from));
          });
  connect(&slices, &SliceColumn::boxDragged, this, &ClippingController::drag);
  connect(&slices, &SliceColumn::boxReleased, this, &ClippingController::endDrag);
  connect(&slices, &SliceColumn::boxResetAsked, this, [this] { setCrop(std::nullopt); });
  connect(&slices, &SliceColumn::cutTaken, this, &ClippingController::takeCut);
  connect(&slices, &SliceColumn::cutDragged, this, &ClippingController::drag);
  connect(&slices, &SliceColumn::cutReleased, this, &ClippingController::endDrag);
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
  m_held.reset();
  m_heldCut.reset();
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
  for (QAction* action :
       {m_actions.clipDeeper, m_actions.clipLess, m_actions.clipTurnLeft, m_actions.clipTurnRight})
    enable(*action, hasPlane, why);
  if (!m_model.hasCase())
  {
    m_slices.setBox(std::nullopt);
    m_slices.setCuts({});
    m_view.display().setHandles({});
    return;
  }
  const CropFrame frame(m_model.value().ct.geometry);
  const HandledBox box = frame.box(m_model.value().view.clipping.crop);
  const bool isShown = showsBox();
  const bool isPart = m_model.value().view.clipping.crop.has_value();
  m_slices.setBox(isShown ? std::optional(SliceBox{box, false, false, isPart}) : std::nullopt);
  std::vector<SliceCut> cuts;
  if (!toolHasView())
    for (const Clipping::Plane& plane : m_model.value().view.clipping.planes)
      cuts.push_back(
          {plane, m_heldCut && m_heldCut->plane == cuts.size() ? m_heldCut->reading() : QString()});
  m_slices.setCuts(std::move(cuts));
  std::vector<DrawnMeasure> parts;
  if (isShown)
    addEdges(parts, box);
  const std::vector<Handle> all = handles();
  for (std::size_t n = 0; n < all.size(); ++n)
  {
    const Handle& handle = all[n];
    std::vector<Eigen::Vector3d> points{handle.at};
    if (handle.arrow > 0.0)
      points.insert(points.begin(), handle.at - handle.arrow * *handle.direction);
    DrawnMeasure& part = add(parts, std::move(points));
    part.handles = {part.points.size() - 1};
    part.form = handle.arrow > 0.0 ? DrawnMeasure::Form::Arrow
                : handle.direction ? DrawnMeasure::Form::Square
                                   : DrawnMeasure::Form::Diamond;
    if (handle.arrow > 0.0)
      part.color = cutColor();
    if (m_held && m_held->number == n && !m_pressed)
      part.label = handle.reading();
  }
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
    m_slices.showWhole(); // its edges are the image's
  else if (!shown)
    m_slices.showAsBefore();
  refresh();
  if (shown && toolHasView())
    emit statusMessage(tr("The crop box comes when the tool is put away"));
  else if (shown)
    tellSize();
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
  const Clipping before = m_model.value().view.clipping;
  change(clipping, "clipping plane");
  if (!clipping.planes.empty())
    emit statusMessage(readPlane(0, before));
}

// In the plane of the slice that has the keyboard, clockwise as it is seen, likewise; in the 3D
// view clockwise as seen from above.
void ClippingController::turnPlanes(double degrees)
{
  if (!m_model.hasCase())
    return;
  const core::GridGeometry& grid = m_model.value().ct.geometry;
  const auto orientation = focusedSlice ? focusedSlice() : std::nullopt;
  const Clipping before = m_model.value().view.clipping;
  Clipping clipping = before;
  for (Clipping::Plane& plane : clipping.planes)
    if (!orientation)
    {
      const Eigen::Vector3d up = m_view.picture().camera().viewUp.normalized();
      plane = presenters::turnedPlane(plane, up, presenters::planeCenter(plane, grid),
                                      -degrees * kDegree, grid);
    }
    else
    {
      const auto slice = m_slices.views()[static_cast<std::size_t>(*orientation)]->slice();
      if (!presenters::lineInSlice(plane, slice))
        return emit statusMessage(tr("The plane does not cut this slice: it is turned in another"));
      const Eigen::Vector3d axis = slice.axes().right.cross(slice.axes().down);
      plane = presenters::turnedPlane(plane, axis, presenters::pivotInSlice(plane, grid, slice),
                                      degrees * kDegree, grid);
    }
  change(clipping, "turn of the clipping plane");
  if (!clipping.planes.empty())
    emit statusMessage(readTurn(0, before));
}

// A step of the pointer moves the plane by its part along the normal, so that the line stays under
// it; a turn is about the slice's normal.
void ClippingController::takeCut(std::size_t n, presenters::CutPart part,
                                 const Eigen::Vector3d& from,
                                 presenters::SliceOrientation orientation)
{
  const core::GridGeometry& grid = m_model.value().ct.geometry;
  const Clipping before = m_model.value().view.clipping;
  if (n >= before.planes.size())
    return;
  if (part == presenters::CutPart::Line)
  {
    const Handle handle = handleOfPlane(n);
    m_heldCut = HeldCut{n, handle.reading};
    return beginDrag([from, dragged = handle.dragged](const Eigen::Vector3d& to)
                     { return dragged(to - from); });
  }
  const auto slice = m_slices.views()[static_cast<std::size_t>(orientation)]->slice();
  const Eigen::Vector3d axis = slice.axes().right.cross(slice.axes().down);
  const Eigen::Vector3d pivot = presenters::pivotInSlice(before.planes[n], grid, slice);
  m_heldCut = HeldCut{n, [this, n] { return readTurn(n, m_before); }};
  beginDrag(
      [before, n, grid, axis, pivot, from](const Eigen::Vector3d& to)
      {
        Clipping clipping = before;
        clipping.planes[n] = presenters::turnedPlane(
            before.planes[n], axis, pivot, presenters::draggedAngle(axis, pivot, from, to), grid);
        return clipping;
      });
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
  const bool isRead = m_held || m_heldCut;
  m_held.reset();
  m_heldCut.reset();
  if (!std::exchange(m_drag, {}) || !m_model.hasCase())
    return;
  record(m_before);
  if (isRead)
    refresh(); // without its reading
}

void ClippingController::tellSize()
{
  const Clipping& clipping = m_model.value().view.clipping;
  const CropFrame frame(m_model.value().ct.geometry);
  emit statusMessage(tr("Crop box: %1").arg(boxSizeText(frame.box(clipping.crop).box.sizes())));
}

// Of the box while it is shown, and of each plane.
std::vector<ClippingController::Handle> ClippingController::handles(bool whole) const
{
  std::vector<Handle> all;
  if (!m_model.hasCase() || !hasHandles())
    return all;
  const Clipping& clipping = m_model.value().view.clipping;
  if (showsBox())
  {
    const CropFrame frame(m_model.value().ct.geometry);
    const HandledBox box = frame.box(clipping.crop);
    for (const FaceHandle& face : presenters::faceHandles(box))
      all.push_back(handleOf(face, whole));
    if (clipping.crop) // all of the image cannot move
      all.push_back(handleOfMiddle());
  }
  for (std::size_t n = 0; n < clipping.planes.size(); ++n)
    all.push_back(handleOfPlane(n));
  return all;
}

ClippingController::Handle ClippingController::handleOf(const FaceHandle& face, bool whole) const
{
  const CropFrame frame(m_model.value().ct.geometry);
  const Clipping before = m_model.value().view.clipping;
  presenters::BoxFaces faces;
  faces.upper[face.axis] = whole || face.isUpper;
  faces.lower[face.axis] = whole || !face.isUpper;
  Handle handle;
  handle.at = face.at;
  handle.direction = face.normal;
  handle.alongSight = tr("Turn the patient: this face is dragged along the line of sight");
  handle.dragged = draggedBox(frame, before, faces);
  handle.reading = [box = frame.box(before.crop).box, face]
  {
    const auto axis = static_cast<Eigen::Index>(face.axis);
    return tr("%1 = %2 mm, width %3 mm")
        .arg(QChar("xyz"[face.axis]),
             numberText(face.isUpper ? box.max()[axis] : box.min()[axis], 1),
             numberText(box.sizes()[axis], 1));
  };
  return handle;
}

ClippingController::Handle ClippingController::handleOfMiddle() const
{
  const CropFrame frame(m_model.value().ct.geometry);
  const Clipping before = m_model.value().view.clipping;
  const HandledBox box = frame.box(before.crop);
  presenters::BoxFaces faces;
  faces.lower.fill(true);
  faces.upper.fill(true);
  Handle handle;
  handle.at = box.patientFromBox * box.box.center();
  handle.dragged = draggedBox(frame, before, faces);
  handle.reading = [middle = Eigen::Vector3d(box.box.center())]
  {
    return tr("middle at x = %1, y = %2, z = %3 mm")
        .arg(numberText(middle[0], 1), numberText(middle[1], 1), numberText(middle[2], 1));
  };
  return handle;
}

ClippingController::Handle ClippingController::handleOfPlane(std::size_t n) const
{
  const core::GridGeometry& grid = m_model.value().ct.geometry;
  const Clipping before = m_model.value().view.clipping;
  const Clipping::Plane& plane = before.planes[n];
  Handle handle;
  handle.at = presenters::planeCenter(plane, grid) + kArrow * plane.normal;
  handle.direction = plane.normal;
  handle.arrow = kArrow;
  handle.alongSight = tr("Turn the patient: the plane is dragged along the line of sight");
  handle.dragged = [before, n, grid](const Eigen::Vector3d& step)
  {
    Clipping clipping = before;
    clipping.planes[n] =
        presenters::movedPlane(before.planes[n], step.dot(before.planes[n].normal), grid);
    return clipping;
  };
  handle.reading = [this, n] { return readPlane(n, m_before); };
  return handle;
}

// Where it lies now, and by how much it was moved since.
QString ClippingController::readPlane(std::size_t n, const Clipping& before) const
{
  const scene::Case& value = m_model.value();
  if (n >= value.view.clipping.planes.size() || n >= before.planes.size())
    return {};
  const Clipping::Plane& plane = value.view.clipping.planes[n];
  const QString moved = numberText(plane.normal.dot(plane.point - before.planes[n].point), 1);
  const auto depth = presenters::depthOf(plane, value.ct.geometry,
                                         [this](const interaction::PickRay& line)
                                         { return m_model.tissueAlong(line); });
  if (!depth)
    return tr("moved by %1 mm").arg(moved);
  return *depth < 0.0 ? tr("%1 mm before the bone's surface, moved by %2 mm")
                            .arg(numberText(-*depth, 1), moved)
                      : tr("%1 mm behind the bone's surface, moved by %2 mm")
                            .arg(numberText(*depth, 1), moved);
}

QString ClippingController::readTurn(std::size_t n, const Clipping& before) const
{
  const std::vector<Clipping::Plane>& planes = m_model.value().view.clipping.planes;
  if (n >= planes.size() || n >= before.planes.size())
    return {};
  const double sine = before.planes[n].normal.cross(planes[n].normal).norm();
  const double cosine = before.planes[n].normal.dot(planes[n].normal);
  return tr("turned by %1°").arg(numberText(std::atan2(sine, cosine) / kDegree, 1));
}

std::vector<std::size_t> ClippingController::handlesAt(const std::vector<Handle>& all,
                                                       const QPointF& position) const
{
  const double ratio = m_view.devicePixelRatioF();
  std::vector<std::pair<double, std::size_t>> found;
  for (std::size_t n = 0; n < all.size(); ++n)
    if (const auto at = m_view.display().pixelOf(all[n].at))
    {
      const double away =
          std::hypot((*at)[0] / ratio - position.x(), (*at)[1] / ratio - position.y());
      if (away < kReach)
        found.emplace_back(away, n);
    }
  std::sort(found.begin(), found.end());
  std::vector<std::size_t> numbers;
  for (const auto& one : found)
    numbers.push_back(one.second);
  return numbers;
}

std::optional<Eigen::Vector3d> ClippingController::draggedTo(const Handle& handle,
                                                             const Eigen::Vector3d& at,
                                                             const QPointF& position) const
{
  const interaction::PickRay line = m_view.sightLine(position);
  if (handle.direction)
  {
    const auto along = presenters::closestAlong(at, *handle.direction, line);
    return along ? std::optional<Eigen::Vector3d>(at + *along * *handle.direction) : std::nullopt;
  }
  const core::CameraPose camera = m_view.picture().camera();
  const Eigen::Vector3d ahead = (camera.focalPoint - camera.position).normalized();
  return line.at(ahead.dot(at - line.origin) / ahead.dot(line.direction));
}

// The nearest that can be dragged: where a face looks along the line of sight, the box's middle.
bool ClippingController::takeHandle(const QPointF& position, bool whole)
{
  const std::vector<Handle> all = handles(whole);
  const std::vector<std::size_t> near = handlesAt(all, position);
  for (const std::size_t number : near)
  {
    const Handle& handle = all[number];
    const auto grabbed = draggedTo(handle, handle.at, position);
    if (!grabbed)
      continue;
    m_held = Held{number, handle};
    m_pressed = position;
    beginDrag([grabbed = *grabbed, dragged = handle.dragged](const Eigen::Vector3d& to)
              { return dragged(to - grabbed); });
    return true;
  }
  if (!near.empty())
    emit statusMessage(all[near.front()].alongSight);
  return false; // the patient turns
}

bool ClippingController::eventFilter(QObject* watched, QEvent* event)
{
  const auto* mouse = watched == &m_view ? dynamic_cast<const QMouseEvent*>(event) : nullptr;
  return mouse && m_model.hasCase() && handleMouse(*mouse);
}

bool ClippingController::handleMouse(const QMouseEvent& event)
{
  const bool isLeft = event.button() == Qt::LeftButton;
  // Of a box that is all of the image nothing moves: Shift pans.
  const bool isWhole =
      event.modifiers() == Qt::ShiftModifier && m_model.value().view.clipping.crop.has_value();
  const bool takes = isLeft && (isWhole || event.modifiers() == Qt::NoModifier);
  switch (event.type())
  {
  case QEvent::MouseButtonPress:
    return takes && takeHandle(event.localPos(), isWhole);
  case QEvent::MouseButtonDblClick: // the second press of who drags it again, and enlarges nothing
    return takes && (takeHandle(event.localPos(), isWhole) ||
                     !handlesAt(handles(), event.localPos()).empty());
  case QEvent::MouseMove:
    if (!m_held)
      return false;
    if (m_pressed && QLineF(*m_pressed, event.localPos()).length() <= kClick)
      return true;
    m_pressed.reset();
    if (const auto to = draggedTo(m_held->handle, m_held->handle.at, event.localPos()))
      drag(*to);
    return true;
  case QEvent::MouseButtonRelease:
    if (!isLeft || !m_held)
      return false;
    endDrag();
    return true;
  default:
    return false;
  }
}

} // namespace petrous::workstation
