#include "PictureController.h"

#include <utility>

#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QEvent>
#include <QLabel>
#include <QLayout>
#include <QMessageBox>
#include <QScopedValueRollback>

#include "Application.h"
#include "PicturePanel.h"
#include "SurgeonWindow.h"
#include "Theme.h"
#include "ThreeDView.h"
#include "WindowActions.h"
#include "WindowSettings.h"
#include "WindowTexts.h"
#include "petrous/Core/Error.h"
#include "petrous/Interaction/ToolInteraction.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Presenters/ProvenanceText.h"
#include "petrous/Presenters/SceneAssembly.h"

namespace petrous::workstation
{

using rendering::StereoMode;

PictureController::PictureController(presenters::WorkstationModel& model, ThreeDView& view,
                                     WindowActions& actions, WindowSettings& kept, QWidget& window,
                                     bool quadBuffer)
  : QObject(&window)
  , m_model(model)
  , m_view(view)
  , m_actions(actions)
  , m_window(window)
  , m_kept(kept)
  , m_quadBuffer(quadBuffer)
  , m_panel(new PicturePanel(model, m_settings, quadBuffer))
  , m_speed(new QLabel)
{
  m_speed->setObjectName("dim");
  m_speed->setContentsMargins(8, 0, 8, 0);
  m_speed->setToolTip(tr("How many pictures a second can be drawn, and at what share of the full "
                         "resolution while something moves"));
  kept.restore(m_settings, quadBuffer);
  m_view.display().setLight(m_settings.light());
  m_lightBefore = m_settings.lightState();
  m_backgroundBefore = m_settings.background();
  m_view.display().setBackground(m_backgroundBefore);
  applyStereo();
  m_panel->settingsChanged();
  const auto changed = [this](auto what)
  {
    return [this, what]
    {
      what();
      m_panel->settingsChanged();
      if (!m_isShowing)
        m_kept.keep(m_settings);
    };
  };
  m_settings.events.lightChanged = changed([this] { lightChanged(); });
  m_settings.events.backgroundChanged = changed([this] { backgroundChanged(); });
  m_settings.events.stereoChanged = changed([this] { applyStereo(); });
  connect(m_actions.stereo, &QActionGroup::triggered, this,
          [this](QAction* action)
          { m_settings.setStereo(static_cast<StereoMode>(action->data().toInt())); });
  connect(m_actions.surgeonWindow, &QAction::triggered, this,
          [this](bool open) { open ? openSurgeonWindow() : closeSurgeonWindow(); });
  connect(&m_view.display(), &SceneDisplay::drawn, this, &PictureController::showSpeed);
  connect(&m_view, &ThreeDView::cameraMoved, this,
          [this]
          {
            if (isBuried() != m_isBuried)
              showNotes();
          });
  connect(&m_view, &ThreeDView::toolModeSet, this,
          [this]
          {
            if (m_model.hasCase() &&
                (!m_model.value().view.clipping.empty() || m_model.value().softTissue.shown))
              showScene();
          });
  connect(&m_view.display(), &SceneDisplay::failed, this, &PictureController::fail);
  m_window.installEventFilter(this);
}

PictureController::~PictureController()
{
  delete m_surgeon; // before the view that it follows
}

void PictureController::announce()
{
  m_isAnnounced = true;
  m_speed->setText(tr("Preparing the picture…"));
  QWidget* bar = m_speed->parentWidget();
  if (!bar || !bar->layout())
    return;
  bar->layout()->activate();
  bar->repaint(); // events come with the picture
}

void PictureController::caseChanged()
{
  m_view.display().setTool(std::nullopt);
  showScene();
  m_isFirst = std::exchange(m_isAnnounced, false);
}

void PictureController::appearanceChanged()
{
  showScene();
}

void PictureController::setDraft(const rendering::MeshContents& surface)
{
  if (!surface.mesh && !m_draft.mesh)
    return;
  m_draft = surface;
  if (m_model.hasCase())
    showScene();
}

void PictureController::showView(const scene::ViewState& view)
{
  const QScopedValueRollback<bool> showing(m_isShowing, true);
  presenters::ViewSettings next;
  m_kept.restore(next, m_quadBuffer);
  // A saved case looks as the command draws it; the user's light is for new ones.
  if (!view.light && m_model.value().revision > 0)
    next.setLight({});
  next.take(view, m_quadBuffer);
  m_settings.take(next);
}

// A step of undo, unless a case is being shown. Stereo is none: it is of the screen.
void PictureController::noteStep(const std::string& what, const std::string& merged,
                                 const std::function<void()>& undo,
                                 const std::function<void()>& redo)
{
  if (m_isShowing || m_isStepping || !m_model.hasCase())
    return;
  const auto step = [this](const std::function<void()>& set)
  {
    return [this, set]
    {
      const QScopedValueRollback<bool> stepping(m_isStepping, true);
      set();
    };
  };
  m_model.edits().did({what, merged, step(undo), step(redo)});
  if (m_model.events.stateChanged)
    m_model.events.stateChanged();
}

void PictureController::backgroundChanged()
{
  const rendering::BackgroundColor after = m_settings.background();
  const rendering::BackgroundColor before = std::exchange(m_backgroundBefore, after);
  m_view.display().setBackground(after);
  noteStep(
      presenters::backgroundEdit(), {}, [this, before] { m_settings.setBackground(before); },
      [this, after] { m_settings.setBackground(after); });
}

void PictureController::lightChanged()
{
  m_view.display().setLight(m_settings.light());
  const scene::ViewState::Light after = m_settings.lightState();
  const scene::ViewState::Light before = std::exchange(m_lightBefore, after);
  const presenters::LightEdit edit = presenters::lightEdit(before, after);
  noteStep(
      edit.what, edit.isContinuous ? "light\n" + edit.what : std::string(),
      [this, before] { m_settings.setLight(before); },
      [this, after] { m_settings.setLight(after); });
}

void PictureController::showScene()
{
  if (m_model.loaded() && !m_model.drawable())
    return; // the old picture stays until the new one is prepared
  try
  {
    rendering::SceneContents contents = m_model.sceneContents();
    if (m_draft.mesh)
      contents.meshes.push_back(m_draft);
    // What a tool lies on must be seen: it knows no clipping, and soft tissue is air to it.
    const scene::Case& value = m_model.value();
    const bool isWhole = m_view.tool().GetDrillMode() || m_view.tool().GetProbeMode();
    const bool isVeiled = isWhole && contents.softTissue;
    if (isWhole)
      contents.softTissue.reset();
    else
      presenters::clip(contents, value.view.clipping, value.ct.geometry);
    m_view.display().setContents(contents);
    QStringList lines;
    for (const std::string& line :
         isWhole ? presenters::interpolatedTexts(value) : presenters::pictureNotes(value))
      lines += phrase(line);
    if (isVeiled)
      lines += tr("Soft tissue is left out while a tool is in the hand");
    if (const std::string why =
            value.softTissue.shown ? presenters::softTissueMissing(value) : std::string();
        !why.empty())
      lines += tr("Soft tissue is not drawn: %1").arg(phrase(why));
    m_notes = lines;
    showNotes();
  }
  catch (const core::Error& error) // too much to draw; the slices still show it
  {
    m_view.display().setContents({});
    m_notes.clear();
    showNotes();
    emit statusMessage(toString(error));
  }
}

bool PictureController::isBuried() const
{
  const SceneDisplay& display = m_view.display();
  return presenters::isBuried(display.picture().camera(), display.contents());
}

void PictureController::showNotes()
{
  QStringList lines = m_notes;
  m_isBuried = isBuried();
  if (m_isBuried)
    lines += tr("The camera is inside tissue: zoom out");
  m_view.setNotes(lines);
}

void PictureController::openSurgeonWindow()
{
  if (m_surgeon)
    return;
  m_surgeon = new SurgeonWindow(m_view, m_settings.stereo() == StereoMode::QuadBuffer);
  m_surgeon->setAttribute(Qt::WA_DeleteOnClose);
  m_surgeon->addActions(m_window.findChildren<QAction*>()); // the window's shortcuts
  connect(&m_surgeon->display(), &SceneDisplay::failed, this, &PictureController::fail);
  connect(m_surgeon, &SurgeonWindow::closed, this,
          [this]
          {
            m_surgeon = nullptr;
            m_actions.surgeonWindow->setChecked(false);
            applyStereo();
          });
  m_actions.surgeonWindow->setChecked(true);
  applyStereo();
  m_surgeon->showBeside(m_window);
  m_surgeon->setBlocked(QApplication::activeModalWidget() != nullptr);
}

bool PictureController::eventFilter(QObject* watched, QEvent* event)
{
  if (m_surgeon &&
      (event->type() == QEvent::WindowBlocked || event->type() == QEvent::WindowUnblocked))
    m_surgeon->setBlocked(event->type() == QEvent::WindowBlocked);
  return QObject::eventFilter(watched, event);
}

void PictureController::closeSurgeonWindow()
{
  if (m_surgeon)
    m_surgeon->close();
}

// Stereo is for the surgeon: the main view is mono, for bystanders, while the other window is open.
// Quad-buffering exists only there.
void PictureController::applyStereo()
{
  const StereoMode mode = m_settings.stereo();
  for (QAction* action : m_actions.stereo->actions())
    action->setChecked(action->data().toInt() == static_cast<int>(mode));
  if (m_surgeon && m_surgeon->quadBuffer() != (mode == StereoMode::QuadBuffer))
  {
    m_surgeon->close(); // needs another kind of window
    return openSurgeonWindow();
  }
  if (m_surgeon)
    m_surgeon->display().setStereo(mode, m_settings.rig());
  const bool here = !m_surgeon && mode != StereoMode::QuadBuffer;
  m_view.display().setStereo(here ? mode : StereoMode::None, m_settings.rig());
}

void PictureController::showSpeed(double milliseconds, double scale, bool moving)
{
  if (!m_model.hasCase() || m_isAnnounced)
    return;
  if (std::exchange(m_isFirst, false))
    m_speed->clear();
  if (milliseconds <= 0.0)
    return;
  const QString speed = milliseconds < 1000.0
                            ? tr("%1 Hz").arg(numberText(1000.0 / milliseconds, 0))
                            : tr("%1 s").arg(numberText(0.001 * milliseconds, 1));
  m_speed->setText(moving ? tr("%1 at %2 %").arg(speed).arg(numberText(100.0 * scale, 0)) : speed);
}

void PictureController::fail(const QString& why)
{
  m_speed->clear();
  const bool safe = !flush || flush();
  QMessageBox box(QMessageBox::Warning, tr("The 3D picture failed"), why, QMessageBox::Ok,
                  &m_window);
  box.setTextInteractionFlags(Qt::TextSelectableByMouse);
  box.setInformativeText(
      (safe ? tr("The case is saved. ") : tr("The case could not be saved; save it first. ")) +
      tr("Close Petrous and start it again. If it fails again, close other programs that use the "
         "graphics card, load only the ear, or install a newer driver. The slices go on "
         "working."));
  box.exec();
}

} // namespace petrous::workstation
