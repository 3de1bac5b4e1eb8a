#pragma once

#include <filesystem>
#include <locale>
#include <sstream>

#include "MadeOnce.h"
#include "petrous/Phantom/SamplePatient.h"

namespace petrous::testing
{

/// writeSamplePatient, once for all tests of a build.
inline void writeSharedSample(const std::filesystem::path& out,
                              const phantom::SampleOptions& options)
{
  std::ostringstream key;
  key.imbue(std::locale::classic());
  key << "sample seed " << options.seed << " noise " << options.noise << " tilt " << options.tilt;
  if (options.spacing)
    key << " spacing " << *options.spacing;
  if (options.dims)
    for (const int n : *options.dims)
      key << " dims " << n;
  copyMadeOnce(key.str(), out,
               [&options](const std::filesystem::path& made)
               { phantom::writeSamplePatient(made, options); });
}

} // namespace petrous::testing
