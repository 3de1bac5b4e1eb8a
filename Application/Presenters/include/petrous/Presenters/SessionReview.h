#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Dissection/Stroke.h"
#include "petrous/Scene/Case.h"
#include "petrous/Session/SpindleMeter.h"
#include "petrous/Session/TickRecord.h"

namespace petrous::presenters
{

/// The tool at one time of a recording.
struct RecordedTool
{
  double time = 0.0;                         ///< s, since the tool was first placed
  Eigen::Vector3d center{0.0, 0.0, 0.0};     ///< of the burr, patient LPS mm
  Eigen::Vector3d axisToHand{0.0, 0.0, 1.0}; ///< unit
  bool drilling = false;                     ///< the burr turns
  double force = 0.0;                        ///< N, on the hand
  double thrust = 0.0;                       ///< N, of the burr's contacts
  double spindle = 0.0;                      ///< of the set speed, 0 to 1; 0 while it does not turn
};

/// Economy of motion and force of a recording.
struct SessionMetrics
{
  double duration = 0.0;       ///< s
  double drilling = 0.0;       ///< s, while the burr turned
  double path = 0.0;           ///< mm, of the burr's centre, see RecordedCourse::kStep
  double drillingPath = 0.0;   ///< mm, likewise while it turned
  double meanForce = 0.0;      ///< N, on the hand while the burr turned, mean over time
  double maxForce = 0.0;       ///< N, on the hand
  double maxThrust = 0.0;      ///< N
  std::size_t drillStarts = 0; ///< how often the burr was switched on; an interruption
                               ///< (session::isInterruption) is no switch
};

/// Course and metrics of a recording from its ticks, in order. The metrics are those of all ticks;
/// the course is thinned to kRate, with every change of the drill.
class RecordedCourse
{
public:
  static constexpr double kRate = 100.0; ///< Hz
  static constexpr double kStep = 0.05;  ///< mm; what trembles within is no path

  /// Ticks without a valid reading of the device are passed over. True if the tick counts.
  bool add(const session::TickRecord& record);

  const std::vector<RecordedTool>& tools() const noexcept { return m_tools; }
  SessionMetrics metrics() const;
  /// While a burr that was set to `rpm` turned, see SpindleMeter.
  std::optional<dissection::SpindleSpeed> speed(double rpm) const { return m_spindle.speed(rpm); }

private:
  std::vector<RecordedTool> m_tools;
  RecordedTool m_last;
  double m_start = 0.0;                // s
  double m_forceSeconds = 0.0;         // N s, while drilling
  Eigen::Vector3d m_step, m_drillStep; // where the path was last extended
  SessionMetrics m_metrics;
  session::SpindleMeter m_spindle;
  session::TickInput m_lastInput;
  bool m_placed = false;
  bool m_isOn = false; // the drill, interruptions included
};

/// The tool at any time: interpolated, and at both ends as there. None of an empty course.
std::optional<RecordedTool> toolAt(const std::vector<RecordedTool>& course, double time);

/// A recorded session as it is shown beside one's own.
struct SessionReview
{
  struct Structure
  {
    std::string name;
    std::optional<double> nearest; ///< mm, from the burr to its surface; 0: touched
    std::optional<double> removed; ///< mm^3
  };

  std::string tool; ///< "cutting burr 4 mm, 6 degrees of freedom"
  dissection::Burr burr;
  std::optional<dissection::SpindleSpeed> speed; ///< as StrokeInfo::speed
  std::vector<RecordedTool> course;
  SessionMetrics metrics;
  std::vector<Structure> structures; ///< of the case, by name
  std::optional<double> removed; ///< mm^3, by all strokes that stayed, without older ones redone
  std::size_t strokes = 0;       ///< that stayed; only with `removed`
  std::vector<dissection::StrokeInfo> made; ///< those
  std::size_t applied = 0;                  ///< strokes of the case when it began
  std::size_t undone = 0;    ///< of those, that were not at its end; only with `removed`
  std::string whyUnmeasured; ///< why the removed volumes are not known; empty: they are
  std::string warning;       ///< what is missing of the recording, one sentence; or empty
};

/// Reads a recording that was made on that case, or on a copy of it: of another one with the same
/// image. Volumes are measured by repeating the recorded cuts on the dissection as it was when the
/// recording began, if the case has that state, at the threshold of that time; what it redoes there
/// is a stroke of the case, if only one can be meant. `value` is a copy, with its dissection
/// loaded. Takes as long as the case takes to be prepared for a tool.
///
/// Throws RecordingError; InvalidParameter if the recording was made on another image;
/// CancelledError.
SessionReview reviewRecording(const std::filesystem::path& file, scene::Case value,
                              const core::Progress& progress = {});

/// The recordings of one operation, which begins another one with each burr, and what they are
/// together, one after the other without the pauses: times, paths, starts, strokes and volumes are
/// sums, distances minima, forces maxima; the mean force is that over the time drilling. A volume
/// is not known where a part's is not. Strokes of a part that were undone in a later part, or
/// between them, are not counted; nor is one that a later part redoes.
struct OperationReview : SessionReview
{
  struct Part
  {
    std::string name;   ///< of the file
    double begin = 0.0; ///< s, in the course of the whole
    SessionReview review;
  };
  std::vector<Part> parts; ///< in order, at least one
};

/// The whole of `parts`, whose `begin` is set; its burr and tool are the first part's.
OperationReview togetherOf(std::vector<OperationReview::Part> parts);

/// The part at a time of the whole.
const OperationReview::Part& partAt(const OperationReview& review, double time);

/// Reads the recordings of an operation, in order. As reviewRecording; throws InvalidParameter also
/// if there is no file.
OperationReview reviewOperation(const std::vector<std::filesystem::path>& files,
                                const scene::Case& value, const core::Progress& progress = {});

/// As CSV, a row per part and one of the whole, with the nearest distance and the volume removed of
/// each structure as columns.
std::string operationCsv(const OperationReview& review);

/// As CSV: quantity, structure, value, unit.
std::string metricsCsv(const SessionReview& review);

/// As CSV, a row per sample of the course: time, centre and axis of the burr (patient LPS mm),
/// drill, force on the hand, thrust and speed of the spindle.
std::string courseCsv(const SessionReview& review);

/// The same of the whole, with the part's number as last column.
std::string operationCourseCsv(const OperationReview& review);

} // namespace petrous::presenters
