#include <algorithm>
#include <iostream>

#include <unistd.h>

#include "Commands.h"
#include "Completion.h"
#include "Program.h"
#include "petrous/Imaging/FileError.h"
#include "petrous/Rendering/RenderingError.h"

namespace
{

using namespace petrous;

// The window is a separate program, so that the command starts without Qt.
int openWorkstation(char** arguments)
{
  const auto program = cli::programBeside("petrous-workstation", "../Workstation");
  if (!program.empty())
    ::execv(program.c_str(), arguments);
  std::cerr << "petrous: "
            << (program.empty() ? "the workstation is not installed beside this program"
                                : "the workstation cannot be started")
            << "; 'petrous --help' lists what the command line can do\n";
  return program.empty() ? 2 : 1;
}

// So are the benchmarks, which include their peers. Returns if they are not installed.
void runBenchmarks(std::vector<std::string> words)
{
  const std::string program =
      cli::programBeside("petrous-bench", "../../Testing/Benchmarks").string();
  std::vector<char*> arguments{const_cast<char*>(program.c_str())};
  for (std::string& word : words)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  if (!program.empty())
    ::execv(program.c_str(), arguments.data());
}

void addCommands(CLI::App& app, cli::Context& context)
{
  cli::addSampleCommand(app, context);
  cli::addScanCommand(app, context);
  cli::addCaseCommands(app, context);
  cli::addDescribeCommand(app, context);
  cli::addAttachCommands(app, context);
  cli::addArchiveCommands(app, context);
  cli::addDeidentifyCommands(app, context);
  cli::addLibraryCommand(app, context);
  cli::addNodeCommands(app, context);
  cli::addBatchCommand(app, context);
  cli::addAppearanceCommand(app, context);
  cli::addViewCommand(app, context);
  cli::addVideoCommand(app, context);
  cli::addRenderCommand(app, context);
  cli::addSliceCommand(app, context);
  cli::addMeasureCommand(app, context);
  cli::addProbeCommand(app, context);
  cli::addDrillCommand(app, context);
  cli::addReviewCommand(app, context);
  cli::addMaterialsCommand(app, context);
  cli::addHistoryCommands(app, context);
  cli::addExportCommand(app, context);
  cli::addRegisterCommand(app, context);
  cli::addReportCommand(app, context);
  context
      .addCommand(app, "bench", "Benchmarks: run time against error (the package petrous-bench)",
                  []
                  {
                    throw cli::UsageError("bench: petrous-bench is not installed beside this "
                                          "program; install the package petrous-bench");
                  })
      ->allow_extras();
  cli::addSegmentCommand(app, context);
  cli::addDeviceTestCommand(app, context);
  cli::addDoctorCommand(app, context);
  cli::addReferenceCommand(app, context);
}

} // namespace

int main(int argc, char** argv)
{
  if (argc < 2)
    return openWorkstation(argv);
  const cli::Program program{"petrous",
                             "Rehearse temporal-bone surgery on the patient's own CT and MR.\n"
                             "Without arguments, opens the workstation.",
                             addCommands};
  if (argv[1] == std::string("complete"))
    return cli::printCompletions(program, {argv + 2, argv + argc});
  const std::vector<std::string> words = cli::wordsOf(argc, argv);
  if (cli::subcommandIn(words) == "bench")
    runBenchmarks(words);
  imaging::logToolkitMessages();
  rendering::logToolkitMessages();
  return cli::run(program, words);
}
