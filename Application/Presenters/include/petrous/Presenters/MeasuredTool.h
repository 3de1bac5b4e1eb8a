#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "petrous/Haptics/PointShell.h"
#include "petrous/Haptics/Pose.h"

namespace petrous::presenters
{

/// From where on a tool distances to structures are measured: a burr's ball, or the points of an
/// instrument's surface. Immutable; thread-safe.
class MeasuredTool
{
public:
  explicit MeasuredTool(double radius); ///< mm, of a burr about the origin of frame T

  /// The points that are felt, in a tree of balls: some hundred of 2,000 are looked up.
  explicit MeasuredTool(const haptics::PointShell& instrument);

  bool isInstrument() const noexcept { return !m_parts.empty(); }

  /// Signed distance of a patient point from a surface, mm, negative inside; clamped to `most`.
  using Surface = std::function<double(const Eigen::Vector3d& patient, double most)>;

  struct Distance
  {
    double millimetres = 0.0; ///< of the ball, or of the nearest point; 0 or less: reaches it
    double sampling = 0.0;    ///< mm by which a place between the points may be nearer
  };

  /// For a tool at X_PT. Beyond `most`, mm, the result is at least that. Of a tool that reaches the
  /// surface it is not told how deep.
  ///
  /// bound   at most what `surface` gives, and cheaper: tells which points of an instrument need no
  ///         look-up; without it `surface` does. The result is the same
  Distance distance(const haptics::Pose& pose, const Surface& surface, double most,
                    const Surface& bound = {}) const;

  double sampling() const noexcept;                 ///< mm, the largest possible Distance::sampling
  double reach() const noexcept { return m_reach; } ///< mm, of what is measured from the origin

private:
  struct Ball
  {
    Eigen::Vector3d center{0.0, 0.0, 0.0}; // frame T, mm
    double radius = 0.0;
    std::size_t begin = 0, end = 0; // of the points
    std::size_t halves = 0;         // the first of two in Part::balls; 0: none
  };
  struct Part // points of one spacing
  {
    std::vector<Eigen::Vector3d> points;
    std::vector<Ball> balls; // the first one has all
    double spacing = 0.0;    // mm, see PointShell
  };
  static Part partOf(std::vector<Eigen::Vector3d> points, double spacing);
  static void divide(Part& part, std::size_t ball);

  double m_radius = 0.0; // mm; 0: an instrument's
  double m_reach = 0.0;
  std::vector<Part> m_parts; // the tip's points first, which have the smaller spacing
};

} // namespace petrous::presenters
