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

/// What `drill` says of what was felt and cut, be it along a path or played again.
class DrillReport
{
public:
  /// radius     of the burr, mm
  /// log        the file of `--log`, or empty
  /// distances  how near the burr comes to each labelled structure is asked for
  /// Case and scene must outlive this.
  DrillReport(scene::Case& value, presenters::TouchScene& scene, double radius,
              const std::string& log, bool distances);

  /// The servo's tick, timed.
  template <typename Call>
  const simulation::TickRecord& feel(Call call)
  {
    return m_times.take(call);
  }

  /// The tick, once what follows it in the tissue is done. `removal`: where a law is at work.
  void add(const simulation::TickRecord& record, const std::optional<TickRemoval>& removal = {});

  /// After the last tick: closes the log.
  void close();

  /// Something was cut, taken back or brought back.
  bool changed() const;

  /// The report in words, and its JSON object.
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
  std::size_t m_position; // when it began
  std::size_t m_before;   // strokes there were then
  bool m_placed = false;  // the hand has taken up the tool
  core::TickTimes m_times;
  double m_force = 0.0;       // N, the hardest of all ticks
  double m_torque = 0.0;      // N mm
  double m_penetration = 0.0; // mm
  std::size_t m_inside = 0;   // ticks of which the tool spent the whole in tissue
  std::size_t m_shaft = 0;    // ticks in which it pressed on tissue
  std::size_t m_handpiece = 0;
  std::size_t m_heldOff = 0; // ticks of drilling in which they carried most of the force
  std::uint8_t m_holder = 0; // then
};

} // namespace petrous::cli
