#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "petrous/Core/CameraPose.h"
#include "petrous/Scene/Description.h"
#include "petrous/Scene/ViewState.h"

namespace petrous::presenters
{

/// A way of operating on the temporal bone, by which the handpiece is held.
enum class SurgicalApproach : std::uint8_t
{
  Transmastoid,
  PosteriorTympanotomy,
  Translabyrinthine,
  Retrosigmoid,
  MiddleFossa
};

constexpr SurgicalApproach kSurgicalApproaches[] = {
    SurgicalApproach::Transmastoid, SurgicalApproach::PosteriorTympanotomy,
    SurgicalApproach::Translabyrinthine, SurgicalApproach::Retrosigmoid,
    SurgicalApproach::MiddleFossa};

/// "transmastoid", "posterior-tympanotomy", ...
const char* nameOf(SurgicalApproach approach);
std::optional<SurgicalApproach> parseSurgicalApproach(const std::string& name);

/// The handpiece as it is held at first, in the right or left hand.
scene::ViewState::Handpiece usualHandpiece(bool isLeftHand);

/// Direction of the shaft, from the burr to the hand, patient LPS, of length 1. It leans from the
/// approach's axis as the usual handpiece does from the line of sight, towards the surgeon and the
/// side of the hand; an ear's axis is the mirror image of the other's in the median plane.
///
/// Axes, from the operated place to the eye, and where the surgeon sits:
///   transmastoid           along the left-right axis, onto the mastoid's surface; behind the ear
///   posterior tympanotomy  30 degrees behind it: past the posterior wall of the canal
///   translabyrinthine      15 degrees behind it: along the internal auditory canal, which lies
///                          nearly transverse, between the canal's wall and the sigmoid sinus
///   retrosigmoid           45 degrees behind it: along the posterior face of the petrous pyramid,
///                          which lies at 45 degrees to the median plane
///   middle fossa           45 degrees above it: onto the petrous bone's superior face through a
///                          craniotomy above the ear; at the vertex
/// 45 degrees of the pyramid is anatomy; the other angles are our choice and no measurement.
///
/// `ear`: left, or else right.
Eigen::Vector3d shaftOf(SurgicalApproach approach, scene::Side ear, bool isLeftHand);

/// The turn and tilt with which a shaft lies along that direction in the middle of the camera's
/// picture, in that hand. nullopt: it would lean further than a handpiece can
/// (AimSettings::kMaxTilt), or come from behind the picture. Throws InvalidParameter for a camera
/// without a viewing direction.
std::optional<scene::ViewState::Handpiece>
handpieceAlong(const Eigen::Vector3d& shaft, const core::CameraPose& camera, bool isLeftHand);

} // namespace petrous::presenters
