#include "DrillLog.h"

#include <limits>

#include "petrous/Core/OutputFile.h"

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

} // namespace

DrillLog::DrillLog(const std::filesystem::path& file, const scene::Case& value,
                   session::TouchScene& scene)
  : m_name(file.string())
  , m_file(core::outputTarget(file))
  , m_case(value)
  , m_scene(scene)
  , m_before(value.dissection.mask())
{
  if (!m_file)
    throw core::InvalidParameter(m_name + ": cannot be written");
  m_file.imbue(std::locale::classic());
  m_file.precision(std::numeric_limits<double>::max_digits10);
  m_file << "t_s,dx_mm,dy_mm,dz_mm,dqw,dqx,dqy,dqz,px_mm,py_mm,pz_mm,pqw,pqx,pqy,pqz,"
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
  m_file << record.time();
  write(m_file, record.mapped);
  write(m_file, record.proxy);
  write(m_file, record.wrench);
  write(m_file, record.output);
  const double thrust = Eigen::Map<const Eigen::Vector3d>(record.burrForce).norm();
  m_file << ',' << record.contacts << ',' << thrust << ','
         << (removal ? removal->arm : record.contactRadius) << ',' << record.elevation << ','
         << record.penetration << ',' << (removal ? removal->removed : m_removed) << ',';
  if (removal)
    m_file << removal->predicted << '\n';
  else
    m_file << "nan\n";
}

void DrillLog::close()
{
  m_file.close();
  if (!m_file)
    throw core::InvalidParameter(m_name + ": could not be written to the end; is the disk full?");
}

} // namespace petrous::cli
