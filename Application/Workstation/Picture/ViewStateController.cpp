#include "ViewStateController.h"

#include <cmath>

#include <QAction>
#include <QScopedValueRollback>

#include "DrillBar.h"
#include "PictureController.h"
#include "RegistrationController.h"
#include "SliceColumn.h"
#include "ThreeDView.h"
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
                                         QObject* parent)
  : QObject(parent)
  , m_model(model)
  , m_view(view)
  , m_slices(slices)
  , m_picture(picture)
  , m_registration(registration)
  , m_bar(bar)
{
}

ViewStateController::State ViewStateController::present() const
{
  State state;
  state.camera = m_view.picture().camera();
  state.view.slices = m_slices.shown();
  state.view.slices->overlay = m_registration.overlay();
  state.view.light = m_picture.settings().lightState();
  state.view.stereo = m_picture.settings().stereoState();
  state.view.tool = {m_bar.burr(), m_bar.thrust(), m_bar.wheelAction()->isChecked()};
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
  m_shown = present();
}

// A case that is saved for another reason gets all of the view, one that is saved as it was only
// what was changed.
void ViewStateController::collect()
{
  if (!m_model.hasCase())
    return;
  const bool all = m_model.unsaved();
  const State now = present();
  const scene::Case& value = m_model.value();
  if (all ? !value.camera || !isSame(now.camera, m_shown.camera)
          : !isSame(now.camera, m_shown.camera))
    m_model.setCamera(now.camera);
  scene::ViewState view = value.view;
  take(view.slices, now.view.slices, m_shown.view.slices, all);
  take(view.light, now.view.light, m_shown.view.light, all);
  take(view.stereo, now.view.stereo, m_shown.view.stereo, all);
  take(view.tool, now.view.tool, m_shown.view.tool, all);
  m_model.setView(view);
  m_shown = now;
}

core::CameraPose ViewStateController::camera() const
{
  const core::CameraPose now = m_view.picture().camera();
  const auto& saved = m_model.value().camera;
  return saved && isSame(now, m_shown.camera) ? *saved : now;
}

void ViewStateController::showCamera(const core::CameraPose& camera)
{
  m_view.setCamera(camera);
  m_shown.camera = m_view.picture().camera();
}

} // namespace petrous::workstation
