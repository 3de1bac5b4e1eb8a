#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include <QObject>

#include "petrous/Presenters/ActiveDevice.h"

namespace petrous::workstation
{

/// Looks for hands, opens and closes them, in a thread of its own: USB and servers take their time.
/// Without a place to look in there is no thread.
class DeviceWatcher : public QObject
{
  Q_OBJECT
public:
  /// `lookEvery`: ms.
  DeviceWatcher(presenters::DeviceSources sources, int lookEvery, QObject* parent = nullptr);
  ~DeviceWatcher() override; ///< waits for what is being opened

  const presenters::DeviceList& found() const noexcept { return m_found; }

  /// The pedal that is, or was, plugged in; null until there was one.
  const std::shared_ptr<devices::Pedal>& pedal() const noexcept { return m_pedal; }

  /// Answered by `opened` or `failed`, unless something else is opened or dropped meanwhile.
  void open(const presenters::InputDevice& input);
  void drop(); ///< what is being opened is not wanted any more

  /// What `opened` told of.
  std::shared_ptr<presenters::ActiveDevice> take() { return std::move(m_opened); }

  /// Ends it without waiting for it; it must not be read any more.
  void close(std::shared_ptr<presenters::ActiveDevice> device);

signals:
  void changed(); ///< `found`, or the pedal
  void opened();
  void failed(const QString& why);

private:
  void run();
  void post(std::function<void()> job);
  void look();
  void show(const presenters::DeviceList& found);

  const presenters::DeviceSources m_sources;
  const int m_lookEvery;
  presenters::DeviceList m_found; // as told
  std::shared_ptr<devices::Pedal> m_pedal;
  std::shared_ptr<presenters::ActiveDevice> m_opened;
  std::atomic<std::uint64_t> m_wanted{0}; // the latest question; older answers are not heard

  presenters::DeviceList m_seen; // of the thread
  std::mutex m_mutex;            // for what follows
  std::condition_variable m_wake;
  std::deque<std::function<void()>> m_jobs;
  bool m_stop = false;
  std::thread m_thread; // last
};

} // namespace petrous::workstation
