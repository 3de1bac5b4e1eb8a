#pragma once

#include <array>
#include <cstdint>
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
/// Samples are found for some way around the tool and kept until the tool has made that way. After
/// a cut those of the ball are found again at once, the others some ticks later: they hold more
/// tissue than there is, never less. Only the constructor allocates; nothing locks or throws. One
/// thread.
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

  /// The tool moved.
  void moved(double linear, double angular) noexcept;

  /// Every sample that a motion of so much (mm, rad) from `pose`, and `beyond` mm more, can reach
  /// is found after this.
  void find(const Pose& pose, double linear, double angular, double beyond) noexcept;

  /// All those inside the tool are found too.
  void findInside(const Pose& pose) noexcept;

  std::size_t count(std::size_t part) const noexcept { return m_lists[part].count; }
  const Eigen::Vector3d& place(std::size_t part, std::size_t n) const noexcept ///< patient, mm
  {
    return m_lists[part].places[n];
  }

  /// Depth of the deepest sample that was found, in the tool at `pose`, mm; 0 where none is deeper
  /// than the tolerance.
  double depth(const Pose& pose) const noexcept;

  /// No sample is deeper than the tolerance; samples need not have been found there.
  bool freeAt(const Pose& pose) noexcept;

  /// What finding cost since the last `look`, in samples of the field.
  std::size_t samples() const noexcept { return m_samples; }

private:
  struct List
  {
    std::vector<Eigen::Vector3d> places; // patient, mm
    std::size_t count = 0;
    double left = -1.0; // mm that the part may still move; below 0: the samples are not known
    bool cut = false;   // the mask changed since they were found
    int age = 0;        // ticks since then

    void forget() noexcept
    {
      count = 0;
      left = -1.0;
      cut = false;
      age = 0;
    }
  };

  struct Search // round a part at a pose
  {
    std::size_t part;
    Pose pose;
    Eigen::Matrix3d toTool;
    double margin;
    bool inside;
  };
  struct Cell; // operands at a cell's corners
  void gather(std::size_t part, const Pose& pose, double margin, bool inside) noexcept;
  void addBrick(const Search& search, const core::Index3& brick) noexcept;
  void addCell(const Search& search, const core::Index3& cell, const Cell& values) noexcept;
  void addUnion(const Search& search, const core::Index3& brick, std::size_t n,
                bool whole) noexcept;
  void addUnionCell(const Search& search, const core::Index3& brick, std::size_t n, bool whole,
                    const core::Index3& cell, const std::array<float, 8>& share) noexcept;
  bool inOthers(const Eigen::Vector3d& voxel, std::size_t but) const noexcept;
  bool reaches(const Search& search, const Eigen::Vector3d& middle, double radius) const noexcept;
  void add(const Search& search, const Eigen::Vector3d& place) noexcept;
  int linesFor(std::size_t part, const core::GridGeometry& grid, bool flat) const noexcept;

  const HapticField& m_field;
  SolidParts m_parts;
  double m_extra; // mm, beyond what is asked for
  std::array<List, SolidParts::kParts> m_lists;
  std::vector<std::uint64_t> m_empty; // bits: bricks in which nothing is left
  const volume::MaskState* m_state = nullptr;
  std::uint64_t m_number = 0;
  std::uint64_t m_raises = 0;
  std::size_t m_samples = 0;
};

} // namespace petrous::haptics
