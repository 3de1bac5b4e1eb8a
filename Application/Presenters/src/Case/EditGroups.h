#pragma once

namespace petrous::presenters
{

// EditHistory::Edit::group
constexpr const char* kMrEdits = "mr";    ///< places of MRs
constexpr const char* kMrAxes = "mraxes"; ///< axes of an MR, which moves with them

} // namespace petrous::presenters
