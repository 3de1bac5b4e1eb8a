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

/// Which hand holds the tool: what the user chose in the bar, opened and set as it was kept. The
/// mouse to begin with, and whenever a device cannot be had.
class ActiveDeviceController : public QObject
{
  Q_OBJECT
public:
  ActiveDeviceController(DeviceWatcher& finder, DeviceToolBar& bar, WindowSettings& settings, QObject* parent = nullptr);
  ~ActiveDeviceController() override;

  presenters::ActiveDevice* device() const noexcept { return m_device.get(); } ///< null: the mouse
  bool opening() const noexcept
  {
    return !m_device && m_input.kind != presenters::InputDevice::Kind::Mouse;
  }
  const std::shared_ptr<devices::Pedal>& pedal() const noexcept { return m_watcher.pedal(); }
  presenters::DeviceMapping lead() const; ///< but for the thrust

  void choose(const presenters::InputDevice& input);
  void giveUp(const QString& why); ///< the mouse takes over

signals:
  /// Not to be used any more from here on; comes before `device` goes.
  void leaving();
  void came(); ///< another hand, which may be used
  void leadChanged();
  void pedalCame();
  void statusMessage(const QString& line);

private:
  void take();
  void showDevices();
  void notifyAdvice();

  DeviceWatcher& m_watcher;
  DeviceToolBar& m_bar;
  WindowSettings& m_settings;
  presenters::InputDevice m_input; // chosen
  std::shared_ptr<presenters::ActiveDevice> m_device;
  std::set<std::string> m_told; // advice on what is plugged in
  bool m_hadPedal = false;
};

} // namespace petrous::workstation
