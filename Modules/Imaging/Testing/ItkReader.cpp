#include "ItkReader.h"

#include <exception>
#include <locale>

#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include "FileHelpers.h"

namespace petrous::imaging
{

namespace
{

std::optional<Component> componentOf(itk::IOComponentEnum type)
{
  const auto integer = [](std::size_t bytes, bool isSigned)
  {
    return bytes == 4 ? (isSigned ? Component::Int32 : Component::UInt32)
                      : (isSigned ? Component::Int64 : Component::UInt64);
  };
  switch (type)
  {
  case itk::IOComponentEnum::CHAR:
    return Component::Int8;
  case itk::IOComponentEnum::UCHAR:
    return Component::UInt8;
  case itk::IOComponentEnum::SHORT:
    return Component::Int16;
  case itk::IOComponentEnum::USHORT:
    return Component::UInt16;
  case itk::IOComponentEnum::INT:
    return integer(sizeof(int), true);
  case itk::IOComponentEnum::UINT:
    return integer(sizeof(unsigned), false);
  case itk::IOComponentEnum::LONG:
    return integer(sizeof(long), true);
  case itk::IOComponentEnum::ULONG:
    return integer(sizeof(unsigned long), false);
  case itk::IOComponentEnum::LONGLONG:
    return Component::Int64;
  case itk::IOComponentEnum::ULONGLONG:
    return Component::UInt64;
  case itk::IOComponentEnum::FLOAT:
    return Component::Float;
  case itk::IOComponentEnum::DOUBLE:
    return Component::Double;
  default:
    return std::nullopt;
  }
}

// During its lifetime, newly created streams have a decimal point and no grouping: MetaIO relies on
// it, and streams use the global std::locale, which cannot be set per thread. Does nothing if this
// already holds.
class PlainStreams
{
public:
  PlainStreams()
  {
    const auto& numbers = std::use_facet<std::numpunct<char>>(m_before);
    m_changed = numbers.decimal_point() != '.' || !numbers.grouping().empty();
    if (m_changed) // unnamed: leaves the C library's locale unchanged
      std::locale::global(std::locale(m_before, new std::numpunct<char>));
  }
  ~PlainStreams()
  {
    if (m_changed)
      std::locale::global(m_before);
  }
  PlainStreams(const PlainStreams&) = delete;
  PlainStreams& operator=(const PlainStreams&) = delete;

private:
  std::locale m_before;
  bool m_changed = false;
};

} // namespace

struct ItkReader::Io
{
  itk::ImageIOBase::Pointer reader;
};

ItkReader::ItkReader(const std::filesystem::path& path, Format format)
  : m_path(path)
  , m_io(std::make_unique<Io>())
{
  switch (format)
  {
  case Format::Nifti:
    m_io->reader = itk::NiftiImageIO::New();
    break;
  case Format::Nrrd:
    m_io->reader = itk::NrrdImageIO::New();
    break;
  case Format::Meta:
    m_io->reader = itk::MetaImageIO::New();
    break;
  }
}

ItkReader::~ItkReader() = default;

bool ItkReader::readHeader()
{
  const PlainNumbers plain;
  const PlainStreams streams;
  itk::ImageIOBase& reader = *m_io->reader;
  try
  {
    reader.SetFileName(m_path.string());
    reader.ReadImageInformation();
  }
  catch (const std::exception&)
  {
    return false;
  }
  m_dims.clear();
  for (unsigned d = 0; d < reader.GetNumberOfDimensions(); ++d)
    m_dims.push_back(reader.GetDimensions(d));
  return true;
}

std::size_t ItkReader::components() const
{
  return m_io->reader->GetNumberOfComponents();
}

std::optional<Component> ItkReader::component() const
{
  return componentOf(m_io->reader->GetComponentType());
}

std::array<double, 3> ItkReader::axis(unsigned index) const
{
  const std::vector<double> axis = m_io->reader->GetDirection(index);
  return {axis[0], axis[1], axis[2]};
}

double ItkReader::spacing(unsigned index) const
{
  return m_io->reader->GetSpacing(index);
}

double ItkReader::origin(unsigned index) const
{
  return m_io->reader->GetOrigin(index);
}

bool ItkReader::read(const std::array<int, 3>& lower, const std::array<int, 3>& size, void* memory)
{
  const PlainNumbers plain;
  const PlainStreams streams;
  itk::ImageIORegion region(static_cast<unsigned>(m_dims.size()));
  for (unsigned a = 0; a < m_dims.size(); ++a)
  {
    region.SetIndex(a, a < 3 ? lower[a] : 0);
    region.SetSize(a, a < 3 ? static_cast<itk::SizeValueType>(size[a]) : 1);
  }
  try
  {
    m_io->reader->SetIORegion(region);
    m_io->reader->Read(memory);
  }
  catch (const std::exception&)
  {
    return false;
  }
  return true;
}

} // namespace petrous::imaging
