#pragma once

#include <QToolBar>

#include "petrous/Dissection/BurrCatalogue.h"
#include "petrous/Dissection/Stroke.h"

class QAction;
class QDoubleSpinBox;
class QSpinBox;

namespace petrous::workstation
{

class DiameterBox;
class FittedBox;

/// Selects the tool, the burr, and how it is pressed.
class DrillBar : public QToolBar
{
  Q_OBJECT
public:
  explicit DrillBar(QWidget* parent = nullptr);

  QAction* drillAction() const noexcept ///< checked: the burr is in use
  {
    return m_drill;
  }
  QAction* pointerAction() const noexcept ///< checked: the pointer is in use; it removes nothing
  {
    return m_pointer;
  }
  /// checked: an instrument is in use; it removes nothing
  QAction* instrumentAction() const noexcept { return m_instrument; }
  void stepDiameter(int steps); ///< among those available
  void nextBurr();              ///< the next one of the catalogue, then the first
  /// The available burrs and their diameters. The wanted one is taken up if it is there, else the
  /// usual one of its kind, in the nearest diameter that is available.
  void setBurrs(const dissection::BurrCatalogue& burrs);
  dissection::Burr burr() const;
  /// The one that the user last selected or that was set, also while the catalogue does not have
  /// it.
  const dissection::Burr& wanted() const noexcept { return m_wanted; }
  /// That another one is taken in place of the wanted one; empty: it is not.
  QString insteadText() const;
  /// In the nearest diameter that is available; for one that is not in the catalogue, or of another
  /// kind there, the usual one of its kind.
  void setBurr(const dissection::Burr& burr);
  QAction* wheelAction() const noexcept ///< checked: the wheel moves the burr in depth
  {
    return m_wheel;
  }
  static constexpr double kUsualThrust = 1.0; ///< N
  double thrust() const;                      ///< N
  void setThrust(double newtons);

  /// The file name of the instrument in use, which the bar shows in place of the burr's settings,
  /// as they do not apply to it; empty: none.
  void setInstrument(const QString& name);

  /// What the device makes use of.
  void setPresses(bool byWheel, bool byThrust);

signals:
  void burrChanged();
  void burrChosen();   ///< by the user
  void pressChanged(); ///< thrust, or how depth is controlled

private:
  void offerBurrs();
  void select(const dissection::Burr& burr);
  void offerDiameters();
  void choose(); // what is shown

  dissection::BurrCatalogue m_burrs = dissection::BurrCatalogue::builtIn();
  dissection::Burr m_wanted;
  QAction* m_drill;
  QAction* m_pointer;
  QAction* m_instrument;
  QAction* m_instrumentButton; // in the bar, while it is in the hand
  QAction* m_wheel;
  DiameterBox* m_diameter;
  FittedBox* m_kind;
  QSpinBox* m_speed;
  QDoubleSpinBox* m_thrust;
  QString m_instrumentTip;
};

} // namespace petrous::workstation
