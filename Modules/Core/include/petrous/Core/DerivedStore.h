#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace petrous::core
{

/// Cache of data computed from other data. Entries may disappear at any time and are then
/// recomputed; no operation reports an error.
///
/// A key covers everything that the bytes depend on: the content of the input, every parameter, and
/// the version of the method. Thread-safe.
class DerivedStore
{
public:
  using Bytes = std::vector<std::uint8_t>;

  virtual ~DerivedStore() = default;

  /// The complete entry stored under this key, or nullopt.
  virtual std::optional<Bytes> find(const std::string& key) noexcept = 0;

  virtual void put(const std::string& key, const Bytes& bytes) noexcept = 0;

  virtual std::uintmax_t bytes() const noexcept = 0; ///< total size, over all cases
};

} // namespace petrous::core
