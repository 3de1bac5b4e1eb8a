#include "petrous/Rendering/Picture.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include "petrous/Core/OutputFile.h"
#include "petrous/Rendering/RenderingError.h"

namespace petrous::rendering
{

namespace
{

[[noreturn]] void failWriting(const std::filesystem::path& file, const std::string& why)
{
  throw RenderingError(RenderingError::Reason::CannotWrite,
                       file.string() + ": cannot be written: " + why);
}

void checkSize(const std::filesystem::path& file, int width, int height, std::size_t values,
               std::size_t perPixel)
{
  if (width < 1 || height < 1 ||
      values != perPixel * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    throw RenderingError(RenderingError::Reason::BadSize,
                         file.string() + ": a picture of " + std::to_string(width) + " x " +
                             std::to_string(height) + " pixels with " + std::to_string(values) +
                             " values cannot be written");
}

void writeWhole(const std::filesystem::path& file, const void* bytes, std::size_t count)
{
  try
  {
    core::writeFile(file, {static_cast<const char*>(bytes), count});
  }
  catch (const core::OutputFileError& error)
  {
    throw RenderingError(RenderingError::Reason::CannotWrite, error.what());
  }
}

} // namespace

std::size_t countDifferentPixels(const Picture& a, const Picture& b)
{
  const auto pixels = [](const Picture& p)
  { return static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height); };
  if (a.width != b.width || a.height != b.height || a.rgb.size() != b.rgb.size())
    return std::max(pixels(a), pixels(b));
  std::size_t different = 0;
  for (std::size_t i = 0; i + 2 < a.rgb.size(); i += 3)
    if (std::memcmp(&a.rgb[i], &b.rgb[i], 3) != 0)
      ++different;
  return different;
}

std::vector<std::uint8_t> pngOf(const Picture& picture)
{
  checkSize("PNG", picture.width, picture.height, picture.rgb.size(), 3);
  vtkNew<vtkImageData> image;
  image->SetDimensions(picture.width, picture.height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const std::size_t row = 3 * static_cast<std::size_t>(picture.width);
  for (int y = 0; y < picture.height; ++y) // VTK stores rows bottom up
    std::memcpy(image->GetScalarPointer(0, picture.height - 1 - y, 0), picture.pixel(0, y), row);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* png = writer->GetResult();
  if (!png)
    return {};
  return {png->GetPointer(0), png->GetPointer(0) + png->GetNumberOfValues()};
}

void writePng(const std::filesystem::path& file, const Picture& picture)
{
  checkSize(file, picture.width, picture.height, picture.rgb.size(), 3);
  const std::vector<std::uint8_t> png = pngOf(picture);
  if (png.empty())
    failWriting(file, "the picture could not be encoded");
  writeWhole(file, png.data(), png.size());
}

void writeNpy(const std::filesystem::path& file, const DepthImage& depth)
{
  checkSize(file, depth.width, depth.height, depth.millimetres.size(), 1);
  static_assert(sizeof(float) == 4);
  // Magic number, version 1.0 and header length (2 bytes), padded so that the data start at a
  // multiple of 64 bytes [numpy.lib.format].
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" +
                       std::to_string(depth.height) + ", " + std::to_string(depth.width) + "), }";
  constexpr std::size_t preamble = 10;
  header.append(63 - (preamble + header.size()) % 64, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xff);
  bytes += static_cast<char>(header.size() >> 8);
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(depth.millimetres.data()), // x86, ARM: little-endian
               depth.millimetres.size() * sizeof(float));
  writeWhole(file, bytes.data(), bytes.size());
}

} // namespace petrous::rendering
