#pragma once

#include <QToolBar>

#include "petrous/Presenters/ActiveDevice.h"

class QAction;
class QComboBox;
class QDoubleSpinBox;

namespace petrous::workstation
{

/// Selects the device that controls the tool, and its mapping. Settings that a device does not use
/// are hidden.
class DeviceToolBar : public QToolBar
{
  Q_OBJECT
public:
  explicit DeviceToolBar(QWidget* parent = nullptr);

  /// `held`: id of the chosen device, which may be missing from the list.
  void showDevices(const presenters::DeviceList& found, const std::string& held);

  /// nullptr: the mouse. Sets the values without signals.
  void showMapping(const haptics::DeviceDescription* device, double scale, double forceLimit);

  double scale() const;      ///< mm of the tool per mm of the device
  double forceLimit() const; ///< N

  QAction* hereAction() const noexcept { return m_here; }
  QAction* testAction() const noexcept { return m_test; }       ///< of a device behind a server
  QAction* connectAction() const noexcept { return m_connect; } ///< says how

signals:
  void chosen(const petrous::presenters::InputDevice& input); ///< by the user
  void mappingChanged();
  void listOpened(); ///< of the devices, by the user

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  std::vector<presenters::InputDevice> m_devices; // as listed
  QComboBox* m_choice;
  QDoubleSpinBox* m_scale;
  QDoubleSpinBox* m_limit;
  std::vector<QAction*> m_scaleParts;
  std::vector<QAction*> m_limitParts;
  QAction* m_here;
  QAction* m_test;
  QAction* m_connect;
  QAction* m_more = nullptr; // the button that offers these two
};

} // namespace petrous::workstation
