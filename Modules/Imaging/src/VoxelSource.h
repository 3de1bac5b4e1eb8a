#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Core/Progress.h"

#include "NrrdHeader.h"

namespace petrous::imaging
{

/// The types of a voxel's number that files hold.
enum class Component
{
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Float,
  Double
};

/// visitor(T{}) with the C++ type of a component.
template <class Visitor>
decltype(auto) visitComponent(Component component, Visitor&& visitor)
{
  switch (component)
  {
  case Component::Int8:
    return visitor(std::int8_t{});
  case Component::UInt8:
    return visitor(std::uint8_t{});
  case Component::Int16:
    return visitor(std::int16_t{});
  case Component::UInt16:
    return visitor(std::uint16_t{});
  case Component::Int32:
    return visitor(std::int32_t{});
  case Component::UInt32:
    return visitor(std::uint32_t{});
  case Component::Int64:
    return visitor(std::int64_t{});
  case Component::UInt64:
    return visitor(std::uint64_t{});
  case Component::Float:
    return visitor(float{});
  case Component::Double:
    break;
  }
  return visitor(double{});
}

/// A NIfTI, NRRD or MetaImage file whose header has been read and found sound: its dimensions
/// can be held by the file, its axes are perpendicular. ITK reads the voxels; no ITK text ever
/// reaches a message. Everything throws FileError.
class VoxelSource
{
public:
  explicit VoxelSource(const std::filesystem::path& path);
  ~VoxelSource();
  VoxelSource(const VoxelSource&) = delete;
  VoxelSource& operator=(const VoxelSource&) = delete;

  const core::GridGeometry& geometry() const noexcept { return *m_geometry; }
  Component component() const noexcept { return m_component; }
  /// Numbers a voxel: above 1 for vectors, colours, and the layers of a segmentation.
  std::size_t components() const noexcept { return m_components; }
  /// Whether whole numbers were turned into float by a rescale slope and intercept.
  bool rescaled() const noexcept { return m_rescaled; }
  const std::vector<std::string>& notes() const noexcept { return m_notes; }
  /// The text header of a NRRD; nothing for other formats.
  const std::optional<NrrdHeader>& nrrd() const noexcept { return m_nrrd; }

  /// The voxels of a box, numbers of a voxel side by side, first axis fastest. Reads no more than
  /// the box where the format allows it, and keeps no more.
  std::shared_ptr<void> read(const core::IndexBox& box, const core::Progress& progress) const;

private:
  struct Io;
  void openNifti();
  void openNrrd();
  void openMeta();
  void readItkHeader();
  void takeItkGeometry(double unit);
  void checkRoom() const;

  std::filesystem::path m_path;
  std::unique_ptr<Io> m_io;
  std::vector<std::uint64_t> m_dims;
  std::optional<core::GridGeometry> m_geometry;
  Component m_component = Component::Int16;
  std::size_t m_components = 1;
  bool m_rescaled = false;
  std::vector<std::string> m_notes;
  std::optional<NrrdHeader> m_nrrd;
  std::uintmax_t m_dataBytes = 0; ///< most bytes on disk that can hold the voxels
};

/// Values of `key = value` lines at the start of a MetaImage file, up to ElementDataFile.
std::vector<std::pair<std::string, std::string>> metaFields(const std::filesystem::path& path);

} // namespace petrous::imaging
