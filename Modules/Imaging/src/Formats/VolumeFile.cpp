#include "petrous/Imaging/VolumeFile.h"

#include "FileHelpers.h"
#include "NiftiHeader.h"
#include "NrrdHeader.h"
#include "VoxelWriter.h"

namespace petrous::imaging
{

namespace
{

constexpr int kLargestNiftiDim = 32767; // dim is int16

/// As paddingIn reads it; empty without padding.
std::string paddingText(const std::optional<double>& padding)
{
  return padding ? kPaddingKey + ("=" + exactText(*padding)) : std::string();
}

std::string metaHeaderText(const core::GridGeometry& geometry, const VoxelType& type,
                           const std::string& comment, bool isHounsfield)
{
  const auto row = [](const Eigen::Vector3d& v)
  { return exactText(v[0]) + " " + exactText(v[1]) + " " + exactText(v[2]); };
  const auto& n = geometry.dims();
  const Eigen::Matrix3d& axes = geometry.direction();
  // TransformMatrix lists the axes consecutively, so its rows are our columns.
  return "ObjectType = Image\nNDims = 3\n" +
         (comment.empty() ? "" : "Comment = " + comment + "\n") +
         (isHounsfield ? std::string(kUnitKey) + " = " + kHounsfield + "\n" : std::string()) +
         "BinaryData = True\nBinaryDataByteOrderMSB = False\n"
         "CompressedData = False\nTransformMatrix = " +
         row(axes.col(0)) + " " + row(axes.col(1)) + " " + row(axes.col(2)) +
         "\nOffset = " + row(geometry.origin()) +
         "\nCenterOfRotation = 0 0 0\nAnatomicalOrientation = ???\nElementSpacing = " +
         row(geometry.spacing()) + "\nDimSize = " + std::to_string(n[0]) + " " +
         std::to_string(n[1]) + " " + std::to_string(n[2]) +
         "\nDistanceUnits = mm\nElementType = " + type.meta + "\nElementDataFile = LOCAL\n";
}

} // namespace

template <>
VoxelType voxelTypeOf<std::int16_t>()
{
  return {"short", "MET_SHORT", 4, 16};
}
template <>
VoxelType voxelTypeOf<std::uint16_t>()
{
  return {"unsigned short", "MET_USHORT", 512, 16};
}
template <>
VoxelType voxelTypeOf<std::uint8_t>()
{
  return {"unsigned char", "MET_UCHAR", 2, 8};
}
template <>
VoxelType voxelTypeOf<float>()
{
  return {"float", "MET_FLOAT", 16, 32};
}

namespace
{

std::string niftiHeader(const VoxelsToWrite& voxels)
{
  for (const int n : voxels.geometry.dims())
    if (n > kLargestNiftiDim)
      fail(FileError::Reason::Unsupported, voxels.path,
           "NIfTI holds at most 32767 voxels along an axis, not " + std::to_string(n) +
               "; write .nrrd");
  return niftiHeaderBytes(
      voxels.geometry, voxels.type.nifti, voxels.type.bits, paddingText(voxels.padding),
      voxels.isHounsfield ? std::string(kUnitKey) + "=" + kHounsfield : std::string());
}

} // namespace

void writeNifti(OutputFile& file, const VoxelsToWrite& voxels)
{
  file.write(niftiHeader(voxels));
  file.writeVoxels(voxels.voxels, voxels.bytes(), voxels.progress);
}

void writeNiftiGz(OutputFile& file, const VoxelsToWrite& voxels)
{
  file.writeCompressed(niftiHeader(voxels), voxels.voxels, voxels.bytes(), voxels.progress);
}

void writeMeta(OutputFile& file, const VoxelsToWrite& voxels)
{
  file.write(metaHeaderText(voxels.geometry, voxels.type, paddingText(voxels.padding),
                            voxels.isHounsfield));
  file.writeVoxels(voxels.voxels, voxels.bytes(), voxels.progress);
}

void writeNrrd(OutputFile& file, const VoxelsToWrite& voxels)
{
  file.write(nrrdHeaderText(voxels.geometry, voxels.type.nrrd, "gzip", voxels.layers) +
             voxels.nrrdKeys + "\n");
  file.writeCompressed("", voxels.voxels, voxels.bytes(), voxels.progress);
}

void writeVoxelFile(const std::filesystem::path& path, FileContent content,
                    const core::GridGeometry& geometry, const VoxelType& type, const void* voxels,
                    const std::string& nrrdKeys, const core::Progress& progress,
                    const std::optional<double>& padding, bool isHounsfield)
{
  const FileFormat& format = writingFormat(path, content);
  OutputFile file(path);
  format.writeVoxels(file,
                     {path, geometry, type, voxels, nrrdKeys, progress, 1, padding, isHounsfield});
  progress.check("writing voxels");
  file.commit();
}

template <class T>
void writeVolume(const std::filesystem::path& path, const volume::Volume<T>& volume,
                 const core::Progress& progress)
{
  writeVoxelFile(path, kImage, volume.geometry(), voxelTypeOf<T>(), volume.data(), {}, progress);
}

void writeVolume(const std::filesystem::path& path, const volume::IntensityVolume& volume,
                 const core::Progress& progress, bool isHounsfield)
{
  const std::string keys =
      (volume.padding() ? nrrdKeyText(kPaddingKey, exactText(*volume.padding())) : "") +
      (isHounsfield ? nrrdKeyText(kUnitKey, kHounsfield) : "");
  volume.visit(
      [&](const auto& voxels)
      {
        using T = typename std::decay_t<decltype(voxels)>::Value;
        writeVoxelFile(path, kImage, voxels.geometry(), voxelTypeOf<T>(), voxels.data(), keys,
                       progress, volume.padding(), isHounsfield);
      });
}

template void writeVolume(const std::filesystem::path&, const volume::Volume<std::int16_t>&,
                          const core::Progress&);
template void writeVolume(const std::filesystem::path&, const volume::Volume<std::uint16_t>&,
                          const core::Progress&);
template void writeVolume(const std::filesystem::path&, const volume::Volume<std::uint8_t>&,
                          const core::Progress&);
template void writeVolume(const std::filesystem::path&, const volume::Volume<float>&,
                          const core::Progress&);

} // namespace petrous::imaging
