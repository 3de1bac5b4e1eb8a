#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "petrous/Haptics/ContactQp.h"

namespace petrous::haptics::qp
{

using Vector6 = ContactQp::Vector6;

struct Problem
{
  Vector6 stiffness;
  Vector6 unconstrained;
  std::vector<Vector6> rows;
  std::vector<double> bounds;
  std::vector<double> compliances;

  void add(const Vector6& row, double bound, double compliance = 0.0)
  {
    rows.push_back(row);
    bounds.push_back(bound);
    compliances.push_back(compliance);
  }

  /// A contact with unit normal n at lever arm r.
  void addContact(const Eigen::Vector3d& n, const Eigen::Vector3d& r, double gap,
                  double compliance = 0.0)
  {
    Vector6 row;
    row << n, r.cross(n);
    add(row, -gap, compliance);
  }

  ContactQp solver() const
  {
    ContactQp qp(std::max<std::size_t>(rows.size(), 1), stiffness);
    fill(qp);
    return qp;
  }

  void fill(ContactQp& qp) const
  {
    qp.clear();
    for (std::size_t i = 0; i < rows.size(); ++i)
      qp.add(rows[i], bounds[i], compliances[i]);
  }
};

/// How far a motion and its multipliers are from the conditions of Karush, Kuhn and Tucker, which
/// for this convex problem are those of the solution. Lengths are M^1/2 a, rows are scaled to unit
/// length; all relative to the root of twice the objective at a = 0, plus the largest bound.
struct KktError
{
  double primal = 0.0;          ///< largest b - J a - c lambda
  double dual = 0.0;            ///< largest -lambda
  double stationarity = 0.0;    ///< |M (a - u) - J^T lambda|
  double complementarity = 0.0; ///< largest min(|lambda|, |J a + c lambda - b|)

  double worst() const { return std::max({primal, dual, stationarity, complementarity}); }
};

template <class Lambda>
KktError kktError(const Problem& problem, const Vector6& a, const Lambda& lambda)
{
  const Vector6 root = problem.stiffness.cwiseSqrt();
  double highest = 0.0;
  double energy = root.cwiseProduct(problem.unconstrained).squaredNorm();
  std::vector<double> lengths;
  for (std::size_t i = 0; i < problem.rows.size(); ++i)
  {
    const double length = problem.rows[i].cwiseQuotient(root).norm();
    lengths.push_back(length > 0.0 ? length : 1.0);
    const double inside = std::max(0.0, problem.bounds[i]);
    highest = std::max(highest, inside / lengths.back());
    if (problem.compliances[i] > 0.0)
      energy += inside * inside / problem.compliances[i];
  }
  double scale = highest + std::sqrt(energy);
  if (!(scale > 0.0))
    scale = 1.0;
  KktError error;
  Vector6 residual = problem.stiffness.cwiseProduct(a - problem.unconstrained);
  for (std::size_t i = 0; i < problem.rows.size(); ++i)
  {
    const double thrust = lambda(i);
    const double slack =
        (problem.rows[i].dot(a) + problem.compliances[i] * thrust - problem.bounds[i]) /
        (lengths[i] * scale);
    const double multiplier = thrust * lengths[i] / scale;
    residual -= thrust * problem.rows[i];
    error.primal = std::max(error.primal, -slack);
    error.dual = std::max(error.dual, -multiplier);
    error.complementarity = std::max(error.complementarity, std::min(std::abs(slack), std::abs(multiplier)));
  }
  error.stationarity = residual.cwiseQuotient(root).norm() / scale;
  return error;
}

inline KktError kktError(const Problem& problem, const ContactQp& solved)
{
  return kktError(problem, solved.solution(), [&](std::size_t i) { return solved.lambda(i); });
}

enum class Family
{
  Random,     ///< contacts anywhere
  BurrPatch,  ///< a burr pressed on bone: normals on a cap, small gaps
  Duplicates, ///< copies of a few contacts, moved by 1e-12 to 1e-3
  Coplanar,   ///< a flat tool on a plane: rank 3
  Wedge,      ///< between opposing walls 1e-9 to 0.1 rad from parallel
  Hole,       ///< a ball that fills a spherical hole
  Identical,  ///< one contact again and again
  Dependent,  ///< rows within 1e-14 to 1e-2 of a plane of fewer dimensions
  Lattice,    ///< rows of small whole numbers: ties, exact dependence, rows of zeros
  Soft,       ///< contacts anywhere, half of them compliant, some inside
  SoftPatch   ///< a burr sunk into soft tissue over bone
};

constexpr std::array<Family, 11> kFamilies{
    Family::Random,  Family::BurrPatch, Family::Duplicates, Family::Coplanar,
    Family::Wedge,   Family::Hole,      Family::Identical,  Family::Dependent,
    Family::Lattice, Family::Soft,      Family::SoftPatch};

/// Problems with a solution: the bounds of rigid rows are <= 0, so that a = 0 fulfils them.
class ProblemSource
{
public:
  explicit ProblemSource(unsigned seed)
    : m_engine(seed)
  {
  }

  /// `count` rows; coupling 1 N/mm and 20 N mm/rad, each times a factor of up to `spread` and its
  /// inverse.
  Problem make(Family family, int count, double spread = 1.0)
  {
    Problem problem;
    const double root = std::log10(spread);
    problem.stiffness << Eigen::Vector3d::Constant(power(-root, root)),
        Eigen::Vector3d::Constant(20.0 * power(-root, root));
    const double reach = power(-3.0, 1.0);
    problem.unconstrained << reach * direction(), 0.1 * reach * direction();
    addRows(family, count, problem);
    return problem;
  }

  double uniform(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(m_engine);
  }

  /// 10^x with x uniform.
  double power(double low, double high) { return std::pow(10.0, uniform(low, high)); }

  Eigen::Vector3d direction()
  {
    std::normal_distribution<double> normal;
    Eigen::Vector3d n;
    do
      n = Eigen::Vector3d(normal(m_engine), normal(m_engine), normal(m_engine));
    while (n.norm() < 1e-6);
    return n.normalized();
  }

  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(m_engine); }

private:
  static Vector6 six(const Eigen::Vector3d& n, const Eigen::Vector3d& torque)
  {
    Vector6 row;
    row << n, torque;
    return row;
  }

  Vector6 anyRow()
  {
    const Eigen::Vector3d n = direction();
    return six(n, (uniform(0.0, 30.0) * direction()).cross(n));
  }

  double gap(double largest) { return whole(0, 2) == 0 ? 0.0 : uniform(0.0, largest); }

  Eigen::Vector3d onCap(const Eigen::Vector3d& pole, double halfAngle)
  {
    const double tilt = halfAngle * std::sqrt(uniform(0.0, 1.0));
    const Eigen::Vector3d side = pole.cross(direction()).normalized();
    return std::cos(tilt) * pole + std::sin(tilt) * side;
  }

  void addRows(Family family, int count, Problem& problem)
  {
    switch (family)
    {
    case Family::Random:
      for (int i = 0; i < count; ++i)
        problem.add(anyRow(), -gap(0.1));
      break;
    case Family::BurrPatch:
    case Family::SoftPatch:
      addPatch(family == Family::SoftPatch, count, problem);
      break;
    case Family::Duplicates:
      for (int i = 0; i < count; ++i)
        if (i < std::max(1, count / 5))
          problem.add(anyRow(), -gap(0.05));
        else
        {
          const auto first = static_cast<std::size_t>(whole(0, std::max(1, count / 5) - 1));
          const double size = power(-12.0, -3.0);
          const Vector6 copy = problem.rows[first] + size * six(direction(), direction());
          problem.add(copy, std::min(0.0, problem.bounds[first] + uniform(-size, size)));
        }
      break;
    case Family::Coplanar:
    {
      const Eigen::Vector3d n = direction();
      for (int i = 0; i < count; ++i)
        problem.addContact(n, uniform(0.0, 20.0) * n.cross(direction()), gap(0.01));
      break;
    }
    case Family::Wedge:
    {
      const Eigen::Vector3d n = direction();
      const double angle = power(-9.0, -1.0);
      const double clearance = power(-6.0, -2.0);
      for (int i = 0; i < count; ++i)
      {
        const Eigen::Vector3d tilted = (n + angle * direction()).normalized();
        problem.addContact(i % 2 ? tilted : Eigen::Vector3d(-tilted),
                           uniform(0.0, 5.0) * direction(), gap(clearance));
      }
      break;
    }
    case Family::Hole:
    {
      const Eigen::Vector3d center = uniform(0.0, 30.0) * direction();
      const double radius = uniform(0.5, 3.5);
      for (int i = 0; i < count; ++i)
      {
        const Eigen::Vector3d n = direction();
        problem.addContact(n, center - radius * n, gap(0.01));
      }
      break;
    }
    case Family::Identical:
    {
      const Vector6 row = anyRow();
      const double clearance = gap(0.05);
      for (int i = 0; i < count; ++i)
        problem.add(row, -clearance);
      break;
    }
    case Family::Dependent:
      addDependent(count, problem);
      break;
    case Family::Lattice:
      for (int i = 0; i < count; ++i)
      {
        Vector6 row;
        for (double& entry : row)
          entry = whole(-1, 1);
        problem.add(row, -0.01 * whole(0, 2));
      }
      break;
    case Family::Soft:
      for (int i = 0; i < count; ++i)
        if (i % 2)
          problem.add(anyRow(), -gap(0.1));
        else
          problem.add(anyRow(), uniform(-0.1, 0.2), power(-3.0, 2.0));
      break;
    }
  }

  void addPatch(bool soft, int count, Problem& problem)
  {
    const Eigen::Vector3d pole = direction();
    const double radius = uniform(0.5, 3.5);
    const double halfAngle = uniform(0.1, 1.3);
    const Eigen::Vector3d center =
        whole(0, 3) == 0 ? Eigen::Vector3d(0.0, 0.0, 0.0) : uniform(0.0, 60.0) * direction();
    const double compliance = power(-2.0, 2.0);
    const double depth = uniform(0.0, 0.5 * radius);
    problem.unconstrained.head<3>() -= uniform(0.0, 2.0) * pole;
    for (int i = 0; i < count; ++i)
    {
      const Eigen::Vector3d n = onCap(pole, halfAngle);
      const Eigen::Vector3d noisy = (n + power(-6.0, -1.5) * direction()).normalized();
      if (soft && i % 8 != 0)
        problem.addContact(noisy, center - radius * n,
                           radius * (1.0 - n.dot(pole)) - depth + uniform(0.0, 0.01), compliance);
      else
        problem.addContact(noisy, center - radius * n, gap(0.05));
    }
  }

  void addDependent(int count, Problem& problem)
  {
    const int rank = whole(1, 5);
    const double noise = power(-14.0, -2.0);
    std::vector<Vector6> base;
    for (int i = 0; i < rank; ++i)
      base.push_back(anyRow());
    for (int i = 0; i < count; ++i)
    {
      Vector6 row = noise * six(direction(), direction());
      for (const Vector6& direction : base)
        row += uniform(-1.0, 1.0) * direction;
      problem.add(row, -gap(0.02));
    }
  }

  std::mt19937_64 m_engine;
};

} // namespace petrous::haptics::qp
