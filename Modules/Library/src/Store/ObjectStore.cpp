#include "petrous/Library/ObjectStore.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <memory>

#include <unistd.h>

#include "LibraryFolder.h"
#include "Sha256.h"

namespace petrous::library
{

namespace fs = std::filesystem;

namespace
{

constexpr std::size_t kHashDigits = 64;

// Removes the file on destruction, unless it was renamed.
struct TemporaryFile
{
  fs::path path;
  ~TemporaryFile()
  {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
};

bool isObjectName(const std::string& name)
{
  const auto hex = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  return name.size() > kHashDigits && name[kHashDigits] == '.' &&
         std::all_of(name.begin(), name.begin() + kHashDigits, hex) &&
         name.find('/') == std::string::npos;
}

// What helps if an object is missing or damaged: a stroke cannot be imported.
std::string remedyFor(const fs::path& object, const ObjectText& what)
{
  const fs::path ending = object.extension();
  return std::string("; restore this file from a copy of the library") +
         (what.isInstrument
              ? ", take it up again from its own file (petrous view --instrument), or "
                "take it out of the case (--clear instrument)"
          : ending == ".stroke" ? ""
          : ending == ".nrrd" || ending == ".obj"
              ? ", or import the same data again (into a new case), which puts it back"
              : ", or attach the same file again, which puts it back") +
         "; 'petrous library verify' lists all that is damaged";
}

[[noreturn]] void throwDamaged(const fs::path& object, const ObjectText& what)
{
  throw LibraryError(LibraryError::Reason::Damaged,
                     core::printable(object) + ": " +
                         (what.words.empty() ? "this file" : what.words) +
                         " is damaged: not what was stored there" + remedyFor(object, what));
}

[[noreturn]] void throwMissing(const fs::path& object, const ObjectText& what)
{
  throw LibraryError(LibraryError::Reason::NotFound,
                     core::printable(object) + ": " +
                         (what.words.empty() ? "" : what.words + " is ") + "missing" +
                         remedyFor(object, what));
}

} // namespace

Sha256::Sha256()
  : m_context(EVP_MD_CTX_new(), &EVP_MD_CTX_free)
{
  if (!m_context || EVP_DigestInit_ex(m_context.get(), EVP_sha256(), nullptr) != 1)
    throw std::bad_alloc();
}

void Sha256::add(const void* bytes, std::size_t count)
{
  EVP_DigestUpdate(m_context.get(), bytes, count);
}

std::string Sha256::hexadecimal()
{
  std::array<unsigned char, 32> digest{};
  EVP_DigestFinal_ex(m_context.get(), digest.data(), nullptr);
  constexpr const char* digits = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : digest)
  {
    text += digits[byte >> 4];
    text += digits[byte & 15];
  }
  return text;
}

std::string copied(const core::InputFile& file,
                   const std::function<void(const char*, std::size_t)>& write,
                   const core::Progress& progress, const char* task)
{
  Sha256 hash;
  std::vector<char> block(1 << 20);
  for (std::uintmax_t done = 0; done < file.size();)
  {
    progress.report(static_cast<double>(done) / static_cast<double>(file.size()), task);
    const ssize_t got =
        ::pread(file.descriptor(), block.data(), block.size(), static_cast<off_t>(done));
    if (got < 0 && errno == EINTR)
      continue;
    if (got <= 0)
      throw LibraryError(LibraryError::Reason::Damaged,
                         core::printable(file.path()) + ": cannot be read to its end");
    const auto count = static_cast<std::size_t>(
        std::min<std::uintmax_t>(static_cast<std::uintmax_t>(got), file.size() - done));
    hash.add(block.data(), count);
    if (write)
      write(block.data(), count);
    done += count;
  }
  return hash.hexadecimal();
}

std::string sha256OfFile(const fs::path& path, const core::Progress& progress)
try
{
  return copied(core::InputFile(path), {}, progress, "checking a file");
}
catch (const core::InputFileError& error)
{
  throw libraryError(error);
}

std::string sha256Of(const std::uint8_t* bytes, std::size_t count)
{
  Sha256 hash;
  hash.add(bytes, count);
  return hash.hexadecimal();
}

void checkObject(const fs::path& object, const ObjectText& what, const core::Progress& progress)
{
  std::error_code error;
  if (fs::symlink_status(object, error).type() == fs::file_type::not_found)
    throwMissing(object, what);
  if (sha256OfFile(object, progress) != object.filename().string().substr(0, kHashDigits))
    throwDamaged(object, what);
}

ObjectStore::ObjectStore(fs::path folder)
  : m_folder(std::move(folder))
{
}

std::string ObjectStore::add(const std::string& ending,
                             const std::function<void(const fs::path&)>& write)
{
  return addHashed(ending,
                   [&write](const fs::path& path)
                   {
                     write(path);
                     return sha256OfFile(path);
                   });
}

std::string ObjectStore::addHashed(const std::string& ending,
                                   const std::function<std::string(const fs::path&)>& write)
{
  makeFolder(m_folder);
  // Writers choose the format by the file extension.
  const TemporaryFile temporary{core::temporaryBeside(m_folder / ending).string() + "." + ending};
  const std::string name = write(temporary.path) + "." + ending;
  if (makeRoom(name))
    settle(moveFile(temporary.path, m_folder / name));
  return name;
}

std::string ObjectStore::add(const std::string& ending, const std::vector<std::uint8_t>& bytes)
{
  makeFolder(m_folder);
  const std::string name = sha256Of(bytes.data(), bytes.size()) + "." + ending;
  if (makeRoom(name))
    settle(core::writeFile(m_folder / name,
                           {reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
  return name;
}

// False if the object exists and is intact.
bool ObjectStore::makeRoom(const std::string& object)
{
  const fs::path target = m_folder / object;
  if (!contains(object))
    m_new.push_back(target);
  else if (sha256OfFile(target) == object.substr(0, kHashDigits))
    return false;
  return true;
}

// An object must be on disk before a manifest references it.
void ObjectStore::settle(bool synced) const
{
  if (!synced)
    throw LibraryError(LibraryError::Reason::Unwritable,
                       core::printable(m_folder) +
                           ": the disk does not confirm what was written; check the disk");
}

bool ObjectStore::contains(const std::string& object) const noexcept
{
  std::error_code error;
  return isObjectName(object) && fs::is_regular_file(m_folder / object, error);
}

fs::path ObjectStore::path(const std::string& object, const ObjectText& what) const
{
  if (!isObjectName(object))
    throw LibraryError(LibraryError::Reason::Damaged,
                       core::printable(m_folder) +
                           ": the case refers to an object by an invalid name; restore its "
                           "manifest from a copy of the library");
  fs::path result = m_folder / object;
  if (!contains(object))
    throwMissing(result, what);
  return result;
}

fs::path ObjectStore::checkedPath(const std::string& object, const ObjectText& what) const
{
  fs::path result = path(object, what);
  checkObject(result, what);
  return result;
}

std::vector<std::uint8_t> ObjectStore::readChecked(const std::string& object,
                                                   const ObjectText& what) const
try
{
  const fs::path file = path(object, what);
  const std::string text = core::readFile(file);
  std::vector<std::uint8_t> bytes(text.begin(), text.end());
  if (sha256Of(bytes.data(), bytes.size()) != object.substr(0, kHashDigits))
    throwDamaged(file, what);
  return bytes;
}
catch (const core::InputFileError& error)
{
  throw libraryError(error);
}

std::vector<std::pair<std::string, std::uintmax_t>> ObjectStore::list() const
{
  std::vector<std::pair<std::string, std::uintmax_t>> objects;
  std::error_code error;
  for (fs::directory_iterator entry(m_folder, error), end; !error && entry != end;
       entry.increment(error))
  {
    const std::string name = entry->path().filename().string();
    std::error_code none;
    const std::uintmax_t size = entry->file_size(none);
    if (isObjectName(name) && !none)
      objects.emplace_back(name, size);
  }
  if (error && error != std::errc::no_such_file_or_directory)
    throw LibraryError(LibraryError::Reason::Damaged,
                       core::printable(m_folder) + ": cannot be read; check the permissions");
  std::sort(objects.begin(), objects.end());
  return objects;
}

void ObjectStore::remove(const std::string& object)
{
  const fs::path file = path(object);
  if (::unlink(file.c_str()) != 0)
    throwForErrno(errno, file);
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

} // namespace petrous::library
