#include "Association.h"

#include <cerrno>
#include <filesystem>
#include <future>
#include <system_error>
#include <utility>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <openssl/ssl.h>
#include <openssl/x509_vfy.h>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmnet/dcmlayer.h>
#include <dcmtk/dcmnet/dcmtrans.h>
#include <dcmtk/dcmnet/dimse.h>
#include <dcmtk/dcmtls/tlslayer.h>

#include "PduChecker.h"
#include "petrous/Core/InputFile.h"

namespace petrous::network
{
namespace
{

using Reason = NetworkError::Reason;

/// Ends with what is no PDU.
class CheckedConnection : public DcmTransportConnection
{
public:
  CheckedConnection(DcmNativeSocketType socket, std::unique_ptr<DcmTransportConnection> connection,
                    std::function<void(const std::string&)> refuse)
    : DcmTransportConnection(socket)
    , m_connection(std::move(connection))
    , m_refuse(std::move(refuse))
  {
  }

  ssize_t read(void* bytes, size_t count) override
  {
    const ssize_t got = m_connection->read(bytes, count);
    if (got <= 0)
      return got;
    const std::string fault =
        m_checker.take(static_cast<const std::uint8_t*>(bytes), static_cast<std::size_t>(got));
    if (fault.empty())
      return got;
    m_refuse(fault);
    ::shutdown(getSocket(), SHUT_RDWR);
    errno = EPROTO;
    return -1;
  }

  OFCondition serverSideHandshake() override { return m_connection->serverSideHandshake(); }
  OFCondition clientSideHandshake() override { return m_connection->clientSideHandshake(); }
  OFCondition renegotiate(const char* suite) override { return m_connection->renegotiate(suite); }
  ssize_t write(void* bytes, size_t count) override { return m_connection->write(bytes, count); }
  void close() override { m_connection->close(); }
  void closeTransportConnection() override { m_connection->closeTransportConnection(); }
  unsigned long getPeerCertificateLength() override
  {
    return m_connection->getPeerCertificateLength();
  }
  unsigned long getPeerCertificate(void* bytes, unsigned long count) override
  {
    return m_connection->getPeerCertificate(bytes, count);
  }
  OFBool networkDataAvailable(int timeout) override
  {
    return m_connection->networkDataAvailable(timeout);
  }
  OFBool isTransparentConnection() override { return m_connection->isTransparentConnection(); }
  OFString& dumpConnectionParameters(OFString& text) override
  {
    return m_connection->dumpConnectionParameters(text);
  }

private:
  std::unique_ptr<DcmTransportConnection> m_connection;
  std::function<void(const std::string&)> m_refuse;
  PduChecker m_checker;
};

/// Nagle's algorithm costs 40 ms an instance: DIMSE answers each message.
template <class Layer>
class WatchedLayer : public Layer
{
public:
  template <class... Arguments>
  explicit WatchedLayer(ConnectionWatch& watch, const Node& node, Admission admits,
                        Arguments... arguments)
    : Layer(arguments...)
    , m_watch(watch)
    , m_place(place(node))
    , m_admits(std::move(admits))
  {
  }

  DcmTransportConnection* createConnection(DcmNativeSocketType socket, OFBool secure) override
  {
    const int on = 1;
    ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    m_watch.watch(socket);
    if (m_admits && !m_admits(socket))
      ::shutdown(socket, SHUT_RDWR);
    std::unique_ptr<DcmTransportConnection> connection(Layer::createConnection(socket, secure));
    if (!connection)
      return nullptr;
    return new CheckedConnection(socket, std::move(connection),
                                 [this](const std::string& fault) { refuse(fault); });
  }

private:
  // A stranger that calls this program ends his own connection only.
  void refuse(const std::string& fault) const
  {
    if (!m_admits)
      m_watch.fail(std::make_exception_ptr(NetworkError(
          Reason::Protocol, m_place + ": what it answers is not valid DICOM (" + fault +
                                "); the connection was ended; is it a DICOM node?")));
  }

  ConnectionWatch& m_watch;
  std::string m_place;
  Admission m_admits;
};

[[noreturn]] void refuseTls(const Node& node, const std::string& why)
{
  throw NetworkError(Reason::Tls, "node '" + node.name + "': " + why);
}

void requireThere(const Node& node, const std::string& file)
{
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    refuseTls(node, file + ": is not there; give a PEM file");
}

// BCP 195, non-downgrading: never below TLS 1.2. What is trusted, and this program's own.
void useTlsFiles(DcmTLSTransportLayer& layer, const Node& node)
{
  const TlsFiles& files = *node.tls;
  if (layer.setTLSProfile(TSP_Profile_BCP195_ND).bad() || layer.activateCipherSuites().bad())
    refuseTls(node, "TLS 1.2 is not available here");
  layer.setCertificateVerification(DCV_requireCertificate);
  layer.setPrivateKeyPasswd(""); // never asked for on the terminal
  if (!files.authority.empty())
  {
    requireThere(node, files.authority);
    if (layer.addTrustedCertificateFile(files.authority.c_str(), DCF_Filetype_PEM).bad())
      refuseTls(node, files.authority + ": is not a PEM file of certificates to trust");
  }
  if (files.certificate.empty())
    return;
  requireThere(node, files.key);
  requireThere(node, files.certificate);
  if (layer.setPrivateKeyFile(files.key.c_str(), DCF_Filetype_PEM).bad())
    refuseTls(node, files.key + ": is not a PEM file of a private key without a passphrase");
  if (layer.setCertificateFile(files.certificate.c_str(), DCF_Filetype_PEM).bad())
    refuseTls(node,
              files.certificate + ": is not a PEM file of a certificate of at least 2048 bits");
  if (!layer.checkPrivateKeyMatchesCertificate())
    refuseTls(node, files.key + ": is not the key of " + files.certificate);
}

// --- What OpenSSL tells ---

int watchIndex()
{
  static const int index = SSL_CTX_get_ex_new_index(0, nullptr, nullptr, nullptr, nullptr);
  return index;
}

ConnectionWatch& watchOf(const SSL* connection)
{
  return *static_cast<ConnectionWatch*>(
      SSL_CTX_get_ex_data(SSL_get_SSL_CTX(connection), watchIndex()));
}

int onCertificate(int good, X509_STORE_CTX* store)
{
  const auto* connection = static_cast<const SSL*>(
      X509_STORE_CTX_get_ex_data(store, SSL_get_ex_data_X509_STORE_CTX_idx()));
  if (!good)
    watchOf(connection).certificateFault = X509_STORE_CTX_get_error(store);
  return good;
}

void onState(const SSL* connection, int where, int value)
{
  if ((where & SSL_CB_ALERT) != 0 && (where & SSL_CB_READ) != 0 && (value >> 8) == SSL3_AL_FATAL)
    watchOf(connection).alert = value & 0xFF;
}

/// The name, or the address, that the node's certificate must be of.
const std::string& certifiedName(const Node& node)
{
  return node.tls->name.empty() ? node.host : node.tls->name;
}

void compareName(SSL_CTX* context, const Node& node)
{
  const std::string& name = certifiedName(node);
  if (name == kAnyName)
    return;
  X509_VERIFY_PARAM* verification = SSL_CTX_get0_param(context);
  if (!X509_VERIFY_PARAM_set1_ip_asc(verification, name.c_str()) &&
      !X509_VERIFY_PARAM_set1_host(verification, name.c_str(), name.size()))
    throw NetworkError(Reason::Tls, "node '" + node.name + "': '" + core::printable(name) +
                                        "' cannot be compared with its certificate; give the name "
                                        "in its certificate (--tls-name)");
}

std::unique_ptr<WatchedLayer<DcmTLSTransportLayer>>
tlsLayer(const Node& node, ConnectionWatch& watch, const Admission& admits, T_ASC_NetworkRole role)
{
  auto layer = std::make_unique<WatchedLayer<DcmTLSTransportLayer>>(
      watch, node, admits, role, static_cast<const char*>(nullptr), OFFalse);
  useTlsFiles(*layer, node);
  if (node.tls->authority.empty() && !SSL_CTX_set_default_verify_paths(layer->getNativeHandle()))
    refuseTls(node,
              "the system's trusted certificates cannot be read; give a file of certificates");
  return layer;
}

std::string rejection(const Node& node, T_ASC_Parameters* parameters)
{
  T_ASC_RejectParameters why{};
  ASC_getRejectParameters(parameters, &why);
  const std::string text = place(node) + ": refuses the association";
  switch (why.reason)
  {
  case ASC_REASON_SU_CALLINGAETITLENOTRECOGNIZED:
    return text + ", as it does not know '" + node.callingAeTitle +
           "'; have that AE title added there";
  case ASC_REASON_SU_CALLEDAETITLENOTRECOGNIZED:
    return text + ", as it is not called '" + node.aeTitle + "'; correct the AE title";
  case ASC_REASON_SP_PRES_TEMPORARYCONGESTION:
  case ASC_REASON_SP_PRES_LOCALLIMITEXCEEDED:
    return text + ", as it is busy; try again later";
  default:
    return text + "; ask its administrator whether this program may call it";
  }
}

std::string tlsFault(const Node& node, const ConnectionWatch& watch)
{
  switch (watch.certificateFault)
  {
  case X509_V_OK:
    break;
  case X509_V_ERR_HOSTNAME_MISMATCH:
  case X509_V_ERR_IP_ADDRESS_MISMATCH:
    return "its certificate is not of '" + core::printable(certifiedName(node)) +
           "'; if it is the right node, give the name in its certificate (--tls-name)";
  case X509_V_ERR_CERT_HAS_EXPIRED:
  case X509_V_ERR_CERT_NOT_YET_VALID:
    return "its certificate, or its authority's, has expired or is not valid yet; have it renewed, "
           "or set the clock of this computer";
  default:
    return "its certificate is not of a trusted authority";
  }
  const std::string ours = node.tls->certificate.empty() ? "it wants a certificate of this program"
                                                         : "it refuses the certificate of this "
                                                           "program";
  switch (watch.alert)
  {
  case SSL_AD_BAD_CERTIFICATE:
  case SSL_AD_UNSUPPORTED_CERTIFICATE:
  case SSL_AD_CERTIFICATE_REVOKED:
  case SSL_AD_CERTIFICATE_EXPIRED:
  case SSL_AD_CERTIFICATE_UNKNOWN:
  case SSL_AD_UNKNOWN_CA:
  case SSL_AD_ACCESS_DENIED:
  case SSL_AD_DECRYPT_ERROR:
  case SSL_AD_CERTIFICATE_REQUIRED:
    return ours;
  case SSL_AD_HANDSHAKE_FAILURE:
    return ours + ", or does not speak TLS 1.2 or later with a permitted cipher (BCP 195)";
  default:
    return "it does not speak TLS 1.2 or later with a permitted cipher (BCP 195)";
  }
}

} // namespace

std::string place(const Node& node)
{
  return "node '" + node.name + "' (" + node.host + ":" + std::to_string(node.port) + ")";
}

void prepareToolkit()
{
  static std::once_flag once;
  std::call_once(once,
                 []
                 {
                   OFLog::configure(OFLogger::OFF_LOG_LEVEL);
                   DcmTLSTransportLayer::initializeOpenSSL();
                   dcmConnectionTimeout.set(10); // seconds; the default is that of the system
                   dcmDisableGethostbyaddr.set(OFTrue); // no name server for each that calls
                 });
}

void checkTlsFiles(const Node& node)
{
  prepareToolkit();
  if (!node.tls)
    return;
  try
  {
    DcmTLSTransportLayer layer(NET_REQUESTOR, nullptr, OFFalse);
    useTlsFiles(layer, node);
  }
  catch (const NetworkError& error)
  {
    throw core::InvalidParameter(error.what());
  }
}

std::unique_ptr<DcmTransportLayer> transportLayer(const Node& node, ConnectionWatch& watch,
                                                  const Admission& admits)
{
  if (!node.tls)
    return std::make_unique<WatchedLayer<DcmTransportLayer>>(watch, node, admits);
  auto layer = tlsLayer(node, watch, admits, admits ? NET_ACCEPTOR : NET_REQUESTOR);
  SSL_CTX* context = layer->getNativeHandle();
  SSL_CTX_set_ex_data(context, watchIndex(), &watch);
  SSL_CTX_set_verify(context, SSL_VERIFY_PEER | SSL_VERIFY_FAIL_IF_NO_PEER_CERT, onCertificate);
  SSL_CTX_set_info_callback(context, onState);
  // Anyone can have a certificate of a public authority for a host of his own, and any computer of
  // a hospital one of its authority.
  if (!admits)
    compareName(context, node);
  return layer;
}

/// What DCMTK needs of a connection; kept by who waits for it and by who opens it.
struct Association::Connection
{
  Connection(const core::Progress& progress, std::chrono::milliseconds limit)
    : watch(progress, limit)
  {
  }
  ~Connection()
  {
    if (association)
    {
      if (opened && !released)
        ASC_abortAssociation(association);
      ASC_destroyAssociation(&association); // and its parameters
    }
    else if (parameters)
      ASC_destroyAssociationParameters(&parameters);
    watch.forget();
    if (network)
      ASC_dropNetwork(&network);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  ConnectionWatch watch; // first: the layer uses it
  std::unique_ptr<DcmTransportLayer> layer;
  T_ASC_Network* network = nullptr;
  T_ASC_Parameters* parameters = nullptr;
  T_ASC_Association* association = nullptr;
  bool opened = false;
  bool released = false;
};

Association::Association(const Node& node, const std::vector<Context>& contexts,
                         const core::Progress& progress)
  : m_node(node)
  , m_connection(
        std::make_shared<Connection>(progress, std::min(node.timeouts.accept, node.timeouts.reply)))
{
  progress.check("network");
  open(contexts, progress);
}

Association::~Association() = default;

T_ASC_Association* Association::get() const noexcept
{
  return m_connection->association;
}

ConnectionWatch& Association::watch() const noexcept
{
  return m_connection->watch;
}

int Association::timeout() const
{
  return static_cast<int>(m_node.timeouts.reply.count() / 1000 + 2);
}

unsigned char Association::context(const std::string& sopClass) const
{
  return ASC_findAcceptedPresentationContextID(get(), sopClass.c_str());
}

unsigned char Association::context(const std::string& sopClass, const char* transferSyntax) const
{
  return ASC_findAcceptedPresentationContextID(get(), sopClass.c_str(), transferSyntax);
}

void Association::release()
{
  if (ASC_releaseAssociation(get()).good())
    m_connection->released = true;
}

void Association::require(const OFCondition& result, const std::string& task) const
{
  watch().active();
  if (result.bad() || watch().ended() == ConnectionWatch::End::Failed)
    fail(result, task);
}

void Association::fail(const OFCondition& result, const std::string& task) const
{
  switch (watch().ended())
  {
  case ConnectionWatch::End::Cancelled:
    throw core::CancelledError(task);
  case ConnectionWatch::End::TimedOut:
    failSilent(task);
  case ConnectionWatch::End::TooLarge:
    throw NetworkError(Reason::Protocol, place(m_node) + ": sends an instance of more than 4 GB; " +
                                             task + " was ended");
  case ConnectionWatch::End::Failed:
    std::rethrow_exception(watch().fault());
  case ConnectionWatch::End::None:
    break;
  }
  // By TLS 1.3 a node refuses a client after the handshake.
  if (!m_connection->opened && (watch().certificateFault != X509_V_OK || watch().alert >= 0))
    failTls();
  if (result == DIMSE_NODATAAVAILABLE || result == DIMSE_READPDVFAILED ||
      (result.module() == OFM_dcmnet && result.code() == DULC_READTIMEOUT))
  {
    if (result != DIMSE_READPDVFAILED)
      failSilent(task);
    failCut(task);
  }
  if (result.module() == OFM_dcmtls)
    failTls();
  if (result.module() != OFM_dcmnet)
    throw NetworkError(Reason::Protocol, place(m_node) + ": what it answers is not valid DICOM; " +
                                             task + " was ended");
  switch (result.code())
  {
  case DULC_UNKNOWNHOST:
  case DULC_TCPINITERROR:
    throw NetworkError(Reason::Unreachable,
                       place(m_node) + ": nothing answers there; check host, port, network and "
                                       "firewall");
  case DULC_TLSERROR:
    failTls();
  case DULC_ASSOCIATIONREJECTED:
    throw NetworkError(Reason::Rejected,
                       rejection(m_node, get() ? get()->params : m_connection->parameters));
  case DULC_PEERABORTEDASSOCIATION:
  case DULC_PEERREQUESTEDRELEASE:
  case DULC_NETWORKCLOSED:
  case DULC_TCPIOERROR:
    failCut(task);
  default:
    break;
  }
  if (result == DIMSE_SENDFAILED || result == DIMSE_RECEIVEFAILED)
    failCut(task);
  throw NetworkError(Reason::Protocol, place(m_node) + ": what it answers is not valid DICOM; " +
                                           task + " was ended");
}

void Association::failSilent(const std::string& task) const
{
  const auto& [reply, accept, listing] = m_node.timeouts;
  const auto limit = m_connection->opened ? reply : std::min(accept, reply);
  throw NetworkError(Reason::TimedOut,
                     place(m_node) + ": has not answered for " +
                         std::to_string(limit.count() / 1000) + " s; " + task + " was ended" +
                         (m_connection->opened ? "" : "; is it a DICOM node, and not too busy?"));
}

void Association::failCut(const std::string& task) const
{
  throw NetworkError(Reason::Cut, place(m_node) + ": the connection was lost during " + task +
                                      (m_connection->opened ? ""
                                       : m_node.tls         ? "; does it expect TLS, and the "
                                                              "certificate of this program?"
                                                            : "; does it expect TLS?"));
}

void Association::failTls() const
{
  throw NetworkError(Reason::Tls,
                     place(m_node) + ": no secure connection; " + tlsFault(m_node, watch()));
}

void Association::open(const std::vector<Context>& contexts, const core::Progress& progress)
{
  const std::string task = "connecting";
  Connection& its = *m_connection;
  auto layer = transportLayer(m_node, its.watch);
  require(ASC_initializeNetwork(NET_REQUESTOR, 0, timeout(), &its.network), task);
  // Owned here: the network keeps a pointer only.
  its.layer = std::move(layer);
  ASC_setTransportLayer(its.network, its.layer.get(), 0);
  require(ASC_createAssociationParameters(&its.parameters, ASC_MAXIMUMPDUSIZE), task);
  ASC_setAPTitles(its.parameters, m_node.callingAeTitle.c_str(), m_node.aeTitle.c_str(), nullptr);
  ASC_setTransportLayerType(its.parameters, m_node.tls ? OFTrue : OFFalse);
  const std::string address = m_node.host + ":" + std::to_string(m_node.port);
  ASC_setPresentationAddresses(its.parameters, "localhost", address.c_str());
  int id = 1;
  for (const Context& context : contexts)
  {
    if (id > 255)
      break;
    std::vector<const char*> syntaxes = context.transferSyntaxes;
    require(ASC_addPresentationContext(its.parameters, static_cast<T_ASC_PresentationContextID>(id),
                                       context.sopClass.c_str(), syntaxes.data(),
                                       static_cast<int>(syntaxes.size()),
                                       context.receives ? ASC_SC_ROLE_SCP : ASC_SC_ROLE_DEFAULT),
            task);
    id += 2;
  }
  its.watch.active();
  // Resolving a name and opening a connection cannot be interrupted: a thread of its own does it,
  // which is left to itself if the user cancels.
  std::promise<OFCondition> outcome;
  std::future<OFCondition> pending = outcome.get_future();
  std::thread opener(
      [connection = m_connection, seconds = timeout(), outcome = std::move(outcome)]() mutable
      {
        outcome.set_value(ASC_requestAssociation(connection->network, connection->parameters,
                                                 &connection->association, nullptr, nullptr,
                                                 DUL_NOBLOCK, seconds));
      });
  try
  {
    while (pending.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready)
      progress.check(task);
  }
  catch (...)
  {
    opener.detach();
    throw;
  }
  opener.join();
  const OFCondition result = pending.get();
  if (result.bad())
    fail(result, task);
  its.opened = true;
  its.watch.begin(m_node.timeouts.reply);
  if (ASC_countAcceptedPresentationContexts(its.association->params) == 0)
    throw NetworkError(Reason::Unsupported,
                       place(m_node) + ": accepts nothing of what was asked for; it is not a "
                                       "node for this purpose");
}

} // namespace petrous::network
