#include "ToolDriver.h"

#include <algorithm>
#include <utility>

#include "ActiveDeviceController.h"
#include "ThreeDView.h"
#include "petrous/Devices/PedalledDevice.h"

namespace petrous::workstation
{

namespace
{
constexpr double kSilence = 3.0; // s; a software-rendered frame can take one
constexpr double kPedalDown = 0.5;
} // namespace

bool isPlaced(const session::TickRecord& record)
{
  using session::ServoFault;
  const auto fault = static_cast<ServoFault>(record.fault);
  return record.input.now > 0.0 && fault != ServoFault::Device && fault != ServoFault::Clock &&
         fault != ServoFault::Parameters;
}

ToolDriver::ToolDriver(presenters::WorkstationModel& model, ThreeDView& view,
                       ActiveDeviceController& devices)
  : m_model(model)
  , m_view(view)
  , m_devices(devices)
  , m_aim([&model](const interaction::PickRay& line) { return model.tissueAlong(line); })
{
}

void ToolDriver::set(const interaction::AimSettings& settings, bool cuts)
{
  m_cuts = cuts;
  m_aim.setSettings(settings);
  send();
}

void ToolDriver::beginThere() noexcept
{
  m_place.reset();
  m_handPlace.setZero();
}

void ToolDriver::beginHere()
{
  m_place = placeLookedAt();
}

// With the burr just in front of the tissue.
Eigen::Vector3d ToolDriver::placeLookedAt()
{
  const interaction::PickRay line = m_view.sightLine(std::nullopt);
  const auto hit = m_model.tissueAlong(line);
  if (!hit)
    return m_model.crosshair();
  const double before = m_aim.settings().burrRadius + interaction::AimSettings().lift;
  return line.at(std::max(*hit - before, 0.0));
}

presenters::DeviceMapping ToolDriver::lead() const
{
  presenters::DeviceMapping lead = m_devices.lead();
  lead.thrust = m_aim.settings().thrust;
  return lead;
}

// None with the wheel, which presses by displacement.
std::optional<double> ToolDriver::setThrust() const
{
  const interaction::AimSettings& aim = m_aim.settings();
  return aim.mode == interaction::AimSettings::Mode::Surface ? std::optional<double>(aim.thrust)
                                                             : std::nullopt;
}

bool ToolDriver::outgrown() const
{
  return m_pointer && session::couplingFor(m_mode, setThrust()).stiffness != m_stiffness;
}

haptics::Device& ToolDriver::prepare(session::TouchSession::Setup& setup)
{
  m_pointer = nullptr;
  if (presenters::ActiveDevice* device = m_devices.device())
  {
    device->setPedal(m_devices.pedal());
    const core::CameraPose camera = m_view.picture().camera();
    presenters::fit(setup, device->description(), lead(), device->endless());
    setup.parameters = presenters::parametersFor(device->description(), lead(), camera, {});
    if (!m_place)
      m_place = placeLookedAt();
    setup.center = presenters::centerFor(*m_place, m_handPlace, lead().scale, camera);
    return *device;
  }
  setup.center = m_model.value().ct.geometry.center();
  m_mode = setup.tool.mode;
  setup.tool.coupling = session::couplingFor(m_mode, setThrust());
  m_stiffness = setup.tool.coupling.stiffness;
  m_aim.begin();
  m_aim.apply(setup.parameters);
  interaction::PointerDevice::Limits limits;
  limits.silence = kSilence;
  auto pointer = std::make_unique<interaction::PointerDevice>(setup.center, limits);
  m_pointer = pointer.get();
  if (m_devices.pedal())
    m_mouse = std::make_unique<devices::PedalledDevice>(std::move(pointer), m_devices.pedal());
  else
    m_mouse = std::move(pointer);
  return *m_mouse;
}

void ToolDriver::send()
{
  if (!m_model.touching())
    return;
  session::ServoParameters parameters;
  if (m_pointer)
  {
    if (m_aim.wanted())
      m_pointer->want(*m_aim.wanted());
    m_pointer->setButtons(m_aim.buttons());
    m_aim.apply(parameters);
    parameters.clutch = m_held.clutch ? 1 : 0;
  }
  else if (const presenters::ActiveDevice* device = m_devices.device())
    parameters =
        presenters::parametersFor(device->description(), lead(), m_view.picture().camera(), m_held);
  if (!m_cuts)
  {
    parameters.drill = 0;
    parameters.drillButtons = 0;
  }
  m_model.touch()->setParameters(parameters);
}

void ToolDriver::point(const interaction::PickRay& line)
{
  if (!m_pointer)
    return;
  m_aim.setCamera(m_view.picture().camera());
  m_aim.point(line);
  send();
}

void ToolDriver::wheel(double notches, bool fine)
{
  m_aim.wheel(notches, fine);
  send();
}

// By button, key or pedal: each presses the mouse's burr on the bone.
void ToolDriver::press()
{
  using Press = interaction::PointerToolController::Press;
  m_aim.press(m_pointer && (m_held.drill || m_foot) ? Press::Drill : Press::None);
  send();
}

void ToolDriver::drill(bool held)
{
  m_held.drill = held;
  press();
}

void ToolDriver::clutch(bool held)
{
  m_held.clutch = held;
  send();
}

void ToolDriver::letGo()
{
  m_foot = false;
  drill(false);
}

void ToolDriver::see(const session::TickRecord& record)
{
  if (m_pointer)
    seeByMouse(record);
  else if (isPlaced(record))
  {
    // So that another burr continues from there.
    m_place = record.proxy.pose().position;
    m_handPlace = record.input.device.pose().position;
  }
  send();
}

void ToolDriver::seeByMouse(const session::TickRecord& record)
{
  m_aim.see(record, m_pointer->see(record));
  const bool foot = record.input.pedal >= kPedalDown && m_cuts;
  if (std::exchange(m_foot, foot) != foot)
    press();
  m_aim.update();
}

} // namespace petrous::workstation
