#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "RegistrationBenchmark.h"
#include "petrous/Core/Progress.h"

namespace petrous::cli
{

struct RegistrationScenes
{
  bool quick = false;
  std::filesystem::path pairs; ///< a folder of PAIR/{fixed,moving}.nii.gz and PAIR/truth.json
  std::filesystem::path data;  ///< a folder that holds a real CT
  std::filesystem::path rire;  ///< RIRE's patients
  std::set<std::string> parts;
  std::filesystem::path work;
};

/// The phantom and, where they are there, a real CT, pairs of files, and RIRE. What is absent is
/// named in `notes`. Throws UsageError for a part that does not exist, Error for damaged files.
registration::BenchmarkInput registrationScenes(const RegistrationScenes& scenes,
                                                std::map<std::string, std::string>& notes,
                                                const core::Progress& progress);

} // namespace petrous::cli
