#pragma once

#include <limits>

#include "SurfaceShadows.h"
#include "TissueOptics.h"
#include "petrous/Rendering/ClippedRegion.h"

namespace petrous::rendering
{

/// What a ray accumulates in tissue.
struct GatheredLight
{
  Eigen::Vector3d color{0.0, 0.0, 0.0}; ///< light from the tissue, RGB
  double transmittance = 1.0;           ///< fraction of the light from behind that is transmitted
  double depth = std::numeric_limits<double>::quiet_NaN(); ///< mm to the first surface of f
};

/// Marches rays through tissue in small constant steps. Every change of state is bisected. Where
/// the state stays but comes close to another, so that a ray grazing a surface could miss it
/// between two samples, the turning point is examined as well. In between, the transfer function is
/// integrated by two-point Gauss quadrature, with the intensity linear within a step, split at the
/// function's points. Pure and thread-safe.
class TissueRay
{
public:
  /// step: relative to the smallest spacing; sample: see optics::asideOf. Throws RenderingError
  /// BadContents.
  TissueRay(const SceneContents& contents, double step, int sample = -1);

  TissueRay(const TissueRay&) = delete;
  TissueRay& operator=(const TissueRay&) = delete;

  /// Up to `end` mm, e.g. an opaque hit. `lamp`: of the frame.
  GatheredLight cast(const PixelRay& ray, double end, const optics::Lamp& lamp) const;

  const SurfaceShadows& shadows() const noexcept { return m_shadows; }

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
  static void add(Walk& walk, double t, const TissueOptics::Surface& surface);

  TissueOptics m_optics;
  ClippedRegion m_drawn;
  SurfaceShadows m_shadows;
  double m_step;      // mm
  double m_tolerance; // mm
};

} // namespace petrous::rendering
