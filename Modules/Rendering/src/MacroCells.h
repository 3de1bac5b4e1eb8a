#pragma once

#include <cstdint>
#include <vector>

#include <vtkSmartPointer.h>

#include "petrous/Volume/CutMask.h"
#include "petrous/Volume/IntensityVolume.h"

class vtkImageData;

namespace petrous::rendering
{

/// Which blocks of 8^3 voxels may hold tissue, and how far away the nearest of them is, so that
/// rays leap over air.
class MacroCells
{
public:
  static constexpr int kEdge = 8;

  /// Reads every voxel once.
  explicit MacroCells(const volume::IntensityVolume& ct);

  /// Fills `distances` for a threshold and a mask (null: nothing cut).
  void update(double iso, const volume::CutMask* mask);

  /// Chebyshev distance in cells, 8 bits; Modified() by every update.
  vtkImageData* distances() const;
  std::size_t bytes() const;

private:
  core::GridGeometry m_grid;
  core::Index3 m_dims;
  std::vector<float> m_max; // of CT, over the voxels that interpolation in the cell can reach
  vtkSmartPointer<vtkImageData> m_distances;
};

} // namespace petrous::rendering
