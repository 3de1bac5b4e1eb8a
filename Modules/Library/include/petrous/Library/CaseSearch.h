#pragma once

#include "petrous/Library/Library.h"

namespace petrous::library
{

/// Library::search that can be cancelled: with CaseFilter::inNotes, and where the index is lost,
/// manifests are read. Throws like it, and CancelledError.
std::vector<CaseSummary> searchCases(const Library& library, const CaseFilter& filter,
                                     std::set<std::string>& tags, const core::Progress& progress);

} // namespace petrous::library
