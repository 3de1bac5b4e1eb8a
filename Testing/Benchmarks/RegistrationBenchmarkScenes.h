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
  std::filesystem::path pairs; ///< folder with PAIR/{fixed,moving}.nii.gz and PAIR/truth.json
  std::filesystem::path data;  ///< folder with a real CT
  std::filesystem::path rire;  ///< folder of RIRE patients
  std::set<std::string> parts;
  std::filesystem::path work;
};

/// The phantom and, if available, a real CT, pairs of files, and RIRE. Missing data are listed in
/// `notes`. Throws Error for damaged files.
registration::BenchmarkInput registrationScenes(const RegistrationScenes& scenes,
                                                std::map<std::string, std::string>& notes,
                                                const core::Progress& progress);

} // namespace petrous::cli
