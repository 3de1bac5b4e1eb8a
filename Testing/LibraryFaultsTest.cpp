#include <cerrno>
#include <chrono>
#include <csignal>
#include <ctime>
#include <functional>
#include <iostream>
#include <set>
#include <sstream>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>

#include "CommandRunner.h"
#include "TestServers.h"

using namespace petrous::testing;
namespace fs = std::filesystem;
namespace servers = petrous::network::test;

namespace
{

using Manifests = std::map<std::string, nlohmann::json>; ///< by case

// What a run may be given.
struct Fault
{
  double killAfter = -1.0;  ///< seconds; < 0: not by time
  std::string preloaded;    ///< PETROUS_KILL_AT=.. or PETROUS_FAIL=.. (SystemCallFaults.cpp)
  std::string countTo = {}; ///< PETROUS_CALLS
  rlim_t largestFile = RLIM_INFINITY;
};

struct Ended
{
  int code = -1; ///< of a program that ended by itself
  bool isKilled = false;
  int signal = 0;
  double seconds = 0.0;
  std::string out, err;
};

/// One thing that a user does to a library.
struct Operation
{
  std::string name;
  std::vector<std::string> words; ///< of the command; %: the world's folder
  std::string archive = {};       ///< file of the world that it writes
};

class LibraryFaults : public CommandLine
{
protected:
  // A world is a folder with a library and what the operations read; each run has its own copy.
  void SetUp() override
  {
    CommandLine::SetUp();
    makePatient("--dims 40,40,40 --spacing 1.5");
    fs::create_directories(base() / "tmp");
    const auto at = [this](const std::string& arguments)
    { return json(arguments + " --library " + quoted(base() / "library")); };
    at("new draft --ct " + quoted(m_folder / "patient/ct") +
       " --mr T2=" + quoted(m_folder / "patient/mr"));
    fs::copy(m_folder / "patient", base() / "patient", fs::copy_options::recursive);
    at("archive draft " + quoted(base() / "old.petrous"));
    // As an archive brings it: without the structures that have no voxel.
    at("add draft --labels " + quoted(m_folder / "patient/labels.seg.nrrd"));
    at("archive draft " + quoted(base() / "draft.petrous"));
    at("restore " + quoted(base() / "draft.petrous") + " --as ear");
    at("library delete draft");
    at("library gc");
    const auto box = at("info ear")["ct"];
    std::array<double, 3> centre{};
    for (std::size_t a = 0; a < 3; ++a)
      centre[a] = box["origin_mm"][a].get<double>() +
                  0.5 * box["dims"][a].get<double>() * box["spacing_mm"][a].get<double>();
    std::array<double, 3> outside = centre;
    outside[0] += 25.0;
    fs::copy(writePath(outside, centre), base() / "path.csv");
    at("drill ear --path " + quoted(base() / "path.csv") + " --diameter 6");
    at("archive ear " + quoted(base() / "ear.petrous"));
    std::ofstream(base() / "table.csv")
        << "name,folder,roi,archive\n"
           "batched,patient/ct,\"-75,-25,-35,35,-35,35\",batched.petrous\n"
           "ear,,,batched-ear.petrous\n";
    // A deleted case with an image of its own.
    at("new gone --roi -70,-30,-30,30,-30,30 --ct " + quoted(m_folder / "patient/ct"));
    at("library delete gone");
    // A session that was killed while it drilled.
    at("library copy ear drilled");
    leaveJournal();
  }

  fs::path base() const { return m_folder / "base"; }
  fs::path world() const { return m_folder / "world"; }

  void freshWorld() const
  {
    fs::remove_all(world());
    fs::copy(base(), world(), fs::copy_options::recursive);
  }

  std::string spelled(std::string word, const fs::path& place) const
  {
    for (std::size_t at = 0; (at = word.find('%', at)) != word.npos; at += place.string().size())
      word.replace(at, 1, place.string());
    return word;
  }

  Ended runIn(const fs::path& place, const std::vector<std::string>& words,
              const Fault& fault = {}) const
  {
    std::vector<std::string> arguments{PETROUS_PROGRAM};
    for (const std::string& word : words)
      arguments.push_back(spelled(word, place));
    std::vector<char*> pointers;
    for (std::string& argument : arguments)
      pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    const fs::path out = m_folder / "out", err = m_folder / "err";
    const auto start = std::chrono::steady_clock::now();
    int pipes[2];
    EXPECT_EQ(::pipe2(pipes, O_CLOEXEC), 0);
    const pid_t child = ::fork();
    if (child == 0)
    {
      const int in = ::open("/dev/null", O_RDONLY);
      const bool isLimited = fault.largestFile != RLIM_INFINITY; // these would be, too
      const int to = isLimited ? ::open("/dev/null", O_WRONLY)
                               : ::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      const int errors =
          isLimited ? pipes[1] : ::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      ::dup2(in, 0);
      ::dup2(to, 1);
      ::dup2(errors, 2);
      ::setenv("PETROUS_LIBRARY", (place / "library").c_str(), 1);
      ::setenv("XDG_STATE_HOME", (m_folder / "state").c_str(), 1);
      ::setenv("TMPDIR", (place / "tmp").c_str(), 1);
      if (!fault.preloaded.empty() || !fault.countTo.empty())
      {
        ::setenv("LD_PRELOAD", PETROUS_SYSTEM_CALLS, 1);
        if (const std::size_t at = fault.preloaded.find('='); at != std::string::npos)
          ::setenv(fault.preloaded.substr(0, at).c_str(), fault.preloaded.c_str() + at + 1, 1);
        if (!fault.countTo.empty())
          ::setenv("PETROUS_CALLS", fault.countTo.c_str(), 1);
      }
      if (fault.largestFile != RLIM_INFINITY)
      {
        std::signal(SIGXFSZ, SIG_DFL); // as a shell starts it
        const rlimit limit{fault.largestFile, fault.largestFile};
        ::setrlimit(RLIMIT_FSIZE, &limit);
      }
      ::execv(PETROUS_PROGRAM, pointers.data());
      ::_exit(127);
    }
    if (fault.killAfter >= 0.0)
    {
      const auto nanoseconds = static_cast<long>(1e9 * fault.killAfter);
      const timespec pause{nanoseconds / 1000000000, nanoseconds % 1000000000};
      ::nanosleep(&pause, nullptr);
      ::kill(child, SIGKILL);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    Ended ended;
    ended.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ended.isKilled = WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
    ended.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    ended.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    ended.out = textOf(out);
    ended.err = textOf(err);
    ::close(pipes[1]);
    if (fault.largestFile != RLIM_INFINITY)
    {
      char bytes[4096]; // far less than a pipe holds
      const ::ssize_t count = ::read(pipes[0], bytes, sizeof bytes);
      ended.err.assign(bytes, static_cast<std::size_t>(std::max<::ssize_t>(count, 0)));
    }
    ::close(pipes[0]);
    return ended;
  }

  Ended runIn(const fs::path& place, const Operation& operation, const Fault& fault = {}) const
  {
    return runIn(place, operation.words, fault);
  }

  nlohmann::json answerIn(const fs::path& place, std::vector<std::string> words) const
  {
    words.emplace_back("--json");
    const Ended ended = runIn(place, words);
    EXPECT_EQ(ended.code, 0) << words[0] << ": " << ended.err;
    return nlohmann::json::parse(ended.out, nullptr, false);
  }

  /// The cases of a library as their files say: what they hold, with the hashes of all voxels; not
  /// what differs between two runs.
  static Manifests manifestsOf(const fs::path& library)
  {
    Manifests manifests;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(library / "cases", error))
      if (entry.path().extension() == ".json")
      {
        auto manifest = nlohmann::json::parse(textOf(entry.path()), nullptr, false);
        for (const char* own : {"id", "revision", "sha256"})
          manifest.erase(own);
        withoutTimes(manifest);
        manifest["name"] = entry.path().stem().string(); // which counts
        manifests[entry.path().stem().string()] = std::move(manifest);
      }
    return manifests;
  }

  /// Whether everything is whole, and every case opens; recovers what was drilled.
  void expectWhole(const fs::path& place, const std::string& when) const
  {
    const Ended verified = runIn(place, {"library", "verify", "--json"});
    EXPECT_EQ(verified.code, 0) << when << ": " << verified.out << verified.err;
    for (const auto& [name, manifest] : manifestsOf(place / "library"))
      EXPECT_EQ(runIn(place, {"info", name}).code, 0) << when << ": " << name;
    EXPECT_EQ(runIn(place, {"library", "verify", "--json"}).code, 0) << when;
  }

  static std::vector<Operation> operations()
  {
    return {{"save", {"add", "ear", "--mesh", "incus2=%/patient/meshes/incus.obj"}},
            {"drill", {"drill", "ear", "--path", "%/path.csv", "--diameter", "4"}},
            {"import",
             {"new", "new", "--ct", "%/patient/ct", "--mr", "T2=%/patient/mr", "--labels",
              "%/patient/labels.seg.nrrd", "--roi", "-75,-25,-35,35,-35,35"}},
            {"archive", {"archive", "ear", "%/old.petrous"}, "old.petrous"},
            {"restore", {"restore", "%/ear.petrous", "--as", "restored"}},
            {"copy", {"library", "copy", "ear", "twin"}},
            {"rename", {"library", "rename", "ear", "left"}},
            {"delete", {"library", "delete", "ear"}},
            {"undelete", {"library", "undelete", "gone"}},
            {"gc", {"library", "gc"}},
            {"repair", {"library", "repair"}},
            {"batch", {"batch", "%/table.csv"}}};
  }

  /// Orthanc, which has the case 'ear', as node 'pacs' of the library; null without it.
  std::unique_ptr<servers::Orthanc> startNode() const
  {
    if (!servers::Orthanc::installed())
    {
      std::cout << "send and receive are left out: Orthanc (package orthanc) is not installed\n";
      return nullptr;
    }
    auto pacs = std::make_unique<servers::Orthanc>(m_folder, servers::Orthanc::Options{});
    EXPECT_EQ(runIn(base(), {"nodes", "add", "pacs", "--host", "127.0.0.1", "--aet", "ORTHANC",
                             "--port", std::to_string(pacs->node().port)})
                  .code,
              0);
    EXPECT_EQ(runIn(base(), {"send", "ear", "--to", "pacs"}).code, 0);
    return pacs;
  }

  static std::vector<Operation> transfers()
  {
    return {{"send", {"send", "ear", "--to", "pacs"}},
            {"receive", {"receive", "--from", "pacs", "--case", "ear", "--as", "received"}}};
  }

  /// Another state of a case, which the node does not have yet.
  void changeIn(const fs::path& place, int state) const
  {
    EXPECT_EQ(runIn(place, {"appearance", "ear", "--iso", std::to_string(300 + state)}).code, 0);
  }

  /// What the node has of the case, as a case of its own, which is removed again.
  nlohmann::json receivedIn(const fs::path& place, const std::string& when) const
  {
    const Ended got =
        runIn(place, {"receive", "--from", "pacs", "--case", "ear", "--as", "looked at"});
    EXPECT_EQ(got.code, 0) << when << ": a state is whole there: " << got.err;
    auto all = manifestsOf(place / "library");
    if (got.code != 0 || all.count("looked at") == 0)
      return {};
    auto manifest = all.at("looked at");
    manifest["name"] = "ear";
    runIn(place, {"library", "delete", "looked at"});
    EXPECT_EQ(runIn(place, {"library", "gc"}).code, 0) << when;
    return manifest;
  }

  /// The batch goes on to its end, and its archives are whole.
  void expectBatchGoesOn(const fs::path& place, const Operation& batch, const Manifests& next,
                         const std::string& when) const
  {
    const Ended again = runIn(place, batch);
    EXPECT_EQ(again.code, 0) << when << ", again: " << again.err;
    EXPECT_EQ(manifestsOf(place / "library"), next) << when << ", again";
    for (const char* name : {"batched", "batched-ear"})
      EXPECT_EQ(runIn(place, {"restore", "%/" + (name + std::string(".petrous")), "--as", "back",
                              "--library", "%/restored-" + std::string(name)})
                    .code,
                0)
          << when << ": " << name;
  }

private:
  static void withoutTimes(nlohmann::json& node)
  {
    if (node.is_object())
      for (const char* key : {"started", "started_at", "ended", "when", "time", "created"})
        node.erase(key);
    if (node.is_structured())
      for (nlohmann::json& child : node)
        withoutTimes(child);
  }

  // Kills a drill of case 'drilled' once its journal holds a stroke.
  void leaveJournal() const
  {
    const fs::path journal = base() / "library/cases/drilled.journal";
    const fs::path session = base() / "session.csv";
    std::istringstream rows(textOf(base() / "path.csv"));
    std::string header, from, to;
    std::getline(rows, header);
    std::getline(rows, from);
    std::getline(rows, to);
    {
      std::ofstream file(session);
      file << header << '\n';
      for (int n = 0; n < 60; ++n) // there and back
        file << 2 * n << from.substr(from.find(',')) << '\n'
             << 2 * n + 1 << to.substr(to.find(',')) << '\n';
    }
    const pid_t child = ::fork();
    if (child == 0)
    {
      const int nowhere = ::open("/dev/null", O_RDWR);
      for (const int stream : {0, 1, 2})
        ::dup2(nowhere, stream);
      ::setenv("PETROUS_LIBRARY", (base() / "library").c_str(), 1);
      ::setenv("XDG_STATE_HOME", (m_folder / "state").c_str(), 1);
      ::execl(PETROUS_PROGRAM, PETROUS_PROGRAM, "drill", "drilled", "--path", session.c_str(),
              "--diameter", "3", nullptr);
      ::_exit(127);
    }
    int status = 0;
    const bool isThere = servers::waitFor(
        [&]
        {
          std::error_code error;
          return ::waitpid(child, &status, WNOHANG) == child ||
                 (fs::file_size(journal, error) > 3000 && !error);
        });
    ::kill(child, SIGKILL);
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(isThere);
    ASSERT_TRUE(fs::exists(journal)) << "the drill ended before it was killed";
  }
};

/// Empty if there are none.
std::string differences(const nlohmann::json& a, const nlohmann::json& b)
{
  return a == b ? "" : nlohmann::json::diff(a, b).dump();
}

std::size_t numberFrom(const char* variable, std::size_t otherwise)
{
  const char* text = std::getenv(variable);
  const std::size_t number = text ? std::strtoull(text, nullptr, 10) : 0;
  return number > 0 ? number : otherwise;
}

/// What was seen of an operation.
struct Row
{
  std::string operation;
  std::size_t kills = 0, atCalls = 0, ended = 0, old = 0, isNew = 0, between = 0;
  int calls = 0;
  double seconds = 0.0;
};

void printTable(const std::vector<Row>& rows)
{
  std::ostringstream table;
  table.imbue(std::locale::classic());
  table
      << "| operation | runs | killed | of these at a call | ended before | old | new | recovered "
         "| calls | s |\n|---|---|---|---|---|---|---|---|---|---|\n";
  Row sum;
  sum.operation = "all";
  const auto print = [&table](const Row& row)
  {
    table << "| " << row.operation << " | " << row.kills + row.ended << " | " << row.kills << " | "
          << row.atCalls << " | " << row.ended << " | " << row.old << " | " << row.isNew << " | "
          << row.between << " | " << row.calls << " | " << row.seconds << " |\n";
  };
  table.precision(2);
  for (const Row& row : rows)
  {
    print(row);
    sum.kills += row.kills;
    sum.atCalls += row.atCalls;
    sum.ended += row.ended;
    sum.old += row.old;
    sum.isNew += row.isNew;
    sum.between += row.between;
    sum.calls += row.calls;
    sum.seconds += row.seconds;
  }
  print(sum);
  std::cout << table.str();
  if (const char* file = std::getenv("PETROUS_KILL_TABLE"))
    std::ofstream(file) << table.str();
}

} // namespace

// The library after a kill -9 at a random moment: half of the moments are drawn from the run's
// time, half from the system calls that change files, where there is most to lose. PETROUS_KILLS
// says how many in all (25), PETROUS_KILLED of which operation alone; PETROUS_KILL_TABLE: a file
// for the table.
TEST_F(LibraryFaults, AKillAtAnyMomentLeavesTheOldOrTheNew)
{
  std::mt19937 random(static_cast<unsigned>(numberFrom("PETROUS_KILL_SEED", 1)));
  const auto draw = [&random](double below)
  { return std::uniform_real_distribution<double>(0.0, below)(random); };
  std::vector<Operation> all = operations();
  const std::unique_ptr<servers::Orthanc> pacs = startNode();
  if (pacs)
    for (const Operation& transfer : transfers())
      all.push_back(transfer);
  if (const char* only = std::getenv("PETROUS_KILLED"))
    all.erase(std::remove_if(all.begin(), all.end(),
                             [only](const Operation& one) { return one.name != only; }),
              all.end());
  ASSERT_FALSE(all.empty()) << "PETROUS_KILLED: no such operation";
  const std::size_t each = (numberFrom("PETROUS_KILLS", 25) + all.size() - 1) / all.size();
  const bool canPreload = *PETROUS_SYSTEM_CALLS != '\0';

  std::vector<Row> rows;
  int state = 0;                 // of the case that is sent: another one each time
  nlohmann::json before = 300.0; // its threshold, at the node
  for (const Operation& operation : all)
  {
    Row row;
    row.operation = operation.name;
    const bool isSend = operation.name == "send", isDrill = operation.name == "drill";

    // Undisturbed: how long it takes, and what it makes of the library.
    freshWorld();
    expectWhole(world(), "before"); // what was drilled is recovered
    const Manifests old = manifestsOf(world() / "library");
    const std::string oldArchive =
        operation.archive.empty() ? "" : textOf(world() / operation.archive);
    freshWorld();
    const fs::path counted = m_folder / "calls";
    Fault count;
    if (canPreload)
      count.countTo = counted.string();
    Ended whole = runIn(world(), operation, count);
    ASSERT_EQ(whole.code, 0) << operation.name << ": " << whole.err;
    std::istringstream(textOf(counted)) >> row.calls;
    freshWorld();
    whole = runIn(world(), operation);
    row.seconds = whole.seconds;
    expectWhole(world(), operation.name);
    const Manifests next = manifestsOf(world() / "library");
    const std::string newArchive =
        operation.archive.empty() ? "" : textOf(world() / operation.archive);

    for (std::size_t n = 0; n < each; ++n)
    {
      if (n == 0 || !isSend) // the latest state of a case is the one of the highest revision
        freshWorld();
      Fault fault;
      if (n % 2 == 1 && row.calls > 0)
        fault.preloaded =
            "PETROUS_KILL_AT=" + std::to_string(1 + static_cast<int>(draw(row.calls)));
      else
        fault.killAfter = draw(whole.seconds);
      const std::string when =
          operation.name + ", " +
          (fault.preloaded.empty()
               ? std::to_string(fault.killAfter) + " s of " + std::to_string(whole.seconds) + " s"
               : fault.preloaded + " of " + std::to_string(row.calls));
      if (isSend)
        changeIn(world(), ++state);
      const Manifests sent = manifestsOf(world() / "library");
      const Ended ended = runIn(world(), operation, fault);
      ASSERT_TRUE(ended.isKilled || ended.code == 0) << when << ": " << ended.code << ended.err;
      ++(ended.isKilled ? row.kills : row.ended);
      row.atCalls += ended.isKilled && !fault.preloaded.empty() ? 1 : 0;

      // Where the cases do not tell how far it came.
      bool isStillOld = false;
      if (operation.name == "repair")
        isStillOld = fs::exists(world() / "library/cases/drilled.journal");
      if (operation.name == "gc")
      {
        // What is listed as deleted can come back whole.
        const auto deleted = answerIn(world(), {"library", "deleted"});
        isStillOld = deleted.dump().find("\"gone\"") != std::string::npos;
        if (isStillOld)
        {
          EXPECT_EQ(runIn(world(), {"library", "undelete", "gone"}).code, 0) << when;
          EXPECT_EQ(runIn(world(), {"library", "verify"}).code, 0) << when;
          EXPECT_EQ(runIn(world(), {"library", "delete", "gone"}).code, 0) << when;
        }
      }
      expectWhole(world(), when);
      const Manifests after = manifestsOf(world() / "library");
      if (isSend)
      {
        // The node gives the state before or this one.
        const nlohmann::json own = sent.at("ear");
        EXPECT_EQ(differences(own, after.at("ear")), "") << when;
        nlohmann::json there = receivedIn(world(), when);
        if (!there.is_null())
        {
          const bool isLatest = there["iso_hu"] == own["iso_hu"];
          ++(isLatest ? row.isNew : row.old);
          EXPECT_TRUE(isLatest || there["iso_hu"] == before) << when;
          there["iso_hu"] = own["iso_hu"];
          EXPECT_EQ(differences(there, own), "") << when;
        }
        EXPECT_EQ(runIn(world(), operation).code, 0) << when << ", again";
        EXPECT_EQ(differences(receivedIn(world(), when), own), "") << when;
        before = own["iso_hu"];
        continue;
      }
      const std::string archive =
          operation.archive.empty() ? "" : textOf(world() / operation.archive);
      const bool isArchiveOld = archive == oldArchive, isArchiveNew = archive == newArchive;
      if (after == next && isArchiveNew)
        ++(isStillOld ? row.old : row.isNew);
      else if (after == old && isArchiveOld)
        ++row.old;
      else if (isDrill)
      {
        // A stroke of its own, or the part of one that was drilled until then, comes back.
        ++row.between;
        Manifests others = after;
        others.erase("ear");
        Manifests othersBefore = old;
        othersBefore.erase("ear");
        EXPECT_EQ(differences(others, othersBefore), "") << when;
        const auto history = answerIn(world(), {"history", "ear"});
        EXPECT_GE(history["strokes"].size(), 1U) << when;
      }
      else
        ADD_FAILURE() << when << ": neither the old nor the new: " << differences(old, after);

      // Nothing is in the way of the next try.
      if (operation.name == "batch")
        expectBatchGoesOn(world(), operation, next, when);
      else if (after == old && !isDrill)
      {
        EXPECT_EQ(runIn(world(), operation).code, 0) << when << ", again";
        EXPECT_EQ(differences(manifestsOf(world() / "library"), next), "") << when << ", again";
        if (!operation.archive.empty())
        {
          EXPECT_EQ(textOf(world() / operation.archive), newArchive) << when;
          for (const auto& entry : fs::directory_iterator(world()))
          {
            // One that was killed before it made anything leaves an empty folder, which could be
            // another program's beginning.
            std::error_code error;
            EXPECT_TRUE(entry.path().filename().string().rfind(".petrous-", 0) != 0 ||
                        (entry.is_directory() && fs::is_empty(entry.path(), error)))
                << when << ": voxels left behind: " << entry.path();
          }
        }
      }
      EXPECT_EQ(runIn(world(), {"library", "gc"}).code, 0) << when;
      for (const auto& entry : fs::recursive_directory_iterator(world() / "library"))
      {
        EXPECT_NE(entry.path().filename().string().rfind(".petrous-", 0), 0U)
            << when << ": left behind: " << entry.path();
        EXPECT_NE(entry.path().extension().string().rfind(".deleted-", 0), 0U)
            << when << ": not removed for good: " << entry.path();
      }
    }
    rows.push_back(row);
  }
  printTable(rows);
}

// A disk that is full at any write, a permission that is lost at any file, a rename or a sync that
// fails: told in a line, and the library is the old or the new. PETROUS_FAULTS: at how many calls
// of each kind (1; the calls are spread over the run).
TEST_F(LibraryFaults, ACallThatFailsIsToldAndLeavesTheOldOrTheNew)
{
  if (*PETROUS_SYSTEM_CALLS == '\0')
    GTEST_SKIP() << "nothing can be preloaded under a sanitizer";
  const int most = static_cast<int>(numberFrom("PETROUS_FAULTS", 1));
  std::size_t refused = 0, done = 0;
  std::vector<Operation> all = operations();
  const std::unique_ptr<servers::Orthanc> pacs = startNode();
  if (pacs)
    for (const Operation& transfer : transfers())
      all.push_back(transfer);
  int state = 0; // of the case that is sent
  for (const Operation& operation : all)
  {
    const bool isSend = operation.name == "send", isBatch = operation.name == "batch";
    const bool isTransfer = isSend || operation.name == "receive";
    const bool isLong = isTransfer || isBatch; // fewer by default
    freshWorld();
    expectWhole(world(), "before");
    const Manifests old = manifestsOf(world() / "library");
    freshWorld();
    ASSERT_EQ(runIn(world(), operation).code, 0);
    expectWhole(world(), "undisturbed");
    const Manifests next = manifestsOf(world() / "library");
    const std::string oldArchive =
        operation.archive.empty() ? "" : textOf(base() / operation.archive);
    const std::string newArchive =
        operation.archive.empty() ? "" : textOf(world() / operation.archive);
    const auto prepare = [&]
    {
      if (!isSend || state == 0) // the latest state at the node is that of the highest revision
        freshWorld();
      if (isSend)
        changeIn(world(), ++state);
    };
    const auto check = [&](const Fault& fault, const std::string& when)
    {
      prepare();
      const Manifests sent = isSend ? manifestsOf(world() / "library") : Manifests();
      const Ended ended = runIn(world(), operation, fault);
      EXPECT_EQ(ended.signal, 0) << when;
      ++(ended.code == 0 ? done : refused);
      if (ended.code != 0)
      {
        // A row of a batch that fails, and an association that ends, are 3.
        EXPECT_TRUE(ended.code == 4 || (ended.code == 3 && (isBatch || isTransfer)))
            << when << ": " << ended.code << ", " << ended.err;
        EXPECT_GE(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << when;
        EXPECT_EQ(ended.err.find("unexpected"), std::string::npos) << when << ": " << ended.err;
      }
      expectWhole(world(), when);
      const Manifests after = manifestsOf(world() / "library");
      if (isSend)
      {
        // What a killed drill of another case left is taken up by whoever looks first.
        EXPECT_EQ(after.at("ear"), sent.at("ear")) << when;
        const nlohmann::json there = receivedIn(world(), when), own = sent.at("ear");
        if (ended.code == 0)
        {
          EXPECT_EQ(differences(there, own), "") << when << ": it said that it is sent";
        }
        else if (!there.is_null())
        {
          nlohmann::json atThreshold = own;
          atThreshold["iso_hu"] = there["iso_hu"];
          EXPECT_EQ(differences(there, atThreshold), "") << when << ": a state that was sent";
        }
      }
      else if (operation.name != "drill") // what was drilled until then is recovered
      {
        EXPECT_TRUE(after == old || after == next) << when;
        EXPECT_TRUE(ended.code != 0 || after == next) << when << ": it said that it is done";
      }
      if (!operation.archive.empty())
      {
        const std::string archive = textOf(world() / operation.archive);
        EXPECT_TRUE(archive == oldArchive || archive == newArchive) << when;
        EXPECT_TRUE(ended.code != 0 || archive == newArchive) << when;
      }
      for (const auto& entry : fs::recursive_directory_iterator(world()))
      {
        if (fault.preloaded.find("unlink") == std::string::npos)
        {
          EXPECT_NE(entry.path().filename().string().rfind(".petrous-", 0), 0U)
              << when << ": left behind: " << entry.path();
        }
      }
      if (isBatch)
        expectBatchGoesOn(world(), operation, next, when);
    };
    for (const auto& [call, error] :
         {std::pair("write", ENOSPC), std::pair("open", EACCES), std::pair("rename", EACCES),
          std::pair("unlink", EACCES), std::pair("fsync", EIO), std::pair("flock", ENOLCK)})
    {
      const std::string name = std::string("PETROUS_FAIL=") + call + ":";
      Fault count;
      count.preloaded = name + "1000000000:0";
      count.countTo = (m_folder / "calls").string();
      prepare();
      ASSERT_EQ(runIn(world(), operation, count).code, 0);
      int ofAll = 0, calls = 0;
      std::istringstream(textOf(count.countTo)) >> ofAll >> calls;
      const int each = std::min(calls, isLong ? std::max(most / 2, 1) : most);
      for (int n = 0; n < each; ++n)
      {
        Fault fault;
        const int at = 1 + (each > 1 ? n * (calls - 1) / (each - 1) : 0);
        fault.preloaded = name + std::to_string(at) + ":" + std::to_string(error);
        check(fault, operation.name + ", " + fault.preloaded + " of " + std::to_string(calls));
      }
    }
    // Also what no call of ours writes: no file may become larger than this.
    for (const rlim_t bytes : {rlim_t{0}, rlim_t{1000}, rlim_t{20000}, rlim_t{100000}})
    {
      if (isLong && bytes != 1000 && most <= 2)
        continue;
      Fault fault;
      fault.largestFile = bytes;
      check(fault, operation.name + ", files of at most " + std::to_string(bytes) + " bytes");
    }
  }
  std::cout << refused << " runs were refused, " << done << " did it all the same\n";
  EXPECT_GT(refused, 20U);
  EXPECT_GT(done, 20U);
}

namespace
{

class DeidentifyFaults : public LibraryFaults
{
protected:
  void SetUp() override
  {
    CommandLine::SetUp();
    makePatient("--dims 40,40,40 --spacing 1.5");
    fs::create_directories(base() / "tmp");
    fs::copy(m_folder / "patient/ct", base() / "in");
    std::ofstream(base() / "passphrase") << "nine lives of a cat\n";
    ASSERT_EQ(runIn(base(), words("in", "reference")).code, 0);
    ASSERT_EQ(runIn(base(), words("in/" + one(), "reference.dcm")).code, 0);
  }

  std::string one() const
  {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(base() / "in"))
      names.insert(entry.path().filename().string());
    return *names.begin();
  }

  static std::vector<std::string> words(const std::string& in, const std::string& out)
  {
    return {"deidentify", "%/" + in,           "%/" + out,    "--map",
            "%/map",      "--passphrase-file", "%/passphrase"};
  }

  /// Files by their path in the folder, without temporaries.
  static std::map<std::string, std::string> filesIn(const fs::path& folder)
  {
    std::map<std::string, std::string> files;
    std::error_code error;
    for (const auto& entry : fs::recursive_directory_iterator(folder, error))
    {
      const std::string path = fs::relative(entry.path(), folder).string();
      if (entry.is_regular_file() && path.find(".petrous-") == path.npos)
        files[path] = textOf(entry.path());
    }
    return files;
  }

  /// Those of maps are removed where a map is opened.
  static std::size_t temporariesIn(const fs::path& folder, bool withMaps = true)
  {
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      files += entry.is_regular_file() && entry.file_size() > 0 &&
               entry.path().string().find(".petrous-") != std::string::npos &&
               (withMaps || textOf(entry.path()).rfind("PETROUS-PSEUDONYMS", 0) != 0);
    return files;
  }
};

} // namespace

// A kill -9 leaves whole files or none where the output is to be; the map opens, has an entry for
// each of them, and gives the same pseudonyms; and the next run removes what is left beside.
TEST_F(DeidentifyFaults, AKillAtAnyMomentLeavesWholeFilesAndTheMap)
{
  std::mt19937 random(static_cast<unsigned>(numberFrom("PETROUS_KILL_SEED", 1)));
  const auto draw = [&random](double above, double below)
  { return std::uniform_real_distribution<double>(above, below)(random); };
  const bool canPreload = *PETROUS_SYSTEM_CALLS != '\0';
  const auto reference = filesIn(base() / "reference");
  ASSERT_EQ(reference.size(), 40U);
  const std::size_t kills = numberFrom("PETROUS_KILLS", 40);
  std::map<bool, double> seconds; // of a run: of the folder, of a file
  std::map<bool, int> calls;
  std::size_t killed = 0, whole = 0, left = 0;
  for (std::size_t n = 0; n < kills; ++n)
  {
    const bool isFile = n % 4 == 3, isThere = n % 4 == 1;
    const auto run = words(isFile ? "in/" + one() : "in", isFile ? "out.dcm" : "out");
    if (seconds[isFile] == 0.0)
    {
      freshWorld();
      Fault count;
      if (canPreload)
        count.countTo = (m_folder / "calls").string();
      const Ended ended = runIn(world(), run, count);
      ASSERT_EQ(ended.code, 0) << ended.err;
      seconds[isFile] = ended.seconds;
      std::istringstream(textOf(m_folder / "calls")) >> calls[isFile];
    }
    freshWorld();
    if (isThere)
      fs::create_directory(world() / "out");
    Fault fault;
    if (n % 2 == 1 && calls[isFile] > 0)
      fault.preloaded =
          "PETROUS_KILL_AT=" + std::to_string(1 + static_cast<int>(draw(0.0, calls[isFile])));
    else // most of the first half goes into the passphrase
      fault.killAfter = draw(0.4, 1.0) * seconds[isFile];
    const std::string when = "run " + std::to_string(n) + " " + fault.preloaded;
    const Ended ended = runIn(world(), run, fault);
    ASSERT_TRUE(ended.isKilled || ended.code == 0) << when << ended.err;
    killed += ended.isKilled;
    left += temporariesIn(world()) > 0;
    const auto there = filesIn(world() / "out");
    for (const auto& [path, bytes] : there)
    {
      EXPECT_TRUE(reference.at(path) == bytes) << when << ": " << path;
    }
    EXPECT_TRUE(isThere || there.empty() || there.size() == reference.size()) << when;
    const std::string file = textOf(world() / "out.dcm");
    EXPECT_TRUE(file.empty() || file == textOf(base() / "reference.dcm")) << when;
    whole += !there.empty() || !file.empty();
    // Opening a map takes a second: it is looked at each fourth time.
    const bool looksAtMap = n % 4 == 2 || !there.empty();
    auto next = words(isFile ? "in/" + one() : "in", isFile ? "out2.dcm" : "out2");
    next.resize(looksAtMap ? next.size() : 3);
    const Ended again = runIn(world(), next);
    ASSERT_EQ(again.code, 0) << when << again.err;
    if (looksAtMap)
    {
      EXPECT_TRUE(isFile ? textOf(world() / "out2.dcm") == textOf(base() / "reference.dcm")
                         : filesIn(world() / "out2") == reference)
          << when << ": the map's key is another";
    }
    if (isThere)
    {
      // Into the same folder again: done, or refused as it holds files; without the temporaries.
      const int code = runIn(world(), {"deidentify", "%/in", "%/out"}).code;
      EXPECT_EQ(code, there.empty() ? 0 : 4) << when;
    }
    EXPECT_EQ(temporariesIn(world(), looksAtMap), 0U) << when;
  }
  std::cout << killed << " of " << kills << " were killed, " << whole << " had output, " << left
            << " left temporaries\n";
  EXPECT_GT(killed, kills / 2);
}

// As of the library's operations: a whole file, or a line that says why not.
TEST_F(DeidentifyFaults, ACallThatFailsIsToldAndLeavesWholeFilesOrNone)
{
  if (*PETROUS_SYSTEM_CALLS == '\0')
    GTEST_SKIP() << "nothing can be preloaded under a sanitizer";
  const int most = static_cast<int>(numberFrom("PETROUS_FAULTS", 3));
  const auto reference = filesIn(base() / "reference");
  const std::string oneReference = textOf(base() / "reference.dcm");
  std::size_t refused = 0;
  for (const bool isFile : {false, true})
  {
    auto run = words(isFile ? "in/" + one() : "in", isFile ? "out.dcm" : "out");
    if (isFile)
      run.emplace_back("--replace");
    const auto check = [&](const Fault& fault, const std::string& when)
    {
      freshWorld();
      std::ofstream(world() / "out.dcm") << "former";
      const Ended ended = runIn(world(), run, fault);
      EXPECT_EQ(ended.signal, 0) << when;
      EXPECT_TRUE(ended.code == 0 || ended.code == 4) << when << ": " << ended.err;
      refused += ended.code != 0;
      const auto there = filesIn(world() / "out");
      const std::string file = textOf(world() / "out.dcm");
      EXPECT_TRUE(there ==
                  (ended.code == 0 && !isFile ? reference : std::map<std::string, std::string>()))
          << when;
      EXPECT_TRUE(file == (ended.code == 0 && isFile ? oneReference : "former")) << when;
    };
    for (const auto& [call, error] :
         {std::pair("write", ENOSPC), std::pair("open", EACCES), std::pair("fsync", EIO)})
    {
      const std::string name = std::string("PETROUS_FAIL=") + call + ":";
      Fault count;
      count.preloaded = name + "1000000000:0";
      count.countTo = (m_folder / "calls").string();
      freshWorld();
      ASSERT_EQ(runIn(world(), run, count).code, 0);
      int all = 0, calls = 0;
      std::istringstream(textOf(count.countTo)) >> all >> calls;
      const int each = std::min(calls, most);
      for (int n = 0; n < each; ++n)
      {
        Fault fault;
        fault.preloaded = name + std::to_string(1 + (each > 1 ? n * (calls - 1) / (each - 1) : 0)) +
                          ":" + std::to_string(error);
        check(fault,
              (isFile ? "file, " : "folder, ") + fault.preloaded + " of " + std::to_string(calls));
      }
    }
    for (const rlim_t bytes : {static_cast<rlim_t>(oneReference.size() - 1), rlim_t{2000}})
    {
      Fault fault;
      fault.largestFile = bytes;
      check(fault, "files of at most " + std::to_string(bytes) + " bytes");
    }
  }
  EXPECT_GT(refused, 4U);
}

TEST_F(LibraryFaults, AFlippedBitOfAnyFileIsFoundAndNamedWithItsCases)
{
  freshWorld();
  expectWhole(world(), "before");
  ASSERT_EQ(runIn(world(), {"library", "gc"}).code, 0); // every object has a case
  std::mt19937 random(7);
  std::size_t flipped = 0;
  for (const char* folder : {"objects", "cases"})
    for (const auto& entry : fs::directory_iterator(world() / "library" / folder))
    {
      if (!entry.is_regular_file() ||
          (folder == std::string("cases") && entry.path().extension() != ".json"))
        continue;
      const std::string sound = textOf(entry.path());
      std::string bytes = sound;
      // Of a manifest a bit of which it becomes another text: its first byte.
      const std::size_t at = folder == std::string("cases") ? 0 : random() % bytes.size();
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
      std::ofstream(entry.path(), std::ios::binary) << bytes;
      const Ended verified = runIn(world(), {"library", "verify", "--json"});
      EXPECT_EQ(verified.code, 3) << entry.path();
      const auto damaged = nlohmann::json::parse(verified.out, nullptr, false)["damaged"];
      ASSERT_EQ(damaged.size(), 1U) << entry.path() << ": " << verified.out;
      const std::string object = damaged[0]["object"];
      EXPECT_NE(object.find(entry.path().filename().string()), std::string::npos) << object;
      ASSERT_GE(damaged[0]["cases"].size(), 1U) << entry.path();
      for (const auto& name : damaged[0]["cases"])
      {
        const auto manifest =
            textOf(world() / "library/cases" / (name.get<std::string>() + ".json"));
        EXPECT_TRUE(folder == std::string("cases") ||
                    manifest.find(object.substr(0, 64)) != std::string::npos)
            << name;
      }
      std::ofstream(entry.path(), std::ios::binary) << sound;
      ++flipped;
    }
  EXPECT_GE(flipped, 6U);
  EXPECT_EQ(runIn(world(), {"library", "verify"}).code, 0);
}

TEST_F(LibraryFaults, ALostOrForeignCatalogueCostsNothing)
{
  freshWorld();
  expectWhole(world(), "before");
  const fs::path index = world() / "library/library.sqlite";
  const auto listed = answerIn(world(), {"library", "list"});
  const Manifests before = manifestsOf(world() / "library");
  const auto spoil = [&index](const std::string& how)
  {
    for (const char* ending : {"-wal", "-shm", "-journal"})
      fs::remove(index.string() + ending);
    const std::string bytes = textOf(index);
    fs::remove(index);
    if (how == "empty")
      std::ofstream(index).flush();
    else if (how == "text")
      std::ofstream(index) << "somebody's text\n";
    else if (how == "half")
      std::ofstream(index, std::ios::binary) << bytes.substr(0, bytes.size() / 2);
    else if (how == "zeros")
      std::ofstream(index, std::ios::binary) << std::string(bytes.size(), '\0');
  };
  for (const char* how : {"deleted", "empty", "text", "half", "zeros"})
  {
    spoil(how);
    EXPECT_EQ(answerIn(world(), {"library", "list"}), listed) << how << ", without repair";
    spoil(how);
    EXPECT_EQ(runIn(world(), {"library", "repair"}).code, 0) << how;
    EXPECT_EQ(answerIn(world(), {"library", "list"}), listed) << how;
    EXPECT_EQ(answerIn(world(), {"library", "search", "T2"})["cases"].size(),
              listed["cases"].size())
        << how;
    EXPECT_EQ(differences(manifestsOf(world() / "library"), before), "") << how;
    EXPECT_EQ(runIn(world(), {"library", "verify"}).code, 0) << how;
  }
}
