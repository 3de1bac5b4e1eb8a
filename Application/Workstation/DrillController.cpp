#include "DrillController.h"

#include <QAction>

#include "DrillBar.h"
#include "ThreeDView.h"

namespace petrous::workstation
{

DrillController::DrillController(presenters::WorkstationModel& model, ThreeDView& view,
                                 DrillBar& bar, QObject* parent)
  : QObject(parent)
  , m_model(model)
  , m_view(view)
  , m_bar(bar)
{
  m_clock.start();
  connect(bar.drillAction(), &QAction::toggled, this, &DrillController::setMode);
  connect(&bar, &DrillBar::burrChanged, this,
          [this]
          {
            if (m_line && m_mode && !m_model.drilling())
              hover(*m_line);
          });
  connect(&view, &ThreeDView::pointed, this, &DrillController::hover);
  connect(&view, &ThreeDView::pointerLeft, this,
          [this]
          {
            m_line.reset();
            showBurr(std::nullopt, false);
            emit pointedNowhere();
          });
  connect(&view, &ThreeDView::picked, this,
          [this](const presenters::SightLine& line)
          {
            if (const auto hit = m_model.surfaceAt(line))
              m_model.setCrosshair(*hit);
          });
  connect(&view, &ThreeDView::drillPressed, this, &DrillController::press);
  connect(&view, &ThreeDView::drillHeld, this, &DrillController::hold);
  connect(&view, &ThreeDView::drillReleased, this, &DrillController::release);
}

void DrillController::setSlicesFollow(bool follow)
{
  m_slicesFollow = follow;
}

double DrillController::seconds() const
{
  return 1e-9 * static_cast<double>(m_clock.nsecsElapsed());
}

void DrillController::setMode(bool drill)
{
  m_mode = drill;
  m_view.setDrillMode(drill);
  if (!drill)
    showBurr(std::nullopt, false);
  else if (m_line)
    hover(*m_line);
}

void DrillController::hover(const presenters::SightLine& line)
{
  m_line = line;
  if (const auto hit = m_model.surfaceAt(line))
    emit pointed(*hit);
  else
    emit pointedNowhere();
  if (m_mode)
    showBurr(m_model.burrAt(line, 0.5 * m_bar.burr().diameter), false);
}

void DrillController::press(const presenters::SightLine& line)
{
  if (!m_model.hasCase())
    return;
  m_model.beginStroke(line, m_bar.burr(), m_bar.feed(), seconds(), m_view.picture().camera());
}

void DrillController::hold(const presenters::SightLine& line)
{
  m_line = line;
  const auto center = m_model.drill(line, seconds());
  showBurr(center, true);
  if (!center)
    return;
  emit pointed(*center);
  if (m_slicesFollow)
    m_model.setCrosshair(*center);
}

void DrillController::release()
{
  if (!m_model.drilling())
    return;
  const auto stroke = m_model.endStroke();
  if (m_line)
    showBurr(m_model.burrAt(*m_line, 0.5 * m_bar.burr().diameter), false);
  emit strokeEnded(stroke);
}

void DrillController::showBurr(const std::optional<Eigen::Vector3d>& center, bool drilling)
{
  std::optional<rendering::ToolPose> tool;
  if (center && m_mode)
    tool = rendering::ToolPose{*center, m_view.axisToHand(), 0.5 * m_bar.burr().diameter, drilling};
  m_view.display().setTool(tool);
}

} // namespace petrous::workstation
