#pragma once

#include <cstddef>

namespace petrous::core
{

/// Writes to an open file, also where the system takes the bytes in parts or is interrupted.
/// Returns 0, or errno of the first failure (ENOSPC where no byte is taken): what was written
/// until then stays.
int writeAll(int descriptor, const void* bytes, std::size_t count) noexcept;

} // namespace petrous::core
