#include "DrillController.h"

#include <QAction>
#include <QApplication>

#include "DrillBar.h"
#include "Theme.h"
#include "ThreeDView.h"

namespace petrous::workstation
{

namespace
{
constexpr int kFrame = 16;        // ms
constexpr double kSilence = 3.0;  // s; a picture drawn on the processor can take one
constexpr int kFaultShown = 1500; // ms after the last tick that had one

// A hand that was just taken up has no reading for some ticks; that is no fault to speak of.
bool isStart(const simulation::TickRecord& record)
{
  using haptics::DeviceVerdict;
  const auto verdict = static_cast<DeviceVerdict>(record.verdict);
  return static_cast<simulation::ServoFault>(record.fault) == simulation::ServoFault::Device &&
         (verdict == DeviceVerdict::NotReady || verdict == DeviceVerdict::Settling);
}
} // namespace

DrillController::DrillController(presenters::WorkstationModel& model, ThreeDView& view,
                                 DrillBar& bar, QObject* parent)
  : QObject(parent)
  , m_model(model)
  , m_view(view)
  , m_bar(bar)
  , m_aim([&model](const interaction::SightLine& line) { return model.tissueAlong(line); })
{
  m_frames.setInterval(kFrame);
  connect(&m_frames, &QTimer::timeout, this, &DrillController::frame);
  connect(bar.drillAction(), &QAction::toggled, this, &DrillController::setMode);
  connect(&bar, &DrillBar::burrChanged, this,
          [this]
          {
            putAway(); // the pointer's next move takes up the new one
            applyBar();
          });
  connect(&bar, &DrillBar::pressChanged, this, &DrillController::applyBar);
  connect(&view, &ThreeDView::pointed, this, &DrillController::hover);
  connect(&view, &ThreeDView::pointerLeft, this, &DrillController::pointedNowhere);
  connect(&view, &ThreeDView::picked, this,
          [this](const interaction::SightLine& line)
          {
            if (const auto hit = m_model.surfaceAt(line))
              m_model.setCrosshair(*hit);
          });
  connect(&view, &ThreeDView::drillPressed, this, &DrillController::press);
  connect(&view, &ThreeDView::drillHeld, this, &DrillController::hold);
  connect(&view, &ThreeDView::drillReleased, this, &DrillController::release);
  connect(&view, &ThreeDView::wheelLed, this,
          [this](double notches, bool fine)
          {
            m_aim.wheel(notches, fine);
            send();
          });
  applyBar();
}

void DrillController::setSlicesFollow(bool follow)
{
  m_slicesFollow = follow;
}

double DrillController::burrRadius() const
{
  return 0.5 * m_bar.burr().diameter;
}

void DrillController::applyBar()
{
  using Mode = interaction::AimSettings::Mode;
  interaction::AimSettings settings = m_aim.settings();
  settings.burrRadius = burrRadius();
  settings.thrust = m_bar.thrust();
  settings.mode = m_bar.wheelAction()->isChecked() ? Mode::Depth : Mode::Surface;
  m_aim.setSettings(settings);
  m_view.setWheelLeads(settings.mode == Mode::Depth);
  send();
}

void DrillController::setMode(bool drill)
{
  m_mode = drill;
  m_view.setDrillMode(drill); // off: lets go of the drill first
  if (drill)
    takeTool();
  else
    putAway();
}

bool DrillController::takeTool()
{
  if (m_model.touching())
    return true;
  if (!m_mode || !m_model.hasCase())
    return false;
  emit said(tr("Taking up the burr…"));
  QApplication::setOverrideCursor(Qt::WaitCursor);
  QString why;
  try
  {
    presenters::TouchSession::Setup setup;
    setup.center = m_model.value().ct.geometry.center();
    setup.tool.burr = m_bar.burr();
    m_aim.apply(setup.parameters);
    interaction::PointerDevice::Limits limits;
    limits.silence = kSilence;
    auto pointer = std::make_unique<interaction::PointerDevice>(setup.center, limits);
    m_model.startTouch(*pointer, setup);
    m_pointer = std::move(pointer);
  }
  catch (const core::Error& error)
  {
    why = words(error.what());
  }
  catch (const std::exception&) // no memory, no thread
  {
    why = tr("The burr cannot be taken up: the computer has no room for it. Close other programs.");
  }
  QApplication::restoreOverrideCursor();
  emit said(why);
  if (!why.isEmpty())
  {
    m_bar.drillAction()->setChecked(false);
    return false;
  }
  m_frames.start();
  return true;
}

void DrillController::putAway()
{
  m_frames.stop();
  const auto news = m_model.stopTouch();
  m_view.display().endTouch();
  if (!m_fault.isEmpty())
    emit faulted({});
  m_fault.clear();
  for (const auto& stroke : news.strokes)
    emit strokeEnded(stroke);
}

void DrillController::point(const interaction::SightLine& line)
{
  m_aim.setCamera(m_view.picture().camera());
  m_aim.point(line);
  send();
}

void DrillController::send()
{
  if (!m_model.touching())
    return;
  if (m_aim.wanted())
    m_pointer->want(*m_aim.wanted());
  m_pointer->setButtons(m_aim.buttons());
  simulation::ServoParameters parameters;
  m_aim.apply(parameters);
  m_model.touch()->setParameters(parameters);
}

void DrillController::hover(const interaction::SightLine& line)
{
  if (const auto hit = m_model.surfaceAt(line))
    emit pointed(*hit);
  else
    emit pointedNowhere();
  if (m_mode && takeTool())
    point(line);
}

void DrillController::press(const interaction::SightLine& line)
{
  if (!takeTool())
    return;
  m_model.touch()->setCamera(m_view.picture().camera());
  m_aim.press(interaction::PointerAim::Press::Drill);
  point(line);
}

void DrillController::hold(const interaction::SightLine& line)
{
  if (m_model.touching())
    point(line);
}

void DrillController::release()
{
  m_aim.press(interaction::PointerAim::Press::None);
  send();
  hear(m_model.endStroke());
}

void DrillController::frame()
{
  if (!m_model.touching()) // another threshold: the pointer's next move takes the tool up again
    return putAway();
  hear(m_model.advanceTouch());
}

void DrillController::hear(const presenters::TouchSession::News& news)
{
  if (news.record)
  {
    m_aim.see(*news.record, m_pointer->see(*news.record));
    m_aim.update();
    send();
    m_view.display().setTouch(*news.record, burrRadius());
    showFault(news);
  }
  if (news.record && m_model.drilling())
  {
    const Eigen::Vector3d burr = news.record->proxy.pose().position;
    emit pointed(burr);
    if (m_slicesFollow)
      m_model.setCrosshair(burr);
  }
  for (const auto& stroke : news.strokes)
    emit strokeEnded(stroke);
}

void DrillController::showFault(const presenters::TouchSession::News& news)
{
  QString fault = m_fault;
  if (!news.fault.empty() && !isStart(*news.record))
  {
    fault = words(news.fault);
    m_sinceFault.start();
  }
  else if (!m_fault.isEmpty() && m_sinceFault.elapsed() > kFaultShown)
    fault.clear();
  if (fault != m_fault)
    emit faulted(m_fault = fault);
}

} // namespace petrous::workstation
