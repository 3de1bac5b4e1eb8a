#pragma once

#include <optional>

#include "ClippedRegion.h"
#include "OpticalModel.h"
#include "TissueOptics.h"

namespace petrous::rendering
{

/// What a surface sees of the sky and of the lamp, by many rays through the tissue field and past
/// the tool. Pure and thread-safe; refers to its arguments.
class SurfaceShadows
{
public:
  static constexpr int kSkyRays = 256; ///< distributed by the cosine
  static constexpr int kLampRays = 64;

  SurfaceShadows(const TissueOptics& optics, const ClippedRegion& drawn,
                 const std::optional<ToolPose>& tool = std::nullopt);

  /// `normal`: unit, towards the camera; zero: everything is seen.
  optics::Seen at(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                  const optics::Lamp& lamp) const;

private:
  template <class Weight>
  double stopped(const PixelRay& ray, double reach, const Weight& weight) const;

  const TissueOptics& m_optics;
  const ClippedRegion& m_drawn;
  std::optional<ToolPose> m_tool; // that is shown
  double m_step;                  // mm
};

} // namespace petrous::rendering
