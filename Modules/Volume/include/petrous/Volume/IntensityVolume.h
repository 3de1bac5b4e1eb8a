#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <variant>

#include "petrous/Volume/Volume.h"

namespace petrous::volume
{

struct ValueRange
{
  double min = 0.0;
  double max = 0.0;
};

/// A CT (Hounsfield units) or MR (arbitrary units) image in the data type of its file.
///
/// Values are in modality units: rescale slope and intercept have been applied. Voxels equal to
/// `padding` are outside the scanned field: they keep their value but are excluded from ranges.
class IntensityVolume
{
public:
  using Voxels = std::variant<std::shared_ptr<const Volume<std::int16_t>>,
                              std::shared_ptr<const Volume<std::uint16_t>>,
                              std::shared_ptr<const Volume<float>>>;

  /// Throws InvalidParameter if the pointer is null.
  explicit IntensityVolume(Voxels voxels, std::optional<double> padding = std::nullopt);

  const Voxels& voxels() const noexcept { return m_voxels; }
  std::optional<double> padding() const noexcept { return m_padding; }
  const core::GridGeometry& geometry() const noexcept;
  std::size_t bytes() const noexcept;

  /// Minimum and maximum value without padding, NaN and infinities; both 0 if nothing remains.
  /// Reads every voxel.
  ValueRange range() const;

  /// visit([](const auto& volume) { ... }) with the Volume<T> inside.
  template <class Visitor>
  decltype(auto) visit(Visitor&& visitor) const
  {
    return std::visit(
        [&visitor](const auto& pointer) -> decltype(auto) { return visitor(*pointer); }, m_voxels);
  }

  double at(int i, int j, int k) const;

  /// Trilinear, at a continuous voxel position.
  double sample(const Eigen::Vector3d& voxel) const;

private:
  Voxels m_voxels;
  std::optional<double> m_padding;
};

} // namespace petrous::volume
