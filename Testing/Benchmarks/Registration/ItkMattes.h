#pragma once

#include <array>
#include <string>

/// ITK part of the peer, without Eigen types: ITK bundles its own copy of Eigen, and one source
/// file cannot include both.
namespace petrous::registration::itkpeer
{

struct Image
{
  std::array<int, 3> dims;
  std::array<double, 3> spacing, origin;
  std::array<double, 9> direction; ///< row-major, columns are the axes
  float* voxels;
};

/// Row-major 3x4, fixed physical point -> moving. False if ITK threw.
bool register3d(const Image& fixed, const Image& moving, const std::array<double, 3>& center,
                std::array<double, 12>& matrix);

std::string version();

} // namespace petrous::registration::itkpeer
