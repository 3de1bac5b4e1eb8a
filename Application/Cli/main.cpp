#include <algorithm>
#include <array>
#include <cctype>
#include <iostream>
#include <new>

#include <unistd.h>

#include "Commands.h"
#include "petrous/Core/Error.h"

namespace
{

using namespace petrous;

enum ExitCode
{
  kDone = 0,
  kOurFault = 1,
  kUsage = 2,
  kBadInput = 3,
  kRefused = 4
};

// Named in the contract of the command line; their issues come later.
constexpr std::array<const char*, 5> kNotBuilt{"archive", "restore", "send", "receive", "nodes"};

int exitCodeOf(core::Fault fault)
{
  switch (fault)
  {
  case core::Fault::BadInput:
    return kBadInput;
  case core::Fault::Refused:
  case core::Fault::Cancelled:
    return kRefused;
  case core::Fault::Internal:
    break;
  }
  return kOurFault;
}

int complain(const std::string& text, int code)
{
  std::cerr << "petrous: " << text << '\n';
  return code;
}

// Nobody leaves an option out by giving it nothing, as a script does whose variable is not set, nor
// means the next option by its value. Also of both sides of NAME=VALUE.
std::string emptyValue(const std::string& value, bool pair)
{
  if (value.empty())
    return "the value is empty; give one, or leave it out";
  if (value.size() > 2 && value.compare(0, 2, "--") == 0 &&
      std::isalpha(static_cast<unsigned char>(value[2])) != 0)
    return "a value is missing before '" + value + "'";
  const bool oneSided = pair && (value.front() == '=' || value.back() == '=');
  return oneSided ? "'" + value + "' is empty on one side of '='" : "";
}

// Of every option and argument of every subcommand.
void refuseEmptyValues(CLI::App& app)
{
  const auto all = [](const auto*) { return true; };
  for (CLI::App* command : app.get_subcommands(all))
  {
    for (CLI::Option* option : command->get_options(all))
      if (option->get_items_expected_max() > 0)
      {
        const bool pair = option->get_type_name().find('=') != std::string::npos;
        // first, before other checks speak of a range
        option->transform(
            CLI::Validator([pair](std::string& value) { return emptyValue(value, pair); }, ""));
      }
    refuseEmptyValues(*command);
  }
}

// "--option=" with nothing behind it would take the next word for its value.
std::string optionWithoutValue(int argc, char** argv)
{
  for (int n = 1; n < argc; ++n)
  {
    const std::string word = argv[n];
    if (word == "--")
      break;
    if (word.size() > 3 && word.compare(0, 2, "--") == 0 && word.find('=') == word.size() - 1)
      return word.substr(0, word.size() - 1);
  }
  return {};
}

// The window is a program of its own: the command starts without Qt.
int openWorkstation(char** arguments)
{
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  const auto folder = self.parent_path();
  for (const auto& candidate :
       {folder / "petrous-workstation", folder / "../Workstation/petrous-workstation"})
    if (std::filesystem::exists(candidate))
    {
      ::execv(candidate.c_str(), arguments);
      return complain(candidate.string() + ": cannot be started", kOurFault);
    }
  return complain("the workstation is not installed beside this program; 'petrous --help' lists "
                  "what the command line can do",
                  kUsage);
}

int runCommand(int argc, char** argv)
{
  CLI::App app("Rehearse an operation on the temporal bone on the patient's own CT and MR.\n"
               "Without arguments the workstation opens.",
               "petrous");
  app.set_version_flag("--version", "petrous " PETROUS_VERSION);
  app.require_subcommand(1);
  cli::Context context;
  cli::addSampleCommand(app, context);
  cli::addScanCommand(app, context);
  cli::addCaseCommands(app, context);
  cli::addLibraryCommand(app, context);
  cli::addAppearanceCommand(app, context);
  cli::addRenderCommand(app, context);
  cli::addSliceCommand(app, context);
  cli::addProbeCommand(app, context);
  cli::addDrillCommand(app, context);
  cli::addHistoryCommands(app, context);
  cli::addBranchCommand(app, context);
  cli::addExportCommand(app, context);
  cli::addRegisterCommand(app, context);
  cli::addBenchCommand(app, context);
  cli::addDoctorCommand(app, context);
  const std::string first = argv[1];
  const auto isFirst = [&first](const CLI::App* command) { return command->get_name() == first; };
  if (first[0] != '-' && app.get_subcommands(isFirst).empty())
    return complain("'" + first + "' is no subcommand; see 'petrous --help'", kUsage);
  if (const std::string option = optionWithoutValue(argc, argv); !option.empty())
    return complain(option + ": the value is empty; give one, or leave it out", kUsage);
  refuseEmptyValues(app);
  try
  {
    app.parse(argc, argv);
    std::cout.flush();
    return std::cout
               ? kDone
               : complain("the answer could not be written to stdout (a full disk?)", kRefused);
  }
  catch (const CLI::Success& asked) // --help, --version
  {
    return app.exit(asked);
  }
  catch (const CLI::ParseError& error)
  {
    return complain(std::string(error.what()) + "; see 'petrous --help'", kUsage);
  }
}

} // namespace

int main(int argc, char** argv)
{
  try
  {
    if (argc < 2)
      return openWorkstation(argv);
    const std::string first = argv[1];
    if (std::find(kNotBuilt.begin(), kNotBuilt.end(), first) != kNotBuilt.end())
      return complain("'" + first + "' is not built yet", kUsage);
    return runCommand(argc, argv);
  }
  catch (const cli::UsageError& error)
  {
    return complain(error.what(), kUsage);
  }
  catch (const core::Error& error)
  {
    return complain(error.what(), exitCodeOf(error.fault()));
  }
  catch (const std::filesystem::filesystem_error& error)
  {
    return complain(error.path1().string() + ": cannot be read or written; check that it is there "
                                             "and its permissions",
                    kRefused);
  }
  catch (const std::bad_alloc&)
  {
    return complain("not enough memory; close other programs, or load less with --roi", kRefused);
  }
  catch (const std::exception&)
  {
    // Texts of other libraries may carry patient data; they stay out.
    return complain("an unexpected fault; the library is as it was before", kOurFault);
  }
}
