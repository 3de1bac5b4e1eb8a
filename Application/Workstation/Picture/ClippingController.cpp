#include "ClippingController.h"

#include <array>
#include <cmath>
#include <utility>

#include <QAction>
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
constexpr double kStep = 0.5;  // mm, of a key

// The edges of a box, and a handle at the middle of each face.
std::vector<DrawnMeasure> drawn(const HandledBox& box)
{
  using Box = Eigen::AlignedBox3d;
  const auto corner = [&box](int n) -> Eigen::Vector3d
  { return box.patientFromBox * box.box.corner(static_cast<Box::CornerType>(n)); };
  std::vector<DrawnMeasure> parts;
  const auto add = [&parts](std::vector<Eigen::Vector3d> points, std::vector<std::size_t> handles)
  {
    DrawnMeasure part;
    part.index = parts.size();
    part.points = std::move(points);
    part.handles = std::move(handles);
    part.color = boxColor();
    parts.push_back(std::move(part));
  };
  // Each edge by itself, as one that reaches behind the camera is not drawn.
  for (int from = 0; from < 8; ++from)
    for (const int along : {1, 2, 4})
      if (!(from & along))
        add({corner(from), corner(from | along)}, {});
  for (const FaceHandle& handle : presenters::faceHandles(box))
    add({handle.at}, {0});
  return parts;
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
  m_actions.cropBox->setChecked(false);
  if (m_dialog)
    m_dialog->close();
  refresh();
}

bool ClippingController::toolHasView() const
{
  return m_view.tool().GetDrillMode() || m_view.tool().GetProbeMode();
}

bool ClippingController::showsHandles() const
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
  const bool isShown = showsHandles();
  m_slices.setBox(isShown ? std::optional(SliceBox{box}) : std::nullopt);
  m_view.display().setHandles(isShown ? drawn(box) : std::vector<DrawnMeasure>());
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
    m_slices.fit(); // its edges are the image's
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

bool ClippingController::takeFace(const QPointF& position)
{
  if (!showsHandles())
    return false;
  const CropFrame frame(m_model.value().ct.geometry);
  const Clipping before = m_model.value().view.clipping;
  const std::array<FaceHandle, 6> handles = presenters::faceHandles(frame.box(before.crop));
  const double ratio = m_view.devicePixelRatioF();
  const FaceHandle* found = nullptr;
  double best = kReach;
  for (const FaceHandle& handle : handles)
    if (const auto at = m_view.display().pixelOf(handle.at))
    {
      const double away =
          std::hypot((*at)[0] / ratio - position.x(), (*at)[1] / ratio - position.y());
      if (away >= best)
        continue;
      best = away;
      found = &handle;
    }
  if (!found)
    return false;
  const auto grabbed =
      presenters::closestAlong(found->at, found->normal, m_view.sightLine(position));
  if (!grabbed)
  {
    emit statusMessage(tr("Turn the patient: this face is dragged along the line of sight"));
    return true;
  }
  m_line = Line{found->at, found->normal};
  presenters::BoxFaces faces;
  (found->isUpper ? faces.upper : faces.lower)[found->axis] = true;
  beginDrag(
      [frame, before, faces,
       from = m_line->at + *grabbed * m_line->direction](const Eigen::Vector3d& to)
      {
        Clipping clipping = before;
        clipping.crop = frame.dragged(before.crop, faces, from, to);
        return clipping;
      });
  return true;
}

bool ClippingController::eventFilter(QObject* watched, QEvent* event)
{
  switch (event->type())
  {
  case QEvent::MouseButtonPress:
  case QEvent::MouseButtonDblClick:
  case QEvent::MouseButtonRelease:
  case QEvent::MouseMove:
    if (watched == &m_view && m_model.hasCase())
      return handleMouse(*static_cast<QMouseEvent*>(event));
    break;
  default:
    break;
  }
  return QObject::eventFilter(watched, event);
}

bool ClippingController::handleMouse(const QMouseEvent& event)
{
  const bool isLeft = event.button() == Qt::LeftButton;
  switch (event.type())
  {
  case QEvent::MouseButtonPress:
    return isLeft && event.modifiers() == Qt::NoModifier && takeFace(event.localPos());
  case QEvent::MouseMove:
    if (!m_line)
      return false;
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
