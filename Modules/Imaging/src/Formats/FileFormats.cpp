#include "petrous/Imaging/FileFormats.h"

#include <algorithm>
#include <memory>

#include <itk_zlib.h>

#include "FileHelpers.h"
#include "MeshReaders.h"
#include "VoxelSource.h"
#include "VoxelWriter.h"

namespace petrous::imaging
{

namespace
{

constexpr std::size_t kStart = 512; // bytes by which a format is recognised

template <std::size_t size>
bool startsWith(std::string_view bytes, const char (&mark)[size])
{
  return bytes.substr(0, size - 1) == std::string_view(mark, size - 1);
}

bool startsNrrd(std::string_view bytes)
{
  return startsWith(bytes, "NRRD000");
}

bool startsNifti(std::string_view bytes)
{
  return bytes.size() >= 348 && (bytes.substr(344, 4) == std::string_view("n+1\0", 4) ||
                                 bytes.substr(4, 4) == std::string_view("n+2\0", 4));
}

bool startsNiftiPair(std::string_view bytes)
{
  return bytes.size() >= 348 && (bytes.substr(344, 4) == std::string_view("ni1\0", 4) ||
                                 bytes.substr(4, 4) == std::string_view("ni2\0", 4));
}

bool startsMeta(std::string_view bytes)
{
  const std::string_view key = trimmed(bytes.substr(0, bytes.find('=')));
  return key == "ObjectType" || key == "NDims";
}

bool startsDicom(std::string_view bytes)
{
  return bytes.size() >= 132 && bytes.substr(128, 4) == "DICM";
}

bool startsStl(std::string_view bytes) // as text; the binary form has no mark
{
  return startsWith(bytes, "solid ") && bytes.find('\0') == bytes.npos;
}

bool startsPly(std::string_view bytes)
{
  return takeLine(bytes) == "ply";
}

bool startsVtp(std::string_view bytes)
{
  constexpr std::size_t kWithin = 1024;
  return bytes.substr(0, kWithin).find("<VTKFile") != bytes.npos;
}

constexpr unsigned kVoxels = kImage | kLabels;

using Source = VoxelSource;

// In the order of lists for the user. 3D Slicer's segmentations name their structures.
constexpr FileFormat kFormats[] = {
    {"NRRD", ".seg.nrrd", kLabels, kLabels, startsNrrd, &Source::openNrrd, writeNrrd, {}, {}},
    {"NRRD", ".seg.nhdr", kLabels, 0, startsNrrd, &Source::openNrrd, {}, {}, {}},
    {"NRRD", ".nrrd", kVoxels, kVoxels, startsNrrd, &Source::openNrrd, writeNrrd, {}, {}},
    {"NRRD", ".nhdr", kVoxels, 0, startsNrrd, &Source::openNrrd, {}, {}, {}},
    {"NIfTI", ".nii.gz", kVoxels, kVoxels, startsNifti, &Source::openNifti, writeNiftiGz, {}, {}},
    {"NIfTI", ".nii", kVoxels, kVoxels, startsNifti, &Source::openNifti, writeNifti, {}, {}},
    {"NIfTI", ".hdr", kVoxels, 0, startsNiftiPair, &Source::openNifti, {}, {}, {}},
    {"NIfTI", ".img", kVoxels, 0, {}, &Source::openNifti, {}, {}, {}},
    {"MetaImage", ".mha", kVoxels, kImage, startsMeta, &Source::openMeta, writeMeta, {}, {}},
    {"MetaImage", ".mhd", kVoxels, 0, startsMeta, &Source::openMeta, {}, {}, {}},
    {"DICOM", ".dcm", kDicom, kSegmentation, startsDicom, {}, {}, {}, {}},
    {"OBJ", ".obj", kMesh, kMesh, {}, {}, {}, parseObj, objText},
    {"STL", ".stl", kMesh, kMesh, startsStl, {}, {}, parseStl, stlBytes},
    {"PLY", ".ply", kMesh, kMesh, startsPly, {}, {}, parsePly, plyBytes},
    {"VTP", ".vtp", kMesh, 0, startsVtp, {}, {}, parseVtp, {}},
};

bool isPacked(const FileFormat& format)
{
  return endsWith(format.ending, ".gz");
}

} // namespace

const FileFormat* formatOf(const std::filesystem::path& path)
{
  const std::string name = lowerName(path);
  const FileFormat* best = nullptr;
  for (const FileFormat& format : kFormats)
    if (endsWith(name, format.ending) && (!best || format.ending.size() > best->ending.size()))
      best = &format;
  return best;
}

bool isReadAs(const std::filesystem::path& path, unsigned contents)
{
  const FileFormat* format = formatOf(path);
  return format && (format->reads & contents) != 0;
}

const FileFormat* recognisedFormat(const std::filesystem::path& path)
{
  std::string bytes(kStart, '\0');
  bool packed = false;
  try
  {
    packed = readBytes(path, 2) == "\x1f\x8b";
  }
  catch (const FileError&)
  {
    return nullptr;
  }
  // Reads what is not compressed as it is.
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), gzclose);
  const int got = file ? gzread(file.get(), bytes.data(), static_cast<unsigned>(kStart)) : -1;
  bytes.resize(static_cast<std::size_t>(std::max(got, 0)));
  const FileFormat* plainest = nullptr;
  for (const FileFormat& format : kFormats)
    if (format.starts && isPacked(format) == packed && format.starts(bytes) &&
        (!plainest || format.ending.size() < plainest->ending.size()))
      plainest = &format;
  return plainest;
}

void failFormat(const std::filesystem::path& path, std::string_view expected)
{
  const FileFormat* found = recognisedFormat(path);
  fail(FileError::Reason::UnknownFormat, path,
       "is named as " + std::string(expected) + ", but is not; " +
           (found ? "it is " + std::string(found->name) + ", so end its name in " +
                        std::string(found->ending)
                  : "give it the name of the format it is in"));
}

void checkFormat(const std::filesystem::path& path, std::string_view expected)
{
  const FileFormat* found = recognisedFormat(path);
  if (found && found->name != expected)
    failFormat(path, expected);
}

std::vector<std::string_view> readEndings(unsigned contents)
{
  std::vector<std::string_view> endings;
  for (const FileFormat& format : kFormats)
    if ((format.reads & contents) != 0)
      endings.push_back(format.ending);
  const std::vector<std::string_view> all = endings;
  endings.erase(std::remove_if(endings.begin(), endings.end(),
                               [&all](std::string_view ending)
                               {
                                 return std::any_of(all.begin(), all.end(),
                                                    [ending](std::string_view other) {
                                                      return other != ending &&
                                                             endsWith(ending, other);
                                                    });
                               }),
                endings.end());
  return endings;
}

std::vector<std::string_view> writtenEndings(unsigned contents)
{
  std::vector<std::string_view> endings;
  for (const FileFormat& format : kFormats)
    if ((format.writes & contents) != 0)
      endings.push_back(format.ending);
  return endings;
}

std::string orText(const std::vector<std::string_view>& endings)
{
  std::string text;
  for (std::size_t n = 0; n < endings.size(); ++n)
    text += (n == 0 ? "" : n + 1 == endings.size() ? " or " : ", ") + std::string(endings[n]);
  return text;
}

const FileFormat& writingFormat(const std::filesystem::path& path, unsigned content)
{
  const FileFormat* format = formatOf(path);
  if (!format || (format->writes & content) == 0)
    fail(FileError::Reason::UnknownFormat, path,
         "cannot be written under this name; end it in " + orText(writtenEndings(content)));
  return *format;
}

std::string baseName(const std::filesystem::path& path)
{
  const std::string name = path.filename().string();
  const FileFormat* format = formatOf(path);
  return format && name.size() > format->ending.size()
             ? name.substr(0, name.size() - format->ending.size())
             : path.stem().string();
}

} // namespace petrous::imaging
