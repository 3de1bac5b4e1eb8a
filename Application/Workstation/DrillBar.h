#pragma once

#include <QToolBar>

#include "petrous/Dissection/Stroke.h"

class QAction;
class QComboBox;
class QDoubleSpinBox;

namespace petrous::workstation
{

/// Which burr is in the hand, how it is pressed, and whether the pointer drills.
class DrillBar : public QToolBar
{
  Q_OBJECT
public:
  explicit DrillBar(QWidget* parent = nullptr);

  QAction* drillAction() const noexcept ///< checked: the left button drills
  {
    return m_drill;
  }
  void stepDiameter(int steps); ///< of 0.5 mm
  dissection::Burr burr() const;
  QAction* wheelAction() const noexcept ///< checked: the wheel moves the burr in depth
  {
    return m_wheel;
  }
  double thrust() const; ///< N

signals:
  void burrChanged();
  void pressChanged(); ///< thrust, or how depth is led

private:
  QAction* m_drill;
  QAction* m_wheel;
  QDoubleSpinBox* m_diameter;
  QComboBox* m_kind;
  QDoubleSpinBox* m_thrust;
};

} // namespace petrous::workstation
