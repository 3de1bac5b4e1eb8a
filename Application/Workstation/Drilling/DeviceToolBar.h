#pragma once

#include <QToolBar>

#include "petrous/Presenters/ActiveDevice.h"

class QAction;
class QComboBox;
class QDoubleSpinBox;

namespace petrous::workstation
{

/// Which hand holds the tool, and how it leads it. What a hand has no use for is not shown.
class DeviceToolBar : public QToolBar
{
  Q_OBJECT
public:
  explicit DeviceToolBar(QWidget* parent = nullptr);

  /// `held`: the id of the hand that is chosen, which may have gone from the list.
  void showDevices(const presenters::DeviceList& found, const std::string& held);

  /// Null: the mouse. The values are set without a word.
  void showLead(const haptics::DeviceDescription* device, double scale, double forceLimit);

  double scale() const;      ///< mm of the tool for a mm of the hand
  double forceLimit() const; ///< N

  QAction* hereAction() const noexcept { return m_here; }

signals:
  void chosen(const petrous::presenters::InputDevice& input); ///< by the user
  void leadChanged();

private:
  std::vector<presenters::InputDevice> m_devices; // as listed
  QComboBox* m_choice;
  QDoubleSpinBox* m_scale;
  QDoubleSpinBox* m_limit;
  std::vector<QAction*> m_scaleParts;
  std::vector<QAction*> m_limitParts;
  QAction* m_here;
};

} // namespace petrous::workstation
