#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
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
    TooLarge
  };

  ConnectionWatch(const core::Progress& progress, std::chrono::milliseconds limit)
    : m_progress(progress)
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

  /// A duplicate: DCMTK may close its own at any time, and its number be used again.
  void watch(int descriptor)
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    if (m_descriptor >= 0)
      ::close(m_descriptor);
    m_descriptor = ::dup(descriptor);
    active();
    if (m_end != End::None)
      ::shutdown(m_descriptor, SHUT_RDWR);
  }
  void forget()
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    if (m_descriptor >= 0)
      ::close(m_descriptor);
    m_descriptor = -1;
  }

  void active() { m_last.store(std::chrono::steady_clock::now().time_since_epoch().count()); }
  void end(End why)
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    endLocked(why);
  }
  End ended() const
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    return m_end;
  }

private:
  void endLocked(End why)
  {
    if (m_end != End::None)
      return;
    m_end = why;
    if (m_descriptor >= 0)
      ::shutdown(m_descriptor, SHUT_RDWR);
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
      const std::chrono::steady_clock::duration since(
          std::chrono::steady_clock::now().time_since_epoch().count() - m_last.load());
      if (m_descriptor >= 0 && since > m_limit)
        endLocked(End::TimedOut);
    }
  }

  const core::Progress& m_progress;
  const std::chrono::milliseconds m_limit;
  mutable std::mutex m_mutex;
  std::condition_variable m_wake;
  bool m_done = false;
  int m_descriptor = -1;
  End m_end = End::None;
  std::atomic<std::chrono::steady_clock::rep> m_last{
      std::chrono::steady_clock::now().time_since_epoch().count()};
  std::thread m_thread; // last: it uses the others
};

/// TCP, or TLS by the node's files, without Nagle's algorithm; connections are given to the watch.
/// Throws NetworkError (Tls) naming the file that cannot be used.
std::unique_ptr<DcmTransportLayer> transportLayer(const Node& node, ConnectionWatch& watch,
                                                  bool acceptor);

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
  /// Throws NetworkError and CancelledError. Node and progress must outlive it.
  Association(const Node& node, const std::vector<Context>& contexts,
              const core::Progress& progress);
  ~Association();
  Association(const Association&) = delete;
  Association& operator=(const Association&) = delete;

  T_ASC_Association* get() const noexcept { return m_association; }
  ConnectionWatch& watch() const noexcept { return *m_watch; }
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
  /// `code`: of OpenSSL, with the library's bit of DCMTK.
  [[noreturn]] void failTls(int code) const;
  void open(std::unique_ptr<DcmTransportLayer> layer, const std::vector<Context>& contexts);
  void close() noexcept;

  const Node& m_node;
  std::unique_ptr<ConnectionWatch> m_watch;
  std::unique_ptr<DcmTransportLayer> m_layer;
  T_ASC_Network* m_network = nullptr;
  T_ASC_Parameters* m_parameters = nullptr;
  T_ASC_Association* m_association = nullptr;
  bool m_opened = false;
  bool m_released = false;
};

} // namespace petrous::network
