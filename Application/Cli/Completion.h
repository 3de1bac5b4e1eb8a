#pragma once

#include <string>
#include <vector>

#include "Program.h"

namespace petrous::cli
{

/// What may stand in place of the last of `words` (the arguments so far, the last one perhaps empty
/// or begun), for the shells: Packaging/completion. A line for each candidate, with a tab before
/// what it means, if that is known. A line that begins with a tab is a request instead: "\tfiles"
/// or "\tfiles\t.csv" for names of files, "\tfolders" for those of folders. The shell keeps those
/// that begin as the word does.
///
/// Reads names of cases and DICOM nodes of the user's library, and writes nothing, neither a
/// library nor the log. Never complains: returns 0, without lines if there is nothing to propose.
int printCompletions(const Program& program, const std::vector<std::string>& words);

} // namespace petrous::cli
