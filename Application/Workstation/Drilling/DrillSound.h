#pragma once

#include <memory>

#include <QObject>
#include <QTimer>

#include "BackgroundWork.h"
#include "petrous/Presenters/WorkstationModel.h"
#include "petrous/Session/TickRecord.h"
#include "petrous/Sound/DrillVoice.h"

namespace petrous::sound
{
class Speaker;
}

namespace petrous::workstation
{

/// The sound of the drill (sound::DrillVoice), off at first: then no library is loaded and no
/// thread runs.
class DrillSound : public QObject
{
  Q_OBJECT
public:
  explicit DrillSound(presenters::WorkstationModel& model, QObject* parent = nullptr);
  ~DrillSound() override;

  void setOn(bool on); ///< begins a moment later, or `failed`
  bool isOn() const noexcept { return m_speaker != nullptr; }

  /// For TouchSession::Setup::heard: load and drill of each tick, from any thread.
  std::function<void(const session::TickRecord&)> listener() const;

  void setBurr(const dissection::Burr& burr);
  /// Once a frame: how much bone remains behind the burr's contact.
  void show(const session::TickRecord& record, double burrRadius);
  void setWarning(bool warned);
  void toolGone(); ///< it was put away

signals:
  void failed(const QString& why); ///< it is off again

private:
  presenters::WorkstationModel& m_model;
  std::shared_ptr<sound::DrillSignal> m_signal;
  std::unique_ptr<sound::Speaker> m_speaker;
  QTimer m_watch; // that it still plays
  BackgroundWork m_opening;
};

} // namespace petrous::workstation
