#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "petrous/Core/Error.h"
#include "petrous/Core/Progress.h"

namespace petrous::network
{

/// Failure of an exchange with a DICOM node. The message names the node; it never contains what a
/// server wrote, nor an identifier of a patient, study or instance.
struct NetworkError : core::Error
{
  enum class Reason
  {
    Unreachable, ///< unknown host, or nothing listens there
    Rejected,    ///< the node refuses the association, e.g. an unknown AE title
    Tls,         ///< no TLS connection: certificate or key refused, or not a TLS server
    TimedOut,    ///< no byte for longer than Timeouts::reply
    Cut,         ///< the connection ended in the middle of an exchange
    Unsupported, ///< the node does not offer the service, or not for this kind of object
    Failed,      ///< the node answered with a failure status
    Incomplete,  ///< instances are still missing after they were asked for again
    Foreign,     ///< the node sent instances of another patient, study or series
    NotFound,    ///< the node has no such study
    Protocol,    ///< what it answers is not DICOM
    TooMany      ///< it has more answers to a query than are read
  };
  NetworkError(Reason why, const std::string& message)
    : Error(why == Reason::NotFound ? core::Fault::BadInput : core::Fault::Refused, message)
    , reason(why)
  {
  }
  Reason reason;
};

/// PEM files. The key is read when it is needed, and must not be encrypted.
struct TlsFiles
{
  std::string authority;   ///< certificates that are trusted; empty: those of the system
  std::string certificate; ///< of this program; empty: none
  std::string key;         ///< belongs to `certificate`
  /// Host name or IP address that the node's certificate must be of; empty: Node::host. kAnyName:
  /// any certificate of `authority` will do, as for a node whose own certificate that is.
  std::string name = {};
};

constexpr const char* kAnyName = "*";

struct Timeouts
{
  std::chrono::milliseconds reply{60000};  ///< without a byte from the node; to connect: 10 s
  std::chrono::milliseconds accept{10000}; ///< the same, until it accepts the association
  /// Before a node that lists nothing of what it confirmed is asked again, twice: indexes lag.
  std::chrono::milliseconds listing{2000};
};

/// A DICOM application entity (PS3.8) that this program may call.
struct Node
{
  std::string name; ///< the user's name for it
  std::string host;
  int port = 104;
  std::string aeTitle;
  std::string callingAeTitle = "PETROUS";
  /// TLS 1.2 or later by the profile of PS3.15 B.9 (BCP 195, non-downgrading). The node's
  /// certificate is always verified against the trusted ones, and its name compared.
  std::optional<TlsFiles> tls;
  /// Port at which this program listens for what the node sends by C-MOVE, where that is preferred,
  /// as by a node without C-GET; the node must know `callingAeTitle` at this host and port. 0: by
  /// C-GET only, which needs no port.
  int movePort = 0;
  /// Host from which the node sends by C-MOVE, where that is not `host`; kAnyName: any. It must
  /// call itself `aeTitle`, as everybody may connect to that port.
  std::string moveHost = {};
  Timeouts timeouts;
};

/// Throws InvalidParameter naming the first field that DICOM or TCP does not permit.
void checkNode(const Node& node);

/// Throws InvalidParameter for files of `node.tls` that cannot be used: one that is not there, is
/// not PEM, or a key that is not the certificate's. Also if the system has no TLS 1.2.
void checkTlsFiles(const Node& node);

/// Verifies that the node answers (C-ECHO). All functions throw NetworkError and CancelledError;
/// `progress` cancels within a fraction of a second, also while the node is silent (but for the
/// time to connect). Thread-safe.
void echo(const Node& node, const core::Progress& progress = {});

/// Empty: any. UTF-8; `*` stands for any text in ID and name, `?` for any character.
struct StudyFilter
{
  std::string uid;
  std::string studyId;        ///< Study ID (0020,0010)
  std::string patientId = {}; ///< Patient ID (0010,0020)
  /// Patient's Name (0010,0010): family name, then `^` and the given name. Whether case matters is
  /// up to the node (PS3.4 C.2.2.2.1).
  std::string patientName = {};
  std::string from = {}, to = {}; ///< Study Date (0008,0020), both included: "20260331"
  std::string modality = {};      ///< of any series of the study: "CT"
};

/// All but `uid` and `instances` may identify the patient: for comparisons and for the user's own
/// screen only. UTF-8.
struct Study
{
  std::string uid;
  std::string patientId;
  std::string patientName;
  std::string date; ///< as DICOM writes it, 20260331; empty: none
  std::string description;
  std::string studyId;    ///< Study ID (0020,0010)
  std::string modalities; ///< separated by `\`; empty: the node does not state them
  int instances = -1;     ///< as the node states; -1: it does not
};

struct Series
{
  std::string uid;
  std::string modality;
  std::string description; ///< may identify the patient: for the user's own screen only
  int number = -1;         ///< Series Number; -1: none
  int instances = -1;      ///< as the node states; -1: it does not
};

struct Instance
{
  std::string uid;
  std::string seriesUid;
  std::string sopClass;
};

/// C-FIND, study root. Duplicates in what a node answers are dropped.
std::vector<Study> findStudies(const Node& node, const StudyFilter& filter,
                               const core::Progress& progress = {});
std::vector<Series> findSeries(const Node& node, const std::string& studyUid,
                               const core::Progress& progress = {});
std::vector<Instance> findInstances(const Node& node, const std::string& studyUid,
                                    const std::vector<std::string>& seriesUids,
                                    const core::Progress& progress = {});

/// Outcome of a transfer that is complete: anything else is thrown.
struct Transfer
{
  /// What the node listed (C-FIND) after it had confirmed each instance.
  enum class Listed
  {
    NotOffered, ///< it offers no queries; also of a retrieval
    Unanswered, ///< it did not answer, or refused, however often it was asked
    None,       ///< none of them: it has no index of them, or not yet
    All
  };

  std::size_t instances = 0; ///< of the whole transfer
  std::size_t completed = 0; ///< = instances, with `present` and `warning`
  std::size_t present = 0;   ///< of these, which were there already
  std::size_t warning = 0;   ///< of these, which the node stored with a warning
  std::size_t asked = 1;     ///< how often it took: 1, or more if something had to be asked again
  bool verified = false;     ///< sent: the node lists all of them; some of them: Incomplete
  Listed listed = Listed::NotOffered;
  std::size_t otherNames = 0; ///< received: which name the patient otherwise than the first does
  std::uintmax_t bytes = 0;   ///< transferred
  double seconds = 0.0;
};

/// Sends DICOM files (C-STORE) and asks the node which it then has (C-FIND, where it offers that).
/// Instances that the node has already are not sent again; after a cut, only what the node did not
/// confirm. Many files are sent over two associations, where the node accepts a second one.
/// Throws InvalidParameter for a file that is not DICOM, NetworkError (Incomplete) if the
/// node refuses one, or lists only some of those that it confirmed, with the number that it has.
Transfer store(const Node& node, const std::vector<std::filesystem::path>& files,
               const core::Progress& progress = {});

/// Fetches series of a study into a folder, one file per instance (`kInstanceEnding`), by C-GET,
/// or C-MOVE (Node::movePort). Which instances there are is asked first (C-FIND);
/// what does not arrive is asked for again, also after a cut. What a complete earlier or a cut
/// transfer left in the folder is used. Files whose study, series, patient or instance is not what
/// was asked for are not kept, and the transfer fails (Foreign): the patient is told by ID, its
/// issuer and birth date (PS3.3 C.7.1.1), of which all files must state the same if they state it;
/// names are written in several ways, and those that differ are counted. A file has arrived when it
/// is on the disk (fsync).
///
/// Without `seriesUids`, all series. Throws NetworkError; the folder then has what arrived in
/// whole, for another call.
Transfer retrieve(const Node& node, const std::string& studyUid,
                  const std::vector<std::string>& seriesUids, const std::filesystem::path& folder,
                  const core::Progress& progress = {});

/// Series Instance UID of a DICOM file. Throws InvalidParameter if it is not one that can be sent.
std::string seriesOfFile(const std::filesystem::path& file);

constexpr const char* kInstanceEnding = ".dcm";

} // namespace petrous::network
