#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "LevelImage.h"

namespace petrous::registration
{

/// Where the metric looks: points of the fixed image with the bin that their value falls into.
///
/// The points are a low-discrepancy sequence over a voxel box, off the grid, so that the artefacts
/// of linear interpolation (a metric that is better where the two grids fall on each other) average
/// out. They lie in memory in the order of the image.
struct FixedSamples
{
  std::vector<Eigen::Vector3f> points; ///< patient, mm, from `centre`
  std::vector<std::uint8_t> bins;
  std::vector<float> weights;                       ///< as many as points, or none: all 1
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< of the points, patient LPS mm
  double radius = 1.0; ///< mm; root mean square distance of the points from the centre

  std::size_t size() const noexcept { return points.size(); }
};

/// `count` points in `box` less those on NaN. Equal seeds give equal points.
FixedSamples drawSamples(const LevelImage& image, const core::IndexBox& box, std::size_t count,
                         std::uint32_t seed, int bins);

/// Those within `radius` mm of a point (fixed patient, LPS mm).
FixedSamples within(const FixedSamples& samples, const Eigen::Vector3d& point, double radius);

/// A block bootstrap (Kuensch 1989): the samples' box is cut into blocks^3 blocks, as many blocks
/// drawn with replacement, and each sample weighted with how often its block was. Keeps those that
/// were.
FixedSamples bootstrap(const FixedSamples& samples, int blocks, std::uint32_t seed);

} // namespace petrous::registration
