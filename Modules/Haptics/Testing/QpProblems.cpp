#include "QpProblems.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace petrous::haptics::testing
{

namespace
{

using Vector6 = QpProblem::Vector6;

Vector6 six(const Eigen::Vector3d& linear, const Eigen::Vector3d& angular)
{
  Vector6 row;
  row << linear, angular;
  return row;
}

} // namespace

void QpProblem::add(const Vector6& row, double bound, int spring)
{
  rows.push_back(row);
  bounds.push_back(bound);
  springs.push_back(spring);
}

void QpProblem::addContact(const Eigen::Vector3d& n, const Eigen::Vector3d& r, double gap,
                           int spring)
{
  add(six(n, r.cross(n)), -gap, spring);
}

bool QpProblem::isSoft() const
{
  return std::any_of(springs.begin(), springs.end(), [](int spring) { return spring != kRigid; });
}

void QpProblem::fill(ProxyQp& qp) const
{
  qp.clear();
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (springs[i] == kRigid)
      qp.add(rows[i], bounds[i]);
    else
      qp.addSoft(rows[i], bounds[i], static_cast<std::size_t>(springs[i]),
                 std::sqrt(complianceOf(i)));
}

ProxyQp solverOf(const QpProblem& problem)
{
  ProxyQp qp(problem.rows.size() + 1, problem.stiffness, problem.isSoft());
  problem.fill(qp);
  return qp;
}

std::string nameOf(QpFamily family)
{
  switch (family)
  {
  case QpFamily::Random:
    return "random";
  case QpFamily::BurrPatch:
    return "burr patch";
  case QpFamily::Duplicates:
    return "duplicates";
  case QpFamily::Coplanar:
    return "coplanar";
  case QpFamily::Wedge:
    return "wedge";
  case QpFamily::Hole:
    return "hole";
  case QpFamily::Identical:
    return "identical";
  case QpFamily::Lattice:
    return "lattice";
  case QpFamily::Violated:
    return "violated";
  case QpFamily::Soft:
    return "soft";
  case QpFamily::SoftPatch:
    return "soft patch";
  case QpFamily::Slit:
    return "slit";
  case QpFamily::Dependent:
    return "dependent";
  }
  return {};
}

double QpProblemSource::uniform(double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(m_engine);
}

double QpProblemSource::power(double low, double high)
{
  return std::pow(10.0, uniform(low, high));
}

int QpProblemSource::whole(int low, int high)
{
  return std::uniform_int_distribution<int>(low, high)(m_engine);
}

Eigen::Vector3d QpProblemSource::direction()
{
  std::normal_distribution<double> normal;
  Eigen::Vector3d n;
  do
    n = Eigen::Vector3d(normal(m_engine), normal(m_engine), normal(m_engine));
  while (n.norm() < 1e-6);
  return n.normalized();
}

Vector6 QpProblemSource::anyRow()
{
  const Eigen::Vector3d n = direction();
  return six(n, (uniform(0.0, 30.0) * direction()).cross(n));
}

double QpProblemSource::gap(double largest)
{
  return whole(0, 2) == 0 ? 0.0 : uniform(0.0, largest);
}

QpProblem QpProblemSource::make(QpFamily family, int count, double spread)
{
  QpProblem problem;
  const double decades = std::log10(spread);
  problem.stiffness = six(Eigen::Vector3d::Constant(power(-decades, decades)),
                          Eigen::Vector3d::Constant(20.0 * power(-decades, decades)));
  const double way = power(-3.0, 1.0);
  problem.unconstrained = six(way * direction(), 0.1 * way * direction());
  switch (family)
  {
  case QpFamily::Random:
    addRandom(count, 0.0, problem);
    break;
  case QpFamily::Soft:
    addRandom(count, 0.5, problem);
    break;
  case QpFamily::BurrPatch:
    addPatch(count, false, problem);
    break;
  case QpFamily::SoftPatch:
    addPatch(count, true, problem);
    break;
  case QpFamily::Duplicates:
    addDuplicates(count, problem);
    break;
  case QpFamily::Coplanar:
    addCoplanar(count, problem);
    break;
  case QpFamily::Wedge:
    addWalls(count, whole(0, 3) == 0 ? 0.0 : power(-3.0, -1.0), problem);
    break;
  case QpFamily::Slit:
    addWalls(count, power(-9.0, -3.0), problem);
    break;
  case QpFamily::Hole:
    addHole(count, problem);
    break;
  case QpFamily::Identical:
    addIdentical(count, problem);
    break;
  case QpFamily::Lattice:
    addLattice(count, problem);
    break;
  case QpFamily::Violated:
    addViolated(count, problem);
    break;
  case QpFamily::Dependent:
    addDependent(count, problem);
    break;
  }
  return problem;
}

void QpProblemSource::addRandom(int count, double softShare, QpProblem& problem)
{
  for (double& compliance : problem.compliances)
    compliance = power(-3.0, 3.0);
  for (int i = 0; i < count; ++i)
    if (uniform(0.0, 1.0) < softShare)
      problem.add(anyRow(), uniform(-0.1, 0.2), whole(0, kMaxSprings - 1));
    else
      problem.add(anyRow(), -gap(0.1));
}

void QpProblemSource::addPatch(int count, bool soft, QpProblem& problem)
{
  const Eigen::Vector3d pole = direction();
  const double radius = uniform(0.5, 3.5);
  const double halfAngle = uniform(0.1, 1.3);
  Eigen::Vector3d center(0.0, 0.0, 0.0);
  if (whole(0, 3) > 0)
    center = uniform(0.0, 60.0) * direction();
  problem.compliances[0] = power(-3.0, 3.0);
  const double depth = uniform(0.0, 0.5 * radius);
  problem.unconstrained.head<3>() -= uniform(0.0, 2.0) * pole;
  for (int i = 0; i < count; ++i)
  {
    const double tilt = halfAngle * std::sqrt(uniform(0.0, 1.0));
    const Eigen::Vector3d side = pole.cross(direction()).normalized();
    const Eigen::Vector3d radial = std::cos(tilt) * pole + std::sin(tilt) * side;
    const Eigen::Vector3d n = (radial + power(-6.0, -1.5) * direction()).normalized();
    const Eigen::Vector3d arm = center - radius * radial;
    if (soft && i % 8 != 0)
      problem.addContact(n, arm, radius * (1.0 - std::cos(tilt)) - depth + uniform(0.0, 0.01), 0);
    else
      problem.addContact(n, arm, gap(0.05));
  }
}

void QpProblemSource::addDuplicates(int count, QpProblem& problem)
{
  const int originals = std::max(1, count / 5);
  for (int i = 0; i < count; ++i)
    if (i < originals)
      problem.add(anyRow(), -gap(0.05));
    else
    {
      const auto first = static_cast<std::size_t>(whole(0, originals - 1));
      const double size = power(-12.0, -3.0);
      const Vector6 copy = problem.rows[first] + size * six(direction(), direction());
      problem.add(copy, std::min(0.0, problem.bounds[first] + uniform(-size, size)));
    }
}

void QpProblemSource::addCoplanar(int count, QpProblem& problem)
{
  const Eigen::Vector3d n = direction();
  for (int i = 0; i < count; ++i)
    problem.addContact(n, uniform(0.0, 20.0) * n.cross(direction()), gap(0.01));
}

void QpProblemSource::addWalls(int count, double angle, QpProblem& problem)
{
  const Eigen::Vector3d n = direction();
  const double clearance = power(-6.0, -2.0);
  for (int i = 0; i < count; ++i)
  {
    const Eigen::Vector3d wall = (n + angle * direction()).normalized();
    problem.addContact(i % 2 == 0 ? wall : Eigen::Vector3d(-wall), uniform(0.0, 5.0) * direction(),
                       gap(clearance));
  }
}

void QpProblemSource::addHole(int count, QpProblem& problem)
{
  const Eigen::Vector3d center = uniform(0.0, 30.0) * direction();
  const double radius = uniform(0.5, 3.5);
  for (int i = 0; i < count; ++i)
  {
    const Eigen::Vector3d n = direction();
    problem.addContact(n, center - radius * n, gap(0.01));
  }
}

void QpProblemSource::addIdentical(int count, QpProblem& problem)
{
  const Vector6 row = anyRow();
  const double clearance = gap(0.05);
  for (int i = 0; i < count; ++i)
    problem.add(row, -clearance);
}

void QpProblemSource::addLattice(int count, QpProblem& problem)
{
  for (int i = 0; i < count; ++i)
  {
    Vector6 row;
    for (double& entry : row)
      entry = whole(-1, 1);
    problem.add(row, -0.01 * whole(0, 2));
  }
}

void QpProblemSource::addViolated(int count, QpProblem& problem)
{
  const double way = power(-3.0, 0.0);
  const Vector6 possible = six(way * direction(), 0.05 * way * direction());
  for (int i = 0; i < count; ++i)
  {
    const Vector6 row = anyRow();
    problem.add(row, row.dot(possible) - gap(0.5 * way));
  }
}

void QpProblemSource::addDependent(int count, QpProblem& problem)
{
  const int rank = whole(1, 5);
  const double noise = power(-14.0, -2.0);
  std::vector<Vector6> base;
  for (int i = 0; i < rank; ++i)
    base.push_back(anyRow());
  for (int i = 0; i < count; ++i)
  {
    Vector6 row = noise * six(direction(), direction());
    for (const Vector6& part : base)
      row += uniform(-1.0, 1.0) * part;
    problem.add(row, -gap(0.02));
  }
}

} // namespace petrous::haptics::testing
