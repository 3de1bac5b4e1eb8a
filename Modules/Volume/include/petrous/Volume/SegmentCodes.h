#pragma once

#include <string>

namespace petrous::volume
{

/// A coded concept (DICOM PS3.3 Table 8.8-1a), e.g. 123037004, SCT, "Anatomical Structure".
struct CodedConcept
{
  std::string value;
  std::string scheme;
  std::string meaning;

  bool empty() const noexcept { return value.empty(); }
  bool operator==(const CodedConcept& other) const
  {
    return value == other.value && scheme == other.scheme && meaning == other.meaning;
  }
};

/// What a segment is and how it was made, as a DICOM segmentation (PS3.3 C.8.20.2) or 3D Slicer's
/// terminology says; what is not said is empty.
struct SegmentCodes
{
  enum class Algorithm
  {
    Unknown,
    Manual,
    SemiAutomatic,
    Automatic
  };

  CodedConcept category;     ///< Segmented Property Category, CID 7150
  CodedConcept type;         ///< Segmented Property Type
  CodedConcept typeModifier; ///< e.g. left
  CodedConcept region;       ///< Anatomic Region
  CodedConcept regionModifier;
  Algorithm algorithm = Algorithm::Unknown;
  std::string algorithmName; ///< may be empty

  bool empty() const { return *this == SegmentCodes(); }
  bool operator==(const SegmentCodes& other) const
  {
    return category == other.category && type == other.type && typeModifier == other.typeModifier &&
           region == other.region && regionModifier == other.regionModifier &&
           algorithm == other.algorithm && algorithmName == other.algorithmName;
  }
};

} // namespace petrous::volume
