#pragma once

#include <memory>

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include "petrous/Interaction/PointerAim.h"
#include "petrous/Interaction/PointerDevice.h"
#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::workstation
{

class DrillBar;
class ThreeDView;

/// Puts the tool into the hand that holds the pointer: in drill mode the pointer leads a device,
/// whose tool the tissue holds back; pressed, it drills. What is shown is the tool, not the hand.
class DrillController : public QObject
{
  Q_OBJECT
public:
  DrillController(presenters::WorkstationModel& model, ThreeDView& view, DrillBar& bar,
                  QObject* parent = nullptr);

  void setSlicesFollow(bool follow); ///< the crosshair goes with the burr while it drills

signals:
  void pointed(const Eigen::Vector3d& patient); ///< the surface under the pointer, or the burr
  void pointedNowhere();
  /// Null when nothing was cut.
  void strokeEnded(const std::shared_ptr<const petrous::dissection::Stroke>& stroke);
  void said(const QString& line);    ///< what takes a while, or what does not work
  void faulted(const QString& line); ///< of the touch; empty when it works again

private:
  void setMode(bool drill);
  void hover(const interaction::SightLine& line);
  void press(const interaction::SightLine& line);
  void hold(const interaction::SightLine& line);
  void release();
  bool takeTool(); // into the hand, unless it is there
  void putAway();
  void applyBar();
  void point(const interaction::SightLine& line);
  void send();
  void frame();
  void hear(const presenters::TouchSession::News& news);
  void showFault(const presenters::TouchSession::News& news);
  double burrRadius() const;

  presenters::WorkstationModel& m_model;
  ThreeDView& m_view;
  DrillBar& m_bar;
  interaction::PointerAim m_aim;
  std::unique_ptr<interaction::PointerDevice> m_pointer; // of the touch that runs
  QTimer m_frames;
  QElapsedTimer m_sinceFault;
  QString m_fault; // as shown
  bool m_mode = false;
  bool m_slicesFollow = true;
};

} // namespace petrous::workstation
