#pragma once

#include <algorithm>
#include <array>

#include "petrous/Rendering/SceneContents.h"

namespace petrous::rendering::tool
{

// Similar to the haptic tool (haptics::BurrShape): a ball, a shaft of at most 0.6 of its radius for
// 30 mm, then the handpiece.
constexpr double kShaftRatio = 0.5;
constexpr double kShaftLength = 30.0;     // mm from the burr's centre
constexpr double kHandpieceLength = 90.0; // mm
constexpr double kHandpieceRadius = 5.0;  // mm

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

inline double handpieceRadius(const ToolPose& pose)
{
  return std::max(kHandpieceRadius, pose.radius);
}

} // namespace petrous::rendering::tool
