#pragma once

#include <memory>
#include <optional>
#include <string>

#include "Context.h"
#include "DrillLog.h"
#include "petrous/Core/TickTimes.h"
#include "petrous/Presenters/StructureDistances.h"

namespace petrous::cli
{

/// Report of `drill`: forces and removal, along a path or in a replay.
class DrillReport
{
public:
  /// radius     of the burr, mm
  /// log        the file of `--log`, or empty
  /// distances  whether the minimum distance of the burr to each labelled structure is computed
  /// Case and scene must outlive this.
  DrillReport(scene::Case& value, session::TouchScene& scene, double radius, const std::string& log,
              bool distances);

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
  bool m_placed = false;  // the device controls the tool
  core::TickTimes m_times;
  double m_force = 0.0;       // N, maximum of all ticks
  double m_torque = 0.0;      // N mm
  double m_penetration = 0.0; // mm
  std::size_t m_inside = 0;   // ticks in which the tool was in tissue throughout
  std::size_t m_shaft = 0;    // ticks in which it pressed on tissue
  std::size_t m_handpiece = 0;
  std::size_t m_heldOff = 0; // drilling ticks with most of the force on these
  std::uint8_t m_holder = 0; // which of them
};

} // namespace petrous::cli
