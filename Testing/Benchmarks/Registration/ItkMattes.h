#pragma once

#include <array>
#include <string>

/// ITK's part of the peer, without a type of Eigen: ITK brings a copy of Eigen of its own, and one
/// source cannot see both.
namespace petrous::registration::itkpeer
{

struct Image
{
  std::array<int, 3> dims;
  std::array<double, 3> spacing, origin;
  std::array<double, 9> direction; ///< row-major, columns are the axes
  float* voxels;
};

/// Row-major 3x4, fixed physical point -> moving. False where ITK threw.
bool register3d(const Image& fixed, const Image& moving, const std::array<double, 3>& center,
                std::array<double, 12>& matrix);

std::string version();

} // namespace petrous::registration::itkpeer
