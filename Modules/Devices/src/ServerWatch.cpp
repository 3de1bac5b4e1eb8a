#include "ServerWatch.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <exception>
#include <string>

#include "petrous/Core/NumberText.h"
#include "petrous/Devices/DeviceServerProtocol.h"
#include "petrous/Haptics/Device.h"

namespace petrous::devices
{

/// A text field of the block as one printable line, for any content.
std::string serverText(const char* field, std::size_t size);

/// The server's description of its device. `fault` is empty, or the reason why it is impossible.
haptics::DeviceDescription serverDescription(const petrous_device_block& block, std::string& fault);

bool same(const haptics::DeviceDescription& a, const haptics::DeviceDescription& b);

namespace
{

// Limits for hand-held devices; the strongest on the market give about 40 N and 15 N/mm.
constexpr double kMaxForce = 200.0;          // N
constexpr double kMaxTorque = 20000.0;       // N mm
constexpr double kMaxStiffness = 100.0;      // N/mm
constexpr double kMaxAngularStiffness = 1e6; // N mm/rad

double number(const double& field)
{
  double value = 0.0;
  __atomic_load(&field, &value, __ATOMIC_RELAXED);
  return value;
}

void check(double value, double most, const char* what, const char* unit, std::string& fault)
{
  if (fault.empty() && !(value >= 0.0 && value <= most))
    fault = std::string("describes a device with a ") + what + " of " + core::plainText(value) +
            " " + unit + "; it must lie between 0 and " + core::plainText(most);
}

} // namespace

std::string serverText(const char* field, std::size_t size)
{
  std::string text;
  for (std::size_t i = 0; i < size; ++i)
  {
    const char c = __atomic_load_n(&field[i], __ATOMIC_RELAXED);
    if (c == '\0')
      break;
    const auto byte = static_cast<unsigned char>(c);
    text += byte < 0x20 || byte == 0x7f ? ' ' : c;
  }
  return text;
}

haptics::DeviceDescription serverDescription(const petrous_device_block& block, std::string& fault)
{
  const std::uint32_t flags = __atomic_load_n(&block.flags, __ATOMIC_RELAXED);
  haptics::DeviceDescription description;
  description.name = serverText(block.name, sizeof block.name);
  description.sensesRotation = (flags & PETROUS_SENSES_ROTATION) != 0;
  description.givesForce = (flags & PETROUS_GIVES_FORCE) != 0;
  description.givesTorque = (flags & PETROUS_GIVES_TORQUE) != 0;
  description.maxForce = number(block.max_force);
  description.maxTorque = number(block.max_torque);
  description.maxStiffness = number(block.max_stiffness);
  description.maxAngularStiffness = number(block.max_angular_stiffness);

  fault.clear();
  check(description.maxForce, kMaxForce, "force", "N", fault);
  check(description.maxTorque, kMaxTorque, "torque", "N mm", fault);
  check(description.maxStiffness, kMaxStiffness, "stiffness", "N/mm", fault);
  check(description.maxAngularStiffness, kMaxAngularStiffness, "angular stiffness", "N mm/rad",
        fault);
  return description;
}

bool same(const haptics::DeviceDescription& a, const haptics::DeviceDescription& b)
{
  return a.name == b.name && a.sensesRotation == b.sensesRotation && a.givesForce == b.givesForce &&
         a.givesTorque == b.givesTorque && a.maxForce == b.maxForce && a.maxTorque == b.maxTorque &&
         a.maxStiffness == b.maxStiffness && a.maxAngularStiffness == b.maxAngularStiffness;
}

namespace
{

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr auto kPeriod = std::chrono::milliseconds(10);
constexpr auto kAsk = std::chrono::milliseconds(50);
// A longer pause was ours (a debugger, a suspended laptop) and does not count against the server.
constexpr double kMaxStep = 0.05; // s
constexpr int kMaxFailures = 5;
constexpr double kSettled = 10.0;   // s; a server that ran this long may fail anew
constexpr double kUserTime = 120.0; // s to do what a starting server asks for

std::string seconds(double value)
{
  return core::plainText(value) + " s";
}

} // namespace

ServerWatch::ServerWatch(const ServedDevice::Options& options)
  : m_options(options)
  , m_block(options.name)
{
  m_thread = std::thread([this] { run(); });
}

ServerWatch::~ServerWatch()
{
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_stop = true;
  }
  m_wake.notify_all();
  m_thread.join();
  __atomic_store_n(&m_block->petrous_state, std::uint32_t{PETROUS_CLOSING}, __ATOMIC_RELEASE);
  if (!m_process.waitForEnd(0.5))
  {
    m_process.signal(SIGTERM);
    m_process.waitForEnd(0.2);
  }
}

haptics::DeviceDescription ServerWatch::awaitReady()
{
  // Slightly longer than the watch's own limit, so that its message is the one thrown.
  const auto limit = Seconds(m_options.startTimeout + 1.0);
  auto end = Clock::now() + limit;
  std::unique_lock<std::mutex> lock(m_mutex);
  const auto answered = [this] { return m_description || m_reason; };
  while (!m_wake.wait_for(lock, kAsk, answered) && Clock::now() < end)
  {
    if (m_options.wanted && !m_options.wanted())
      throw ServerError(Reason::NotReady,
                        "device server '" + m_options.name + "' is not waited for any longer");
    if (m_waitsFor.empty())
      continue;
    end = Clock::now() + limit;
    if (m_options.waits)
    {
      const std::string text = m_waitsFor;
      lock.unlock();
      m_options.waits(text);
      lock.lock();
    }
  }
  if (m_description)
    return *m_description;
  throw ServerError(m_reason.value_or(Reason::NotReady), m_status.fault);
}

ServedDevice::Status ServerWatch::status() const
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  ServedDevice::Status status = m_status;
  status.pid = m_pid.load();
  return status;
}

void ServerWatch::run()
{
  // Out of memory: escaping the thread would terminate the program; the next beat tries again.
  const auto attempt = [](const auto& what)
  {
    try
    {
      what();
    }
    catch (const std::exception&)
    {
    }
  };
  if (launches())
    attempt([this] { start(); });
  auto last = Clock::now();
  std::unique_lock<std::mutex> lock(m_mutex);
  while (!m_wake.wait_for(lock, kPeriod, [this] { return m_stop; }))
  {
    lock.unlock();
    const auto now = Clock::now();
    attempt([&] { look(std::min(Seconds(now - last).count(), kMaxStep)); });
    last = now;
    lock.lock();
  }
}

void ServerWatch::look(double elapsed)
{
  __atomic_add_fetch(&m_block->petrous_beat, 1, __ATOMIC_RELEASE);
  m_sinceBegin += elapsed;
  m_untilStart -= elapsed;
  if (launches())
    lookAfterProcess();
  else
    lookForProcess();
  if (link() == Link::Gone || link() == Link::Refused)
    return;
  const std::uint32_t version = __atomic_load_n(&m_block->server_version, __ATOMIC_ACQUIRE);
  if (version != 0 && version != PETROUS_DEVICE_VERSION)
  {
    giveUpOn(Link::Refused, Reason::VersionMismatch,
             "speaks version " + std::to_string(version) + " of the protocol, Petrous version " +
                 std::to_string(PETROUS_DEVICE_VERSION));
    return;
  }
  lookAtState();
  lookAtBeat(elapsed);
}

void ServerWatch::lookAfterProcess()
{
  if (const auto end = m_process.ended())
  {
    // Why it hung or was refused is more informative than that it was killed for it.
    const std::uint32_t version = __atomic_load_n(&m_block->server_version, __ATOMIC_ACQUIRE);
    if (version != 0 && version != PETROUS_DEVICE_VERSION)
      fail(Reason::VersionMismatch, "speaks version " + std::to_string(version) +
                                        " of the protocol, Petrous version " +
                                        std::to_string(PETROUS_DEVICE_VERSION));
    else if (link() != Link::Hung)
      fail(Reason::Ended, *end);
    m_pid = 0;
    setLink(Link::Gone);
    m_failures = m_sinceBegin > kSettled ? 1 : m_failures + 1;
    m_untilStart = 0.1 * (1 << m_failures);
    if (m_options.restart && m_failures >= kMaxFailures)
      fail(Reason::Ended, *end + "; that was the " + std::to_string(m_failures) +
                              "th time in a row, and it is not started again");
  }
  if (!m_process.runs() && mayRestart() && m_untilStart <= 0.0)
    start();
}

bool ServerWatch::mayRestart() const
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  return m_options.restart && m_description && m_failures < kMaxFailures;
}

void ServerWatch::lookForProcess()
{
  const int pid = static_cast<int>(__atomic_load_n(&m_block->server_pid, __ATOMIC_ACQUIRE));
  if (pid <= 0)
    return;
  if (pid != m_pid.load())
  {
    begin();
    m_pid = pid;
  }
  else if (link() != Link::Gone && ::kill(pid, 0) != 0 && errno == ESRCH)
    giveUpOn(Link::Gone, Reason::Ended, "has gone");
}

void ServerWatch::lookAtState()
{
  const std::uint32_t state = __atomic_load_n(&m_block->server_state, __ATOMIC_ACQUIRE);
  const std::string text = serverText(m_block->error, sizeof m_block->error);
  switch (state)
  {
  case PETROUS_SERVER_EMPTY:
  case PETROUS_SERVER_STARTING:
    lookAtStart(state == PETROUS_SERVER_STARTING ? text : std::string());
    break;
  case PETROUS_SERVER_READY:
    if (!m_accepted)
      accept();
    else if (link() == Link::Up)
      clearFault();
    break;
  case PETROUS_SERVER_NO_DEVICE:
    fail(Reason::NoDevice, "has no device" + (text.empty() ? text : ": " + text));
    break;
  case PETROUS_SERVER_FAULT:
    fail(Reason::Fault, "reports a fault" + (text.empty() ? text : ": " + text));
    break;
  default:
    fail(Reason::Fault, "is in state " + std::to_string(state) + ", which there is not");
  }
}

// `text`: what the user has to do first, if anything.
void ServerWatch::lookAtStart(const std::string& text)
{
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_waitsFor = text;
  }
  if (m_accepted && !text.empty())
    fail(Reason::NotReady, "waits: " + text);
  const double most = text.empty() ? m_options.startTimeout : kUserTime;
  if (link() != Link::Starting || m_sinceBegin <= most)
    return;
  if (m_pid.load() == 0)
    giveUpOn(Link::Gone, Reason::NotStarted,
             "was not started: nobody opened " + m_block.path() + " within " + seconds(most));
  else
    giveUpOn(Link::Hung, Reason::NotReady,
             "is not ready after " + seconds(most) + (text.empty() ? text : ": " + text));
}

void ServerWatch::lookAtBeat(double elapsed)
{
  const std::uint64_t beat = __atomic_load_n(&m_block->server_beat, __ATOMIC_ACQUIRE);
  if (beat != m_beat)
  {
    m_beat = beat;
    m_silence = 0.0;
    if (link() == Link::Hung)
      setLink(m_accepted ? Link::Up : Link::Starting);
    return;
  }
  m_silence += elapsed;
  if (link() == Link::Up && m_silence > m_options.hungAfter)
    giveUpOn(Link::Hung, Reason::NotReady,
             "hangs: it has not answered for " + seconds(m_options.hungAfter));
}

void ServerWatch::accept()
{
  std::string fault;
  const haptics::DeviceDescription description = serverDescription(*m_block, fault);
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    if (fault.empty() && m_description && !same(*m_description, description))
      fault = "came back as another device (" + description.name + ")";
    if (fault.empty())
      m_description = description;
  }
  if (!fault.empty())
  {
    giveUpOn(Link::Refused, Reason::BadDescription, fault);
    return;
  }
  m_accepted = true;
  m_silence = 0.0;
  setLink(Link::Up);
  clearFault();
  m_wake.notify_all();
}

void ServerWatch::begin()
{
  m_accepted = false;
  m_sinceBegin = 0.0;
  m_silence = 0.0;
  m_epoch.fetch_add(1);
  setLink(Link::Starting);
}

void ServerWatch::start()
{
  const bool again = m_epoch.load() > 0;
  m_block.forgetServer();
  begin();
  if (const auto fault = m_process.start(m_options.command, m_block.path()))
  {
    giveUpOn(Link::Gone, Reason::NotStarted, *fault);
    ++m_failures;
    m_untilStart = 0.1 * (1 << m_failures);
    return;
  }
  m_pid = m_process.pid();
  if (again)
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    ++m_status.restarts;
  }
}

void ServerWatch::giveUpOn(Link link, Reason reason, const std::string& words)
{
  fail(reason, words);
  setLink(link);
  // A hung server cannot be asked to end; one of ours is killed so that it can be restarted.
  if (link == Link::Hung && mayRestart())
    m_process.signal(SIGKILL);
}

void ServerWatch::fail(Reason reason, const std::string& words)
{
  const int pid = m_pid.load();
  const std::string who = "device server '" + m_options.name + "'" +
                          (pid > 0 ? " (process " + std::to_string(pid) + ") " : " ");
  const std::lock_guard<std::mutex> lock(m_mutex);
  m_status.fault = who + words;
  m_status.lastFault = m_status.fault;
  m_reason = reason;
  m_wake.notify_all();
}

void ServerWatch::clearFault()
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  m_status.fault.clear();
  m_reason.reset();
}

} // namespace petrous::devices
