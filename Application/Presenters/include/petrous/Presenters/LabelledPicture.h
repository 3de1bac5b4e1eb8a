#pragma once

#include <string>
#include <vector>

#include "petrous/Core/CameraPose.h"
#include "petrous/Presenters/Background.h"
#include "petrous/Presenters/SliceGeometry.h"
#include "petrous/Presenters/SliceOverlay.h"
#include "petrous/Rendering/Picture.h"
#include "petrous/Scene/Description.h"

namespace petrous::presenters
{

/// What is written into pictures that leave the window, in the sizes of a picture on a screen.
/// `magnified`: for one with more pixels, as for print; `backdrop`: what its background is.

/// A scale bar at the lower right with its length, a round number; `where` follows it: "in the
/// focal plane".
void addScaleBar(rendering::Picture& picture, double mmPerPixel, const std::string& where = {},
                 double magnified = 1.0, Backdrop backdrop = Backdrop::Dark);

/// The patient's directions at the middles of the edges of a 3D picture.
void addEdgeLetters(rendering::Picture& picture, const core::CameraPose& camera,
                    double magnified = 1.0, Backdrop backdrop = Backdrop::Dark);

/// Lines at the upper left.
void addLines(rendering::Picture& picture, const std::vector<std::string>& lines,
              double magnified = 1.0, Backdrop backdrop = Backdrop::Dark);

/// A cross with a gap in its middle at a place; pixels.
void addCross(rendering::Picture& picture, const Eigen::Vector2d& place);

/// A straight line between two places; pixels.
void addLine(rendering::Picture& picture, const Eigen::Vector2d& from, const Eigen::Vector2d& to);

/// A slice with orientation letters, a scale bar and lines.
rendering::Picture labelledSlice(SlicePixels pixels, const SliceGeometry& slice,
                                 const std::vector<std::string>& lines);

/// "Left side", "Right side", "Both sides", "Side not stated".
std::string sideText(scene::Side side);

} // namespace petrous::presenters
