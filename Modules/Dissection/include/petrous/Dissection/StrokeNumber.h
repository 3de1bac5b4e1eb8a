#pragma once

#include <cstddef>

#include "petrous/Dissection/History.h"

namespace petrous::dissection
{

/// The number by which a stroke is called wherever it is shown, read or written: from 1, in order
/// of creation over all branches, so that it stays the same whichever branch is shown. 0 for
/// History::kStart.
constexpr std::size_t strokeNumber(std::size_t stroke) noexcept
{
  return stroke == History::kStart ? 0 : stroke + 1;
}

} // namespace petrous::dissection
