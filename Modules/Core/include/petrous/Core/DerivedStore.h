#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace petrous::core
{

/// Keeps what follows from other data, so that it is not made again. What is asked for may be gone
/// at any time, and is then made anew: nothing here is ever a fault.
///
/// A key says all that the bytes depend on: the content of the data, every parameter, and the
/// version of the method. Thread-safe.
class DerivedStore
{
public:
  using Bytes = std::vector<std::uint8_t>;

  virtual ~DerivedStore() = default;

  /// What was put under this key, whole; else nothing.
  virtual std::optional<Bytes> find(const std::string& key) noexcept = 0;

  virtual void put(const std::string& key, const Bytes& bytes) noexcept = 0;

  virtual std::uintmax_t bytes() const noexcept = 0; ///< that it takes, of all cases together
};

} // namespace petrous::core
