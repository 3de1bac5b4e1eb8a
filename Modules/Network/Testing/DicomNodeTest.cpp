#include "petrous/Network/DicomNode.h"

#include <map>

#include <gtest/gtest.h>

#include "TestServers.h"
#include "petrous/Imaging/DicomReader.h"
#include "petrous/Imaging/DicomScan.h"
#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Network/SceneObjects.h"

namespace petrous::network
{
namespace
{

using namespace test;
using Reason = NetworkError::Reason;

constexpr int kSlices = 12;

/// A CT series with pseudo-random voxels in a folder, and what it is at a node.
struct CtSeries
{
  std::string study = imaging::deterministicUid(7, "test study");
  std::string series = imaging::deterministicUid(7, "test series");
  std::vector<fs::path> files;
  std::shared_ptr<volume::Volume<std::int16_t>> voxels;

  explicit CtSeries(const fs::path& folder, int n = 64)
  {
    const core::GridGeometry grid({n, n, kSlices}, Eigen::Vector3d(0.5, 0.5, 0.75),
                                  Eigen::Vector3d(-10, 20, -30));
    voxels = std::make_shared<volume::Volume<std::int16_t>>(grid);
    std::mt19937 random(5);
    for (std::size_t i = 0; i < voxels->size(); ++i)
      voxels->data()[i] = static_cast<std::int16_t>(random() % 4000) - 1000;
    imaging::SeriesDescription description;
    description.studyUid = study;
    description.seriesUid = series;
    description.frameOfReferenceUid = imaging::deterministicUid(7, "frame");
    description.patientId = "SECRET-PATIENT-ID";
    imaging::writeDicomSeries(
        folder,
        volume::IntensityVolume(std::shared_ptr<const volume::Volume<std::int16_t>>(voxels)),
        description);
    for (const auto& entry : fs::directory_iterator(folder))
      files.push_back(entry.path());
    std::sort(files.begin(), files.end());
  }

  /// Expects these very voxels.
  void expectIn(const fs::path& folder) const
  {
    const auto scan = imaging::scanDicom(folder, {});
    ASSERT_EQ(scan.series.size(), 1U);
    EXPECT_EQ(scan.series.front().geometry.verdict, imaging::Verdict::Ok);
    const auto read = imaging::readSeries(scan.series.front(), {}, {});
    const auto image = std::get<std::shared_ptr<const volume::Volume<std::int16_t>>>(read.voxels());
    ASSERT_EQ(image->size(), voxels->size());
    EXPECT_EQ(std::memcmp(image->data(), voxels->data(), voxels->size() * sizeof(std::int16_t)), 0);
  }
};

std::size_t filesIn(const fs::path& folder)
{
  std::error_code ignored;
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    count += entry.path().extension() == kInstanceEnding ? 1U : 0U;
  return count;
}

template <class Action>
NetworkError failure(const Action& action)
{
  try
  {
    action();
  }
  catch (const NetworkError& error)
  {
    const std::string text = error.what();
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_EQ(text.find("SECRET"), std::string::npos) << text;
    EXPECT_EQ(text.find("2.25."), std::string::npos) << text;
    return error;
  }
  ADD_FAILURE() << "nothing was thrown";
  return {Reason::Protocol, ""};
}

void roundTrip(const Node& node, const fs::path& folder)
{
  const CtSeries ct(folder / "ct");
  echo(node);
  EXPECT_EQ(failure([&] { retrieve(node, ct.study, {}, folder / "none"); }).reason,
            Reason::NotFound);

  const Transfer sent = store(node, ct.files);
  EXPECT_EQ(sent.instances, kSlices);
  EXPECT_EQ(sent.completed, kSlices);
  EXPECT_EQ(sent.present, 0U);
  EXPECT_EQ(sent.asked, 1U);
  EXPECT_TRUE(sent.verified);
  EXPECT_GT(sent.bytes, ct.voxels->size() * 2);
  const Transfer again = store(node, ct.files);
  EXPECT_EQ(again.completed, kSlices);
  EXPECT_EQ(again.present, kSlices) << "not sent again";
  EXPECT_EQ(again.bytes, 0U);

  const auto studies = findStudies(node, {ct.study, {}});
  ASSERT_EQ(studies.size(), 1U);
  EXPECT_EQ(studies.front().patientId, "SECRET-PATIENT-ID");
  // As a user looks for a patient.
  const auto foundBy = [&](const std::function<void(StudyFilter&)>& set)
  {
    StudyFilter filter;
    set(filter);
    return findStudies(node, filter).size();
  };
  EXPECT_EQ(foundBy([](auto& filter) { filter.patientId = "SECRET*"; }), 1U);
  EXPECT_EQ(foundBy([](auto& filter) { filter.patientId = "SECRET"; }), 0U);
  EXPECT_EQ(foundBy(
                [](auto& filter)
                {
                  filter.patientId = "SECRET-PATIENT-ID";
                  filter.modality = "CT";
                }),
            1U);
  EXPECT_EQ(foundBy(
                [](auto& filter)
                {
                  filter.patientId = "SECRET-PATIENT-ID";
                  filter.modality = "MR";
                }),
            0U);
  EXPECT_EQ(foundBy([](auto& filter) { filter.patientName = "M\u00fcller^*"; }), 0U);
  const auto series = findSeries(node, ct.study);
  ASSERT_EQ(series.size(), 1U);
  EXPECT_EQ(series.front().uid, ct.series);
  EXPECT_EQ(series.front().modality, "CT");
  EXPECT_EQ(findInstances(node, ct.study, {ct.series}).size(), std::size_t{kSlices});

  const fs::path back = folder / "back";
  const Transfer got = retrieve(node, ct.study, {}, back);
  EXPECT_EQ(got.instances, kSlices);
  EXPECT_EQ(got.completed, kSlices);
  EXPECT_EQ(got.asked, 1U);
  ct.expectIn(back);

  // Some are there already: only the rest is fetched.
  std::vector<fs::path> received;
  for (const auto& entry : fs::directory_iterator(back))
    received.push_back(entry.path());
  for (int n = 0; n < 5; ++n)
    fs::remove(received[static_cast<std::size_t>(n)]);
  fs::resize_file(received[6], 200); // damaged
  const Transfer rest = retrieve(node, ct.study, {ct.series}, back);
  EXPECT_EQ(rest.completed, kSlices);
  EXPECT_EQ(rest.present, std::size_t{kSlices - 6});
  ct.expectIn(back);
}

/// A node of dcmjs-dimse (npm), whose DICOM network is neither DCMTK's, on which this program and
/// Orthanc stand, nor the Central Test Node's. Null where it is not installed.
class DimsePeer
{
public:
  static std::unique_ptr<DimsePeer> start(const fs::path& folder, const Certificate* own = nullptr,
                                          const Certificate* client = nullptr)
  {
    auto peer = std::unique_ptr<DimsePeer>(new DimsePeer);
    peer->m_node.name = "dimse";
    peer->m_node.host = "127.0.0.1";
    peer->m_node.port = freePort();
    peer->m_node.aeTitle = "DIMSE";
    std::vector<std::string> command{"/usr/bin/env",
                                     "NODE_PATH=/usr/local/lib/node_modules:/usr/lib/node_modules",
                                     "node", PETROUS_DIMSE_PEER, std::to_string(peer->m_node.port)};
    if (const char* path = std::getenv("NODE_PATH"))
      command[1] = std::string("NODE_PATH=") + path;
    if (own)
    {
      command.insert(command.end(), {own->key(), own->certificate(), client->certificate()});
      peer->m_node.tls = TlsFiles{own->certificate(), client->certificate(), client->key()};
    }
    peer->m_process = std::make_unique<ServerProcess>(command, folder / "dimse.log");
    bool isThere = false;
    waitFor(
        [&]
        {
          const int connection = connectTo(peer->m_node.port);
          isThere = connection >= 0;
          if (isThere)
            ::close(connection);
          return isThere || !peer->m_process->running();
        });
    return isThere ? std::move(peer) : nullptr;
  }
  const Node& node() const { return m_node; }

private:
  DimsePeer() = default;
  Node m_node;
  std::unique_ptr<ServerProcess> m_process;
};

constexpr const char* kNoDimsePeer =
    "dcmjs-dimse is not installed (npm install -g dcmjs-dimse, or name its folder in NODE_PATH)";

class OrthancNode : public ::testing::Test
{
protected:
  void SetUp() override
  {
    if (!Orthanc::installed())
      GTEST_SKIP() << "Orthanc (package orthanc) is not installed";
  }
  TemporaryFolder m_folder;
};

} // namespace

TEST_F(OrthancNode, KeepsASeriesAndGivesItBack)
{
  const Orthanc server(m_folder.path(), {});
  roundTrip(server.node(), m_folder.path());
}

// A second implementation of all services, plain and with certificates of both sides.
TEST(OtherNode, KeepsASeriesAndGivesItBack)
{
  const TemporaryFolder folder;
  const auto peer = DimsePeer::start(folder.path());
  if (!peer)
    GTEST_SKIP() << kNoDimsePeer;
  roundTrip(peer->node(), folder.path());
}

TEST(OtherNode, SpeaksTlsWithCertificatesOfBothSides)
{
  const TemporaryFolder folder;
  const Certificate own(folder.path(), "server"), client(folder.path(), "client"),
      stranger(folder.path(), "stranger");
  const auto peer = DimsePeer::start(folder.path(), &own, &client);
  if (!peer)
    GTEST_SKIP() << kNoDimsePeer;
  roundTrip(peer->node(), folder.path());
  Node node = peer->node();
  node.tls->authority = stranger.certificate();
  EXPECT_EQ(failure([&] { echo(node); }).reason, Reason::Tls);
  node = peer->node();
  node.tls->certificate = stranger.certificate();
  node.tls->key = stranger.key();
  const Reason reason = failure([&] { echo(node); }).reason;
  EXPECT_TRUE(reason == Reason::Tls || reason == Reason::Cut)
      << "of a client that it does not know";
}

TEST_F(OrthancNode, SpeaksTlsWithCertificatesOfBothSides)
{
  const Certificate own(m_folder.path(), "server"), client(m_folder.path(), "client"),
      stranger(m_folder.path(), "stranger");
  const Orthanc server(m_folder.path(), {&own, &client, 0, 0});
  roundTrip(server.node(), m_folder.path());

  const auto expectFailure =
      [](const Node& node, std::set<Reason> reasons, const std::string& words)
  {
    const NetworkError error = failure([&] { echo(node); });
    EXPECT_EQ(reasons.count(error.reason), 1U) << error.what();
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  };
  // By TLS 1.3 the node refuses after the handshake, and its reason may be lost with the
  // connection.
  const std::set<Reason> late{Reason::Tls, Reason::Cut};
  Node node = server.node();
  node.tls->authority = stranger.certificate();
  expectFailure(node, {Reason::Tls}, "not of a trusted authority");
  node = server.node();
  node.tls->authority.clear();
  expectFailure(node, {Reason::Tls}, "not of a trusted authority");
  node = server.node();
  node.tls->certificate = stranger.certificate();
  expectFailure(node, {Reason::Tls}, "is not the key of");
  node.tls->key = stranger.key();
  expectFailure(node, late, "the certificate of this program");
  node = server.node();
  node.tls->certificate.clear();
  node.tls->key.clear();
  expectFailure(node, late, "certificate of this program");
  node.tls.reset();
  node.timeouts.reply = std::chrono::seconds(5);
  expectFailure(node, {Reason::Cut}, "does it expect TLS?");
}

// Of the system's authorities everybody can have a certificate, but only for a host of his own.
TEST_F(OrthancNode, ComparesTheHostWithACertificateOfTheSystemsAuthorities)
{
  const Certificate client(m_folder.path(), "client");
  for (const char* name : {"localhost", "elsewhere.example"})
  {
    const fs::path folder = m_folder.path() / name;
    fs::create_directories(folder);
    const Certificate own(folder, name, std::string("DNS:") + name);
    const Orthanc server(folder, {&own, &client, 0, 0});
    ::setenv("SSL_CERT_FILE", own.certificate().c_str(), 1); // the system's, for OpenSSL
    Node node = server.node();
    node.host = "localhost";
    node.tls->authority.clear();
    if (std::string(name) == node.host)
      EXPECT_NO_THROW(echo(node));
    else
      EXPECT_EQ(failure([&] { echo(node); }).reason, Reason::Tls);
    ::unsetenv("SSL_CERT_FILE");
  }
}

TEST_F(OrthancNode, KeepsASeriesInPostgreSql)
{
  if (!fs::exists("/usr/share/orthanc/plugins/libOrthancPostgreSQLIndex.so"))
    GTEST_SKIP() << "Orthanc's plugin (package orthanc-postgresql) is not installed";
  std::string whyNot;
  const auto database = Postgres::start(m_folder.path(), whyNot);
  if (!database)
    GTEST_SKIP() << whyNot;
  const Orthanc server(m_folder.path(), {nullptr, nullptr, database->port(), 0});
  roundTrip(server.node(), m_folder.path());
}

TEST_F(OrthancNode, SendsByMoveWhereItAllowsNoGet)
{
  const Orthanc server(m_folder.path(), {nullptr, nullptr, 0, freePort()});
  roundTrip(server.node(), m_folder.path());
  Node node = server.node();
  node.movePort = 0;
  const std::string study = imaging::deterministicUid(7, "test study");
  EXPECT_EQ(failure([&] { retrieve(node, study, {}, m_folder.path() / "none"); }).reason,
            Reason::Cut)
      << "that is how it refuses";
  EXPECT_EQ(filesIn(m_folder.path() / "none"), 0U);
}

TEST_F(OrthancNode, SendsByMoveOverTls)
{
  const Certificate own(m_folder.path(), "server"), client(m_folder.path(), "client");
  const Orthanc server(m_folder.path(), {&own, &client, 0, freePort()});
  roundTrip(server.node(), m_folder.path());
}

TEST_F(OrthancNode, RefusesWrongTitlesByName)
{
  const Orthanc server(m_folder.path(), {});
  Node node = server.node();
  node.aeTitle = "NOBODY";
  NetworkError error = failure([&] { echo(node); });
  EXPECT_EQ(error.reason, Reason::Rejected);
  EXPECT_NE(std::string(error.what()).find("'NOBODY'"), std::string::npos) << error.what();
  node = server.node();
  node.port = freePort();
  error = failure([&] { echo(node); });
  EXPECT_EQ(error.reason, Reason::Unreachable);
  EXPECT_NE(std::string(error.what()).find(std::to_string(node.port)), std::string::npos);
}

TEST_F(OrthancNode, GoesOnAfterACut)
{
  const Orthanc server(m_folder.path(), {});
  const CtSeries ct(m_folder.path() / "ct", 256);
  Node node = server.node();
  {
    const BreakingProxy proxy(server.node().port, 600000, BreakingProxy::Fault::Cut, 2);
    node.port = proxy.port();
    const Transfer sent = store(node, ct.files);
    EXPECT_EQ(sent.completed, kSlices);
    EXPECT_EQ(sent.asked, 3U);
    EXPECT_EQ(proxy.broken(), 2);
  }
  {
    const BreakingProxy proxy(server.node().port, 600000, BreakingProxy::Fault::Cut, 2);
    node.port = proxy.port();
    const Transfer got = retrieve(node, ct.study, {}, m_folder.path() / "back");
    EXPECT_EQ(got.completed, kSlices);
    EXPECT_EQ(got.asked, 3U);
    EXPECT_EQ(proxy.broken(), 2);
  }
  ct.expectIn(m_folder.path() / "back");
}

TEST_F(OrthancNode, NamesACutThatStays)
{
  const Orthanc server(m_folder.path(), {});
  const CtSeries ct(m_folder.path() / "ct", 256);
  Node node = server.node();
  // Before a slice is through.
  const BreakingProxy proxy(server.node().port, 40000, BreakingProxy::Fault::Cut, 100);
  node.port = proxy.port();
  const std::string of = "0 of " + std::to_string(kSlices) + " instances ";
  NetworkError error = failure([&] { store(node, ct.files); });
  EXPECT_EQ(error.reason, Reason::Cut);
  EXPECT_NE(std::string(error.what()).find(of + "were confirmed"), std::string::npos)
      << error.what();
  store(server.node(), ct.files);
  error = failure([&] { retrieve(node, ct.study, {}, m_folder.path() / "back"); });
  EXPECT_EQ(error.reason, Reason::Cut);
  EXPECT_NE(std::string(error.what()).find(of + "arrived"), std::string::npos) << error.what();
  EXPECT_EQ(filesIn(m_folder.path() / "back"), 0U);
}

TEST_F(OrthancNode, EndsWhenTheServerFallsSilent)
{
  const Orthanc server(m_folder.path(), {});
  const CtSeries ct(m_folder.path() / "ct", 256);
  Node node = server.node();
  node.timeouts.reply = std::chrono::milliseconds(300);
  // Before a slice is through: what gets on is asked for again for as long as it gets on.
  const BreakingProxy proxy(server.node().port, 40000, BreakingProxy::Fault::Stall, 100);
  node.port = proxy.port();
  const NetworkError error = failure([&] { store(node, ct.files); });
  EXPECT_EQ(error.reason, Reason::TimedOut) << error.what();
}

TEST_F(OrthancNode, IsLeftWhenTheUserCancels)
{
  const Orthanc server(m_folder.path(), {});
  const CtSeries ct(m_folder.path() / "ct", 256);
  Node node = server.node(); // a minute until it is given up
  const BreakingProxy proxy(server.node().port, 300000, BreakingProxy::Fault::Stall, 100);
  node.port = proxy.port();
  const auto token = std::make_shared<core::CancelToken>();
  const core::Progress progress([](double, const std::string&) {}, token);
  std::thread user(
      [&]
      {
        waitFor([&] { return proxy.stalled(); });
        token->cancel();
      });
  EXPECT_THROW(store(node, ct.files, progress), core::CancelledError);
  user.join();
}

TEST_F(OrthancNode, KeepsASceneInParts)
{
  const Orthanc server(m_folder.path(), {});
  std::string content(300001, '\0');
  std::mt19937 random(3);
  for (char& c : content)
    c = static_cast<char>(random());
  const fs::path archive = m_folder.path() / "ear.petrous";
  std::ofstream(archive, std::ios::binary) << content;
  fs::create_directories(m_folder.path() / "parts");
  SceneDescription description;
  description.studyUid = imaging::deterministicUid(9, "study");
  const auto files = writeSceneObjects(archive, m_folder.path() / "parts", description, {}, 100000);
  ASSERT_EQ(files.size(), 4U);
  store(server.node(), files);
  const fs::path back = m_folder.path() / "back";
  EXPECT_EQ(retrieve(server.node(), description.studyUid, {}, back).completed, 4U);
  std::vector<fs::path> received;
  for (const auto& entry : fs::directory_iterator(back))
    received.push_back(entry.path());
  const fs::path restored = m_folder.path() / "restored.petrous";
  readSceneObjects(received, restored);
  std::ifstream stream(restored, std::ios::binary);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stream), {}), content);

  received.pop_back();
  fs::remove(restored);
  EXPECT_THROW(readSceneObjects(received, restored), core::InvalidParameter);
  EXPECT_FALSE(fs::exists(restored));
}

} // namespace petrous::network
