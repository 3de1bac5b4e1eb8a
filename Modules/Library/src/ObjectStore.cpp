#include "petrous/Library/ObjectStore.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <memory>

#include <openssl/evp.h>

#include "DurableFile.h"

namespace petrous::library
{

namespace fs = std::filesystem;

namespace
{

constexpr std::size_t kHashDigits = 64;

// Removes the file unless it was taken in.
struct TemporaryFile
{
  fs::path path;
  ~TemporaryFile()
  {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
};

using Digest = std::array<unsigned char, 32>;

std::string hexadecimal(const Digest& digest)
{
  constexpr const char* digits = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : digest)
  {
    text += digits[byte >> 4];
    text += digits[byte & 15];
  }
  return text;
}

bool isObjectName(const std::string& name)
{
  const auto hex = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  return name.size() > kHashDigits && name[kHashDigits] == '.' &&
         std::all_of(name.begin(), name.begin() + kHashDigits, hex) &&
         name.find('/') == std::string::npos;
}

} // namespace

std::string sha256OfFile(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(),
                                                                        &EVP_MD_CTX_free);
  if (!file || !context || EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) != 1)
    throw LibraryError(LibraryError::Reason::NotFound, path.string() + ": cannot be read");
  std::vector<char> block(1 << 20);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())), file.gcount() > 0)
    EVP_DigestUpdate(context.get(), block.data(), static_cast<std::size_t>(file.gcount()));
  if (file.bad())
    throw LibraryError(LibraryError::Reason::Damaged,
                       path.string() + ": cannot be read to its end");
  Digest digest{};
  EVP_DigestFinal_ex(context.get(), digest.data(), nullptr);
  return hexadecimal(digest);
}

std::string sha256Of(const std::uint8_t* bytes, std::size_t count)
{
  Digest digest{};
  EVP_Digest(bytes, count, digest.data(), nullptr, EVP_sha256(), nullptr);
  return hexadecimal(digest);
}

ObjectStore::ObjectStore(fs::path folder)
  : m_folder(std::move(folder))
{
}

std::string ObjectStore::add(const std::string& ending,
                             const std::function<void(const fs::path&)>& write)
{
  makeFolder(m_folder);
  const TemporaryFile temporary{temporaryBeside(m_folder / ("object." + ending))};
  write(temporary.path);
  const std::string name = sha256OfFile(temporary.path) + "." + ending;
  const fs::path target = m_folder / name;
  if (!fs::exists(target))
  {
    m_new.push_back(target);
    renameDurably(temporary.path, target);
  }
  return name;
}

std::string ObjectStore::add(const std::string& ending, const std::vector<std::uint8_t>& bytes)
{
  return add(ending,
             [&bytes](const fs::path& path) {
               writeDurably(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
             });
}

fs::path ObjectStore::path(const std::string& object) const
{
  if (!isObjectName(object))
    throw LibraryError(LibraryError::Reason::Damaged,
                       m_folder.string() + ": the case names an object that is no object name");
  fs::path result = m_folder / object;
  if (!fs::exists(result))
    throw LibraryError(LibraryError::Reason::NotFound,
                       result.string() + ": missing; restore the library from a copy");
  return result;
}

std::vector<std::uint8_t> ObjectStore::read(const std::string& object) const
{
  const fs::path file = path(object);
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(fs::file_size(file)));
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream)
    throw LibraryError(LibraryError::Reason::Damaged, file.string() + ": cannot be read");
  return bytes;
}

std::vector<std::uint8_t> ObjectStore::readWhole(const std::string& object) const
{
  auto bytes = read(object);
  if (sha256Of(bytes.data(), bytes.size()) != object.substr(0, kHashDigits))
    throw LibraryError(LibraryError::Reason::Damaged,
                       path(object).string() +
                           ": is not what was written there; restore the library from a copy");
  return bytes;
}

void ObjectStore::discardNew() noexcept
{
  for (const fs::path& path : m_new)
  {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
  m_new.clear();
}

void ObjectStore::forget() noexcept
{
  m_new.clear();
}

void ObjectStore::removeLeftovers() noexcept
{
  std::error_code error;
  for (fs::directory_iterator entry(m_folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().filename().string().rfind(".", 0) == 0)
    {
      std::error_code ignored;
      fs::remove(entry->path(), ignored);
    }
}

} // namespace petrous::library
