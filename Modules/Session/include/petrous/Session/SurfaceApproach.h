#pragma once

#include <optional>

#include "petrous/Session/ServoParameters.h"
#include "petrous/Volume/NearestSurface.h"

namespace petrous::session
{

/// Vector from the position of a pressed tool to the surface (ServoParameters::approach): to the
/// nearest point of f = 0, hence along the normal there. For a position inside tissue, from that
/// point, where the tissue was entered, to the position.
///
/// The last vector is reused while the position moves by at most a twentieth of its distance and
/// the mask is unchanged. Searches and allocates: not for the servo tick. Not thread-safe.
class SurfaceApproach
{
public:
  static constexpr double kReach = 30.0; ///< mm, beyond it there is nothing to press on

  /// `field` is evaluated in its current state, and must outlive this.
  explicit SurfaceApproach(const volume::TissueField& field)
    : m_field(field)
  {
  }

  /// Call when the field has changed.
  void forget() noexcept
  {
    m_search.reset();
    m_known = false;
  }

  /// From `place` (patient mm) into the tissue, mm; zero if no surface is within reach.
  Eigen::Vector3d at(const Eigen::Vector3d& place);

  void apply(const Eigen::Vector3d& place, ServoParameters& parameters);

private:
  const volume::TissueField& m_field;
  std::optional<volume::NearestSurfaceSearch> m_search;
  bool m_known = false;
  double m_distance = kReach; // mm, of the last position examined
  Eigen::Vector3d m_place{0.0, 0.0, 0.0};
  Eigen::Vector3d m_way{0.0, 0.0, 0.0};
};

} // namespace petrous::session
