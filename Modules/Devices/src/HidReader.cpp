#include "HidReader.h"

#include <chrono>
#include <exception>

#include "petrous/Devices/DeviceCatalogue.h"

namespace petrous::devices
{

namespace
{

constexpr int kReadMilliseconds = 100; // upper limit on the time to stop the thread

} // namespace

HidReader::HidReader(std::shared_ptr<const HidLibrary> library, std::string what, double lookEvery,
                     Calls calls)
  : m_library(std::move(library))
  , m_what(std::move(what))
  , m_lookEvery(lookEvery)
  , m_calls(std::move(calls))
  , m_problem("no " + m_what + " is plugged in")
{
  m_thread = std::thread([this] { run(); });
}

HidReader::~HidReader()
{
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_stop = true;
  }
  m_wake.notify_all();
  m_thread.join();
}

std::string HidReader::problem() const
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  return m_problem;
}

void HidReader::setProblem(const std::string& words)
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  m_problem = words;
}

void HidReader::run()
{
  while (!m_stop)
  {
    bool connected = false;
    try
    {
      if (const auto connection = connect())
      {
        connected = true;
        read(*connection);
      }
    }
    catch (const HidError& error)
    {
      setProblem(error.what());
    }
    catch (const std::exception&) // out of memory: escaping the thread would terminate the program
    {
      setProblem("cannot be read");
    }
    if (connected)
      m_calls.disconnected();
    std::unique_lock<std::mutex> lock(m_mutex);
    m_wake.wait_for(lock, std::chrono::duration<double>(m_lookEvery),
                    [this] { return m_stop.load(); });
  }
}

std::unique_ptr<HidLibrary::Connection> HidReader::connect()
{
  std::string problem = "no " + m_what + " is plugged in";
  for (const HidInterface& interface : m_library->list())
  {
    if (!m_calls.matches(interface))
      continue;
    if (auto connection = m_library->open(interface.path))
    {
      setProblem("");
      m_calls.connected(interface);
      return connection;
    }
    problem = adviceFor(interface, accessTo(interface.path));
  }
  setProblem(problem);
  return nullptr;
}

void HidReader::read(HidLibrary::Connection& connection)
{
  unsigned char bytes[64];
  while (!m_stop)
  {
    const int size = connection.read(bytes, sizeof bytes, kReadMilliseconds);
    if (size < 0)
    {
      setProblem("the " + m_what + " was unplugged, or reading it failed");
      return;
    }
    if (size > 0)
      m_calls.report(bytes, static_cast<std::size_t>(size));
  }
}

} // namespace petrous::devices
