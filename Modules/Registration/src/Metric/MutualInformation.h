#pragma once

#include <Eigen/Core>

#include "petrous/Core/RigidTransform.h"

#include "FixedSamples.h"
#include "LevelImage.h"

namespace petrous::registration
{

/// Bins along each axis of the joint histogram: the default chosen by measurement
/// (Documentation/adr).
constexpr int kBins = 64;

struct JointHistogram;

/// Bias of the mutual information due to finite sampling, nats: half the number of filled cells per
/// sample (Miller 1955), assuming that all `bins` by `bins` cells are filled. 0 without samples.
double informationBias(int bins, double samples);

/// Score for comparing poses with different overlap: information * sqrt(overlap). Information alone
/// favours pushing one image out of the other until little overlap remains; information times
/// overlap favours aligning images that have little in common (measured: Documentation/adr).
double poseScore(double information, double overlap);

/// Mutual information of the fixed samples and the moving image, in nats, according to Mattes et
/// al. (IEEE TMI 22:120, 2003): I = sum_fm p(f,m) log(p(f,m) / (p(f) p(m))), with a box Parzen
/// window for fixed and a cubic B-spline for moving values, so that it is differentiable.
///
/// Samples outside the hull of the moving image or on NaN are skipped. The order of summation does
/// not depend on the number of threads: equal input gives bit-identical results.
class MutualInformation
{
public:
  struct Value
  {
    double information = 0.0; ///< nats; 0 without overlap
    double overlap = 0.0;     ///< fraction of sample weight inside the moving image
    /// d information / d pose for a small translation of the mapped points (mm) and a small
    /// rotation about the mapped centre (rad), both in the moving patient's axes.
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
    Eigen::Vector3d rotation = Eigen::Vector3d::Zero();
  };

  /// Keeps references to both arguments.
  MutualInformation(const FixedSamples& fixed, const LevelImage& moving, int bins = kBins);

  const FixedSamples& fixed() const noexcept { return m_fixed; }

  /// For a pose that maps fixed to moving patient points.
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
