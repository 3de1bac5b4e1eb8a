#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace petrous::library
{

/// A case that a newer version of the program wrote: it is not damaged, and left alone.
struct NewerCase
{
  std::string name;
  bool isDeleted = false; ///< and can be brought back
  std::string text;       ///< by which format, and which one this program reads
};

/// Those of the library in that folder, by names, then deleted ones. Library::verify does not count
/// them as damaged.
std::vector<NewerCase> casesOfNewerVersion(const std::filesystem::path& library);

/// Whether a case that is listed as damaged (CaseSummary) is one of them.
bool isOfNewerVersion(const std::filesystem::path& library, const std::string& name);

} // namespace petrous::library
