#include <regex>
#include <set>

#include "CommandRunner.h"

using petrous::testing::CommandLine;
using petrous::testing::Outcome;
using petrous::testing::quoted;
using petrous::testing::textOf;

namespace
{

namespace fs = std::filesystem;

using Words = std::set<std::string>;

// The first column of what CLI11's own help lists: options, or subcommands.
Words inHelp(const std::string& help, const std::regex& what)
{
  Words found;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);)
    if (std::smatch match; std::regex_search(line, match, what))
      found.insert(match[1]);
  return found;
}

const std::regex kOption("^  (?:-h,)?(--[a-z-]+)");
const std::regex kCommand("^  ([a-z][a-z-]*)   ");

class Reference : public CommandLine
{
protected:
  Words commands() const { return inHelp(run("--help").out, kCommand); }
  Words options(const std::string& command) const
  {
    return inHelp(run(command + " --help").out, kOption);
  }
  static bool has(const char* program)
  {
    return std::system((std::string("command -v ") + program + " >/dev/null 2>&1").c_str()) == 0;
  }
  // Runs a shell's command; the test's own folder is its working directory.
  std::string shell(const std::string& command) const
  {
    const fs::path out = m_folder / ".shell";
    const std::string whole =
        "cd " + quoted(m_folder) + " && PETROUS_LIBRARY=" + quoted(library()) +
        " HOME=" + quoted(m_folder) + " PATH=" + quoted(fs::path(PETROUS_PROGRAM).parent_path()) +
        ":$PATH " + command + " >" + quoted(out) + " 2>&1 </dev/null";
    if (std::system(whole.c_str()) != 0)
      ADD_FAILURE() << command << ": " << textOf(out);
    return textOf(out);
  }
};

class Completion : public Reference
{
protected:
  void SetUp() override
  {
    Reference::SetUp();
    for (const char* name : {"ear left", "ear right", "head", "$(touch owned)", "`touch owned`"})
    {
      fs::create_directories(library() / "cases");
      std::ofstream(library() / "cases" / (std::string(name) + ".json")) << "{}";
    }
    std::ofstream(m_folder / "path.csv") << "t_s\n";
    std::ofstream(m_folder / "a picture.png") << "";
    fs::create_directories(m_folder / "plan");
  }

  // As a shell asks; the first column.
  Words proposed(const std::string& words) const
  {
    Words found;
    std::istringstream lines(run("complete " + words).out);
    for (std::string line; std::getline(lines, line);)
      found.insert(line.front() == '\t' ? line : line.substr(0, line.find('\t')));
    return found;
  }

  // What bash offers for these words, of which the last one is begun.
  Words inBash(const std::string& words) const
  {
    const fs::path script = m_folder / "script.bash";
    std::ofstream(script) << "compopt() { :; }\nsource " PETROUS_SOURCE
                             "/Packaging/completion/petrous.bash\nCOMP_WORDS=(petrous "
                          << words
                          << ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_petrous\n"
                             "((${#COMPREPLY[@]})) && printf '%s\\n' \"${COMPREPLY[@]}\"\ntrue\n";
    Words found;
    std::istringstream lines(shell("bash --norc " + quoted(script)));
    for (std::string line; std::getline(lines, line);)
      found.insert(line);
    return found;
  }
};

} // namespace

TEST_F(Reference, ManPagesHaveEveryOptionOfEveryCommandAndRenderWithoutWarnings)
{
  const fs::path pages = m_folder / "man";
  ASSERT_EQ(run("reference man " + quoted(pages)).code, 0);
  const Words commands = this->commands();
  EXPECT_GT(commands.size(), 30U);
  const auto plain = [](std::string page)
  { return std::regex_replace(page, std::regex(R"(\\-)"), "-"); };
  const std::string whole = plain(textOf(pages / "petrous.1"));
  for (const std::string& command : commands)
  {
    EXPECT_NE(whole.find("\\fB" + command + "\\fR"), std::string::npos) << command;
    const std::string page = plain(textOf(pages / ("petrous-" + command + ".1")));
    if (command == "bench") // a program of its own, which may be absent
      continue;
    for (const std::string& option : options(command))
      EXPECT_NE(page.find("\\fB" + option + "\\fR"), std::string::npos) << command << option;
  }
  if (has("man"))
  {
    EXPECT_EQ(shell("sh -c 'man --warnings -l man/*.1 >rendered'"), "");
  }
  if (has("mandoc")) // pages of the same version are the same: without a date
  {
    EXPECT_EQ(shell("sh -c 'mandoc -T lint -W warning man/*.1 | grep -v \"missing date\"; true'"),
              "");
  }
}

TEST_F(Reference, MarkdownHasEveryCommandAndItsOptions)
{
  ASSERT_EQ(run("reference markdown " + quoted(m_folder)).code, 0);
  const std::string page = textOf(m_folder / "petrous.md");
  for (const std::string& command : commands())
    EXPECT_NE(page.find("\n## petrous " + command + "\n"), std::string::npos) << command;
  for (const std::string& option : options("drill"))
    EXPECT_NE(page.find(option), std::string::npos) << option;
}

TEST_F(Completion, ProposesWhatTheHelpLists)
{
  EXPECT_EQ(proposed("''"), commands());
  EXPECT_EQ(proposed("help ''"), commands());
  for (const char* command : {"drill", "new", "appearance", "nodes"})
    EXPECT_EQ(proposed(std::string(command) + " --"), options(command)) << command;
}

TEST_F(Completion, ProposesWhatAnOptionTakes)
{
  const Words burrs{"cutting",        "cutting-rake-25",    "cutting-rake-6", "diamond",
                    "diamond-coarse", "diamond-extra-fine", "diamond-fine",   "diamond-medium"};
  EXPECT_EQ(proposed("drill --burr ''"), burrs);
  EXPECT_EQ(proposed("view head --burr ''"), burrs);
  EXPECT_EQ(proposed("drill head --burr diamond --mode 6"), (Words{"6dof", "3dof"}));
  EXPECT_EQ(proposed("drill --burr=c"), burrs);
  EXPECT_EQ(proposed("drill head --path ''"), (Words{"\tfiles\t.csv"}));
  EXPECT_EQ(proposed("new x --ct ''"), (Words{"\tfiles"}));
  EXPECT_EQ(proposed("info --library ''"), (Words{"\tfolders"}));
  EXPECT_EQ(proposed("--log-level ''").count("debug"), 1U);
  EXPECT_EQ(proposed("drill --diameter ''"), Words()) << "a number";
  EXPECT_EQ(proposed("segment head x --threshold ''"), (Words{"auto"}));
  EXPECT_EQ(proposed("register head --mr T2 --init ''").count("landmarks"), 1U);
  EXPECT_EQ(proposed("library ''").count("rename"), 1U);
  EXPECT_EQ(proposed("unknown ''"), Words());
}

TEST_F(Completion, ProposesCasesAndNodesAndTouchesNothing)
{
  const Words cases{"ear left", "ear right", "head", "$(touch owned)", "`touch owned`"};
  EXPECT_EQ(proposed("info ''"), cases);
  EXPECT_EQ(proposed("library rename ''"), cases);
  EXPECT_EQ(proposed("new ''"), Words()) << "a name that is not taken";
  EXPECT_EQ(proposed("restore x --ct ''"), cases);
  ASSERT_EQ(run("nodes add pacs --host h --port 104 --aet A").code, 0);
  EXPECT_EQ(proposed("send head --to ''"), (Words{"pacs"}));
  EXPECT_EQ(proposed("nodes test ''"), (Words{"pacs"}));
  const fs::path none = m_folder / "none";
  EXPECT_EQ(proposed("--library " + quoted(none) + " info ''"), Words());
  EXPECT_FALSE(fs::exists(none)) << "a library was made";
  fs::remove_all(m_folder / "state");
  proposed("info ''");
  EXPECT_FALSE(fs::exists(m_folder / "state")) << "a log was written";
}

TEST_F(Completion, BashCompletesAndQuotes)
{
  EXPECT_EQ(inBash("reg"), (Words{"register"}));
  EXPECT_EQ(inBash("drill --di"), (Words{"--diameter"}));
  EXPECT_EQ(inBash("info ear"), (Words{"ear\\ left", "ear\\ right"}));
  EXPECT_EQ(inBash("info 'ear\\ r'"), (Words{"ear\\ right"})) << "as bash hands it over";
  EXPECT_EQ(inBash("info \\\"ear"), (Words{"ear left", "ear right"})) << "in quotes";
  EXPECT_EQ(inBash("info '$'"), Words()) << "not run, and begins with a backslash when typed";
  EXPECT_EQ(inBash("drill head --path p"), (Words{"path.csv", "plan/"}));
  EXPECT_EQ(inBash("attach head a"), (Words{"a\\ picture.png"}));
  EXPECT_EQ(inBash("drill --burr = c"), (Words{"cutting", "cutting-rake-25", "cutting-rake-6"}))
      << "--burr=c, taken apart at =";
  EXPECT_EQ(inBash("new x --mr T2 = pl"), (Words{"plan/"}));
  EXPECT_EQ(inBash("info --library pla"), (Words{"plan/"}));
  inBash("info '$(touch owned)' ''");
  EXPECT_FALSE(fs::exists(m_folder / "owned")) << "what was typed was run";
}

TEST_F(Completion, FishAndZshReadTheirScripts)
{
  const std::string scripts = PETROUS_SOURCE "/Packaging/completion/";
  if (has("zsh"))
  {
    EXPECT_EQ(shell("zsh -n " + scripts + "_petrous"), "");
  }
  if (!has("fish"))
    GTEST_SKIP() << "fish is not installed";
  const auto fish = [&](const std::string& line) {
    return shell("fish -N -c 'source " + scripts + "petrous.fish; complete -C \"" + line + "\"'");
  };
  EXPECT_EQ(fish("petrous regi").rfind("register\t", 0), 0U) << fish("petrous regi");
  EXPECT_EQ(fish("petrous info hea"), "head\n");
  EXPECT_EQ(fish("petrous drill --burr diamond-e"), "diamond-extra-fine\n");
  EXPECT_EQ(fish("petrous drill head --path pa"), "path.csv\n");
}
