#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Network/DicomNode.h"

namespace petrous::network
{

/// An archive of a case (`petrous archive`) as DICOM objects that a PACS keeps: Raw Data Storage
/// (PS3.3 A.37), in parts, so that neither side needs the whole in memory and a cut transfer goes
/// on with what is missing.
///
/// Each part holds in (7571,1010) of the private creator "PETROUS SCENE" a line of text
///
///     petrous-scene 1 PART PARTS OFFSET SIZE TOTAL SHA256\n
///
/// (format, number of the part from 1, number of parts, its place and size in bytes, size and
/// SHA-256 of the archive) followed by its bytes. As bytes, it survives servers that store private
/// elements without their VR.
constexpr std::uintmax_t kScenePartBytes = std::uintmax_t{32} << 20;

/// Series Description and Modality of such a series.
constexpr const char* kSceneDescription = "Petrous scene";
constexpr const char* kSceneModality = "OT";
/// Series Number of the first; by it and the modality it is known where a node does not answer the
/// description, which is an optional key (PS3.4 C.6.2.1.4).
constexpr int kFirstSceneNumber = 1000;

bool isScene(const Series& series);

/// The latest scene among the series, that of the highest number; end() if there is none.
std::vector<Series>::const_iterator latestScene(const std::vector<Series>& series);

/// The scenes among the series, the latest first.
std::vector<Series> scenesAmong(const std::vector<Series>& series);

/// None of them is a person's.
struct SceneDescription
{
  std::string patientId = "ANONYMOUS";
  std::string patientName = "Anonymous";
  std::string studyUid; ///< required
  std::string studyId = "1";
  int seriesNumber = kFirstSceneNumber; ///< the highest is the latest
};

/// Writes the parts into a folder, `scene-0001.dcm` onwards. Series and instance UIDs are derived
/// from the content: the same archive gives the same files. Throws core::InputFileError,
/// InvalidParameter, Error (Refused) if a file cannot be written, CancelledError.
std::vector<std::filesystem::path> writeSceneObjects(const std::filesystem::path& archive,
                                                     const std::filesystem::path& folder,
                                                     const SceneDescription& description,
                                                     const core::Progress& progress = {},
                                                     std::uintmax_t partBytes = kScenePartBytes);

/// Puts an archive together from the DICOM files of its series. Throws InvalidParameter if a file
/// is not such a part, if parts are missing or do not belong together, or if the result does not
/// have the size and SHA-256 that they state; nothing is written then. core::OutputFileError,
/// CancelledError.
void readSceneObjects(const std::vector<std::filesystem::path>& files,
                      const std::filesystem::path& archive, const core::Progress& progress = {});

} // namespace petrous::network
