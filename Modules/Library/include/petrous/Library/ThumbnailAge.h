#pragma once

#include "petrous/Library/Library.h"

namespace petrous::library
{

/// Whether a thumbnail should be drawn: the case has none, or one that is older than its last save.
/// Not for a case that is damaged, that has drilling to be recovered (opening it would do that,
/// unseen), or that is of a format without an id. Looks at three files. Never throws.
bool needsThumbnail(const Library& library, const CaseSummary& summary) noexcept;

} // namespace petrous::library
