#pragma once

#include <array>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "petrous/Haptics/ProxyQp.h"

namespace petrous::haptics::testing
{

/// One problem of ProxyQp.
struct QpProblem
{
  using Vector6 = ProxyQp::Vector6;
  static constexpr int kRigid = -1;

  Vector6 stiffness;
  Vector6 unconstrained;
  std::vector<Vector6> rows;
  std::vector<double> bounds;
  std::vector<int> springs;                         ///< of each row: its spring, or kRigid
  std::array<double, kMaxSprings> compliances = {}; ///< of each spring, mm/N

  void add(const Vector6& row, double bound, int spring = kRigid);

  /// A contact with unit normal n at lever arm r, mm.
  void addContact(const Eigen::Vector3d& n, const Eigen::Vector3d& r, double gap,
                  int spring = kRigid);

  bool isSoft() const;

  /// Of row i: its spring's compliance; 0 if it is rigid.
  double complianceOf(std::size_t i) const
  {
    return springs[i] == kRigid ? 0.0 : compliances[static_cast<std::size_t>(springs[i])];
  }

  /// Replaces the rows of `qp`.
  void fill(ProxyQp& qp) const;
};

/// Contains the problem's rows, and room for one more.
ProxyQp solverOf(const QpProblem& problem);

enum class QpFamily
{
  Random,     ///< contacts anywhere
  BurrPatch,  ///< a burr on bone: normals on a cap, small gaps
  Duplicates, ///< copies of a few contacts, displaced by 1e-12 to 1e-3
  Coplanar,   ///< a flat tool on a plane: rank 3
  Wedge,      ///< between opposing walls, parallel or 1e-3 to 0.1 rad from it
  Hole,       ///< a ball that fills a spherical hole
  Identical,  ///< the same contact repeated
  Lattice,    ///< rows of small integers: ties, exact dependence, zero rows
  Violated,   ///< a = 0 violates the rows, another motion satisfies them
  Soft,       ///< contacts anywhere, half of them of soft structures, some inside
  SoftPatch,  ///< a burr sunk into soft tissue over bone
  Slit,       ///< between opposing walls 1e-9 to 1e-3 rad from parallel
  Dependent   ///< rows within 1e-14 to 1e-2 of a lower-dimensional subspace
};

constexpr std::array<QpFamily, 13> kQpFamilies{
    QpFamily::Random,   QpFamily::BurrPatch, QpFamily::Duplicates, QpFamily::Coplanar,
    QpFamily::Wedge,    QpFamily::Hole,      QpFamily::Identical,  QpFamily::Lattice,
    QpFamily::Violated, QpFamily::Soft,      QpFamily::SoftPatch,  QpFamily::Slit,
    QpFamily::Dependent};

std::string nameOf(QpFamily family);

/// Families with rows nearer than 1e-5 to linear dependence, which ProxyQp satisfies to 1e-7.
inline bool isNearlyDependent(QpFamily family)
{
  return family == QpFamily::Slit || family == QpFamily::Dependent;
}

/// Feasible problems; in all families but Violated a = 0 satisfies the rigid rows.
class QpProblemSource
{
public:
  explicit QpProblemSource(unsigned seed)
    : m_engine(seed)
  {
  }

  /// `count` rows; coupling 1 N/mm and 20 N mm/rad, each times a factor between 1 / spread and
  /// spread; motions of 1 um to 10 mm.
  QpProblem make(QpFamily family, int count, double spread = 1.0);

  double uniform(double low, double high);
  double power(double low, double high); ///< 10^x, x uniform
  int whole(int low, int high);
  Eigen::Vector3d direction();

private:
  QpProblem::Vector6 anyRow();
  double gap(double largest);
  void addRandom(int count, double softShare, QpProblem& problem);
  void addPatch(int count, bool soft, QpProblem& problem);
  void addDuplicates(int count, QpProblem& problem);
  void addCoplanar(int count, QpProblem& problem);
  void addWalls(int count, double angle, QpProblem& problem);
  void addHole(int count, QpProblem& problem);
  void addIdentical(int count, QpProblem& problem);
  void addLattice(int count, QpProblem& problem);
  void addViolated(int count, QpProblem& problem);
  void addDependent(int count, QpProblem& problem);

  std::mt19937_64 m_engine;
};

} // namespace petrous::haptics::testing
