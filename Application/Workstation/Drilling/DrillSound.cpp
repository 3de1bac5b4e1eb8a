#include "DrillSound.h"

#include "petrous/Sound/Speaker.h"

namespace petrous::workstation
{

namespace
{

constexpr int kFlutes = 8;   // of a cutting burr
constexpr int kWatch = 1000; // ms

Eigen::Vector3d forceOf(const session::TickRecord& record)
{
  return {record.burrForce[0], record.burrForce[1], record.burrForce[2]};
}

} // namespace

DrillSound::DrillSound(presenters::WorkstationModel& model, QObject* parent)
  : QObject(parent)
  , m_model(model)
  , m_signal(std::make_shared<sound::DrillSignal>())
{
  connect(&m_opening, &BackgroundWork::failed, this, &DrillSound::failed);
  m_watch.setInterval(kWatch);
  connect(&m_watch, &QTimer::timeout, this,
          [this]
          {
            if (m_speaker && m_speaker->plays())
              return;
            setOn(false);
            emit failed(tr("The sound output is gone; the drill is not heard any more"));
          });
}

DrillSound::~DrillSound() = default;

void DrillSound::setOn(bool on)
{
  m_opening.abandon();
  m_watch.stop();
  m_speaker.reset();
  if (!on)
    return;
  m_opening.replace(
      [this](const core::Progress& progress)
      {
        const auto fill = [signal = m_signal](double rate)
        {
          return
              [signal, voice = sound::DrillVoice(rate)](float* samples, std::size_t count) mutable
          { voice.render(signal->now(), samples, count); };
        };
        auto speaker = std::make_shared<std::unique_ptr<sound::Speaker>>(
            std::make_unique<sound::Speaker>(fill));
        progress.check("sound"); // else it ends here, in this thread
        return BackgroundWork::Reply(
            [this, speaker]
            {
              m_speaker = std::move(*speaker);
              m_watch.start();
            });
      });
}

std::function<void(const session::TickRecord&)> DrillSound::listener() const
{
  return [signal = m_signal](const session::TickRecord& record)
  {
    signal->running = record.drill != 0;
    if (record.drill != 0)
      signal->spindle = record.input.spindle();
    signal->load = forceOf(record).norm();
  };
}

void DrillSound::setBurr(const dissection::Burr& burr)
{
  m_signal->flutes = burr.kind == dissection::Burr::Kind::Cutting ? kFlutes : 0;
  m_signal->rpm = burr.rpm;
}

void DrillSound::show(const session::TickRecord& record, double burrRadius)
{
  const Eigen::Vector3d force = forceOf(record);
  const bool cuts = record.drill != 0 && force.norm() > 0.0;
  if (!cuts)
    m_signal->wall = sound::DrillVoice::kThick; // until the next contact
  if (!cuts || !isOn() || !m_model.ready())
    return;
  const Eigen::Vector3d into = -force.normalized();
  if (const auto wall = m_model.wallBehind(record.proxy.pose().position + burrRadius * into, into))
    m_signal->wall = *wall;
}

void DrillSound::setWarning(bool warned)
{
  m_signal->warning = warned;
}

void DrillSound::toolGone()
{
  m_signal->running = false;
  m_signal->load = 0.0;
  m_signal->wall = sound::DrillVoice::kThick;
  m_signal->warning = false;
}

} // namespace petrous::workstation
