#include "petrous/Library/PseudonymMap.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <memory>
#include <new>
#include <set>
#include <tuple>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <sodium.h>

#include "petrous/Core/InputFile.h"
#include "petrous/Core/OpenedLock.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Library/OwnerLock.h"

namespace petrous::library
{

namespace
{

using nlohmann::json;

constexpr char kMagic[] = "PETROUS-PSEUDONYMS ";
constexpr std::size_t kMagicBytes = sizeof(kMagic) - 1;
constexpr char kVersion = '1';
constexpr std::size_t kSalt = crypto_pwhash_SALTBYTES;
constexpr std::size_t kNonce = crypto_aead_xchacha20poly1305_ietf_NPUBBYTES;
constexpr std::size_t kTag = crypto_aead_xchacha20poly1305_ietf_ABYTES;
constexpr std::size_t kSecret = crypto_aead_xchacha20poly1305_ietf_KEYBYTES;
constexpr std::size_t kChecksum = 32;
constexpr std::size_t kCost = kMagicBytes + 2; // version and newline before it
constexpr std::size_t kHeader = kCost + 16 + kSalt + kNonce;
constexpr std::uintmax_t kLargest = std::uintmax_t{256} << 20;
constexpr std::uint64_t kMaxPasses = 16, kMaxMemory = std::uint64_t{1} << 30; // of a hostile file

unsigned char* bytesOf(std::string& text)
{
  return reinterpret_cast<unsigned char*>(text.data());
}

const unsigned char* bytesOf(const std::string& text)
{
  return reinterpret_cast<const unsigned char*>(text.data());
}

std::string littleEndian(std::uint64_t value)
{
  std::string bytes;
  for (unsigned n = 0; n < 8; ++n)
    bytes += static_cast<char>(value >> 8 * n & 0xffU);
  return bytes;
}

std::uint64_t numberAt(const std::string& bytes, std::size_t at)
{
  std::uint64_t value = 0;
  for (std::size_t n = 8; n-- > 0;)
    value = value << 8 | static_cast<unsigned char>(bytes[at + n]);
  return value;
}

std::string checksumOf(const std::string& bytes, std::size_t count)
{
  std::string sum(kChecksum, '\0');
  ::crypto_generichash(bytesOf(sum), sum.size(), bytesOf(bytes), count, nullptr, 0);
  return sum;
}

void checkPassphrase(const std::string& passphrase)
{
  constexpr std::size_t kShortest = 8;
  if (passphrase.size() < kShortest)
    throw core::InvalidParameter("the passphrase is too short: it needs at least 8 characters");
}

std::string newSalt()
{
  std::string salt(kSalt, '\0');
  ::randombytes_buf(salt.data(), salt.size());
  return salt;
}

} // namespace

PseudonymMapError::PseudonymMapError(Reason why, const std::string& message)
  : core::Error(why == Reason::InUse ? core::Fault::Refused : core::Fault::BadInput, message)
  , reason(why)
{
}

PseudonymMap::PseudonymMap(const std::filesystem::path& path, const std::string& passphrase)
  : PseudonymMap(path, passphrase, Cost())
{
}

PseudonymMap::PseudonymMap(const std::filesystem::path& path, const std::string& passphrase,
                           const Cost& cost)
  : m_path(core::outputTarget(path))
  , m_cost(cost)
{
  checkPassphrase(passphrase);
  const std::string lock = m_path.string() + ".lock";
  m_lock = ::open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (m_lock < 0)
    core::throwOutputError(errno, lock);
  try
  {
    if (core::lockOpened(m_lock) != core::LockState::Ours)
      throw PseudonymMapError(PseudonymMapError::Reason::InUse,
                              core::printable(m_path) +
                                  ": is in use by another program; try again when that has ended");
    m_secret = static_cast<unsigned char*>(::sodium_malloc(kSecret));
    if (!m_secret)
      throw std::bad_alloc();
    // Of a run that was killed while it wrote the map.
    removeAbandoned(
        m_path.has_parent_path() ? m_path.parent_path() : ".",
        [](const std::filesystem::path& found)
        {
          std::string start(kMagicBytes, '\0');
          std::error_code ignored;
          if (!core::isLeftover(found) ||
              !std::filesystem::is_regular_file(std::filesystem::symlink_status(found, ignored)))
            return false;
          std::ifstream(found, std::ios::binary).read(start.data(), kMagicBytes);
          return start == kMagic;
        });
    std::error_code error;
    if (std::filesystem::exists(m_path, error))
      read(passphrase);
    else
    {
      m_salt = newSalt();
      deriveKey(passphrase, m_salt);
    }
  }
  catch (...)
  {
    ::sodium_free(m_secret);
    ::close(m_lock);
    throw;
  }
}

PseudonymMap::~PseudonymMap()
{
  ::sodium_free(m_secret);
  ::close(m_lock);
  for (Pseudonym& entry : m_entries)
    ::sodium_memzero(entry.identity.data(), entry.identity.size());
}

void PseudonymMap::deriveKey(const std::string& passphrase, const std::string& salt)
{
  if (::crypto_pwhash(m_secret, kSecret, passphrase.data(), passphrase.size(), bytesOf(salt),
                      m_cost.passes, m_cost.memory, crypto_pwhash_ALG_ARGON2ID13) != 0)
    throw core::Error(core::Fault::Internal,
                      "there is not enough memory to open the pseudonym map (Argon2id needs " +
                          std::to_string(m_cost.memory >> 20) + " MiB)");
}

void PseudonymMap::read(const std::string& passphrase)
{
  using Reason = PseudonymMapError::Reason;
  const auto fail = [this](Reason reason, const char* what)
  { return PseudonymMapError(reason, core::printable(m_path) + ": " + what); };
  const std::string file = core::readFile(m_path, kLargest);
  if (file.compare(0, kMagicBytes, kMagic) != 0)
    throw fail(Reason::Damaged, "is not a pseudonym map of Petrous, or damaged");
  if (file.size() > kMagicBytes && file[kMagicBytes] > kVersion && file[kMagicBytes] <= '9')
    throw fail(Reason::NewerVersion, "was written by a newer version of Petrous");
  if (file.size() < kHeader + kTag + kChecksum ||
      checksumOf(file, file.size() - kChecksum) != file.substr(file.size() - kChecksum))
    throw fail(Reason::Damaged, "is damaged or incomplete; restore it from a backup");
  m_cost = {numberAt(file, kCost), numberAt(file, kCost + 8)};
  if (m_cost.passes < crypto_pwhash_OPSLIMIT_MIN || m_cost.passes > kMaxPasses ||
      m_cost.memory < crypto_pwhash_MEMLIMIT_MIN || m_cost.memory > kMaxMemory)
    throw fail(Reason::Damaged, "asks for an absurd amount of work; it was not written by Petrous");
  m_salt = file.substr(kCost + 16, kSalt);
  deriveKey(passphrase, m_salt);
  std::string plain(file.size() - kHeader - kTag - kChecksum, '\0');
  unsigned long long length = 0;
  if (::crypto_aead_xchacha20poly1305_ietf_decrypt(
          bytesOf(plain), &length, nullptr, bytesOf(file) + kHeader,
          file.size() - kHeader - kChecksum, bytesOf(file), kHeader,
          bytesOf(file) + kHeader - kNonce, m_secret) != 0)
    throw fail(Reason::WrongPassphrase, "cannot be opened with this passphrase");
  json content = json::parse(plain, nullptr, false);
  ::sodium_memzero(plain.data(), plain.size());
  try
  {
    const auto key = content.at("key").get<std::vector<unsigned char>>();
    PseudonymKey::Bytes bytes{};
    if (key.size() != bytes.size())
      throw fail(Reason::Damaged, "holds no key");
    std::copy(key.begin(), key.end(), bytes.begin());
    m_key = PseudonymKey(bytes);
    for (const json& entry : content.at("entries"))
      m_entries.push_back({entry.at(0).get<std::string>(), entry.at(1).get<std::string>(),
                           entry.at(2).get<std::string>()});
  }
  catch (const json::exception&)
  {
    throw fail(Reason::Damaged, "is not a pseudonym map of this version");
  }
}

std::size_t PseudonymMap::add(const std::vector<Pseudonym>& entries)
{
  // By place, so that no identity is copied to memory that is not cleared.
  const auto isBefore = [this, &entries](std::size_t a, std::size_t b)
  {
    const auto at = [this, &entries](std::size_t n) -> const Pseudonym&
    { return n < m_entries.size() ? m_entries[n] : entries[n - m_entries.size()]; };
    const Pseudonym &one = at(a), &other = at(b);
    return std::tie(one.kind, one.pseudonym, one.identity) <
           std::tie(other.kind, other.pseudonym, other.identity);
  };
  std::set<std::size_t, decltype(isBefore)> known(isBefore);
  std::vector<std::size_t> added;
  for (std::size_t n = 0; n < m_entries.size() + entries.size(); ++n)
    if (known.insert(n).second && n >= m_entries.size())
      added.push_back(n - m_entries.size());
  for (const std::size_t n : added) // `known` ends here
    m_entries.push_back(entries[n]);
  return added.size();
}

std::size_t PseudonymMap::takeIn(const std::vector<Pseudonym>& entries)
{
  const auto before = static_cast<std::ptrdiff_t>(m_entries.size());
  const std::size_t added = add(entries);
  try
  {
    save();
  }
  catch (...)
  {
    m_entries.erase(m_entries.begin() + before, m_entries.end());
    throw;
  }
  return added;
}

bool PseudonymMap::changePassphrase(const std::string& passphrase)
{
  checkPassphrase(passphrase);
  const std::unique_ptr<unsigned char, decltype(&::sodium_free)> former(
      static_cast<unsigned char*>(::sodium_malloc(kSecret)), &::sodium_free);
  if (!former)
    throw std::bad_alloc();
  std::copy(m_secret, m_secret + kSecret, former.get());
  std::string salt = newSalt();
  deriveKey(passphrase, salt);
  std::swap(m_salt, salt);
  try
  {
    return save();
  }
  catch (...)
  {
    std::copy(former.get(), former.get() + kSecret, m_secret);
    std::swap(m_salt, salt);
    throw;
  }
}

bool PseudonymMap::saveCopy(const std::filesystem::path& path, const std::string& passphrase) const
{
  std::error_code error;
  if (std::filesystem::exists(core::outputTarget(path), error))
    throw core::Error(core::Fault::Refused,
                      core::printable(path) + ": is there already; give the copy a new name");
  PseudonymMap copy(path, passphrase, m_cost);
  copy.m_key = m_key;
  copy.m_entries = m_entries;
  return copy.save();
}

bool PseudonymMap::save()
{
  json entries = json::array();
  for (const Pseudonym& entry : m_entries)
    entries.push_back({entry.kind, entry.pseudonym, entry.identity});
  const auto& key = m_key.bytes();
  std::string plain = json{{"key", std::vector<unsigned char>(key.begin(), key.end())},
                           {"entries", std::move(entries)}}
                          .dump(-1, ' ', true, json::error_handler_t::replace);
  std::string file = kMagic;
  file += kVersion;
  file += '\n';
  file += littleEndian(m_cost.passes) + littleEndian(m_cost.memory) + m_salt;
  std::string nonce(kNonce, '\0');
  ::randombytes_buf(nonce.data(), nonce.size());
  file += nonce;
  file.resize(kHeader + plain.size() + kTag);
  unsigned long long length = 0;
  const std::string header = file.substr(0, kHeader);
  ::crypto_aead_xchacha20poly1305_ietf_encrypt(bytesOf(file) + kHeader, &length, bytesOf(plain),
                                               plain.size(), bytesOf(header), kHeader, nullptr,
                                               bytesOf(nonce), m_secret);
  ::sodium_memzero(plain.data(), plain.size());
  file += checksumOf(file, file.size());
  core::OutputFile out(m_path);
  if (::fchmod(out.descriptor(), 0600) != 0)
    core::throwOutputError(errno, m_path);
  out.write(file);
  return out.commit();
}

} // namespace petrous::library
