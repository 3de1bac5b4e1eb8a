#pragma once

#include "petrous/Rendering/RenderQuality.h"

namespace petrous::rendering
{

/// How coarse a picture is while something moves, so that frames come at the wanted rate: fewer
/// samples per pixel, and below half of them longer steps too. Opacity is per millimetre, so
/// brightness stays the same.
///
/// Learns from the time that frames took: at a given step, that of a volume grows with the number
/// of its pixels. Pure arithmetic.
class InteractionQuality
{
public:
  static constexpr double kSmallestScale = 0.15; ///< of the picture's edge
  static constexpr double kMaxStep = 1.0;    ///< voxels

  /// Throws InvalidParameter unless 1 <= hz <= 240.
  explicit InteractionQuality(double hz = 30.0);

  double wantedRate() const noexcept { return m_hz; }

  /// For the next frame while something moves.
  RenderQuality coarser(const RenderQuality& full) const noexcept;

  /// What a frame drawn with `quality` took, ms. Times that are not above 0 are passed over.
  void frameTook(double milliseconds, const RenderQuality& quality) noexcept;

private:
  double m_hz;
  double m_cost = 0.0; // ms of a picture of scale 1 at kMaxStep's step, smoothed; 0: unknown
};

} // namespace petrous::rendering
