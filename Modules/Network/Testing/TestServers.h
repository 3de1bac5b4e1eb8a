#pragma once

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <pwd.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rsa.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include "petrous/Network/DicomNode.h"

namespace petrous::network::test
{

namespace fs = std::filesystem;

class TemporaryFolder
{
public:
  TemporaryFolder()
    : m_path(fs::temp_directory_path() / ("petrous-network-" + std::to_string(::getpid()) + "-" +
                                          std::to_string(std::random_device{}())))
  {
    fs::create_directories(m_path);
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    fs::remove_all(m_path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return m_path; }

private:
  fs::path m_path;
};

/// Waits for a condition, at most a minute.
inline bool waitFor(const std::function<bool()>& condition)
{
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (std::chrono::steady_clock::now() < end)
  {
    if (condition())
      return true;
    const timespec pause{0, 20000000};
    ::nanosleep(&pause, nullptr);
  }
  return false;
}

/// A server of another program, killed with the test, whatever ends it.
class ServerProcess
{
public:
  ServerProcess(const std::vector<std::string>& words, const fs::path& log, uid_t user = ::getuid(),
                gid_t group = ::getgid())
  {
    std::vector<char*> arguments;
    for (const std::string& word : words)
      arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const pid_t parent = ::getpid();
    m_pid = ::fork();
    if (m_pid != 0)
      return;
    if (group != ::getgid() && ::setgid(group) != 0)
      ::_exit(127);
    if (user != ::getuid() && ::setuid(user) != 0)
      ::_exit(127);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent)
      ::_exit(127);
    const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    const int in = ::open("/dev/null", O_RDONLY);
    ::dup2(in, 0);
    ::dup2(out, 1);
    ::dup2(out, 2);
    for (int n = 3; n < 256; ++n)
      ::close(n);
    ::setenv("TCP_NODELAY", "1", 0); // read by DCMTK, on which Orthanc stands
    ::execv(arguments.front(), arguments.data());
    ::_exit(127);
  }
  ~ServerProcess()
  {
    if (m_pid <= 0 || !running())
      return;
    ::kill(m_pid, SIGTERM);
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (running() && std::chrono::steady_clock::now() < end)
    {
      const timespec pause{0, 10000000};
      ::nanosleep(&pause, nullptr);
    }
    if (running())
    {
      ::kill(m_pid, SIGKILL);
      ::waitpid(m_pid, nullptr, 0);
    }
  }
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  bool running()
  {
    if (m_ended || m_pid <= 0)
      return false;
    m_ended = ::waitpid(m_pid, nullptr, WNOHANG) == m_pid;
    return !m_ended;
  }

private:
  pid_t m_pid = -1;
  bool m_ended = false;
};

/// A listening socket on the loopback; port 0: a free one.
inline int listenOn(int port, int& chosen)
{
  const int descriptor = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int on = 1;
  ::setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  socklen_t size = sizeof address;
  if (::bind(descriptor, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
      ::listen(descriptor, 16) != 0 ||
      ::getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) != 0)
  {
    ::close(descriptor);
    throw std::runtime_error("no free port");
  }
  chosen = ntohs(address.sin_port);
  return descriptor;
}

/// Below the ports that the system gives to outgoing connections, so that none of these takes it
/// before the server does.
inline int freePort()
{
  std::random_device random;
  for (int attempt = 0; attempt < 100; ++attempt)
    try
    {
      int port = 0;
      ::close(listenOn(20000 + static_cast<int>(random() % 12000), port));
      return port;
    }
    catch (const std::runtime_error&)
    {
    }
  throw std::runtime_error("no free port");
}

inline int connectTo(int port)
{
  const int descriptor = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  if (::connect(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0)
    return descriptor;
  ::close(descriptor);
  return -1;
}

/// A self-signed certificate and its key, in PEM files; of this computer, unless told otherwise.
class Certificate
{
public:
  Certificate(const fs::path& folder, const std::string& name,
              const std::string& hosts = "DNS:localhost,IP:127.0.0.1", long lifetime = 86400)
    : m_certificate(folder / (name + ".crt"))
    , m_key(folder / (name + ".key"))
  {
    EVP_PKEY* key = EVP_RSA_gen(2048);
    X509* certificate = X509_new();
    X509_set_version(certificate, 2);
    ASN1_INTEGER_set(X509_get_serialNumber(certificate), 1);
    X509_gmtime_adj(X509_getm_notBefore(certificate), -3600);
    X509_gmtime_adj(X509_getm_notAfter(certificate), lifetime); // seconds; < 0: expired
    X509_set_pubkey(certificate, key);
    X509_NAME* subject = X509_get_subject_name(certificate);
    X509_NAME_add_entry_by_txt(subject, "CN", MBSTRING_ASC,
                               reinterpret_cast<const unsigned char*>(name.c_str()), -1, -1, 0);
    X509_set_issuer_name(certificate, subject);
    X509_EXTENSION* names =
        X509V3_EXT_conf_nid(nullptr, nullptr, NID_subject_alt_name, hosts.c_str());
    X509_add_ext(certificate, names, -1);
    X509_EXTENSION_free(names);
    X509_sign(certificate, key, EVP_sha256());
    write(m_certificate, [&](FILE* file) { PEM_write_X509(file, certificate); });
    write(m_key, [&](FILE* file)
          { PEM_write_PrivateKey(file, key, nullptr, nullptr, 0, nullptr, nullptr); });
    X509_free(certificate);
    EVP_PKEY_free(key);
  }
  std::string certificate() const { return m_certificate.string(); }
  std::string key() const { return m_key.string(); }

private:
  static void write(const fs::path& path, const std::function<void(FILE*)>& content)
  {
    FILE* file = std::fopen(path.c_str(), "wb");
    content(file);
    std::fclose(file);
  }
  fs::path m_certificate, m_key;
};

/// PostgreSQL of its own, as another user where the test runs as root, which initdb refuses.
class Postgres
{
public:
  /// Null, with the reason, where there is none.
  static std::unique_ptr<Postgres> start(const fs::path& folder, std::string& whyNot)
  {
    fs::path programs;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator("/usr/lib/postgresql", ignored))
      if (fs::exists(entry.path() / "bin/initdb"))
        programs = entry.path() / "bin";
    if (programs.empty())
    {
      whyNot = "PostgreSQL's server (package postgresql) is not installed";
      return nullptr;
    }
    auto server = std::unique_ptr<Postgres>(new Postgres);
    uid_t user = ::getuid();
    gid_t group = ::getgid();
    if (user == 0)
    {
      const passwd* other = ::getpwnam("postgres");
      if (!other)
        other = ::getpwnam("nobody");
      if (!other)
      {
        whyNot = "the test runs as root, and there is no other user for PostgreSQL";
        return nullptr;
      }
      user = other->pw_uid;
      group = other->pw_gid;
    }
    const fs::path place = folder / "postgres";
    fs::create_directories(place);
    if (::chown(place.c_str(), user, group) != 0)
    {
      whyNot = "the database's folder cannot be given to another user";
      return nullptr;
    }
    const std::string data = (place / "data").string();
    const fs::path log = place / "log";
    {
      ServerProcess init({(programs / "initdb").string(), "-D", data, "-U", "petrous",
                          "--auth=trust", "--no-sync", "-E", "UTF8", "--locale=C"},
                         log, user, group);
      waitFor([&] { return !init.running(); });
    }
    if (!fs::exists(place / "data/postgresql.conf") && ::getuid() == user)
    {
      whyNot = "initdb failed";
      return nullptr;
    }
    server->m_port = freePort();
    server->m_process = std::make_unique<ServerProcess>(
        std::vector<std::string>{(programs / "postgres").string(), "-D", data, "-p",
                                 std::to_string(server->m_port), "-c", "listen_addresses=127.0.0.1",
                                 "-k", place.string(), "-c", "fsync=off"},
        log, user, group);
    const std::string ready = (programs / "pg_isready").string() + " -q -h 127.0.0.1 -p " +
                              std::to_string(server->m_port);
    if (!waitFor([&]
                 { return !server->m_process->running() || std::system(ready.c_str()) == 0; }) ||
        !server->m_process->running())
    {
      whyNot = "PostgreSQL did not start";
      return nullptr;
    }
    return server;
  }
  int port() const { return m_port; }

private:
  Postgres() = default;
  int m_port = 0;
  std::unique_ptr<ServerProcess> m_process;
};

/// An Orthanc of its own: folder, port, configuration. Null where it is not installed.
class Orthanc
{
public:
  struct Options
  {
    const Certificate* own = nullptr; ///< with TLS
    const Certificate* client = nullptr;
    int postgres = 0; ///< port
    int movePort = 0; ///< offers C-MOVE to this port only, no C-GET
  };

  static bool installed() { return fs::exists(kProgram); }

  Orthanc(const fs::path& folder, const Options& options)
  {
    for (int attempt = 0; attempt < 3 && !m_process; ++attempt) // the port may be taken meanwhile
      start(folder / ("orthanc-" + std::to_string(attempt)), options);
    if (!m_process)
      throw std::runtime_error("Orthanc did not start");
  }

  const Node& node() const { return m_node; }
  const fs::path& storage() const { return m_storage; }

private:
  static constexpr const char* kProgram = "/usr/sbin/Orthanc";

  void start(const fs::path& folder, const Options& options)
  {
    m_storage = folder / "storage";
    fs::create_directories(m_storage);
    m_node = Node();
    m_node.name = "orthanc";
    m_node.host = "127.0.0.1";
    m_node.port = freePort();
    m_node.aeTitle = "ORTHANC";
    std::ofstream file(folder / "orthanc.json");
    file << "{\"StorageDirectory\":\"" << (folder / "storage").string()
         << "\",\"IndexDirectory\":\"" << (folder / "storage").string()
         << "\",\"HttpServerEnabled\":false,\"DicomServerEnabled\":true,\"DicomAet\":\"ORTHANC\""
         << ",\"DicomCheckCalledAet\":true,\"DicomPort\":" << m_node.port
         << R"(,"DicomAlwaysAllowStore":false,"DicomModalities":{"petrous":{"AET":"PETROUS",)"
         << R"("Host":"127.0.0.1","Port":)" << (options.movePort != 0 ? options.movePort : 104)
         << R"(,"AllowEcho":true,"AllowFind":true,"AllowStore":true,"AllowMove":true,"AllowGet":)"
         << (options.movePort != 0 ? "false" : "true") << R"(,"UseDicomTls":)"
         << (options.own ? "true" : "false") << "}}";
    m_node.movePort = options.movePort;
    if (options.own)
    {
      file << ",\"DicomTlsEnabled\":true,\"DicomTlsCertificate\":\"" << options.own->certificate()
           << "\",\"DicomTlsPrivateKey\":\"" << options.own->key()
           << "\",\"DicomTlsTrustedCertificates\":\"" << options.client->certificate() << "\"";
      m_node.tls = TlsFiles{options.own->certificate(), options.client->certificate(),
                            options.client->key()};
    }
    if (options.postgres != 0)
      file << ",\"Plugins\":[\"/usr/share/orthanc/plugins/libOrthancPostgreSQLIndex.so\","
              "\"/usr/share/orthanc/plugins/libOrthancPostgreSQLStorage.so\"]"
           << ",\"PostgreSQL\":{\"EnableIndex\":true,\"EnableStorage\":true,\"Host\":\"127.0.0.1\","
              "\"Port\":"
           << options.postgres
           << ",\"Database\":\"postgres\",\"Username\":\"petrous\",\"Password\":\"\"}";
    file << "}\n";
    file.close();
    auto process = std::make_unique<ServerProcess>(
        std::vector<std::string>{kProgram, (folder / "orthanc.json").string()}, folder / "log");
    const auto answers = [&]
    {
      const int connection = connectTo(m_node.port);
      if (connection < 0)
        return !process->running();
      ::close(connection);
      return true;
    };
    if (waitFor(answers) && process->running())
      m_process = std::move(process);
  }

  Node m_node;
  fs::path m_storage;
  std::unique_ptr<ServerProcess> m_process;
};

/// Forwards connections to a port, and breaks them as told: after so many bytes from the server.
class BreakingProxy
{
public:
  enum class Fault
  {
    Cut,
    Stall
  };

  /// `times`: how many connections are broken; the others pass.
  BreakingProxy(int target, std::size_t afterBytes, Fault fault, int times)
    : m_target(target)
    , m_after(afterBytes)
    , m_fault(fault)
    , m_times(times)
    , m_listener(listenOn(0, m_port))
    , m_thread([this] { run(); })
  {
  }
  ~BreakingProxy()
  {
    m_stop = true;
    m_thread.join();
    ::close(m_listener);
  }
  int port() const { return m_port; }
  bool stalled() const { return m_stalled; }
  int broken() const { return m_broken; }

private:
  bool wait(std::vector<pollfd>& all) const
  {
    while (!m_stop)
      if (::poll(all.data(), all.size(), 20) > 0)
        return true;
    return false;
  }

  void run()
  {
    std::vector<pollfd> all{{m_listener, POLLIN, 0}};
    while (wait(all))
    {
      const int client = ::accept(m_listener, nullptr, nullptr);
      const int server = connectTo(m_target);
      forward(client, server);
      ::close(client);
      ::close(server);
    }
  }

  void forward(int client, int server)
  {
    std::size_t count = 0;
    std::vector<char> bytes(65536);
    std::vector<pollfd> both{{client, POLLIN, 0}, {server, POLLIN, 0}};
    while (wait(both))
      for (int side = 0; side < 2; ++side)
      {
        if ((both[static_cast<std::size_t>(side)].revents & (POLLIN | POLLHUP | POLLERR)) == 0)
          continue;
        const ssize_t got = ::read(side == 0 ? client : server, bytes.data(), bytes.size());
        if (got <= 0)
          return;
        count += static_cast<std::size_t>(got); // of both directions
        if (count > m_after && m_broken < m_times)
        {
          ++m_broken;
          if (m_fault == Fault::Cut)
            return;
          m_stalled = true;
          std::vector<pollfd> closed{{client, POLLRDHUP, 0}};
          wait(closed);
          return;
        }
        for (ssize_t done = 0; done < got;)
        {
          const ssize_t sent = ::send(side == 0 ? server : client, bytes.data() + done,
                                      static_cast<std::size_t>(got - done), MSG_NOSIGNAL);
          if (sent <= 0)
            return;
          done += sent;
        }
      }
  }

  int m_target;
  std::size_t m_after;
  Fault m_fault;
  int m_times;
  std::atomic<int> m_broken{0};
  std::atomic<bool> m_stalled{false};
  std::atomic<bool> m_stop{false};
  int m_port = 0;
  int m_listener;
  std::thread m_thread;
};

} // namespace petrous::network::test
