#pragma once

#include <algorithm>
#include <array>

#include "petrous/Rendering/SceneContents.h"

namespace petrous::rendering::tool
{

// The tool that is felt (haptics::BurrShape with its defaults): a ball, a shaft, a handpiece along
// one axis. Lengths in mm, the shaft's from the burr's centre.
constexpr double kShaftRatio = 0.6;     // of the burr's radius
constexpr double kMaxShaftRadius = 1.2; // mm
constexpr double kShaftLength = 30.0;
constexpr double kHandpieceLength = 60.0;
constexpr double kHandpieceRadius = 6.0;

constexpr double kField = 5.0; // mm around the burr: what a surgeon looks at

constexpr std::array<double, 3> kBurrColor{0.85, 0.72, 0.35};
constexpr std::array<double, 3> kDrillingColor{1.0, 0.55, 0.15};
constexpr std::array<double, 3> kShaftColor{0.72, 0.74, 0.77};
constexpr std::array<double, 3> kHandpieceColor{0.50, 0.56, 0.64};

constexpr double kAmbient = 0.25;
constexpr double kSpecular = 0.45;
constexpr double kShininess = 40.0;

/// Whether there is anything to draw.
inline bool isShown(const ToolPose& pose)
{
  return pose.radius > 0.0 && pose.axisToHand.norm() > 0.0 && pose.center.allFinite() &&
         pose.axisToHand.allFinite();
}

/// mm
inline double shaftRadius(const ToolPose& pose)
{
  return std::min(kShaftRatio * pose.radius, kMaxShaftRadius);
}

} // namespace petrous::rendering::tool
