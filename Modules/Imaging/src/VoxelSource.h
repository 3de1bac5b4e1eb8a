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

#include "ItkReader.h"
#include "NrrdHeader.h"

namespace petrous::imaging
{

/// A NIfTI, NRRD or MetaImage file whose header has been read and found sound: its dimensions
/// can be held by the file, its axes are perpendicular. ITK reads the voxels; no ITK text ever
/// reaches a message. Everything throws FileError.
class VoxelSource
{
public:
  explicit VoxelSource(const std::filesystem::path& path);

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
  void openNifti();
  void openNrrd();
  void openMeta();
  void readItkHeader(ItkReader::Format format);
  void takeItkGeometry(double unit);
  void checkRoom() const;

  std::filesystem::path m_path;
  std::unique_ptr<ItkReader> m_reader;
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
