#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "petrous/Core/Error.h"
#include "petrous/Library/Deidentification.h"

namespace petrous::library
{

/// A map file that cannot be used. Fault::Refused where it is in use, else BadInput.
struct PseudonymMapError : core::Error
{
  enum class Reason
  {
    WrongPassphrase,
    Damaged,
    NewerVersion,
    InUse
  };
  PseudonymMapError(Reason why, const std::string& message);
  Reason reason;
};

/// Who is behind the pseudonyms, and the key that made them: an encrypted file that stays at home.
///
/// The file is a header (format, cost, salt, nonce), the entries as JSON encrypted and
/// authenticated together with the header by XChaCha20-Poly1305, and a BLAKE2b checksum that tells
/// damage from a wrong passphrase. The encryption key is the passphrase's Argon2id hash. Replaced
/// as a whole by `save`; locked (FILE.lock) from construction to destruction.
class PseudonymMap
{
public:
  /// Cost of Argon2id: passes and bytes of memory. The default takes about a second.
  struct Cost
  {
    std::uint64_t passes = 3;
    std::uint64_t memory = std::uint64_t{256} << 20;
  };

  /// Opens the file, or starts a new map where there is none (written by `save`). Throws
  /// PseudonymMapError, InvalidParameter for a passphrase of less than 8 bytes, InputFileError.
  PseudonymMap(const std::filesystem::path& path, const std::string& passphrase, const Cost& cost);
  PseudonymMap(const std::filesystem::path& path, const std::string& passphrase);
  ~PseudonymMap();
  PseudonymMap(const PseudonymMap&) = delete;
  PseudonymMap& operator=(const PseudonymMap&) = delete;

  const PseudonymKey& key() const noexcept { return m_key; }
  const std::vector<Pseudonym>& entries() const noexcept { return m_entries; }

  /// Entries that it has already are not added again. Returns how many were new.
  std::size_t add(const std::vector<Pseudonym>& entries);

  /// Writes the map under another passphrase. Returns and throws as OutputFile::commit;
  /// InvalidParameter for less than 8 bytes. The map, and its file, are then as they were.
  bool changePassphrase(const std::string& passphrase);

  /// Writes the same map, key included, to a new file under a passphrase of its own. Returns and
  /// throws as OutputFile::commit; PseudonymMapError (InUse); Error (Refused) if the file is there.
  bool saveCopy(const std::filesystem::path& path, const std::string& passphrase) const;

  /// Adds entries and saves them; one that cannot be saved is as it was, file and all. Returns how
  /// many were new; throws as OutputFile::commit.
  std::size_t takeIn(const std::vector<Pseudonym>& entries);

  /// Returns and throws as OutputFile::commit.
  bool save();

private:
  void read(const std::string& passphrase);
  void deriveKey(const std::string& passphrase, const std::string& salt);

  std::filesystem::path m_path;
  Cost m_cost;
  std::string m_salt;
  unsigned char* m_secret = nullptr; ///< sodium_malloc
  int m_lock = -1;
  PseudonymKey m_key;
  std::vector<Pseudonym> m_entries;
};

} // namespace petrous::library
