#include "MeasureController.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QClipboard>
#include <QFile>
#include <QFileDialog>
#include <QKeyEvent>
#include <QLabel>
#include <QLineF>
#include <QMenu>
#include <QMouseEvent>

#include "Application.h"
#include "AskName.h"
#include "BackgroundWork.h"
#include "MeasurePanel.h"
#include "MenuAction.h"
#include "SceneDisplay.h"
#include "SliceColumn.h"
#include "SliceView.h"
#include "Theme.h"
#include "ThreeDView.h"
#include "WindowTexts.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Library/LibraryFiles.h"
#include "petrous/Presenters/Measuring.h"

namespace petrous::workstation
{

namespace
{

using presenters::MeasurementEditor;
using scene::Measurement;
using Tool = MeasurementEditor::Tool;

constexpr double kClick = 4.0;   // px, that a click may move
constexpr double kReach = 8.0;   // px, to a handle
constexpr double kDeepest = 3.0; // mm, of a handle below the surface on which it is dragged
constexpr double kDrag = 6.0;    // px, from which on a drag is one

struct ToolEntry
{
  Tool tool;
  const char* name;
  int key;
  const char* tip;
};
// In the order of the panel's buttons.
constexpr ToolEntry kTools[] = {
    {Tool::Distance, QT_TRANSLATE_NOOP("petrous::workstation::MeasureController", "&Distance"),
     Qt::SHIFT + Qt::Key_D,
     QT_TRANSLATE_NOOP("petrous::workstation::MeasureController", "Between two points")},
    {Tool::Angle, QT_TRANSLATE_NOOP("petrous::workstation::MeasureController", "&Angle"),
     Qt::SHIFT + Qt::Key_A,
     QT_TRANSLATE_NOOP("petrous::workstation::MeasureController", "At the second of three points")},
    {Tool::Area, QT_TRANSLATE_NOOP("petrous::workstation::MeasureController", "A&rea"),
     Qt::SHIFT + Qt::Key_R,
     QT_TRANSLATE_NOOP("petrous::workstation::MeasureController",
                       "Of a polygon; Return or a double click closes it")},
    {Tool::Mark, QT_TRANSLATE_NOOP("petrous::workstation::MeasureController", "&Mark"),
     Qt::SHIFT + Qt::Key_K,
     QT_TRANSLATE_NOOP("petrous::workstation::MeasureController", "A place with a name")},
    {Tool::Along,
     QT_TRANSLATE_NOOP("petrous::workstation::MeasureController", "Along a &structure"),
     Qt::SHIFT + Qt::Key_L,
     QT_TRANSLATE_NOOP("petrous::workstation::MeasureController",
                       "Along the centre line of a nerve or canal between two points, or along "
                       "points of your own")},
    {Tool::Thickness,
     QT_TRANSLATE_NOOP("petrous::workstation::MeasureController", "&Wall thickness"),
     Qt::SHIFT + Qt::Key_W,
     QT_TRANSLATE_NOOP("petrous::workstation::MeasureController",
                       "Of the bone at a point of its surface, to the next structure or cavity")},
};

DrawnMeasure drawn(const scene::Case& value, const Measurement& measurement, std::size_t index)
{
  DrawnMeasure one;
  one.index = index;
  one.points = measurement.points;
  one.closed = measurement.kind == Measurement::Kind::Area;
  one.color = measureColor(measurement.kind);
  one.label = words(measurement.name);
  if (measurement.kind != Measurement::Kind::Mark)
    one.label += ": " + phrase(presenters::summaryOf(value, measurement));
  if (measurement.kind == Measurement::Kind::Thickness) // the shortest way is in the list
    one.points.resize(2);
  for (std::size_t n = 0; n < one.points.size(); ++n)
    if (MeasurementEditor::isHandle(measurement, n))
      one.handles.push_back(n);
  return one;
}

// Where the slices show most of it.
Eigen::Vector3d middleOf(const Measurement& measurement)
{
  const auto& points = measurement.points;
  if (points.size() == 1)
    return points.front();
  if (measurement.kind == Measurement::Kind::Distance ||
      measurement.kind == Measurement::Kind::Thickness)
    return 0.5 * (points[0] + points[1]);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points)
    mean += point / static_cast<double>(points.size());
  return *std::min_element(points.begin(), points.end(),
                           [&mean](const Eigen::Vector3d& a, const Eigen::Vector3d& b)
                           { return (a - mean).squaredNorm() < (b - mean).squaredNorm(); });
}

} // namespace

MeasureController::MeasureController(presenters::WorkstationModel& model, SliceColumn& slices,
                                     ThreeDView& view, QWidget& window)
  : QObject(&window)
  , m_model(model)
  , m_slices(slices)
  , m_view(view)
  , m_window(window)
  , m_editor(model)
  , m_work(std::make_unique<BackgroundWork>())
  , m_computing(std::make_unique<BackgroundWork>())
  , m_menu(new QMenu(tr("&Measure"), &window))
  , m_tools(new QActionGroup(this))
{
  addActions();
  connectPanel();
  connectSlices();
  m_view.installEventFilter(this);
  m_editor.events.changed = [this] { refresh(); };
  m_editor.events.hovered = [this] { draw(); };
  m_editor.inLanguage = [](const std::string& name) { return bytes(phrase(name)); };
  m_editor.inBackground = [this](MeasurementEditor::Work work) { compute(std::move(work)); };
  connect(m_computing.get(), &BackgroundWork::progressed, this,
          [this](double fraction, const QString&, const QString& left)
          {
            emit statusMessage(
                withTimeLeft(tr("Measuring: %1 %").arg(static_cast<int>(100.0 * fraction)), left));
          });
  connect(m_computing.get(), &BackgroundWork::failed, this,
          [this](const QString& why)
          {
            attempt([this] { m_editor.workEnded(); });
            m_panel->say(sentence(why));
          });
  connect(m_computing.get(), &BackgroundWork::cancelled, this,
          [this] { attempt([this] { m_editor.workEnded(); }); });
  connect(m_work.get(), &BackgroundWork::failed, this,
          [this](const QString& why)
          {
            m_panel->showQuantities({});
            m_panel->say(sentence(why));
          });
  refresh();
}

MeasureController::~MeasureController()
{
  m_editor.events = {};
  m_editor.inLanguage = {};
  m_editor.inBackground = {};
  m_view.removeEventFilter(this);
}

void MeasureController::addActions()
{
  std::vector<QAction*> tools;
  m_tools->setExclusionPolicy(QActionGroup::ExclusionPolicy::ExclusiveOptional);
  for (const ToolEntry& entry : kTools)
  {
    QAction* action = make(m_menu, tr(entry.name), entry.key, tr(entry.tip));
    action->setCheckable(true);
    action->setData(static_cast<int>(entry.tool));
    m_tools->addAction(action);
    tools.push_back(action);
    connect(action, &QAction::triggered, this,
            [this, tool = entry.tool](bool on) { choose(on ? tool : Tool::None); });
  }
  m_menu->addSeparator();
  m_finish = make(m_menu, tr("&End the line or polygon"), {},
                  tr("With the points that are set (Return, or a double click)"));
  m_menu->addSeparator();
  m_showAll = make(m_menu, tr("Show a&ll"), {}, tr("All measurements, in the slices and in 3D"));
  m_hideAll = make(m_menu, tr("&Hide all"), {}, tr("The list keeps them"));
  m_export = make(m_menu, tr("E&xport as a table…"), {},
                  tr("All measurements and the volumes of structures, as CSV"));
  connect(m_finish, &QAction::triggered, this, [this] { attempt([this] { m_editor.finish(); }); });
  connect(m_showAll, &QAction::triggered, this, [this] { m_editor.setAllShown(true); });
  connect(m_hideAll, &QAction::triggered, this, [this] { m_editor.setAllShown(false); });
  connect(m_export, &QAction::triggered, this, &MeasureController::exportCsv);
  m_panel = new MeasurePanel(m_model, m_editor, tools);
  m_panel->installEventFilter(this);
}

void MeasureController::connectPanel()
{
  const auto index = [](int row) { return static_cast<std::size_t>(row); };
  connect(m_panel, &MeasurePanel::goToAsked, this, [=](int row) { goTo(index(row)); });
  connect(m_panel, &MeasurePanel::renamed, this,
          [=](int row, const QString& name)
          {
            if (attempt([&] { m_editor.rename(index(row), bytes(name)); }))
              return;
            const QString why = m_panel->findChild<QLabel*>("measureHint")->text();
            emit statusMessage(why);
          });
  connect(m_panel, &MeasurePanel::shownAsked, this,
          [=](int row, bool shown) { m_editor.setShown(index(row), shown); });
  connect(m_panel, &MeasurePanel::removalAsked, this,
          [=](int row) { m_editor.remove(index(row)); });
  connect(m_panel, &MeasurePanel::chosenChanged, this,
          [=](int row)
          { m_editor.choose(row < 0 ? std::nullopt : std::optional<std::size_t>(index(row))); });
  connect(m_panel, &MeasurePanel::exportOffered, m_export, &QAction::setEnabled);
  connect(m_panel, &MeasurePanel::exportAsked, this, &MeasureController::exportCsv);
  connect(m_panel, &MeasurePanel::copyAsked, this,
          [=](int row) { copy(row < 0 ? std::nullopt : std::optional<std::size_t>(index(row))); });
  connect(m_panel, &MeasurePanel::structureAsked, this,
          [this](const QString& structure, const QString& other)
          { measureStructure(bytes(structure), bytes(other)); });
}

void MeasureController::connectSlices()
{
  connect(&m_slices, &SliceColumn::toolPressed, this,
          [this](const Eigen::Vector3d& patient, presenters::SliceOrientation plane)
          {
            if (!active())
              return;
            m_editor.setImage(m_slices.mrAlone());
            const presenters::Slab& slab = m_slices.slab();
            if (slab.thickness > 0.0 && slab.projection == presenters::Projection::Mean)
              emit statusMessage(
                  tr("The slices show the mean of a slab: the point lies in its middle, whatever "
                     "depth is seen there"));
            const bool begins = m_editor.tool() == Tool::Distance && m_editor.points().empty();
            set(patient);
            m_pressed = begins ? std::optional<Eigen::Vector3d>(patient) : std::nullopt;
            m_apart = kDrag * m_slices.mmPerPixel(plane);
            m_facing = m_slices.planes().axes(plane).next;
          });
  connect(&m_slices, &SliceColumn::toolDragged, this,
          [this](const Eigen::Vector3d& patient)
          {
            if (!active())
              return;
            m_dragged = patient;
            hoverInSlice(patient);
          });
  connect(&m_slices, &SliceColumn::toolReleased, this,
          [this]
          {
            // Pulled from one end to the other; depths in a slab differ from pixel to pixel.
            if (active() && m_pressed && m_dragged &&
                (*m_dragged - *m_pressed).cross(m_facing).norm() > m_apart)
              set(*m_dragged);
            m_pressed.reset();
            m_dragged.reset();
          });
  connect(&m_slices, &SliceColumn::toolDoubleClicked, this,
          [this]
          {
            if (active())
              attempt([this] { m_editor.finish(); });
          });
  connect(&m_slices, &SliceColumn::pointed, this,
          [this](const Eigen::Vector3d& patient)
          {
            if (!active() || m_editor.points().empty())
              return;
            hoverInSlice(patient);
          });
  connect(&m_slices, &SliceColumn::handleTaken, this,
          [this](std::size_t measurement, std::size_t point)
          { m_editor.take(measurement, point); });
  connect(&m_slices, &SliceColumn::handleDragged, this,
          [this](const Eigen::Vector3d& patient)
          {
            m_editor.setImage(m_slices.mrAlone());
            attempt([&] { m_editor.drag(patient); });
          });
  connect(&m_slices, &SliceColumn::handleReleased, this,
          [this]
          {
            m_editor.release();
            emit changed();
          });
  for (SliceView* view : m_slices.findChildren<SliceView*>())
    view->installEventFilter(this);
}

void MeasureController::hoverInSlice(const Eigen::Vector3d& patient)
{
  m_hoversInView = false;
  m_editor.setImage(m_slices.mrAlone());
  m_editor.hover(patient);
}

// Nothing waits for the work before.
void MeasureController::compute(MeasurementEditor::Work work)
{
  if (!work)
    return m_computing->abandon();
  m_computing->replace(
      [this, work = std::move(work)](const core::Progress& progress) -> BackgroundWork::Reply
      {
        return [this, apply = work(progress)]
        {
          const std::size_t before = m_editor.all().size();
          attempt(apply);
          announce(before);
          if (!m_editor.dragging())
            emit changed(); // a drag that ended meanwhile
        };
      });
}

void MeasureController::caseChanged()
{
  m_work->abandon();
  m_pressed.reset();
  m_dragged.reset();
  m_holdsHandle = false;
  m_editor.caseChanged();
  m_panel->caseChanged();
}

void MeasureController::partsChanged()
{
  if (m_work->busy())
    m_panel->showQuantities({});
  m_work->abandon();
  m_editor.partsChanged();
}

void MeasureController::measurementsChanged()
{
  m_editor.measurementsChanged(); // which refreshes, unless it is about to
  if (!m_editor.dragging())
    emit changed();
}

bool MeasureController::active() const
{
  return m_editor.tool() != Tool::None;
}

void MeasureController::leaveTool()
{
  if (active())
    choose(Tool::None);
}

bool MeasureController::hasPoints() const
{
  return !m_editor.points().empty();
}

bool MeasureController::canUndo() const
{
  return m_editor.canUndo();
}

bool MeasureController::canRedo() const
{
  return m_editor.canRedo();
}

QString MeasureController::undoText() const
{
  return phrase(m_editor.undoText());
}

QString MeasureController::redoText() const
{
  return phrase(m_editor.redoText());
}

void MeasureController::undo()
{
  attempt([this] { m_editor.undo(); });
}

void MeasureController::redo()
{
  attempt([this] { m_editor.redo(); });
}

void MeasureController::choose(Tool tool)
{
  if (tool != Tool::None && m_model.hasCase())
    emit toolTaken(); // before, as putting the others away leaves the tool of this
  m_panel->say({});
  keepPoints();
  m_editor.setTool(tool);
  refresh();
}

// Of the tool that is put away: a measurement if they are enough for one.
void MeasureController::keepPoints()
{
  if (!m_model.hasCase() || !hasPoints())
    return;
  const std::size_t before = m_editor.all().size();
  if (m_editor.canFinish() && attempt([this] { m_editor.finish(); }))
    return announce(before);
  emit statusMessage(tr("The points that were set are dropped: they do not make a measurement"));
}

bool MeasureController::attempt(const std::function<void()>& what)
{
  m_panel->say({});
  try
  {
    what();
    return true;
  }
  catch (const std::exception& error)
  {
    m_panel->say(sentence(toString(error)));
    return false;
  }
}

void MeasureController::set(const Eigen::Vector3d& patient)
{
  const std::size_t before = m_editor.all().size();
  attempt([&] { m_editor.set(patient); });
  announce(before);
}

// What was added to so many measurements.
void MeasureController::announce(std::size_t before)
{
  if (m_editor.all().size() <= before)
    return;
  const Measurement& made = m_editor.all().back();
  emit statusMessage(words(made.name) + ": " +
                     phrase(presenters::summaryOf(m_model.value(), made)));
}

void MeasureController::refresh()
{
  const bool open = m_model.hasCase();
  const Tool tool = m_editor.tool();
  for (QAction* action : m_tools->actions())
  {
    action->setEnabled(open);
    action->setChecked(action->data().toInt() == static_cast<int>(tool));
  }
  const auto& all = m_editor.all();
  const auto isShown = [](const Measurement& one) { return one.shown; };
  m_finish->setEnabled(m_editor.canFinish());
  m_showAll->setEnabled(!std::all_of(all.begin(), all.end(), isShown));
  m_hideAll->setEnabled(std::any_of(all.begin(), all.end(), isShown));
  m_slices.setMeasuring(active());
  draw();
  m_panel->refresh();
  emit stateChanged();
}

void MeasureController::draw()
{
  std::vector<DrawnMeasure> measures;
  const auto& all = m_editor.all();
  for (std::size_t n = 0; n < all.size(); ++n)
    if (all[n].shown)
    {
      measures.push_back(drawn(m_model.value(), all[n], n));
      measures.back().chosen = m_editor.chosen() == n;
    }
  std::vector<DrawnMeasure> inView = measures;
  if (auto draft = m_editor.draft())
  {
    DrawnMeasure one = drawn(m_model.value(), *draft, all.size());
    const auto value = scene::valueOf(draft->kind, draft->points);
    one.label = value ? phrase(presenters::toString(
                            presenters::quantitiesOf(m_model.value(), *draft).front()))
                      : QString();
    one.closed = one.closed && draft->points.size() > 2;
    one.draft = true;
    one.handles.clear();
    for (std::size_t n = 0; n < one.points.size(); ++n)
      one.handles.push_back(n);
    measures.push_back(one);
    // While the pointer is in a slice the 3D view would be drawn for each of its moves.
    if (!m_hoversInView)
    {
      one.points = m_editor.points();
      one.handles.resize(one.points.size());
      one.closed = one.closed && one.points.size() > 2;
      one.label.clear();
    }
    inView.push_back(std::move(one));
  }
  m_slices.setMeasures(measures);
  m_view.display().setMeasures(inView);
}

void MeasureController::goTo(std::size_t measurement)
{
  if (measurement >= m_editor.all().size())
    return;
  m_editor.choose(measurement);
  m_model.setCrosshair(middleOf(m_editor.all()[measurement]));
}

void MeasureController::copy(std::optional<std::size_t> measurement)
{
  QString text;
  const auto& all = m_editor.all();
  for (std::size_t n = 0; n < all.size(); ++n)
    if (!measurement || *measurement == n)
      text +=
          words(all[n].name) + "\t" + phrase(presenters::summaryOf(m_model.value(), all[n])) + "\n";
  if (text.isEmpty())
    return;
  QApplication::clipboard()->setText(text);
  emit statusMessage(measurement ? tr("The measurement is on the clipboard")
                                 : tr("%1 measurements are on the clipboard").arg(all.size()));
}

void MeasureController::exportCsv()
{
  if (!m_model.hasCase())
    return;
  QFileDialog dialog(&m_window, tr("Export measurements"));
  dialog.setObjectName("exportMeasurementsDialog");
  dialog.setNameFilter(tr("Tables (*.csv)"));
  dialog.setDefaultSuffix("csv");
  dialog.selectFile(words(m_model.value().name) + " " + tr("measurements") + ".csv");
  const std::filesystem::path file = askFile(dialog);
  if (file.empty() || !m_model.hasCase())
    return;
  if (attempt(
          [&]
          {
            library::refuseOverwriting(file, m_model.library().folder());
            core::writeFile(file, presenters::measurementsCsv(m_model.value()));
          }))
    emit statusMessage(tr("The measurements are in %1").arg(QFile::decodeName(file.c_str())));
}

// In another thread: the surface of a large structure takes seconds.
void MeasureController::measureStructure(const std::string& structure, const std::string& other)
{
  if (!m_model.hasCase() || structure.empty())
    return;
  m_panel->say({});
  if (!m_model.loaded())
    return m_panel->say(tr("The structures are still being loaded."));
  m_panel->showBusy();
  m_work->replace(
      [this, structure, other,
       value = m_model.presentable()](const core::Progress& progress) -> BackgroundWork::Reply
      {
        std::vector<presenters::Quantity> quantities;
        if (other.empty() || other == structure)
          quantities = presenters::dimensionsOf(value, structure, progress);
        else
          quantities = {presenters::distanceBetween(value, structure, other, progress).distance};
        return [this, quantities] { m_panel->showQuantities(quantities); };
      });
}

std::optional<std::array<std::size_t, 2>> MeasureController::handleAt(const QPointF& position) const
{
  if (viewTaken && viewTaken())
    return std::nullopt;
  const double ratio = m_view.devicePixelRatioF();
  std::optional<std::array<std::size_t, 2>> found;
  double best = kReach;
  const auto& all = m_editor.all();
  for (std::size_t n = 0; n < all.size(); ++n)
    for (std::size_t p = 0; all[n].shown && p < all[n].points.size(); ++p)
    {
      if (!MeasurementEditor::isHandle(all[n], p))
        continue;
      const auto at = m_view.display().pixelOf(all[n].points[p]);
      if (!at)
        continue;
      const double away =
          std::hypot((*at)[0] / ratio - position.x(), (*at)[1] / ratio - position.y());
      if (away >= best)
        continue;
      best = away;
      found = std::array<std::size_t, 2>{n, p};
    }
  if (!found)
    return std::nullopt;
  // Dragging moves it along the surface that is seen: one that lies deep below it stays.
  const auto surface = m_model.surfaceAt(m_view.sightLine(position));
  if (!surface || (*surface - all[(*found)[0]].points[(*found)[1]]).norm() > kDeepest)
    return std::nullopt;
  return found;
}

bool MeasureController::eventFilter(QObject* watched, QEvent* event)
{
  switch (event->type())
  {
  case QEvent::ShortcutOverride:
  case QEvent::KeyPress:
    if (handleKey(*static_cast<QKeyEvent*>(event), event->type() == QEvent::ShortcutOverride))
    {
      event->accept();
      return true;
    }
    break;
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

// Those of the tool in use; elsewhere they belong to segmenting and the window. `only`: asked
// whether a shortcut is overridden.
bool MeasureController::handleKey(QKeyEvent& event, bool only)
{
  if (!active() || (event.modifiers() & ~Qt::KeypadModifier))
    return false;
  switch (event.key())
  {
  case Qt::Key_Escape:
    if (only)
      return true;
    if (m_editor.points().empty())
      leaveTool();
    else
      m_editor.drop();
    return true;
  case Qt::Key_Return:
  case Qt::Key_Enter:
    if (!only)
      attempt([this] { m_editor.finish(); });
    return true;
  case Qt::Key_Backspace:
    if (m_editor.points().empty())
      return false;
    if (!only)
      m_editor.undo();
    return true;
  default:
    return false;
  }
}

// A click sets a point where the left button does not turn the patient; a handle is dragged along
// the surface.
bool MeasureController::handleMouse(QMouseEvent& event)
{
  const bool isLeft = event.button() == Qt::LeftButton;
  const auto surface = [&] { return m_model.surfaceAt(m_view.sightLine(event.localPos())); };
  switch (event.type())
  {
  case QEvent::MouseButtonPress:
    if (!isLeft || event.modifiers() != Qt::NoModifier)
      return false;
    if (const auto handle = handleAt(event.localPos()))
    {
      m_holdsHandle = true;
      m_clicked = event.localPos(); // until it is dragged
      m_editor.take((*handle)[0], (*handle)[1]);
      return true;
    }
    if (active())
      m_clicked = event.localPos();
    return false;
  case QEvent::MouseButtonDblClick:
    if (!isLeft || !active())
      return false;
    m_swallowsRelease = true;
    // Its first click may have made a measurement: the second one begins no other.
    m_editor.setImage({});
    if (const auto at = m_editor.points().empty() ? std::nullopt : surface())
      set(*at);
    attempt([this] { m_editor.finish(); });
    return true;
  case QEvent::MouseMove:
    if (m_holdsHandle)
    {
      if (m_clicked && QLineF(*m_clicked, event.localPos()).length() <= kClick)
        return true;
      m_clicked.reset();
      m_editor.setImage({});
      if (const auto at = surface())
        attempt([&] { m_editor.drag(*at); });
      return true;
    }
    if (m_clicked && QLineF(*m_clicked, event.localPos()).length() > kClick)
      m_clicked.reset(); // it turns the patient
    if (active() && !m_editor.points().empty() && event.buttons() == Qt::NoButton)
    {
      m_hoversInView = true;
      m_editor.setImage({});
      m_editor.hover(surface());
    }
    return false;
  default:
    break;
  }
  if (!isLeft)
    return false;
  if (m_holdsHandle)
  {
    m_holdsHandle = false;
    m_clicked.reset();
    m_editor.release();
    emit changed();
    return true;
  }
  if (std::exchange(m_swallowsRelease, false))
    return true;
  const auto clicked = std::exchange(m_clicked, std::nullopt);
  if (!active() || !clicked || QLineF(*clicked, event.localPos()).length() > kClick)
    return false;
  m_editor.setImage({});
  if (const auto at = surface())
    set(*at);
  else if (m_model.isCutAway(m_view.sightLine(event.localPos())))
    m_panel->say(cutAwayText());
  else
    m_panel->say(m_model.ready() ? tr("There is nothing under the pointer.")
                                 : tr("The case is still being prepared; then the surface can be "
                                      "clicked. The slices can be already."));
  return false;
}

} // namespace petrous::workstation
