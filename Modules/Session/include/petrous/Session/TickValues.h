#pragma once

#include <type_traits>

#include "petrous/Haptics/Pose.h"

namespace petrous::session
{

/// A pose as plain numbers, trivially copyable to a ring or file.
struct PoseValues
{
  double position[3] = {0.0, 0.0, 0.0};      ///< mm
  double rotation[4] = {1.0, 0.0, 0.0, 0.0}; ///< w, x, y, z

  static PoseValues of(const haptics::Pose& pose) noexcept
  {
    const auto& p = pose.position;
    const auto& q = pose.rotation;
    return {{p.x(), p.y(), p.z()}, {q.w(), q.x(), q.y(), q.z()}};
  }
  haptics::Pose pose() const noexcept
  {
    return {{position[0], position[1], position[2]},
            {rotation[0], rotation[1], rotation[2], rotation[3]}};
  }
};

/// A wrench as plain numbers, N and N mm.
struct WrenchValues
{
  double force[3] = {0.0, 0.0, 0.0};
  double torque[3] = {0.0, 0.0, 0.0};

  static WrenchValues of(const haptics::Wrench& wrench) noexcept
  {
    const auto& f = wrench.linear;
    const auto& t = wrench.angular;
    return {{f.x(), f.y(), f.z()}, {t.x(), t.y(), t.z()}};
  }
  haptics::Wrench wrench() const noexcept
  {
    return {{force[0], force[1], force[2]}, {torque[0], torque[1], torque[2]}};
  }
};

static_assert(std::is_trivially_copyable_v<PoseValues> && sizeof(PoseValues) == 56);
static_assert(std::is_trivially_copyable_v<WrenchValues> && sizeof(WrenchValues) == 48);

} // namespace petrous::session
