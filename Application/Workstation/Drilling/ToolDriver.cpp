#include "ToolDriver.h"

#include <algorithm>
#include <utility>

#include "ActiveDeviceController.h"
#include "Application.h"
#include "ThreeDView.h"
#include "petrous/Devices/PedalledDevice.h"

namespace petrous::workstation
{

namespace
{
constexpr double kSilence = 3.0; // s; a software-rendered frame can take one
} // namespace

bool isPlaced(const session::TickRecord& record)
{
  return record.input.now > 0.0 && session::hasToolPose(record);
}

ToolDriver::ToolDriver(presenters::WorkstationModel& model, ThreeDView& view,
                       ActiveDeviceController& devices)
  : m_model(model)
  , m_view(view)
  , m_devices(devices)
  , m_aim([&model](const interaction::PickRay& line) { return model.tissueAlong(line); })
{
  view.tool().SetPointer(&m_aim, nullptr);
  m_observer = view.tool().AddObserver(vtkCommand::InteractionEvent, this, &ToolDriver::forward);
}

ToolDriver::~ToolDriver()
{
  m_view.tool().RemoveObserver(m_observer);
  m_view.tool().SetPointer(nullptr, nullptr);
}

void ToolDriver::set(const interaction::AimSettings& settings)
{
  m_aim.setSettings(settings);
  send();
}

void ToolDriver::beginThere() noexcept
{
  m_continues = false;
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

presenters::DeviceMapping ToolDriver::mapping() const
{
  presenters::DeviceMapping mapping = m_devices.mapping();
  mapping.thrust = m_aim.settings().thrust;
  return mapping;
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
  letGo(); // of the last session's device
  m_pointer = nullptr;
  if (presenters::ActiveDevice* device = m_devices.device())
  {
    device->setPedal(m_devices.pedal());
    const core::CameraPose camera = m_view.picture().camera();
    presenters::fit(setup, device->description(), mapping(), device->endless());
    m_view.tool().SetParameters(ownParameters());
    setup.parameters = m_view.tool().GetParameters();
    if (!m_place)
      m_place = placeLookedAt();
    setup.center = presenters::centerFor(*m_place, m_handPlace, mapping().scale, camera);
    return *device;
  }
  setup.center = m_model.value().ct.geometry.center();
  m_mode = setup.tool.instrument ? session::TouchTool::Mode::SixDof : setup.tool.mode;
  setup.tool.coupling = session::couplingFor(m_mode, setThrust());
  m_stiffness = setup.tool.coupling.stiffness;
  std::exchange(m_continues, true) ? m_aim.resume() : m_aim.begin();
  interaction::PointerDevice::Limits limits;
  limits.silence = kSilence;
  auto pointer = std::make_unique<interaction::PointerDevice>(setup.center, limits);
  m_pointer = pointer.get();
  if (m_devices.pedal())
    m_mouse = std::make_unique<devices::PedalledDevice>(std::move(pointer), m_devices.pedal());
  else
    m_mouse = std::move(pointer);
  m_view.tool().SetPointer(&m_aim, m_pointer);
  m_view.tool().SetParameters(ownParameters());
  setup.parameters = m_view.tool().GetParameters();
  return *m_mouse;
}

// The tool adds pointer, keys and camera.
session::ServoParameters ToolDriver::ownParameters() const
{
  const presenters::ActiveDevice* device = m_devices.device();
  if (m_pointer || !device)
    return {};
  return presenters::parametersFor(device->description(), mapping(), m_view.picture().camera());
}

void ToolDriver::send()
{
  if (m_model.touching())
    m_view.tool().SetParameters(ownParameters());
}

void ToolDriver::forward()
{
  guarded( // within a VTK event
      [this]
      {
        if (m_model.touching())
          m_model.touch()->setParameters(m_view.tool().GetParameters());
      });
}

void ToolDriver::letGo()
{
  m_view.tool().SetPointer(&m_aim, nullptr);
}

void ToolDriver::see(const session::TickRecord& record)
{
  if (!m_pointer && isPlaced(record))
  {
    // So that another burr continues from there.
    m_place = record.proxy.pose().position;
    m_handPlace = record.input.device.pose().position;
  }
  m_view.tool().See(record);
}

} // namespace petrous::workstation
