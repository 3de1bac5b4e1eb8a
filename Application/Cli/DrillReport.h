#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "Context.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Core/TickTimes.h"
#include "petrous/Dissection/RemovedVolume.h"
#include "petrous/Presenters/StructureDistances.h"
#include "petrous/Session/TickRecord.h"
#include "petrous/Session/TouchScene.h"

namespace petrous::cli
{

/// Output of the removal laws for a tick.
struct TickRemoval
{
  double arm = 0.0;     ///< mm, distance of the contact from the spindle axis, as used by the law;
                        ///< NaN: no burr
  double removed = 0.0; ///< mm^3 so far, including what was swept
  double predicted = 0.0; ///< mm^3 so far
};

/// `drill --log`: one row per tick. Without a removal law (a replay), the removed volume is
/// measured tick by tick, which is slow. The file appears with `close`, whole.
class DrillLog
{
public:
  /// Throws InvalidParameter naming the file if it cannot be written.
  DrillLog(const std::filesystem::path& file, const scene::Case& value, session::TouchScene& scene);

  void add(const session::TickRecord& record, const std::optional<TickRemoval>& removal);

  /// Throws InvalidParameter if not everything could be written.
  void close();

private:
  void measure();
  void flush();

  core::OutputFile m_file;
  std::string m_rows; // not yet in the file
  const scene::Case& m_case;
  session::TouchScene& m_scene;
  volume::CutMask m_before;
  double m_removed = 0.0; // mm^3
};

/// Report of `drill`: forces and removal, along a path or in a replay.
class DrillReport
{
public:
  /// radius     of the burr, mm; 0: an instrument, whose tip counts, and which removes nothing
  /// log        the file of `--log`, or empty
  /// distances  whether the minimum distance of the burr to each labelled structure is computed
  /// Case and scene must outlive this.
  DrillReport(scene::Case& value, session::TouchScene& scene, const presenters::MeasuredTool& tool,
              const std::string& log, bool distances);

  /// The servo's tick, timed.
  template <typename Call>
  const session::TickRecord& feel(Call call)
  {
    return m_times.take(call);
  }

  /// Adds the tick, after its effect on the tissue. `removal`: if a removal law is in use.
  void add(const session::TickRecord& record, const std::optional<TickRemoval>& removal = {});

  /// Call after the last tick: closes the log.
  void close();

  /// Whether something was removed, undone or redone.
  bool changed() const;

  /// The report as text, and as a JSON object.
  void print(const Context& context) const;
  nlohmann::json json();

private:
  struct Cut
  {
    std::size_t strokes = 0;
    double removed = 0.0; // mm^3
    std::size_t bytes = 0;
    std::map<std::string, double> structures; // mm^3
  };
  Cut cut() const;

  scene::Case& m_case;
  std::optional<DrillLog> m_log;
  std::optional<presenters::StructureDistances> m_distances;
  std::size_t m_position; // at the start
  std::size_t m_before;   // number of strokes at the start
  bool m_cuts;            // the tool is a burr
  core::TickTimes m_times;
  double m_force = 0.0;       // N, maximum of all ticks
  double m_torque = 0.0;      // N mm
  double m_penetration = 0.0; // mm; NaN (null in JSON): unknown, as of a tick
  std::size_t m_inside = 0;   // ticks in which the tool was in tissue throughout
  std::size_t m_shaft = 0;    // ticks in which it pressed on tissue
  std::size_t m_handpiece = 0;
  std::size_t m_heldOff = 0; // drilling ticks with most of the force on these
  std::uint8_t m_holder = 0; // which of them
};

} // namespace petrous::cli
