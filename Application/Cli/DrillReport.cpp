#include "DrillReport.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "CaseJson.h"
#include "Numbers.h"
#include "petrous/Core/NumberText.h"

namespace petrous::cli
{

namespace
{

constexpr std::size_t kFlush = std::size_t{1} << 20; // bytes

std::string number(double value)
{
  return core::generalText(value, std::numeric_limits<double>::max_digits10);
}

template <std::size_t count>
void write(std::string& row, const double (&values)[count])
{
  for (const double value : values)
    row += "," + number(value);
}

void write(std::string& row, const session::PoseValues& pose, bool isKnown)
{
  if (!isKnown)
    row += ",nan,nan,nan,nan,nan,nan,nan";
  else
  {
    write(row, pose.position);
    write(row, pose.rotation);
  }
}

void write(std::string& row, const session::WrenchValues& wrench)
{
  write(row, wrench.force);
  write(row, wrench.torque);
}

// A bad place for the log is a bad argument of `drill`.
template <class Action>
auto asParameter(const Action& action)
{
  try
  {
    return action();
  }
  catch (const core::OutputFileError& error)
  {
    throw core::InvalidParameter(error.what());
  }
}

} // namespace

DrillLog::DrillLog(const std::filesystem::path& file, const scene::Case& value,
                   session::TouchScene& scene)
  : m_file(asParameter([&] { return core::OutputFile(file); }))
  , m_case(value)
  , m_scene(scene)
  , m_before(value.dissection.mask())
{
  m_rows = "t_s,dx_mm,dy_mm,dz_mm,dqw,dqx,dqy,dqz,px_mm,py_mm,pz_mm,pqw,pqx,pqy,pqz,"
           "fx_n,fy_n,fz_n,tx_nmm,ty_nmm,tz_nmm,ox_n,oy_n,oz_n,otx_nmm,oty_nmm,otz_nmm,"
           "contacts,thrust_n,r_mm,theta_rad,penetration_mm,removed_mm3,predicted_mm3\n";
}

void DrillLog::measure()
{
  const volume::CutMask& now = m_case.dissection.mask();
  const auto bricks = dissection::changedBricks(m_before, now);
  if (bricks.empty())
    return;
  m_removed += dissection::measureRemoved(m_scene.drill().field(), m_before, now, bricks, {}).total;
  m_before = now;
}

void DrillLog::add(const session::TickRecord& record, const std::optional<TickRemoval>& removal)
{
  if (!removal)
    measure();
  m_rows += number(record.time());
  const bool isKnown = session::hasToolPose(record);
  write(m_rows, record.mapped, isKnown);
  write(m_rows, record.proxy, isKnown);
  write(m_rows, record.wrench);
  write(m_rows, record.output);
  m_rows += "," + std::to_string(record.contacts);
  write(m_rows, {Eigen::Map<const Eigen::Vector3d>(record.burrForce).norm(),
                 removal ? removal->arm : record.contactRadius, record.elevation,
                 record.penetration, removal ? removal->removed : m_removed});
  m_rows += "," + (removal ? number(removal->predicted) : "nan") + "\n";
  if (m_rows.size() >= kFlush)
    flush();
}

void DrillLog::flush()
{
  asParameter([this] { m_file.write(m_rows); });
  m_rows.clear();
}

void DrillLog::close()
{
  flush();
  asParameter([this] { m_file.commit(); });
}

DrillReport::DrillReport(scene::Case& value, session::TouchScene& scene,
                         const presenters::MeasuredTool& tool, const std::string& log,
                         bool distances)
  : m_case(value)
  , m_position(value.dissection.history().position())
  , m_before(value.dissection.strokes().size())
  , m_cuts(!tool.isInstrument())
{
  if (!log.empty())
    m_log.emplace(log, value, scene);
  if (distances && !(value.labels.empty() && value.meshes.empty()))
    m_distances.emplace(value, tool);
}

void DrillReport::add(const session::TickRecord& record, const std::optional<TickRemoval>& removal)
{
  const haptics::Wrench wrench = record.wrench.wrench();
  m_force = std::max(m_force, wrench.linear.norm());
  m_torque = std::max(m_torque, wrench.angular.norm());
  if (std::isnan(record.penetration) || record.penetration > m_penetration)
    m_penetration = record.penetration; // NaN stays
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
  if (m_distances && session::hasToolPose(record))
    m_distances->add(record.proxy.pose());
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
                 (m_cuts ? " ticks: there nothing is felt, and the drill takes what the burr sweeps"
                         : " ticks: there nothing is felt"));
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
