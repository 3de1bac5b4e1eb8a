#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

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

/// ITK's reader of one file, behind a wall: ITK 5.2 brings an Eigen of its own, which must not
/// meet ours in one source. Failures are told by false, as ITK's texts may quote the file.
class ItkReader
{
public:
  enum class Format
  {
    Nrrd,
    Nifti, ///< for comparison only: ITK accepts NIfTI and MetaImage files that break off
    Meta   ///< the same
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
