#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <sys/socket.h>
#include <unistd.h>

#include "petrous/Network/DicomNode.h"

// DCMTK's, whose headers are for sources only.
class DcmTransportLayer;
class OFCondition;
struct T_ASC_Association;
struct T_ASC_Network;
struct T_ASC_Parameters;

namespace petrous::network
{

/// "node 'pacs' (host:104)"
std::string place(const Node& node);

/// Before anything else of DCMTK: silences its log, which holds data sets and addresses.
void prepareToolkit();

/// Ends the connection, from a thread of its own, when the user cancels or the node is silent for
/// too long: the blocking call of DCMTK then returns.
class ConnectionWatch
{
public:
  enum class End
  {
    None,
    Cancelled,
    TimedOut,
    TooLarge,
    Failed ///< fault()
  };

  ConnectionWatch(core::Progress progress, std::chrono::milliseconds limit)
    : m_progress(std::move(progress))
    , m_limit(limit)
    , m_thread([this] { run(); })
  {
  }
  ~ConnectionWatch()
  {
    {
      const std::lock_guard<std::mutex> lock(m_mutex);
      m_done = true;
    }
    m_wake.notify_all();
    m_thread.join();
    forget();
  }
  ConnectionWatch(const ConnectionWatch&) = delete;
  ConnectionWatch& operator=(const ConnectionWatch&) = delete;

  /// A duplicate: DCMTK may close its own at any time, and its number be used again. One that
  /// cannot be watched is not used.
  void watch(int descriptor)
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    if (m_descriptor >= 0)
      ::close(m_descriptor);
    m_descriptor = ::dup(descriptor);
    active();
    if (m_descriptor < 0)
      failLocked(std::make_exception_ptr(core::Error(
          core::Fault::Refused, "network: too many files are open; close other cases, or raise "
                                "the limit (ulimit -n)")));
    if (m_end != End::None)
      ::shutdown(descriptor, SHUT_RDWR);
  }
  void forget()
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    if (m_descriptor >= 0)
      ::close(m_descriptor);
    m_descriptor = -1;
  }
  /// From now on silence is limited to `limit`, and what ended another connection does not end the
  /// next one, unless it was the user.
  void begin(std::chrono::milliseconds limit)
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_limit = limit;
    if (m_end != End::Cancelled)
      m_end = End::None;
    active();
  }

  void active() noexcept
  {
    m_last.store(std::chrono::steady_clock::now().time_since_epoch().count());
  }
  void end(End why)
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    endLocked(why);
  }
  /// For what must not pass through DCMTK.
  void fail(std::exception_ptr fault)
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    failLocked(std::move(fault));
  }
  End ended() const
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    return m_end;
  }
  std::exception_ptr fault() const
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    return m_fault;
  }

  // Told by OpenSSL, from whatever thread connects.
  std::atomic<int> certificateFault{0}; ///< X509_V_ERR_... of the peer's certificate
  std::atomic<int> alert{-1};           ///< SSL_AD_... that the peer ended the connection with

private:
  void endLocked(End why)
  {
    if (m_end != End::None)
      return;
    m_end = why;
    if (m_descriptor >= 0)
      ::shutdown(m_descriptor, SHUT_RDWR);
  }
  void failLocked(std::exception_ptr fault)
  {
    if (m_end == End::None)
      m_fault = std::move(fault);
    endLocked(End::Failed);
  }

  void run()
  {
    std::unique_lock<std::mutex> lock(m_mutex);
    while (!m_wake.wait_for(lock, std::chrono::milliseconds(50), [this] { return m_done; }))
    {
      try
      {
        m_progress.check("network");
      }
      catch (const core::CancelledError&)
      {
        endLocked(End::Cancelled);
      }
      catch (...)
      {
        failLocked(std::current_exception());
      }
      const std::chrono::steady_clock::duration since(
          std::chrono::steady_clock::now().time_since_epoch().count() - m_last.load());
      if (m_descriptor >= 0 && since > m_limit)
        endLocked(End::TimedOut);
    }
  }

  const core::Progress m_progress;
  std::chrono::milliseconds m_limit;
  mutable std::mutex m_mutex;
  std::condition_variable m_wake;
  bool m_done = false;
  int m_descriptor = -1;
  End m_end = End::None;
  std::exception_ptr m_fault;
  std::atomic<std::chrono::steady_clock::rep> m_last{
      std::chrono::steady_clock::now().time_since_epoch().count()};
  std::thread m_thread; // last: it uses the others
};

/// Whether a connection that was accepted may go on, by its descriptor.
using Admission = std::function<bool(int descriptor)>;

/// TCP, or TLS by the node's files, without Nagle's algorithm; connections are given to the watch.
/// With `admits`, for connections that are accepted. Throws NetworkError (Tls) naming the file that
/// cannot be used.
std::unique_ptr<DcmTransportLayer> transportLayer(const Node& node, ConnectionWatch& watch,
                                                  const Admission& admits = {});

/// A presentation context to propose.
struct Context
{
  std::string sopClass;
  std::vector<const char*> transferSyntaxes;
  bool receives = false; ///< the node sends these to this program (C-GET)
};

/// An association with the node; released by `release`, aborted by the destructor otherwise.
class Association
{
public:
  /// Throws NetworkError and CancelledError. The node must outlive it.
  Association(const Node& node, const std::vector<Context>& contexts,
              const core::Progress& progress);
  ~Association();
  Association(const Association&) = delete;
  Association& operator=(const Association&) = delete;

  T_ASC_Association* get() const noexcept;
  ConnectionWatch& watch() const noexcept;
  const Node& node() const noexcept { return m_node; }
  int timeout() const; ///< seconds, for DCMTK; the watch is the finer one

  /// The accepted context, or 0.
  unsigned char context(const std::string& sopClass) const;
  unsigned char context(const std::string& sopClass, const char* transferSyntax) const;

  void release();

  /// Throws for a failed call of DCMTK.
  void require(const OFCondition& result, const std::string& task) const;
  [[noreturn]] void fail(const OFCondition& result, const std::string& task) const;

private:
  [[noreturn]] void failSilent(const std::string& task) const;
  [[noreturn]] void failCut(const std::string& task) const;
  [[noreturn]] void failTls() const;
  void open(const std::vector<Context>& contexts, const core::Progress& progress);

  struct Connection;

  const Node& m_node;
  std::shared_ptr<Connection> m_connection; ///< with who opens it
};

} // namespace petrous::network
