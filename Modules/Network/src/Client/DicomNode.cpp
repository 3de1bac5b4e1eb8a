#include "petrous/Network/DicomNode.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <netdb.h>
#include <openssl/evp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcostrmf.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmnet/dcmlayer.h>
#include <dcmtk/dcmnet/dimse.h>

#include "Association.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Core/WriteAll.h"
#include "petrous/Imaging/DicomReader.h"

namespace petrous::network
{
namespace
{

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Reason = NetworkError::Reason;

constexpr const char* kImageLevel = "IMAGE";
constexpr std::size_t kMaxUidsAsked = 400;      ///< of one request: a UI value holds 64 KB
constexpr std::size_t kMaxContexts = 128;       ///< PS3.8 9.3.2: odd numbers of one byte
constexpr std::size_t kMaxAnswers = 100000;     ///< to a query
constexpr std::chrono::seconds kNegotiation(5); ///< for who connects to send by C-MOVE
/// From which on a second association is worth its negotiation.
constexpr std::size_t kManyFiles = 32;
constexpr int kMaxIdleRounds = 2;            ///< transfers without a new instance before giving up
constexpr std::size_t kMaxSuperfluous = 100; ///< instances, beyond as many as were asked for
constexpr std::uintmax_t kMaxInstanceBytes = std::uintmax_t{4} << 30;

/// What is retrieved may be stored in any of these; Imaging reads them all. Explicit little endian
/// first: what has no compressed form comes as it is.
constexpr std::array<const char*, 9> kTransferSyntaxes{
    UID_LittleEndianExplicitTransferSyntax,
    UID_LittleEndianImplicitTransferSyntax,
    UID_JPEGProcess14SV1TransferSyntax,
    UID_JPEGProcess14TransferSyntax,
    UID_JPEGLSLosslessTransferSyntax,
    UID_JPEG2000LosslessOnlyTransferSyntax,
    UID_RLELosslessTransferSyntax,
    UID_JPEG2000TransferSyntax,
    UID_DeflatedExplicitVRLittleEndianTransferSyntax};

/// What Petrous reads, for a node that does not say of what class its instances are: the key is
/// optional (PS3.4 C.6.2.1.5).
const std::array<const char*, 10> kReadClasses{UID_CTImageStorage,
                                               UID_EnhancedCTImageStorage,
                                               UID_LegacyConvertedEnhancedCTImageStorage,
                                               UID_MRImageStorage,
                                               UID_EnhancedMRImageStorage,
                                               UID_LegacyConvertedEnhancedMRImageStorage,
                                               UID_SegmentationStorage,
                                               "1.2.840.10008.5.1.4.1.1.66.7", // label map
                                               UID_RTStructureSetStorage,
                                               UID_RawDataStorage};

std::string numberOf(std::size_t count, const std::string& what)
{
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

const std::vector<const char*> kUncompressed{UID_LittleEndianExplicitTransferSyntax,
                                             UID_LittleEndianImplicitTransferSyntax};

bool isWarning(DIC_US status)
{
  return (status & 0xF000) == 0xB000 || status == 0x0001 || status == 0x0107 || status == 0x0116;
}

std::string hexadecimal(DIC_US status)
{
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string text;
  for (int shift = 12; shift >= 0; shift -= 4)
    text += kDigits[(status >> shift) & 0xF];
  return text;
}

/// PS3.4 C.4, B.2.3.
std::string statusText(DIC_US status)
{
  const std::string code = " (status " + hexadecimal(status) + ")";
  if ((status & 0xFF00) == 0xA700)
    return "it is out of resources" + code;
  if ((status & 0xFF00) == 0xA900)
    return "the request does not match its model, or it refuses the object" + code;
  if (status == 0xA801)
    return "it does not know this program's AE title as a destination; have it added there" + code;
  if (status == 0x0122 || status == 0xA800)
    return "it does not support this kind of object" + code;
  if (status == 0x0124)
    return "this program may not do that there" + code;
  if (status == 0xFE00)
    return "it cancelled the request" + code;
  return "it cannot process the request" + code;
}

// --- C-FIND ---

std::string text(DcmItem& item, const DcmTagKey& key)
{
  OFString value;
  if (item.findAndGetOFStringArray(key, value).bad())
    return {};
  const std::string all(value.c_str(), value.length());
  return all.substr(0, all.find_last_not_of(std::string(" \0", 2)) + 1);
}

int count(DcmItem& item, const DcmTagKey& key)
{
  const std::string digits = text(item, key);
  if (digits.empty() || digits.size() > 9 ||
      digits.find_first_not_of("0123456789") != std::string::npos)
    return -1;
  return std::stoi(digits);
}

struct FindCall
{
  const Association* association;
  std::function<void(DcmDataset&)> each;
  std::size_t answers = 0;
};

void onFindAnswer(void* data, T_DIMSE_C_FindRQ*, int, T_DIMSE_C_FindRSP*, DcmDataset* answer)
{
  auto& call = *static_cast<FindCall*>(data);
  ConnectionWatch& watch = call.association->watch();
  watch.active();
  try // nothing through DCMTK
  {
    if (++call.answers > kMaxAnswers)
      throw NetworkError(Reason::TooMany,
                         place(call.association->node()) + ": answers a query more than " +
                             std::to_string(kMaxAnswers) + " times; narrow the search");
    if (answer)
      call.each(*answer);
  }
  catch (...)
  {
    watch.fail(std::current_exception());
  }
}

void find(const Association& association, DcmDataset& query,
          const std::function<void(DcmDataset&)>& each)
{
  const std::string task = "the query";
  const auto context = association.context(UID_FINDStudyRootQueryRetrieveInformationModel);
  if (context == 0)
    throw NetworkError(Reason::Unsupported,
                       place(association.node()) + ": does not offer queries (C-FIND, study root)");
  T_DIMSE_C_FindRQ request{};
  request.MessageID = association.get()->nextMsgID++;
  OFStandard::strlcpy(request.AffectedSOPClassUID, UID_FINDStudyRootQueryRetrieveInformationModel,
                      sizeof request.AffectedSOPClassUID);
  request.DataSetType = DIMSE_DATASET_PRESENT;
  request.Priority = DIMSE_PRIORITY_MEDIUM;
  T_DIMSE_C_FindRSP response{};
  FindCall call{&association, each};
  int answers = 0;
  DcmDataset* detail = nullptr;
  const OFCondition result =
      DIMSE_findUser(association.get(), context, &request, &query, answers, onFindAnswer, &call,
                     DIMSE_NONBLOCKING, association.timeout(), &response, &detail);
  delete detail;
  association.require(result, task);
  if (response.DimseStatus != STATUS_Success)
    throw NetworkError(Reason::Failed, place(association.node()) + ": refuses the query: " +
                                           statusText(response.DimseStatus));
}

std::vector<Context> findContexts()
{
  return {{UID_FINDStudyRootQueryRetrieveInformationModel, kUncompressed}};
}

void put(DcmItem& item, const DcmTagKey& key, const std::string& value)
{
  item.putAndInsertString(key, value.c_str());
}

bool isAscii(const std::string& value)
{
  return std::all_of(value.begin(), value.end(),
                     [](char c) { return static_cast<unsigned char>(c) < 128; });
}

std::string dateRange(const StudyFilter& filter)
{
  if (filter.from.empty() && filter.to.empty())
    return {};
  return filter.from == filter.to ? filter.from : filter.from + "-" + filter.to;
}

std::vector<Study> studiesIn(const Association& association, const StudyFilter& filter)
{
  DcmDataset query;
  if (!isAscii(filter.patientId) || !isAscii(filter.patientName))
    put(query, DCM_SpecificCharacterSet, "ISO_IR 192");
  put(query, DCM_QueryRetrieveLevel, "STUDY");
  put(query, DCM_StudyInstanceUID, filter.uid);
  put(query, DCM_StudyID, filter.studyId);
  put(query, DCM_PatientID, filter.patientId);
  put(query, DCM_PatientName, filter.patientName);
  put(query, DCM_StudyDate, dateRange(filter));
  put(query, DCM_StudyDescription, "");
  put(query, DCM_ModalitiesInStudy, filter.modality);
  put(query, DCM_NumberOfStudyRelatedInstances, "");
  std::map<std::string, Study> found;
  find(association, query,
       [&](DcmDataset& answer)
       {
         answer.convertToUTF8(); // as it came where that is impossible
         Study study;
         study.uid = text(answer, DCM_StudyInstanceUID);
         study.patientId = text(answer, DCM_PatientID);
         study.patientName = text(answer, DCM_PatientName);
         study.date = text(answer, DCM_StudyDate);
         study.studyId = text(answer, DCM_StudyID);
         study.description = text(answer, DCM_StudyDescription);
         study.modalities = text(answer, DCM_ModalitiesInStudy);
         study.instances = count(answer, DCM_NumberOfStudyRelatedInstances);
         // A node may ignore a key that it does not know.
         const auto inRange = [&]
         {
           return study.date.empty() || ((filter.from.empty() || study.date >= filter.from) &&
                                         (filter.to.empty() || study.date <= filter.to));
         };
         const auto hasModality = [&]
         {
           return filter.modality.empty() || study.modalities.empty() ||
                  ("\\" + study.modalities + "\\").find("\\" + filter.modality + "\\") !=
                      std::string::npos;
         };
         if (!study.uid.empty() && (filter.uid.empty() || study.uid == filter.uid) &&
             (filter.studyId.empty() || study.studyId == filter.studyId) && inRange() &&
             hasModality())
           found.emplace(study.uid, study);
       });
  std::vector<Study> studies;
  for (auto& [uid, study] : found)
    studies.push_back(std::move(study));
  return studies;
}

/// A node may ignore a key that it does not know, and may answer without it.
bool isOther(DcmItem& answer, const DcmTagKey& key, const std::string& asked)
{
  const std::string stated = text(answer, key);
  return !stated.empty() && stated != asked;
}

std::vector<Series> seriesIn(const Association& association, const std::string& studyUid)
{
  DcmDataset query;
  put(query, DCM_QueryRetrieveLevel, "SERIES");
  put(query, DCM_StudyInstanceUID, studyUid);
  put(query, DCM_SeriesInstanceUID, "");
  put(query, DCM_Modality, "");
  put(query, DCM_SeriesDescription, "");
  put(query, DCM_SeriesNumber, "");
  put(query, DCM_NumberOfSeriesRelatedInstances, "");
  std::map<std::string, Series> found;
  find(association, query,
       [&](DcmDataset& answer)
       {
         if (isOther(answer, DCM_StudyInstanceUID, studyUid))
           return;
         answer.convertToUTF8();
         Series series;
         series.uid = text(answer, DCM_SeriesInstanceUID);
         series.modality = text(answer, DCM_Modality);
         series.description = text(answer, DCM_SeriesDescription);
         series.number = count(answer, DCM_SeriesNumber);
         series.instances = count(answer, DCM_NumberOfSeriesRelatedInstances);
         if (!series.uid.empty())
           found.emplace(series.uid, series);
       });
  std::vector<Series> list;
  for (auto& [uid, series] : found)
    list.push_back(std::move(series));
  return list;
}

using Instances = std::map<std::string, Instance>; // by UID

Instances instancesIn(const Association& association, const std::string& studyUid,
                      const std::vector<std::string>& seriesUids)
{
  Instances found;
  for (const std::string& series : seriesUids)
  {
    DcmDataset query;
    put(query, DCM_QueryRetrieveLevel, kImageLevel);
    put(query, DCM_StudyInstanceUID, studyUid);
    put(query, DCM_SeriesInstanceUID, series);
    put(query, DCM_SOPInstanceUID, "");
    put(query, DCM_SOPClassUID, "");
    find(association, query,
         [&](DcmDataset& answer)
         {
           if (isOther(answer, DCM_StudyInstanceUID, studyUid) ||
               isOther(answer, DCM_SeriesInstanceUID, series))
             return;
           Instance instance;
           instance.uid = text(answer, DCM_SOPInstanceUID);
           instance.seriesUid = series;
           instance.sopClass = text(answer, DCM_SOPClassUID);
           if (!instance.uid.empty())
             found.emplace(instance.uid, instance);
         });
  }
  return found;
}

// --- C-STORE ---

struct OutgoingFile
{
  fs::path path;
  std::string sopClass, uid, studyUid, seriesUid;
  const char* transferSyntax = nullptr;
  std::uintmax_t bytes = 0;
};

OutgoingFile outgoing(const fs::path& path)
{
  DcmFileFormat file;
  const auto refuse = [&path]
  { throw core::InvalidParameter(path.string() + ": is not a DICOM file that can be sent"); };
  if (!imaging::canBeInflated(path) ||
      file.loadFile(path.c_str(), EXS_Unknown, EGL_noChange, 4096).bad())
    refuse();
  DcmDataset& data = *file.getDataset();
  OutgoingFile result;
  result.path = path;
  result.sopClass = text(data, DCM_SOPClassUID);
  result.uid = text(data, DCM_SOPInstanceUID);
  result.studyUid = text(data, DCM_StudyInstanceUID);
  result.seriesUid = text(data, DCM_SeriesInstanceUID);
  result.transferSyntax = DcmXfer(data.getOriginalXfer()).getXferID();
  std::error_code fault;
  result.bytes = fs::file_size(path, fault);
  if (result.sopClass.empty() || result.uid.empty() || result.studyUid.empty() ||
      result.seriesUid.empty() || fault)
    refuse();
  return result;
}

std::vector<Context> storeContexts(const std::vector<OutgoingFile>& files)
{
  std::set<std::pair<std::string, std::string>> kinds;
  for (const OutgoingFile& file : files)
    kinds.emplace(file.sopClass, file.transferSyntax);
  std::vector<Context> contexts = findContexts();
  for (const auto& [sopClass, syntax] : kinds)
  {
    const DcmXfer xfer(syntax.c_str());
    contexts.push_back({sopClass, {xfer.getXferID()}});
    if (!xfer.isEncapsulated()) // DCMTK converts between these
      contexts.push_back({sopClass, kUncompressed});
  }
  if (contexts.size() > kMaxContexts)
    throw core::InvalidParameter("DICOM: too many kinds of objects for one transfer; send fewer");
  return contexts;
}

/// Counts bytes over all instances of a transfer, for the user and for the watch.
struct ByteCounter
{
  ConnectionWatch* watch = nullptr;
  ConnectionWatch* receiver = nullptr; ///< of what comes on a connection of its own (C-MOVE)
  const core::Progress* progress = nullptr;
  bool sends = false;
  std::uintmax_t total = 0; ///< 0: unknown
  std::size_t done = 0, of = 0;
  std::uintmax_t before = 0;

  void at(std::uintmax_t bytes) noexcept
  {
    watch->active();
    if (receiver)
      receiver->active();
    if (bytes > kMaxInstanceBytes)
      watch->end(ConnectionWatch::End::TooLarge);
    const double fraction = total > 0
                                ? static_cast<double>(before + bytes) / static_cast<double>(total)
                            : of > 0 ? static_cast<double>(done) / static_cast<double>(of)
                                     : 0.0;
    try // nothing through DCMTK
    {
      progress->report(std::min(fraction, 1.0), (sends ? "sending, " : "receiving, ") +
                                                    std::to_string(done) + " of " +
                                                    std::to_string(of));
    }
    catch (const core::CancelledError&)
    {
      watch->end(ConnectionWatch::End::Cancelled);
    }
    catch (...)
    {
      watch->fail(std::current_exception());
    }
  }
};

void onStoreProgress(void* data, T_DIMSE_StoreProgress* progress, T_DIMSE_C_StoreRQ*)
{
  static_cast<ByteCounter*>(data)->at(
      static_cast<std::uintmax_t>(std::max(progress->progressBytes, 0L)));
}

void onReceiveProgress(void* data, unsigned long bytes)
{
  static_cast<ByteCounter*>(data)->at(bytes);
}

DIC_US sendFile(const Association& association, const OutgoingFile& file, ByteCounter& counter)
{
  auto context = association.context(file.sopClass, file.transferSyntax);
  if (context == 0)
    context = association.context(file.sopClass);
  if (context == 0)
    return 0x0122; // SOP class not supported
  T_DIMSE_C_StoreRQ request{};
  request.MessageID = association.get()->nextMsgID++;
  OFStandard::strlcpy(request.AffectedSOPClassUID, file.sopClass.c_str(),
                      sizeof request.AffectedSOPClassUID);
  OFStandard::strlcpy(request.AffectedSOPInstanceUID, file.uid.c_str(),
                      sizeof request.AffectedSOPInstanceUID);
  request.DataSetType = DIMSE_DATASET_PRESENT;
  request.Priority = DIMSE_PRIORITY_MEDIUM;
  DcmFileFormat content;
  if (content.loadFile(file.path.c_str()).bad())
    throw core::InvalidParameter(file.path.string() + ": cannot be read any more");
  T_DIMSE_C_StoreRSP response{};
  DcmDataset* detail = nullptr;
  const OFCondition result = DIMSE_storeUser(
      association.get(), context, &request, nullptr, content.getDataset(), onStoreProgress,
      &counter, DIMSE_NONBLOCKING, association.timeout(), &response, &detail);
  delete detail;
  association.require(result, "sending");
  return response.DimseStatus;
}

/// What two associations send: the first one takes at the end, the second one at the front.
struct Outbox
{
  std::mutex mutex; ///< of all
  std::deque<OutgoingFile> waiting;
  std::size_t inSecondHand = 0; ///< files that are neither waiting nor confirmed: 0 or 1
  std::size_t warned = 0;       ///< of the confirmed ones
  std::uintmax_t bytes = 0;     ///< confirmed

  void confirm(const OutgoingFile& file, DIC_US status)
  {
    bytes += file.bytes;
    warned += status == STATUS_Success ? 0 : 1;
  }
};

bool isConfirmed(DIC_US status)
{
  return status == STATUS_Success || isWarning(status);
}

/// A second association that sends while the first one does: a node answers to an instance when it
/// is stored and indexed, and works for one association meanwhile. Where the node refuses it, or
/// anything else goes wrong with it, it ends and gives its file back, and the first association
/// meets the fault.
class SecondSender
{
public:
  SecondSender(const Node& node, std::vector<Context> contexts, Outbox& outbox)
    : m_outbox(outbox)
    , m_thread([this, &node, contexts = std::move(contexts)] { run(node, contexts); })
  {
  }
  ~SecondSender()
  {
    m_token->cancel();
    m_thread.join();
  }
  SecondSender(const SecondSender&) = delete;
  SecondSender& operator=(const SecondSender&) = delete;

  /// Takes no more files; returns when its last one is confirmed or given back.
  void finish()
  {
    std::unique_lock<std::mutex> lock(m_outbox.mutex);
    m_finished = true;
    m_idle.wait(lock, [this] { return m_outbox.inSecondHand == 0; });
  }

private:
  void run(const Node& node, const std::vector<Context>& contexts)
  {
    const core::Progress progress({}, m_token); // the first association reports, for both
    std::optional<OutgoingFile> file;
    try
    {
      Association association(node, contexts, progress);
      ByteCounter counter;
      counter.watch = &association.watch();
      counter.progress = &progress;
      while ((file = next()))
      {
        const DIC_US status = sendFile(association, *file, counter);
        if (!isConfirmed(status))
          break;
        const std::lock_guard<std::mutex> lock(m_outbox.mutex);
        m_outbox.confirm(*file, status);
        file.reset();
        setIdle();
      }
      if (!file)
        association.release();
    }
    catch (...)
    {
    }
    const std::lock_guard<std::mutex> lock(m_outbox.mutex);
    if (file)
      m_outbox.waiting.push_front(*file);
    setIdle();
  }

  /// The last one is the first association's.
  std::optional<OutgoingFile> next()
  {
    const std::lock_guard<std::mutex> lock(m_outbox.mutex);
    if (m_finished || m_outbox.waiting.size() < 2)
      return std::nullopt;
    OutgoingFile file = m_outbox.waiting.front();
    m_outbox.waiting.pop_front();
    m_outbox.inSecondHand = 1;
    return file;
  }

  void setIdle()
  {
    m_outbox.inSecondHand = 0;
    m_idle.notify_all();
  }

  const std::shared_ptr<core::CancelToken> m_token = std::make_shared<core::CancelToken>();
  Outbox& m_outbox;
  bool m_finished = false;
  std::condition_variable m_idle;
  std::thread m_thread; // last: it uses the others
};

/// Whether trying again may help.
bool isTransient(const NetworkError& error)
{
  return error.reason == Reason::Cut || error.reason == Reason::TimedOut ||
         error.reason == Reason::Incomplete;
}

/// The instances of the files that the node says that it has; nullopt if it offers no queries.
std::optional<std::set<std::string>> heldThere(const Association& association,
                                               const std::vector<OutgoingFile>& files)
{
  if (association.context(UID_FINDStudyRootQueryRetrieveInformationModel) == 0)
    return std::nullopt;
  std::set<std::pair<std::string, std::string>> series;
  for (const OutgoingFile& file : files)
    series.emplace(file.studyUid, file.seriesUid);
  std::set<std::string> held;
  for (const auto& [studyUid, seriesUid] : series)
    for (const auto& [uid, instance] : instancesIn(association, studyUid, {seriesUid}))
      held.insert(uid);
  return held;
}

// --- C-GET ---

std::string fileNameOf(const std::string& instanceUid)
{
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned length = 0;
  EVP_Digest(instanceUid.data(), instanceUid.size(), digest.data(), &length, EVP_sha256(), nullptr);
  std::string name;
  constexpr const char* kDigits = "0123456789abcdef";
  for (unsigned n = 0; n < 16; ++n)
  {
    name += kDigits[digest[n] >> 4];
    name += kDigits[digest[n] & 0xF];
  }
  return name + kInstanceEnding;
}

/// Brings files to the disk on a thread of its own while the next ones are received: each is synced
/// and then renamed, so that a name never stands for half a file.
class Keeper
{
public:
  explicit Keeper(fs::path folder)
    : m_folder(std::move(folder))
  {
  }
  ~Keeper()
  {
    {
      const std::lock_guard lock(m_mutex);
      m_ended = true;
      m_end = Clock::now() + kLongestEnd;
    }
    m_changed.notify_all();
    if (m_thread.joinable())
      m_thread.join(); // what was received is kept for the next time, as far as the disk keeps up
  }
  Keeper(const Keeper&) = delete;
  Keeper& operator=(const Keeper&) = delete;

  /// Waits where the disk is far behind.
  void keep(const fs::path& received, const fs::path& name)
  {
    std::unique_lock lock(m_mutex);
    if (!m_thread.joinable())
      m_thread = std::thread([this] { run(); });
    m_changed.wait(lock, [this] { return m_waiting.size() < kMaxWaiting || m_error != 0; });
    m_waiting.emplace_back(received, name);
    m_changed.notify_all();
  }

  /// Waits until all are on the disk. Returns errno of the first that is not, or 0.
  int settle(const core::Progress& progress)
  {
    constexpr std::chrono::milliseconds kStep(100);
    std::unique_lock lock(m_mutex);
    while (!m_changed.wait_for(lock, kStep, [this] { return m_waiting.empty() && !m_isAtWork; }))
    {
      lock.unlock();
      progress.check("bringing to the disk");
      lock.lock();
    }
    return std::exchange(m_error, 0);
  }

private:
  static constexpr std::size_t kMaxWaiting = 64;
  /// For which a transfer that ended early is kept waiting by a slow disk.
  static constexpr std::chrono::seconds kLongestEnd{2};

  static int sync(const fs::path& file)
  {
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
      return errno;
    const int error = ::fsync(descriptor) == 0 || errno == EINVAL ? 0 : errno; // EINVAL: of file
    ::close(descriptor);                                                       // systems without
    return error;
  }

  void run()
  {
    bool isFolderSynced = true;
    std::unique_lock lock(m_mutex);
    for (;;)
    {
      m_changed.wait(lock, [this] { return !m_waiting.empty() || m_ended; });
      if (m_waiting.empty())
        return;
      const auto [received, name] = m_waiting.front();
      m_waiting.pop_front();
      m_isAtWork = true;
      const bool isLast = m_waiting.empty();
      const bool failed = m_error != 0 || (m_ended && Clock::now() > m_end);
      lock.unlock();
      std::error_code fault;
      int error = failed ? EIO : sync(received);
      if (error == 0)
      {
        fs::rename(received, name, fault);
        error = fault.value();
      }
      if (error != 0)
        fs::remove(received, fault);
      else
        isFolderSynced = false;
      if (isLast && !isFolderSynced)
      {
        core::syncFolder(m_folder);
        isFolderSynced = true;
      }
      lock.lock();
      m_error = m_error == 0 ? error : m_error;
      m_isAtWork = false;
      m_changed.notify_all();
    }
  }

  const fs::path m_folder;
  std::mutex m_mutex;
  std::condition_variable m_changed;
  std::deque<std::pair<fs::path, fs::path>> m_waiting; ///< received file, its name
  int m_error = 0;
  bool m_isAtWork = false;
  bool m_ended = false;
  Clock::time_point m_end{};
  std::thread m_thread;
};

// Files on their way, "part-PID-N.tmp"; those of a program that was killed hold a patient's data.
fs::path partFile(const fs::path& folder, std::size_t n)
{
  return folder / ("part-" + std::to_string(::getpid()) + '-' + std::to_string(n) + ".tmp");
}

void removePartsOfTheDead(const fs::path& folder) noexcept
{
  std::error_code fault;
  for (fs::directory_iterator file(folder, fault), end; !fault && file != end;
       file.increment(fault))
  {
    int pid = 0, count = 0;
    unsigned number = 0;
    const std::string name = file->path().filename().string();
    std::error_code ignored;
    if (std::sscanf(name.c_str(), "part-%9d-%9u.tmp%n", &pid, &number, &count) == 2 &&
        static_cast<std::size_t>(count) == name.size() && pid > 0 && ::kill(pid, 0) != 0 &&
        errno == ESRCH)
      fs::remove(file->path(), ignored);
  }
}

/// What is asked for, and what of it has arrived.
class Reception
{
public:
  Reception(const Node& node, Study study, Instances expected, fs::path folder)
    : m_node(node)
    , m_study(std::move(study))
    , m_expected(std::move(expected))
    , m_folder(std::move(folder))
    , m_keeper(m_folder)
  {
    for (const auto& [uid, instance] : m_expected)
      m_series.insert(instance.seriesUid);
  }

  const Study& study() const noexcept { return m_study; }
  std::size_t expected() const noexcept { return m_expected.size(); }
  std::size_t arrived() const noexcept { return m_arrived.size(); }
  std::size_t foreign() const noexcept { return m_foreign; }
  std::size_t otherNames() const noexcept { return m_otherNames; }
  /// Whether the node sends without end what it was not asked for, or sent already.
  bool overflows() const noexcept { return m_superfluous > m_expected.size() + kMaxSuperfluous; }
  void beginRequest() noexcept { m_superfluous = 0; }
  const std::set<std::string>& series() const noexcept { return m_series; }
  const fs::path& folder() const noexcept { return m_folder; }

  std::set<std::string> sopClasses() const
  {
    std::set<std::string> classes;
    for (const auto& [uid, instance] : m_expected)
      classes.insert(instance.sopClass);
    if (classes.erase("") > 0)
      classes.insert(kReadClasses.begin(), kReadClasses.end());
    return classes;
  }

  /// By series.
  std::map<std::string, std::vector<std::string>> missing() const
  {
    std::map<std::string, std::vector<std::string>> result;
    for (const auto& [uid, instance] : m_expected)
      if (m_arrived.count(uid) == 0)
        result[instance.seriesUid].push_back(uid);
    return result;
  }
  std::size_t sizeOf(const std::string& seriesUid) const
  {
    return static_cast<std::size_t>(std::count_if(m_expected.begin(), m_expected.end(),
                                                  [&](const auto& one)
                                                  { return one.second.seriesUid == seriesUid; }));
  }

  /// Takes what an earlier transfer left.
  void resume()
  {
    removePartsOfTheDead(m_folder);
    for (const auto& [uid, instance] : m_expected)
    {
      const fs::path file = m_folder / fileNameOf(uid);
      std::error_code ignored;
      if (fs::is_regular_file(file, ignored) && check(file, uid) == STATUS_Success)
        m_arrived.insert(uid);
    }
    m_foreign = 0;
  }

  /// The status that answers a file which was received in whole; keeps or removes it.
  DIC_US take(const fs::path& received, const std::string& uid)
  {
    const DIC_US status = check(received, uid);
    std::error_code fault;
    if (status != STATUS_Success)
    {
      fs::remove(received, fault);
      return status;
    }
    if (m_expected.count(uid) == 0 || m_arrived.count(uid) != 0)
      ++m_superfluous;
    if (m_expected.count(uid) == 0) // arrived at the node since it was asked
    {
      fs::remove(received, fault);
      return STATUS_Success;
    }
    m_keeper.keep(received, m_folder / fileNameOf(uid));
    m_arrived.insert(uid);
    return STATUS_Success;
  }

  /// Name of the file to be received next.
  fs::path nextPart() { return partFile(m_folder, m_parts++); }

  /// Waits until what has arrived is on the disk; what is not counts as missing. Returns errno of
  /// the first that is not, or 0.
  int settle(const core::Progress& progress)
  {
    const int error = m_keeper.settle(progress);
    std::error_code ignored;
    for (auto uid = m_arrived.begin(); error != 0 && uid != m_arrived.end();)
      uid = fs::is_regular_file(m_folder / fileNameOf(*uid), ignored) ? std::next(uid)
                                                                      : m_arrived.erase(uid);
    return error;
  }

private:
  DIC_US check(const fs::path& path, const std::string& uid)
  {
    DcmFileFormat file;
    if (!imaging::canBeInflated(path) ||
        file.loadFile(path.c_str(), EXS_Unknown, EGL_noChange, 4096).bad())
    {
      ++m_superfluous; // a node that sends such without end is left
      return 0xC000;   // cannot understand
    }
    DcmDataset& data = *file.getDataset();
    const std::string patient = text(data, DCM_PatientID);
    // The answer to the query may lack it, or be in another character set: then all are compared
    // with the first.
    const auto isAscii = [](char c) { return static_cast<unsigned char>(c) < 128; };
    if (m_arrived.empty() &&
        (m_study.patientId.empty() ||
         !std::all_of(m_study.patientId.begin(), m_study.patientId.end(), isAscii)))
      m_study.patientId = patient;
    const Person person{text(data, DCM_IssuerOfPatientID), text(data, DCM_PatientBirthDate),
                        folded(text(data, DCM_PatientName))};
    if (text(data, DCM_StudyInstanceUID) != m_study.uid ||
        m_series.count(text(data, DCM_SeriesInstanceUID)) == 0 ||
        text(data, DCM_SOPInstanceUID) != uid || patient != m_study.patientId ||
        contradict(person.issuer, m_person.issuer) ||
        contradict(person.birthDate, m_person.birthDate))
    {
      ++m_foreign;
      return 0xA900; // data set does not match
    }
    const auto state = [](std::string& known, const std::string& stated)
    {
      if (known.empty())
        known = stated;
    };
    state(m_person.issuer, person.issuer);
    state(m_person.birthDate, person.birthDate);
    state(m_person.name, person.name);
    m_otherNames += contradict(person.name, m_person.name) ? 1 : 0;
    return STATUS_Success;
  }

  /// What tells patients of one ID apart; empty: not stated. For comparisons only.
  struct Person
  {
    std::string issuer, birthDate, name;
  };

  static bool contradict(const std::string& a, const std::string& b)
  {
    return !a.empty() && !b.empty() && a != b;
  }

  // "Doe^Jane^^" as "DOE JANE".
  static std::string folded(const std::string& name)
  {
    std::string text;
    for (const char c : name)
      if (c != '^' && c != ' ')
        text += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
      else if (!text.empty() && text.back() != ' ')
        text += ' ';
    return text.empty() || text.back() != ' ' ? text : text.substr(0, text.size() - 1);
  }

  const Node& m_node;
  Study m_study;
  Instances m_expected;
  fs::path m_folder;
  std::set<std::string> m_series;
  std::set<std::string> m_arrived;
  std::size_t m_foreign = 0;
  std::size_t m_otherNames = 0;
  Person m_person;               ///< of the files that are taken
  std::size_t m_superfluous = 0; ///< of one request
  std::size_t m_parts = 0;
  Keeper m_keeper;
};

/// Appends to a file. Unlike DCMTK's own, keeps what the disk said.
class AppendedFile : public DcmConsumer
{
public:
  explicit AppendedFile(const fs::path& path)
    : m_descriptor(::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC))
    , m_error(m_descriptor < 0 ? errno : 0)
  {
  }
  ~AppendedFile() override { close(); }
  AppendedFile(const AppendedFile&) = delete;
  AppendedFile& operator=(const AppendedFile&) = delete;

  /// Returns errno of the first failure, or 0.
  int close()
  {
    if (m_descriptor >= 0 && ::close(m_descriptor) != 0 && errno != EINTR && m_error == 0)
      m_error = errno;
    m_descriptor = -1;
    return m_error;
  }

  OFBool good() const override { return m_error == 0; }
  OFCondition status() const override { return good() ? EC_Normal : EC_InvalidStream; }
  OFBool isFlushed() const override { return OFTrue; }
  offile_off_t avail() const override { return std::numeric_limits<offile_off_t>::max(); }
  offile_off_t write(const void* bytes, offile_off_t count) override
  {
    if (m_error == 0)
      m_error = core::writeAll(m_descriptor, bytes, static_cast<std::size_t>(count));
    return good() ? count : 0;
  }
  void flush() override {}

private:
  int m_descriptor;
  int m_error;
};

class AppendingStream : public DcmOutputStream
{
public:
  explicit AppendingStream(AppendedFile& file)
    : DcmOutputStream(&file)
  {
  }
};

/// A file of the meta information, to which the data set is appended. Throws
/// core::OutputFileError.
void beginFile(const fs::path& part, T_ASC_Association* association,
               T_ASC_PresentationContextID context, const T_DIMSE_C_StoreRQ& request)
{
  errno = 0;
  DcmOutputFileStream* opened = nullptr;
  const OFCondition made =
      DIMSE_createFilestream(part.c_str(), &request, association, context, 1, &opened);
  const int error = errno;
  std::unique_ptr<DcmOutputFileStream> stream(opened);
  const offile_off_t size = made.good() ? stream->tell() : 0;
  stream.reset(); // what the disk says then is lost
  std::error_code fault;
  if (made.bad() || fs::file_size(part, fault) != static_cast<std::uintmax_t>(size) || fault)
  {
    fs::remove(part, fault);
    core::throwOutputError(made.bad() && error != 0 ? error : ENOSPC, part.parent_path());
  }
}

/// Receives the data set of a C-STORE request to the disk, and answers it. Throws
/// core::OutputFileError if the disk does not take it.
OFCondition receiveInstance(T_ASC_Association* association, int timeout,
                            T_ASC_PresentationContextID context, T_DIMSE_C_StoreRQ& request,
                            Reception& reception, ByteCounter& counter, Transfer& transfer)
{
  const fs::path part = reception.nextPart();
  const std::string uid = request.AffectedSOPInstanceUID;
  beginFile(part, association, context, request);
  AppendedFile file(part);
  AppendingStream stream(file);
  const OFCondition result = DIMSE_receiveDataSetInFile(
      association, DIMSE_NONBLOCKING, timeout, &context, &stream, onReceiveProgress, &counter);
  if (const int error = file.close())
  {
    std::error_code ignored;
    fs::remove(part, ignored);
    core::throwOutputError(error, reception.folder());
  }
  std::error_code ignored;
  if (result.bad())
  {
    fs::remove(part, ignored);
    return result;
  }
  const std::uintmax_t bytes = fs::file_size(part, ignored);
  transfer.bytes += bytes;
  counter.before += bytes;
  const DIC_US status = reception.take(part, uid);
  counter.done = reception.arrived();
  counter.at(0);
  T_DIMSE_C_StoreRSP response{};
  response.MessageIDBeingRespondedTo = request.MessageID;
  response.DimseStatus = status;
  response.DataSetType = DIMSE_DATASET_NULL;
  OFStandard::strlcpy(response.AffectedSOPClassUID, request.AffectedSOPClassUID,
                      sizeof response.AffectedSOPClassUID);
  OFStandard::strlcpy(response.AffectedSOPInstanceUID, request.AffectedSOPInstanceUID,
                      sizeof response.AffectedSOPInstanceUID);
  response.opts = O_STORE_AFFECTEDSOPCLASSUID | O_STORE_AFFECTEDSOPINSTANCEUID;
  return DIMSE_sendStoreResponse(association, context, &request, &response, nullptr);
}

DcmDataset retrieveRequest(const Reception& reception, const std::string& seriesUid,
                           const std::vector<std::string>& uids)
{
  DcmDataset query;
  put(query, DCM_QueryRetrieveLevel, uids.empty() ? "SERIES" : kImageLevel);
  put(query, DCM_StudyInstanceUID, reception.study().uid);
  put(query, DCM_SeriesInstanceUID, seriesUid);
  if (!uids.empty())
  {
    std::string list;
    for (const std::string& uid : uids)
      list += (list.empty() ? "" : "\\") + uid;
    put(query, DCM_SOPInstanceUID, list);
  }
  return query;
}

/// One C-GET request until its final response. Returns the final status; the node's counts of
/// sub-operations are not believed, only what arrives is.
DIC_US getInstances(const Association& association, DcmDataset& query, Reception& reception,
                    ByteCounter& counter, Transfer& transfer)
{
  const std::string task = "receiving";
  const auto context = association.context(UID_GETStudyRootQueryRetrieveInformationModel);
  T_DIMSE_Message message{};
  message.CommandField = DIMSE_C_GET_RQ;
  message.msg.CGetRQ.MessageID = association.get()->nextMsgID++;
  OFStandard::strlcpy(message.msg.CGetRQ.AffectedSOPClassUID,
                      UID_GETStudyRootQueryRetrieveInformationModel,
                      sizeof message.msg.CGetRQ.AffectedSOPClassUID);
  message.msg.CGetRQ.Priority = DIMSE_PRIORITY_MEDIUM;
  message.msg.CGetRQ.DataSetType = DIMSE_DATASET_PRESENT;
  const DIC_US id = message.msg.CGetRQ.MessageID;
  association.require(DIMSE_sendMessageUsingMemoryData(association.get(), context, &message,
                                                       nullptr, &query, nullptr, nullptr),
                      task);
  for (;;)
  {
    T_ASC_PresentationContextID on = 0;
    T_DIMSE_Message answer{};
    DcmDataset* detail = nullptr;
    const OFCondition result = DIMSE_receiveCommand(association.get(), DIMSE_NONBLOCKING,
                                                    association.timeout(), &on, &answer, &detail);
    delete detail;
    association.require(result, task);
    if (answer.CommandField == DIMSE_C_STORE_RQ)
    {
      association.require(receiveInstance(association.get(), association.timeout(), on,
                                          answer.msg.CStoreRQ, reception, counter, transfer),
                          task);
      if (reception.foreign() > 0 || reception.overflows())
        return STATUS_Success; // ended by the caller
      continue;
    }
    if (answer.CommandField != DIMSE_C_GET_RSP ||
        answer.msg.CGetRSP.MessageIDBeingRespondedTo != id)
      association.fail(DIMSE_BADCOMMANDTYPE, task);
    if (answer.msg.CGetRSP.DataSetType != DIMSE_DATASET_NULL) // the list of those that failed
    {
      DcmDataset* failed = nullptr;
      const OFCondition read =
          DIMSE_receiveDataSetInMemory(association.get(), DIMSE_NONBLOCKING, association.timeout(),
                                       &on, &failed, nullptr, nullptr);
      delete failed;
      association.require(read, task);
    }
    if (!DICOM_PENDING_STATUS(answer.msg.CGetRSP.DimseStatus))
      return answer.msg.CGetRSP.DimseStatus;
  }
}

[[noreturn]] void failForeign(const Node& node)
{
  throw NetworkError(Reason::Foreign,
                     place(node) + ": sent an instance of another patient, study or series than "
                                   "was asked for; the transfer was ended");
}

[[noreturn]] void failOverflow(const Node& node)
{
  throw NetworkError(Reason::Protocol, place(node) + ": sends more instances than it was asked "
                                                     "for, without end; the transfer was ended");
}

std::vector<Context> getContexts(const Reception& reception)
{
  std::vector<Context> contexts{{UID_GETStudyRootQueryRetrieveInformationModel, kUncompressed},
                                {UID_MOVEStudyRootQueryRetrieveInformationModel, kUncompressed}};
  const std::set<std::string> classes = reception.sopClasses();
  // One context per class and syntax, so that each object can come as it is stored.
  const std::size_t syntaxes =
      std::clamp((kMaxContexts - 2) / std::max<std::size_t>(classes.size(), 1), std::size_t{1},
                 kTransferSyntaxes.size());
  for (const std::string& sopClass : classes)
    for (std::size_t n = 0; n < syntaxes; ++n)
      contexts.push_back({sopClass, {kTransferSyntaxes[n]}, true});
  return contexts;
}

/// The addresses of a host, as text; none if the name is not known.
std::set<std::string> addressesOf(const std::string& host)
{
  std::set<std::string> found;
  addrinfo* first = nullptr;
  if (::getaddrinfo(host.c_str(), nullptr, nullptr, &first) != 0)
    return found;
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> all(first, &::freeaddrinfo);
  for (const addrinfo* one = first; one; one = one->ai_next)
  {
    std::array<char, NI_MAXHOST> name{};
    if (::getnameinfo(one->ai_addr, one->ai_addrlen, name.data(), name.size(), nullptr, 0,
                      NI_NUMERICHOST) == 0)
      found.insert(name.data());
  }
  return found;
}

std::string addressOfPeer(int descriptor)
{
  sockaddr_storage peer{};
  socklen_t size = sizeof peer;
  std::array<char, NI_MAXHOST> name{};
  if (::getpeername(descriptor, reinterpret_cast<sockaddr*>(&peer), &size) != 0 ||
      ::getnameinfo(reinterpret_cast<const sockaddr*>(&peer), size, name.data(), name.size(),
                    nullptr, 0, NI_NUMERICHOST) != 0)
    return {};
  return name.data();
}

/// Storage provider for what a node sends by C-MOVE, on a thread of its own: one association at a
/// time, as nodes open one per request. Only the node is served, by its address and its AE title.
class MoveReceiver
{
public:
  MoveReceiver(const Node& node, Reception& reception, ByteCounter& counter, Transfer& transfer,
               const core::Progress& progress)
    : m_node(node)
    , m_reception(reception)
    , m_counter(counter)
    , m_transfer(transfer)
    , m_watch(progress, node.timeouts.reply)
  {
    if (node.tls && node.tls->authority.empty())
      throw NetworkError(
          Reason::Tls, place(node) + ": C-MOVE with TLS needs the certificates to trust: those of "
                                     "the system would let anyone send; see 'petrous nodes add "
                                     "--tls-ca'");
    if (node.tls && node.tls->certificate.empty())
      throw NetworkError(Reason::Tls, place(node) + ": C-MOVE with TLS needs a certificate of this "
                                                    "program; see 'petrous nodes add --tls-cert'");
    counter.receiver = &m_watch;
    if (node.moveHost != kAnyName)
      m_senders = addressesOf(node.moveHost.empty() ? node.host : node.moveHost);
    m_layer = transportLayer(node, m_watch, [this](int descriptor) { return admits(descriptor); });
    if (ASC_initializeNetwork(NET_ACCEPTOR, node.movePort, 30, &m_network).bad())
      throw NetworkError(Reason::Unreachable, place(node) +
                                                  ": this program cannot listen at port " +
                                                  std::to_string(node.movePort) +
                                                  " for C-MOVE; is it in use, or below 1024?");
    ASC_setTransportLayer(m_network, m_layer.get(), 0);
    m_thread = std::thread([this] { run(); });
  }
  ~MoveReceiver()
  {
    stop();
    m_counter.receiver = nullptr;
  }
  MoveReceiver(const MoveReceiver&) = delete;
  MoveReceiver& operator=(const MoveReceiver&) = delete;

  /// After this the reception is the caller's again. Throws what the disk did, and NetworkError
  /// (Rejected) if nothing was received, as it came from elsewhere.
  void finish()
  {
    stop();
    if (m_fault)
      std::rethrow_exception(m_fault);
    if (!m_served && !m_refused.empty())
      throw NetworkError(Reason::Rejected,
                         place(m_node) + ": nothing was received by C-MOVE: " + m_refused);
  }

private:
  bool admits(int descriptor)
  {
    if (m_node.moveHost == kAnyName || m_senders.count(addressOfPeer(descriptor)) != 0)
      return true;
    m_refused = "a connection of another host was refused; if the node sends from another one, "
                "change it in the node (--move-host)";
    return false;
  }

  void stop()
  {
    m_stop = true;
    if (m_thread.joinable())
      m_thread.join();
    if (m_network)
      ASC_dropNetwork(&m_network);
  }

  void run()
  {
    while (!m_stop)
    {
      // In slices, so that it can be stopped.
      if (!ASC_associationWaiting(m_network, 0))
      {
        ::poll(nullptr, 0, 5);
        continue;
      }
      T_ASC_Association* association = nullptr;
      // Who connects and says nothing does not keep the node waiting.
      m_watch.begin(std::min<std::chrono::milliseconds>(kNegotiation, m_node.timeouts.reply / 4));
      if (ASC_receiveAssociation(m_network, &association, ASC_MAXIMUMPDUSIZE, nullptr, nullptr,
                                 m_node.tls ? OFTrue : OFFalse)
              .good())
        try
        {
          m_watch.begin(m_node.timeouts.reply);
          serve(association);
        }
        catch (...)
        {
          m_fault = std::current_exception();
          ASC_abortAssociation(association);
        }
      m_watch.forget();
      ASC_dropSCPAssociation(association, 0);
      ASC_destroyAssociation(&association);
    }
  }

  void serve(T_ASC_Association* association)
  {
    std::vector<std::string> classes{UID_VerificationSOPClass};
    for (const std::string& sopClass : m_reception.sopClasses())
      classes.push_back(sopClass);
    for (const std::string& sopClass : classes)
    {
      const char* syntax = sopClass.c_str();
      ASC_acceptContextsWithPreferredTransferSyntaxes(
          association->params, &syntax, 1, const_cast<const char**>(kTransferSyntaxes.data()),
          static_cast<int>(kTransferSyntaxes.size()));
    }
    const auto reject = [association](T_ASC_RejectParametersReason why)
    {
      const T_ASC_RejectParameters unknown{ASC_RESULT_REJECTEDPERMANENT, ASC_SOURCE_SERVICEUSER,
                                           why};
      ASC_rejectAssociation(association, &unknown);
    };
    if (m_node.callingAeTitle != association->params->DULparams.calledAPTitle)
      return reject(ASC_REASON_SU_CALLEDAETITLENOTRECOGNIZED);
    if (m_node.aeTitle != association->params->DULparams.callingAPTitle)
    {
      m_refused = "what connected does not call itself '" + m_node.aeTitle + "'";
      return reject(ASC_REASON_SU_CALLINGAETITLENOTRECOGNIZED);
    }
    if (ASC_acknowledgeAssociation(association).bad())
      return;
    m_served = true;
    while (!m_stop)
    {
      T_ASC_PresentationContextID context = 0;
      T_DIMSE_Message message{};
      DcmDataset* detail = nullptr;
      const OFCondition result =
          DIMSE_receiveCommand(association, DIMSE_NONBLOCKING, 1, &context, &message, &detail);
      delete detail;
      if (result == DIMSE_NODATAAVAILABLE)
        continue;
      if (result == DUL_PEERREQUESTEDRELEASE)
        ASC_acknowledgeRelease(association);
      if (result.bad())
        return;
      m_watch.active();
      if (message.CommandField == DIMSE_C_ECHO_RQ)
        DIMSE_sendEchoResponse(association, context, &message.msg.CEchoRQ, STATUS_Success, nullptr);
      else if (message.CommandField != DIMSE_C_STORE_RQ ||
               receiveInstance(association, 2, context, message.msg.CStoreRQ, m_reception,
                               m_counter, m_transfer)
                   .bad() ||
               m_reception.overflows())
        return;
    }
  }

  const Node& m_node;
  Reception& m_reception;
  ByteCounter& m_counter;
  Transfer& m_transfer;
  ConnectionWatch m_watch;
  std::unique_ptr<DcmTransportLayer> m_layer;
  T_ASC_Network* m_network = nullptr;
  std::atomic<bool> m_stop{false};
  std::set<std::string> m_senders; ///< addresses
  // Of the thread, until it ended.
  std::exception_ptr m_fault;
  std::string m_refused; ///< why, the latest
  bool m_served = false;
  std::thread m_thread;
};

struct MoveCall
{
  const Association* association;
};

void onMoveAnswer(void* data, T_DIMSE_C_MoveRQ*, int, T_DIMSE_C_MoveRSP*)
{
  static_cast<MoveCall*>(data)->association->watch().active();
}

DIC_US moveInstances(const Association& association, DcmDataset& query)
{
  T_DIMSE_C_MoveRQ request{};
  request.MessageID = association.get()->nextMsgID++;
  OFStandard::strlcpy(request.AffectedSOPClassUID, UID_MOVEStudyRootQueryRetrieveInformationModel,
                      sizeof request.AffectedSOPClassUID);
  OFStandard::strlcpy(request.MoveDestination, association.node().callingAeTitle.c_str(),
                      sizeof request.MoveDestination);
  request.Priority = DIMSE_PRIORITY_MEDIUM;
  request.DataSetType = DIMSE_DATASET_PRESENT;
  T_DIMSE_C_MoveRSP response{};
  MoveCall call{&association};
  DcmDataset* detail = nullptr;
  DcmDataset* failed = nullptr;
  const OFCondition result = DIMSE_moveUser(
      association.get(), association.context(UID_MOVEStudyRootQueryRetrieveInformationModel),
      &request, &query, onMoveAnswer, &call, DIMSE_NONBLOCKING, association.timeout(), nullptr,
      nullptr, nullptr, &response, &detail, &failed);
  delete detail;
  delete failed;
  association.require(result, "receiving");
  return response.DimseStatus;
}

/// Asks for everything that is missing, once.
void fetchMissing(const Node& node, Reception& reception, ByteCounter& counter, Transfer& transfer,
                  const core::Progress& progress)
{
  Association association(node, getContexts(reception), progress);
  const bool canGet = association.context(UID_GETStudyRootQueryRetrieveInformationModel) != 0;
  const bool canMove = association.context(UID_MOVEStudyRootQueryRetrieveInformationModel) != 0;
  const bool gets = canGet && (node.movePort == 0 || !canMove);
  if (!gets && (node.movePort == 0 || !canMove))
    throw NetworkError(
        Reason::Unsupported,
        place(node) + (canMove ? ": offers retrieval by C-MOVE only; add it with --move-port, and "
                                 "have this program's AE title, host and port added there"
                               : ": offers no retrieval (C-GET or C-MOVE)"));
  counter.watch = &association.watch();
  DIC_US refusal = STATUS_Success;
  for (const auto& [series, uids] : reception.missing())
  {
    const bool whole = uids.size() == reception.sizeOf(series);
    const std::size_t most = whole ? uids.size() : kMaxUidsAsked;
    for (std::size_t first = 0; first < uids.size(); first += most)
    {
      std::vector<std::string> these;
      if (!whole)
        these.assign(uids.begin() + static_cast<std::ptrdiff_t>(first),
                     uids.begin() +
                         static_cast<std::ptrdiff_t>(std::min(first + most, uids.size())));
      DcmDataset query = retrieveRequest(reception, series, these);
      DIC_US status = STATUS_Success;
      reception.beginRequest();
      if (gets)
        status = getInstances(association, query, reception, counter, transfer);
      else
      {
        MoveReceiver receiver(node, reception, counter, transfer, progress);
        status = moveInstances(association, query);
        receiver.finish();
      }
      if (reception.foreign() > 0)
        failForeign(node);
      if (reception.overflows())
        failOverflow(node);
      if (status != STATUS_Success && !isWarning(status))
        refusal = status;
    }
  }
  association.release();
  if (refusal != STATUS_Success && !reception.missing().empty())
    throw NetworkError(Reason::Failed, place(node) + ": ended the retrieval, " +
                                           std::to_string(reception.arrived()) + " of " +
                                           numberOf(reception.expected(), "instance") +
                                           " arrived: " + statusText(refusal));
}

constexpr int kMaxListings = 2;

void pause(std::chrono::milliseconds time, const core::Progress& progress)
{
  constexpr std::chrono::milliseconds kStep{50};
  for (const auto end = Clock::now() + time; Clock::now() < end; std::this_thread::sleep_for(kStep))
    progress.check("waiting for the node's list");
}

double secondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

} // namespace

void checkNode(const Node& node)
{
  const auto refuse = [&node](const std::string& what)
  {
    throw core::InvalidParameter("DICOM node '" +
                                 (core::isUtf8(node.name) ? core::printable(node.name) : "?") +
                                 "': " + what);
  };
  const auto isVisible = [](const std::string& value, char least)
  {
    return std::all_of(value.begin(), value.end(),
                       [least](char c) { return c >= least && c < 127; });
  };
  if (node.name.empty())
    throw core::InvalidParameter("DICOM node: give it a name");
  if (!core::isUtf8(node.name) || core::printable(node.name) != node.name)
    refuse("its name is UTF-8 text without control characters");
  if (node.host.empty() || !isVisible(node.host, '!') ||
      node.host.find_first_of("/:") != std::string::npos)
    refuse("the host is a name or an IPv4 address, without a port");
  if (!isVisible(node.moveHost, '!') || node.moveHost.find_first_of("/:") != std::string::npos)
    refuse("the host that sends by C-MOVE is a name or an IPv4 address, without a port, or " +
           std::string(kAnyName) + " for any");
  if (node.port < 1 || node.port > 65535)
    refuse("the port is between 1 and 65535");
  if (node.movePort < 0 || node.movePort > 65535)
    refuse("the port for C-MOVE is between 1 and 65535, or 0");
  for (const std::string& title : {node.aeTitle, node.callingAeTitle})
  {
    const bool printable = std::all_of(title.begin(), title.end(),
                                       [](char c) { return c > 31 && c < 127 && c != '\\'; });
    if (title.find_first_not_of(' ') == std::string::npos || title.size() > 16 || !printable)
      refuse("an AE title has 1 to 16 ASCII characters");
  }
  if (node.tls && node.tls->certificate.empty() != node.tls->key.empty())
    refuse("a TLS certificate and its key are given together");
  if (!node.tls)
    return;
  for (const std::string& file : {node.tls->authority, node.tls->certificate, node.tls->key})
    if (!core::isUtf8(file) || core::printable(file) != file)
      refuse("the paths of TLS files are UTF-8 text without control characters");
  if (!isVisible(node.tls->name, '!'))
    refuse("the name in its certificate is a host name or an IP address");
  if (node.tls->name == kAnyName && node.tls->authority.empty())
    refuse("certificates of any name are for trusted certificates of your own only; of the "
           "system's authorities everybody can have one");
}

void echo(const Node& node, const core::Progress& progress)
{
  prepareToolkit();
  checkNode(node);
  Association association(node, {{UID_VerificationSOPClass, kUncompressed}}, progress);
  DIC_US status = STATUS_Success;
  DcmDataset* detail = nullptr;
  const OFCondition result =
      DIMSE_echoUser(association.get(), association.get()->nextMsgID++, DIMSE_NONBLOCKING,
                     association.timeout(), &status, &detail);
  delete detail;
  association.require(result, "C-ECHO");
  association.release();
  if (status != STATUS_Success)
    throw NetworkError(Reason::Failed, place(node) + ": C-ECHO failed: " + statusText(status));
}

std::vector<Study> findStudies(const Node& node, const StudyFilter& filter,
                               const core::Progress& progress)
{
  prepareToolkit();
  checkNode(node);
  Association association(node, findContexts(), progress);
  auto found = studiesIn(association, filter);
  association.release();
  return found;
}

std::vector<Series> findSeries(const Node& node, const std::string& studyUid,
                               const core::Progress& progress)
{
  prepareToolkit();
  checkNode(node);
  Association association(node, findContexts(), progress);
  auto found = seriesIn(association, studyUid);
  association.release();
  return found;
}

std::vector<Instance> findInstances(const Node& node, const std::string& studyUid,
                                    const std::vector<std::string>& seriesUids,
                                    const core::Progress& progress)
{
  prepareToolkit();
  checkNode(node);
  Association association(node, findContexts(), progress);
  std::vector<Instance> list;
  for (auto& [uid, instance] : instancesIn(association, studyUid, seriesUids))
    list.push_back(instance);
  association.release();
  return list;
}

std::string seriesOfFile(const fs::path& file)
{
  return outgoing(file).seriesUid;
}

Transfer store(const Node& node, const std::vector<fs::path>& files, const core::Progress& progress)
{
  prepareToolkit();
  checkNode(node);
  const Clock::time_point start = Clock::now();
  std::vector<OutgoingFile> all;
  Outbox outbox;
  std::deque<OutgoingFile>& waiting = outbox.waiting;
  std::set<std::string> uids;
  ByteCounter counter;
  for (const fs::path& path : files)
  {
    progress.check("sending");
    all.push_back(outgoing(path));
    if (!uids.insert(all.back().uid).second)
      throw core::InvalidParameter(path.string() + ": has the SOP Instance UID of another file");
    counter.total += all.back().bytes;
  }
  Transfer transfer;
  transfer.instances = all.size();
  transfer.asked = 0;
  if (all.empty())
    return transfer;
  transfer.listed = Transfer::Listed::Unanswered;
  counter.progress = &progress;
  counter.sends = true;
  counter.of = all.size();
  waiting.assign(all.rbegin(), all.rend()); // sent from its end: in the order of the files
  DIC_US refusal = STATUS_Success;
  std::size_t refused = 0;
  std::uintmax_t refusedBytes = 0;
  std::size_t fewest = all.size(); // that were missing after a round
  bool counted = false;            // what was there already
  bool listed = false;             // the node said what it has, or cannot
  for (int idle = 0; !listed;)
  {
    ++transfer.asked;
    std::vector<OutgoingFile> unconfirmed;
    const auto sendAgain = [&]
    {
      waiting.insert(waiting.end(), unconfirmed.begin(), unconfirmed.end());
      unconfirmed.clear();
    };
    // A node whose list changes from one query to the next gets no further by that.
    const auto isIdle = [&]
    {
      const bool less = waiting.size() < fewest;
      fewest = std::min(fewest, waiting.size());
      return !less && ++idle >= kMaxIdleRounds;
    };
    try
    {
      Association association(node, storeContexts(all), progress);
      counter.watch = &association.watch();
      if (!waiting.empty())
        if (const auto held = heldThere(association, {waiting.begin(), waiting.end()}))
        {
          const auto isHeld = [&](const OutgoingFile& file) { return held->count(file.uid) != 0; };
          const auto end = std::remove_if(waiting.begin(), waiting.end(), isHeld);
          if (!std::exchange(counted, true))
            transfer.present = static_cast<std::size_t>(waiting.end() - end);
          waiting.erase(end, waiting.end());
        }
      refused = 0;
      std::optional<SecondSender> second;
      if (waiting.size() >= kManyFiles)
        second.emplace(node, storeContexts(all), outbox);
      for (;;)
      {
        counted = true;
        std::unique_lock<std::mutex> lock(outbox.mutex);
        if (waiting.empty() && second)
        {
          lock.unlock();
          second->finish(); // may give its file back
          lock.lock();
        }
        if (waiting.empty())
          break;
        const OutgoingFile file = waiting.back();
        counter.done = all.size() - waiting.size() - unconfirmed.size() - outbox.inSecondHand;
        counter.before = outbox.bytes + refusedBytes;
        lock.unlock();
        const DIC_US status = sendFile(association, file, counter);
        lock.lock();
        waiting.pop_back();
        if (isConfirmed(status))
          outbox.confirm(file, status);
        else
        {
          refusal = status;
          ++refused;
          refusedBytes += file.bytes;
          unconfirmed.push_back(file);
        }
      }
      second.reset();
      sendAgain();
      // A node may answer Success and not keep it. One that lists none of them has no index of
      // them, or not yet.
      if (waiting.empty())
      {
        auto held = heldThere(association, all);
        const auto listsNone = [&]
        {
          return held &&
                 std::none_of(all.begin(), all.end(),
                              [&](const OutgoingFile& file) { return held->count(file.uid) != 0; });
        };
        for (int again = 0; again < kMaxListings && listsNone(); ++again)
        {
          pause(node.timeouts.listing, progress);
          held = heldThere(association, all);
        }
        for (const OutgoingFile& file : all)
          if (held && held->count(file.uid) == 0)
            waiting.push_back(file);
        if (waiting.empty() || waiting.size() == all.size())
        {
          listed = true;
          transfer.listed = !held             ? Transfer::Listed::NotOffered
                            : waiting.empty() ? Transfer::Listed::All
                                              : Transfer::Listed::None;
          transfer.verified = transfer.listed == Transfer::Listed::All;
          waiting.clear();
        }
      }
      association.release();
    }
    catch (const NetworkError& error)
    {
      sendAgain();
      const bool confirmed = waiting.empty(); // only the node's list is wanting
      if (listed)
        break;
      if (isTransient(error) && !isIdle())
        continue;
      if (!confirmed && !isTransient(error))
        throw;
      if (!confirmed)
        throw NetworkError(error.reason, std::string(error.what()) + "; " +
                                             std::to_string(all.size() - waiting.size()) + " of " +
                                             numberOf(all.size(), "instance") + " were confirmed");
      break;
    }
    if (!listed && isIdle())
      throw NetworkError(
          Reason::Incomplete,
          place(node) + ": has " + std::to_string(all.size() - waiting.size()) + " of " +
              numberOf(all.size(), "instance") + " after " + std::to_string(transfer.asked) +
              " attempts" +
              (refused > 0 ? ": " + statusText(refusal) : ", although it confirmed them"));
  }
  transfer.bytes = outbox.bytes;
  transfer.warning = outbox.warned;
  transfer.completed = all.size();
  transfer.seconds = secondsSince(start);
  return transfer;
}

Transfer retrieve(const Node& node, const std::string& studyUid,
                  const std::vector<std::string>& seriesUids, const fs::path& folder,
                  const core::Progress& progress)
{
  prepareToolkit();
  checkNode(node);
  const Clock::time_point start = Clock::now();
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fault)
    throw core::Error(core::Fault::Refused, folder.string() + ": cannot be created");
  Study study;
  Instances expected;
  {
    Association association(node, findContexts(), progress);
    const auto studies = studiesIn(association, {studyUid, {}});
    if (studies.empty())
      throw NetworkError(Reason::NotFound, place(node) + ": has no such study");
    study = studies.front();
    std::vector<std::string> wanted = seriesUids;
    std::map<std::string, std::size_t> stated; // by series
    std::set<std::string> absent(seriesUids.begin(), seriesUids.end());
    for (const Series& series : seriesIn(association, studyUid))
    {
      absent.erase(series.uid);
      if (seriesUids.empty())
        wanted.push_back(series.uid);
      if (std::find(wanted.begin(), wanted.end(), series.uid) != wanted.end())
        stated[series.uid] = static_cast<std::size_t>(std::max(series.instances, 0));
    }
    expected = instancesIn(association, studyUid, wanted);
    association.release();
    if (!absent.empty())
      throw NetworkError(Reason::NotFound, place(node) + ": does not have " +
                                               std::to_string(absent.size()) +
                                               " of the series that were asked for");
    if (expected.empty())
      throw NetworkError(Reason::NotFound, place(node) + ": has no instances of that study");
    std::map<std::string, std::size_t> listed;
    for (const auto& [uid, instance] : expected)
      ++listed[instance.seriesUid];
    std::size_t total = 0;
    for (const auto& [series, count] : stated)
      total += std::max(count, listed[series]);
    if (seriesUids.empty())
      total = std::max(total, static_cast<std::size_t>(std::max(study.instances, 0)));
    if (expected.size() < total)
      throw NetworkError(Reason::Incomplete,
                         place(node) + ": states " + numberOf(total, "instance") +
                             " of what was asked for, but lists " +
                             std::to_string(expected.size()) +
                             "; it may still be receiving them, try again later");
  }
  Reception reception(node, std::move(study), std::move(expected), folder);
  reception.resume();
  Transfer transfer;
  transfer.instances = reception.expected();
  transfer.present = reception.arrived();
  transfer.asked = 0;
  ByteCounter counter;
  counter.progress = &progress;
  counter.of = reception.expected();
  const auto settle = [&]
  {
    if (const int error = reception.settle(progress))
      core::throwOutputError(error, folder);
  };
  for (int idle = 0; reception.arrived() < reception.expected();)
  {
    const std::size_t before = reception.arrived();
    ++transfer.asked;
    try
    {
      fetchMissing(node, reception, counter, transfer, progress);
      settle();
    }
    catch (const NetworkError& error)
    {
      if (!isTransient(error))
        throw;
      settle();
      if (reception.arrived() == before && ++idle >= kMaxIdleRounds)
        throw NetworkError(error.reason,
                           std::string(error.what()) + "; " + std::to_string(reception.arrived()) +
                               " of " + numberOf(reception.expected(), "instance") + " arrived");
      continue;
    }
    if (reception.arrived() == before && ++idle >= kMaxIdleRounds)
      throw NetworkError(Reason::Incomplete, place(node) + ": sent " +
                                                 std::to_string(reception.arrived()) + " of " +
                                                 numberOf(reception.expected(), "instance") +
                                                 "; the rest was asked for " +
                                                 std::to_string(transfer.asked) + " times");
  }
  transfer.completed = reception.arrived();
  transfer.otherNames = reception.otherNames();
  transfer.seconds = secondsSince(start);
  return transfer;
}

} // namespace petrous::network
