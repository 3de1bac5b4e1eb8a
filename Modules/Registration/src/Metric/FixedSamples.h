#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "LevelImage.h"

namespace petrous::registration
{

/// Sample points of the fixed image with their intensity bins.
///
/// The points are a low-discrepancy sequence over a voxel box, off the grid, so that the artefacts
/// of linear interpolation (a better metric where the two grids coincide) average out. They are
/// stored in image order.
struct FixedSamples
{
  std::vector<Eigen::Vector3f> points; ///< patient, mm, relative to `centre`
  std::vector<std::uint8_t> bins;
  std::vector<float> weights;                       ///< one per point, or empty: all 1
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< of the points, patient LPS mm
  double radius = 1.0; ///< mm; root mean square distance of the points from the centre

  std::size_t size() const noexcept { return points.size(); }
};

/// `count` points in `box`, except those on NaN. Equal seeds give equal points.
FixedSamples drawSamples(const LevelImage& image, const core::IndexBox& box, std::size_t count,
                         std::uint32_t seed, int bins);

/// The samples within `radius` mm of a point (fixed patient, LPS mm).
FixedSamples within(const FixedSamples& samples, const Eigen::Vector3d& point, double radius);

/// Block bootstrap (Kuensch 1989): the samples' box is divided into blocks^3 blocks, the same
/// number of blocks is drawn with replacement, and each sample is weighted by the multiplicity of
/// its block. Samples with weight 0 are dropped.
FixedSamples bootstrap(const FixedSamples& samples, int blocks, std::uint32_t seed);

} // namespace petrous::registration
