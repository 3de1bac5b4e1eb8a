#include "ActiveDeviceController.h"

#include <algorithm>
#include <utility>

#include <QAction>
#include <QCoreApplication>

#include "DeviceTestDialog.h"
#include "DeviceToolBar.h"
#include "Manual.h"
#include "Theme.h"
#include "WindowSettings.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

using presenters::DeviceMapping;
using presenters::InputDevice;

ActiveDeviceController::ActiveDeviceController(DeviceWatcher& finder, DeviceToolBar& bar,
                                               WindowSettings& settings, QObject* parent)
  : QObject(parent)
  , m_watcher(finder)
  , m_bar(bar)
  , m_settings(settings)
{
  connect(&finder, &DeviceWatcher::changed, this, &ActiveDeviceController::showDevices);
  connect(&finder, &DeviceWatcher::opened, this, &ActiveDeviceController::take);
  connect(&finder, &DeviceWatcher::failed, this, &ActiveDeviceController::giveUp);
  connect(&finder, &DeviceWatcher::waits, this, &ActiveDeviceController::statusMessage);
  connect(&bar, &DeviceToolBar::listOpened, &finder, &DeviceWatcher::look);
  connect(&bar, &DeviceToolBar::chosen, this, &ActiveDeviceController::choose);
  connect(bar.testAction(), &QAction::triggered, this, &ActiveDeviceController::test);
  connect(bar.connectAction(), &QAction::triggered, this,
          [this]
          {
            const QString why = openManual(QCoreApplication::applicationDirPath(),
                                           QDesktopServices::openUrl, "devices.html");
            emit statusMessage(why.isEmpty() ? tr("The manual is in the browser") : why);
          });
  connect(&bar, &DeviceToolBar::mappingChanged, this,
          [this]
          {
            m_settings.keepScale(m_input.id, m_bar.scale());
            if (m_device && m_device->description().givesForce)
              m_settings.keepForceLimit(m_input.id, m_bar.forceLimit());
            emit mappingChanged();
          });
}

ActiveDeviceController::~ActiveDeviceController()
{
  m_watcher.close(std::move(m_device));
}

void ActiveDeviceController::showDevices()
{
  m_bar.showDevices(m_watcher.found(), m_input.id);
  notifyAdvice();
  const bool pedal = m_watcher.pedal() != nullptr;
  if (std::exchange(m_hadPedal, pedal) == pedal)
    return;
  emit pedalCame();
  emit statusMessage(tr("The pedal drills")); // after the messages of taking up the tool
}

// Connected devices that cannot be used: each advice once.
void ActiveDeviceController::notifyAdvice()
{
  std::set<std::string> advice;
  for (const InputDevice& input : m_watcher.found().devices)
    advice.insert(input.advice);
  advice.insert(m_watcher.found().pedalAdvice);
  advice.insert(m_watcher.found().hidProblem);
  advice.erase("");
  for (const std::string& line : advice)
    if (m_told.count(line) == 0)
      emit statusMessage(phrase(line));
  m_told = std::move(advice);
}

void ActiveDeviceController::choose(const InputDevice& input)
{
  if (input.id == m_input.id)
    return;
  emit leaving();
  m_watcher.drop();
  m_watcher.close(std::move(m_device));
  m_device.reset();
  m_input = input;
  m_bar.showDevices(m_watcher.found(), m_input.id);
  m_bar.showMapping(nullptr, 1.0, 0.0);
  if (input.kind == InputDevice::Kind::Mouse)
    return emit came();
  emit statusMessage(tr("Taking up %1…").arg(words(input.name)));
  m_watcher.open(input);
}

void ActiveDeviceController::take()
{
  m_device = m_watcher.take();
  const haptics::DeviceDescription& device = m_device->description();
  const double scale = m_settings.scale(m_input.id).value_or(presenters::usualScale(device));
  const double limit = m_settings.forceLimit(m_input.id).value_or(device.maxForce);
  m_bar.showMapping(&device, scale, std::clamp(limit, 0.0, device.maxForce));
  emit statusMessage(tr("%1 is there").arg(words(device.name)));
  emit came();
}

// The test has the device for itself; afterwards it is taken up with what was kept.
void ActiveDeviceController::test()
{
  const InputDevice input = m_input;
  choose(InputDevice());
  auto* dialog = new DeviceTestDialog(m_watcher.sources(), input, m_bar.window());
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &QObject::destroyed, this, [this, input] { choose(input); });
  dialog->open();
}

void ActiveDeviceController::giveUp(const QString& why)
{
  const bool had = m_device != nullptr;
  choose(InputDevice());
  if (had)
    emit lost();
  emit statusMessage(tr("%1. The mouse leads the tool.").arg(why.left(1).toUpper() + why.mid(1)));
}

DeviceMapping ActiveDeviceController::mapping() const
{
  DeviceMapping mapping;
  mapping.scale = m_bar.scale();
  mapping.forceLimit = m_bar.forceLimit();
  return mapping;
}

} // namespace petrous::workstation
