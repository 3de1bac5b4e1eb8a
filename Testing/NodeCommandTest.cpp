#include <fstream>
#include <memory>
#include <set>
#include <utility>

#include "DicomValidator.h"
#include "TestServers.h"
#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Network/SceneObjects.h"

using namespace petrous::testing;
namespace servers = petrous::network::test;

namespace
{

// A drilled sample patient, and a node; TLS with certificates of both sides if asked for.
class NodeCommand : public CommandLine
{
protected:
  void start(bool tls)
  {
    std::string security;
    std::unique_ptr<servers::Certificate> own, client;
    if (tls)
    {
      own = std::make_unique<servers::Certificate>(m_folder, "server");
      client = std::make_unique<servers::Certificate>(m_folder, "client");
      security = " --tls-ca " + quoted(std::filesystem::path(own->certificate())) + " --tls-cert " +
                 quoted(std::filesystem::path(client->certificate())) + " --tls-key " +
                 quoted(std::filesystem::path(client->key()));
    }
    m_server = std::make_unique<servers::Orthanc>(
        m_folder, servers::Orthanc::Options{own.get(), client.get(), 0, 0});
    const std::string node = "nodes add pacs --host 127.0.0.1 --aet ORTHANC --port " +
                             std::to_string(m_server->node().port) + security;
    json(node);
    json(node + other());
    makePatient();
    namePatient("Kowalczyk^Jan");
    json("new ear --ct " + quoted(m_folder / "patient/ct") +
         " --mr T2=" + quoted(m_folder / "patient/mr") + " --labels " +
         quoted(m_folder / "patient/labels.seg.nrrd"));
    json("appearance ear --iso 345.25");
    const auto box = json("info ear")["ct"];
    std::array<double, 3> centre{};
    for (std::size_t a = 0; a < 3; ++a)
      centre[a] = box["origin_mm"][a].get<double>() +
                  0.5 * box["dims"][a].get<double>() * box["spacing_mm"][a].get<double>();
    std::array<double, 3> outside = centre;
    outside[0] += 25.0;
    json("drill ear --path " + quoted(writePath(outside, centre)) + " --diameter 6");
  }

  // Of the sample, which is of nobody: a case tells its name where that is known not to be his.
  void namePatient(const std::string& name) const
  {
    const std::string key("\x10\x00\x10\x00PN\x10\x00", 8); // of 16 bytes
    std::string padded = name;
    padded.resize(16, ' ');
    for (const char* series : {"patient/ct", "patient/mr"})
      for (const auto& entry : std::filesystem::directory_iterator(m_folder / series))
      {
        std::string bytes = textOf(entry.path());
        const std::size_t at = bytes.find(key);
        ASSERT_NE(at, bytes.npos);
        bytes.replace(at + key.size(), padded.size(), padded);
        std::ofstream(entry.path(), std::ios::binary) << bytes;
      }
  }

  std::string other() const { return " --library " + quoted(m_folder / "other"); }

  // What a window shows and an expert asks for.
  void expectSameCase(const std::string& name) const
  {
    auto here = json("info ear");
    auto there = json("info " + name + other());
    EXPECT_GT(here["dissection"]["strokes"], 0);
    for (const char* own : {"case", "resources"})
    {
      here.erase(own);
      there.erase(own);
    }
    EXPECT_EQ(here, there);
    auto history = json("history ear");
    auto received = json("history " + name + other());
    for (auto* one : {&history, &received})
    {
      one->erase("case");
      for (auto& stroke : (*one)["strokes"])
        EXPECT_EQ(stroke["started_at"].is_null(), one == &received) << "times stay at home";
      for (auto& stroke : (*one)["strokes"])
        stroke.erase("started_at");
    }
    EXPECT_EQ(history, received);
    json("render ear --size 120x90 --out " + quoted(m_folder / "here.png"));
    json("render " + name + " --size 120x90 --out " + quoted(m_folder / "there.png") + other());
    EXPECT_EQ(textOf(m_folder / "here.png"), textOf(m_folder / "there.png"));
    json("export ear --what dissected --out " + quoted(m_folder / "here.nrrd"));
    json("export " + name + " --what dissected --out " + quoted(m_folder / "there.nrrd") + other());
    EXPECT_EQ(textOf(m_folder / "here.nrrd"), textOf(m_folder / "there.nrrd"));
    EXPECT_EQ(json("library verify" + other())["damaged"].size(), 0U);
  }

  std::unique_ptr<servers::Orthanc> m_server;
};

// One CT series of two reconstructions 90 mm apart, of the first of which a slice is missing.
std::vector<std::filesystem::path> writeBothEars(const std::filesystem::path& folder,
                                                 const std::string& study)
{
  const std::string series = "2.25.71", other = "2.25.72"; // of one length
  std::vector<std::filesystem::path> files;
  for (const double x : {-60.0, 30.0})
  {
    const petrous::core::GridGeometry grid({16, 16, 20}, Eigen::Vector3d::Constant(0.5),
                                           {x, 0.0, 0.0});
    auto voxels = std::make_shared<petrous::volume::Volume<std::int16_t>>(grid, std::int16_t{0});
    for (int k = 0; k < 20; ++k)
      voxels->at(8, 8, k) = static_cast<std::int16_t>(100 + k);
    petrous::imaging::SeriesDescription description;
    description.studyUid = study;
    description.seriesUid = x < 0.0 ? series : other;
    description.frameOfReferenceUid = "2.25.73";
    const auto ear = folder / description.seriesUid;
    petrous::imaging::writeDicomSeries(
        ear,
        petrous::volume::IntensityVolume(
            std::shared_ptr<const petrous::volume::Volume<std::int16_t>>(std::move(voxels))),
        description);
    if (x < 0.0)
      std::filesystem::remove(ear / "slice-0010.dcm");
    for (const auto& entry : std::filesystem::directory_iterator(ear))
    {
      std::string bytes = textOf(entry.path());
      const std::string element = std::string("\x20\x00\x0e\x00UI", 6);
      const std::size_t at = bytes.find(other, bytes.find(element));
      if (x > 0.0 && at != std::string::npos)
        bytes.replace(at, other.size(), series);
      std::ofstream(entry.path(), std::ios::binary) << bytes;
      files.push_back(entry.path());
    }
  }
  return files;
}

} // namespace

TEST_F(NodeCommand, SendsACaseThatIsTheSameWhenReceived)
{
  if (!servers::Orthanc::installed())
    GTEST_SKIP() << "Orthanc (package orthanc) is not installed";
  start(true);
  EXPECT_EQ(json("nodes test pacs")["tls"], true);
  const auto sent = json("send ear --to pacs");
  EXPECT_EQ(sent["completed"], sent["instances"]);
  EXPECT_EQ(sent["failed"], 0);
  const auto got = json("receive --from pacs --case ear" + other());
  EXPECT_EQ(got["case"], "ear");
  EXPECT_EQ(got["scene"], true);
  expectSameCase("ear");
  if (hasDicomValidator())
  {
    EXPECT_GT(expectValidDicom(m_server->storage(), m_folder / "dciodvfy.txt"), 100U);
  }
  const auto again = json("send ear --to pacs");
  EXPECT_EQ(again["present"], again["instances"]) << "all there already";
  EXPECT_EQ(run("send ear --to pacs").err.find("earlier state"), std::string::npos);

  // A case of the same name in another library is another study.
  json("new twin --ct " + quoted(m_folder / "patient/ct") + other());
  json("library rename ear first" + other());
  json("library rename twin ear" + other());
  EXPECT_NE(json("send ear --to pacs --what ct" + other())["study"], sent["study"]);
  json("library delete ear" + other());
  json("library rename first ear" + other());
  expectRefused("receive --from pacs --study 1.2.3.4 --as nobody" + other(), 3,
                "has no such study");

  // What may be an identity is said before anything leaves; segmentations that are superseded stay.
  json("describe ear --note 'Call Doe^Jane, born 14.03.1962' --tag mrn4711471");
  json("remove ear --part incus");
  const auto warned = run("send ear --to pacs --without-notes");
  EXPECT_EQ(warned.code, 0) << warned.err;
  EXPECT_NE(warned.err.find("tag"), std::string::npos) << warned.err;
  EXPECT_EQ(warned.err.find("the note:"), std::string::npos) << warned.err;
  EXPECT_NE(warned.err.find("1 segmentation of an earlier state"), std::string::npos) << warned.err;
  json("receive --from pacs --as noteless --study " + sent["study"].get<std::string>() + other());
  EXPECT_EQ(run("info noteless" + other()).out.find("Doe^Jane"), std::string::npos);
  EXPECT_NE(run("send ear --to pacs --what scene").err.find("the note"), std::string::npos);

  // A later state is another scene, and the one that is received.
  json("undo ear");
  json("send ear --to pacs --what scene");
  json("receive --from pacs --as later --study " + sent["study"].get<std::string>() + other());
  const auto later = json("info later" + other())["dissection"];
  EXPECT_EQ(later["redo"], 1);
  EXPECT_EQ(later, json("info ear")["dissection"]);
  expectRefused("receive --from pacs --as later --case ear" + other(), 4, "there already");
  expectRefused("receive --from pacs --case ear" + other(), 4, "'ear' is there already");

  // One folder for two states of the scene.
  const std::string kept = " --partial " + quoted(m_folder / "kept") + other();
  json("receive --from pacs --as kept --case ear" + kept);
  json("redo ear");
  json("send ear --to pacs --what scene");
  json("receive --from pacs --as newer --case ear" + kept);
  EXPECT_EQ(json("info newer" + other())["dissection"], json("info ear")["dissection"]);
  EXPECT_EQ(logText().find(sent["study"].get<std::string>()), std::string::npos);
  if (!hasDicomValidator())
    GTEST_SKIP() << kNoDicomValidator;
}

// By names and IDs of nobody's; a name that may be a patient's does not leave but in the scene.
TEST_F(NodeCommand, ListsCasesByTheirNamesAsPatientsOfTheirOwn)
{
  if (!servers::Orthanc::installed())
    GTEST_SKIP() << "Orthanc (package orthanc) is not installed";
  start(false);
  const Outcome renamed = run("library rename ear first");
  EXPECT_NE(renamed.out.find("it is another patient and study there"), std::string::npos)
      << renamed.out;
  json("library rename first ear");
  json("library copy ear \"\xc3\xb6hr 2\"");
  json("library copy ear \"Jane Doeberg\"");
  std::set<std::string> patients;
  for (const char* name : {"ear", "\xc3\xb6hr 2", "Jane Doeberg"})
  {
    const auto sent = json("send \"" + std::string(name) + "\" --to pacs --what labels");
    const bool isHidden = std::string(name) == "Jane Doeberg";
    EXPECT_EQ(sent["patient_name"],
              "Petrous^" + (isHidden ? sent["patient_id"].get<std::string>() : name));
    patients.insert(sent["patient_id"]);
    const auto studies =
        petrous::network::findStudies(m_server->node(), {sent["study"].get<std::string>(), {}});
    ASSERT_EQ(studies.size(), 1U);
    EXPECT_EQ(studies[0].patientName, sent["patient_name"].get<std::string>());
    EXPECT_EQ(studies[0].patientId, sent["patient_id"].get<std::string>());
  }
  EXPECT_EQ(patients.size(), 3U);
  const auto names = [this](const std::string& options)
  {
    std::multiset<std::string> all;
    const auto answer = json("receive --from pacs --list " + options);
    for (const auto& one : answer["cases"])
      all.insert(one["case"].is_null() ? "?" : one["case"].get<std::string>());
    return all;
  };
  using Names = std::multiset<std::string>;
  EXPECT_EQ(names(""), (Names{"Jane Doeberg", "ear", "\xc3\xb6hr 2"})) << "of this library";
  EXPECT_EQ(names(other()), (Names{"?", "ear", "\xc3\xb6hr 2"}));
  EXPECT_EQ(names("--case EA" + other()), Names{"ear"});
  EXPECT_EQ(names("--case \"\xc3\xb6h*2\"" + other()), Names{"\xc3\xb6hr 2"});
  EXPECT_EQ(names("--case \"Jane Doeberg\""), Names{"Jane Doeberg"}) << "by this library's salt";
  EXPECT_EQ(names("--case \"Jane Doeberg\"" + other()), Names{}) << "nor can it be guessed";
  EXPECT_EQ(names("--case nobody" + other()), Names{});
  expectRefused("receive --from pacs --list --as x", 2, "--list");

  // As the former version sent a scene: one patient for all, another study of the same case.
  json("archive ear " + quoted(m_folder / "former.petrous"));
  petrous::network::SceneDescription former;
  former.studyUid = "2.25.4711";
  former.studyId = "db889f25ec96f88a"; // sha256sum of "petrous case former ear"
  std::filesystem::create_directories(m_folder / "former");
  petrous::network::store(m_server->node(),
                          petrous::network::writeSceneObjects(m_folder / "former.petrous",
                                                              m_folder / "former", former));
  EXPECT_EQ(names("--case \"former ear\"" + other()), Names{"?"});
  EXPECT_EQ(names(other()).size(), 4U);
  EXPECT_EQ(json("receive --from pacs --case \"former ear\" --as was" + other())["scene"], true);
}

// Fail closed: in another library nothing is known of the patient's name, and of one of two letters
// no hash is kept.
TEST_F(NodeCommand, WithholdsANameThatIsNotKnownToBeNobodys)
{
  if (!servers::Orthanc::installed())
    GTEST_SKIP() << "Orthanc (package orthanc) is not installed";
  start(false);
  const auto studyOf = [this](const nlohmann::json& sent)
  {
    return petrous::network::findStudies(m_server->node(), {sent["study"].get<std::string>(), {}})
        .at(0);
  };
  const auto sent = [&](const std::string& name, const std::string& library = {})
  {
    const Outcome outcome = run("--json send \"" + name + "\" --to pacs --what labels" + library);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto answer = nlohmann::json::parse(outcome.out);
    const bool isHidden =
        answer["patient_name"] == "Petrous^" + answer["patient_id"].get<std::string>();
    EXPECT_EQ(isHidden,
              outcome.err.find("is not the patient's name at node 'pacs'") != std::string::npos)
        << outcome.err;
    EXPECT_EQ(studyOf(answer).patientName, answer["patient_name"].get<std::string>());
    const std::string notes = answer["notes"].dump();
    EXPECT_EQ(isHidden, notes.find("it goes along where") != std::string::npos) << notes;
    return answer;
  };
  const auto isHidden = [&](const nlohmann::json& answer)
  { return answer["patient_name"] == "Petrous^" + answer["patient_id"].get<std::string>(); };

  json("library copy ear \"Kowalczyk left\"");
  const auto own = sent("Kowalczyk left");
  EXPECT_TRUE(isHidden(own));
  EXPECT_FALSE(isHidden(sent("ear")));
  // What is exported as DICOM, likewise.
  const auto exported =
      json("export \"Kowalczyk left\" --what labels --out " + quoted(m_folder / "left.dcm"));
  EXPECT_TRUE(isHidden(exported));
  EXPECT_NE(exported["notes"].dump().find("where the case is renamed"), std::string::npos);
  const auto named = json("export ear --what labels --out " + quoted(m_folder / "ear.dcm"));
  EXPECT_EQ(named["patient_name"], "Petrous^ear");
  EXPECT_EQ(named["notes"].dump().find("is not the patient's name"), std::string::npos);
  const std::string guessed = "72747bacb70ffd04"; // sha256sum of "petrous case Kowalczyk left"
  EXPECT_NE(studyOf(own).studyId, guessed);
  const auto again = sent("Kowalczyk left");
  EXPECT_EQ(again["study"], own["study"]);
  EXPECT_EQ(again["present"], again["instances"]);

  json("archive \"Kowalczyk left\" " + quoted(m_folder / "left.petrous"));
  json("restore " + quoted(m_folder / "left.petrous") + other());
  const auto foreign = sent("Kowalczyk left", other());
  EXPECT_TRUE(isHidden(foreign));
  EXPECT_NE(studyOf(foreign).studyId, guessed);
  EXPECT_NE(studyOf(foreign).studyId, studyOf(own).studyId);
  const auto scene = json("send \"Kowalczyk left\" --to pacs --what scene" + other());
  // By what `send` names, a third library finds it, which knows the node.
  json("nodes add pacs --host 127.0.0.1 --aet ORTHANC --port " +
       std::to_string(m_server->node().port) + " --library " + quoted(m_folder / "by study"));
  const std::string study = scene["study"];
  EXPECT_NE(scene["notes"].dump().find("receives the study " + study), std::string::npos)
      << scene["notes"];
  EXPECT_EQ(json("receive --from pacs --study " + study + " --as left --library " +
                 quoted(m_folder / "by study"))["scene"],
            true);
  const auto listed = json("receive --from pacs --list --library " + quoted(m_folder / "by study"));
  for (const auto& one : listed["cases"])
    EXPECT_TRUE(one["study"] != study || one["instances"].get<int>() >= 2) << one;
  json("receive --from pacs --case \"Kowalczyk left\" --as back" + other());
  expectRefused("receive --from pacs --case \"Kowalczyk left\" --as back --library " +
                    quoted(m_folder / "third"),
                3, "");

  namePatient("Ng^Bo");
  json("new \"Ng ear\" --ct " + quoted(m_folder / "patient/ct") + " --labels " +
       quoted(m_folder / "patient/labels.seg.nrrd"));
  EXPECT_TRUE(isHidden(sent("Ng ear")));

  // Its files state a name, but of nobody.
  namePatient("Phantom^Petrous");
  json("new sample --ct " + quoted(m_folder / "patient/ct") + " --labels " +
       quoted(m_folder / "patient/labels.seg.nrrd"));
  const auto ofPhantom = sent("sample");
  EXPECT_TRUE(isHidden(ofPhantom));
  const std::string notes = ofPhantom["notes"].dump();
  EXPECT_NE(notes.find("no word with which to compare it"), notes.npos) << notes;
  EXPECT_EQ(notes.find("nothing is known"), notes.npos) << notes;
}

// Whoever has the report alone can receive the case; what the scanner made is not in it.
TEST_F(NodeCommand, ABatchNamesTheStudyByWhichACaseIsReceived)
{
  if (!servers::Orthanc::installed())
    GTEST_SKIP() << "Orthanc (package orthanc) is not installed";
  start(false);
  json("library copy ear \"Kowalczyk left\"");
  const auto table = m_folder / "table.csv";
  std::ofstream(table) << "name,folder,send\nKowalczyk left,,pacs\nbad,patient,\n";
  // Two series of one kind in a folder: each is named by its UID.
  const Outcome outcome = run("--json batch " + quoted(table));
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  const auto answer = nlohmann::json::parse(outcome.out);
  const std::string notes = answer["rows"][0]["notes"].dump();
  const std::string words = "receives the study ";
  const std::size_t at = notes.find(words);
  ASSERT_NE(at, notes.npos) << notes;
  const std::size_t from = at + words.size();
  const std::string study = notes.substr(from, notes.find(',', from) - from);
  EXPECT_EQ(study.rfind("2.25.", 0), 0U) << study;
  EXPECT_EQ(notes.find("petrous scan"), notes.npos) << notes;
  EXPECT_EQ(json("receive --from pacs --study " + study + " --as back" + other())["scene"], true);
  const std::string error = answer["rows"][1]["error"];
  EXPECT_NE(error.find("UID 1"), error.npos) << error;
  EXPECT_EQ(error.find("2.25."), error.npos) << "of the source's files: " << error;
}

// A study that states the hash of a case's name need not be that case's; and what a node answers
// need not be text.
TEST_F(NodeCommand, ListsTheNodesOwnNamesBesideAndNoControlCharacters)
{
  if (!servers::Orthanc::installed())
    GTEST_SKIP() << "Orthanc (package orthanc) is not installed";
  start(false);
  json("archive ear " + quoted(m_folder / "ear.petrous"));
  int number = 0;
  for (const char* name : {"Petrous^another", "Petrous^a\tb"})
  {
    petrous::network::SceneDescription description;
    description.patientId = "PETROUS-000000000000000" + std::to_string(++number);
    description.patientName = name;
    description.studyUid = "2.25.81" + std::to_string(number);
    description.studyId = number == 1 ? "5e0064845753a76d" : "1"; // sha256sum of "petrous case ear"
    const auto folder = m_folder / std::to_string(number);
    std::filesystem::create_directories(folder);
    petrous::network::store(m_server->node(), petrous::network::writeSceneObjects(
                                                  m_folder / "ear.petrous", folder, description));
  }
  const auto cases = json("receive --from pacs --list")["cases"];
  ASSERT_EQ(cases.size(), 2U);
  EXPECT_EQ(cases[0]["case"], "ear");
  EXPECT_EQ(cases[0]["patient_name"], "Petrous^another");
  const Outcome listed = run("receive --from pacs --list");
  EXPECT_NE(listed.out.find("'ear', there of patient 'Petrous^another'"), std::string::npos)
      << listed.out;
  EXPECT_NE(listed.out.find("'a?b'"), std::string::npos) << listed.out;
}

TEST_F(NodeCommand, BuildsACaseOfImages)
{
  if (!servers::Orthanc::installed())
    GTEST_SKIP() << "Orthanc (package orthanc) is not installed";
  start(false);
  const auto sent = json("send ear --to pacs --what ct");
  EXPECT_EQ(sent["instances"], 60);
  const std::string study = " --study " + sent["study"].get<std::string>();
  expectRefused("receive --from pacs" + study + other(), 3, "--as");
  json("receive --from pacs --as ct" + study + other());
  json("send ear --to pacs --what mr");
  EXPECT_EQ(json("send ear --to pacs --what labels")["instances"], 1);
  const auto got = json("receive --from pacs --as both" + study + other());
  EXPECT_EQ(got["scene"], false);
  const auto info = json("info both" + other());
  EXPECT_EQ(info["mr"].size(), 1U);
  const auto labels = json("info ear")["labels"];
  ASSERT_EQ(info["labels"].size(), labels.size());
  for (std::size_t n = 0; n < labels.size(); ++n)
  {
    EXPECT_EQ(info["labels"][n]["name"], labels[n]["name"]);
    EXPECT_EQ(info["labels"][n]["voxels"], labels[n]["voxels"]);
  }
  for (const char* name : {"ear", "both"})
    json(std::string("export ") + name + " --what ct --out " +
         quoted(m_folder / (std::string(name) + ".nrrd")) + (name[0] == 'e' ? "" : other()));
  EXPECT_EQ(textOf(m_folder / "ear.nrrd"), textOf(m_folder / "both.nrrd"));

  // Of several states of the structures the latest, whatever their files are called.
  for (const int threshold : {900, 1000, 1100, 1200})
  {
    json("segment ear block --replace --threshold " + std::to_string(threshold) + ",1300");
    json("send ear --to pacs --what labels");
    const std::string name = "at" + std::to_string(threshold);
    const auto received = json("receive --from pacs --as " + name + study + other());
    EXPECT_NE(received["notes"].dump().find("the latest by its series number"), std::string::npos)
        << received;
    std::map<std::string, int> here, there;
    const auto ours = json("info ear"), theirs = json("info " + name + other());
    for (const auto& one : ours["labels"])
      here[one["name"]] = one["voxels"];
    for (const auto& one : theirs["labels"])
      there[one["name"]] = one["voxels"];
    EXPECT_GT(here["block"], 0);
    EXPECT_EQ(there, here) << threshold;
  }

  // Two patients by one folder of what arrived.
  json("new plain --ct " + quoted(m_folder / "patient/ct"));
  const auto plain = json("send plain --to pacs --what ct");
  const std::string kept = " --partial " + quoted(m_folder / "kept");
  json("receive --from pacs --as first" + study + kept + other());
  json("receive --from pacs --as second --study " + plain["study"].get<std::string>() + kept +
       other());
  EXPECT_EQ(json("info first" + other())["mr"].size(), 1U);
  EXPECT_EQ(json("info second" + other())["mr"].size(), 0U);
  EXPECT_EQ(json("info second" + other())["labels"].size(), 0U);

  // The study is there already when its scene follows.
  json("send plain --to pacs --what scene");
  EXPECT_EQ(json("receive --from pacs --case plain" + other())["scene"], true);

  // Of two CTs one is asked for, before anything is transferred.
  json("export ear --what dissected --out " + quoted(m_folder / "dissected/"));
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(m_folder / "dissected"))
    files.push_back(entry.path());
  petrous::network::store(m_server->node(), files);
  expectRefused("receive --from pacs --as two --partial " + quoted(m_folder / "two") + study +
                    other(),
                3, "2 CT series; name one by --series: ");
  EXPECT_TRUE(!std::filesystem::exists(m_folder / "two") ||
              std::filesystem::is_empty(m_folder / "two"));

  // Of two ears in one series neither is chosen, though only one is sound.
  petrous::network::store(m_server->node(), writeBothEars(m_folder / "ears", "2.25.70"));
  const std::string ears = "receive --from pacs --study 2.25.70 --as one" + other();
  for (const char* series : {"", " --series 2.25.71"})
  {
    const auto asked = run(ears + series);
    EXPECT_EQ(asked.code, 3) << asked.err;
    for (const char* said : {"2 volumes", "--volume", "(19 images, doubtful)", "(20 images)"})
      EXPECT_NE(asked.err.find(said), std::string::npos) << asked.err;
  }
  const auto asked = run(ears);
  const std::size_t first = asked.err.find("--volume: '") + 11;
  const std::size_t comma = asked.err.find("(20 images)");
  const std::size_t last = asked.err.rfind('\'', comma);
  const std::size_t start = asked.err.rfind('\'', last - 1) + 1;
  ASSERT_TRUE(first < comma && start < last) << asked.err;
  json(ears + " --volume '" + asked.err.substr(start, last - start) + "'");
  const auto box = json("info one" + other())["ct"];
  EXPECT_EQ(box["dims"][2], 20);
  EXPECT_EQ(box["origin_mm"][0], 30.0);
}

// Of 12 bits stored by its header, with a voxel of 5000.
TEST_F(NodeCommand, ReceivesBitsThatAreNotDeclaredAsTheUserSays)
{
  if (!servers::Orthanc::installed())
    GTEST_SKIP() << "Orthanc (package orthanc) is not installed";
  start(false);
  using Voxels = petrous::volume::Volume<std::int16_t>;
  const auto voxels = std::make_shared<Voxels>(
      petrous::core::GridGeometry({16, 16, 6}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero()),
      std::int16_t{40});
  voxels->at(5, 5, 3) = 5000;
  petrous::imaging::SeriesDescription series;
  series.studyUid = "2.25.80";
  series.seriesUid = "2.25.81";
  series.frameOfReferenceUid = "2.25.82";
  petrous::imaging::writeDicomSeries(
      m_folder / "odd", petrous::volume::IntensityVolume(std::shared_ptr<const Voxels>(voxels)),
      series);
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(m_folder / "odd"))
  {
    std::string bytes = textOf(entry.path());
    for (const auto& [element, value] :
         {std::pair('\x01', 12), {'\x02', 11}}) // Bits Stored, High Bit
    {
      const std::size_t at =
          bytes.find(std::string("\x28\x00", 2) + element + "\x01US" + std::string("\x02\x00", 2));
      ASSERT_NE(at, std::string::npos);
      bytes[at + 8] = static_cast<char>(value);
    }
    std::ofstream(entry.path(), std::ios::binary) << bytes;
    files.push_back(entry.path());
  }
  petrous::network::store(m_server->node(), files);
  const std::string odd = "receive --from pacs --study 2.25.80 --as ";
  expectRefused(odd + "none" + other(), 3, "--bits stored");
  expectRefused(odd + "none --bits both" + other(), 2, "--bits");
  expectRefused("receive --from pacs --list --bits stored" + other(), 2, "--list");
  json(odd + "cut --bits stored" + other());
  json(odd + "whole --bits allocated" + other());
  for (const char* name : {"cut", "whole"})
    json(std::string("export ") + name + " --what ct --out " +
         quoted(m_folder / (std::string(name) + ".nrrd")) + other());
  EXPECT_NE(textOf(m_folder / "cut.nrrd"), textOf(m_folder / "whole.nrrd"));
}

// A send that was cut leaves parts of a scene; the one before it can still be received.
TEST_F(NodeCommand, ReceivesTheLatestSceneThatIsWhole)
{
  if (!servers::Orthanc::installed())
    GTEST_SKIP() << "Orthanc (package orthanc) is not installed";
  start(false);
  const auto sent = json("send ear --to pacs --what scene");
  const std::filesystem::path archive = m_folder / "later.petrous";
  // Another content: the same archive would be of the same series.
  json("new later --ct " + quoted(m_folder / "patient/ct"));
  json("archive later " + quoted(archive));
  petrous::network::SceneDescription description;
  description.studyUid = sent["study"];
  const auto study =
      petrous::network::findStudies(m_server->node(), {description.studyUid, {}}).at(0);
  description.studyId = study.studyId;
  description.patientId = study.patientId;
  description.patientName = study.patientName;
  description.seriesNumber = 5000; // a later state than that of the revision
  std::filesystem::create_directories(m_folder / "parts");
  auto parts = petrous::network::writeSceneObjects(archive, m_folder / "parts", description, {},
                                                   std::filesystem::file_size(archive) / 3);
  ASSERT_GE(parts.size(), 3U);
  const auto last = parts.back();
  parts.pop_back();
  petrous::network::store(m_server->node(), parts);
  const auto got = json("receive --from pacs --case ear" + other());
  EXPECT_EQ(got["scene"], true);
  ASSERT_EQ(got["notes"].size(), 1U) << got;
  EXPECT_NE(got["notes"][0].get<std::string>().find("a later state of the case"),
            std::string::npos);
  expectSameCase("ear");
  petrous::network::store(m_server->node(), {last});
  EXPECT_TRUE(json("receive --from pacs --case ear --as whole" + other())["notes"].empty());
}

TEST_F(NodeCommand, ABatchSendsWhatIsNew)
{
  if (!servers::Orthanc::installed())
    GTEST_SKIP() << "Orthanc (package orthanc) is not installed";
  start(false);
  std::ofstream(m_folder / "table.csv") << "name,folder,send\near,,pacs\nct,patient/ct,pacs\n";
  const std::string batch = "batch " + quoted(m_folder / "table.csv");
  EXPECT_EQ(json(batch)["counts"]["done"], 2);
  json("receive --from pacs --case ear" + other());
  json("receive --from pacs --case ct" + other());
  expectSameCase("ear");
  EXPECT_EQ(json(batch)["counts"]["already done"], 2);
  // The same name at another place.
  json("nodes remove pacs");
  json("nodes add pacs --host 127.0.0.1 --aet ORTHANC --port " +
       std::to_string(servers::freePort()));
  EXPECT_EQ(run(batch).code, 3) << "nothing is sent there, nor said to be";
  json("nodes remove pacs");
  json("nodes add pacs --host 127.0.0.1 --aet ORTHANC --port " +
       std::to_string(m_server->node().port));
  EXPECT_EQ(json(batch)["counts"]["already done"], 2);
  json("undo ear");
  const auto rows = json(batch)["rows"];
  EXPECT_EQ(rows[0]["steps"]["send"]["status"], "done") << "a later state is sent";
  EXPECT_EQ(rows[1]["status"], "already done");
  m_server.reset();
  json("redo ear");
  const Outcome outcome = run(batch);
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.out.find("send failed"), std::string::npos) << outcome.out;
}

TEST_F(NodeCommand, KeepsNodesInTheLibrary)
{
  json("nodes add b --host pacs.example --port 11112 --aet ARCHIVE --calling ME");
  expectRefused("nodes add c --host h --aet A --tls-ca " + quoted(m_folder / "none.pem"), 3,
                "none.pem: is not there");
  std::ofstream(m_folder / "text.pem") << "no certificate";
  expectRefused("nodes add c --host h --aet A --tls-ca " + quoted(m_folder / "text.pem"), 3,
                "text.pem: is not a PEM file");
  const servers::Certificate own(m_folder, "own"), another(m_folder, "another");
  const std::string pair = "nodes add c --host h --aet A --tls-cert " +
                           quoted(std::filesystem::path(own.certificate())) + " --tls-key ";
  expectRefused(pair + quoted(m_folder / "text.pem"), 3, "text.pem: is not a PEM file");
  expectRefused(pair + quoted(std::filesystem::path(another.key())), 3, "is not the key of");
  json(pair + quoted(std::filesystem::path(own.key())));
  json("nodes remove c");
  json("nodes add a --host 127.0.0.1 --port " + std::to_string(servers::freePort()) +
       " --aet ARCHIVE --tls");
  const auto nodes = json("nodes list")["nodes"];
  ASSERT_EQ(nodes.size(), 2U);
  EXPECT_EQ(nodes[0]["name"], "a");
  EXPECT_EQ(nodes[0]["tls"], true);
  EXPECT_EQ(nodes[1]["ae_title"], "ARCHIVE");
  EXPECT_EQ(nodes[1]["calling_ae_title"], "ME");
  expectRefused("nodes add a --host h --port 1 --aet A", 3, "there already");
  expectRefused("nodes add c --host h:104 --aet A", 3, "host");
  expectRefused("nodes add c --host h --port 70000 --aet A", 2, "65535");
  expectRefused("nodes add c --host h --aet 'LONGER THAN SIXTEEN'", 2, "16");
  expectRefused("nodes add c --host h --aet A --tls-cert x.pem", 3, "together");
  expectRefused("nodes add '\xff\xfe' --host h --aet A", 3, "UTF-8");
  expectRefused("nodes add c --host h --aet A --tls-name '*'", 3, "certificates of any name");
  expectRefused("nodes add c --host h --aet A --move-host h:1", 3, "without a port");
  expectRefused("nodes add c --host h", 2, "--aet");
  expectRefused("nodes test nobody", 3, "there are: a, b");
  expectRefused("nodes test a", 4, "nothing answers");
  expectRefused("send ear --to nobody", 3, "nobody");
  expectRefused("receive --from a", 2, "--study");
  json("nodes remove a");
  EXPECT_EQ(json("nodes list")["nodes"].size(), 1U);
  expectRefused("nodes remove a", 3, "there are: b");
  EXPECT_EQ(json("library verify")["damaged"].size(), 0U);
  std::ofstream(library() / "nodes.json") << "{";
  expectRefused("nodes list", 3, "nodes.json");
}

// What a killed receive left of a patient is removed by the next one.
TEST_F(NodeCommand, RemovesWhatAKilledTransferLeft)
{
  makePatient();
  json("new ear --ct " + quoted(m_folder / "patient/ct"));
  json("nodes add pacs --host 127.0.0.1 --aet A --port " + std::to_string(servers::freePort()));
  const auto left = m_folder / "tmp/petrous-transfer-aaaaaa/0123/images";
  std::filesystem::create_directories(left);
  std::ofstream(left / "part.tmp") << "a patient's";
  std::filesystem::create_directories(m_folder / "tmp/petrous-other");
  ::setenv("TMPDIR", (m_folder / "tmp").c_str(), 1);
  const auto outcome = run("receive --from pacs --study 1.2.3 --as new");
  ::unsetenv("TMPDIR");
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(m_folder / "tmp/petrous-transfer-aaaaaa"));
  EXPECT_TRUE(std::filesystem::exists(m_folder / "tmp/petrous-other"));
}

// An MR as primary image is the case's MR.
TEST_F(NodeCommand, SendsThePrimaryMr)
{
  if (!servers::Orthanc::installed())
    GTEST_SKIP() << "Orthanc (package orthanc) is not installed";
  start(false);
  json("new mr --modality MR --ct " + quoted(m_folder / "patient/mr"));
  const auto sent = run("send mr --to pacs");
  EXPECT_EQ(sent.code, 0) << sent.err;
  EXPECT_EQ(sent.err.find("has no MR"), std::string::npos) << sent.err;
  EXPECT_GT(json("send mr --to pacs --what mr")["instances"], 10);
  expectRefused("send mr --to pacs --what ct", 3, "its primary image is an MR");
}
