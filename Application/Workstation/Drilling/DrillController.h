#pragma once

#include <memory>
#include <optional>

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include "BackgroundWork.h"
#include "DrillSound.h"
#include "ToolDriver.h"
#include "petrous/Presenters/HandpiecePresets.h"
#include "petrous/Presenters/InstrumentFile.h"
#include "petrous/Session/StallWatch.h"

namespace petrous::workstation
{

class DrillBar;
class ActiveDeviceController;
class ThreeDView;

/// Controls the tool. The burr drills where it is pressed; the pointer removes nothing and probes
/// at its tip; an instrument, a closed mesh of the user's, is pressed and removes nothing. It is
/// moved by the mouse, through a PointerDevice, or by a chosen device. What is shown is the proxy,
/// which the tissue holds back, not the device pose.
class DrillController : public QObject
{
  Q_OBJECT
public:
  static constexpr double kPointerRadius = 0.5; ///< mm, of the pointer's spherical tip

  DrillController(presenters::WorkstationModel& model, ThreeDView& view, DrillBar& bar,
                  ActiveDeviceController& devices, QObject* parent = nullptr);

  /// The crosshair follows the burr while it drills, and the tip of pointer and instrument.
  void setSlicesFollow(bool follow);
  /// No tool: ends an open stroke and abandons what is read; whether one was in the hand.
  bool releaseTool();
  void renewTool();  ///< puts the tool away and takes it up again
  void tissueCame(); ///< the case's structures are loaded
  void bringHere();  ///< moves a device's tool in front of the view's centre

  /// The instrument to be read when it is taken up first; empty: the user is asked for it then.
  void setInstrument(const QString& file, const QString& axis);
  /// Reads it in the background and takes it up, unless another tool or case came meanwhile
  /// (setTool, releaseTool) or a stroke is open. axis: of presenters::kInstrumentAxes.
  void readInstrument(const QString& file, const QString& axis);
  /// The instrument of the open case, which comes first; nullopt: it has none.
  void setCaseInstrument(const std::optional<scene::ViewState::Instrument>& instrument);
  /// That one, or the one that was taken up since: what the case is to keep.
  const std::optional<scene::ViewState::Instrument>& caseInstrument() const noexcept
  {
    return m_ofCase;
  }
  /// Asks the user for a file, reads it in the background, and then asks for the axis.
  void chooseInstrument();
  /// The case keeps no instrument any more; one in the hand is put away. Its file stays known.
  void takeOutInstrument();

  DrillSound& sound() noexcept { return m_sound; }

  /// Of the handpiece that the mouse leads, relative to the line of sight, degrees:
  /// counterclockwise on the screen, and away from the line.
  void turnHandpiece(double turn, double tilt);
  void holdAsAtFirst(); ///< the usual turn and tilt of the present hand
  /// As it is held for that approach to the case's ear, seen as now; then it follows the view.
  void holdFor(presenters::SurgicalApproach approach);
  /// As the case keeps it; nullopt: as at first.
  std::optional<scene::ViewState::Handpiece> handpiece() const;
  void setHandpiece(const std::optional<scene::ViewState::Handpiece>& hand);
  void setLeftHand(bool isLeft);
  bool leftHand() const noexcept { return m_isLeft; }
  /// The burr alone is felt (session::TouchTool::Mode::ThreeDof); else shaft and handpiece, too.
  void setBurrAlone(bool alone);
  bool burrAlone() const noexcept { return m_isBurrAlone; }

signals:
  void pointed(const Eigen::Vector3d& patient); ///< the surface under the pointer, or the tool
  void pointedNowhere();
  void tissueWanted(); ///< a tool was chosen, but the case is not prepared for it
  /// Of a burr or an instrument in use, at X_PT; each frame.
  void toolMoved(const presenters::MeasuredTool& tool, const haptics::Pose& pose);
  void toolGone(); ///< put away
  /// nullptr if nothing was removed.
  void strokeEnded(const std::shared_ptr<const petrous::dissection::Stroke>& stroke);
  void statusMessage(const QString& line); ///< progress of slow operations, or errors
  void instrumentRead(const QString& file, const QString& axis);
  void instrumentRefused(const QString& why);
  void caseInstrumentChanged(); ///< caseInstrument()
  /// Which tool is in the hand changed; `instrument`: its file's name, empty for another or none.
  void toolChanged(const QString& instrument);
  void faulted(const QString& line); ///< of the touch session; empty when it works again

private:
  enum class Tool
  {
    None,
    Burr,
    Pointer,
    Instrument
  };
  void connectBar();
  void connectView();
  void connectDevices();
  void setTool(Tool tool);
  void showTool();
  void abandonReading();
  void readSurface(const QString& file);
  void askAxis(const QString& file, presenters::InstrumentSurface surface);
  void makeInstrument(const QString& file, const QString& axis,
                      presenters::InstrumentSurface surface);
  void readCaseInstrument();
  void keep(const std::optional<scene::ViewState::Instrument>& instrument); // with the case
  /// What makes an instrument of a surface; `file` is empty if that is the case's. For m_reading.
  BackgroundWork::Reply made(const QString& file, const scene::ViewState::Instrument& kept,
                             presenters::InstrumentSurface surface, const core::Progress& progress);
  void instrumentCame(const QString& file, const scene::ViewState::Instrument& kept,
                      presenters::LoadedInstrument instrument,
                      std::shared_ptr<const presenters::MeasuredTool> measured);
  void follow(const Eigen::Vector3d& tip);
  std::optional<Eigen::Vector3d> surfaceAt(const interaction::PickRay& line);
  void hover(const interaction::PickRay& line);
  void press();
  bool takeTool(); // into use, unless it is
  void putAway();
  void restartTool();
  void renewCoupling();
  void takeAtPointer();
  void dropHint();
  session::TouchTool toolChosen() const;
  void prepareAhead();
  void prepareTool(const session::TouchTool& tool); // then it is taken up
  void applyBar();
  void deviceCame();
  void frame();
  void hear(const session::TouchSession::News& news);
  void show(const session::TouchSession::News& news);
  void read(const session::TickRecord& record);
  void showFault(const session::TouchSession::News& news);
  QString whyStalled(const session::TickRecord& record) const;
  QString whyLost() const;
  bool isLost(const session::TickRecord& record);
  double toolRadius() const;
  rendering::ToolPose toolForm() const; ///< without a place

  presenters::WorkstationModel& m_model;
  ThreeDView& m_view;
  DrillBar& m_bar;
  ActiveDeviceController& m_devices;
  ToolDriver m_driver;
  DrillSound m_sound;
  BackgroundWork m_preparation; // of the tool
  BackgroundWork m_reading;     // of an instrument
  std::shared_ptr<const session::Instrument> m_instrument;
  std::shared_ptr<const presenters::MeasuredTool> m_measured; // it
  std::optional<scene::ViewState::Instrument> m_loaded;       // it, as a case keeps it
  std::optional<scene::ViewState::Instrument> m_ofCase;       // keep()
  bool m_isLoadedFromCase = false;
  QString m_instrumentFile, m_instrumentAxis;
  QString m_fileRead;                   // the one being read; empty: the case's instrument
  std::optional<Eigen::Vector3d> m_tip; // last one probed, or followed
  QTimer m_frames;
  QTimer m_anew;
  QElapsedTimer m_sinceFault;
  QElapsedTimer m_sinceTaken;
  QElapsedTimer m_sinceGone;
  QElapsedTimer m_sinceRead;
  session::StallWatch m_stall;
  QString m_fault; // as shown
  Tool m_tool = Tool::None;
  bool m_slicesFollow = true;
  bool m_hints = false;                            // where the tool comes
  double m_turn = interaction::AimSettings().turn; // degrees
  double m_tilt = interaction::AimSettings().tilt;
  bool m_isLeft = false;
  bool m_isBurrAlone = false;
};

} // namespace petrous::workstation
