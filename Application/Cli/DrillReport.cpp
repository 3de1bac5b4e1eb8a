#include "DrillReport.h"

#include <algorithm>

#include "CaseJson.h"
#include "Numbers.h"

namespace petrous::cli
{

DrillReport::DrillReport(scene::Case& value, session::TouchScene& scene, double radius,
                         const std::string& log, bool distances)
  : m_case(value)
  , m_position(value.dissection.history().position())
  , m_before(value.dissection.strokes().size())
{
  if (!log.empty())
    m_log.emplace(log, value, scene);
  if (distances && !(value.labels.empty() && value.meshes.empty()))
    m_distances.emplace(value, radius);
}

void DrillReport::add(const session::TickRecord& record, const std::optional<TickRemoval>& removal)
{
  const haptics::Wrench wrench = record.wrench.wrench();
  m_force = std::max(m_force, wrench.linear.norm());
  m_torque = std::max(m_torque, wrench.angular.norm());
  m_penetration = std::max(m_penetration, record.penetration);
  m_shaft += (record.held & session::TickRecord::kShaft) != 0;
  m_handpiece += (record.held & session::TickRecord::kHandpiece) != 0;
  if (session::isHeldOff(record))
  {
    ++m_heldOff;
    m_holder |= record.held;
  }
  m_inside += record.status == static_cast<std::uint8_t>(haptics::ProxyStatus::Inside);
  if (m_log)
    m_log->add(record, removal);
  using session::ServoFault;
  const auto fault = static_cast<ServoFault>(record.fault);
  m_placed = m_placed || (fault != ServoFault::Device && fault != ServoFault::Clock &&
                          fault != ServoFault::Parameters);
  if (m_distances && m_placed)
    m_distances->add(record.proxy.pose().position);
}

void DrillReport::close()
{
  if (m_log)
    m_log->close();
}

bool DrillReport::changed() const
{
  return m_case.dissection.history().position() != m_position ||
         m_case.dissection.strokes().size() != m_before;
}

// Of the strokes made here that are applied.
DrillReport::Cut DrillReport::cut() const
{
  Cut result;
  const dissection::History& history = m_case.dissection.history();
  for (const std::size_t n : history.lineTo(history.position()))
  {
    if (n < m_before)
      continue;
    const dissection::Stroke& stroke = *m_case.dissection.strokes()[n];
    ++result.strokes;
    result.removed += stroke.info.removed;
    result.bytes += stroke.bytes;
    for (const auto& structure : stroke.info.structures)
      result.structures[structure.name] += structure.volume;
  }
  return result;
}

void DrillReport::print(const Context& context) const
{
  const Cut result = cut();
  if (m_inside > 0)
    context.warn("the tool stood in tissue for " + std::to_string(m_inside) +
                 " ticks: there nothing is felt, and the drill takes what the burr sweeps");
  if (m_heldOff > 0)
    context.warn(session::holderToString(m_holder) + " lay on tissue and held the burr off for " +
                 std::to_string(m_heldOff) +
                 " ticks of drilling: give the tool another angle or more room");
  context.print(std::to_string(result.strokes) +
                (result.strokes == 1 ? " stroke, " : " strokes, ") + fixed(result.removed, 2) +
                " mm3 removed in " + std::to_string(m_times.count()) + " ticks");
  for (const auto& [name, volume] : result.structures)
    context.print("  of '" + name + "': " + fixed(volume, 2) + " mm3");
}

nlohmann::json DrillReport::json()
{
  const Cut result = cut();
  nlohmann::json structures = nlohmann::json::array();
  for (const auto& [name, volume] : result.structures)
    structures.push_back({{"label", name}, {"volume_mm3", volume}});
  nlohmann::json distances = nlohmann::json::object();
  if (m_distances)
    for (const auto& [name, distance] : m_distances->smallest())
      distances[name] = distance;
  auto resources = residentResources(m_case);
  if (m_distances)
    resources.merge(m_distances->resources());
  const auto micros = [](const auto& within) -> nlohmann::json
  {
    return {{"p50", 1e6 * within(0.5)},
            {"p99", 1e6 * within(0.99)},
            {"p999", 1e6 * within(0.999)},
            {"max", 1e6 * within(1.0)}};
  };
  return {{"case", m_case.name},
          {"ticks", m_times.count()},
          {"strokes", result.strokes},
          {"removed_mm3", result.removed},
          {"max_penetration_mm", m_penetration},
          {"max_force_n", m_force},
          {"max_torque_nmm", m_torque},
          {"ticks_inside", m_inside},
          {"held_by_shaft_ticks", m_shaft},
          {"held_by_handpiece_ticks", m_handpiece},
          {"held_off_ticks", m_heldOff},
          {"structures_touched", std::move(structures)},
          {"min_distance_mm", std::move(distances)},
          {"undo_bytes", result.bytes},
          {"tick_us", micros([this](double share) { return m_times.processor(share); })},
          {"tick_wall_us", micros([this](double share) { return m_times.wall(share); })},
          {"resources", std::move(resources)}};
}

} // namespace petrous::cli
