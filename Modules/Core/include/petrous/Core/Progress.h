#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>

namespace petrous::core
{

/// Cancellation flag; may be set from any thread, and takes effect at the task's next check.
class CancelToken
{
public:
  void cancel() noexcept { m_cancelled.store(true); }
  bool isCancelled() const noexcept { return m_cancelled.load(); }

private:
  std::atomic<bool> m_cancelled{false};
};

/// Progress reporting and cancellation of a long task.
///
/// Passed by value into the task; `part` maps a sub-task to its part of the progress range. The
/// listener may be called from any worker thread and must be thread-safe. Without a listener and
/// token every call is a cheap no-op.
class Progress
{
public:
  /// fraction in [0, 1]; the text names the current step.
  using Listener = std::function<void(double fraction, const std::string& text)>;

  Progress() = default;
  explicit Progress(Listener listener, std::shared_ptr<const CancelToken> token = nullptr);

  /// Notifies the listener; throws CancelledError if the token was cancelled.
  void report(double fraction, const std::string& text) const;

  /// Throws CancelledError naming `task` if the token was cancelled.
  void check(const std::string& task) const;

  /// The same listener, with [0, 1] mapped to [first, last] of this range.
  Progress part(double first, double last) const;

private:
  Listener m_listener;
  std::shared_ptr<const CancelToken> m_token;
  double m_first = 0.0;
  double m_last = 1.0;
};

} // namespace petrous::core
