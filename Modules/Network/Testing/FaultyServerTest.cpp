// Servers that do not do what they say: a service provider on DCMTK's low level, told how to fail;
// and a storage provider of an implementation of its own (CTN).
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <sstream>
#include <thread>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmnet/dimse.h>
#include <dcmtk/dcmtls/tlslayer.h>

#include <arpa/inet.h>
#include <openssl/ssl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "../src/Client/Association.h"
#include "../src/Client/PduChecker.h"
#include "TestServers.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Network/DicomNode.h"

namespace
{

std::atomic<int> g_syncDelay{0}; // ms for which each fsync takes longer: of a slow disk

}

extern "C" int fsync(int descriptor)
{
  if (const int delay = g_syncDelay)
    std::this_thread::sleep_for(std::chrono::milliseconds(delay));
  return static_cast<int>(::syscall(SYS_fsync, descriptor));
}

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
  int statedOfStudy = -1;   ///< instances; -1: it does not say
  bool returnsClass = true; ///< of instances
  bool returnsKeys = false; ///< of study and series, which it ignores
  /// What it lists to query n (from 0) of instances; without: `files`.
  std::function<std::vector<fs::path>(int query)> lists;
  std::function<bool(int query)> cuts; ///< the connection, when asked for instances
  int answers = 1;                     ///< as often to each query of studies
  // C-MOVE: what it sends comes to this port.
  int movePort = 0;
  std::string moveTitle = "FAULTY";
  bool silentFirst = false; ///< another connection, which says nothing, before its own
  // TLS, if there is a certificate; from a client with one of `client` only, if that is given.
  const Certificate* own = nullptr;
  const Certificate* client = nullptr;
  /// Associations are served side by side; otherwise the next one waits for the end of the first.
  bool manyAtOnce = false;
  /// Answer to the instance `number` (from 0) that comes over the second association; nullopt: it
  /// is cut.
  std::function<std::optional<DIC_US>(int number)> second;
  int latestTls = 0; ///< TLS1_1_VERSION; 0: any
  std::string ciphers;
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
    if (m_behaviour.own)
      secure();
    m_thread = std::thread([this] { run(); });
  }
  ~FaultyServer()
  {
    m_stop = true;
    m_thread.join();
    for (std::thread& served : m_served)
      served.join();
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
  struct Stored
  {
    int association;
    DIC_US status;
  };
  /// By instance, in the order in which they came.
  std::map<std::string, std::vector<Stored>> stored() const
  {
    const std::lock_guard<std::mutex> lock(m_storedMutex);
    return m_stored;
  }
  int associations() const
  {
    return m_associations;
  } ///< that were asked for, whatever became of it

private:
  void secure()
  {
    DcmTLSTransportLayer::initializeOpenSSL();
    auto layer = std::make_unique<DcmTLSTransportLayer>(NET_ACCEPTOR, nullptr, OFFalse);
    layer->setTLSProfile(TSP_Profile_BCP195_ND);
    layer->activateCipherSuites();
    layer->setPrivateKeyFile(m_behaviour.own->key().c_str(), DCF_Filetype_PEM);
    layer->setCertificateFile(m_behaviour.own->certificate().c_str(), DCF_Filetype_PEM);
    if (m_behaviour.client)
      layer->addTrustedCertificateFile(m_behaviour.client->certificate().c_str(), DCF_Filetype_PEM);
    layer->setCertificateVerification(m_behaviour.client ? DCV_requireCertificate
                                                         : DCV_ignoreCertificate);
    SSL_CTX* context = layer->getNativeHandle();
    if (m_behaviour.latestTls != 0)
    {
      SSL_CTX_set_security_level(context, 0); // else OpenSSL itself refuses it
      SSL_CTX_clear_options(context, SSL_OP_NO_TLSv1 | SSL_OP_NO_TLSv1_1);
      SSL_CTX_set_min_proto_version(context, TLS1_VERSION);
      SSL_CTX_set_max_proto_version(context, m_behaviour.latestTls);
    }
    if (!m_behaviour.ciphers.empty())
      SSL_CTX_set_cipher_list(context, m_behaviour.ciphers.c_str());
    m_layer = std::move(layer);
    ASC_setTransportLayer(m_network, m_layer.get(), 0);
  }

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
      if (ASC_receiveAssociation(m_network, &association, ASC_DEFAULTMAXPDU, nullptr, nullptr,
                                 m_layer ? OFTrue : OFFalse)
              .good())
      {
        const int number = m_associations++;
        if (m_behaviour.manyAtOnce)
        {
          m_served.emplace_back(
              [this, association, number]
              {
                serve(association, number);
                drop(association);
              });
          continue;
        }
        serve(association, number);
      }
      drop(association);
    }
  }

  static void drop(T_ASC_Association* association)
  {
    ASC_dropSCPAssociation(association, 0);
    ASC_destroyAssociation(&association);
  }

  void serve(T_ASC_Association* association, int number)
  {
    int stored = 0;
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
      if (message.CommandField == DIMSE_C_ECHO_RQ)
        DIMSE_sendEchoResponse(association, id, &message.msg.CEchoRQ, STATUS_Success, nullptr);
      else if (message.CommandField == DIMSE_C_FIND_RQ)
      {
        if (!find(association, id, message.msg.CFindRQ))
        {
          ASC_abortAssociation(association);
          return;
        }
      }
      else if (message.CommandField == DIMSE_C_MOVE_RQ)
        move(association, id, message.msg.CMoveRQ);
      else if (message.CommandField == DIMSE_C_GET_RQ)
      {
        if (!get(association, id, message.msg.CGetRQ))
          return;
      }
      else if (message.CommandField == DIMSE_C_STORE_RQ)
      {
        const auto status = number == 1 && m_behaviour.second
                                ? m_behaviour.second(stored++)
                                : std::optional<DIC_US>(m_behaviour.storeStatus);
        if (!status)
        {
          ASC_abortAssociation(association);
          return;
        }
        store(association, id, message.msg.CStoreRQ, number, *status);
      }
    }
  }

  static std::unique_ptr<DcmDataset> query(T_ASC_Association* association)
  {
    T_ASC_PresentationContextID id = 0;
    DcmDataset* data = nullptr;
    DIMSE_receiveDataSetInMemory(association, DIMSE_BLOCKING, 0, &id, &data, nullptr, nullptr);
    return std::unique_ptr<DcmDataset>(data);
  }

  /// False to cut the connection.
  bool find(T_ASC_Association* association, T_ASC_PresentationContextID id,
            const T_DIMSE_C_FindRQ& request)
  {
    const auto asked = query(association);
    const std::string level = valueOf(*asked, DCM_QueryRetrieveLevel);
    const int number = level == "IMAGE" ? m_queries++ : -1;
    if (number >= 0 && m_behaviour.cuts && m_behaviour.cuts(number))
      return false;
    T_DIMSE_C_FindRSP response{};
    response.MessageIDBeingRespondedTo = request.MessageID;
    const auto answer = [&](DcmDataset& data)
    {
      response.DimseStatus = STATUS_Pending;
      response.DataSetType = DIMSE_DATASET_PRESENT;
      DIMSE_sendFindResponse(association, id, &request, &response, &data, nullptr);
    };
    std::map<std::string, int> series;
    for (const fs::path& path :
         number >= 0 && m_behaviour.lists ? m_behaviour.lists(number) : m_behaviour.files)
    {
      DcmFileFormat file;
      file.loadFile(path.c_str());
      DcmDataset& data = *file.getDataset();
      ++series[valueOf(data, DCM_SeriesInstanceUID)];
      if (level != "IMAGE")
        continue;
      DcmDataset one;
      one.putAndInsertString(DCM_SOPInstanceUID, valueOf(data, DCM_SOPInstanceUID).c_str());
      if (m_behaviour.returnsClass)
        one.putAndInsertString(DCM_SOPClassUID, valueOf(data, DCM_SOPClassUID).c_str());
      if (m_behaviour.returnsKeys)
        for (const DcmTagKey& key : {DCM_StudyInstanceUID, DCM_SeriesInstanceUID})
          one.putAndInsertString(key, valueOf(data, key).c_str());
      answer(one);
    }
    if (level == "STUDY")
    {
      DcmDataset one;
      one.putAndInsertString(DCM_StudyInstanceUID, m_behaviour.studyUid.c_str());
      one.putAndInsertString(DCM_PatientID, m_behaviour.patientId.c_str());
      if (m_behaviour.statedOfStudy >= 0)
        one.putAndInsertString(DCM_NumberOfStudyRelatedInstances,
                               std::to_string(m_behaviour.statedOfStudy).c_str());
      for (int n = 0; n < m_behaviour.answers; ++n)
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
    return true;
  }

  void move(T_ASC_Association* association, T_ASC_PresentationContextID id,
            const T_DIMSE_C_MoveRQ& request)
  {
    query(association);
    const int silent = m_behaviour.silentFirst ? connectTo(m_behaviour.movePort) : -1;
    T_ASC_Network* network = nullptr;
    T_ASC_Parameters* parameters = nullptr;
    T_ASC_Association* other = nullptr;
    ASC_initializeNetwork(NET_REQUESTOR, 0, 30, &network);
    ASC_createAssociationParameters(&parameters, ASC_DEFAULTMAXPDU);
    ASC_setAPTitles(parameters, m_behaviour.moveTitle.c_str(), request.MoveDestination, nullptr);
    ASC_setPresentationAddresses(parameters, "localhost",
                                 ("127.0.0.1:" + std::to_string(m_behaviour.movePort)).c_str());
    const char* syntax = UID_LittleEndianExplicitTransferSyntax;
    ASC_addPresentationContext(parameters, 1, UID_CTImageStorage, &syntax, 1);
    DIC_US status = 0xA702;
    if (ASC_requestAssociation(network, parameters, &other).good() &&
        sendAll(other, m_behaviour.sends(m_requests++, {})))
    {
      ASC_releaseAssociation(other);
      status = STATUS_Success;
    }
    ASC_destroyAssociation(&other);
    ASC_dropNetwork(&network);
    if (silent >= 0)
      ::close(silent);
    T_DIMSE_C_MoveRSP response{};
    response.MessageIDBeingRespondedTo = request.MessageID;
    response.DataSetType = DIMSE_DATASET_NULL;
    response.DimseStatus = status;
    DIMSE_sendMoveResponse(association, id, &request, &response, nullptr, nullptr);
  }

  static bool sendAll(T_ASC_Association* association, const std::vector<fs::path>& files)
  {
    for (const fs::path& path : files)
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
        return false;
      delete detail;
    }
    return true;
  }

  /// False if the connection is lost.
  bool get(T_ASC_Association* association, T_ASC_PresentationContextID id,
           const T_DIMSE_C_GetRQ& request)
  {
    const auto asked = query(association);
    std::vector<std::string> uids;
    std::istringstream list(valueOf(*asked, DCM_SOPInstanceUID));
    for (std::string uid; std::getline(list, uid, '\\');)
      uids.push_back(uid);
    const int number = m_requests++;
    if (m_behaviour.silentToGet)
      return true;
    if (!sendAll(association, m_behaviour.sends(number, uids)))
      return false;
    T_DIMSE_C_GetRSP response{};
    response.MessageIDBeingRespondedTo = request.MessageID;
    response.DataSetType = DIMSE_DATASET_NULL;
    response.DimseStatus = m_behaviour.finalStatus;
    response.opts = O_GET_NUMBEROFCOMPLETEDSUBOPERATIONS; // whatever was sent
    response.NumberOfCompletedSubOperations = static_cast<DIC_US>(m_behaviour.files.size());
    DIMSE_sendGetResponse(association, id, &request, &response, nullptr, nullptr);
    return true;
  }

  void store(T_ASC_Association* association, T_ASC_PresentationContextID id,
             const T_DIMSE_C_StoreRQ& request, int number, DIC_US status)
  {
    query(association);
    {
      const std::lock_guard<std::mutex> lock(m_storedMutex);
      m_stored[request.AffectedSOPInstanceUID].push_back({number, status});
    }
    T_DIMSE_C_StoreRSP response{};
    response.MessageIDBeingRespondedTo = request.MessageID;
    response.DataSetType = DIMSE_DATASET_NULL;
    response.DimseStatus = status;
    DIMSE_sendStoreResponse(association, id, &request, &response, nullptr);
  }

  Behaviour m_behaviour;
  int m_port = 0;
  T_ASC_Network* m_network = nullptr;
  std::atomic<bool> m_stop{false};
  std::atomic<int> m_requests{0}, m_associations{0};
  int m_queries = 0; ///< of instances
  mutable std::mutex m_storedMutex;
  std::map<std::string, std::vector<Stored>> m_stored;
  std::vector<std::thread> m_served;
  std::unique_ptr<DcmTLSTransportLayer> m_layer;
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
                               const std::string& study = {}, int count = 10)
  {
    const core::GridGeometry grid({16, 16, count}, Eigen::Vector3d::Ones(),
                                  Eigen::Vector3d::Zero());
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

// The class of an instance is an optional key of a query.
TEST_F(FaultyNode, ThatDoesNotSayTheClassesGivesEverything)
{
  m_behaviour.returnsClass = false;
  const FaultyServer server(m_behaviour);
  EXPECT_EQ(retrieve(server.node(), m_study, {}, m_folder.path() / "back").completed, 10U);
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

// Nobody accepts the connection that the system's queue took.
TEST_F(FaultyNode, ThatDoesNotAcceptTheAssociationIsLeftSooner)
{
  const int silent = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ASSERT_EQ(::bind(silent, reinterpret_cast<const sockaddr*>(&address), size), 0);
  ASSERT_EQ(::listen(silent, 8), 0);
  ::getsockname(silent, reinterpret_cast<sockaddr*>(&address), &size);
  Node node;
  node.name = "faulty";
  node.host = "127.0.0.1";
  node.port = ntohs(address.sin_port);
  node.aeTitle = "SILENT";
  node.timeouts.reply = std::chrono::hours(1);
  node.timeouts.accept = std::chrono::milliseconds(200);
  const NetworkError error = failure([&] { echo(node); });
  EXPECT_EQ(error.reason, Reason::TimedOut);
  EXPECT_NE(std::string(error.what()).find("is it a DICOM node"), std::string::npos)
      << error.what();
  ::close(silent);
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

class BusyNode : public FaultyNode
{
protected:
  void SetUp() override
  {
    FaultyNode::SetUp();
    m_files = series("MANY", "P1", {}, 60);
    m_behaviour.lists = [this](int query)
    { return query == 0 ? std::vector<fs::path>() : m_files; };
  }

  /// Each instance once with success, and how many over the second association.
  static int overTheSecond(const FaultyServer& server)
  {
    int count = 0;
    const auto stored = server.stored();
    EXPECT_EQ(stored.size(), 60U);
    for (const auto& [uid, times] : stored)
    {
      int confirmed = 0;
      for (const auto& time : times)
      {
        confirmed += time.status == STATUS_Success ? 1 : 0;
        count += time.status == STATUS_Success && time.association == 1 ? 1 : 0;
      }
      EXPECT_EQ(confirmed, 1);
    }
    return count;
  }
};

TEST_F(BusyNode, IsSentToOverTwoAssociations)
{
  m_behaviour.manyAtOnce = true;
  const FaultyServer server(m_behaviour);
  const Transfer sent = store(server.node(), m_files);
  EXPECT_EQ(sent.completed, 60U);
  EXPECT_EQ(sent.asked, 1U);
  EXPECT_EQ(sent.warning, 0U);
  std::uintmax_t bytes = 0;
  for (const fs::path& file : m_files)
    bytes += fs::file_size(file);
  EXPECT_EQ(sent.bytes, bytes);
  EXPECT_EQ(server.associations(), 2);
  EXPECT_GT(overTheSecond(server), 5);
}

TEST_F(BusyNode, ThatServesOneAssociationAtATimeGetsAllOverIt)
{
  const FaultyServer server(m_behaviour);
  const Transfer sent = store(server.node(), m_files);
  EXPECT_EQ(sent.completed, 60U);
  EXPECT_EQ(sent.asked, 1U);
  EXPECT_TRUE(sent.verified);
  EXPECT_EQ(overTheSecond(server), 0);
}

TEST_F(BusyNode, ThatCutsTheSecondAssociationGetsTheRestOverTheFirst)
{
  m_behaviour.manyAtOnce = true;
  m_behaviour.second = [](int number)
  { return number < 3 ? std::optional<DIC_US>(STATUS_Success) : std::nullopt; };
  const FaultyServer server(m_behaviour);
  const Transfer sent = store(server.node(), m_files);
  EXPECT_EQ(sent.completed, 60U);
  EXPECT_EQ(sent.asked, 1U);
  EXPECT_EQ(overTheSecond(server), 3);
}

TEST_F(BusyNode, ThatRefusesOverTheSecondAssociationIsAskedOverTheFirst)
{
  m_behaviour.manyAtOnce = true;
  m_behaviour.second = [](int number)
  { return std::optional<DIC_US>(number == 0 ? 0xB000 : 0xA700); };
  const FaultyServer server(m_behaviour);
  const Transfer sent = store(server.node(), m_files);
  EXPECT_EQ(sent.completed, 60U);
  EXPECT_EQ(sent.warning, 1U);
  const auto stored = server.stored();
  const auto refused =
      std::count_if(stored.begin(), stored.end(),
                    [](const auto& instance) { return instance.second.front().status == 0xA700; });
  EXPECT_EQ(refused, 1) << "the second association goes on";
}

TEST_F(BusyNode, ThatRefusesEverythingIsNamed)
{
  m_behaviour.manyAtOnce = true;
  m_behaviour.storeStatus = 0xA700;
  m_behaviour.lists = [](int) { return std::vector<fs::path>(); };
  const FaultyServer server(m_behaviour);
  const NetworkError error = failure([&] { store(server.node(), m_files); });
  EXPECT_EQ(error.reason, Reason::Incomplete);
  EXPECT_NE(std::string(error.what()).find("0 of 60"), std::string::npos) << error.what();
  EXPECT_NE(std::string(error.what()).find("A700"), std::string::npos) << error.what();
}

TEST_F(BusyNode, IsLeftWhenTheUserCancels)
{
  m_behaviour.manyAtOnce = true;
  const FaultyServer server(m_behaviour);
  const auto token = std::make_shared<core::CancelToken>();
  const core::Progress progress(
      [&token](double fraction, const std::string&)
      {
        if (fraction > 0.3)
          token->cancel();
      },
      token);
  EXPECT_THROW(store(server.node(), m_files, progress), core::CancelledError);
  EXPECT_LT(server.stored().size(), 60U);
}

namespace
{

/// Takes one connection, sends these bytes and says nothing more until the other side ends it.
class Chatterer
{
public:
  explicit Chatterer(std::string bytes)
    : m_listener(listenOn(0, m_port))
    , m_thread(
          [this, bytes = std::move(bytes)]
          {
            const int client = ::accept(m_listener, nullptr, nullptr);
            [[maybe_unused]] const ssize_t sent =
                ::send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL);
            pollfd closed{client, POLLRDHUP, 0};
            ::poll(&closed, 1, 30000);
            ::close(client);
          })
  {
  }
  ~Chatterer()
  {
    m_thread.join();
    ::close(m_listener);
  }
  Node node() const
  {
    Node node;
    node.name = "faulty";
    node.host = "127.0.0.1";
    node.port = m_port;
    node.aeTitle = "WEB";
    node.timeouts.reply = node.timeouts.accept = std::chrono::hours(1);
    return node;
  }

private:
  int m_port = 0;
  int m_listener;
  std::thread m_thread;
};

// PS3.8 Table 9-11 and its items, as far as they go.
std::string pdu(int type, std::uint32_t length, const std::string& body)
{
  std::string all{static_cast<char>(type), 0};
  for (int shift = 24; shift >= 0; shift -= 8)
    all += static_cast<char>(length >> shift & 0xFF);
  return all + body;
}

std::string pdu(int type, const std::string& body)
{
  return pdu(type, static_cast<std::uint32_t>(body.size()), body);
}

} // namespace

// Refused when it comes and not when the time is up, which is an hour here.
TEST_F(FaultyNode, ThatIsNoDicomServerIsNamed)
{
  const std::string fields(68, '\0');
  const std::string item("\x10\0\0\x15", 4);
  for (const auto& [bytes, told] :
       {std::pair<std::string, std::string>("HTTP/1.1 400 Bad Request\r\n\r\n", "type 72"),
        {"220 mail.example ESMTP\r\n", "type 50"},
        {std::string(64, '\0'), "type 0"},
        {"\xFF\xFF\xFF\xFF\xFF\xFF", "type 255"},
        {pdu(2, 0xFFFFFFFF, ""), "states 4294967295 bytes"},
        {pdu(2, 4, "\1\2\3\4"), "states 4 bytes"},
        {pdu(3, 0x7FFFFFFF, ""), "states 2147483647 bytes"},
        {pdu(4, 0x10000000, ""), "states 268435456 bytes"},
        {pdu(2, fields + item + "short"), "longer than it is"},
        {pdu(2, fields + "\x10"), "bytes behind its last part"}})
  {
    const Chatterer server(bytes);
    const NetworkError error = failure([node = server.node()] { echo(node); });
    EXPECT_EQ(error.reason, Reason::Protocol) << told;
    EXPECT_NE(std::string(error.what()).find(told), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("is not valid DICOM"), std::string::npos);
  }
}

// In whatever pieces the bytes come.
TEST(PduChecker, FollowsAConnectionFromPduToPdu)
{
  const auto faultOf = [](const std::string& bytes, std::size_t piece)
  {
    PduChecker checker;
    for (std::size_t at = 0; at < bytes.size(); at += piece)
      if (std::string fault = checker.take(reinterpret_cast<const std::uint8_t*>(bytes.data()) + at,
                                           std::min(piece, bytes.size() - at));
          !fault.empty())
        return fault;
    return std::string();
  };
  const auto value = [](std::uint32_t length, std::size_t bytes)
  { return pdu(0, length, std::string(bytes, '\3')).substr(2); };
  const std::string fields(68, '\0');
  const std::string item("\x10\0\0\x03", 4);
  const std::string sound = pdu(2, fields + item + "abc" + item + "def") + pdu(2, fields) +
                            pdu(4, value(5, 5) + value(2, 2)) + pdu(4, value(100, 100)) +
                            pdu(5, std::string(4, '\0')) + pdu(6, std::string(4, '\0')) +
                            pdu(7, std::string(4, '\0')) + pdu(3, std::string(4, '\0'));
  for (const std::size_t piece : {1, 2, 3, 7, 64, 100000})
  {
    EXPECT_EQ(faultOf(sound, piece), "") << piece;
    for (const auto& [bytes, told] :
         {std::pair(pdu(4, value(1, 1) + value(1, 1)), "a data value of 1 bytes"),
          {pdu(4, value(6, 5)), "longer than it is"},
          {pdu(4, value(0xFFFFFFFF, 5)), "longer than it is"},
          {pdu(4, value(5, 5) + "abc"), "bytes behind its last part"},
          {pdu(4, 131073, ""), "states 131073 bytes"},
          {pdu(4, 5, ""), "states 5 bytes"},
          {pdu(5, 5, ""), "states 5 bytes"},
          {pdu(8, 4, ""), "type 8"}})
      EXPECT_NE(faultOf(sound + bytes, piece).find(told), std::string::npos)
          << told << ", " << piece;
  }
}

// What may still become a PDU is waited for.
TEST_F(FaultyNode, ThatStopsWithinAPduIsLeftWhenTheTimeIsUp)
{
  const std::string whole = pdu(2, 1000, std::string(500, '\0'));
  for (const std::size_t size : {std::size_t(3), std::size_t(6), std::size_t(40)})
  {
    const Chatterer server(whole.substr(0, size));
    Node node = server.node();
    node.timeouts.accept = std::chrono::milliseconds(300);
    EXPECT_EQ(failure([&] { echo(node); }).reason, Reason::TimedOut) << size;
  }
}

// --- What is counted ---

TEST_F(FaultyNode, ThatIsCutWhenAskedWhatItHasIsAskedAgain)
{
  m_behaviour.cuts = [](int query) { return query == 1; };
  {
    const FaultyServer server(m_behaviour);
    const Transfer sent = store(server.node(), m_files);
    EXPECT_EQ(sent.listed, Transfer::Listed::All);
    EXPECT_EQ(sent.asked, 2U);
  }
  m_behaviour.files.resize(6); // of which it confirmed ten
  const FaultyServer server(m_behaviour);
  EXPECT_EQ(failure([&] { store(server.node(), m_files); }).reason, Reason::Incomplete);
}

TEST_F(FaultyNode, ThatNeverSaysWhatItHasIsNotSaidToListNothing)
{
  m_behaviour.files.clear();
  m_behaviour.cuts = [](int query) { return query > 0; };
  {
    const FaultyServer server(m_behaviour);
    const Transfer sent = store(server.node(), m_files);
    EXPECT_EQ(sent.completed, 10U);
    EXPECT_EQ(sent.listed, Transfer::Listed::Unanswered);
    EXPECT_FALSE(sent.verified);
    EXPECT_EQ(sent.asked, 3U);
  }
  m_behaviour.cuts = {};
  const FaultyServer server(m_behaviour);
  Node node = server.node();
  node.timeouts.listing = std::chrono::milliseconds(60);
  EXPECT_EQ(store(node, m_files).listed, Transfer::Listed::None);
}

TEST_F(FaultyNode, WhoseListLagsIsAskedAgain)
{
  m_behaviour.lists = [this](int query) { return query < 3 ? std::vector<fs::path>() : m_files; };
  const FaultyServer server(m_behaviour);
  Node node = server.node();
  node.timeouts.listing = std::chrono::milliseconds(60);
  const Transfer sent = store(node, m_files);
  EXPECT_EQ(sent.listed, Transfer::Listed::All);
  EXPECT_TRUE(sent.verified);
}

TEST_F(FaultyNode, WhoseListChangesIsNotSentToForEver)
{
  m_behaviour.lists = [this](int query)
  {
    const std::size_t held = query == 0 ? 0 : query % 4 < 2 ? 5 : 4;
    return std::vector<fs::path>(m_files.begin(),
                                 m_files.begin() + static_cast<std::ptrdiff_t>(held));
  };
  const FaultyServer server(m_behaviour);
  EXPECT_EQ(failure([&] { store(server.node(), m_files); }).reason, Reason::Incomplete);
}

TEST_F(FaultyNode, ThatIsCutAtFirstIsStillAskedWhatWasThere)
{
  m_behaviour.cuts = [](int query) { return query == 0; };
  m_behaviour.lists = [this](int query)
  { return std::vector<fs::path>(m_files.begin(), m_files.begin() + (query == 1 ? 4 : 10)); };
  const FaultyServer server(m_behaviour);
  const Transfer sent = store(server.node(), m_files);
  EXPECT_EQ(sent.present, 4U);
  EXPECT_EQ(sent.completed, 10U);
}

TEST_F(FaultyNode, ThatListsFewerThanItStatesOfTheStudyIsNamed)
{
  m_behaviour.stated = 0; // of the series
  m_behaviour.statedOfStudy = 12;
  const FaultyServer server(m_behaviour);
  const NetworkError error = retrieveFailure(server.node());
  EXPECT_EQ(error.reason, Reason::Incomplete);
  EXPECT_NE(std::string(error.what()).find("12 instances"), std::string::npos) << error.what();
}

TEST_F(FaultyNode, ThatIgnoresTheSeriesIsTakenByWhatItAnswers)
{
  const auto other = series("OTHER", "P1");
  m_behaviour.files.insert(m_behaviour.files.end(), other.begin(), other.end());
  m_behaviour.returnsKeys = true;
  const FaultyServer server(m_behaviour);
  const Transfer got = retrieve(server.node(), m_study, {imaging::deterministicUid(8, "SERIES")},
                                m_folder.path() / "back");
  EXPECT_EQ(got.instances, 10U);
  EXPECT_EQ(got.completed, 10U);
  EXPECT_EQ(findInstances(server.node(), m_study, {imaging::deterministicUid(8, "OTHER")}).size(),
            10U);
  EXPECT_TRUE(findSeries(server.node(), imaging::deterministicUid(8, "another")).size() == 2U)
      << "a node may not say to which study they belong";
}

TEST_F(FaultyNode, ThatSendsWithoutEndIsLeft)
{
  m_behaviour.sends = [this](int, const std::vector<std::string>&)
  {
    std::vector<fs::path> files;
    for (int n = 0; n < 400; ++n)
      files.push_back(m_files[static_cast<std::size_t>(n) % 5]);
    return files;
  };
  const FaultyServer server(m_behaviour);
  const NetworkError error = retrieveFailure(server.node());
  EXPECT_EQ(error.reason, Reason::Protocol);
  EXPECT_NE(std::string(error.what()).find("without end"), std::string::npos) << error.what();
}

TEST_F(FaultyNode, ThatAnswersWithoutEndIsLeft)
{
  m_behaviour.answers = 100001;
  const FaultyServer server(m_behaviour);
  const NetworkError error = failure([&] { findStudies(server.node(), {m_study, {}}); });
  EXPECT_EQ(error.reason, Reason::TooMany);
  EXPECT_NE(std::string(error.what()).find("100000 times"), std::string::npos) << error.what();
}

// --- This computer's own faults ---

TEST_F(FaultyNode, IsNotBlamedForAFullDisk)
{
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
  for (const rlim_t most : {rlim_t{0}, rlim_t{700}, rlim_t{fs::file_size(m_files[0]) - 40}})
  {
    const fs::path folder = m_folder.path() / ("back" + std::to_string(most));
    const FaultyServer server(m_behaviour);
    rlimit limit = before;
    limit.rlim_cur = most;
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try
    {
      retrieve(server.node(), m_study, {}, folder);
      ADD_FAILURE() << most << ": the disk took it";
    }
    catch (const core::OutputFileError& error)
    {
      EXPECT_EQ(error.reason, core::OutputFileError::Reason::DiskFull) << error.what();
    }
    catch (const std::exception& error)
    {
      ADD_FAILURE() << most << ": " << error.what();
    }
    ::setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_TRUE(fs::is_empty(folder)) << most;
  }
  std::signal(SIGXFSZ, ignored);
}

// Of what arrived until then a slow disk gets no more than it can write in a moment.
TEST_F(FaultyNode, IsLeftSoonAlthoughTheDiskIsSlow)
{
  constexpr std::size_t kFiles = 50, kReceived = 45;
  m_files = series("MANY", "P1", {}, static_cast<int>(kFiles));
  m_behaviour.files = m_files;
  const FaultyServer server(m_behaviour);
  const auto token = std::make_shared<core::CancelToken>();
  const fs::path folder = m_folder.path() / "back";
  const core::Progress progress(
      [&](double fraction, const std::string&)
      {
        if (fraction >= static_cast<double>(kReceived) / static_cast<double>(kFiles))
          token->cancel();
      },
      token);
  g_syncDelay = 300; // 13 s for all
  EXPECT_THROW(retrieve(server.node(), m_study, {}, folder, progress), core::CancelledError);
  g_syncDelay = 0;
  const auto kept = static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  EXPECT_GT(kept, 0U);
  EXPECT_LT(kept, kReceived / 2);
  for (const auto& entry : fs::directory_iterator(folder))
    EXPECT_EQ(entry.path().extension(), kInstanceEnding);
  EXPECT_EQ(retrieve(server.node(), m_study, {}, folder).present, kept);
}

// What a killed program was receiving is a patient's.
TEST_F(FaultyNode, PartsOfADeadProgramAreRemoved)
{
  const pid_t dead = ::fork();
  if (dead == 0)
    ::_exit(0);
  ASSERT_GT(dead, 0);
  ::waitpid(dead, nullptr, 0);
  const fs::path folder = m_folder.path() / "back";
  fs::create_directories(folder);
  const std::string left = "part-" + std::to_string(dead) + "-3.tmp";
  const std::string another = "part-" + std::to_string(::getppid()) + "-3.tmp";
  const std::vector<std::string> others{another, "part-x-3.tmp", left + ".txt", "notes.tmp"};
  std::ofstream(folder / left) << "a patient's";
  for (const std::string& name : others)
    std::ofstream(folder / name) << "mine";
  const FaultyServer server(m_behaviour);
  EXPECT_EQ(retrieve(server.node(), m_study, {}, folder).completed, m_files.size());
  EXPECT_FALSE(fs::exists(folder / left));
  for (const std::string& name : others)
    EXPECT_TRUE(fs::exists(folder / name)) << name;
}

TEST_F(FaultyNode, WhatTheListenerThrowsArrivesAtTheCaller)
{
  const core::Progress progress([](double, const std::string&)
                                { throw std::runtime_error("of the listener"); });
  const FaultyServer server(m_behaviour);
  EXPECT_THROW(retrieve(server.node(), m_study, {}, m_folder.path() / "back", progress),
               std::runtime_error);
  m_behaviour.files.resize(6); // else there is nothing to send
  const FaultyServer lacking(m_behaviour);
  EXPECT_THROW(store(lacking.node(), m_files, progress), std::runtime_error);
}

TEST(ConnectionWatch, AConnectionThatCannotBeWatchedIsNotUsed)
{
  ConnectionWatch watch({}, std::chrono::seconds(60));
  watch.watch(-1);
  EXPECT_EQ(watch.ended(), ConnectionWatch::End::Failed);
  EXPECT_THROW(std::rethrow_exception(watch.fault()), core::Error);
}

TEST(ConnectionWatch, EndsWhatIsTooLarge)
{
  std::array<int, 2> ends{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
  ConnectionWatch watch({}, std::chrono::seconds(60));
  watch.watch(ends[0]);
  watch.end(ConnectionWatch::End::TooLarge);
  char byte = 0;
  EXPECT_EQ(::read(ends[1], &byte, 1), 0) << "its peer sees the end";
  EXPECT_EQ(watch.ended(), ConnectionWatch::End::TooLarge);
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST_F(FaultyNode, ThatDoesNotEvenConnectIsLeftWhenTheUserCancels)
{
  int port = 0;
  const int listener = listenOn(0, port);
  ::listen(listener, 0);
  std::vector<int> pending; // until the system drops who connects
  for (pollfd one{-1, POLLOUT, 0}; pending.empty() || ::poll(&one, 1, 200) > 0;)
  {
    one.fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    pending.push_back(one.fd);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    ::connect(one.fd, reinterpret_cast<sockaddr*>(&address), sizeof address);
  }
  prepareToolkit();
  const Sint32 before = dcmConnectionTimeout.get();
  dcmConnectionTimeout.set(600);
  Node node;
  node.name = "faulty";
  node.host = "127.0.0.1";
  node.port = port;
  node.aeTitle = "FULL";
  const auto token = std::make_shared<core::CancelToken>();
  std::atomic<bool> cancelled{false};
  std::thread user(
      [&]
      {
        try
        {
          echo(node, core::Progress({}, token));
        }
        catch (const core::CancelledError&)
        {
          cancelled = true;
        }
        catch (const std::exception&)
        {
        }
      });
  token->cancel();
  EXPECT_TRUE(waitFor([&] { return cancelled.load(); }));
  for (const int one : pending)
    ::close(one);
  ::close(listener); // whoever still connects is refused now
  user.join();
  dcmConnectionTimeout.set(before);
}

// --- Who sends by C-MOVE ---

class MovingNode : public FaultyNode
{
protected:
  void SetUp() override
  {
    FaultyNode::SetUp();
    m_behaviour.movePort = freePort();
  }
  Node nodeOf(const FaultyServer& server) const
  {
    Node node = server.node();
    node.movePort = m_behaviour.movePort;
    return node;
  }
  std::size_t arrived() const
  {
    std::error_code ignored;
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(m_folder.path() / "back", ignored))
      count += entry.path().extension() == kInstanceEnding ? 1U : 0U;
    return count;
  }
};

TEST_F(MovingNode, ThatIsInOrderGivesEverything)
{
  const FaultyServer server(m_behaviour);
  for (const char* host : {"", "localhost", kAnyName})
  {
    fs::remove_all(m_folder.path() / "back");
    Node node = nodeOf(server);
    node.moveHost = host;
    EXPECT_EQ(retrieve(node, m_study, {}, m_folder.path() / "back").completed, 10U) << host;
  }
}

TEST_F(MovingNode, IsNotReplacedByOneOfAnotherTitle)
{
  m_behaviour.moveTitle = "STRANGER";
  const FaultyServer server(m_behaviour);
  const NetworkError error = retrieveFailure(nodeOf(server));
  EXPECT_EQ(error.reason, Reason::Rejected);
  EXPECT_NE(std::string(error.what()).find("does not call itself 'FAULTY'"), std::string::npos)
      << error.what();
  EXPECT_EQ(arrived(), 0U);
}

TEST_F(MovingNode, IsNotReplacedByAnotherHost)
{
  const FaultyServer server(m_behaviour);
  Node node = nodeOf(server);
  node.moveHost = "127.0.0.2"; // this computer's too, but not the one that sends
  const NetworkError error = retrieveFailure(node);
  EXPECT_EQ(error.reason, Reason::Rejected);
  EXPECT_NE(std::string(error.what()).find("another host"), std::string::npos) << error.what();
  EXPECT_EQ(arrived(), 0U);
}

TEST_F(MovingNode, IsServedAlthoughAnotherConnectionSaysNothing)
{
  m_behaviour.silentFirst = true;
  const FaultyServer server(m_behaviour);
  Node node = nodeOf(server);
  node.timeouts.reply = std::chrono::seconds(4);
  EXPECT_EQ(retrieve(node, m_study, {}, m_folder.path() / "back").completed, 10U);
}

TEST_F(MovingNode, IsNotLetInByAnyCertificateOfTheSystemsAuthorities)
{
  const Certificate own(m_folder.path(), "server"), client(m_folder.path(), "client");
  m_behaviour.own = &own;
  const FaultyServer server(m_behaviour);
  ::setenv("SSL_CERT_FILE", own.certificate().c_str(), 1); // the system's, for OpenSSL
  Node node = nodeOf(server);
  node.tls = TlsFiles{"", client.certificate(), client.key()};
  const NetworkError error = retrieveFailure(node);
  ::unsetenv("SSL_CERT_FILE");
  EXPECT_EQ(error.reason, Reason::Tls);
  EXPECT_NE(std::string(error.what()).find("certificates to trust"), std::string::npos)
      << error.what();
}

// --- TLS ---

class SecureNode : public FaultyNode
{
protected:
  /// Fails as told, before a byte of DICOM.
  void expectRefused(const TlsFiles& files, const std::string& words) const
  {
    const FaultyServer server(m_behaviour);
    Node node = server.node();
    node.tls = files;
    node.timeouts.reply = std::chrono::seconds(10);
    const NetworkError error = failure([&] { echo(node); });
    EXPECT_EQ(error.reason, Reason::Tls) << error.what();
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    EXPECT_EQ(server.associations(), 0) << words;
  }
  void expectConnected(const TlsFiles& files) const
  {
    const FaultyServer server(m_behaviour);
    Node node = server.node();
    node.tls = files;
    EXPECT_NO_THROW(echo(node));
    EXPECT_EQ(server.associations(), 1);
  }
};

TEST_F(SecureNode, IsConnectedIfItsCertificateIsOfTheHostOrTheNameGiven)
{
  const Certificate here(m_folder.path(), "here"),
      elsewhere(m_folder.path(), "elsewhere", "DNS:pacs.hospital.example"),
      client(m_folder.path(), "client");
  m_behaviour.own = &here;
  expectConnected({here.certificate(), "", ""});
  m_behaviour.client = &client;
  expectConnected({here.certificate(), client.certificate(), client.key()});
  m_behaviour.client = nullptr;
  m_behaviour.own = &elsewhere;
  expectConnected({elsewhere.certificate(), "", "", "pacs.hospital.example"});
  expectConnected({elsewhere.certificate(), "", "", kAnyName});
}

TEST_F(SecureNode, OfAnotherNameIsRefusedAlthoughItsAuthorityIsTrusted)
{
  const Certificate elsewhere(m_folder.path(), "elsewhere", "DNS:other.hospital.example");
  m_behaviour.own = &elsewhere;
  expectRefused({elsewhere.certificate(), "", ""}, "is not of '127.0.0.1'");
  expectRefused({elsewhere.certificate(), "", "", "pacs.hospital.example"},
                "is not of 'pacs.hospital.example'");
}

TEST_F(SecureNode, WithAnExpiredOrUnknownCertificateIsRefused)
{
  const Certificate expired(m_folder.path(), "expired", "IP:127.0.0.1", -60),
      stranger(m_folder.path(), "stranger");
  m_behaviour.own = &expired;
  expectRefused({expired.certificate(), "", ""}, "has expired");
  m_behaviour.own = &stranger;
  expectRefused({expired.certificate(), "", ""}, "not of a trusted authority");
  expectRefused({"", "", ""}, "not of a trusted authority");
}

TEST_F(SecureNode, WithOldTlsOrWeakCiphersOnlyIsRefused)
{
  const Certificate own(m_folder.path(), "own");
  m_behaviour.own = &own;
  m_behaviour.latestTls = TLS1_1_VERSION;
  m_behaviour.ciphers = "ALL:@SECLEVEL=0";
  expectRefused({own.certificate(), "", ""}, "TLS 1.2 or later");
  m_behaviour.latestTls = TLS1_2_VERSION;
  expectConnected({own.certificate(), "", ""});
  m_behaviour.ciphers = "AES128-SHA";
  expectRefused({own.certificate(), "", ""}, "with a permitted cipher");
}

TEST_F(SecureNode, ThatWantsAnotherCertificateIsNamed)
{
  const Certificate own(m_folder.path(), "own"), client(m_folder.path(), "client"),
      stranger(m_folder.path(), "stranger");
  m_behaviour.own = &own;
  m_behaviour.client = &client;
  m_behaviour.latestTls = TLS1_2_VERSION;
  expectRefused({own.certificate(), "", ""}, "wants a certificate of this program");
  expectRefused({own.certificate(), stranger.certificate(), stranger.key()},
                "refuses the certificate of this program");
  // By TLS 1.3 it refuses after the handshake, and its reason may be lost with the connection.
  m_behaviour.latestTls = 0;
  const FaultyServer server(m_behaviour);
  for (const TlsFiles& files :
       {TlsFiles{own.certificate(), "", ""},
        TlsFiles{own.certificate(), stranger.certificate(), stranger.key()}})
  {
    Node node = server.node();
    node.tls = files;
    const NetworkError error = failure([&] { echo(node); });
    EXPECT_TRUE(error.reason == Reason::Tls || error.reason == Reason::Cut) << error.what();
    EXPECT_NE(std::string(error.what()).find("certificate of this program"), std::string::npos)
        << error.what();
  }
  EXPECT_EQ(server.associations(), 0);
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
