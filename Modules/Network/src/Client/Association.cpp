#include "Association.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <openssl/ssl.h>
#include <openssl/sslerr.h>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmnet/dcmlayer.h>
#include <dcmtk/dcmnet/dcmtrans.h>
#include <dcmtk/dcmnet/dimse.h>
#include <dcmtk/dcmtls/tlslayer.h>

namespace petrous::network
{
namespace
{

using Reason = NetworkError::Reason;

/// Nagle's algorithm costs 40 ms an instance: DIMSE answers each message.
template <class Layer>
class WatchedLayer : public Layer
{
public:
  template <class... Arguments>
  explicit WatchedLayer(ConnectionWatch& watch, Arguments... arguments)
    : Layer(arguments...)
    , m_watch(watch)
  {
  }

  DcmTransportConnection* createConnection(DcmNativeSocketType socket, OFBool secure) override
  {
    const int on = 1;
    ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    m_watch.watch(socket);
    return Layer::createConnection(socket, secure);
  }

private:
  ConnectionWatch& m_watch;
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

std::unique_ptr<DcmTransportLayer> tlsLayer(const Node& node, ConnectionWatch& watch,
                                            T_ASC_NetworkRole role)
{
  auto layer = std::make_unique<WatchedLayer<DcmTLSTransportLayer>>(
      watch, role, static_cast<const char*>(nullptr), OFFalse);
  useTlsFiles(*layer, node);
  if (!node.tls->authority.empty())
    return layer;
  if (!SSL_CTX_set_default_verify_paths(layer->getNativeHandle()))
    refuseTls(node, "the system's trusted certificates cannot be read; give a file of "
                    "certificates");
  // Anyone can have a certificate of a public authority, for a host of his own.
  X509_VERIFY_PARAM* verification = SSL_CTX_get0_param(layer->getNativeHandle());
  if (role == NET_REQUESTOR && !X509_VERIFY_PARAM_set1_ip_asc(verification, node.host.c_str()) &&
      !X509_VERIFY_PARAM_set1_host(verification, node.host.c_str(), node.host.size()))
    refuseTls(node, "its host name cannot be compared with its certificate; give a file of "
                    "certificates");
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
                                                  bool acceptor)
{
  if (node.tls)
    return tlsLayer(node, watch, acceptor ? NET_ACCEPTOR : NET_REQUESTOR);
  return std::make_unique<WatchedLayer<DcmTransportLayer>>(watch);
}

Association::Association(const Node& node, const std::vector<Context>& contexts,
                         const core::Progress& progress)
  : m_node(node)
  , m_watch(std::make_unique<ConnectionWatch>(progress, node.timeouts.reply))
{
  progress.check("network");
  try
  {
    open(transportLayer(node, *m_watch, false), contexts);
  }
  catch (...)
  {
    close();
    throw;
  }
}

Association::~Association()
{
  close();
}

int Association::timeout() const
{
  return static_cast<int>(m_node.timeouts.reply.count() / 1000 + 2);
}

unsigned char Association::context(const std::string& sopClass) const
{
  return ASC_findAcceptedPresentationContextID(m_association, sopClass.c_str());
}

unsigned char Association::context(const std::string& sopClass, const char* transferSyntax) const
{
  return ASC_findAcceptedPresentationContextID(m_association, sopClass.c_str(), transferSyntax);
}

void Association::release()
{
  if (ASC_releaseAssociation(m_association).good())
    m_released = true;
}

void Association::require(const OFCondition& result, const std::string& task) const
{
  m_watch->active();
  if (result.bad())
    fail(result, task);
}

void Association::fail(const OFCondition& result, const std::string& task) const
{
  switch (m_watch->ended())
  {
  case ConnectionWatch::End::Cancelled:
    throw core::CancelledError(task);
  case ConnectionWatch::End::TimedOut:
    failSilent(task);
  case ConnectionWatch::End::TooLarge:
    throw NetworkError(Reason::Protocol, place(m_node) + ": sends an instance of more than 4 GB; " +
                                             task + " was ended");
  case ConnectionWatch::End::None:
    break;
  }
  if (result == DIMSE_NODATAAVAILABLE || result == DIMSE_READPDVFAILED ||
      (result.module() == OFM_dcmnet && result.code() == DULC_READTIMEOUT))
  {
    if (result != DIMSE_READPDVFAILED)
      failSilent(task);
    failCut(task);
  }
  if (result.module() == OFM_dcmtls)
    failTls(result.code());
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
    failTls(0);
  case DULC_ASSOCIATIONREJECTED:
    throw NetworkError(Reason::Rejected,
                       rejection(m_node, m_association ? m_association->params : m_parameters));
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
  throw NetworkError(Reason::TimedOut, place(m_node) + ": has not answered for " +
                                           std::to_string(m_node.timeouts.reply.count() / 1000) +
                                           " s; " + task + " was ended");
}

void Association::failCut(const std::string& task) const
{
  throw NetworkError(Reason::Cut, place(m_node) + ": the connection was lost during " + task +
                                      (m_opened     ? ""
                                       : m_node.tls ? "; does it expect TLS, and the "
                                                      "certificate of this program?"
                                                    : "; does it expect TLS?"));
}

void Association::failTls(int code) const
{
  const std::string text = place(m_node) + ": no secure connection; ";
  if ((code & 0x7FF) == SSL_R_CERTIFICATE_VERIFY_FAILED)
    throw NetworkError(Reason::Tls, text + "its certificate is not of a trusted authority, or has "
                                           "expired");
  throw NetworkError(Reason::Tls, text + "it refuses the certificate of this program, or does not "
                                         "speak TLS 1.2 or later");
}

void Association::open(std::unique_ptr<DcmTransportLayer> layer,
                       const std::vector<Context>& contexts)
{
  const std::string task = "connecting";
  require(ASC_initializeNetwork(NET_REQUESTOR, 0, timeout(), &m_network), task);
  // Owned here: the network keeps a pointer only.
  m_layer = std::move(layer);
  ASC_setTransportLayer(m_network, m_layer.get(), 0);
  require(ASC_createAssociationParameters(&m_parameters, ASC_MAXIMUMPDUSIZE), task);
  ASC_setAPTitles(m_parameters, m_node.callingAeTitle.c_str(), m_node.aeTitle.c_str(), nullptr);
  ASC_setTransportLayerType(m_parameters, m_node.tls ? OFTrue : OFFalse);
  const std::string address = m_node.host + ":" + std::to_string(m_node.port);
  ASC_setPresentationAddresses(m_parameters, "localhost", address.c_str());
  int id = 1;
  for (const Context& context : contexts)
  {
    if (id > 255)
      break;
    std::vector<const char*> syntaxes = context.transferSyntaxes;
    require(ASC_addPresentationContext(m_parameters, static_cast<T_ASC_PresentationContextID>(id),
                                       context.sopClass.c_str(), syntaxes.data(),
                                       static_cast<int>(syntaxes.size()),
                                       context.receives ? ASC_SC_ROLE_SCP : ASC_SC_ROLE_DEFAULT),
            task);
    id += 2;
  }
  m_watch->active();
  const OFCondition result = ASC_requestAssociation(m_network, m_parameters, &m_association,
                                                    nullptr, nullptr, DUL_NOBLOCK, timeout());
  if (result.good())
    m_opened = true;
  else
    fail(result, task);
  if (ASC_countAcceptedPresentationContexts(m_association->params) == 0)
    throw NetworkError(Reason::Unsupported,
                       place(m_node) + ": accepts nothing of what was asked for; it is not a "
                                       "node for this purpose");
}

void Association::close() noexcept
{
  if (m_association)
  {
    if (m_opened && !m_released)
      ASC_abortAssociation(m_association);
    ASC_destroyAssociation(&m_association); // and its parameters
  }
  else if (m_parameters)
    ASC_destroyAssociationParameters(&m_parameters);
  m_watch->forget();
  if (m_network)
    ASC_dropNetwork(&m_network);
  m_watch.reset(); // joins
}

} // namespace petrous::network
