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
/// goes to the caller and the next call tries again.
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
    const std::lock_guard<std::mutex> lock(m_state->mutex);
    if (!m_state->value)
      m_state->value = m_state->maker();
    return m_state->value;
  }

  /// The value where it is resident already, else null.
  std::shared_ptr<const T> peek() const
  {
    if (!m_state)
      return nullptr;
    const std::lock_guard<std::mutex> lock(m_state->mutex);
    return m_state->value;
  }

private:
  struct State
  {
    std::mutex mutex;
    Maker maker;
    std::shared_ptr<const T> value;
  };
  std::shared_ptr<State> m_state;
};

} // namespace petrous::core
