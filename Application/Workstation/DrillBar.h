#pragma once

#include <QToolBar>

#include "petrous/Dissection/Stroke.h"

class QAction;
class QComboBox;
class QDoubleSpinBox;

namespace petrous::workstation
{

/// Which burr is in the hand, and whether the pointer drills.
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
  double feed() const; ///< mm/s

signals:
  void burrChanged();

private:
  QAction* m_drill;
  QDoubleSpinBox* m_diameter;
  QComboBox* m_kind;
  QDoubleSpinBox* m_feed;
};

} // namespace petrous::workstation
