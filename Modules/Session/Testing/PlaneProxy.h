#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "petrous/Haptics/Proxy.h"
#include "petrous/Volume/PublishedMask.h"
#include "petrous/Volume/Sampling.h"

namespace petrous::session::testing
{

/// A ball on a half-space, in closed form: solid where normal . p < offset and, with a mask, where
/// the mask is above 1/2. The ball touches with its pole towards the plane. Rotation is not
/// resisted.
class PlaneProxy : public haptics::Proxy
{
public:
  Eigen::Vector3d normal{0.0, 0.0, 1.0};
  double offset = 0.0;
  double radius = 2.0;
  double stiffness = 1.0;
  bool absent = false; ///< nothing is solid
  std::shared_ptr<const volume::PublishedMask> mask;

  const haptics::Pose& pose() const noexcept override { return m_pose; }

  void place(const haptics::Pose& pose) noexcept override
  {
    m_pose = pose;
    const volume::MaskState* state = mask ? mask->acquire() : nullptr;
    m_inside = solid(pole(pose.position), state);
    m_raises = state ? state->raises() : 0;
    if (mask)
      mask->release();
  }

  bool placeFree(const haptics::Pose& pose) noexcept override
  {
    const volume::MaskState* state = mask ? mask->acquire() : nullptr;
    const bool free = !solid(pole(pose.position), state);
    if (mask)
      mask->release();
    if (free)
      place(pose);
    return free;
  }

  const haptics::ProxyTick& step(const haptics::Pose& goal) noexcept override
  {
    m_tick = haptics::ProxyTick();
    if (!goal.finite())
      m_tick.status = haptics::ProxyStatus::BadGoal;
    else
    {
      const volume::MaskState* state = mask ? mask->acquire() : nullptr;
      move(goal, state);
      if (mask)
        mask->release();
    }
    m_tick.pose = m_pose;
    return m_tick;
  }

private:
  Eigen::Vector3d pole(const Eigen::Vector3d& center) const { return center - radius * normal; }

  bool solid(const Eigen::Vector3d& p, const volume::MaskState* state) const
  {
    if (absent || normal.dot(p) >= offset)
      return false;
    return !state || left(p, *state) > 0.5;
  }

  double left(const Eigen::Vector3d& patient, const volume::MaskState& state) const
  {
    const auto& grid = mask->geometry();
    const Eigen::Vector3d voxel = grid.voxelFromPatient(patient);
    if (!grid.hullContains(voxel))
      return 1.0;
    const auto& bricks = mask->brickDims();
    return volume::TrilinearCell(voxel, grid.dims())
        .interpolate(
            [&](int i, int j, int k)
            {
              constexpr int edge = volume::CutMask::kBrickEdge;
              const auto n = static_cast<std::size_t>(
                  i / edge + bricks[0] * (j / edge + bricks[1] * (k / edge)));
              const auto* brick = state.brick(n);
              if (!brick)
                return 1.0;
              return (*brick)[static_cast<std::size_t>(i % edge +
                                                       edge * (j % edge + edge * (k % edge)))] /
                     65535.0;
            });
  }

  // Smallest distance along the normal that frees the ball, in steps of 0.02 mm, then bisected.
  double wayOut(const Eigen::Vector3d& center, const volume::MaskState* state) const
  {
    if (!solid(pole(center), state))
      return 0.0;
    double inside = 0.0;
    double outside = offset - normal.dot(pole(center));
    for (double t = 0.0; state && t < outside; t += 0.02)
      if (!solid(pole(center) + t * normal, state))
      {
        outside = t;
        inside = t - 0.02;
        break;
      }
    for (int n = 0; state && n < 40; ++n)
    {
      const double middle = 0.5 * (inside + outside);
      (solid(pole(center) + middle * normal, state) ? inside : outside) = middle;
    }
    return outside;
  }

  void move(const haptics::Pose& goal, const volume::MaskState* state)
  {
    if (state && state->raises() != m_raises)
    {
      m_raises = state->raises();
      const double back = m_inside ? 0.0 : wayOut(m_pose.position, state);
      if (back > 0.0)
      {
        m_pose.position += back * normal;
        m_tick.status = haptics::ProxyStatus::Retreated;
        return;
      }
    }
    const double deep = wayOut(goal.position, state);
    if (m_inside)
    {
      m_pose = goal;
      m_inside = deep > 0.0;
      m_tick.status = m_inside ? haptics::ProxyStatus::Inside : haptics::ProxyStatus::Free;
      return;
    }
    m_pose = {goal.position + deep * normal, goal.rotation};
    if (deep <= 0.0)
      return;
    m_tick.status = haptics::ProxyStatus::Contact;
    m_tick.wrench.linear = stiffness * deep * normal;
    m_tick.thrust = stiffness * deep;
    m_tick.contactCount = 1;
    m_tick.contacts[0].normal = normal;
    m_tick.contacts[0].arm = -radius * normal;
    m_tick.contacts[0].thrust = stiffness * deep;
  }

  haptics::Pose m_pose;
  haptics::ProxyTick m_tick;
  std::uint64_t m_raises = 0;
  bool m_inside = false;
};

} // namespace petrous::session::testing
