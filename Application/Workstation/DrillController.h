#pragma once

#include <memory>

#include <QElapsedTimer>
#include <QObject>

#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::workstation
{

class DrillBar;
class ThreeDView;

/// Leads the burr with the pointer of the 3D view, and drills with it.
class DrillController : public QObject
{
  Q_OBJECT
public:
  DrillController(presenters::WorkstationModel& model, ThreeDView& view, DrillBar& bar,
                  QObject* parent = nullptr);

  void setSlicesFollow(bool follow); ///< the crosshair goes with the burr while it drills

signals:
  void pointed(const Eigen::Vector3d& patient); ///< the surface under the pointer
  void pointedNowhere();
  /// Null when nothing was cut.
  void strokeEnded(const std::shared_ptr<const petrous::dissection::Stroke>& stroke);

private:
  void setMode(bool drill);
  void hover(const presenters::SightLine& line);
  void press(const presenters::SightLine& line);
  void hold(const presenters::SightLine& line);
  void release();
  void showBurr(const std::optional<Eigen::Vector3d>& center, bool drilling);
  double seconds() const;

  presenters::WorkstationModel& m_model;
  ThreeDView& m_view;
  DrillBar& m_bar;
  QElapsedTimer m_clock;
  std::optional<presenters::SightLine> m_line;
  bool m_mode = false;
  bool m_slicesFollow = true;
};

} // namespace petrous::workstation
