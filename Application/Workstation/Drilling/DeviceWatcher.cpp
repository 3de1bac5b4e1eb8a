#include "DeviceWatcher.h"

#include <chrono>
#include <utility>

#include <pthread.h>

#include <QFile>
#include <QFileInfo>

#include "Application.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/Log.h"
#include "petrous/Devices/DeviceCatalogue.h"

namespace petrous::workstation
{

using presenters::ActiveDevice;
using presenters::DeviceList;
using presenters::InputDevice;

namespace
{
constexpr int kAfterChange = 300; // ms
} // namespace

DeviceWatcher::DeviceWatcher(presenters::DeviceSources sources, int lookEvery, QObject* parent)
  : QObject(parent)
  , m_sources(std::move(sources))
  , m_lookEvery(lookEvery)
{
  if (!m_sources.hid && m_sources.serverFolders.empty())
    return;
  m_soon.setSingleShot(true);
  m_soon.setInterval(kAfterChange);
  connect(&m_soon, &QTimer::timeout, this, [this] { startLook(devices::isKnownPluggedIn()); });
  connect(&m_changes, &QFileSystemWatcher::directoryChanged, &m_soon, qOverload<>(&QTimer::start));
  if (m_sources.hid)
    m_changes.addPath("/dev");
  for (const auto& folder : m_sources.serverFolders)
    if (const QString path = QFile::decodeName(folder.c_str()); QFileInfo::exists(path))
      m_changes.addPath(path);
  startLook(m_lookEvery > 0 || devices::isKnownPluggedIn());
}

DeviceWatcher::~DeviceWatcher()
{
  drop();
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_stop = true;
  }
  m_wake.notify_all();
  if (m_thread.joinable())
    m_thread.join();
}

void DeviceWatcher::look()
{
  startLook(true);
}

void DeviceWatcher::startLook(bool withHid)
{
  if (!m_sources.hid && m_sources.serverFolders.empty())
    return;
  m_usesHid = m_usesHid || withHid;
  post([this, usesHid = m_usesHid] { find(usesHid); });
}

void DeviceWatcher::post(std::function<void()> job)
{
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_jobs.push_back(std::move(job));
    if (m_isRunning)
      return m_wake.notify_all();
    m_isRunning = true;
  }
  if (m_thread.joinable()) // it has ended
    m_thread.join();
  try
  {
    m_thread = std::thread([this] { guarded([this] { run(); }); });
  }
  catch (...)
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_isRunning = false; // the job waits for the next one
    throw;
  }
}

void DeviceWatcher::run()
{
  ::pthread_setname_np(::pthread_self(), "petrous-devices");
  std::unique_lock<std::mutex> lock(m_mutex);
  while (!m_jobs.empty()) // pending closes are still processed after a stop
  {
    std::deque<std::function<void()>> jobs = std::exchange(m_jobs, {});
    lock.unlock();
    // An exception for one device must not affect the others.
    for (const auto& job : jobs)
      guarded(job);
    guarded([&jobs] { jobs.clear(); });
    lock.lock();
    if (m_lookEvery <= 0 || m_stop)
      continue;
    m_wake.wait_for(lock, std::chrono::milliseconds(m_lookEvery),
                    [this] { return m_stop || !m_jobs.empty(); });
    if (!m_stop)
      m_jobs.push_back([this] { find(true); });
  }
  m_isRunning = false;
}

void DeviceWatcher::find(bool withHid)
{
  presenters::DeviceSources sources = m_sources;
  if (!withHid)
    sources.hid.reset();
  DeviceList found = presenters::findDevices(sources);
  if (found == m_seen)
    return;
  m_seen = std::move(found);
  std::string text = "devices:";
  for (const InputDevice& device : m_seen.devices)
    text += device.kind == InputDevice::Kind::Server ? " server," : " " + device.name + ",";
  core::log::info(text + (m_seen.pedal ? " pedal" : " no pedal"));
  QMetaObject::invokeMethod(
      this, [this, seen = m_seen] { show(seen); }, Qt::QueuedConnection);
}

void DeviceWatcher::show(const DeviceList& found)
{
  m_found = found;
  // It is kept: a disconnected pedal reads as released, and may be reconnected.
  if (found.pedal && !m_pedal)
    m_pedal = std::make_shared<devices::Pedal>(m_sources.hid, devices::Pedal::Options());
  emit changed();
}

void DeviceWatcher::open(const InputDevice& input)
{
  const std::uint64_t question = ++m_wanted;
  post(
      [this, input, question]
      {
        const auto wanted = [this, question] { return question == m_wanted; };
        const auto advise = [this, name = words(input.name)](const std::string& text)
        {
          QMetaObject::invokeMethod(
              this, [this, name, text] { emit waits(name + ": " + phrase(text)); },
              Qt::QueuedConnection);
        };
        if (!wanted())
          return;
        std::shared_ptr<ActiveDevice> device;
        QString why;
        try
        {
          device = std::make_shared<ActiveDevice>(m_sources, input, wanted, advise);
        }
        catch (const core::Error& error)
        {
          why = toString(error);
        }
        catch (const std::exception&) // out of memory, no thread
        {
          why = tr("%1 cannot be opened").arg(words(input.name));
        }
        QMetaObject::invokeMethod(
            this,
            [this, device, why, question]() mutable
            {
              if (question != m_wanted)
                return post([last = std::move(device)] {});
              if (!device)
                return emit failed(why);
              m_opened = std::move(device);
              emit opened();
            },
            Qt::QueuedConnection);
      });
}

void DeviceWatcher::drop()
{
  ++m_wanted;
}

void DeviceWatcher::close(std::shared_ptr<ActiveDevice> device)
{
  if (device)
    post([last = std::move(device)]() mutable { last.reset(); });
}

} // namespace petrous::workstation
