#pragma once

#include <QDialog>

#include "BackgroundWork.h"
#include "petrous/Devices/DeviceCheck.h"
#include "petrous/Presenters/ActiveDevice.h"

class QLabel;
class QProgressBar;
class QPushButton;

namespace petrous::workstation
{

/// The test of a device behind a server, as `petrous device-test` does it: what the user does, its
/// progress, and the result, whose stiffness is kept on request. Nothing else may use the device.
class DeviceTestDialog : public QDialog
{
  Q_OBJECT
public:
  DeviceTestDialog(presenters::DeviceSources sources, presenters::InputDevice input,
                   QWidget* parent = nullptr,
                   const devices::DeviceCheck::Options& options = devices::DeviceCheck::Options());
  ~DeviceTestDialog() override; ///< ends a test; the device has no force

private:
  struct Outcome
  {
    haptics::DeviceDescription description;
    devices::DeviceCheck::Result result;
  };
  Outcome test(const core::Progress& progress) const; ///< in the worker thread
  void startOrStop();
  void showOutcome(const Outcome& outcome);
  void say(const QString& text);
  void keep();

  const presenters::DeviceSources m_sources;
  const presenters::InputDevice m_input;
  const devices::DeviceCheck::Options m_options;
  QLabel* m_advice;
  QProgressBar* m_progress;
  QLabel* m_result;
  QPushButton* m_start;
  QPushButton* m_keep;
  std::string m_device;    // its described name
  double m_proposed = 0.0; // N/mm; 0: none
  BackgroundWork m_work;   // last
};

} // namespace petrous::workstation
