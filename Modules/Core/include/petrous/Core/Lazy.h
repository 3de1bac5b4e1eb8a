#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <utility>

namespace petrous::core
{

/// A shared, immutable value that is made when first asked for.
///
/// Copies share the value and its maker. Thread-safe; when the maker throws, the exception
/// goes to the caller and the next call tries again. Whoever asks for the value while it is being
/// made waits for it; whoever peeks never does.
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

  /// The value; null only for a default-constructed Lazy.
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

  /// The value where it is resident already, else null. Never waits for a maker: the lock that it
  /// takes is held for the copy of a pointer only.
  std::shared_ptr<const T> peek() const { return m_state ? m_state->resident() : nullptr; }

private:
  struct State
  {
    std::shared_ptr<const T> resident() const
    {
      const std::lock_guard<std::mutex> lock(publishing);
      return value;
    }

    std::mutex making; // held as long as the maker works
    Maker maker;
    mutable std::mutex publishing; // of `value`
    std::shared_ptr<const T> value;
  };
  std::shared_ptr<State> m_state;
};

} // namespace petrous::core
