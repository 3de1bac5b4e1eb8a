#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "ConfidentialityProfile.h"
#include "petrous/Library/Deidentification.h"

namespace petrous::library
{

class FaceSlices;

/// De-identifies one DICOM file after the other, and counts what was done to each attribute.
class DicomCleaner
{
public:
  struct Outcome
  {
    std::string leftOut; ///< why nothing was written; empty: written
    bool isDicom = true;
  };
  /// Where a file of this new Series Instance UID and modality is written.
  using Placement =
      std::function<std::filesystem::path(const std::string& series, const std::string& modality)>;

  DicomCleaner(const DeidentificationOptions& options, const PseudonymKey& key);

  /// Throws OutputFileError.
  Outcome clean(const std::filesystem::path& input, const Placement& placed);

  struct Done
  {
    std::string name, action;
    bool stays = false;
    std::size_t files = 0;
  };
  std::map<std::pair<std::string, std::string>, Done> done; ///< by path and action
  std::map<std::string, std::size_t> warnings;
  std::map<std::string, Pseudonym> pseudonyms; ///< by kind and pseudonym
  ConfidentialityProfile profile;
  std::shared_ptr<const FaceSlices> faces; ///< for DeidentificationOptions::maskFace

private:
  struct Person
  {
    std::string name, birthDate;
    bool differs(const Person& other) const; ///< both state it, and not the same
  };

  std::map<std::string, Person> m_people;         ///< the first by pseudonym
  std::map<std::string, std::string> m_patientOf; ///< the first pseudonym by the new series UID
  DeidentificationOptions m_options;
  const PseudonymKey& m_key;
};

} // namespace petrous::library
