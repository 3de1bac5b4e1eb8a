#include "DicomDataSet.h"

#include <array>
#include <sstream>
#include <string_view>
#include <utility>

#include <gdcmDataSet.h>
#include <gdcmFile.h>
#include <gdcmSequenceOfItems.h>
#include <gdcmTransferSyntax.h>
#include <gdcmWriter.h>

#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"

namespace petrous::imaging
{

// At most 16 characters, the last possibly a space for even length.
std::string decimal(double value)
{
  if (value == 0.0)
    return "0"; // also for -0
  std::string text;
  for (int digits = 15; digits > 0; --digits)
    if (text = core::generalText(value, digits); text.size() <= 15)
      break;
  return text;
}

std::string decimals(std::initializer_list<double> values)
{
  std::string text;
  for (const double value : values)
    text += (text.empty() ? "" : "\\") + decimal(value);
  return text;
}

void put(gdcm::DataSet& data, std::uint16_t group, std::uint16_t element, const char* vr,
         std::string text)
{
  if (text.size() % 2 != 0)
    text += std::string_view(vr) == "UI" ? '\0' : ' ';
  gdcm::DataElement de(gdcm::Tag(group, element));
  de.SetVR(gdcm::VR::GetVRType(vr));
  de.SetByteValue(text.data(), static_cast<std::uint32_t>(text.size()));
  data.Replace(de);
}

void put(gdcm::DataSet& data, std::uint16_t group, std::uint16_t element, std::uint16_t value,
         const char* vr)
{
  gdcm::DataElement de(gdcm::Tag(group, element));
  de.SetVR(gdcm::VR::GetVRType(vr));
  const std::array<char, 2> bytes{static_cast<char>(value & 0xFF), static_cast<char>(value >> 8)};
  de.SetByteValue(bytes.data(), 2);
  data.Replace(de);
}

void put(gdcm::DataSet& data, const std::vector<TextElement>& elements)
{
  for (const TextElement& e : elements)
    put(data, e.group, e.element, e.vr, e.text);
}

void putBytes(gdcm::DataSet& data, std::uint16_t group, std::uint16_t element, const char* vr,
              const std::vector<char>& bytes)
{
  gdcm::DataElement de(gdcm::Tag(group, element));
  de.SetVR(gdcm::VR::GetVRType(vr));
  de.SetByteValue(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  data.Replace(de);
}

void putSequence(gdcm::DataSet& data, std::uint16_t group, std::uint16_t element,
                 const std::vector<gdcm::DataSet>& items)
{
  const gdcm::SmartPointer<gdcm::SequenceOfItems> sequence = new gdcm::SequenceOfItems;
  sequence->SetLengthToUndefined();
  for (const gdcm::DataSet& content : items)
  {
    gdcm::Item item;
    item.SetVLToUndefined();
    item.SetNestedDataSet(content);
    sequence->AddItem(item);
  }
  gdcm::DataElement de(gdcm::Tag(group, element));
  de.SetVR(gdcm::VR::SQ);
  de.SetValue(*sequence);
  de.SetVLToUndefined();
  data.Replace(de);
}

void putDeidentified(gdcm::DataSet& data)
{
  put(data, {{0x0012, 0x0062, "CS", "YES"},
             {0x0012, 0x0063, "LO", "written from voxels and geometry alone"}});
}

void putPixelFormat(gdcm::DataSet& data, const core::GridGeometry& grid, int bits, bool isSigned)
{
  // samples per pixel, rows, columns, bits allocated and stored, high bit, representation
  const std::pair<std::uint16_t, int> numbers[] = {
      {0x0002, 1},    {0x0010, grid.dims()[1]}, {0x0011, grid.dims()[0]},  {0x0100, bits},
      {0x0101, bits}, {0x0102, bits - 1},       {0x0103, isSigned ? 1 : 0}};
  for (const auto& [element, value] : numbers)
    put(data, 0x0028, element, static_cast<std::uint16_t>(value));
}

void checkUid(const std::string& uid, const char* what)
{
  if (uid.empty() || uid.size() > 64 || uid.find_first_not_of("0123456789.") != std::string::npos)
    throw core::InvalidParameter(std::string("DICOM: the ") + what +
                                 " is no UID (digits and dots, at most 64)");
}

std::string encoded(gdcm::Writer& writer, const std::filesystem::path& path)
{
  writer.GetFile().GetHeader().SetDataSetTransferSyntax(
      gdcm::TransferSyntax::ExplicitVRLittleEndian);
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  writer.SetStream(stream);
  if (!writer.Write())
    throw core::Error(core::Fault::Internal, path.string() + ": cannot be encoded");
  return stream.str();
}

} // namespace petrous::imaging
