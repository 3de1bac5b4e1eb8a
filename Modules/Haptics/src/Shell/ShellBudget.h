#pragma once

#include <cstddef>
#include <string>

#include "petrous/Core/Error.h"

namespace petrous::haptics
{

/// Throws InvalidParameter "NAME: ..." if a shell may not have that many points.
inline void checkShellBudget(std::size_t budget, const std::string& name)
{
  if (budget < 200 || budget > 20000)
    throw core::InvalidParameter(name + ": a shell has 200 to 20000 points, not " +
                                 std::to_string(budget));
}

} // namespace petrous::haptics
