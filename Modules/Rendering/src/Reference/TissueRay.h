#pragma once

#include <limits>

#include "ClippedRegion.h"
#include "TissueOptics.h"

namespace petrous::rendering
{

/// What a ray gathers on its way through the tissue.
struct GatheredLight
{
  Eigen::Vector3d color{0.0, 0.0, 0.0}; ///< what the tissue sends to the eye, RGB
  double transmittance = 1.0;           ///< share of what lies behind that comes through
  double depth = std::numeric_limits<double>::quiet_NaN(); ///< mm to the first surface of f
};

/// Follows rays through the tissue in constant small steps. Every change of state is bisected, and
/// where the state stays but comes close to another, so that a ray which only grazes a surface
/// might pass it between two samples, the turning point is looked at too. In between, the transfer
/// function is integrated with the intensity linear within a step, split where the function bends,
/// by Gauss' rule of two points. Pure and thread-safe.
class TissueRay
{
public:
  /// step: of the smallest spacing. Throws RenderingError BadContents.
  TissueRay(const SceneContents& contents, double step);

  /// Up to `end` mm, where something opaque may stand.
  GatheredLight cast(const PixelRay& ray, double end) const;

private:
  struct Walk;
  struct Sample;
  Sample sampleAt(const PixelRay& ray, double t) const;
  std::optional<Sample> turningPoint(const PixelRay& ray, const Sample& a, const Sample& b,
                                     const Sample& c) const;
  void walkTo(Walk& walk, const Sample& target) const;
  void gather(Walk& walk, double to) const;
  void addSurface(Walk& walk, double t, TissueOptics::State to,
                  const std::optional<Eigen::Vector3d>& face) const;

  TissueOptics m_optics;
  ClippedRegion m_drawn;
  double m_step;      // mm
  double m_tolerance; // mm
};

} // namespace petrous::rendering
