#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace gdcm
{
class DataSet;
class Writer;
} // namespace gdcm

namespace petrous::imaging
{

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

/// Throws InvalidParameter for what is no UID; `what` names it ("study's UID").
void checkUid(const std::string& uid, const char* what);

/// The whole file in explicit VR little endian. Made in memory, as GDCM aborts the program on a
/// full disk. Throws Error (Internal) naming `path`.
std::string encoded(gdcm::Writer& writer, const std::filesystem::path& path);

} // namespace petrous::imaging
