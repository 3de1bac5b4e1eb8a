#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "Component.h"

namespace petrous::imaging
{

/// ITK's reader of one file, to compare with, behind a wall: ITK 5.2 brings an Eigen of its own,
/// which must not meet ours in one source.
class ItkReader
{
public:
  enum class Format
  {
    Nrrd,
    Nifti,
    Meta
  };

  ItkReader(const std::filesystem::path& path, Format format);
  ~ItkReader();
  ItkReader(const ItkReader&) = delete;
  ItkReader& operator=(const ItkReader&) = delete;

  /// Must come first; what follows is valid where it returns true.
  bool readHeader();

  const std::vector<std::uint64_t>& dims() const noexcept ///< as many as the file counts
  {
    return m_dims;
  }
  std::size_t components() const;             ///< numbers a voxel
  std::optional<Component> component() const; ///< nothing for a type that is not read

  /// As ITK gives them, LPS, for axes 0 to 2.
  std::array<double, 3> axis(unsigned index) const;
  double spacing(unsigned index) const;
  double origin(unsigned index) const;

  /// The voxels of the box, further axes 1 long. Only MetaImage reads less than the whole file.
  bool read(const std::array<int, 3>& lower, const std::array<int, 3>& size, void* memory);

private:
  struct Io;
  std::filesystem::path m_path;
  std::unique_ptr<Io> m_io;
  std::vector<std::uint64_t> m_dims;
};

} // namespace petrous::imaging
