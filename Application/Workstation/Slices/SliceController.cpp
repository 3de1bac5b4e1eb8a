#include "SliceController.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <QAction>
#include <QActionGroup>
#include <QMenu>

#include "MenuAction.h"
#include "SliceColumn.h"
#include "SliceView.h"
#include "SlicesPanel.h"
#include "Theme.h"
#include "ThreeDView.h"
#include "WindowSettings.h"
#include "WindowTexts.h"
#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::workstation
{

namespace
{

using presenters::Projection;
using presenters::Slab;
using presenters::SlicePlanes;
using scene::Side;

constexpr double kThicknesses[] = {1.0, 2.0, 3.0, 5.0, 8.0, 12.0, 20.0, 30.0, 50.0}; // mm
constexpr double kFollows = 0.999962; // cosine of half a degree: less, and the planes stay
constexpr double kDegree = 3.14159265358979323846 / 180.0;

} // namespace

SliceController::SliceController(presenters::WorkstationModel& model, ThreeDView& view,
                                 SliceColumn& slices, WindowSettings& kept, QWidget& window)
  : QObject(&window)
  , m_model(model)
  , m_view(view)
  , m_slices(slices)
  , m_kept(kept)
  , m_menu(new QMenu(tr("S&lices"), &window))
{
  makeMenu(window);
  m_panel = new SlicesPanel(model, slices, *this, kept);
  setZoomTogether(kept.zoomTogether());
  setZoomWithScene(kept.zoomWithScene());
  connect(&slices, &SliceColumn::planesChanged, this, &SliceController::showState);
  connect(&slices, &SliceColumn::slabChanged, this, &SliceController::showState);
  connect(&slices, &SliceColumn::windowChanged, m_panel, &SlicesPanel::refresh);
  connect(&slices, &SliceColumn::menuAsked, m_menu,
          [this](const QPoint& global) { m_menu->popup(global); });
  connect(&view, &ThreeDView::cameraMoved, this, &SliceController::followScene);
  showState();
}

void SliceController::makeMenu(QWidget&)
{
  m_menu->setToolTipsVisible(true);
  addPlanes();
  m_menu->addSeparator();
  addWindows();
  m_menu->addSeparator();
  addSlabs();
  m_menu->addSeparator();
  addZoom();
}

void SliceController::addPlanes()
{
  m_planes = new QActionGroup(this);
  const auto add = [this](const QString& text, int key, Kind kind, Side side, const QString& tip)
  {
    QAction* action = make(m_menu, text, key, tip);
    action->setCheckable(true);
    action->setData(static_cast<int>(kind));
    m_planes->addAction(action);
    connect(action, &QAction::triggered, this, [this, kind, side] { setPlanes(kind, side); });
    return action;
  };
  add(tr("&Axial, coronal, sagittal"), Qt::CTRL + Qt::Key_6, Kind::Standard, Side::Unknown,
      tr("Along the patient's axes; puts turned planes back"));
  add(tr("&Pöschl and Stenvers planes"), Qt::CTRL + Qt::Key_7, Kind::Petrous, Side::Unknown,
      tr("Upright, at 45° across and along the petrous bone of the ear's side, in place of the "
         "sagittal and the coronal slice"));
  add(tr("Along the too&l"), Qt::CTRL + Qt::Key_8, Kind::Tool, Side::Unknown,
      tr("One plane across the tool's axis and two along it, which follow the tool; without a tool "
         "in use, along the line of sight"));
  QAction* byHand =
      add(tr("Turned by &hand"), 0, Kind::Free, Side::Unknown,
          tr("Ctrl+drag in a slice turns the other two planes, Ctrl+arrow keys tilt it"));
  byHand->setEnabled(false);
}

void SliceController::addWindows()
{
  m_windows = m_menu->addMenu(tr("&Grey window"));
  connect(m_windows, &QMenu::aboutToShow, this, &SliceController::fillWindows);
  fillWindows();
}

void SliceController::fillWindows()
{
  m_windows->clear();
  const auto display = m_slices.seenDisplay();
  const auto add = [&](const QString& name, const presenters::GreyWindow& window)
  {
    QAction* action = m_windows->addAction(tr("%1: W %2  L %3")
                                               .arg(QString(name).replace('&', "&&"),
                                                    numberText(display.number(window.width)),
                                                    numberText(display.number(window.level))));
    connect(action, &QAction::triggered, &m_slices,
            [this, window] { m_slices.setSeenWindow(window); });
  };
  for (const presenters::NamedWindow& one : m_slices.seenWindows())
    add(windowName(one.name), one.window);
  for (const presenters::NamedWindow& one :
       m_kept.greyWindows(m_panel ? m_panel->windowKind() : ""))
    add(words(one.name), one.window);
}

void SliceController::addSlabs()
{
  m_slabs = new QActionGroup(this);
  const auto add = [this](const QString& text, int projection, const QString& tip)
  {
    QAction* action = make(m_menu, text, {}, tip);
    action->setCheckable(true);
    action->setData(projection);
    m_slabs->addAction(action);
    connect(action, &QAction::triggered, this,
            [this, projection]
            {
              Slab slab = m_lastSlab;
              if (projection < 0)
                slab.thickness = 0.0;
              else
                slab.projection = static_cast<Projection>(projection);
              setSlab(slab);
            });
  };
  add(tr("&Thin slice"), -1, tr("Without a slab"));
  add(tr("Slab: &brightest (MIP)"), static_cast<int>(Projection::Maximum),
      tr("Maximum intensity projection through a layer about the slice"));
  add(tr("Slab: &darkest (MinIP)"), static_cast<int>(Projection::Minimum),
      tr("Minimum intensity projection: air cells"));
  add(tr("Slab: m&ean"), static_cast<int>(Projection::Mean), tr("As a thicker slice: less noise"));
  connect(make(m_menu, tr("&Next projection"), Qt::CTRL + Qt::Key_J,
               tr("Thin, MIP, MinIP, mean in turn")),
          &QAction::triggered, this, &SliceController::nextProjection);
  const auto step = [this](const QString& text, int bracket, int key, int by, const QString& tip)
  {
    QAction* action = make(m_menu, text, bracket, tip);
    addKey(*action, key);
    connect(action, &QAction::triggered, this, [this, by] { stepSlab(by); });
  };
  step(tr("Thi&cker slab"), Qt::CTRL + Qt::Key_BracketRight, Qt::SHIFT + Qt::Key_J, 1,
       tr("1, 2, 3, 5, 8, 12, 20, 30 or 50 mm"));
  step(tr("Thinne&r slab"), Qt::CTRL + Qt::Key_BracketLeft, Qt::CTRL + Qt::SHIFT + Qt::Key_J, -1,
       tr("50, 30, 20, 12, 8, 5, 3, 2 or 1 mm, then the thin slice"));
}

void SliceController::addZoom()
{
  const auto add =
      [this](const QString& text, int key, const QString& tip, void (SliceController::*set)(bool))
  {
    QAction* action = make(m_menu, text, key, tip);
    action->setCheckable(true);
    connect(action, &QAction::triggered, this, set);
    return action;
  };
  m_zoomTogether = add(tr("&Zoom slices together"), Qt::CTRL + Qt::Key_9,
                       tr("A slice that is zoomed takes the others along, to one scale"),
                       &SliceController::setZoomTogether);
  m_zoomWithScene = add(tr("Zoom &with the 3D view"), Qt::CTRL + Qt::Key_0,
                        tr("The slices have the scale of the 3D view where it turns about"),
                        &SliceController::setZoomWithScene);
}

void SliceController::setPlanes(Kind kind, Side side)
{
  if (!m_model.hasCase())
    return;
  switch (kind)
  {
  case Kind::Standard:
    return m_slices.setPlanes({});
  case Kind::Petrous:
    if (const auto ear =
            side == Side::Unknown ? presenters::earOf(m_model.value()) : std::optional<Side>(side))
      return m_slices.setPlanes(SlicePlanes::petrous(*ear));
    showState(); // the menu has ticked it
    return emit statusMessage(tr("Which ear it is, is not known: choose it with the planes in the "
                                 "panel Slices, or state the side (Case > Side)"));
  case Kind::Tool:
  {
    const auto& tool = m_view.display().tool();
    const core::CameraPose camera = m_view.picture().camera();
    return m_slices.setPlanes(SlicePlanes::alongTool(
        tool ? tool->axisToHand : Eigen::Vector3d(camera.position - camera.focalPoint),
        m_slices.planes()));
  }
  case Kind::Free:
    break;
  }
}

void SliceController::toolMoved()
{
  const auto& tool = m_view.display().tool();
  if (!tool || m_slices.planes().kind() != Kind::Tool)
    return;
  const SlicePlanes next = SlicePlanes::alongTool(tool->axisToHand, m_slices.planes());
  const auto slice = presenters::SliceOrientation::Axial;
  const auto isSame = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b)
  { return a.dot(b) > kFollows; };
  const auto& before = m_slices.planes().axes(slice);
  if (!isSame(next.axes(slice).next, before.next) || !isSame(next.axes(slice).right, before.right))
    m_slices.setPlanes(next);
}

const Slab& SliceController::slab() const
{
  return m_slices.slab();
}

void SliceController::setSlab(const Slab& slab)
{
  if (slab.thickness > 0.0)
    m_lastSlab = slab;
  m_slices.setSlab(slab);
}

void SliceController::nextProjection()
{
  Slab slab = m_lastSlab;
  if (!(m_slices.slab().thickness > 0.0))
    slab.projection = Projection::Maximum;
  else if (slab.projection == Projection::Mean)
    slab.thickness = 0.0;
  else
    slab.projection = static_cast<Projection>(static_cast<int>(slab.projection) + 1);
  if (slab.thickness > 0.0)
    return setSlab(slab);
  m_slices.setSlab({});
}

void SliceController::stepSlab(int step)
{
  const double now = m_slices.slab().thickness;
  Slab slab = m_lastSlab;
  if (step > 0)
  {
    const double* next = std::upper_bound(std::begin(kThicknesses), std::end(kThicknesses), now);
    slab.thickness = next == std::end(kThicknesses) ? now : *next;
  }
  else
  {
    const double* at = std::lower_bound(std::begin(kThicknesses), std::end(kThicknesses), now);
    slab.thickness = at == std::begin(kThicknesses) ? 0.0 : *(at - 1);
  }
  setSlab(slab);
}

bool SliceController::isZoomTogether() const
{
  return m_zoomTogether->isChecked();
}

bool SliceController::isZoomWithScene() const
{
  return m_zoomWithScene->isChecked();
}

void SliceController::setZoomTogether(bool on)
{
  m_zoomTogether->setChecked(on);
  m_slices.setZoomTogether(on);
  m_kept.keepZoomTogether(on);
  m_panel->refresh();
  followScene();
}

void SliceController::setZoomWithScene(bool on)
{
  m_zoomWithScene->setChecked(on);
  m_kept.keepZoomWithScene(on);
  m_panel->refresh();
  followScene();
}

// Where the camera turns about; a slice's pixels are those of the window.
void SliceController::followScene()
{
  if (!isZoomWithScene() || !m_model.hasCase() || m_view.height() < 1)
    return;
  const core::CameraPose camera = m_view.picture().camera();
  const double distance = (camera.position - camera.focalPoint).norm();
  const double half = camera.parallelScale ? *camera.parallelScale
                                           : distance * std::tan(0.5 * camera.viewAngle * kDegree);
  m_slices.setScale(2.0 * half / m_view.height());
}

void SliceController::setCaseOpen(bool open)
{
  m_menu->setEnabled(open);
  for (QAction* action : m_menu->actions())
    action->setEnabled(open && action->data() != static_cast<int>(Kind::Free));
  if (open)
    showState();
}

void SliceController::showState()
{
  const Kind kind = m_slices.planes().kind();
  for (QAction* action : m_planes->actions())
    action->setChecked(action->data().toInt() == static_cast<int>(kind));
  const Slab& slab = m_slices.slab();
  if (slab.thickness > 0.0)
    m_lastSlab = slab;
  const int projection = slab.thickness > 0.0 ? static_cast<int>(slab.projection) : -1;
  for (QAction* action : m_slabs->actions())
    action->setChecked(action->data().toInt() == projection);
  m_panel->refresh();
}

} // namespace petrous::workstation
