#include "AnsweringServer.h"
#include "BenchCommand.h"
#include "Program.h"

using namespace petrous;

// The arguments of `petrous bench`, with or without a leading "bench".
int main(int argc, char** argv)
{
  std::vector<std::string> words = cli::wordsOf(argc, argv);
  if (!words.empty() && words.front() == cli::kAnsweringServer)
    return cli::serveAnswers(words);
  const bool version = words.size() == 1 && words.front() == "--version";
  if (cli::subcommandIn(words) != "bench" && !version)
    words.insert(words.begin(), "bench");
  return cli::run(
      {"petrous-bench", "The benchmarks of Petrous, each beside its peers.", cli::addBenchCommand},
      words);
}
