#include "ViewStateController.h"

#include <cmath>

#include <QAction>
#include <QMenu>
#include <QScopedValueRollback>

#include "Application.h"
#include "AskName.h"
#include "DrillBar.h"
#include "PictureController.h"
#include "RegistrationController.h"
#include "SliceColumn.h"
#include "Theme.h"
#include "ThreeDView.h"
#include "WindowTexts.h"
#include "petrous/Presenters/CasePicture.h"

namespace petrous::workstation
{

namespace
{

// But for rounding: VTK normalizes the camera whenever it is set.
bool isSame(const core::CameraPose& a, const core::CameraPose& b)
{
  constexpr double kRounding = 1e-9;
  const auto equal = [](double one, double other)
  { return std::abs(one - other) <= kRounding * (1.0 + std::abs(one)); };
  return (a.position - b.position).norm() <= kRounding * (1.0 + a.position.norm()) &&
         (a.focalPoint - b.focalPoint).norm() <= kRounding * (1.0 + a.focalPoint.norm()) &&
         (a.viewUp - b.viewUp).norm() <= kRounding && equal(a.viewAngle, b.viewAngle) &&
         a.parallelScale.has_value() == b.parallelScale.has_value() &&
         equal(a.parallelScale.value_or(0.0), b.parallelScale.value_or(0.0));
}

// `saved` stays as it is unless the present value is another than was shown.
template <class T>
void take(std::optional<T>& saved, const std::optional<T>& now, const std::optional<T>& shown,
          bool all)
{
  if (now && (!shown || !(*now == *shown) || (!saved && all)))
    saved = now;
}

} // namespace

ViewStateController::ViewStateController(presenters::WorkstationModel& model, ThreeDView& view,
                                         SliceColumn& slices, PictureController& picture,
                                         RegistrationController& registration, DrillBar& bar,
                                         QWidget& window)
  : QObject(&window)
  , m_model(model)
  , m_view(view)
  , m_slices(slices)
  , m_picture(picture)
  , m_registration(registration)
  , m_bar(bar)
  , m_window(window)
  , m_savedMenu(new QMenu(tr("Sa&ved views"), &window))
{
  m_savedMenu->setToolTipsVisible(true);
  QAction* keep = m_savedMenu->addAction(tr("&Keep this view…"));
  keep->setShortcut(Qt::CTRL + Qt::Key_K);
  keep->setToolTip(tr("Camera and slices under a name, saved with the case (Ctrl+K)"));
  keep->setStatusTip(tr("Camera and slices under a name, saved with the case"));
  connect(keep, &QAction::triggered, this, &ViewStateController::saveAs);
  connect(m_savedMenu, &QMenu::aboutToShow, this, &ViewStateController::fillSaved);
}

void ViewStateController::savedViewsChanged()
{
  // The menu may still be in use.
  QMetaObject::invokeMethod(this, &ViewStateController::fillSaved, Qt::QueuedConnection);
}

// The first ones have keys, which work without the menu; hence whenever the views change.
void ViewStateController::fillSaved()
{
  const QList<QAction*> actions = m_savedMenu->actions();
  for (int n = 1; n < actions.size(); ++n)
  {
    if (actions[n]->menu())
      delete actions[n]->menu();
    else
      delete actions[n];
  }
  if (!m_model.hasCase() || m_model.value().view.saved.empty())
    return;
  m_savedMenu->addSeparator();
  auto* removal = new QMenu(tr("&Remove"), m_savedMenu);
  int number = 1;
  for (const auto& [name, saved] : m_model.value().view.saved)
  {
    const QString shown = words(name).replace('&', "&&");
    QAction* action = m_savedMenu->addAction(shown);
    if (number <= 9)
      action->setShortcut(Qt::ALT + Qt::Key_0 + number++);
    connect(action, &QAction::triggered, this, [this, key = name] { showSaved(key); });
    connect(removal->addAction(shown), &QAction::triggered, this,
            [this, key = name]
            {
              m_model.removeView(key);
              emit statusMessage(tr("View “%1” removed; Ctrl+Z brings it back").arg(words(key)));
            });
  }
  m_savedMenu->addSeparator();
  m_savedMenu->addMenu(removal);
}

void ViewStateController::saveAs()
{
  if (!m_model.hasCase())
    return;
  const auto saved = m_model.value().view.saved; // the case may be another one afterwards
  const QString name =
      askName(m_window, tr("Keep this view"),
              tr("Name of the view (camera and slices). One of that name is replaced."), {},
              [&saved](const std::string& text)
              {
                scene::checkViewName(text);
                if (saved.count(text) == 0 && saved.size() >= scene::ViewState::kMaxSaved)
                  throw core::InvalidParameter(
                      "The case keeps " + std::to_string(scene::ViewState::kMaxSaved) +
                      " views, and no more; type the name of one to replace it, or remove one "
                      "first");
              });
  if (name.isEmpty() || !m_model.hasCase())
    return;
  const bool replaces = saved.count(bytes(name)) > 0;
  State now = present();
  now.view.slices->planes = m_slices.shown().planes; // as they are seen
  try
  {
    m_model.saveView(bytes(name), now.camera, *now.view.slices);
  }
  catch (const core::InvalidParameter& error)
  {
    return emit statusMessage(sentence(toString(error)));
  }
  emit statusMessage((replaces ? tr("View “%1” replaced; Ctrl+Z brings back the one before")
                               : tr("View “%1” kept; Save (Ctrl+S) writes it"))
                         .arg(name));
}

void ViewStateController::showSaved(const std::string& name)
{
  if (!m_model.hasCase())
    return;
  const auto found = m_model.value().view.saved.find(name);
  if (found == m_model.value().view.saved.end())
    return;
  const scene::ViewState::Saved saved = found->second;
  if (saved.camera)
    m_view.setCamera(*saved.camera);
  if (saved.slices)
    m_slices.setShown(*saved.slices);
  emit statusMessage(tr("View “%1”").arg(words(name)));
}

ViewStateController::State ViewStateController::present() const
{
  State state;
  state.camera = m_view.picture().camera();
  state.view.slices = m_slices.lasting();
  state.view.slices->overlay = m_registration.overlay();
  state.view.light = m_picture.settings().lightState();
  state.view.stereo = m_picture.settings().stereoState();
  state.view.tool = {m_bar.wanted(), m_bar.thrust(), m_bar.wheelAction()->isChecked()};
  if (handpiece)
    state.view.handpiece = handpiece();
  if (instrument)
    state.view.instrument = instrument();
  return state;
}

void ViewStateController::show()
{
  const QScopedValueRollback<bool> showing(m_isShowing, true);
  const scene::Case& value = m_model.value();
  const scene::ViewState view = value.view;
  m_view.setCamera(presenters::currentCamera(value));
  m_picture.showView(view);
  if (view.slices)
  {
    m_slices.setShown(*view.slices);
    m_registration.show(view.slices->overlay);
  }
  if (view.tool)
  {
    m_bar.setBurr(view.tool->burr);
    m_bar.setThrust(view.tool->thrust);
    m_bar.wheelAction()->setChecked(view.tool->byWheel);
  }
  if (showHandpiece)
    showHandpiece(view.handpiece);
  if (showInstrument)
    showInstrument(view.instrument);
  m_shown = present();
  fillSaved();
}

// Camera and slices; returns the case's view with the latter.
scene::ViewState ViewStateController::takePlace(const State& now, bool all)
{
  if ((all && !m_model.value().camera) || !isSame(now.camera, m_shown.camera))
    m_model.setCamera(now.camera);
  scene::ViewState view = m_model.value().view;
  // A zoom that is still being sought is not the one that will be shown.
  take(view.slices, now.view.slices, m_shown.view.slices, all && !m_slices.isFraming());
  return view;
}

// A case that is saved for another reason gets all of the view, one that is saved as it was only
// what was changed.
void ViewStateController::collect()
{
  if (!m_model.hasCase())
    return;
  const bool all = m_model.unsaved();
  const State now = present();
  scene::ViewState view = takePlace(now, all);
  take(view.light, now.view.light, m_shown.view.light, all);
  take(view.stereo, now.view.stereo, m_shown.view.stereo, all);
  take(view.tool, now.view.tool, m_shown.view.tool, all);
  take(view.instrument, now.view.instrument, m_shown.view.instrument, all);
  take(view.handpiece, now.view.handpiece, m_shown.view.handpiece, all);
  if (!now.view.handpiece && m_shown.view.handpiece)
    view.handpiece.reset(); // as at first again
  m_model.setView(view);
  m_shown = now;
}

void ViewStateController::collectPlace()
{
  const State now = present();
  m_model.setView(takePlace(now, true));
  placeShown(now);
}

void ViewStateController::placeShown(const State& now)
{
  m_shown.camera = now.camera;
  m_shown.view.slices = now.view.slices;
}

void ViewStateController::showPlace()
{
  const scene::Case& value = m_model.value();
  m_slices.keepAsSeen(); // what was before is the other approach's
  if (value.camera)
    m_view.setCamera(*value.camera);
  if (value.view.slices)
    m_slices.setShown(scene::ViewState::Slices(*value.view.slices));
  placeShown(present());
}

} // namespace petrous::workstation
