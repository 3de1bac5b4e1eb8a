#pragma once

#include <optional>

#include "petrous/Presenters/DrillSession.h"

namespace petrous::presenters
{

/// A straight line of sight, patient LPS mm.
struct SightLine
{
  Eigen::Vector3d origin{0.0, 0.0, 0.0};
  Eigen::Vector3d direction{0.0, 0.0, 1.0}; ///< unit
};

/// Where the line first meets tissue, mm from its origin; nothing when it passes by.
std::optional<double> firstTissue(const volume::TissueField& field, const SightLine& line);

/// Where a burr that comes along the line first touches tissue: mm from the origin to the burr's
/// centre, never below 0; nothing when it passes by. The ball is felt along 25 parallel lines.
std::optional<double> burrRest(const volume::TissueField& field, const SightLine& line,
                               double radius);

/// Drills with a pointer on the screen: the burr lies on the surface under the pointer, and feeds
/// into the bone along the line of sight while the drill is on, so holding still drills deeper.
///
/// Between two pointer positions the burr is led over the surface in steps of half a radius, first
/// at the height of the higher of two neighbours, so it never ploughs through what stands between.
class PointerDrill
{
public:
  /// `feed` in mm/s, >= 0. The session must outlive this; one thread.
  PointerDrill(DrillSession& session, const dissection::Burr& burr, double feed);

  void begin(const SightLine& line, double seconds, const std::optional<core::CameraPose>& camera);

  /// The pointer's line of sight at time `seconds`; feeds by the time that went by, at most one
  /// radius. True when a voxel changed.
  bool moveTo(const SightLine& line, double seconds);

  /// Null when the stroke changed nothing.
  std::shared_ptr<const dissection::Stroke> end();

  /// The burr's centre; nothing before the pointer met tissue.
  const std::optional<Eigen::Vector3d>& center() const noexcept { return m_center; }

private:
  bool step(const SightLine& line, double feed, double seconds);

  DrillSession& m_session;
  dissection::Burr m_burr;
  double m_feed;
  double m_last = 0.0; ///< s
  std::optional<SightLine> m_line;
  std::optional<double> m_depth; ///< of the burr's centre along the line, mm
  std::optional<Eigen::Vector3d> m_center;
};

} // namespace petrous::presenters
