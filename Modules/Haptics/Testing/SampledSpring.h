#pragma once

#include <Eigen/Dense>

namespace petrous::haptics
{

/// The largest stiffness, N/mm, at which the sampled spring F_n = -k x_(n-delay), held until the
/// next tick, has all of its poles within the unit circle, on a handle m (kg), b (N s/mm) that a
/// hand holds with k_h (N/mm). At most 100. The closed loop is exact: no friction, no quantisation.
inline double sampledSpringLimit(double mass, double damping, double handStiffness, int delay,
                                 double tick = 0.001)
{
  const double scale = 1000.0 / mass; // mm/s^2 of a newton
  // [x, v] over a tick by the Taylor series of exp(A T), and of its integral for the held force.
  Eigen::Matrix2d a;
  a << 0.0, 1.0, -scale * handStiffness, -scale * damping;
  Eigen::Matrix2d power = Eigen::Matrix2d::Identity();
  Eigen::Matrix2d whole = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d integral = Eigen::Matrix2d::Zero();
  double factor = 1.0;
  for (int n = 0; n < 30; ++n)
  {
    whole += factor * power;
    integral += factor * tick / (n + 1) * power;
    power = (a * power).eval();
    factor *= tick / (n + 1);
  }
  const Eigen::Vector2d input = integral * Eigen::Vector2d(0.0, scale);
  const auto stable = [&](double k)
  {
    Eigen::MatrixXd loop = Eigen::MatrixXd::Zero(2 + delay, 2 + delay);
    loop.topLeftCorner(2, 2) = whole;
    if (delay == 0)
      loop.topLeftCorner(2, 2) -= k * input * Eigen::RowVector2d(1.0, 0.0);
    else
    {
      loop.block(0, 2, 2, 1) = input; // the force that acts now, then those underway
      for (int i = 0; i + 1 < delay; ++i)
        loop(2 + i, 3 + i) = 1.0;
      loop(1 + delay, 0) = -k;
    }
    return loop.eigenvalues().cwiseAbs().maxCoeff() < 1.0;
  };
  double low = 0.0;
  double high = 100.0;
  for (int n = 0; n < 50; ++n)
    (stable(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  return low;
}

} // namespace petrous::haptics
