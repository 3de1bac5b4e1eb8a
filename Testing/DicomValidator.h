#pragma once

#include <cstdlib>
#include <vector>

#include "CommandRunner.h"

namespace petrous::testing
{

/// dciodvfy of dicom3tools, which knows the IODs of PS3.3; shares no code with the program.
inline bool hasDicomValidator()
{
  return std::system("command -v dciodvfy >/dev/null") == 0;
}

constexpr const char* kNoDicomValidator =
    "dciodvfy (package dicom3tools) is not there to check what was written";

/// Expects no error in each DICOM file of the folder, or in the file; returns how many there were.
/// `scratch`: a file for the validator's words.
inline std::size_t expectValidDicom(const std::filesystem::path& where,
                                    const std::filesystem::path& scratch)
{
  std::vector<std::filesystem::path> files;
  if (std::filesystem::is_directory(where))
  {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(where))
      if (entry.is_regular_file())
        files.push_back(entry.path());
  }
  else
    files.push_back(where);
  std::size_t count = 0;
  for (const auto& file : files)
  {
    if (textOf(file).substr(0, 132).find("DICM") != 128)
      continue;
    ++count;
    std::system(("dciodvfy " + quoted(file) + " >" + quoted(scratch) + " 2>&1").c_str());
    const std::string report = textOf(scratch);
    EXPECT_NE(report, "") << file;
    EXPECT_EQ(report.find("Error"), std::string::npos) << file << ": " << report;
  }
  return count;
}

} // namespace petrous::testing
