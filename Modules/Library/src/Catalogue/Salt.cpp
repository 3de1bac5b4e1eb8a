#include "Salt.h"

#include <cerrno>
#include <cstdio>
#include <random>
#include <utility>

#include <sys/stat.h>

#include "LibraryFolder.h"
#include "petrous/Library/ObjectStore.h"

namespace petrous::library
{

namespace fs = std::filesystem;

namespace
{

constexpr std::size_t kLength = 64;
// Begins a salt whose hashes come with its ID; earlier ones are 64 hexadecimal digits. Thus hashes
// without an ID are known not to be of a salt that was drawn in the place of an earlier one.
const std::string kWithId = "2-";

std::string readSalt(const fs::path& library)
{
  return core::readFile(library / "salt", 2 * kLength);
}

// A plain hash would allow anyone who knows a hospital's UIDs to test them against it.
std::string saltedHash(const std::string& salt, const std::string& hash)
{
  const std::string text = salt + hash;
  return sha256Of(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

// The beginning of a hash, which tells nothing of the salt.
std::string idOf(const std::string& salt)
{
  constexpr std::size_t kIdLength = 16;
  return salt.rfind(kWithId, 0) == 0 ? saltedHash(salt, "id").substr(0, kIdLength) : std::string();
}

} // namespace

std::string drawnId()
{
  std::random_device random;
  char text[33];
  std::snprintf(text, sizeof text, "%08x%08x%08x%08x", random(), random(), random(), random());
  return text;
}

std::string saltOf(const fs::path& library)
{
  const fs::path path = library / "salt";
  std::error_code fault;
  if (fs::symlink_status(path, fault).type() == fs::file_type::not_found)
  {
    core::OutputFile out(path);
    if (::fchmod(out.descriptor(), 0600) != 0)
      core::throwOutputError(errno, path);
    out.write((kWithId + drawnId() + drawnId()).substr(0, kLength));
    out.commit();
  }
  std::string salt;
  try
  {
    salt = readSalt(library);
  }
  catch (const core::InputFileError& error)
  {
    throw libraryError(error);
  }
  if (salt.size() != kLength)
    throw LibraryError(LibraryError::Reason::Damaged,
                       path.string() + ": is not what this program wrote; restore it from a copy, "
                                       "or remove it (a new image's frame of reference is then "
                                       "not known to be that of older ones)");
  return salt;
}

bool hasSalt(const fs::path& library) noexcept
{
  try
  {
    return readSalt(library).size() == kLength;
  }
  catch (const std::exception&)
  {
    return false;
  }
}

scene::IdentitySalt identitySalt(std::function<std::string()> salt)
{
  return {[salt](const std::string& hash) { return saltedHash(salt(), hash); },
          [salt] { return idOf(salt()); }};
}

} // namespace petrous::library
