#include "SegmentController.h"

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <future>
#include <memory>
#include <utility>

#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QEventLoop>
#include <QMenu>
#include <QMessageBox>
#include <QProgressDialog>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QTimer>

#include "Application.h"
#include "BackgroundWork.h"
#include "Commands.h"
#include "MenuAction.h"
#include "SegmentPanel.h"
#include "SliceColumn.h"
#include "SliceView.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Presenters/TimeLeft.h"

namespace petrous::workstation
{

namespace
{
using presenters::SegmentEditor;
using Tool = SegmentEditor::Tool;

constexpr int kSurfaceAfter = 400;  // ms after the last change
constexpr double kBrushStep = 1.2;  // factor
constexpr double kLeastBrush = 0.1; // mm
const QColor kPoint("#ffd040");
const QColor kPath("#ffd040");
const QColor kOutside("#ff6a3c"); // a point beside the path
const QColor kEraser("#f2f5f8");

struct ToolEntry
{
  Tool tool;
  const char* name;
  int key;
  const char* tip;
};
// In the order of the panel's buttons.
constexpr ToolEntry kTools[] = {
    {Tool::Threshold, QT_TRANSLATE_NOOP("petrous::workstation::SegmentController", "&Threshold"),
     Qt::SHIFT + Qt::Key_T,
     QT_TRANSLATE_NOOP(
         "petrous::workstation::SegmentController",
         "All voxels in a range of intensities, or those connected to a clicked point")},
    {Tool::Paint, QT_TRANSLATE_NOOP("petrous::workstation::SegmentController", "&Paint"),
     Qt::SHIFT + Qt::Key_P,
     QT_TRANSLATE_NOOP("petrous::workstation::SegmentController",
                       "Paints with a ball or a disk in the slices")},
    {Tool::Erase, QT_TRANSLATE_NOOP("petrous::workstation::SegmentController", "&Erase"),
     Qt::SHIFT + Qt::Key_E,
     QT_TRANSLATE_NOOP("petrous::workstation::SegmentController",
                       "Erases with a ball or a disk in the slices")},
    {Tool::Grow, QT_TRANSLATE_NOOP("petrous::workstation::SegmentController", "&Grow"),
     Qt::SHIFT + Qt::Key_G,
     QT_TRANSLATE_NOOP("petrous::workstation::SegmentController",
                       "From strokes inside the structure and beside it, by the image")},
    {Tool::Fill, QT_TRANSLATE_NOOP("petrous::workstation::SegmentController", "&Fill"),
     Qt::SHIFT + Qt::Key_F,
     QT_TRANSLATE_NOOP("petrous::workstation::SegmentController",
                       "The slices between those that were painted")},
    {Tool::Nerve, QT_TRANSLATE_NOOP("petrous::workstation::SegmentController", "&Nerve"),
     Qt::SHIFT + Qt::Key_N,
     QT_TRANSLATE_NOOP("petrous::workstation::SegmentController",
                       "A tube along a few clicked points: facial nerve, chorda, vessels")},
    {Tool::Islands, QT_TRANSLATE_NOOP("petrous::workstation::SegmentController", "&Islands"),
     Qt::SHIFT + Qt::Key_I,
     QT_TRANSLATE_NOOP("petrous::workstation::SegmentController", "Removes small parts")},
    {Tool::Margin, QT_TRANSLATE_NOOP("petrous::workstation::SegmentController", "&Margin"),
     Qt::SHIFT + Qt::Key_M,
     QT_TRANSLATE_NOOP("petrous::workstation::SegmentController",
                       "Wider or narrower by some millimetres")},
    {Tool::Smooth, QT_TRANSLATE_NOOP("petrous::workstation::SegmentController", "&Smooth"),
     Qt::SHIFT + Qt::Key_S,
     QT_TRANSLATE_NOOP("petrous::workstation::SegmentController", "Rounds the surface")},
};

bool hasBrushOf(Tool tool)
{
  return tool == Tool::Paint || tool == Tool::Erase || tool == Tool::Grow;
}

bool hasClicks(Tool tool)
{
  return hasBrushOf(tool) || tool == Tool::Threshold || tool == Tool::Nerve ||
         tool == Tool::Islands;
}

QColor colorOf(const std::array<float, 3>& color)
{
  return QColor::fromRgbF(double(color[0]), double(color[1]), double(color[2]));
}
QColor strokeColor(bool inside)
{
  const auto& color = inside ? SegmentEditor::kInsideStroke : SegmentEditor::kBesideStroke;
  return QColor::fromRgbF(double(color[0]) / 255.0, double(color[1]) / 255.0,
                          double(color[2]) / 255.0);
}
} // namespace

SegmentController::SegmentController(presenters::WorkstationModel& model, SliceColumn& slices,
                                     QWidget& window)
  : QObject(&window)
  , m_model(model)
  , m_slices(slices)
  , m_window(window)
  , m_editor(model)
  , m_menu(new QMenu(tr("Se&gment"), &window))
  , m_tools(new QActionGroup(this))
  , m_work(std::make_unique<BackgroundWork>())
  , m_surfaceWork(std::make_unique<BackgroundWork>())
{
  addTools();
  connectPanel();
  connectSlices();
  m_editor.events.changed = [this] { changed(); };
  m_editor.events.voxelsChanged = [this](const core::IndexBox& box)
  {
    if (m_model.hasCase() && !box.empty())
    {
      m_slices.draftChanged(m_model.value().ct.geometry.cropped(box).patientBounds());
      m_panel->showVolume();
    }
  };
  m_editor.events.created = [this](const std::string& name)
  {
    emit structureCreated();
    const scene::StructurePart* made = scene::findStructure(m_model.value(), name);
    const double volume =
        made ? static_cast<double>(made->voxels) * m_model.value().ct.geometry.voxelVolume() : 0.0;
    const QString line = tr("%1 is a structure of the case now, %2; Undo makes it a draft again")
                             .arg(shownName(name), volumeText(volume));
    m_panel->say(line);
    m_created = line;
    emit statusMessage(line);
    if (m_panel->isAncestorOf(QApplication::focusWidget()))
      emit viewFocusAsked(); // keys are those of the next tool
  };
  m_surfaceLater.setSingleShot(true);
  m_surfaceLater.setInterval(kSurfaceAfter);
  connect(&m_surfaceLater, &QTimer::timeout, this, &SegmentController::showSurface);
  changed();
}

SegmentController::~SegmentController()
{
  m_editor.events = {};
}

void SegmentController::addTools()
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
  m_step = make(m_menu, tr("&Apply the tool"), Qt::SHIFT + Qt::Key_Return,
                tr("One step on the draft, which can be undone"));
  m_create = make(m_menu, tr("&Create the structure"), Qt::Key_Return,
                  tr("The draft becomes a structure of the case"));
  m_create->setShortcuts({Qt::Key_Return, Qt::Key_Enter});
  m_escape = make(m_menu, tr("&Leave the tool, or discard the draft"), Qt::Key_Escape,
                  tr("Puts the tool away; without a tool asks whether the draft is dropped"));
  connect(m_step, &QAction::triggered, this, &SegmentController::step);
  connect(m_create, &QAction::triggered, this, &SegmentController::create);
  connect(m_escape, &QAction::triggered, this, &SegmentController::escape);
  for (QAction* action : {m_step, m_create, m_escape})
    action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  m_panel = new SegmentPanel(m_editor, tools);
  addKeysTo(*m_panel);
}

void SegmentController::addKeysTo(QWidget& widget)
{
  widget.addActions({m_step, m_create, m_escape});
}

void SegmentController::connectPanel()
{
  connect(m_panel, &SegmentPanel::stepAsked, this, &SegmentController::step);
  connect(m_panel, &SegmentPanel::cancelAsked, this, [this] { m_work->cancel(); });
  connect(m_panel, &SegmentPanel::undoAsked, this, &SegmentController::undo);
  connect(m_panel, &SegmentPanel::redoAsked, this, &SegmentController::redo);
  connect(m_panel, &SegmentPanel::createAsked, this, &SegmentController::create);
  connect(m_panel, &SegmentPanel::discardAsked, this, &SegmentController::discard);
  connect(m_panel, &SegmentPanel::editAsked, this,
          [this](const QString& structure) { edit(bytes(structure)); });
  connect(m_panel, &SegmentPanel::imageWanted, this, &SegmentController::imageWanted);
  connect(m_panel, &SegmentPanel::pointChosen, this,
          [this](const Eigen::Vector3d& patient) { m_model.setCrosshair(patient); });
  connect(m_panel, &SegmentPanel::pointToCrosshairAsked, this,
          [this](int row)
          {
            if (row >= 0)
              m_editor.moveTubePoint(static_cast<std::size_t>(row), m_model.crosshair());
          });
  connect(m_work.get(), &BackgroundWork::progressed, m_panel, &SegmentPanel::setProgress);
  connect(m_work.get(), &BackgroundWork::failed, this,
          [this](const QString& why)
          {
            m_editor.workFailed(bytes(why));
            if (windowText(words(m_editor.warning())) != why) // else it stands there already
              m_panel->complain(why);
          });
  connect(m_work.get(), &BackgroundWork::cancelled, this,
          [this]
          {
            m_editor.workEnded();
            m_panel->say(tr("Stopped; the draft is as before."));
          });
}

void SegmentController::connectSlices()
{
  connect(&m_slices, &SliceColumn::toolPressed, this,
          [this](const Eigen::Vector3d& patient, presenters::SliceOrientation plane)
          {
            m_createAs.clear();
            attempt([&] { m_editor.press(patient, m_slices.planes().axes(plane).next); });
          });
  connect(&m_slices, &SliceColumn::toolDragged, this,
          [this](const Eigen::Vector3d& patient) { m_editor.drag(patient); });
  connect(&m_slices, &SliceColumn::toolReleased, this, [this] { m_editor.release(); });
}

void SegmentController::strokeEnded()
{
  m_panel->withdraw(std::exchange(m_created, {}));
}

void SegmentController::caseChanged()
{
  m_createAs.clear();
  m_work->drop();
  m_surfaceWork->drop();
  m_editor.caseChanged();
  m_panel->caseChanged();
}

void SegmentController::partsChanged()
{
  m_editor.partsChanged();
}

void SegmentController::mrMoved()
{
  m_editor.mrMoved();
}

void SegmentController::setShown(const presenters::ShownImages& shown)
{
  m_editor.setShown(shown);
}

bool SegmentController::active() const
{
  return m_editor.tool() != Tool::None;
}

bool SegmentController::busy() const
{
  return m_work->busy();
}

bool SegmentController::canUndo() const
{
  return m_editor.canUndo() && !m_editor.stepping();
}

bool SegmentController::canRedo() const
{
  return m_editor.canRedo() && !m_editor.stepping();
}

bool SegmentController::canUndoStep() const
{
  return m_editor.canUndoStep();
}

bool SegmentController::canRedoStep() const
{
  return m_editor.canRedoStep();
}

QString SegmentController::undoText() const
{
  return phrase(m_editor.undoText());
}

QString SegmentController::redoText() const
{
  return phrase(m_editor.redoText());
}

bool SegmentController::hasBrush() const
{
  return hasBrushOf(m_editor.tool());
}

void SegmentController::stepBrush(int steps)
{
  presenters::SegmentValues values = m_editor.values();
  // Steps that are seen and end in a round tenth of a millimetre.
  const double wanted = values.brush * std::pow(kBrushStep, steps);
  const double tenths =
      steps > 0 ? std::max(std::round(10.0 * wanted), std::round(10.0 * values.brush) + 1.0)
                : std::min(std::round(10.0 * wanted), std::round(10.0 * values.brush) - 1.0);
  values.brush = std::max(0.1 * tenths, kLeastBrush);
  m_editor.setValues(values);
}

bool SegmentController::attempt(const std::function<void()>& what)
{
  m_panel->say({});
  try
  {
    what();
    return true;
  }
  catch (const std::exception& error)
  {
    m_panel->complain(toString(error));
    return false;
  }
}

void SegmentController::choose(Tool tool)
{
  m_createAs.clear();
  m_panel->say({});
  if (tool != Tool::None && m_model.hasCase())
    emit toolTaken(); // before, as putting the drill away leaves the tool of this
  m_editor.setTool(tool);
  changed();
}

void SegmentController::leaveTool()
{
  if (active())
    choose(Tool::None);
}

void SegmentController::undo()
{
  if (canUndo())
    attempt(
        [this]
        {
          const QString what = undoText();
          if (!m_editor.undo())
            return;
          emit structureCreated();
          emit statusMessage(tr("Undone: %1; it is a draft again").arg(what));
        });
}

void SegmentController::redo()
{
  if (canRedo())
    attempt([this] { m_editor.redo(); });
}

void SegmentController::changed()
{
  const bool open = m_model.hasCase();
  const Tool tool = m_editor.tool();
  for (QAction* action : m_tools->actions())
  {
    action->setEnabled(open);
    action->setChecked(action->data().toInt() == static_cast<int>(tool));
  }
  const bool draft = m_editor.hasDraft();
  const std::string whyNot = m_editor.whyNotStep();
  enable(*m_step, open && whyNot.empty(), open ? phrase(whyNot) : tr("Open a case first"));
  m_create->setEnabled(open && draft);
  m_escape->setEnabled(open && (draft || tool != Tool::None));
  m_slices.setHidden(m_editor.edited());
  m_slices.setTool(
      hasClicks(tool)
          ? std::optional(SliceTool{hasBrushOf(tool) ? m_editor.values().brush : 0.0,
                                    tool == Tool::Erase  ? kEraser
                                    : tool == Tool::Grow ? strokeColor(m_editor.values().inside)
                                                         : colorOf(m_editor.color())})
          : std::nullopt);
  presenters::DraftLayer layer = m_editor.layer();
  m_slices.setDraft(layer.indexAt ? std::make_shared<const presenters::DraftLayer>(std::move(layer))
                                  : nullptr);
  drawing();
  m_panel->refresh();
  emit stateChanged();
  m_surfaceLater.start();
  askWork();
  if (!m_createAs.empty() && !m_editor.previewPending() && !m_editor.stepping())
    QTimer::singleShot(0, this, &SegmentController::createAtLast);
}

// Return was pressed before the preview was done; what was changed since is not what was meant.
void SegmentController::createAtLast()
{
  const bool isMeant = std::exchange(m_createAs, {}) == m_editor.name() && m_editor.hasDraft();
  m_panel->say({});
  if (isMeant)
    create();
}

// Clicked points and the path between them.
void SegmentController::drawing()
{
  SliceDrawing drawing;
  drawing.color = kPath;
  if (m_editor.tool() == Tool::Nerve)
  {
    drawing.curve = m_editor.path();
    const auto points = m_editor.tubePoints();
    for (std::size_t n = 0; n < points.size(); ++n)
      drawing.marks.push_back({points[n].patient,
                               QString::number(n + 1) + (points[n].isOutside ? "!" : ""),
                               points[n].isOutside ? kOutside : kPoint});
  }
  if (m_editor.tool() == Tool::Threshold)
    for (const Eigen::Vector3d& seed : m_editor.seeds())
      drawing.marks.push_back({seed, {}, kPoint});
  m_slices.setDrawing(drawing);
}

void SegmentController::askWork()
{
  if (m_asking)
    return;
  if (auto work = m_editor.dueWork())
    run(std::move(*work), false);
}

void SegmentController::run(SegmentEditor::Work work, bool step)
{
  m_panel->setProgress(0.0, {}, {});
  m_work->start([work = std::move(work)](const core::Progress& progress) -> BackgroundWork::Reply
                { return work(progress); });
  if (step)
    m_panel->refresh();
}

void SegmentController::step()
{
  m_createAs.clear();
  m_panel->say({});
  if (m_editor.stepping())
    return m_panel->complain(tr("A step is under way; wait, or stop it."));
  m_work->drop(); // a preview
  m_editor.workEnded();
  attempt(
      [this]
      {
        if (auto work = m_editor.stepWork())
          run(std::move(*work), true);
        else
          m_panel->complain(phrase(m_editor.whyNotStep()));
      });
}

void SegmentController::edit(const std::string& structure)
{
  if (m_model.hasCase()) // a menu may be open while a case is closed
    attempt([&] { run(m_editor.edit(structure), true); });
}

void SegmentController::create()
{
  if (m_asking || !m_model.hasCase())
    return;
  if (m_editor.stepping())
    return m_panel->complain(tr("A step is under way; then the structure can be created."));
  if (m_editor.name().empty() && m_editor.hasDraft())
  {
    m_panel->complain(tr("Give the structure a name."));
    return m_panel->focusName();
  }
  if (m_editor.previewPending())
  {
    m_createAs = m_editor.name();
    return m_panel->say(tr("The structure is created when the preview is done."));
  }
  attempt([this] { run(m_editor.createWork(), true); });
}

void SegmentController::discard()
{
  if (!m_editor.hasDraft() || m_asking)
    return;
  m_createAs.clear();
  if (!m_editor.isUnsaved()) // a structure of the case, not changed, or a proposal
  {
    m_work->drop();
    return m_editor.discard();
  }
  const QScopedValueRollback<bool> asking(m_asking, true);
  QMessageBox box(QMessageBox::Question, tr("Discard the draft"),
                  tr("Discard the draft of “%1”?")
                      .arg(m_editor.name().empty() ? tr("a structure without a name")
                                                   : shownName(m_editor.name())),
                  QMessageBox::NoButton, &m_window);
  box.setObjectName("askDiscard");
  auto* drop = box.addButton(tr("Discard"), QMessageBox::DestructiveRole);
  box.setDefaultButton(box.addButton(QMessageBox::Cancel));
  box.exec();
  if (box.clickedButton() != drop)
    return;
  m_work->drop();
  m_editor.discard();
}

void SegmentController::escape()
{
  if (active())
    leaveTool();
  else
    discard();
}

// In another thread, with a progress dialog where it takes long. False if it was cancelled.
bool SegmentController::finish(SegmentEditor::Work work)
{
  using namespace std::chrono_literals;
  const auto token = std::make_shared<core::CancelToken>();
  std::atomic<double> reached{0.0};
  const core::Progress progress(
      [&reached](double fraction, const std::string&) { reached = fraction; }, token);
  auto done = std::async(std::launch::async, [&] { return work(progress); });
  if (done.wait_for(100ms) != std::future_status::ready)
  {
    QProgressDialog dialog(tr("Computing the draft…"), tr("Cancel"), 0, 100, &m_window);
    dialog.setObjectName("finishDraft");
    dialog.setWindowModality(Qt::ApplicationModal);
    dialog.setMinimumDuration(200);
    dialog.setAutoReset(false);
    QEventLoop loop;
    QTimer timer;
    presenters::TimeLeft time;
    connect(&dialog, &QProgressDialog::canceled, &loop, [&token] { token->cancel(); });
    connect(&timer, &QTimer::timeout, &loop,
            [&]
            {
              if (done.wait_for(0ms) == std::future_status::ready)
                loop.quit();
              else if (!token->isCancelled())
              {
                const double fraction = reached;
                const double now = presenters::steadySeconds();
                time.report(fraction, now);
                dialog.setLabelText(withTimeLeft(
                    tr("Computing the draft…"), phrase(presenters::timeLeftText(time.shown(now)))));
                dialog.setValue(static_cast<int>(100.0 * fraction));
              }
            });
    timer.start(20ms);
    loop.exec();
  }
  try
  {
    done.get()();
    return true;
  }
  catch (const core::CancelledError&)
  {
    m_editor.workEnded();
    return false;
  }
  catch (...)
  {
    m_editor.workEnded();
    throw;
  }
}

// The step that is under way ends, or is stopped by the user: then the draft is as before.
void SegmentController::awaitStep()
{
  QProgressDialog dialog(tr("A step on the draft is being finished…"), tr("Stop"), 0, 100,
                         &m_window);
  dialog.setObjectName("finishStep");
  dialog.setWindowModality(Qt::ApplicationModal);
  dialog.setMinimumDuration(200);
  dialog.setAutoReset(false);
  dialog.setAutoClose(false);
  QEventLoop loop;
  QTimer timer;
  connect(&dialog, &QProgressDialog::canceled, m_work.get(), &BackgroundWork::cancel);
  connect(
      m_work.get(), &BackgroundWork::progressed, &dialog,
      [&dialog, label = dialog.labelText()](double fraction, const QString&, const QString& left)
      {
        dialog.setLabelText(withTimeLeft(label, left));
        dialog.setValue(static_cast<int>(100.0 * fraction));
      });
  connect(&timer, &QTimer::timeout, &loop,
          [&]
          {
            if (!m_work->busy() || !m_editor.stepping())
              loop.quit();
          });
  timer.start(20);
  loop.exec();
}

bool SegmentController::mayLeave()
{
  m_createAs.clear();
  if (!m_editor.isUnsaved())
    return true;
  if (m_asking)
    return false;
  const QScopedValueRollback<bool> asking(m_asking, true);
  if (m_work->busy() && m_editor.stepping())
    awaitStep();
  m_work->drop();
  m_editor.workDropped();
  try // the preview is what would be created
  {
    while (auto work = m_editor.dueWork())
      if (!finish(std::move(*work)))
        return false;
  }
  catch (const std::exception&)
  {
    m_editor.workEnded();
  }
  const std::string whyNot = m_editor.whyNotCreate();
  QMessageBox box(QMessageBox::Question, tr("A structure is not finished"),
                  tr("The draft of “%1” is not a structure of the case yet.")
                      .arg(m_editor.name().empty() ? tr("a structure without a name")
                                                   : shownName(m_editor.name())),
                  QMessageBox::NoButton, &m_window);
  box.setObjectName("askDraft");
  if (!whyNot.empty())
    box.setInformativeText(tr("It cannot be created as it is: %1").arg(phrase(whyNot)));
  auto* create = box.addButton(tr("Create"), QMessageBox::AcceptRole);
  create->setEnabled(whyNot.empty());
  auto* drop = box.addButton(tr("Discard"), QMessageBox::DestructiveRole);
  auto* stay = box.addButton(QMessageBox::Cancel);
  box.setDefaultButton(stay);
  box.setEscapeButton(stay);
  box.exec();
  if (box.clickedButton() == create)
    return attempt([this] { finish(m_editor.createWork()); }) && !m_editor.isUnsaved();
  if (box.clickedButton() != drop)
    return false;
  m_editor.discard();
  return true;
}

// The preview in 3D follows when nothing has changed for a while.
void SegmentController::showSurface()
{
  if (m_work->busy() && m_editor.stepping())
    return m_surfaceLater.start();
  m_surfaceWork->start(
      [this, work = m_editor.surfaceWork()](const core::Progress& progress) -> BackgroundWork::Reply
      {
        auto apply = work(progress);
        return [this, apply = std::move(apply)]
        {
          apply();
          rendering::MeshContents contents;
          contents.name = "draft";
          contents.mesh = m_editor.raisedSurface();
          contents.look.color = m_editor.color();
          emit surfaceChanged(contents);
          if (const int voxels = m_editor.surfaceStep(); contents.mesh && voxels > 1)
            emit statusMessage(
                tr("The draft is large: the 3D view shows it in cells of %1 voxels along each "
                   "axis; what is created has all its voxels")
                    .arg(voxels));
        };
      });
}

} // namespace petrous::workstation
