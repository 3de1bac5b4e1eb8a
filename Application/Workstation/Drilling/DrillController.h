#pragma once

#include <memory>
#include <optional>

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include "ToolDriver.h"
#include "petrous/Presenters/StallWatch.h"

namespace petrous::workstation
{

class DrillBar;
class ActiveDeviceController;
class ThreeDView;

/// Puts a tool into the hand. The burr drills where it is pressed; the pointer cuts nothing and
/// reads what is at its tip. The hand is the mouse, whose pointer leads a device of its own, or a
/// device that was chosen. What is shown is the tool, which the tissue holds back, not the hand.
class DrillController : public QObject
{
  Q_OBJECT
public:
  static constexpr double kPointerRadius = 0.5; ///< mm, of the pointer's ball

  DrillController(presenters::WorkstationModel& model, ThreeDView& view, DrillBar& bar,
                  ActiveDeviceController& devices, QObject* parent = nullptr);

  void setSlicesFollow(bool follow); ///< the crosshair goes with the burr while it drills
  void releaseTool();                    ///< no tool; ends an open stroke
  void tissueCame();                 ///< the case's structures are loaded
  void bringHere();                  ///< a device's tool before what the view's middle shows

signals:
  void pointed(const Eigen::Vector3d& patient); ///< the surface under the pointer, or the tool
  void pointedNowhere();
  void tissueWanted(); ///< a tool was chosen, and the case is not prepared for it
  void burrMoved(const Eigen::Vector3d& center, double radius); ///< patient LPS mm; each picture
  void burrGone();                                              ///< out of the hand
  /// Null when nothing was cut.
  void strokeEnded(const std::shared_ptr<const petrous::dissection::Stroke>& stroke);
  void statusMessage(const QString& line);    ///< what takes a while, or what does not work
  void faulted(const QString& line); ///< of the touch; empty when it works again

private:
  enum class Tool
  {
    None,
    Burr,
    Pointer
  };
  void connectBar();
  void connectView();
  void connectDevices();
  void setTool(Tool tool);
  void hover(const interaction::PickRay& line);
  void press(const interaction::PickRay& line);
  void release();
  bool takeTool(); // into the hand, unless it is there
  void putAway();
  void restartTool();
  void takeAtPointer();
  void applyBar();
  void deviceCame();
  void frame();
  void hear(const presenters::TouchSession::News& news);
  void show(const presenters::TouchSession::News& news);
  void read(const simulation::TickRecord& record);
  void showFault(const presenters::TouchSession::News& news);
  QString whyStalled(const simulation::TickRecord& record) const;
  QString whyLost() const;
  bool isLost(const simulation::TickRecord& record);
  double toolRadius() const;

  presenters::WorkstationModel& m_model;
  ThreeDView& m_view;
  DrillBar& m_bar;
  ActiveDeviceController& m_devices;
  ToolDriver m_lead;
  std::optional<Eigen::Vector3d> m_tip; // that was read last
  QTimer m_frames;
  QTimer m_anew;
  QElapsedTimer m_sinceFault;
  QElapsedTimer m_sinceTaken;
  QElapsedTimer m_sinceGone;
  QElapsedTimer m_sinceRead;
  presenters::StallWatch m_stall;
  QString m_fault; // as shown
  Tool m_tool = Tool::None;
  bool m_slicesFollow = true;
};

} // namespace petrous::workstation
