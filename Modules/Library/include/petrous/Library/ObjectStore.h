#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Library/LibraryError.h"

namespace petrous::library
{

/// Files named by the SHA-256 of their content: what is stored twice is kept once, and nothing that
/// a manifest names is ever overwritten.
///
/// An object's name is its hash in hexadecimal with the ending of its format, e.g.
/// "3b1c….nrrd". Not for several writers at once: the library's lock sees to that.
class ObjectStore
{
public:
  explicit ObjectStore(std::filesystem::path folder);

  /// Lets `write` make a file at a temporary path, then takes it in, durably; returns the object's
  /// name. An object that is there already is held against its name, and replaced where it is
  /// damaged. Throws what `write` throws, LibraryError and core::OutputFileError; leaves nothing
  /// behind then.
  std::string add(const std::string& ending,
                  const std::function<void(const std::filesystem::path&)>& write);

  std::string add(const std::string& ending, const std::vector<std::uint8_t>& bytes);

  bool contains(const std::string& object) const noexcept;

  /// Path of an object that is there; throws LibraryError (NotFound) naming it otherwise, and
  /// (Damaged) for a name that is no object name. `what` names for the user what the object is.
  std::filesystem::path path(const std::string& object, const std::string& what = {}) const;

  /// The same, and the content must have the hash that the name says: throws LibraryError (Damaged)
  /// otherwise.
  std::filesystem::path checkedPath(const std::string& object, const std::string& what) const;
  std::vector<std::uint8_t> readChecked(const std::string& object, const std::string& what) const;

  /// Every object with its size in bytes.
  std::vector<std::pair<std::string, std::uintmax_t>> list() const;
  void remove(const std::string& object); ///< throws LibraryError

  /// Objects that this store added since `forget`, newest last; `discardNew` removes them again.
  void discardNew() noexcept;
  void forget() noexcept;

private:
  bool makeRoom(const std::string& object);
  void settle(bool synced) const;

  std::filesystem::path m_folder;
  std::vector<std::filesystem::path> m_new;
};

/// SHA-256 in lower-case hexadecimal.
std::string sha256Of(const std::uint8_t* bytes, std::size_t count);

/// SHA-256 of a file in lower-case hexadecimal. Throws LibraryError when it cannot be read.
std::string sha256OfFile(const std::filesystem::path& path, const core::Progress& progress = {});

/// Throws LibraryError (Damaged, NotFound) where a file's content is not what its name says.
void checkObject(const std::filesystem::path& object, const std::string& what,
                 const core::Progress& progress = {});

} // namespace petrous::library
