#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "petrous/Haptics/HapticField.h"
#include "petrous/Haptics/PointShell.h"
#include "petrous/Haptics/Pose.h"

namespace petrous::haptics
{

/// Largest displacement of a point of a body, mm: |translation| + arm |rotation|.
inline double maxDisplacement(const Motion& motion, double arm) noexcept
{
  return motion.linear.norm() + arm * motion.angular.norm();
}

class SurfaceSamples;

/// Tests a tool's motion through the tissue field for contact.
///
/// Every point moves along chords of at most `step` voxels. On a chord f is bounded by its maximum
/// slope: a segment is free if f at both ends is so low that it cannot reach 0 in between, and is
/// halved otherwise, down to h/16. Walls thinner than the step are therefore detected too.
///
/// A tool that is a solid (PointShell::solid) is also tested against samples of the tissue's
/// surface, so that nothing passes between the points of its shell: see src/Shell/SurfaceSamples.h.
///
/// A point far from tissue is not examined again before the tool has moved that far. Only the
/// constructor allocates, locks or throws. Not thread-safe.
class ShellSweep
{
public:
  static constexpr std::size_t kMaxSteps = 64; ///< chords per sweep

  struct Near ///< a shell point that may meet tissue
  {
    std::uint32_t point = 0;
    FieldSample sample; ///< at the point's present position
  };
  static constexpr std::uint32_t kNoPoint = UINT32_MAX;
  struct Hit
  {
    bool any = false;
    double free = 1.0;                        ///< fraction of the motion before it
    std::uint32_t point = 0;                  ///< the first to enter, or kNoPoint:
    std::uint32_t part = 0;                   ///< the part of the solid that made contact
    Eigen::Vector3d place{0.0, 0.0, 0.0};     ///< point of the tissue's surface, patient, mm
    Eigen::Vector3d direction{0.0, 0.0, 0.0}; ///< unit, direction of the tool's motion there,
                                              ///< patient axes
  };

  ShellSweep(std::shared_ptr<const HapticField> field, PointShell shell, double step,
             int bisections);
  ~ShellSweep();

  const PointShell& shell() const noexcept { return m_shell; }
  const HapticField& field() const noexcept { return *m_field; }

  /// Sets the mask state for the following calls. If tissue was restored since the last one, call
  /// `forgetClearances` as well.
  void look(const volume::MaskState& state) noexcept;
  void forgetClearances() noexcept;
  const volume::MaskState& state() const noexcept { return *m_state; }

  /// Sets the tool's pose without a sweep.
  void moveTo(const Pose& pose) noexcept;
  const Pose& pose() const noexcept { return m_pose; }

  /// Finds the points within `distance` mm of tissue.
  void findNear(double distance) noexcept;

  /// Adds those that a motion of this length (mm, rad) can bring to tissue. Returns the fraction of
  /// the motion, 0 to 1, that may be made now: the search for surface samples that a longer one may
  /// meet is not finished.
  double addNear(double linear, double angular) noexcept;
  const Near* begin() const noexcept { return m_near.data(); }
  const Near* end() const noexcept { return m_near.data() + m_nearCount; }
  std::size_t nearCount() const noexcept { return m_nearCount; }

  Eigen::Vector3d voxelOf(std::uint32_t point) const noexcept ///< present position
  {
    return m_maps[0].linear * m_shell.points[point] + m_maps[0].offset;
  }

  /// Surface samples that were found with the near points.
  const SurfaceSamples& surface() const noexcept { return *m_surface; }

  /// f <= 0 at every point of the shell and no tissue in the solid. False also if the latter could
  /// not be determined at the cost of kMaxQuery.
  static constexpr std::size_t kMaxQuery = 1500; ///< field samples
  bool freeAt(const Pose& pose) noexcept;

  /// Depth of the deepest point at the tool's pose, or of the tissue deepest in its solid, mm; 0 if
  /// f <= 0 throughout. Considers the points examined on arrival (the others cannot be in tissue),
  /// or all of them after `measure`. In the flat interior of tissue, where depth cannot be
  /// determined, the burr's radius; NaN for a tool without one that is deeper than a voxel.
  double penetration() const noexcept;

  /// Examines all points and the solid at the present pose. Returns whether the tool is free; false
  /// also if that could not be determined at the cost of `most` (field samples), not counting the
  /// points.
  bool measure(std::size_t most = SIZE_MAX) noexcept;

  /// Moves the tool as far as it is free, at most by `motion` and kMaxSteps chords, and not beyond
  /// the chord at which `samples` reaches `maxSamples`; near points must have been found for it. At
  /// the final pose f <= 0 at every near point.
  Hit advance(const Motion& motion, std::size_t maxSamples = SIZE_MAX) noexcept;

  /// What else kept the last motion from reaching its hit; `any` is false if nothing did.
  const Hit& blocker() const noexcept { return m_blocker; }

  /// Field samples since the last `look`, distances to the solid included pro rata: the cost of a
  /// tick, independent of the machine.
  std::size_t samples() const noexcept;

  /// Cost of the search for surface samples, in field samples. It has a bound of its own per tick
  /// (SurfaceSamples::kMaxWork), so that it does not cut a sweep short.
  std::size_t surfaceSamples() const noexcept;

private:
  struct VoxelMap // of a point in frame T: linear * p + offset
  {
    Eigen::Matrix3d linear;
    Eigen::Vector3d offset;
  };
  void judge(std::size_t point, double way) noexcept;
  VoxelMap mapOf(const Pose& pose) const noexcept;
  FieldSample sampleAt(const Eigen::Vector3d& voxel) const noexcept
  {
    ++m_samples;
    return m_field->sample(voxel, *m_state);
  }
  double firstInside(const Eigen::Vector3d& from, const FieldSample& atFrom,
                     const Eigen::Vector3d& to, const FieldSample& atTo,
                     double limit) const noexcept;
  struct Meeting // a surface sample that a motion may bring into the solid
  {
    Eigen::Vector3d place;
    double least;       // mm: no contact while the distance is above
    std::uint32_t part; // of the solid
    std::uint32_t next; // chord at whose end it is examined again
  };
  void findMeetings(const Motion& motion) noexcept;
  double distanceAt(const Meeting& meeting, const Pose& pose) const noexcept;
  std::uint32_t chordsTo(const Meeting& meeting, double distance, double linear,
                         double angular) const noexcept;
  void meet(std::uint32_t s, const Motion& motion, double perStep, double& best, Hit& hit) noexcept;
  Hit hitOf(const Meeting& meeting, const Pose& pose, const Motion& motion) const noexcept;
  bool meetingsFreeAt(const Pose& pose) const noexcept;
  bool nearFreeAt(const Pose& pose) noexcept;
  void deepen(double value, std::uint32_t point) noexcept
  {
    if (value > m_deepest)
    {
      m_deepest = value;
      m_deepestPoint = point;
    }
  }
  void commit(const Motion& motion, double share) noexcept;

  std::shared_ptr<const HapticField> m_field;
  PointShell m_shell;
  double m_step;                   // mm
  double m_tolerance;              // fraction of a chord
  std::vector<double> m_arm;       // mm, of each point from the origin
  std::vector<double> m_clearance; // mm that each point may still move unexamined
  std::vector<Near> m_near;
  std::vector<bool> m_isNear;
  std::vector<std::uint32_t> m_wake;
  std::vector<bool> m_known;
  std::size_t m_nearCount = 0;
  mutable std::size_t m_samples = 0;
  mutable std::size_t m_distances = 0; // to the solid
  double m_inside = 0.0;               // mm, solid's depth as of the last `measure`
  std::array<VoxelMap, kMaxSteps + 1> m_maps;
  std::array<Pose, kMaxSteps + 1> m_poses;
  std::unique_ptr<SurfaceSamples> m_surface;
  std::vector<Meeting> m_meetings;
  std::size_t m_meetingCount = 0;
  mutable const Meeting* m_deepestMeeting = nullptr; // the one that was not free
  Hit m_blocker;
  const volume::MaskState* m_state = nullptr;
  Pose m_pose;
  double m_deepest = volume::TissueField::kAir; // f, at the tool's pose
  std::uint32_t m_deepestPoint = 0;
};

} // namespace petrous::haptics
