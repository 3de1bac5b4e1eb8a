#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Core/TriangleMesh.h"
#include "petrous/Scene/ViewState.h"
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

/// An instrument as its file has it.
struct InstrumentSurface
{
  std::string name;        ///< of the file
  core::TriangleMesh mesh; ///< mm, in the file's own coordinates; closed
};

/// How an instrument lies in its file if it does along that axis.
struct InstrumentPlacement
{
  double length = 0.0; ///< mm, along the axis
  double width = 0.0;  ///< mm, the longer of its two sides across
  double tip = 0.0;    ///< mm, coordinate along x, y or z of the end at which its tip then is
  /// It is more than a quarter longer across than along the axis.
  bool isAcross() const noexcept { return width > 1.25 * length; }
};

constexpr double kMinInstrument = 1.0;   ///< mm, longest edge of its bounding box
constexpr double kMaxInstrument = 300.0; ///< mm
constexpr std::size_t kMaxInstrumentTriangles = 200000;

/// Reads the surface of an instrument from OBJ, STL, PLY or VTP (imaging::loadMesh): closed, in mm,
/// or in the unit that the file states.
///
/// Throws FileError; InvalidParameter for a surface that is not closed, encloses nothing, is
/// shorter than kMinInstrument, longer than kMaxInstrument, or of too many triangles, naming what
/// would be right. CancelledError.
InstrumentSurface readInstrumentSurface(const std::filesystem::path& path,
                                        const core::Progress& progress = {});

/// The same of a mesh that a case keeps; throws InvalidParameter for what it refuses.
InstrumentSurface instrumentSurface(std::string name, core::TriangleMesh mesh);

/// An instrument as a case keeps it, and the other way round: its surface is read, which throws
/// what that throws, and checked as a file's. `unnamed`: the name of one without.
scene::ViewState::Instrument keptInstrument(const InstrumentSurface& surface,
                                            const std::string& axis);
InstrumentSurface surfaceOf(const scene::ViewState::Instrument& kept,
                            const std::string& unnamed = "instrument");

/// `axis` as for makeInstrument.
InstrumentPlacement placementOf(const core::TriangleMesh& mesh, const std::string& axis);

/// Of kInstrumentAxes the likely one: along the longest side of the bounding box, of equal ones
/// along that which kInstrumentAxes has first. Its tip is at the end at which the origin lies, to
/// 1 mm; if it lies at neither or both, at the end whose last tenth is narrower, else at the lower.
std::string likelyAxis(const core::TriangleMesh& mesh);

/// The file's origin is the tip if it lies within 1 mm of the surface, which reaches no more than
/// 1 mm beyond it along the axis; else the tip is the point farthest from the hand, which is noted.
/// `axis`, of kInstrumentAxes, leads from the tip to the hand in the file's own coordinates; the
/// instrument is turned so that it becomes +z.
///
/// Throws InvalidParameter for an axis that does not exist; CancelledError.
LoadedInstrument makeInstrument(InstrumentSurface surface, const std::string& axis,
                                const core::Progress& progress = {});

/// Both; throws what they throw.
LoadedInstrument readInstrument(const std::filesystem::path& path,
                                const std::string& axis = kInstrumentAxes[0],
                                const core::Progress& progress = {});

/// mm by which an instrument reaches beyond its tip, away from the hand; 0 to 1.
double reachBeyondTip(const session::Instrument& instrument) noexcept;

/// "pick.stl: 2000 points, no place within 10 mm of its tip farther than 0.31 mm from one, and none
/// at all farther than 1.20 mm; bone thinner than twice that may pass between them unfelt".
std::string toString(const session::Instrument& instrument);

} // namespace petrous::presenters
