#pragma once

#include <memory>
#include <set>
#include <string>

#include <QObject>

#include "DeviceWatcher.h"
#include "petrous/Presenters/DeviceMapping.h"

namespace petrous::workstation
{

class DeviceToolBar;
class WindowSettings;

/// The device that controls the tool: chosen by the user in the bar, opened and configured as last
/// stored. The mouse initially, and whenever a device is unavailable.
class ActiveDeviceController : public QObject
{
  Q_OBJECT
public:
  ActiveDeviceController(DeviceWatcher& finder, DeviceToolBar& bar, WindowSettings& settings,
                         QObject* parent = nullptr);
  ~ActiveDeviceController() override;

  presenters::ActiveDevice* device() const noexcept { return m_device.get(); } ///< null: the mouse
  bool opening() const noexcept
  {
    return !m_device && m_input.kind != presenters::InputDevice::Kind::Mouse;
  }
  const std::shared_ptr<devices::Pedal>& pedal() const noexcept { return m_watcher.pedal(); }
  presenters::DeviceMapping mapping() const; ///< except the thrust

  void choose(const presenters::InputDevice& input);
  void giveUp(const QString& why); ///< falls back to the mouse

signals:
  /// The device must not be used from here on; emitted before `device` is released.
  void leaving();
  void came(); ///< another device is ready
  void lost(); ///< the device went by itself; the mouse has taken over
  void mappingChanged();
  void pedalCame();
  void statusMessage(const QString& line);

private:
  void take();
  void test();
  void showDevices();
  void notifyAdvice();

  DeviceWatcher& m_watcher;
  DeviceToolBar& m_bar;
  WindowSettings& m_settings;
  presenters::InputDevice m_input; // chosen
  std::shared_ptr<presenters::ActiveDevice> m_device;
  std::set<std::string> m_told; // advice on connected devices already shown
  bool m_hadPedal = false;
};

} // namespace petrous::workstation
