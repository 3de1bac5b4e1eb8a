#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "petrous/Core/GridGeometry.h"

namespace gdcm
{
class DataSet;
class Writer;
} // namespace gdcm

namespace petrous::imaging
{

/// Manufacturer (0008,0070) of the files that are written.
constexpr const char* kManufacturer = "Petrous";

// Elements of DICOM files that are written; `vr` is the value representation ("UI").

/// A decimal string (DS): as many digits as its 16 characters hold.
std::string decimal(double value);
/// Several, separated by backslashes.
std::string decimals(std::initializer_list<double> values);

/// Adds an element with a text value, padded to even length as required by its VR.
void put(gdcm::DataSet& data, std::uint16_t group, std::uint16_t element, const char* vr,
         std::string text);

/// Adds an element with a value of 16 bits.
void put(gdcm::DataSet& data, std::uint16_t group, std::uint16_t element, std::uint16_t value,
         const char* vr = "US");

struct TextElement
{
  std::uint16_t group, element;
  const char* vr;
  std::string text;
};
void put(gdcm::DataSet& data, const std::vector<TextElement>& elements);

/// Adds an element with the bytes of its value as they are.
void putBytes(gdcm::DataSet& data, std::uint16_t group, std::uint16_t element, const char* vr,
              const std::vector<char>& bytes);

/// Adds a sequence of these items.
void putSequence(gdcm::DataSet& data, std::uint16_t group, std::uint16_t element,
                 const std::vector<gdcm::DataSet>& items);

/// Patient, study, series, frame of reference and equipment of a SeriesDescription or a
/// SegmentationDescription; no date or physician is known.
template <class Description>
void putIdentification(gdcm::DataSet& data, const Description& of)
{
  put(data, {{0x0008, 0x0050, "SH", ""},
             {0x0008, 0x0070, "LO", kManufacturer},
             {0x0008, 0x0090, "PN", ""},
             {0x0010, 0x0010, "PN", of.patientName},
             {0x0010, 0x0020, "LO", of.patientId},
             {0x0010, 0x0030, "DA", ""},
             {0x0010, 0x0040, "CS", ""},
             {0x0018, 0x1020, "LO", "1"},
             {0x0020, 0x000D, "UI", of.studyUid},
             {0x0020, 0x000E, "UI", of.seriesUid},
             {0x0020, 0x0010, "SH", of.studyId},
             {0x0020, 0x0011, "IS", std::to_string(of.seriesNumber)},
             {0x0020, 0x0052, "UI", of.frameOfReferenceUid},
             {0x0020, 0x1040, "LO", ""},
             {0x0028, 0x0004, "CS", "MONOCHROME2"}});
}

/// Patient Identity Removed, and how.
void putDeidentified(gdcm::DataSet& data);

/// Rows, columns and how a pixel is stored: one sample of `bits` bits.
void putPixelFormat(gdcm::DataSet& data, const core::GridGeometry& grid, int bits, bool isSigned);

/// Throws InvalidParameter for what is no UID; `what` names it ("study's UID").
void checkUid(const std::string& uid, const char* what);

/// The whole file in explicit VR little endian. Made in memory, as GDCM aborts the program on a
/// full disk. Throws Error (Internal) naming `path`.
std::string encoded(gdcm::Writer& writer, const std::filesystem::path& path);

} // namespace petrous::imaging
