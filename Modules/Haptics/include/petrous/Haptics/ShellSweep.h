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

/// Largest way of a point of a body, mm: |translation| + arm |rotation|.
inline double maxDisplacement(const Motion& motion, double arm) noexcept
{
  return motion.linear.norm() + arm * motion.angular.norm();
}

class SurfaceSamples;

/// Tests a tool's motion through the tissue field for contact.
///
/// Every point goes along chords of at most `step` voxels. On a chord f is bounded by its steepest
/// slope: a stretch is free when f at both ends is so low that f cannot reach 0 between them, and
/// is halved otherwise, down to h/16. So a wall thinner than the step is met as well as a thick
/// one.
///
/// A tool that is a solid (PointShell::solid) is also tested against samples of the tissue's
/// surface, so that nothing passes between the points of its shell: see src/Shell/SurfaceSamples.h.
///
/// A point that is far from tissue is not looked at again before the tool has moved that far.
/// Nothing here allocates, locks or throws but the constructor. One thread.
class ShellSweep
{
public:
  static constexpr std::size_t kMaxSteps = 64; ///< chords of one sweep

  struct Near ///< a shell point that may meet tissue
  {
    std::uint32_t point = 0;
    FieldSample sample; ///< where the point is now
  };
  static constexpr std::uint32_t kNoPoint = UINT32_MAX;
  struct Hit
  {
    bool any = false;
    double free = 1.0;                        ///< share of the motion before it
    std::uint32_t point = 0;                  ///< the first to enter, or kNoPoint:
    std::uint32_t part = 0;                   ///< of the solid, which is what met
    Eigen::Vector3d place{0.0, 0.0, 0.0};     ///< the tissue's surface there, patient, mm
    Eigen::Vector3d direction{0.0, 0.0, 0.0}; ///< unit, of the tool's way there, patient axes
  };

  ShellSweep(std::shared_ptr<const HapticField> field, PointShell shell, double step,
             int bisections);
  ~ShellSweep();

  const PointShell& shell() const noexcept { return m_shell; }
  const HapticField& field() const noexcept { return *m_field; }

  /// The mask's state for the calls that follow. Where tissue came back since the last one,
  /// `forgetClearances` goes with it.
  void look(const volume::MaskState& state) noexcept;
  void forgetClearances() noexcept;
  const volume::MaskState& state() const noexcept { return *m_state; }

  /// The tool is at `pose`, wherever it was before.
  void moveTo(const Pose& pose) noexcept;
  const Pose& pose() const noexcept { return m_pose; }

  /// Finds the points within `distance` mm of tissue.
  void findNear(double distance) noexcept;

  /// Adds those that a motion of this length (mm, rad) can bring to tissue. The share of the
  /// motion, 0 to 1, that may be made now: the surface's samples that a longer one may meet are
  /// still searched for.
  double addNear(double linear, double angular) noexcept;
  const Near* begin() const noexcept { return m_near.data(); }
  const Near* end() const noexcept { return m_near.data() + m_nearCount; }
  std::size_t nearCount() const noexcept { return m_nearCount; }

  Eigen::Vector3d voxelOf(std::uint32_t point) const noexcept ///< where it is now
  {
    return m_maps[0].linear * m_shell.points[point] + m_maps[0].offset;
  }

  /// Samples of the tissue's surface that were found with the near points.
  const SurfaceSamples& surface() const noexcept { return *m_surface; }

  /// f <= 0 at every point of the shell, and no tissue in the solid. False also where the latter
  /// was not found out at the cost of kMaxQuery.
  static constexpr std::size_t kMaxQuery = 1500; ///< samples of the field
  bool freeAt(const Pose& pose) noexcept;

  /// Depth of the deepest point where the tool stands, or of the tissue that lies deepest in its
  /// solid, mm; 0 where f <= 0 at all. It is that of the
  /// points that were looked at when it came there (the others cannot be in tissue), or of all of
  /// them after `measure`. In the flat inside of tissue, where nothing tells more, the burr's
  /// radius.
  double penetration() const noexcept;

  /// Looks at all points and the solid where the tool stands. Whether it is free; false also where
  /// that was not found out at the cost of `most` (samples of the field), beside the points.
  bool measure(std::size_t most = SIZE_MAX) noexcept;

  /// Moves the tool as far as it goes freely, at most `motion` and at most kMaxSteps chords, and
  /// not beyond the chord at which `samples` reaches `mostSamples`; near points must have been
  /// found for it. f <= 0 at every near point where it comes to stand.
  Hit advance(const Motion& motion, std::size_t maxSamples = SIZE_MAX) noexcept;

  /// What else kept the last motion from going on to where its hit was; `any` is false where
  /// nothing did.
  const Hit& blocker() const noexcept { return m_blocker; }

  /// Samples of the field since the last `look`, distances to the solid at their share: what a tick
  /// costs, whatever the machine.
  std::size_t samples() const noexcept;

  /// What the search for the surface's samples cost, in samples of the field. It has a bound of its
  /// own in each tick (SurfaceSamples::kMaxWork), so that a sweep is not cut short for it.
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
  struct Meeting // a sample of the surface that a motion may bring into the solid
  {
    Eigen::Vector3d place;
    double least;       // mm: no contact while the distance is above
    std::uint32_t part; // of the solid
    std::uint32_t next; // chord at whose end it is looked at again
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
  double m_tolerance;              // share of a chord
  std::vector<double> m_arm;       // mm, of each point from the origin
  std::vector<double> m_clearance; // mm that each point may still go unseen
  std::vector<Near> m_near;
  std::vector<bool> m_isNear;
  std::vector<std::uint32_t> m_wake;
  std::vector<bool> m_known;
  std::size_t m_nearCount = 0;
  mutable std::size_t m_samples = 0;
  mutable std::size_t m_distances = 0; // to the solid
  double m_inside = 0.0;               // mm, as the last `measure` found the solid
  std::array<VoxelMap, kMaxSteps + 1> m_maps;
  std::array<Pose, kMaxSteps + 1> m_poses;
  std::unique_ptr<SurfaceSamples> m_surface;
  std::vector<Meeting> m_meetings;
  std::size_t m_meetingCount = 0;
  mutable const Meeting* m_deepestMeeting = nullptr; // that was not free
  Hit m_blocker;
  const volume::MaskState* m_state = nullptr;
  Pose m_pose;
  double m_deepest = volume::TissueField::kAir; // f, where the tool stands
  std::uint32_t m_deepestPoint = 0;
};

} // namespace petrous::haptics
