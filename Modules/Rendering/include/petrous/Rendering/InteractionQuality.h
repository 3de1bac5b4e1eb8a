#pragma once

#include "petrous/Rendering/RenderQuality.h"

namespace petrous::rendering
{

/// Adapts picture quality during interaction to reach a target frame rate: fewer samples per pixel
/// and, below half of them, longer steps as well. Opacity is per millimetre, so brightness does not
/// change.
///
/// Learns from measured frame times: for a given step, the time of a volume grows with its number
/// of pixels. Pure computation.
class InteractionQuality
{
public:
  static constexpr double kSmallestScale = 0.15; ///< relative to the picture's edge
  static constexpr double kMaxStep = 1.0;        ///< voxels

  /// Throws InvalidParameter unless 1 <= hz <= 240.
  explicit InteractionQuality(double hz = 30.0);

  double wantedRate() const noexcept { return m_hz; }

  /// Quality of the next frame during interaction.
  RenderQuality coarser(const RenderQuality& full) const noexcept;

  /// Reports the time in ms of a frame drawn with `quality`. Times <= 0 are ignored.
  void frameTook(double milliseconds, const RenderQuality& quality) noexcept;

private:
  double m_hz;
  double m_cost = 0.0; // ms for a picture of scale 1 with kMaxStep, smoothed; 0: unknown
};

} // namespace petrous::rendering
