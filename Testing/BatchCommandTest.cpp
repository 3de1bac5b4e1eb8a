#include <csignal>
#include <sstream>
#include <thread>
#include <utility>
#include <vector>

#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/socket.h>

#include "CommandRunner.h"

using namespace petrous::testing;

namespace
{

// Tables beside a small sample patient.
class BatchCommand : public CommandLine
{
protected:
  void SetUp() override
  {
    CommandLine::SetUp();
    makePatient("--dims 32,32,30 --spacing 2.0");
  }

  std::filesystem::path write(const std::string& text, const char* name = "table.csv") const
  {
    const auto file = m_folder / name;
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

  std::string batch(const std::string& options = "") const
  {
    return "batch " + quoted(m_folder / "table.csv") + " " + options;
  }

  std::filesystem::path state() const { return m_folder / "table.csv.state"; }

  static nlohmann::json parsed(const Outcome& outcome)
  {
    return nlohmann::json::parse(outcome.out, nullptr, false);
  }

  /// A table of `count` rows that build, describe and archive the patient. `last`: another row.
  void writeMany(std::size_t count, const std::string& last = "") const
  {
    std::string text = "name,folder,mr,labels,tags,archive,send\n";
    for (std::size_t n = 1; n <= count; ++n)
      text += "case " + std::to_string(n) +
              ",patient/ct,T2=patient/mr,patient/labels.seg.nrrd,\"a|b\",out/,\n";
    text += last;
    std::filesystem::create_directories(m_folder / "out");
    write(text);
  }

  /// Runs a table of `count` rows, of which the last waits for ever, and sends `signal` once `rows`
  /// of the others are done. The wait status.
  int stopAfter(std::size_t rows, std::size_t count, int signal) const
  {
    const int silent = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0); // a node without a word
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(::bind(silent, reinterpret_cast<const sockaddr*>(&address), size), 0);
    EXPECT_EQ(::listen(silent, 8), 0);
    ::getsockname(silent, reinterpret_cast<sockaddr*>(&address), &size);
    run("nodes remove silent");
    json("nodes add silent --host 127.0.0.1 --aet SILENT --port " +
         std::to_string(ntohs(address.sin_port)));
    writeMany(count, "case 1,,,,,,silent\n");
    const auto progress = m_folder / "progress";
    std::filesystem::remove(progress);
    const pid_t child = ::fork();
    if (child == 0)
    {
      const int nowhere = ::open("/dev/null", O_RDWR);
      const int lines = ::open(progress.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      ::dup2(nowhere, 0);
      ::dup2(nowhere, 1);
      ::dup2(lines, 2);
      ::setenv("PETROUS_LIBRARY", library().c_str(), 1);
      ::execl(PETROUS_PROGRAM, PETROUS_PROGRAM, "batch", (m_folder / "table.csv").c_str(),
              "--progress", "--report", (m_folder / "report.json").c_str(), nullptr);
      ::_exit(127);
    }
    int status = 0;
    while (::waitpid(child, &status, WNOHANG) != child)
    {
      std::size_t done = 0;
      const std::string text = textOf(progress);
      for (std::size_t at = text.find(kRow); at != text.npos; at = text.find(kRow, at + 1))
        ++done;
      if (done < rows)
      {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        continue;
      }
      ::kill(child, signal);
      ::waitpid(child, &status, 0);
      break;
    }
    ::close(silent);
    writeMany(count);
    return status;
  }

  static constexpr const char* kRow = "\"event\":\"row\"";
};

} // namespace

TEST_F(BatchCommand, DoesEachRowAndGoesOnPastABadOne)
{
  // As a German spreadsheet writes it.
  write("\xef\xbb\xbfName;Folder;MR;Labels;Tags;Note;Side;Date;Register;ROI;Archive;\r\n"
        "\"ear; left\";patient/ct;T2=patient/mr;patient/labels.seg.nrrd;one|two;\"a \"\"note\"\",\n"
        "of two lines\";Left;2031-04-05;ja;;out/;\r\n"
        "lost;no such folder;;;;;;;;;;\r\n"
        "bad box;patient/ct;;;;;;;;1,2,3;;\r\n"
        ";;;;;;;;;;;\r\n"
        "part;patient/ct;;;;;;;nein;-60.5,-30,-20,20,-20,20;part.petrous;\r\n"
        "\"ear; left\";;;;three;;;;;;;\r\n");
  std::filesystem::create_directories(m_folder / "out");
  const Outcome outcome = run(batch("--report " + quoted(m_folder / "report.csv") + " --json"));
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("2 of 5 rows failed"), std::string::npos) << outcome.err;
  const auto answer = parsed(outcome);
  ASSERT_EQ(answer["rows"].size(), 5U) << outcome.out;
  EXPECT_EQ(answer["counts"]["done"], 3);
  EXPECT_EQ(answer["counts"]["failed"], 2);
  EXPECT_EQ(answer["rows"][0]["line"], 2);
  EXPECT_EQ(answer["rows"][1]["line"], 4) << "the first row has two lines";
  EXPECT_NE(answer["rows"][1]["error"].get<std::string>().find("'folder': no such"),
            std::string::npos)
      << answer["rows"][1]["error"];
  EXPECT_NE(answer["rows"][2]["error"].get<std::string>().find("6 numbers"), std::string::npos);
  EXPECT_EQ(answer["rows"][4]["steps"]["describe"]["status"], "done");

  const auto info = json("info 'ear; left'");
  // As the commands do it one by one.
  json("new same --ct " + quoted(m_folder / "patient/ct") +
       " --mr T2=" + quoted(m_folder / "patient/mr") + " --labels " +
       quoted(m_folder / "patient/labels.seg.nrrd"));
  json("register same --mr T2");
  const auto same = json("info same");
  for (const char* part : {"ct", "mr", "labels", "meshes"})
    EXPECT_EQ(info[part], same[part]) << part;
  EXPECT_TRUE(info["mr"][0]["registered"]);
  EXPECT_EQ(info["mr"][0]["name"], "T2");
  const auto described = json("describe 'ear; left'")["description"];
  EXPECT_EQ(described["note"], "a \"note\",\nof two lines");
  EXPECT_EQ(described["tags"], nlohmann::json::array({"one", "two", "three"}));
  EXPECT_EQ(described["side"], "left");
  EXPECT_EQ(described["date"], "2031-04-05");
  EXPECT_LT(json("info part")["ct"]["dims"][0], info["ct"]["dims"][0]);
  EXPECT_EQ(json("library list")["cases"].size(), 3U);

  // The report, as the table: semicolons and a mark; read by an independent reader.
  const std::string report = textOf(m_folder / "report.csv");
  EXPECT_EQ(report.rfind("\xef\xbb\xbfline;name;status;build;", 0), 0U) << report;
  if (std::system("/usr/bin/python3 -c '' 2>/dev/null") == 0)
  {
    std::ofstream(m_folder / "read.py")
        << "import csv, sys\n"
           "rows = list(csv.DictReader(open(sys.argv[1], encoding='utf-8-sig', newline=''),"
           " delimiter=';'))\n"
           "assert [r['line'] for r in rows] == ['2', '4', '5', '7', '8'], rows\n"
           "assert rows[0]['name'] == 'ear; left' and rows[0]['status'] == 'done', rows\n"
           "assert rows[0]['register'].startswith('done'), rows\n"
           "assert rows[1]['status'] == 'failed' and 'no such' in rows[1]['error'], rows\n";
    EXPECT_EQ(std::system(("/usr/bin/python3 " + quoted(m_folder / "read.py") + " " +
                           quoted(m_folder / "report.csv"))
                              .c_str()),
              0)
        << report;
  }
  // What reads as a case that is there is told before anything is read.
  write("name,folder\nSAME,patient/ct\n");
  const Outcome taken = run(batch("--dry-run --json"));
  EXPECT_EQ(taken.code, 3);
  EXPECT_NE(parsed(taken)["rows"][0]["error"].get<std::string>().find("'same' is there already"),
            std::string::npos)
      << taken.out;
  for (const char* archive : {"out/ear; left.petrous", "part.petrous"})
    EXPECT_EQ(
        run("restore " + quoted(m_folder / archive) + " --library " + quoted(m_folder / "other"))
            .code,
        0)
        << archive;
}

// What leaves is looked at as by the commands, and chosen.
TEST_F(BatchCommand, NotesWhatMayIdentifyAndLeavesOutWhatIsAskedFor)
{
  makeSample(m_folder / "wide", "--dims 80,80,20 --spacing 2.0");
  std::ofstream(m_folder / "Doe.pdf") << "%PDF-1.7 of Doe";
  std::ofstream(m_folder / "Doe.mp4") << std::string("\0\0\0\x18", 4) + "ftypmp42 of Doe";
  json("new wide --ct " + quoted(m_folder / "wide/ct"));
  json("describe wide --note 'of ward 7' --tag 'mrn 4711471'");
  json("attach wide " + quoted(m_folder / "Doe.pdf"));
  json("attach wide " + quoted(m_folder / "Doe.mp4"));
  const auto run = [this](const std::string& choices, const std::string& options = "")
  {
    write("name,archive,mask_face,without_notes,with_videos,with_documents\nwide,a.petrous," +
          choices + "\n");
    return json(batch(options))["rows"][0];
  };
  const auto has = [](const nlohmann::json& row, const char* text)
  { return row["notes"].dump().find(text) != std::string::npos; };
  const auto restored = [this]
  {
    static int n = 0;
    const std::string name = "restored" + std::to_string(++n);
    json("restore " + quoted(m_folder / "a.petrous") + " --as " + name);
    return std::pair(json("describe " + name)["description"]["note"].get<std::string>(),
                     json("attachments " + name)["attachments"].size());
  };

  for (const char* options : {"--dry-run", ""})
  {
    const auto row = run("no,,no,", options);
    EXPECT_TRUE(has(row, "whole head")) << row;
    EXPECT_TRUE(has(row, "the note: read it")) << row;
    EXPECT_TRUE(has(row, "tags: 1 of 1")) << row;
  }
  EXPECT_EQ(restored(), std::pair(std::string("of ward 7"), std::size_t{0}));
  EXPECT_EQ(run("no,,no,")["status"], "already done");

  const auto row = run("no,yes,yes,yes");
  EXPECT_EQ(row["status"], "done") << "other choices";
  EXPECT_FALSE(has(row, "the note: read it")) << row;
  EXPECT_EQ(restored(), std::pair(std::string(), std::size_t{2}));
  EXPECT_EQ(run("no,,no,")["status"], "done") << "the file is another one";

  // The built-in patient has no face, but skin that may be of one: nothing leaves unmasked.
  write("name,archive,mask_face\nwide,masked.petrous,yes\n");
  const Outcome masked = CommandLine::run(batch());
  EXPECT_EQ(masked.code, 3);
  EXPECT_NE((masked.out + masked.err).find("where its face is cannot be told"), std::string::npos)
      << masked.out << masked.err;
  EXPECT_FALSE(std::filesystem::exists(m_folder / "masked.petrous"));

  write("name,tags,mask_face\nwide,x,yes\n");
  EXPECT_NE(CommandLine::run(batch()).out.find("'mask_face' goes with"), std::string::npos);
}

TEST_F(BatchCommand, DoesNothingTwice)
{
  writeMany(2);
  EXPECT_EQ(json(batch())["counts"]["done"], 2);
  const auto before = libraryContent();
  const auto written = std::filesystem::last_write_time(m_folder / "out/case 1.petrous");
  EXPECT_EQ(json(batch())["counts"]["already done"], 2);
  EXPECT_EQ(libraryContent(), before);
  EXPECT_EQ(std::filesystem::last_write_time(m_folder / "out/case 1.petrous"), written);

  // Only what changed is done: a case, an archive, a row.
  json("describe 'case 1' --tag mine");
  std::filesystem::remove(m_folder / "out/case 2.petrous");
  auto rows = json(batch())["rows"];
  for (int n : {0, 1})
  {
    EXPECT_EQ(rows[n]["steps"]["build"]["status"], "already done");
    EXPECT_EQ(rows[n]["steps"]["describe"]["status"], "already done") << "the user's own stays";
    EXPECT_EQ(rows[n]["steps"]["archive"]["status"], "done");
  }
  json("library delete 'case 2'");
  rows = json(batch())["rows"];
  EXPECT_EQ(rows[0]["status"], "already done");
  EXPECT_EQ(rows[1]["steps"]["build"]["status"], "done");
  std::string text = textOf(m_folder / "table.csv");
  text.replace(text.find("\"a|b\""), 5, "\"a|c\"");
  write(text);
  rows = json(batch())["rows"];
  EXPECT_EQ(rows[0]["steps"]["build"]["status"], "already done");
  EXPECT_EQ(rows[0]["steps"]["describe"]["status"], "done");
  EXPECT_EQ(json("describe 'case 1'")["description"]["tags"],
            nlohmann::json::array({"a", "b", "mine", "c"}));
}

TEST_F(BatchCommand, NeverTakesAnotherCaseForItsOwn)
{
  writeMany(1);
  json("new 'case 1' --ct " + quoted(m_folder / "patient/ct"));
  const auto before = libraryContent();
  const Outcome outcome = run(batch("--json"));
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.out.find("is in the library already, and not from this row"), std::string::npos)
      << outcome.out;
  EXPECT_EQ(libraryContent(), before);

  // Built, and killed before that was recorded: the content tells.
  json("library delete 'case 1'");
  json(batch());
  std::string text = textOf(state());
  const std::string cut = text.substr(0, text.find("\n", text.find("\"content\"")) + 1);
  std::ofstream(state(), std::ios::binary) << cut << "{\"case_id\":\"half a li";
  EXPECT_EQ(json(batch())["rows"][0]["steps"]["build"]["status"], "already done");
  json("library delete 'case 1'");
  json("new 'case 1' --ct " + quoted(m_folder / "patient/ct"));
  std::ofstream(state(), std::ios::binary) << cut;
  EXPECT_EQ(run(batch()).code, 3) << "another case was put there in the meantime";
}

TEST_F(BatchCommand, GoesOnAfterAKillAtAnyMoment)
{
  constexpr std::size_t kRows = 5;
  for (std::size_t rows = 0; rows <= kRows; ++rows)
  {
    const int status = stopAfter(rows, kRows, SIGKILL);
    ASSERT_TRUE(WIFSIGNALED(status)) << rows;
    EXPECT_EQ(json("library verify")["damaged"].size(), 0U);
  }
  EXPECT_EQ(json(batch("--report " + quoted(m_folder / "report.json")))["counts"]["failed"], 0);
  EXPECT_EQ(json("library list")["cases"].size(), kRows);
  EXPECT_EQ(json("library verify")["damaged"].size(), 0U);
  for (std::size_t n = 1; n <= kRows; ++n)
  {
    const std::string name = "case " + std::to_string(n);
    EXPECT_EQ(json("describe '" + name + "'")["description"]["tags"].size(), 2U);
    json("restore " + quoted(m_folder / "out" / (name + ".petrous")) + " --library " +
         quoted(m_folder / "other"));
  }
}

TEST_F(BatchCommand, AnInterruptLeavesAReportAndGoesOn)
{
  const int status = stopAfter(1, 4, SIGINT);
  ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGINT);
  const auto report = nlohmann::json::parse(textOf(m_folder / "report.json"));
  EXPECT_GE(report["counts"]["done"], 1);
  EXPECT_GE(report["counts"]["interrupted"].get<int>() + report["counts"]["pending"].get<int>(), 1);
  EXPECT_EQ(report["counts"]["failed"], 0);
  const auto rows = json(batch("--report " + quoted(m_folder / "report.json")))["rows"];
  EXPECT_EQ(rows[0]["status"], "already done");
  EXPECT_EQ(json(batch("--report " + quoted(m_folder / "report.json")))["counts"]["already done"],
            4);
}

TEST_F(BatchCommand, ADryRunOnlyLooks)
{
  write("name,folder,mr,register,archive,send\n"
        "a,patient/ct,patient/mr,yes,a.petrous,\n"
        "b,patient/ct,,yes,,\n"
        "a,,,,again.petrous,\n"
        "c,,,,c.petrous,\n"
        "d,patient/ct,,,,nowhere\n"
        "e,patient/truth.json,,,,\n");
  const Outcome outcome = run(batch("--dry-run --json"));
  EXPECT_EQ(outcome.code, 3);
  const auto rows = parsed(outcome)["rows"];
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows[0]["status"], "would be done");
  EXPECT_EQ(rows[0]["steps"]["build"]["text"], "30 slices of 32 x 32");
  EXPECT_EQ(rows[1]["error"], "case 'b' would have no MR to register");
  EXPECT_EQ(rows[2]["status"], "would be done") << "the first row would build it";
  EXPECT_EQ(rows[3]["status"], "failed");
  EXPECT_EQ(rows[4]["status"], "failed") << "no such node";
  EXPECT_TRUE(rows[4]["steps"].empty()) << "told before anything is read";
  EXPECT_EQ(rows[5]["status"], "failed");
  EXPECT_FALSE(std::filesystem::exists(state()));
  EXPECT_FALSE(std::filesystem::exists(m_folder / "a.petrous"));
  EXPECT_TRUE(libraryContent().empty());

  // Names that read the same are told before, too.
  write("name,folder\nBat A,patient/ct\nbat_a,patient/ct\n");
  const auto alike = parsed(run(batch("--dry-run --json")))["rows"];
  EXPECT_EQ(alike[0]["status"], "would be done");
  EXPECT_NE(alike[1]["error"].get<std::string>().find("is built by line 2"), std::string::npos);

  // What needs repair is told before.
  makeSample(m_folder / "tilted", "--dims 32,32,30 --spacing 2.0 --tilt 12");
  write("name,folder,repair\nleft,tilted/ct,\nright,tilted/ct,yes\n");
  const auto tilted = parsed(run(batch("--dry-run --json")))["rows"];
  EXPECT_EQ(tilted[0]["status"], "failed");
  EXPECT_NE(tilted[0]["error"].get<std::string>().find("'repair' yes"), std::string::npos);
  EXPECT_EQ(tilted[1]["status"], "would be done");
}

TEST_F(BatchCommand, RefusesATableThatIsUnclear)
{
  const auto refuses = [this](const std::string& text, const std::string& words)
  {
    write(text);
    expectRefused(batch(), 3, words);
    EXPECT_FALSE(std::filesystem::exists(library() / "cases"));
  };
  refuses("name,folder,colour\na,patient/ct,red\n",
          "line 1: there is no column 'colour'; columns are name, folder, series, ");
  refuses("name,folder,Name\na,patient/ct,b\n", "column 'name' is there twice");
  refuses("folder\npatient/ct\n", "there is no column 'name'");
  refuses("name,folder\na,\"patient/ct\n", "line 2: a quote is opened and not closed");
  refuses("name,folder\na,patient/ct,yes\n", "line 2: has more cells than there are columns");
  refuses("name,folder,\na,patient/ct,yes\n", "column 3 has no name");
  refuses("name,folder\na,patient/ct\nGeh\xf6r,patient/ct\n",
          "line 3: is not UTF-8 text; save the table as 'CSV UTF-8'");
  refuses(std::string("\xff\xfen\0a\0", 6), "is UTF-16");
  refuses("name,folder\n,,\n", "has no row after the header");
  refuses("", "is empty");
  expectRefused("batch " + quoted(m_folder / "none.csv"), 3, "none.csv");
  write("name,folder\na,patient/ct\n");
  EXPECT_EQ(run(batch("--report " + quoted(m_folder / "report.txt"))).code, 2);
  expectRefused(batch("--report " + quoted(m_folder / "table.csv")), 4, "would be replaced");
  for (const std::string text : {"somebody's own file\n", "somebody's own file of one line",
                                 "{\"petrous_batch\":1}\nmore\n"})
  {
    std::ofstream(state()) << text;
    expectRefused(batch(), 3, "is not the state of a batch");
    std::ifstream file(state(), std::ios::binary);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), text);
  }
}

// A file of meshes states neither the correction of its image's axes nor always frame and unit.
TEST_F(BatchCommand, SaysOfMeshesWhatTheirFilesDoNot)
{
  const auto vertices = [](const std::string& obj)
  {
    std::vector<std::array<double, 3>> found;
    std::istringstream lines(obj);
    for (std::string line; std::getline(lines, line);)
      if (line.rfind("v ", 0) == 0)
      {
        std::istringstream numbers(line.substr(2));
        found.emplace_back();
        numbers >> found.back()[0] >> found.back()[1] >> found.back()[2];
      }
    return found;
  };
  const std::string incus = textOf(m_folder / "patient/meshes/incus.obj");
  const auto own = vertices(incus);
  ASSERT_FALSE(own.empty());
  std::string other; // the same in RAS and cm
  std::istringstream lines(incus);
  std::size_t n = 0;
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("v ", 0) == 0)
    {
      other += "v " + std::to_string(-0.1 * own[n][0]) + " " + std::to_string(-0.1 * own[n][1]) +
               " " + std::to_string(0.1 * own[n][2]) + "\n";
      ++n;
    }
    else if (line.rfind("f ", 0) == 0)
      other += line + "\n";
  std::ofstream(m_folder / "ras.obj", std::ios::binary) << other;
  write("name,folder,ct_axes,meshes,mesh_axes,mesh_frame,mesh_unit\n"
        "stays,patient/ct,RPS,patient/meshes/incus.obj,LPS,,\n"
        "open,patient/ct,RPS,patient/meshes/incus.obj,,,\n"
        "follows,patient/ct,RPS,patient/meshes/incus.obj@ct,,,\n"
        "told,patient/ct,,ras.obj,,RAS,cm\n"
        "odd,patient/ct,,patient/meshes/incus.obj,,,ell\n");
  const Outcome outcome = run(batch("--json"));
  EXPECT_EQ(outcome.code, 3);
  const auto rows = parsed(outcome)["rows"];
  ASSERT_EQ(rows.size(), 5U) << outcome.out << outcome.err;
  const std::vector<std::string> expected{"done", "failed", "done", "done", "failed"};
  for (std::size_t row = 0; row < rows.size(); ++row)
    EXPECT_EQ(rows[row]["status"], expected[row]) << rows[row];
  EXPECT_NE(rows[1]["error"].get<std::string>().find("'mesh_axes' LPS"), std::string::npos)
      << rows[1]["error"];
  EXPECT_NE(rows[4]["error"].get<std::string>().find("'mesh_unit' is "), std::string::npos);
  // The CT's centre in x, about which it is mirrored.
  const nlohmann::json ct = json("info told")["ct"];
  const double center = ct["origin_mm"][0].get<double>() + 0.5 *
                                                               (ct["dims"][0].get<double>() - 1.0) *
                                                               ct["spacing_mm"][0].get<double>();
  for (const char* const name : {"stays", "follows", "told"})
  {
    const auto out = m_folder / (name + std::string(".obj"));
    const std::string part = json(std::string("info ") + name)["meshes"][0]["name"];
    json(std::string("export ") + name + " --what structure '" + part + "' --out " + quoted(out));
    const auto placed = vertices(textOf(out));
    ASSERT_EQ(placed.size(), own.size()) << name;
    for (std::size_t v = 0; v < own.size(); ++v)
    {
      const double x = name == std::string("follows") ? 2.0 * center - own[v][0] : own[v][0];
      ASSERT_NEAR(placed[v][0], x, 1e-3) << name;
      ASSERT_NEAR(placed[v][1], own[v][1], 1e-3) << name;
      ASSERT_NEAR(placed[v][2], own[v][2], 1e-3) << name;
    }
  }
}

TEST_F(BatchCommand, NamesTheColumnOfAxesThatAreNone)
{
  for (const std::string column : {"ct_axes", "mr_axes", "labels_axes", "mesh_axes"})
  {
    write("name,folder,mr,labels,meshes," + column +
          "\na,patient/ct,T2=patient/mr,patient/labels.seg.nrrd,patient/meshes/incus.obj,XYZ\n");
    const auto rows = parsed(run(batch("--dry-run --json")))["rows"];
    ASSERT_EQ(rows.size(), 1U) << column;
    EXPECT_EQ(rows[0]["error"].get<std::string>().rfind("'" + column + "': axes: 'XYZ' is not", 0),
              0U)
        << rows[0]["error"];
  }
  for (const auto& [column, cell] : {std::pair<std::string, std::string>("mesh_axes", "RPS"),
                                     {"mesh_frame", "ras"},
                                     {"mesh_unit", "cm"}})
  {
    write("name,folder," + column + "\na,patient/ct," + cell + "\n");
    const auto rows = parsed(run(batch("--dry-run --json")))["rows"];
    ASSERT_EQ(rows.size(), 1U) << column;
    EXPECT_NE(rows[0]["error"].get<std::string>().find("'" + column + "' goes with 'meshes'"),
              std::string::npos)
        << column << ": " << rows[0]["error"];
  }
  // What the commands say of their options.
  makeSample(m_folder / "tilted", "--dims 32,32,30 --spacing 2.0 --tilt 12");
  write("name,folder\na,tilted/ct\n");
  const std::string error = parsed(run(batch("--json")))["rows"][0]["error"];
  EXPECT_NE(error.find("With 'repair' it is"), std::string::npos) << error;
  EXPECT_EQ(error.find("--"), std::string::npos) << error;
}

TEST_F(BatchCommand, TwoCannotWorkOnOneTable)
{
  writeMany(1);
  std::ofstream(state()).flush();
  const int held = ::open(state().c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(::flock(held, LOCK_EX), 0);
  expectRefused(batch(), 4, "is in use by another program");
  ::close(held);
  EXPECT_EQ(run(batch()).code, 0);
}
