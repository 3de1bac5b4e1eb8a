#pragma once

#include <cstdint>
#include <string>

namespace petrous::imaging
{

/// Patient ID (0010,0020) that stands in DICOM objects for the patient of a case: "PETROUS-" and
/// 16 hexadecimal digits. It names nobody: patientKey() takes it as no ID, which an ID of a
/// hospital would contradict. Where no name is stated either, it is the only one of the key's
/// nameParts: two that differ are of two cases, and nothing says that these are of one patient.
std::string casePatientId(std::uint64_t hash);
bool isCasePatientId(const std::string& id);
constexpr const char* kCasePatientIds = "PETROUS-*"; ///< all of them, for a query

/// Family name (0010,0010) in such objects; the given name is the case's, or the ID.
constexpr const char* kCaseFamilyName = "Petrous";

} // namespace petrous::imaging
