#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "petrous/Haptics/Pose.h"

namespace petrous::haptics
{

/// How a proxy follows the device. Lengths in voxels are multiples of h, the smallest spacing.
struct ProxyParameters
{
  double stiffness = 1.0;         ///< of the coupling, N/mm, in (0, 100]
  double angularStiffness = 20.0; ///< N mm/rad, in (0, 1e5]
  double nearGap = 0.25;          ///< voxels: shell points closer than this give contact rows
  double sweepStep = 0.5;         ///< voxels: longest step of a point between two samples
  int bisections = 10;            ///< of a sweep's step, to locate the surface, in [1, 30]
  int rounds = 5;                 ///< motions per tick that end at new contacts, in [1, 20]
  double deadband = 0.001;        ///< mm: shorter motions are skipped
  int samples = 1200; ///< field samples per tick, in [100, 1000000]; the rest of the motion follows
                      ///< later
};

enum class ProxyStatus : std::uint8_t
{
  Free,
  Contact,
  Inside,    ///< in tissue with no known way out: no contact or force until free
  Retreated, ///< tissue was restored around the tool; it went back along its path
  BadGoal    ///< the goal is not finite; the tool stays
};

struct ProxyContact
{
  Eigen::Vector3d arm{0.0, 0.0, 0.0};    ///< from the tool's origin to the contact, patient axes,
                                         ///< mm
  Eigen::Vector3d normal{0.0, 0.0, 1.0}; ///< unit, out of the tissue, patient axes
  double gap = 0.0;                      ///< mm
  double thrust = 0.0;                   ///< lambda, N
  std::uint32_t point = 0;               ///< index in the shell
  bool soft = false;
};

/// Result of one proxy tick.
struct ProxyTick
{
  static constexpr std::size_t kMaxContacts = 32;

  ProxyStatus status = ProxyStatus::Free;
  Pose pose;     ///< of the proxy, X_PT
  Wrench wrench; ///< on the hand, about the tool's origin, patient axes, before limits
  std::size_t contactCount = 0; ///< active contacts
  std::array<ProxyContact, kMaxContacts> contacts;
  double thrust = 0.0; ///< N, sum over the burr's contacts
  double penetration =
      0.0; ///< mm, of the deepest shell point in rigid tissue, as sampled; NaN: unknown
  int rounds = 0;
  double postponed = 0.0; ///< mm, of the fastest point: motion that the tick's limits of work left
                          ///< to the following ticks, as far as it is known
  std::size_t nearPoints = 0;  ///< shell points examined
  std::size_t samples = 0;     ///< of the field
  std::uint64_t maskState = 0; ///< number of the mask state used (MaskState)
};

} // namespace petrous::haptics
