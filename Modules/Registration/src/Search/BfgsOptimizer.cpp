#include "BfgsOptimizer.h"

#include <algorithm>

#include "RigidParametrization.h"

namespace petrous::registration
{

namespace
{

constexpr double kArmijo = 1e-4;   // fraction of the predicted gain required of a step
constexpr double kShortest = 1e-3; // mm; shorter steps are not informative
constexpr int kHalvings = 8;       // of a step before the line search fails

// One evaluation in the parametrization.
struct Place
{
  PoseVector x = PoseVector::Zero();
  double information = 0.0;
  PoseVector slope = PoseVector::Zero();
};

class Climber
{
public:
  Climber(const MutualInformation& metric, const core::RigidTransform& start,
          const BfgsOptions& options, const EvaluationListener& listener)
    : m_metric(metric)
    , m_chart(start, metric.fixed().centre, metric.fixed().radius)
    , m_options(options)
    , m_listener(listener)
  {
  }

  Optimum climb()
  {
    Place here = evaluate(PoseVector::Zero());
    Eigen::Matrix<double, 6, 6> inverse = Eigen::Matrix<double, 6, 6>::Identity();
    bool scaled = false;
    int still = 0;
    while (!spent() && here.slope.norm() > m_options.gradient && still < 2)
    {
      PoseVector direction = inverse * here.slope;
      if (!scaled || direction.dot(here.slope) <= 0.0)
      {
        direction = here.slope * (m_options.firstStep / here.slope.norm());
        inverse.setIdentity();
        scaled = false;
      }
      direction *= std::min(1.0, m_options.maxStep / direction.norm());
      Place next;
      if (!step(here, direction, next))
        break;
      const PoseVector s = next.x - here.x;
      const PoseVector y = here.slope - next.slope; // of the negated metric
      const double sy = s.dot(y);
      if (sy > 1e-10 * s.norm() * y.norm())
      {
        if (!scaled)
          inverse *= sy / y.squaredNorm();
        scaled = true;
        const Eigen::Matrix<double, 6, 6> left =
            Eigen::Matrix<double, 6, 6>::Identity() - s * y.transpose() / sy;
        inverse = left * inverse * left.transpose() + s * s.transpose() / sy;
      }
      const double gain = next.information - here.information;
      still = gain < m_options.change * next.information ? still + 1 : 0;
      here = next;
    }
    return m_best;
  }

private:
  bool spent() const { return m_best.evaluations >= m_options.evaluations; }

  Place evaluate(const PoseVector& x)
  {
    const core::RigidTransform pose = m_chart.pose(x);
    const MutualInformation::Value value = m_metric.withGradient(pose);
    if (m_best.evaluations++ == 0 || value.information > m_best.information)
    {
      m_best.pose = pose;
      m_best.information = value.information;
      m_best.overlap = value.overlap;
    }
    if (m_listener)
      m_listener(pose, value.information);
    PoseVector slope = m_chart.gradient(x, value.translation, value.rotation);
    if (!m_options.turns)
      slope.head<3>().setZero();
    return {x, value.information, slope};
  }

  // Backtracking line search with parabolic interpolation.
  bool step(const Place& here, const PoseVector& direction, Place& next)
  {
    const double promised = direction.dot(here.slope);
    double length = 1.0;
    for (int n = 0; n < kHalvings && !spent(); ++n)
    {
      if (length * direction.norm() < kShortest)
        return false;
      next = evaluate(here.x + length * direction);
      const double gain = next.information - here.information;
      if (gain >= kArmijo * length * promised)
        return true;
      const double bend = 2.0 * (length * promised - gain);
      length *= std::clamp(length * promised / bend, 0.1, 0.5);
    }
    return false;
  }

  const MutualInformation& m_metric;
  RigidParametrization m_chart;
  const BfgsOptions& m_options;
  const EvaluationListener& m_listener;
  Optimum m_best;
};

} // namespace

Optimum maximize(const MutualInformation& metric, const core::RigidTransform& start,
                 const BfgsOptions& options, const EvaluationListener& listener)
{
  return Climber(metric, start, options, listener).climb();
}

} // namespace petrous::registration
