#include "petrous/Imaging/VolumeFile.h"

#include "FileHelpers.h"
#include "NiftiHeader.h"
#include "NrrdHeader.h"
#include "OutputFile.h"
#include "VoxelWriter.h"

namespace petrous::imaging
{

namespace
{

constexpr int kLargestNiftiDim = 32767; // dim is int16

std::string metaHeaderText(const core::GridGeometry& geometry, const VoxelType& type)
{
  const auto row = [](const Eigen::Vector3d& v)
  { return exactText(v[0]) + " " + exactText(v[1]) + " " + exactText(v[2]); };
  const auto& n = geometry.dims();
  const Eigen::Matrix3d& axes = geometry.direction();
  // TransformMatrix lists the axes consecutively, so its rows are our columns.
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
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

void writeVoxelFile(const std::filesystem::path& path, const core::GridGeometry& geometry,
                    const VoxelType& type, const void* voxels, const std::string& nrrdKeys,
                    const core::Progress& progress)
{
  const std::string name = lowerName(path);
  const std::size_t bytes = geometry.voxelCount() * static_cast<std::size_t>(type.bits / 8);
  const bool nifti = endsWith(name, ".nii") || endsWith(name, ".nii.gz");
  if (!nifti && !endsWith(name, ".nrrd") && !endsWith(name, ".mha"))
    fail(FileError::Reason::UnknownFormat, path,
         "cannot be written under this name; end it in .nrrd, .nii.gz, .nii or .mha");
  if (nifti)
    for (const int n : geometry.dims())
      if (n > kLargestNiftiDim)
        fail(FileError::Reason::Unsupported, path,
             "NIfTI holds at most 32767 voxels along an axis, not " + std::to_string(n) +
                 "; write .nrrd");
  OutputFile file(path);
  if (nifti)
  {
    const std::string header = niftiHeaderBytes(geometry, type.nifti, type.bits);
    if (endsWith(name, ".gz"))
      file.writeCompressed(header, voxels, bytes, progress);
    else
    {
      file.write(header);
      file.writeVoxels(voxels, bytes, progress);
    }
  }
  else if (endsWith(name, ".mha"))
  {
    file.write(metaHeaderText(geometry, type));
    file.writeVoxels(voxels, bytes, progress);
  }
  else
  {
    file.write(nrrdHeaderText(geometry, type.nrrd, "gzip") + nrrdKeys + "\n");
    file.writeCompressed("", voxels, bytes, progress);
  }
  progress.check("writing voxels");
  file.commit();
}

template <class T>
void writeVolume(const std::filesystem::path& path, const volume::Volume<T>& volume,
                 const core::Progress& progress)
{
  writeVoxelFile(path, volume.geometry(), voxelTypeOf<T>(), volume.data(), {}, progress);
}

void writeVolume(const std::filesystem::path& path, const volume::IntensityVolume& volume,
                 const core::Progress& progress)
{
  const std::string keys =
      volume.padding() ? nrrdKeyText("petrous_padding", exactText(*volume.padding())) : "";
  volume.visit(
      [&](const auto& voxels)
      {
        using T = typename std::decay_t<decltype(voxels)>::Value;
        writeVoxelFile(path, voxels.geometry(), voxelTypeOf<T>(), voxels.data(), keys, progress);
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
