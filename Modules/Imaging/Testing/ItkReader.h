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

/// ITK's reader of one file, as reference, isolated in its own source: ITK 5.2 includes its own
/// Eigen, which must not meet ours in one translation unit.
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

  /// Must be called first; the other members are valid if it returns true.
  bool readHeader();

  const std::vector<std::uint64_t>& dims() const noexcept ///< as stored in the file
  {
    return m_dims;
  }
  std::size_t components() const;             ///< numbers per voxel
  std::optional<Component> component() const; ///< nullopt for an unsupported type

  /// As returned by ITK, LPS, for axes 0 to 2.
  std::array<double, 3> axis(unsigned index) const;
  double spacing(unsigned index) const;
  double origin(unsigned index) const;

  /// The voxels of the box, further axes 1 long. Only MetaImage supports reading part of a file.
  bool read(const std::array<int, 3>& lower, const std::array<int, 3>& size, void* memory);

private:
  struct Io;
  std::filesystem::path m_path;
  std::unique_ptr<Io> m_io;
  std::vector<std::uint64_t> m_dims;
};

} // namespace petrous::imaging
