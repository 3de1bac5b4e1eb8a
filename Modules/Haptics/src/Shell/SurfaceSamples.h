#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "SolidParts.h"
#include "petrous/Haptics/HapticField.h"
#include "petrous/Haptics/Pose.h"

namespace petrous::haptics
{

/// Samples of the tissue's surface around a solid tool: tissue against the tool, where a point
/// shell tests the tool against the tissue. Features thinner than a shell's spacing (a plate on
/// edge, a ridge, a spike) cannot pass between its points, since they have samples of their own.
///
/// The samples are where lines parallel to the grid's axes cross f = 0. Along such a line each
/// operand of f is linear in a cell, so each sample is on the interpolated surface; a union on
/// another grid than the CT's has lines in its own cells. A cell has the lines along its edges
/// where its surface is nearly flat, and 2 x 2 or more per side where it is curved or the tool is
/// thin. They depend on the field only and not on the tool, so a pose free of them stays free
/// however often they are found again.
///
/// The samples of a brick are kept, as most of what a search finds was found by the one before it;
/// they are found again when the mask has changed there.
///
/// Samples are found within a `margin` around the tool and kept until the tool has moved that far.
/// The cost of finding them per tick is bounded: a search continues in following ticks, while the
/// known samples are used, and a smaller margin is used where they are many. The tool may have to
/// wait, but never goes where no search was made. A search begins before the known samples are used
/// up, and after a cut: until it ends they represent more tissue than there is, never less. Only
/// the constructor allocates; nothing locks or throws. Not thread-safe.
class SurfaceSamples
{
public:
  static constexpr double kTolerance = 1e-6; ///< mm, depth in the solid that is no contact yet

  /// The field must outlive this.
  SurfaceSamples(const HapticField& field, const ToolSolid& solid);

  bool any() const noexcept { return m_parts.has(SolidParts::kBall); }
  const SolidParts& parts() const noexcept { return m_parts; }

  /// Sets the mask state for the following calls.
  void look(const volume::MaskState& state) noexcept;

  /// Discards all known samples: the tool was placed elsewhere or tissue was restored.
  void forget() noexcept;

  /// The tool moved to `pose`.
  void moved(const Pose& pose) noexcept;

  /// Searches for every sample within reach of a motion of this size (mm, rad) from `pose`, plus
  /// `beyond` mm. Returns the fraction of the motion, 0 to 1, for which all are known now.
  double find(const Pose& pose, double linear, double angular, double beyond) noexcept;

  /// Number of leading samples of a part that include all those within `distance` mm of it now.
  std::size_t within(std::size_t part, double distance) const noexcept;
  const Eigen::Vector3d& place(std::size_t part, std::size_t n) const noexcept ///< patient, mm
  {
    return m_lists[part].places[n];
  }

  /// Maximum lever arm of the known samples about the tool's origin, mm.
  double arm(std::size_t part) const noexcept { return m_parts.reach(part) + m_lists[part].margin; }

  /// Depth of the deepest known sample in the tool at `pose`, mm; 0 if none is deeper than the
  /// tolerance.
  double depth(const Pose& pose) const noexcept;

  /// Depth of a sample deeper than the tolerance in the tool at `pose`, mm; 0 if there is none;
  /// nullopt if not determined at the cost of `most` (field samples).
  std::optional<double> insideAt(const Pose& pose, std::size_t most) noexcept;

  /// Cost of searching since the last `look`, in field samples. `find` costs at most kMaxWork (plus
  /// kMaxAfterCut) and the cost of one brick.
  std::size_t samples() const noexcept { return m_work / kUnit; }

  static constexpr std::size_t kMaxSamples = 16384; ///< per part
  static constexpr std::size_t kMaxWork = 1000;     ///< of `find` per tick, field samples
  /// Additional work after a cut, so that the burr mostly continues in the tick that uses it.
  static constexpr std::size_t kMaxAfterCut = 3000;
  static constexpr std::size_t kUnit = 8; ///< distances to the tool per field sample

private:
  static constexpr std::size_t kBins = 64;
  struct List
  {
    std::vector<Eigen::Vector3d> places;          // patient, mm, in bins, nearest first
    std::array<std::uint32_t, kBins + 1> first{}; // of each bin
    Pose pose;                                    // at the time of the search
    double margin = 0.0;                          // mm within which all were found
    double made = 0.0;                            // mm, maximum motion of a sample relative to the
                                                  // tool since
    double wish = 0.0;                            // mm, margin of the next search
    bool known = false;
    bool cut = false; // the mask changed since the search
    int age = 0;      // ticks since then

    double left() const noexcept { return known ? margin - made : -1.0; }
  };
  struct Box // of bricks, half-open
  {
    core::Index3 lower, upper;
  };
  struct Search // around a part at a pose
  {
    std::size_t part = 0;
    Pose pose;
    Eigen::Matrix3d toTool = Eigen::Matrix3d::Identity();
    double margin = 0.0;
    double least = 0.0; // lower limit of the margin, mm
    double made = 0.0;
    double deepest = 0.0; // if inside
    bool inside = false;  // only tests whether anything is in the tool
    bool active = false;
    bool cut = false;
    std::array<Box, 64> stack;
    std::size_t depth = 0;
    std::size_t work = 0;
    std::size_t dearAt = 0;
    std::vector<Eigen::Vector3d> places;
    std::vector<float> distances;
    std::size_t count = 0;
  };
  void begin(Search& search, std::size_t part, const Pose& pose, double margin,
             bool inside) noexcept;
  void run(Search& search, std::size_t until) noexcept;
  void renew(std::size_t part, const Pose& pose, std::size_t until) noexcept;
  void finish() noexcept;
  void shrink(Search& search, double margin) noexcept;
  void spend(Search& search, std::size_t units) noexcept
  {
    m_work += units;
    search.work += units;
  }
  struct Cell; // operands at a cell's corners
  struct Brick // whose samples for a part are known
  {
    std::uint64_t key = UINT64_MAX; // of brick and part
    std::uint64_t state = 0;        // number of the mask state for which they are known
    std::uint64_t first = 0;        // number of its first place
    std::uint32_t count = 0;
    std::array<float, 27> mask{};
  };
  std::size_t indexOf(const core::Index3& brick) const noexcept;
  void markEmpty(const Box& box) noexcept;
  bool isEmpty(const Box& box) const noexcept;
  bool valid(Search& search, Brick& known, std::uint64_t key, const core::Index3& brick) noexcept;
  void addBrick(Search& search, const core::Index3& brick) noexcept;
  void addCell(Search& search, const core::Index3& cell, const Cell& values) noexcept;
  void addUnion(Search& search, const core::Index3& brick, std::size_t n, bool whole) noexcept;
  void addUnionCell(Search& search, const core::Index3& brick, std::size_t n, bool whole,
                    const core::Index3& cell, const std::array<float, 8>& share) noexcept;
  bool inOthers(const Eigen::Vector3d& voxel, std::size_t but) const noexcept;
  bool reaches(const Search& search, const Eigen::Vector3d& middle, double radius) const noexcept;
  bool reachesCell(const Search& search, const core::GridGeometry& grid,
                   const core::Index3& cell) const noexcept;
  void add(Search& search, const Eigen::Vector3d& place) noexcept;
  int linesFor(std::size_t part, const core::GridGeometry& grid, bool flat) const noexcept;

  const HapticField& m_field;
  SolidParts m_parts;
  std::array<List, SolidParts::kParts> m_lists;
  Search m_search; // for a list
  Search m_query;  // whether a pose is free
  // A bit per brick, a word per block of 4^3 bricks. A brick that was tissue throughout before
  // cutting is skipped until it is cut.
  std::vector<std::uint64_t> m_empty; // nothing is left in them
  std::vector<std::uint64_t> m_full;  // tissue throughout before cutting
  core::Index3 m_blocks{};
  // Places of known bricks, the oldest overwritten.
  static constexpr std::size_t kPlaces = std::size_t{1} << 16;
  static constexpr std::size_t kBricks = std::size_t{1} << 13;
  static constexpr std::uint32_t kMaxInBrick = 4096; // with more they are not kept
  std::vector<Eigen::Vector3d> m_places;
  std::uint64_t m_nextPlace = 0; // number
  std::vector<Brick> m_known;    // by a hash of the key
  Brick* m_making = nullptr;     // the brick whose samples are being found
  const volume::MaskState* m_state = nullptr;
  std::uint64_t m_number = 0;
  std::uint64_t m_raises = 0;
  std::size_t m_work = 0; // in units
  bool m_cut = false;     // since the last tick
};

} // namespace petrous::haptics
