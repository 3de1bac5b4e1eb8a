#pragma once

#include <filesystem>
#include <string>

#include "petrous/Core/Progress.h"
#include "petrous/Library/Deidentification.h"

namespace petrous::presenters
{

struct DeidentifyRequest
{
  std::filesystem::path input;  ///< a DICOM file or a folder; never changed
  std::filesystem::path output; ///< a file, or a new or empty folder
  std::filesystem::path map;    ///< pseudonyms, encrypted; empty: a key that is used once
  library::DeidentificationOptions options;
  bool replace = false;               ///< an output file that is there; otherwise that is refused
  std::filesystem::path library = {}; ///< that is open: library::refuseOverwriting; empty: none
};

/// Throws Error (Refused) for a file that would lie in `input`: a report, or the map.
void refuseWithin(const std::filesystem::path& file, const std::filesystem::path& input,
                  const std::string& what);

/// De-identifies with the key of the map, which is written before (a key that is lost would leave
/// files that nobody can assign) and completed before the output is in place. `passphrase` is that
/// of the map. Throws like library::deidentify and library::PseudonymMap.
library::DeidentificationResult deidentifyFolder(const DeidentifyRequest& request,
                                                 const std::string& passphrase,
                                                 const core::Progress& progress = {});

/// Overwrites a secret, then empties it.
void wipe(std::string& secret) noexcept;

} // namespace petrous::presenters
