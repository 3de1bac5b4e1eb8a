#include "DrillLog.h"

#include <limits>

namespace petrous::cli
{

namespace
{

template <std::size_t count>
void write(std::ostream& stream, const double (&values)[count])
{
  for (const double value : values)
    stream << ',' << value;
}

void write(std::ostream& stream, const session::PoseValues& pose)
{
  write(stream, pose.position);
  write(stream, pose.rotation);
}

void write(std::ostream& stream, const session::WrenchValues& wrench)
{
  write(stream, wrench.force);
  write(stream, wrench.torque);
}

constexpr std::streamoff kFlush = std::streamoff{1} << 20; // bytes

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
  m_rows.imbue(std::locale::classic());
  m_rows.precision(std::numeric_limits<double>::max_digits10);
  m_rows << "t_s,dx_mm,dy_mm,dz_mm,dqw,dqx,dqy,dqz,px_mm,py_mm,pz_mm,pqw,pqx,pqy,pqz,"
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
  m_rows << record.time();
  write(m_rows, record.mapped);
  write(m_rows, record.proxy);
  write(m_rows, record.wrench);
  write(m_rows, record.output);
  const double thrust = Eigen::Map<const Eigen::Vector3d>(record.burrForce).norm();
  m_rows << ',' << record.contacts << ',' << thrust << ','
         << (removal ? removal->arm : record.contactRadius) << ',' << record.elevation << ','
         << record.penetration << ',' << (removal ? removal->removed : m_removed) << ',';
  if (removal)
    m_rows << removal->predicted << '\n';
  else
    m_rows << "nan\n";
  if (m_rows.tellp() >= kFlush)
    flush();
}

void DrillLog::flush()
{
  asParameter([this] { m_file.write(m_rows.str()); });
  m_rows.str({});
}

void DrillLog::close()
{
  flush();
  asParameter([this] { m_file.commit(); });
}

} // namespace petrous::cli
