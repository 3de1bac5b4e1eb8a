#pragma once

#include <Eigen/Core>

#include "petrous/Core/RigidTransform.h"

#include "FixedSamples.h"
#include "LevelImage.h"

namespace petrous::registration
{

/// Bins along each axis of the joint histogram: the measured default (Documentation/adr).
constexpr int kBins = 64;

struct JointHistogram;

/// What independent images share for want of samples, nats: half the filled cells a sample (Miller
/// 1955), with all cells of `bins` by `bins` taken for filled. 0 without samples.
double informationBias(int bins, double samples);

/// What ranks poses that overlap differently: information * sqrt(overlap). Information alone likes
/// to push an image out of the other until little is left; times the whole overlap it likes to push
/// images together that share little (measured: Documentation/adr).
double poseScore(double information, double overlap);

/// Mutual information of the fixed samples and the moving image, in nats, as Mattes et al. (IEEE
/// TMI 22:120, 2003) define it: I = sum_fm p(f,m) log(p(f,m) / (p(f) p(m))), with a Parzen window
/// of a box over fixed and a cubic B-spline over moving values, so that it has a gradient.
///
/// Samples that fall outside the moving image's hull or on NaN are left out. The sums are taken in
/// an order that does not depend on the number of threads: equal input gives equal bits.
class MutualInformation
{
public:
  struct Value
  {
    double information = 0.0; ///< nats; 0 where nothing overlaps
    double overlap = 0.0;     ///< share of the samples' weight that fell on the moving image
    /// d information / d pose for a small translation of the mapped points (mm) and a small
    /// rotation of them about the mapped centre (rad), both in the moving patient's axes.
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
    Eigen::Vector3d rotation = Eigen::Vector3d::Zero();
  };

  /// Keeps references to both.
  MutualInformation(const FixedSamples& fixed, const LevelImage& moving, int bins = kBins);

  const FixedSamples& fixed() const noexcept { return m_fixed; }

  /// At a pose that takes fixed patient points to moving ones.
  double value(const core::RigidTransform& movingFromFixed, double* overlap = nullptr) const;
  Value withGradient(const core::RigidTransform& movingFromFixed) const;

private:
  template <class Fall>
  JointHistogram fill(const core::RigidTransform& movingFromFixed, const Fall& fall) const;

  const FixedSamples& m_fixed;
  const LevelImage& m_moving;
  int m_bins;
  double m_weight;
};

} // namespace petrous::registration
