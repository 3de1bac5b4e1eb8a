#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include <QFileSystemWatcher>
#include <QObject>
#include <QTimer>

#include "petrous/Presenters/ActiveDevice.h"

namespace petrous::workstation
{

/// Detects, opens and closes devices in a separate thread, since USB and servers are slow. The
/// thread ends when there is nothing to do: it looks when something is plugged in or installed (the
/// kernel tells of changes in /dev and the servers' folders), or when `look` is called. hidapi is
/// used, and so loaded, only once a SpaceMouse or pedal is plugged in or `look` is called.
class DeviceWatcher : public QObject
{
  Q_OBJECT
public:
  /// `lookEvery`: ms, for sources of whose changes the kernel does not tell; 0: never by itself.
  DeviceWatcher(presenters::DeviceSources sources, int lookEvery, QObject* parent = nullptr);
  ~DeviceWatcher() override; ///< waits for a device being opened

  const presenters::DeviceSources& sources() const noexcept { return m_sources; }
  const presenters::DeviceList& found() const noexcept { return m_found; }

  void look(); ///< answered by `changed` if it finds another list

  /// The pedal that is, or was, connected; nullptr until there was one.
  const std::shared_ptr<devices::Pedal>& pedal() const noexcept { return m_pedal; }

  /// Answered by `opened` or `failed`, unless another device is opened or `drop` is called
  /// meanwhile.
  void open(const presenters::InputDevice& input);
  void drop(); ///< cancels opening

  /// The device announced by `opened`.
  std::shared_ptr<presenters::ActiveDevice> take() { return std::move(m_opened); }

  /// Closes it asynchronously; it must not be read any more.
  void close(std::shared_ptr<presenters::ActiveDevice> device);

signals:
  void changed(); ///< `found`, or the pedal
  void opened();
  void failed(const QString& why);
  void waits(const QString& advice); ///< what to do first for the device being opened

private:
  void run();
  void post(std::function<void()> job);
  void find(bool withHid);
  void startLook(bool withHid);
  void show(const presenters::DeviceList& found);

  const presenters::DeviceSources m_sources;
  const int m_lookEvery;
  presenters::DeviceList m_found; // as last signalled
  std::shared_ptr<devices::Pedal> m_pedal;
  std::shared_ptr<presenters::ActiveDevice> m_opened;
  std::atomic<std::uint64_t> m_wanted{0}; // the latest request; older answers are ignored

  bool m_usesHid = false; // from the first device or question on
  QFileSystemWatcher m_changes;
  QTimer m_soon; // after a change: udev sets permissions somewhat later

  presenters::DeviceList m_seen; // used by the thread only
  std::mutex m_mutex;            // guards what follows
  std::condition_variable m_wake;
  std::deque<std::function<void()>> m_jobs;
  bool m_stop = false;
  bool m_isRunning = false;
  std::thread m_thread; // last
};

} // namespace petrous::workstation
