// Servers that do not do what they say: a service provider on DCMTK's low level, told how to fail;
// and a storage provider of an implementation of its own (CTN).
#include <algorithm>
#include <functional>
#include <map>
#include <sstream>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmnet/dimse.h>

#include <gtest/gtest.h>

#include "TestServers.h"
#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Network/DicomNode.h"

namespace petrous::network
{
namespace
{

using namespace test;
using Reason = NetworkError::Reason;

struct Behaviour
{
  std::string studyUid;
  std::string patientId = "P1";
  std::vector<fs::path> files; ///< that it lists
  int stated = -1;             ///< instances of the series; -1: those that it lists
  /// What it sends for request n (from 0) of these instances.
  std::function<std::vector<fs::path>(int request, const std::vector<std::string>& uids)> sends;
  DIC_US finalStatus = STATUS_Success;
  DIC_US storeStatus = STATUS_Success;
  bool silentToGet = false;
};

std::string valueOf(DcmItem& item, const DcmTagKey& key)
{
  OFString value;
  item.findAndGetOFStringArray(key, value);
  return value.c_str();
}

class FaultyServer
{
public:
  explicit FaultyServer(Behaviour behaviour)
    : m_behaviour(std::move(behaviour))
  {
    for (int attempt = 0; attempt < 5 && !m_network; ++attempt)
    {
      m_port = freePort();
      if (ASC_initializeNetwork(NET_ACCEPTOR, m_port, 30, &m_network).bad())
        m_network = nullptr;
    }
    if (!m_network)
      throw std::runtime_error("no free port");
    m_thread = std::thread([this] { run(); });
  }
  ~FaultyServer()
  {
    m_stop = true;
    m_thread.join();
    ASC_dropNetwork(&m_network);
  }

  Node node() const
  {
    Node node;
    node.name = "faulty";
    node.host = "127.0.0.1";
    node.port = m_port;
    node.aeTitle = "FAULTY";
    return node;
  }
  int requests() const { return m_requests; }

private:
  void run()
  {
    while (!m_stop)
    {
      if (!ASC_associationWaiting(m_network, 0))
      {
        pollfd none{-1, 0, 0};
        ::poll(&none, 1, 5);
        continue;
      }
      T_ASC_Association* association = nullptr;
      if (ASC_receiveAssociation(m_network, &association, ASC_DEFAULTMAXPDU).good())
        serve(association);
      ASC_dropSCPAssociation(association, 0);
      ASC_destroyAssociation(&association);
    }
  }

  void serve(T_ASC_Association* association)
  {
    for (int n = 0; n < ASC_countPresentationContexts(association->params); ++n)
    {
      T_ASC_PresentationContext context;
      ASC_getPresentationContext(association->params, n, &context);
      ASC_acceptPresentationContext(association->params, context.presentationContextID,
                                    context.proposedTransferSyntaxes[0], context.proposedRole);
    }
    if (ASC_acknowledgeAssociation(association).bad())
      return;
    while (!m_stop)
    {
      T_ASC_PresentationContextID id = 0;
      T_DIMSE_Message message{};
      DcmDataset* detail = nullptr;
      const OFCondition result =
          DIMSE_receiveCommand(association, DIMSE_NONBLOCKING, 1, &id, &message, &detail);
      delete detail;
      if (result == DIMSE_NODATAAVAILABLE)
        continue;
      if (result == DUL_PEERREQUESTEDRELEASE)
        ASC_acknowledgeRelease(association);
      if (result.bad())
        return;
      if (message.CommandField == DIMSE_C_FIND_RQ)
        find(association, id, message.msg.CFindRQ);
      else if (message.CommandField == DIMSE_C_GET_RQ)
        get(association, id, message.msg.CGetRQ);
      else if (message.CommandField == DIMSE_C_STORE_RQ)
        store(association, id, message.msg.CStoreRQ);
    }
  }

  static std::unique_ptr<DcmDataset> query(T_ASC_Association* association)
  {
    T_ASC_PresentationContextID id = 0;
    DcmDataset* data = nullptr;
    DIMSE_receiveDataSetInMemory(association, DIMSE_BLOCKING, 0, &id, &data, nullptr, nullptr);
    return std::unique_ptr<DcmDataset>(data);
  }

  void find(T_ASC_Association* association, T_ASC_PresentationContextID id,
            const T_DIMSE_C_FindRQ& request)
  {
    const auto asked = query(association);
    const std::string level = valueOf(*asked, DCM_QueryRetrieveLevel);
    T_DIMSE_C_FindRSP response{};
    response.MessageIDBeingRespondedTo = request.MessageID;
    const auto answer = [&](DcmDataset& data)
    {
      response.DimseStatus = STATUS_Pending;
      response.DataSetType = DIMSE_DATASET_PRESENT;
      DIMSE_sendFindResponse(association, id, &request, &response, &data, nullptr);
    };
    std::map<std::string, int> series;
    for (const fs::path& path : m_behaviour.files)
    {
      DcmFileFormat file;
      file.loadFile(path.c_str());
      DcmDataset& data = *file.getDataset();
      ++series[valueOf(data, DCM_SeriesInstanceUID)];
      if (level != "IMAGE")
        continue;
      DcmDataset one;
      for (const DcmTagKey& key : {DCM_SOPInstanceUID, DCM_SOPClassUID})
        one.putAndInsertString(key, valueOf(data, key).c_str());
      answer(one);
    }
    if (level == "STUDY")
    {
      DcmDataset one;
      one.putAndInsertString(DCM_StudyInstanceUID, m_behaviour.studyUid.c_str());
      one.putAndInsertString(DCM_PatientID, m_behaviour.patientId.c_str());
      answer(one);
    }
    if (level == "SERIES")
      for (const auto& [uid, count] : series)
      {
        DcmDataset one;
        one.putAndInsertString(DCM_SeriesInstanceUID, uid.c_str());
        const int stated = m_behaviour.stated < 0 ? count : m_behaviour.stated;
        one.putAndInsertString(DCM_NumberOfSeriesRelatedInstances, std::to_string(stated).c_str());
        answer(one);
      }
    response.DimseStatus = STATUS_Success;
    response.DataSetType = DIMSE_DATASET_NULL;
    DIMSE_sendFindResponse(association, id, &request, &response, nullptr, nullptr);
  }

  void get(T_ASC_Association* association, T_ASC_PresentationContextID id,
           const T_DIMSE_C_GetRQ& request)
  {
    const auto asked = query(association);
    std::vector<std::string> uids;
    std::istringstream list(valueOf(*asked, DCM_SOPInstanceUID));
    for (std::string uid; std::getline(list, uid, '\\');)
      uids.push_back(uid);
    const int number = m_requests++;
    if (m_behaviour.silentToGet)
      return;
    for (const fs::path& path : m_behaviour.sends(number, uids))
    {
      DcmFileFormat file;
      file.loadFile(path.c_str());
      T_DIMSE_C_StoreRQ store{};
      store.MessageID = association->nextMsgID++;
      store.DataSetType = DIMSE_DATASET_PRESENT;
      OFStandard::strlcpy(store.AffectedSOPClassUID, UID_CTImageStorage,
                          sizeof store.AffectedSOPClassUID);
      OFStandard::strlcpy(store.AffectedSOPInstanceUID,
                          valueOf(*file.getDataset(), DCM_SOPInstanceUID).c_str(),
                          sizeof store.AffectedSOPInstanceUID);
      T_DIMSE_C_StoreRSP response{};
      DcmDataset* detail = nullptr;
      const auto context = ASC_findAcceptedPresentationContextID(association, UID_CTImageStorage);
      if (DIMSE_storeUser(association, context, &store, nullptr, file.getDataset(), nullptr,
                          nullptr, DIMSE_NONBLOCKING, 10, &response, &detail)
              .bad())
        return;
      delete detail;
    }
    T_DIMSE_C_GetRSP response{};
    response.MessageIDBeingRespondedTo = request.MessageID;
    response.DataSetType = DIMSE_DATASET_NULL;
    response.DimseStatus = m_behaviour.finalStatus;
    response.opts = O_GET_NUMBEROFCOMPLETEDSUBOPERATIONS; // whatever was sent
    response.NumberOfCompletedSubOperations = static_cast<DIC_US>(m_behaviour.files.size());
    DIMSE_sendGetResponse(association, id, &request, &response, nullptr, nullptr);
  }

  void store(T_ASC_Association* association, T_ASC_PresentationContextID id,
             const T_DIMSE_C_StoreRQ& request)
  {
    query(association);
    T_DIMSE_C_StoreRSP response{};
    response.MessageIDBeingRespondedTo = request.MessageID;
    response.DataSetType = DIMSE_DATASET_NULL;
    response.DimseStatus = m_behaviour.storeStatus;
    DIMSE_sendStoreResponse(association, id, &request, &response, nullptr);
  }

  Behaviour m_behaviour;
  int m_port = 0;
  T_ASC_Network* m_network = nullptr;
  std::atomic<bool> m_stop{false};
  std::atomic<int> m_requests{0};
  std::thread m_thread;
};

class FaultyNode : public ::testing::Test
{
protected:
  void SetUp() override
  {
    m_files = series("SERIES", "P1");
    m_behaviour.studyUid = m_study;
    m_behaviour.files = m_files;
    m_behaviour.sends = [this](int, const std::vector<std::string>& uids) { return asked(uids); };
  }

  std::vector<fs::path> series(const std::string& role, const std::string& patient,
                               const std::string& study = {})
  {
    const core::GridGeometry grid({16, 16, 10}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero());
    imaging::SeriesDescription description;
    description.studyUid = study.empty() ? m_study : study;
    description.seriesUid = imaging::deterministicUid(8, role);
    description.frameOfReferenceUid = imaging::deterministicUid(8, "frame");
    description.patientId = patient;
    const fs::path folder = m_folder.path() / (role + patient);
    imaging::writeDicomSeries(
        folder, volume::IntensityVolume(std::make_shared<const volume::Volume<std::int16_t>>(grid)),
        description);
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder))
      files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
  }

  /// Of m_files: those with these UIDs, or all.
  std::vector<fs::path> asked(const std::vector<std::string>& uids) const
  {
    std::vector<fs::path> result;
    for (const fs::path& path : m_files)
    {
      DcmFileFormat file;
      file.loadFile(path.c_str());
      const std::string uid = valueOf(*file.getDataset(), DCM_SOPInstanceUID);
      if (uids.empty() || std::find(uids.begin(), uids.end(), uid) != uids.end())
        result.push_back(path);
    }
    return result;
  }

  template <class Action>
  static NetworkError failure(const Action& action)
  {
    try
    {
      action();
    }
    catch (const NetworkError& error)
    {
      const std::string text = error.what();
      EXPECT_EQ(text.find("2.25."), std::string::npos) << text;
      EXPECT_NE(text.find("'faulty'"), std::string::npos) << text;
      return error;
    }
    ADD_FAILURE() << "nothing was thrown";
    return {Reason::Protocol, ""};
  }

  NetworkError retrieveFailure(const Node& node) const
  {
    return failure([&] { retrieve(node, m_study, {}, m_folder.path() / "back"); });
  }

  TemporaryFolder m_folder;
  std::string m_study = imaging::deterministicUid(8, "study");
  std::vector<fs::path> m_files;
  Behaviour m_behaviour;
};

} // namespace

TEST_F(FaultyNode, ThatIsInOrderGivesEverything)
{
  const FaultyServer server(m_behaviour);
  const Transfer got = retrieve(server.node(), m_study, {}, m_folder.path() / "back");
  EXPECT_EQ(got.completed, 10U);
  EXPECT_EQ(server.requests(), 1);
}

TEST_F(FaultyNode, IsAskedAgainForTheHalfThatItDidNotSend)
{
  m_behaviour.sends = [this](int, const std::vector<std::string>& uids)
  {
    auto files = asked(uids);
    files.resize((files.size() + 1) / 2);
    return files;
  };
  const FaultyServer server(m_behaviour);
  const Transfer got = retrieve(server.node(), m_study, {}, m_folder.path() / "back");
  EXPECT_EQ(got.completed, 10U);
  EXPECT_EQ(server.requests(), 4) << "5, 3, 1 and 1";
}

TEST_F(FaultyNode, ThatClaimsToHaveSentAllIsNotBelieved)
{
  m_behaviour.sends = [this](int request, const std::vector<std::string>& uids)
  {
    auto files = asked(uids);
    files.resize(request == 0 ? 7 : 0);
    return files;
  };
  const FaultyServer server(m_behaviour);
  const NetworkError error = retrieveFailure(server.node());
  EXPECT_EQ(error.reason, Reason::Incomplete);
  EXPECT_NE(std::string(error.what()).find("7 of 10 instances"), std::string::npos) << error.what();
}

TEST_F(FaultyNode, ThatListsFewerThanItStatesIsNamed)
{
  m_behaviour.stated = 12;
  const FaultyServer server(m_behaviour);
  const NetworkError error = retrieveFailure(server.node());
  EXPECT_EQ(error.reason, Reason::Incomplete);
  EXPECT_NE(std::string(error.what()).find("12 instances"), std::string::npos) << error.what();
  EXPECT_EQ(server.requests(), 0);
}

TEST_F(FaultyNode, ThatSendsAnotherPatientsSlicesIsRefused)
{
  const auto other = series("SERIES", "P2");
  m_behaviour.sends = [this, other](int, const std::vector<std::string>& uids)
  {
    auto files = asked(uids);
    files[4] = other[4];
    return files;
  };
  {
    const FaultyServer server(m_behaviour);
    EXPECT_EQ(retrieveFailure(server.node()).reason, Reason::Foreign);
  }
  const auto study = series("SERIES", "P1x", imaging::deterministicUid(8, "another study"));
  m_behaviour.sends = [study](int, const std::vector<std::string>&) { return study; };
  {
    const FaultyServer server(m_behaviour);
    EXPECT_EQ(retrieveFailure(server.node()).reason, Reason::Foreign);
  }
  const auto another = series("OTHER", "P1");
  m_behaviour.sends = [another](int, const std::vector<std::string>&) { return another; };
  const FaultyServer server(m_behaviour);
  EXPECT_EQ(retrieveFailure(server.node()).reason, Reason::Foreign);
}

// Two hospitals number their patients alike.
TEST_F(FaultyNode, ThatMixesPatientsOfOneIdIsRefusedOrToldOf)
{
  const auto state = [](const fs::path& path, const DcmTagKey& key, const char* value)
  {
    DcmFileFormat file;
    ASSERT_TRUE(file.loadFile(path.c_str()).good());
    file.loadAllDataIntoMemory();
    file.getDataset()->putAndInsertString(key, value);
    ASSERT_TRUE(file.saveFile(path.c_str(), EXS_LittleEndianExplicit).good());
  };
  const auto reason = [this]
  {
    fs::remove_all(m_folder.path() / "back");
    const FaultyServer server(m_behaviour);
    return retrieveFailure(server.node()).reason;
  };
  const auto otherNames = [this]
  {
    fs::remove_all(m_folder.path() / "back");
    const FaultyServer server(m_behaviour);
    const Transfer got = retrieve(server.node(), m_study, {}, m_folder.path() / "back");
    EXPECT_EQ(got.completed, 10U);
    return got.otherNames;
  };
  for (const fs::path& file : m_files)
    for (const auto& [key, value] :
         {std::pair(DCM_IssuerOfPatientID, "NORTH"), std::pair(DCM_PatientBirthDate, "19600101"),
          std::pair(DCM_PatientName, "Doe^Jane")})
      state(file, key, value);
  EXPECT_EQ(otherNames(), 0U);
  state(m_files[4], DCM_PatientName, "DOE^JANE^^");
  state(m_files[5], DCM_PatientBirthDate, "");
  EXPECT_EQ(otherNames(), 0U) << "the same, written otherwise or not stated";
  state(m_files[4], DCM_PatientName, "Roe^Rick");
  EXPECT_EQ(otherNames(), 1U);
  state(m_files[6], DCM_PatientBirthDate, "19610101");
  EXPECT_EQ(reason(), Reason::Foreign);
  state(m_files[6], DCM_PatientBirthDate, "19600101");
  state(m_files[7], DCM_IssuerOfPatientID, "SOUTH");
  EXPECT_EQ(reason(), Reason::Foreign);
}

TEST_F(FaultyNode, ThatRefusesIsQuotedByItsStatus)
{
  m_behaviour.sends = [](int, const std::vector<std::string>&) { return std::vector<fs::path>(); };
  m_behaviour.finalStatus = 0xA702;
  const FaultyServer server(m_behaviour);
  const NetworkError error = retrieveFailure(server.node());
  EXPECT_EQ(error.reason, Reason::Failed);
  EXPECT_NE(std::string(error.what()).find("A702"), std::string::npos) << error.what();
}

TEST_F(FaultyNode, ThatDoesNotAnswerIsLeft)
{
  m_behaviour.silentToGet = true;
  const FaultyServer server(m_behaviour);
  Node node = server.node();
  node.timeouts.reply = std::chrono::milliseconds(200);
  EXPECT_EQ(retrieveFailure(node).reason, Reason::TimedOut);
}

TEST_F(FaultyNode, ThatRefusesToStoreIsNamed)
{
  m_behaviour.files.clear();
  m_behaviour.storeStatus = 0xA700;
  const FaultyServer server(m_behaviour);
  const NetworkError error = failure([&] { store(server.node(), m_files); });
  EXPECT_EQ(error.reason, Reason::Incomplete);
  EXPECT_NE(std::string(error.what()).find("A700"), std::string::npos) << error.what();
  EXPECT_NE(std::string(error.what()).find("0 of 10"), std::string::npos) << error.what();
}

TEST_F(FaultyNode, ThatConfirmsWhatItDoesNotKeepIsNotBelieved)
{
  m_behaviour.files.resize(6);
  const FaultyServer server(m_behaviour);
  const NetworkError error = failure([&] { store(server.node(), m_files); });
  EXPECT_EQ(error.reason, Reason::Incomplete);
  EXPECT_NE(std::string(error.what()).find("6 of 10 instances"), std::string::npos) << error.what();
  EXPECT_NE(std::string(error.what()).find("although it confirmed"), std::string::npos)
      << error.what();
}

TEST_F(FaultyNode, ThatIsNoDicomServerIsNamed)
{
  int port = 0;
  const int listener = listenOn(0, port);
  std::thread server(
      [listener]
      {
        const int client = ::accept(listener, nullptr, nullptr);
        const std::string answer = "HTTP/1.1 400 Bad Request\r\n\r\n";
        [[maybe_unused]] const ssize_t sent =
            ::send(client, answer.data(), answer.size(), MSG_NOSIGNAL);
        pollfd closed{client, POLLRDHUP, 0};
        ::poll(&closed, 1, 10000);
        ::close(client);
      });
  Node node;
  node.name = "faulty";
  node.host = "127.0.0.1";
  node.port = port;
  node.aeTitle = "WEB";
  EXPECT_EQ(failure([&] { echo(node); }).reason, Reason::Protocol);
  server.join();
  ::close(listener);
}

TEST(CentralTestNode, KeepsASeries)
{
  const std::string program = "/usr/bin/simple_storage";
  if (!fs::exists(program))
    GTEST_SKIP() << "the Central Test Node (package ctn) is not installed";
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "kept");
  const core::GridGeometry grid({32, 32, 10}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero());
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid);
  for (std::size_t i = 0; i < voxels->size(); ++i)
    voxels->data()[i] = static_cast<std::int16_t>(i * 7 % 3000);
  imaging::SeriesDescription description;
  description.studyUid = imaging::deterministicUid(4, "study");
  description.seriesUid = imaging::deterministicUid(4, "series");
  description.frameOfReferenceUid = imaging::deterministicUid(4, "frame");
  imaging::writeDicomSeries(
      folder.path() / "ct",
      volume::IntensityVolume(std::shared_ptr<const volume::Volume<std::int16_t>>(voxels)),
      description);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder.path() / "ct"))
    files.push_back(entry.path());

  Node node;
  node.name = "ctn";
  node.host = "127.0.0.1";
  node.port = freePort();
  node.aeTitle = "CTN";
  ServerProcess server({program, "-s", "-c", node.aeTitle, "-x", (folder.path() / "kept").string(),
                        std::to_string(node.port)},
                       folder.path() / "log");
  // It takes one connection at a time, and does not survive one without an association.
  const auto answers = [&]
  {
    try
    {
      echo(node);
      return true;
    }
    catch (const NetworkError&)
    {
      return !server.running();
    }
  };
  ASSERT_TRUE(waitFor(answers));
  ASSERT_TRUE(server.running());
  const Transfer sent = store(node, files);
  EXPECT_EQ(sent.completed, 10U);
  EXPECT_FALSE(sent.verified) << "it answers no queries";
  // Each slice's voxels are in a file, in whatever form it keeps them.
  std::string all;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path() / "kept"))
    if (entry.is_regular_file())
    {
      std::ifstream stream(entry.path(), std::ios::binary);
      all.append(std::istreambuf_iterator<char>(stream), {});
    }
  for (int k = 0; k < 10; ++k)
  {
    const std::string slice(reinterpret_cast<const char*>(&voxels->at(0, 0, k)), 2 * 32 * 32);
    EXPECT_NE(all.find(slice), std::string::npos) << k;
  }
}

} // namespace petrous::network
