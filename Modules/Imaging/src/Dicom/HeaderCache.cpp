#include "HeaderCache.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <ctime>
#include <memory>
#include <string_view>
#include <type_traits>

#include <openssl/evp.h>
#include <openssl/rand.h>
#include <sys/stat.h>

#include "ByteSource.h"

namespace petrous::imaging
{

namespace
{

constexpr const char* kMethod = "dicom headers 12"; // increment with the fields below
constexpr std::int64_t kCoarsest = 2'000'000'000;   // ns; FAT
constexpr std::size_t kSampled = 8;                 // files
constexpr std::size_t kSample = 4096;               // bytes
constexpr std::size_t kMostBytes = std::size_t{64} << 20;
constexpr std::size_t kNonce = 12;
constexpr std::size_t kTag = 16;

class Sha256
{
public:
  Sha256()
    : m_context(EVP_MD_CTX_new(), &EVP_MD_CTX_free)
  {
    EVP_DigestInit_ex(m_context.get(), EVP_sha256(), nullptr);
  }
  void add(const void* bytes, std::size_t count)
  {
    EVP_DigestUpdate(m_context.get(), bytes, count);
  }
  template <class Number>
  void add(Number value)
  {
    static_assert(std::is_arithmetic_v<Number>);
    add(&value, sizeof value);
  }
  void add(std::string_view text)
  {
    add(text.size());
    add(text.data(), text.size());
  }
  std::string value() const
  {
    std::string result(32, '\0');
    const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> copy(EVP_MD_CTX_new(),
                                                                       &EVP_MD_CTX_free);
    EVP_MD_CTX_copy_ex(copy.get(), m_context.get());
    EVP_DigestFinal_ex(copy.get(), reinterpret_cast<unsigned char*>(result.data()), nullptr);
    return result;
  }

private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> m_context;
};

std::string hex(std::string_view bytes)
{
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const char c : bytes)
  {
    text += kDigits[static_cast<unsigned char>(c) >> 4];
    text += kDigits[static_cast<unsigned char>(c) & 15];
  }
  return text;
}

/// Appends values, or takes them back in the same order.
class Writer
{
public:
  explicit Writer(std::string& bytes)
    : m_bytes(bytes)
  {
  }
  bool good() const { return true; }
  template <class Number>
  void raw(const Number& value)
  {
    m_bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void text(const std::string& value)
  {
    raw(static_cast<std::uint32_t>(value.size()));
    m_bytes += value;
  }
  void size(std::size_t& count) { raw(static_cast<std::uint32_t>(count)); }

private:
  std::string& m_bytes;
};

class Reader
{
public:
  explicit Reader(std::string_view bytes)
    : m_rest(bytes)
  {
  }
  bool good() const { return m_good; }
  bool isAtEnd() const { return m_good && m_rest.empty(); }
  template <class Number>
  void raw(Number& value)
  {
    m_good = m_good && m_rest.size() >= sizeof value;
    if (!m_good)
      return;
    std::memcpy(&value, m_rest.data(), sizeof value);
    m_rest.remove_prefix(sizeof value);
  }
  void text(std::string& value)
  {
    std::size_t count = 0;
    size(count);
    if (!m_good)
      return;
    value.assign(m_rest.data(), count);
    m_rest.remove_prefix(count);
  }
  void size(std::size_t& count) ///< of something of at least as many bytes
  {
    std::uint32_t value = 0;
    raw(value);
    count = value;
    m_good = m_good && count <= m_rest.size();
  }

private:
  std::string_view m_rest;
  bool m_good = true;
};

template <class Archive, class Number>
std::enable_if_t<std::is_arithmetic_v<Number> || std::is_enum_v<Number>> pass(Archive& archive,
                                                                              Number& value)
{
  archive.raw(value);
}

template <class Archive>
void pass(Archive& archive, std::string& value)
{
  archive.text(value);
}

template <class Archive, int N>
void pass(Archive& archive, Eigen::Matrix<double, N, 1>& value)
{
  for (Eigen::Index n = 0; n < N; ++n)
    archive.raw(value[n]);
}

template <class Archive>
void pass(Archive& archive, std::filesystem::path& value)
{
  std::string text = value.string();
  archive.text(text);
  value = std::move(text);
}

template <class Archive, class T>
void pass(Archive& archive, std::optional<T>& value)
{
  bool has = value.has_value();
  archive.raw(has);
  if (!archive.good() || !has)
    return;
  if (!value)
    value.emplace();
  pass(archive, *value);
}

template <class Archive, class T>
void pass(Archive& archive, std::vector<T>& values)
{
  std::size_t count = values.size();
  archive.size(count);
  if (!archive.good())
    return;
  values.resize(count);
  for (T& value : values)
    if (archive.good())
      pass(archive, value);
}

template <class Archive, class... Fields>
void passAll(Archive& archive, Fields&... fields)
{
  (pass(archive, fields), ...);
}

// The bindings name every field, in order: a field added to a header does not compile here until it
// is stored too.

template <class Archive>
void pass(Archive& archive, FileStamp& value)
{
  auto& [device, inode, size, modified, changed] = value;
  passAll(archive, device, inode, size, modified, changed);
}

template <class Archive>
void pass(Archive& archive, PatientKey& value)
{
  auto& [id, issuer, name, birthDate, nameParts, foldedParts, joinedName] = value;
  passAll(archive, id, issuer, name, birthDate, joinedName);
  for (std::size_t& part : nameParts)
    pass(archive, part);
  for (std::size_t& part : foldedParts)
    pass(archive, part);
}

template <class Archive>
void pass(Archive& archive, SliceTraits& value)
{
  auto& [b, echoTime, triggerTime, phase, inversion, echo, temporal, gradient, stack] = value;
  passAll(archive, b, echoTime, triggerTime, phase, inversion, echo, temporal, gradient, stack);
}

template <class Archive>
void pass(Archive& archive, PixelFormat& value)
{
  auto& [bitsAllocated, bitsStored, highBit, isSigned, isReal, samples, photometric, syntax,
         isEncapsulated, isBigEndian, isWords, isDeflated, offset, offsetTable, frame, frameCount,
         length] = value;
  passAll(archive, bitsAllocated, bitsStored, highBit, isSigned, isReal, samples, photometric,
          syntax, isEncapsulated, isBigEndian, isWords, isDeflated, offset, offsetTable, frame,
          frameCount, length);
}

template <class Archive>
void pass(Archive& archive, SliceHeader& value)
{
  auto& [file, stamp, position, row, column, pixelSpacing, rows, columns, frames, slope, intercept,
         hasRescale, rescaleType, isCalibrated, isLossy, isLossUnknown, lossyRatio, burnedIn,
         declaredSpacing, thickness, declaredTilt, padding, paddingLimit, taken, patientPosition,
         instance, stackPosition, count, isImage, imageType, frameOfReference, patient, study,
         modality, kernel, tube, seriesNumber, acquisition, traits, step, hasLut, pixels, damage] =
      value;
  passAll(archive, file, stamp, position, row, column, pixelSpacing, rows, columns, frames, slope,
          intercept, hasRescale, rescaleType, isCalibrated, isLossy, isLossUnknown, lossyRatio,
          burnedIn, declaredSpacing, thickness, declaredTilt, padding, paddingLimit, taken,
          patientPosition, instance, stackPosition, count, isImage, imageType, frameOfReference,
          patient, study, modality, kernel, tube, seriesNumber, acquisition, traits, step, hasLut,
          pixels, damage);
}

template <class Archive>
void pass(Archive& archive, FileHeader& value)
{
  auto& [kind, hasFailed, sopClass, seriesUid, modality, description, slice, frames] = value;
  passAll(archive, kind, hasFailed, sopClass, seriesUid, modality, description, slice, frames);
}

using Cipher = std::unique_ptr<EVP_CIPHER_CTX, decltype(&EVP_CIPHER_CTX_free)>;

const unsigned char* in(const void* bytes)
{
  return static_cast<const unsigned char*>(bytes);
}

/// nonce, ciphertext, tag; empty on failure.
core::DerivedStore::Bytes sealed(const std::string& plain, const std::string& secret)
{
  core::DerivedStore::Bytes bytes(kNonce + plain.size() + kTag);
  const Cipher cipher(EVP_CIPHER_CTX_new(), &EVP_CIPHER_CTX_free);
  int count = 0;
  int rest = 0;
  const bool done = cipher && RAND_bytes(bytes.data(), static_cast<int>(kNonce)) == 1 &&
                    EVP_EncryptInit_ex(cipher.get(), EVP_aes_256_gcm(), nullptr, in(secret.data()),
                                       bytes.data()) == 1 &&
                    EVP_EncryptUpdate(cipher.get(), bytes.data() + kNonce, &count, in(plain.data()),
                                      static_cast<int>(plain.size())) == 1 &&
                    EVP_EncryptFinal_ex(cipher.get(), bytes.data() + kNonce + count, &rest) == 1 &&
                    EVP_CIPHER_CTX_ctrl(cipher.get(), EVP_CTRL_GCM_GET_TAG, static_cast<int>(kTag),
                                        bytes.data() + kNonce + plain.size()) == 1;
  if (!done)
    bytes.clear();
  return bytes;
}

std::optional<std::string> opened(core::DerivedStore::Bytes bytes, const std::string& secret)
{
  if (bytes.size() < kNonce + kTag || bytes.size() > kMostBytes)
    return std::nullopt;
  std::string plain(bytes.size() - kNonce - kTag, '\0');
  const Cipher cipher(EVP_CIPHER_CTX_new(), &EVP_CIPHER_CTX_free);
  auto* out = reinterpret_cast<unsigned char*>(plain.data());
  int count = 0;
  int rest = 0;
  const bool done = cipher &&
                    EVP_DecryptInit_ex(cipher.get(), EVP_aes_256_gcm(), nullptr, in(secret.data()),
                                       bytes.data()) == 1 &&
                    EVP_DecryptUpdate(cipher.get(), out, &count, bytes.data() + kNonce,
                                      static_cast<int>(plain.size())) == 1 &&
                    EVP_CIPHER_CTX_ctrl(cipher.get(), EVP_CTRL_GCM_SET_TAG, static_cast<int>(kTag),
                                        bytes.data() + kNonce + plain.size()) == 1 &&
                    EVP_DecryptFinal_ex(cipher.get(), out + count, &rest) == 1;
  return done ? std::optional(std::move(plain)) : std::nullopt;
}

} // namespace

std::int64_t timeNow()
{
  struct timespec now = {};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

HeaderCache::HeaderCache(core::DerivedStore& store, const std::vector<ListedFile>& files)
  : m_store(store)
  , m_files(files)
{
  Sha256 list;
  list.add(std::string_view(kMethod));
  struct stat program = {};
  if (::stat("/proc/self/exe", &program) == 0)
  {
    list.add(program.st_size);
    list.add(program.st_mtim.tv_sec);
    list.add(program.st_mtim.tv_nsec);
  }
  for (const ListedFile& file : files)
  {
    list.add(std::string_view(file.path.native()));
    for (const std::uint64_t number : {file.stamp.device, file.stamp.inode, file.stamp.size})
      list.add(number);
    list.add(file.stamp.modified);
    list.add(file.stamp.changed);
  }
  m_name = kMethod + (" " + hex(list.value()));
  std::array<char, kSample> sample{};
  for (std::size_t n = 0; n < std::min(kSampled, files.size()); ++n)
  {
    ByteSource source(files[n * files.size() / std::min(kSampled, files.size())].path);
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(kSample, source.size()));
    if (source.isOpen() && source.read(0, sample.data(), count))
      list.add(sample.data(), count);
  }
  m_secret = list.value();
}

std::optional<HeaderCache::Entry> HeaderCache::find()
{
  const auto bytes = m_store.find(m_name);
  const auto plain = bytes ? opened(*bytes, m_secret) : std::nullopt;
  if (!plain)
    return std::nullopt;
  Entry entry;
  entry.headers.resize(m_files.size());
  Reader reader(*plain);
  for (std::size_t n = 0; n < entry.headers.size(); ++n)
  {
    pass(reader, entry.headers[n]);
    if (!reader.good() || entry.headers[n].slice.file != m_files[n].path)
      return std::nullopt;
  }
  std::size_t count = 0;
  reader.size(count);
  for (std::size_t n = 0; n < count && reader.good(); ++n)
  {
    std::string key;
    std::uint64_t value = 0;
    reader.text(key);
    reader.raw(value);
    entry.comparisons.emplace(std::move(key), value);
  }
  return reader.isAtEnd() ? std::optional(std::move(entry)) : std::nullopt;
}

std::optional<std::string> HeaderCache::packed(const std::vector<FileHeader>& headers,
                                               std::int64_t listed) const
{
  for (std::size_t n = 0; n < headers.size(); ++n)
  {
    const FileStamp& then = m_files[n].stamp;
    const FileStamp& read = headers[n].slice.stamp;
    const bool isSame = then.size == read.size && then.modified == read.modified &&
                        then.inode == read.inode && then.device == read.device;
    if (headers[n].hasFailed || !isSame || then.modified + kCoarsest > listed)
      return std::nullopt;
  }
  std::string plain;
  Writer writer(plain);
  for (FileHeader header : headers) // a copy: reading and writing share their code
  {
    pass(writer, header);
    if (plain.size() + kNonce + kTag > kMostBytes)
      return std::nullopt;
  }
  return plain;
}

void HeaderCache::put(std::string packed, const KnownComparisons& comparisons)
{
  Writer writer(packed);
  std::size_t count = comparisons.size();
  writer.size(count);
  for (const auto& [key, value] : comparisons)
  {
    writer.text(key);
    writer.raw(value);
  }
  if (packed.size() + kNonce + kTag > kMostBytes)
    return;
  if (const auto bytes = sealed(packed, m_secret); !bytes.empty())
    m_store.put(m_name, bytes);
}

} // namespace petrous::imaging
