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

/// What an object is to the user, for messages.
struct ObjectText
{
  ObjectText(std::string text = {}, bool ofInstrument = false)
    : words(std::move(text))
    , isInstrument(ofInstrument)
  {
  }

  std::string words; ///< "mesh 'cochlea' of case 'ear'"; empty: not known
  bool isInstrument; ///< and no part of the case, so that another remedy helps
};

/// Content-addressed store: files are named by the SHA-256 of their content, so identical content
/// is stored once, and nothing that a manifest references is ever overwritten.
///
/// An object name is the hash in hexadecimal with the extension of its format, e.g. "3b1c….nrrd".
/// Not for concurrent writers: the library's lock prevents them.
class ObjectStore
{
public:
  explicit ObjectStore(std::filesystem::path folder);

  /// Lets `write` create a file at a temporary path, then adds it durably; returns the object name.
  /// An existing object is verified, and replaced if damaged. Throws what `write` throws,
  /// LibraryError and core::OutputFileError; leaves nothing behind then.
  std::string add(const std::string& ending,
                  const std::function<void(const std::filesystem::path&)>& write);
  /// The same; `write` returns the file's SHA-256, which it has computed as it wrote it.
  std::string addHashed(const std::string& ending,
                        const std::function<std::string(const std::filesystem::path&)>& write);

  std::string add(const std::string& ending, const std::vector<std::uint8_t>& bytes);

  bool contains(const std::string& object) const noexcept;

  /// Path of an existing object; throws LibraryError (NotFound) naming it otherwise, and (Damaged)
  /// for an invalid object name.
  std::filesystem::path path(const std::string& object, const ObjectText& what = {}) const;

  /// Like `path`, but verifies the content against the hash in the name: throws LibraryError
  /// (Damaged) on mismatch.
  std::filesystem::path checkedPath(const std::string& object, const ObjectText& what) const;
  std::vector<std::uint8_t> readChecked(const std::string& object, const ObjectText& what) const;

  /// All objects with their size in bytes.
  std::vector<std::pair<std::string, std::uintmax_t>> list() const;
  void remove(const std::string& object); ///< throws LibraryError

  /// Objects added since `forget`, newest last; `discardNew` removes them again.
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

/// SHA-256 of a file in lower-case hexadecimal. Throws LibraryError if it cannot be read.
std::string sha256OfFile(const std::filesystem::path& path, const core::Progress& progress = {});

/// Throws LibraryError (Damaged, NotFound) if the content of a file does not match its name.
void checkObject(const std::filesystem::path& object, const ObjectText& what,
                 const core::Progress& progress = {});

} // namespace petrous::library
