#include "QpBenchmark.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string>

#include "KktError.h"
#include "QpProblems.h"

namespace petrous::haptics
{

namespace
{

using testing::QpFamily;
using testing::QpProblem;
using testing::QpProblemSource;
using Vector6 = QpProblem::Vector6;
using Clock = std::chrono::steady_clock;

constexpr double kAllowed = 1e-9;       // KKT error, relative
constexpr double kAllowedNearly = 1e-7; // for nearly linearly dependent rows
constexpr int kRepeats = 3;             // of each problem, for ours and the peer
constexpr std::size_t kCapacity = 1024;
const char* const kErrorUnit = "worst KKT error, of the problem's size";

// Textbook projected Gauss-Seidel on the dual: each multiplier in turn is set so that its row
// holds.
class GaussSeidel
{
public:
  void solve(const QpProblem& problem)
  {
    constexpr int kMaxSweeps = 1000;
    constexpr double kSettled = 1e-9;
    const Vector6 root = problem.stiffness.cwiseSqrt();
    const std::size_t count = problem.rows.size();
    m_normals.resize(count);
    m_lengths.resize(count);
    m_multipliers.assign(count, 0.0);
    m_gives.resize(count);
    m_compressions.fill(0.0);
    for (std::size_t i = 0; i < count; ++i)
    {
      const Vector6 whitened = problem.rows[i].cwiseQuotient(root);
      const double compliance = problem.complianceOf(i);
      m_lengths[i] = std::max(std::sqrt(whitened.squaredNorm() + compliance), 1e-12);
      m_normals[i] = whitened / m_lengths[i];
      m_gives[i] = std::sqrt(compliance) / m_lengths[i];
    }
    Vector6 y = root.cwiseProduct(problem.unconstrained);
    const double settled = kSettled * y.norm();
    double change = 2.0 * settled;
    for (m_sweeps = 0; m_sweeps < kMaxSweeps && change > settled; ++m_sweeps)
    {
      change = 0.0;
      for (std::size_t i = 0; i < count; ++i)
      {
        // A rigid row has a give of 0, whichever spring it is given.
        double& compression = m_compressions[std::max(0, problem.springs[i])];
        const double missing =
            problem.bounds[i] / m_lengths[i] - m_normals[i].dot(y) - m_gives[i] * compression;
        const double next = std::max(0.0, m_multipliers[i] + missing);
        const double step = next - m_multipliers[i];
        m_multipliers[i] = next;
        y += step * m_normals[i];
        compression += step * m_gives[i];
        change = std::max(change, std::abs(step));
      }
    }
    m_solution = y.cwiseQuotient(root);
  }

  const Vector6& solution() const { return m_solution; }
  double lambda(std::size_t i) const { return m_multipliers[i] / m_lengths[i]; }
  int sweeps() const { return m_sweeps; }

private:
  std::vector<Vector6> m_normals;
  std::vector<double> m_lengths;
  std::vector<double> m_multipliers;
  std::vector<double> m_gives;                      // component of a row along its spring
  std::array<double, kMaxSprings> m_compressions{}; // each times the root of its stiffness
  Vector6 m_solution;
  int m_sweeps = 0;
};

struct Outcome
{
  std::vector<double> seconds;
  double worst = 0.0; // KKT error
  double work = 0.0;  // iterations, total
  int failures = 0;

  void add(double time, double error, double iterations, bool failed)
  {
    seconds.push_back(time);
    worst = std::max(worst, error);
    work += iterations;
    failures += failed ? 1 : 0;
  }

  double quantile(double share)
  {
    const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(seconds.size()));
    const auto nth =
        seconds.begin() + std::min(place, static_cast<std::ptrdiff_t>(seconds.size()) - 1);
    std::nth_element(seconds.begin(), nth, seconds.end());
    return *nth;
  }
};

// Minimum of kRepeats, against interference by other processes; the same for both solvers.
template <class Work>
double timed(const Work& work)
{
  double least = HUGE_VAL;
  for (int n = 0; n < kRepeats; ++n)
  {
    const auto start = Clock::now();
    work();
    least = std::min(least, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return least;
}

void solveOurs(const QpProblem& problem, double allowed, ProxyQp& qp, Outcome& outcome)
{
  ProxyQp::Status status{};
  const double time = timed(
      [&]
      {
        problem.fill(qp);
        status = qp.solve(problem.unconstrained);
      });
  // A problem given up has no solution to check: it counts as failed.
  const bool solved = status == ProxyQp::Status::Solved;
  const double error = solved ? testing::kktError(problem, qp).worst() : 0.0;
  outcome.add(time, error, qp.iterations(), !solved || error > allowed);
}

void solvePeer(const QpProblem& problem, GaussSeidel& peer, Outcome& outcome)
{
  const double time = timed([&] { peer.solve(problem); });
  const double error =
      testing::kktError(problem, peer.solution(), [&](std::size_t i) { return peer.lambda(i); })
          .worst();
  outcome.add(time, error, peer.sweeps(), error > kAllowed);
}

core::BenchmarkPoint pointOf(Outcome& outcome, const std::string& scene, const std::string& peer)
{
  core::BenchmarkPoint point;
  point.scene = scene;
  point.seconds = outcome.quantile(0.5);
  point.error = outcome.worst;
  point.errorUnit = kErrorUnit;
  point.peer = peer;
  point.extra["problems"] = static_cast<double>(outcome.seconds.size());
  point.extra["failures"] = outcome.failures;
  point.extra["p999_us"] = 1e6 * outcome.quantile(0.999);
  point.extra["mean_iterations"] = outcome.work / static_cast<double>(outcome.seconds.size());
  return point;
}

void measureRows(QpFamily family, int rows, bool quick, core::BenchmarkReport& report)
{
  QpProblemSource source(static_cast<unsigned>(rows));
  GaussSeidel peer;
  Outcome ours, theirs;
  const int problems = quick ? 200 : 2000;
  const int peerProblems = std::max(10, (quick ? 1000 : 10000) / (rows + 10));
  for (int n = 0; n < problems; ++n)
  {
    const QpProblem problem = source.make(family, rows);
    ProxyQp qp(kCapacity, problem.stiffness, problem.isSoft());
    if (n == 0)
      solvePeer(problem, peer, theirs), theirs = {}; // warm-up
    solveOurs(problem, kAllowed, qp, ours);
    if (n < peerProblems)
      solvePeer(problem, peer, theirs);
  }
  for (Outcome* outcome : {&ours, &theirs})
  {
    core::BenchmarkPoint point = pointOf(*outcome, testing::nameOf(family),
                                         outcome == &ours ? "" : "projected Gauss-Seidel");
    point.setting["rows"] = std::to_string(rows);
    point.series = "rows";
    point.isDefault = outcome == &ours && rows == 100 && family == QpFamily::BurrPatch;
    report.points.push_back(point);
  }
}

// All families in turn, up to 60 rows, occasionally up to 800, stiffness ratios up to 100.
void measureAll(bool quick, const core::Progress& progress, core::BenchmarkReport& report)
{
  const int problems = quick ? 10000 : 1000000;
  QpProblemSource source(1);
  Outcome apart, nearly;
  for (int n = 0; n < problems; ++n)
  {
    if (n % 1000 == 0)
      progress.report(static_cast<double>(n) / problems, "solving contact problems");
    const QpFamily family =
        testing::kQpFamilies[static_cast<std::size_t>(n) % testing::kQpFamilies.size()];
    const bool close = testing::isNearlyDependent(family);
    const int rows = source.whole(1, source.whole(0, 99) == 0 ? 800 : 60);
    const QpProblem problem = source.make(family, rows, 10.0);
    ProxyQp qp(kCapacity, problem.stiffness, problem.isSoft());
    solveOurs(problem, close ? kAllowedNearly : kAllowed, qp, close ? nearly : apart);
  }
  for (Outcome* outcome : {&apart, &nearly})
  {
    core::BenchmarkPoint point =
        pointOf(*outcome, outcome == &apart ? "all families" : "rows that nearly depend", "");
    point.setting["rows"] = "1 to 800";
    report.points.push_back(point);
  }
}

} // namespace

core::BenchmarkReport runQpBenchmark(bool quick, const core::Progress& progress)
{
  core::BenchmarkReport report{"qp", "Contact problem of one tick", {}};
  const std::vector<int> rows{1, 2, 5, 10, 20, 50, 100, 200, 400, 800};
  const core::Progress first = progress.part(0.0, 0.3);
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    first.report(static_cast<double>(k) / static_cast<double>(rows.size()), "contact rows");
    for (const QpFamily family : {QpFamily::BurrPatch, QpFamily::Wedge, QpFamily::SoftPatch})
      measureRows(family, rows[k], quick, report);
  }
  measureAll(quick, progress.part(0.3, 1.0), report);
  return report;
}

} // namespace petrous::haptics
