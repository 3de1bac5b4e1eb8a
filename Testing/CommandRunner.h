#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <map>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "MadeOnce.h"

namespace petrous::testing
{

struct Outcome
{
  int code = -1;
  std::string out;
  std::string err;
};

inline std::string textOf(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline std::string quoted(const std::filesystem::path& path)
{
  return "'" + path.string() + "'";
}

/// Runs the petrous program as a user would, with its own library and scratch folder.
class CommandLine : public ::testing::Test
{
protected:
  void SetUp() override
  {
    m_folder =
        std::filesystem::temp_directory_path() / ("petrous-command-" + std::to_string(::getpid()) +
                                                  "-" + std::to_string(std::random_device{}()));
    std::filesystem::create_directories(m_folder);
  }
  void TearDown() override
  {
    std::error_code ignored;
    std::filesystem::remove_all(m_folder, ignored);
  }

  Outcome run(const std::string& arguments) const
  {
    const auto out = m_folder / ".stdout";
    const auto err = m_folder / ".stderr";
    const char* preload = std::getenv("PETROUS_TEST_PRELOAD"); // for the program, not for the test
    const std::string command =
        "PETROUS_LIBRARY=" + quoted(library()) + " XDG_STATE_HOME=" + quoted(m_folder / "state") +
        (preload ? " LD_PRELOAD=" + quoted(preload) : "") + " " + quoted(PETROUS_PROGRAM) + " " +
        arguments + " >" + quoted(out) + " 2>" + quoted(err) + " </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, textOf(out), textOf(err)};
  }

  /// Runs with --json; the run must succeed.
  nlohmann::json json(const std::string& arguments) const
  {
    const Outcome outcome = run(arguments + " --json");
    EXPECT_EQ(outcome.code, 0) << arguments << ": " << outcome.err;
    return nlohmann::json::parse(outcome.out, nullptr, false);
  }

  /// Expects this exit code and one line on stderr containing `words`.
  void expectRefused(const std::string& arguments, int code, const std::string& words) const
  {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, code) << arguments << ": " << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1)
        << arguments << ": " << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    EXPECT_TRUE(outcome.out.empty()) << outcome.out;
  }

  /// The sample patient of these options in `out`, made by the program once for all tests.
  void makeSample(const std::filesystem::path& out, const std::string& options) const
  {
    copyMadeOnce("command " + options, out,
                 [&](const std::filesystem::path& made)
                 {
                   const Outcome outcome = run("sample " + quoted(made) + " " + options);
                   ASSERT_EQ(outcome.code, 0) << outcome.err;
                 });
  }

  /// A small one in patient/.
  void makePatient(const std::string& options = "--dims 64,64,60 --spacing 1.0") const
  {
    makeSample(m_folder / "patient", options);
  }

  /// A straight path from `from` to `to` (LPS mm), drilling all the way, one second.
  std::filesystem::path writePath(const std::array<double, 3>& from,
                                  const std::array<double, 3>& to) const
  {
    // The shaft, +z of the tool, points backwards along the path: w = 1 + z . a, v = z x a.
    std::array<double, 3> back{from[0] - to[0], from[1] - to[1], from[2] - to[2]};
    const double length = std::hypot(back[0], back[1], back[2]);
    std::array<double, 4> q{1.0 + back[2] / length, -back[1] / length, back[0] / length, 0.0};
    if (q[0] < 1e-6)
      q = {0.0, 1.0, 0.0, 0.0};
    const auto path = m_folder / "path.csv";
    std::ofstream file(path);
    const auto row = [&](double time, const std::array<double, 3>& at, int drill)
    {
      file << time << ',' << at[0] << ',' << at[1] << ',' << at[2];
      for (const double part : q)
        file << ',' << part;
      file << ',' << drill << '\n';
    };
    file << "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill\n";
    row(0.0, from, 1);
    row(1.0, to, 0);
    return path;
  }

  /// Expects plots of `petrous bench`, which are drawn only where matplotlib is installed.
  static void expectPlots(const std::filesystem::path& folder,
                          std::initializer_list<const char*> names)
  {
    if (std::system("/usr/bin/python3 -c 'import matplotlib' 2>/dev/null") != 0)
      return;
    for (const char* name : names)
      EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  }

  /// Of the program that `run` started.
  std::string logText() const { return textOf(m_folder / "state/petrous/petrous.log"); }

  std::filesystem::path library() const { return m_folder / "library"; }

  /// All files of the library with their content, except lock, index and derived data (derived/).
  std::map<std::string, std::string> libraryContent() const
  {
    std::map<std::string, std::string> files;
    if (!std::filesystem::exists(library()))
      return files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(library()))
    {
      const std::string name = entry.path().filename().string();
      if (entry.is_regular_file() && name != ".lock" && name.rfind("library.sqlite", 0) != 0 &&
          entry.path().parent_path() != library() / "derived")
        files[entry.path().string()] = textOf(entry.path());
    }
    return files;
  }

  std::filesystem::path m_folder;
};

} // namespace petrous::testing
