#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Session/TouchScene.h"

namespace petrous::presenters
{

/// The axes of a file along which an instrument may lie, from its tip to the hand.
constexpr std::array<const char*, 6> kInstrumentAxes{"z+", "z-", "x+", "x-", "y+", "y-"};

struct LoadedInstrument
{
  std::shared_ptr<const session::Instrument> instrument;
  std::vector<std::string> notes; ///< what was assumed or changed, one sentence each
};

constexpr double kMinInstrument = 1.0;   ///< mm, longest edge of its bounding box
constexpr double kMaxInstrument = 300.0; ///< mm
constexpr std::size_t kMaxInstrumentTriangles = 200000;

/// Reads an instrument from OBJ, STL, PLY or VTP (imaging::loadMesh): a closed surface in mm, or in
/// the unit that the file states.
///
/// The file's origin is the tip if it lies within 1 mm of the surface, which reaches no more than
/// 1 mm beyond it along the axis; else the tip is the point farthest from the hand, which is noted.
/// `axis`, of kInstrumentAxes, leads from the tip to the hand in the file's own coordinates; the
/// instrument is turned so that it becomes +z.
///
/// Throws FileError; InvalidParameter for an axis that does not exist, and for a surface that is
/// not closed, encloses nothing, is shorter than kMinInstrument, longer than kMaxInstrument, or of
/// too many triangles, naming what would be right. CancelledError.
LoadedInstrument readInstrument(const std::filesystem::path& path,
                                const std::string& axis = kInstrumentAxes[0],
                                const core::Progress& progress = {});

/// mm by which an instrument reaches beyond its tip, away from the hand; 0 to 1.
double reachBeyondTip(const session::Instrument& instrument) noexcept;

/// "pick.stl: 2000 points, no place within 10 mm of its tip farther than 0.31 mm from one, and none
/// at all farther than 1.20 mm; bone thinner than twice that may pass between them unfelt".
std::string toString(const session::Instrument& instrument);

} // namespace petrous::presenters
