#include "ObjectChecks.h"

#include <chrono>
#include <memory>
#include <system_error>

#include "petrous/Library/ObjectStore.h"

namespace petrous::library
{

namespace fs = std::filesystem;

ObjectChecks::~ObjectChecks()
{
  m_stop.cancel();
  if (m_thread.joinable())
    m_thread.join();
}

void ObjectChecks::start(const fs::path& object, const std::string& what)
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  const auto [known, isNew] = m_checks.try_emplace(object, Check{what, false, {}});
  if (!isNew && known->second.damage.empty())
    return;
  known->second = {what, false, {}};
  m_queue.push_back(object);
  if (m_running)
    return;
  if (m_thread.joinable())
    m_thread.join(); // it is finishing and needs no lock
  try
  {
    m_running = true;
    m_thread = std::thread([this] { run(); });
  }
  catch (const std::system_error&)
  {
    m_running = false; // no thread available: `wait` runs the checks
  }
}

void ObjectChecks::run()
{
  const core::Progress progress(
      {}, std::shared_ptr<const core::CancelToken>(std::shared_ptr<void>(), &m_stop));
  for (;;)
  {
    fs::path object;
    std::string what;
    {
      const std::lock_guard<std::mutex> lock(m_mutex);
      if (m_queue.empty() || m_stop.isCancelled())
      {
        m_running = false;
        return;
      }
      object = m_queue.front();
      m_queue.pop_front();
      what = m_checks[object].what;
    }
    std::string damage;
    try
    {
      checkObject(object, what, progress);
    }
    catch (const core::CancelledError&)
    {
      continue;
    }
    catch (const std::exception& error)
    {
      damage = error.what();
    }
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_checks[object].done = true;
    m_checks[object].damage = damage;
    m_done.notify_all();
  }
}

std::string ObjectChecks::wait(const fs::path& object, const std::string& what,
                               const core::Progress& progress)
{
  if (!knows(object))
    start(object, what);
  std::unique_lock<std::mutex> lock(m_mutex);
  while (!m_checks[object].done)
  {
    progress.check("checking the voxels");
    if (!m_running)
    {
      m_running = true;
      lock.unlock();
      run();
      lock.lock();
      continue;
    }
    m_done.wait_for(lock, std::chrono::milliseconds(50));
  }
  return m_checks[object].damage;
}

std::vector<std::string> ObjectChecks::waitForAll(const core::Progress& progress)
{
  std::vector<fs::path> objects;
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    for (const auto& [object, check] : m_checks)
      objects.push_back(object);
  }
  std::vector<std::string> damage;
  for (const fs::path& object : objects)
    if (const std::string words = wait(object, {}, progress); !words.empty())
      damage.push_back(words);
  return damage;
}

bool ObjectChecks::knows(const fs::path& object) const
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  return m_checks.count(object) > 0;
}

void ObjectChecks::forget(const fs::path& object)
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  const auto check = m_checks.find(object);
  if (check != m_checks.end() && check->second.done)
    m_checks.erase(check);
}

std::string ObjectChecks::found(const fs::path& object) const
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  const auto check = m_checks.find(object);
  return check == m_checks.end() ? std::string() : check->second.damage;
}

} // namespace petrous::library
