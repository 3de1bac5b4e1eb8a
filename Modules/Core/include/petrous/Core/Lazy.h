#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <utility>

namespace petrous::core
{

/// A shared, immutable value that is computed on first access.
///
/// Copies share the value and its maker. Thread-safe. If the maker throws, the exception propagates
/// to the caller and the next call tries again. get() blocks while another thread computes the
/// value; peek() never does.
template <class T>
class Lazy
{
public:
  using Maker = std::function<std::shared_ptr<const T>()>;

  Lazy() = default;
  Lazy(std::shared_ptr<const T> value)
    : m_state(std::make_shared<State>())
  {
    m_state->value = std::move(value);
  }
  explicit Lazy(Maker maker)
    : m_state(std::make_shared<State>())
  {
    m_state->maker = std::move(maker);
  }

  explicit operator bool() const noexcept { return m_state != nullptr; }

  /// The value; nullptr only for a default-constructed Lazy.
  std::shared_ptr<const T> get() const
  {
    if (!m_state)
      return nullptr;
    if (auto resident = m_state->resident())
      return resident;
    const std::lock_guard<std::mutex> lock(m_state->making);
    auto value = m_state->resident();
    if (!value)
    {
      value = m_state->maker();
      const std::lock_guard<std::mutex> publishing(m_state->publishing);
      m_state->value = value;
    }
    return value;
  }

  /// The value if already computed, else nullptr. Never waits for the maker: its lock is held only
  /// while a pointer is copied.
  std::shared_ptr<const T> peek() const { return m_state ? m_state->resident() : nullptr; }

private:
  struct State
  {
    std::shared_ptr<const T> resident() const
    {
      const std::lock_guard<std::mutex> lock(publishing);
      return value;
    }

    std::mutex making; // held while the maker runs
    Maker maker;
    mutable std::mutex publishing; // guards `value`
    std::shared_ptr<const T> value;
  };
  std::shared_ptr<State> m_state;
};

} // namespace petrous::core
