#include "DrillLog.h"

#include <limits>

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

void write(std::string& row, const session::PoseValues& pose)
{
  write(row, pose.position);
  write(row, pose.rotation);
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
  std::vector<std::size_t> bricks;
  for (std::size_t n = 0; n < now.brickCount(); ++n)
    if (now.brick(n) != m_before.brick(n))
      bricks.push_back(n);
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
  write(m_rows, record.mapped);
  write(m_rows, record.proxy);
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

} // namespace petrous::cli
