#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"

namespace petrous::library
{

/// De-identification of DICOM files by the Basic Application Level Confidentiality Profile (PS3.15
/// Annex E) and options to it. What Table E.1-1 does not list stays only if it cannot carry an
/// identity (numbers, coded strings, well-known UIDs, codes and units of a known form,
/// manufacturers of a list); other text is reduced to a vocabulary.
struct DeidentificationOptions
{
  enum class Dates
  {
    Remove,
    Shift, ///< by a number of days of the patient's own, the same in all files
    Keep
  };

  Dates dates = Dates::Remove;
  bool cleanDescriptors = false; ///< descriptions reduced to a vocabulary, instead of removed
  bool retainDevice = false;     ///< also model, software, names of sequences, kernels and coils
  bool retainPatientCharacteristics = false; ///< sex, age, size, weight
  bool retainSafePrivate = false;            ///< PS3.15 Table E.3.10-1
  bool keepBurnedIn = false; ///< also images that state, or are suspected of, burned-in text
  /// Air in place of the face (volume::maskFace) in CT and MR volumes, by the Clean Recognizable
  /// Visual Features Option. Images that are in no such volume, and volumes with a face whose
  /// pixels are compressed, are left out.
  bool maskFace = false;
};

/// What replaces identities; equal keys give equal pseudonyms, UIDs and date shifts. Nothing leads
/// back from them without the key.
class PseudonymKey
{
public:
  using Bytes = std::array<unsigned char, 32>;

  PseudonymKey(); ///< random
  explicit PseudonymKey(const Bytes& bytes) noexcept
    : m_bytes(bytes)
  {
  }
  ~PseudonymKey();

  /// "2.25." and a UUID (ITU-T X.667), from keyed BLAKE2b of `uid`.
  std::string uid(const std::string& uid) const;
  std::string patient(const std::string& patientId) const; ///< "P-" and 12 hexadecimal digits
  int daysEarlier(const std::string& patientId) const;     ///< 1 to 3650

  const Bytes& bytes() const noexcept { return m_bytes; }

private:
  Bytes m_bytes{};
};

/// A patient, study or series, and what stands for it. For the map at home only.
struct Pseudonym
{
  std::string kind; ///< "patient", "study", "series"
  std::string pseudonym;
  std::string identity; ///< patient ID and name, UTF-8; or UID
};

/// What was done, without any value, file name or UID. Attributes are named by their path of tags,
/// e.g. "(0040,0275)/(0040,0007)".
struct DeidentificationReport
{
  struct Line
  {
    std::string attribute;
    std::string name; ///< of PS3.6; private attributes: the creator's, if it is a known one
    std::string action;
    std::size_t files = 0;
    bool stays = false; ///< with its value, or a part of it
  };

  std::string edition; ///< of the table
  std::vector<std::string> options;
  std::vector<Line> lines; ///< sorted by attribute
  std::size_t filesWritten = 0;
  std::size_t patients = 0;
  std::map<std::string, std::size_t> leftOut;  ///< number of files by reason
  std::map<std::string, std::size_t> warnings; ///< number of files by warning
  bool durable = true;

  std::string text() const;
};

struct DeidentificationResult
{
  DeidentificationReport report;
  /// What was not written and why. Has the names of input files, which may identify the patient:
  /// for the user's own screen only.
  std::vector<std::string> leftOut;
  std::vector<Pseudonym> pseudonyms; ///< for the map at home
};

/// De-identifies the DICOM files in `input`, a file or a folder of any depth, into `output`, a file
/// or a new or empty folder; files there are numbered by series. Files that cannot be de-identified
/// (documents, private SOP classes, damaged files) are left out. The output is complete or absent;
/// what an earlier call left there or beside it when its process was killed is removed. A file that
/// is there is replaced.
///
/// `keep` is given the pseudonyms before the output is in place, so that no file of it can be
/// without an entry in a map.
///
/// Throws core::Error (BadInput) if nothing can be de-identified, (Refused) if the output lies
/// within the input or the reverse; OutputFileError, CancelledError.
DeidentificationResult
deidentify(const std::filesystem::path& input, const std::filesystem::path& output,
           const DeidentificationOptions& options, const PseudonymKey& key,
           const core::Progress& progress = {},
           const std::function<void(const std::vector<Pseudonym>&)>& keep = {});

/// Whether `cleanDescriptors` keeps this word: one of anatomy or of imaging.
bool isDescriptorWord(const std::string& word);

} // namespace petrous::library
