#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>

namespace petrous::core
{

/// Asked to stop from any thread; seen by the work at its next check.
class CancelToken
{
public:
  void cancel() noexcept { m_cancelled.store(true); }
  bool isCancelled() const noexcept { return m_cancelled.load(); }

private:
  std::atomic<bool> m_cancelled{false};
};

/// How far a long task is, and whether it should stop.
///
/// A value that is passed down into the work; `part` gives a sub-task its share of the bar. The
/// listener may be called from any worker thread and must be thread-safe. Without a listener
/// and token every call is a cheap no-op.
class Progress
{
public:
  /// fraction in [0, 1]; the text names the step that is under way.
  using Listener = std::function<void(double fraction, const std::string& text)>;

  Progress() = default;
  explicit Progress(Listener listener, std::shared_ptr<const CancelToken> token = nullptr);

  /// Tells the listener; throws CancelledError where the token was cancelled.
  void report(double fraction, const std::string& text) const;

  /// Throws CancelledError naming `task` where the token was cancelled.
  void check(const std::string& task) const;

  /// The same listener with [0, 1] mapped on [first, last] of this one.
  Progress part(double first, double last) const;

private:
  Listener m_listener;
  std::shared_ptr<const CancelToken> m_token;
  double m_first = 0.0;
  double m_last = 1.0;
};

} // namespace petrous::core
