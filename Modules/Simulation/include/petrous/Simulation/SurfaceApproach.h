#pragma once

#include <optional>

#include "petrous/Simulation/ServoParameters.h"
#include "petrous/Volume/NearestSurface.h"

namespace petrous::simulation
{

/// Where a tool that is pressed at a given place finds the surface (ServoParameters::approach): the
/// way from the place to the nearest point of f = 0, which is along the normal there. Nearest to a
/// place inside tissue is where it is entered from, so the way leads from there to the place.
///
/// A place that moves by a twentieth of its distance has the way that it had, as long as the mask
/// stays. Not for a servo's tick: it searches, and allocates. One thread.
class SurfaceApproach
{
public:
  static constexpr double kReach = 30.0; ///< mm, farther off there is nothing to press on

  /// `field` is looked at as it is now, and must outlive this.
  explicit SurfaceApproach(const volume::TissueField& field)
    : m_field(field)
  {
  }

  /// The field has changed.
  void forget() noexcept
  {
    m_search.reset();
    m_known = false;
  }

  /// From `place` (patient mm) into the tissue, mm; zero where no surface is within reach.
  Eigen::Vector3d at(const Eigen::Vector3d& place);

  void apply(const Eigen::Vector3d& place, ServoParameters& parameters);

private:
  const volume::TissueField& m_field;
  std::optional<volume::NearestSurfaceSearch> m_search;
  bool m_known = false;
  double m_distance = kReach; // mm, of the last place that was looked at
  Eigen::Vector3d m_place{0.0, 0.0, 0.0};
  Eigen::Vector3d m_way{0.0, 0.0, 0.0};
};

} // namespace petrous::simulation
