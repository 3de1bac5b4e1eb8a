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

/// Samples of the tissue's surface round a tool that is a solid: tissue against the tool, where a
/// point shell is the tool against the tissue. What is thinner than a shell's spacing (a plate on
/// edge, a ridge, a spike) cannot pass between its points, but it has samples of its own.
///
/// The samples are where lines parallel to the grid's axes cross f = 0. Along such a line each
/// operand of f is linear in a cell, so each sample lies on the interpolated surface; a union whose
/// voxels are not the CT's has lines in its own cells. A cell has the lines along its edges where
/// its surface is about flat, and 2 x 2 or more a side where it bulges or the tool is thin. They
/// depend on the field alone and not on the tool, so a pose that is free of them stays free however
/// often they are found again.
///
/// Samples are found for some way around the tool (`margin`) and kept until the tool has made that
/// way. What finding them may cost in a tick is bounded: a search goes on in the ticks that follow,
/// beside the samples that are known, and where they are many it makes do with a smaller margin. So
/// the tool may have to wait, but it never goes where nothing was looked for. A search begins
/// before the known samples are used up, and after a cut: until it ends they hold more tissue than
/// there is, never less. Only the constructor allocates; nothing locks or throws. One thread.
class SurfaceSamples
{
public:
  static constexpr double kTolerance = 1e-6; ///< mm, in the solid: no contact yet

  /// The field must outlive this.
  SurfaceSamples(const HapticField& field, const ToolSolid& solid);

  bool any() const noexcept { return m_parts.has(SolidParts::kBall); }
  const SolidParts& parts() const noexcept { return m_parts; }

  /// The mask's state for the calls that follow.
  void look(const volume::MaskState& state) noexcept;

  /// The tool is at `pose`, wherever it was before.
  void forget() noexcept;

  /// The tool moved to `pose`.
  void moved(const Pose& pose) noexcept;

  /// Searches for every sample that a motion of so much (mm, rad) from `pose`, and `beyond` mm
  /// more, can reach. The share of the motion, 0 to 1, for which all are known now.
  double find(const Pose& pose, double linear, double angular, double beyond) noexcept;

  /// The first so many samples of a part hold all that were found within `distance` mm of it now.
  std::size_t within(std::size_t part, double distance) const noexcept;
  const Eigen::Vector3d& place(std::size_t part, std::size_t n) const noexcept ///< patient, mm
  {
    return m_lists[part].places[n];
  }

  /// The arm, mm, on which a sample that was found can turn about the tool's origin.
  double arm(std::size_t part) const noexcept { return m_parts.reach(part) + m_lists[part].margin; }

  /// Depth of the deepest sample that was found, in the tool at `pose`, mm; 0 where none is deeper
  /// than the tolerance.
  double depth(const Pose& pose) const noexcept;

  /// Depth of a sample that is deeper than the tolerance in the tool at `pose`, mm; 0 where there
  /// is none; nothing where that was not found out at the cost of `most` (in samples of the field).
  std::optional<double> insideAt(const Pose& pose, std::size_t most) noexcept;

  /// What finding cost since the last `look`, in samples of the field. `find` costs at most
  /// kMaxWork (and kMaxAfterCut) and what one brick costs.
  std::size_t samples() const noexcept { return m_work / kUnit; }

  static constexpr std::size_t kMaxSamples = 16384; ///< of a part
  static constexpr std::size_t kMaxWork = 1000;     ///< of `find` in a tick, samples of the field
  /// As much more after a cut, so that the burr mostly goes on in the tick that feels it.
  static constexpr std::size_t kMaxAfterCut = 3000;
  static constexpr std::size_t kUnit = 8; ///< distances to the tool, for one such sample

private:
  static constexpr std::size_t kBins = 64;
  struct List
  {
    std::vector<Eigen::Vector3d> places;          // patient, mm, in bins, the nearest first
    std::array<std::uint32_t, kBins + 1> first{}; // of each bin
    Pose pose;                                    // at which they were found
    double margin = 0.0;                          // mm within which all were found
    double made = 0.0;                            // mm of a sample in the tool since, at most
    double wish = 0.0;                            // mm, the margin of the next search
    bool known = false;
    bool cut = false; // the mask changed since they were found
    int age = 0;      // ticks since then

    double left() const noexcept { return known ? margin - made : -1.0; }
  };
  struct Box // of bricks, half open
  {
    core::Index3 lower, upper;
  };
  struct Search // round a part at a pose
  {
    std::size_t part = 0;
    Pose pose;
    Eigen::Matrix3d toTool = Eigen::Matrix3d::Identity();
    double margin = 0.0;
    double least = 0.0; // of the margin, mm
    double made = 0.0;
    double deepest = 0.0; // where inside
    bool inside = false;  // only whether anything is in the tool
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
  void addBrick(Search& search, const core::Index3& brick) noexcept;
  void addCell(Search& search, const core::Index3& cell, const Cell& values) noexcept;
  void addUnion(Search& search, const core::Index3& brick, std::size_t n, bool whole) noexcept;
  void addUnionCell(Search& search, const core::Index3& brick, std::size_t n, bool whole,
                    const core::Index3& cell, const std::array<float, 8>& share) noexcept;
  bool inOthers(const Eigen::Vector3d& voxel, std::size_t but) const noexcept;
  bool reaches(const Search& search, const Eigen::Vector3d& middle, double radius) const noexcept;
  void add(Search& search, const Eigen::Vector3d& place) noexcept;
  int linesFor(std::size_t part, const core::GridGeometry& grid, bool flat) const noexcept;

  const HapticField& m_field;
  SolidParts m_parts;
  std::array<List, SolidParts::kParts> m_lists;
  Search m_search; // for a list
  Search m_query;  // whether a tool is free
  // Bits of bricks. What is tissue everywhere before it is cut needs no look while nothing is.
  std::vector<std::uint64_t> m_empty; // nothing is left in them
  std::vector<std::uint64_t> m_full;  // uncut they are tissue everywhere
  const volume::MaskState* m_state = nullptr;
  std::uint64_t m_number = 0;
  std::uint64_t m_raises = 0;
  std::size_t m_work = 0; // in units
  bool m_cut = false;     // since the last tick
};

} // namespace petrous::haptics
