#include "Bench.h"

#include <algorithm>
#include <chrono>

namespace standin
{

namespace
{

constexpr std::size_t kQueue = 64; // reports queued by hidraw

using Milliseconds = std::chrono::duration<double, std::milli>;

bool isSetUp(Command::Kind kind)
{
  return kind == Command::Kind::Plug || kind == Command::Kind::Deny || kind == Command::Kind::Allow;
}

} // namespace

void Bench::play(const std::vector<Command>& commands)
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  // Devices connected at the very beginning are there before the first enumeration.
  auto first = commands.begin();
  while (!m_busy && first != commands.end() && isSetUp(first->kind))
    apply(*first++);
  m_commands.insert(m_commands.end(), first, commands.end());
  m_busy = true;
  if (!m_thread.joinable())
  {
    m_stop = false;
    m_thread = std::thread([this] { run(); });
  }
  m_changed.notify_all();
}

void Bench::finish()
{
  std::unique_lock<std::mutex> lock(m_mutex);
  m_changed.wait(lock, [this] { return !m_busy; });
}

void Bench::stop()
{
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_stop = true;
    m_commands.clear();
    m_busy = false;
  }
  m_changed.notify_all();
  if (m_thread.joinable())
    m_thread.join();
  m_thread = std::thread();
}

void Bench::reset()
{
  stop();
  const std::lock_guard<std::mutex> lock(m_mutex);
  m_devices.clear();
}

void Bench::run()
{
  std::unique_lock<std::mutex> lock(m_mutex);
  while (!m_stop)
  {
    if (m_commands.empty())
    {
      m_busy = false;
      m_changed.notify_all();
      m_changed.wait(lock, [this] { return m_stop || !m_commands.empty(); });
      continue;
    }
    const Command command = m_commands.front();
    m_commands.pop_front();
    if (command.kind == Command::Kind::Wait)
      m_changed.wait_for(lock, Milliseconds(command.milliseconds), [this] { return m_stop; });
    else if (command.kind == Command::Kind::Await)
      m_changed.wait(lock, [&] { return m_stop || m_devices[command.node].open > 0; });
    else
      apply(command);
  }
}

void Bench::apply(const Command& command)
{
  Device& device = m_devices[command.node];
  switch (command.kind)
  {
  case Command::Kind::Plug:
    std::copy_n(command.numbers, 4, device.numbers);
    device.name = command.name;
    device.plugged = true;
    device.failing = false;
    ++device.generation;
    break;
  case Command::Kind::Deny:
    device.denied = true;
    break;
  case Command::Kind::Allow:
    device.denied = false;
    break;
  case Command::Kind::Report:
    if (device.open > 0 && device.reports.size() < kQueue)
      device.reports.push_back(command.bytes);
    break;
  case Command::Kind::Error:
    device.failing = true;
    break;
  case Command::Kind::Unplug:
    device.plugged = false;
    device.reports.clear();
    break;
  case Command::Kind::Await:
  case Command::Kind::Wait:
    break;
  }
  m_changed.notify_all();
}

std::map<std::string, Bench::Device> Bench::plugged()
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  std::map<std::string, Device> result;
  for (const auto& [node, device] : m_devices)
    if (device.plugged)
      result.emplace(node, device);
  return result;
}

unsigned Bench::open(const std::string& node)
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  const auto found = m_devices.find(node);
  if (found == m_devices.end() || !found->second.plugged || found->second.denied)
    return 0;
  Device& device = found->second;
  device.reports.clear();
  ++device.opened;
  ++device.open;
  m_changed.notify_all();
  return device.generation;
}

void Bench::close(const std::string& node)
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  --m_devices[node].open;
}

int Bench::opened(const std::string& node)
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  return m_devices[node].opened;
}

int Bench::read(const std::string& node, unsigned generation, unsigned char* bytes,
                std::size_t size, int milliseconds)
{
  std::unique_lock<std::mutex> lock(m_mutex);
  Device& device = m_devices[node];
  const auto gone = [&] { return !device.plugged || device.generation != generation; };
  const auto ready = [&] { return gone() || device.failing || !device.reports.empty(); };
  if (milliseconds < 0)
    m_changed.wait(lock, ready);
  else
    m_changed.wait_for(lock, Milliseconds(milliseconds), ready);
  if (gone())
    return -1;
  if (!device.reports.empty())
  {
    const std::vector<unsigned char> report = device.reports.front();
    device.reports.pop_front();
    const std::size_t count = std::min(size, report.size());
    std::copy_n(report.begin(), count, bytes);
    return static_cast<int>(count);
  }
  if (device.failing)
  {
    device.failing = false;
    return -1;
  }
  return 0;
}

} // namespace standin
