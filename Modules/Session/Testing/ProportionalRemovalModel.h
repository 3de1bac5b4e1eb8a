#pragma once

#include <cmath>

#include "petrous/Session/RemovalModel.h"

namespace petrous::session::testing
{

/// Advances at a speed proportional to thrust, for any tissue: 20 mm/s per N.
class ProportionalRemovalModel : public RemovalModel
{
public:
  explicit ProportionalRemovalModel(double radius, double gain = 20.0)
    : m_radius(radius)
    , m_gain(gain)
  {
  }

  void press(const TickRecord& record, double seconds) override
  {
    const Eigen::Vector3d force(record.burrForce[0], record.burrForce[1], record.burrForce[2]);
    m_way -= m_gain * seconds * force;
    m_at = record.proxy.pose().position;
  }

  std::optional<dissection::SweptSphere> nextCut(const volume::CutMask&) override
  {
    const Eigen::Vector3d way = m_way;
    m_way.setZero();
    if (!(way.norm() > 0.0))
      return std::nullopt;
    return dissection::SweptSphere{m_at, m_at + way, m_radius};
  }

  void release() override { m_way.setZero(); }

private:
  double m_radius; // mm
  double m_gain;   // mm/s per N
  Eigen::Vector3d m_at{0.0, 0.0, 0.0};
  Eigen::Vector3d m_way{0.0, 0.0, 0.0};
};

} // namespace petrous::session::testing
