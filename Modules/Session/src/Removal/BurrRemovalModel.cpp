#include "petrous/Session/BurrRemovalModel.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "petrous/Core/Error.h"

namespace petrous::session
{

namespace
{

constexpr double kPi = 3.14159265358979323846;

// mm by which a burr on a flat surface has sunk in before the first removal: what a cutting burr
// with ten teeth removes in two turns at a tenth of a micrometre per tooth. It defines the smallest
// patch.
constexpr double kMinSink = 0.002;

// Quadrature over a patch: within 0.3 % of its mean at the pole, and better elsewhere.
constexpr int kRings = 12;
constexpr int kPlaces = 24;

// Half angle (rad) of the cap of a unit ball with this mean distance from its own axis:
// (a - sin a cos a) / (2 (1 - cos a)), which is 2/3 a for small a and increases up to a full ball.
double rimOf(double spread) noexcept
{
  double low = 0.0;
  double high = kPi;
  for (int n = 0; n < 30; ++n)
  {
    const double a = 0.5 * (low + high);
    const double half = std::sin(0.5 * a);
    const double mean =
        a > 1e-3 ? (a - std::sin(a) * std::cos(a)) / (4.0 * half * half) : 2.0 / 3.0 * a;
    (mean < spread ? low : high) = a;
  }
  return 0.5 * (low + high);
}

} // namespace

BurrRemovalModel::BurrRemovalModel(dissection::RemovalDepthSolver& search,
                                   const dissection::Burr& burr, double voxel)
  : m_search(search)
  , m_speed(burr.rpm * 2.0 * kPi / 60.0)
  , m_voxel(voxel)
  , m_ahead(std::max(kVoxelsAhead * voxel, kMinAhead))
{
  if (!(burr.rpm >= 0.0) || !std::isfinite(burr.rpm))
    throw core::InvalidParameter("drill: the spindle's speed must be at least 0 turns a minute");
}

double BurrRemovalModel::armOf(const Eigen::Vector3d& normal, double spread) const noexcept
{
  const double sine = std::clamp(normal.dot(m_spindle), -1.0, 1.0);
  return armOf(m_search.radius(), std::asin(sine), spread);
}

double BurrRemovalModel::armOf(double radius, double elevation, double spread) noexcept
{
  const double least = 2.0 / 3.0 * std::sqrt(2.0 * radius * kMinSink);
  const double rim = rimOf(std::max(spread, least) / radius);
  // Rings of equal area, points of half of each evenly spaced.
  const double sine = std::sin(elevation);
  const double cosine = std::cos(elevation);
  double sum = 0.0;
  for (int ring = 0; ring < kRings; ++ring)
  {
    const double along = 1.0 - (1.0 - std::cos(rim)) * (ring + 0.5) / kRings;
    const double across = std::sqrt(std::max(0.0, 1.0 - along * along));
    for (int place = 0; place < kPlaces; ++place)
    {
      const double turn = kPi * (place + 0.5) / kPlaces;
      const double axial = along * sine + across * std::cos(turn) * cosine;
      sum += std::sqrt(std::max(0.0, 1.0 - axial * axial));
    }
  }
  return radius * sum / (kRings * kPlaces);
}

double BurrRemovalModel::armOfPatch() const noexcept
{
  const double now = armOf(m_patch.middle, m_patch.spread);
  // The spindle may have rotated since the step.
  return m_biteArm > 0.0 ? std::min(m_search.radius(), m_patch.arm * now / m_biteArm) : now;
}

void BurrRemovalModel::press(const TickRecord& record, double seconds)
{
  const Eigen::Vector3d force(record.burrForce[0], record.burrForce[1], record.burrForce[2]);
  const haptics::Pose tool = record.proxy.pose();
  const double thrust = force.norm();
  if (!(thrust > 0.0) || !std::isfinite(thrust) || !tool.position.allFinite())
    return release();
  m_thrust = thrust;
  m_wish.place = tool.position;
  m_wish.into = -force / thrust;
  m_spindle = m_wish.spindle = tool.rotation * Eigen::Vector3d::UnitZ();
  m_pressedArm = m_patchArm = m_arm = m_bitten ? armOfPatch() : armOf(m_wish.into, 0.0);
  m_wish.deepest = m_ahead;
  m_rate = thrust * m_arm * m_speed * record.input.spindle();
  const double work = m_rate * seconds;
  m_owed += work;
  if (m_resistance > 0.0)
    m_balance.predicted += work / m_resistance;
  else
    m_unpriced += work;
  m_pressed = true;
}

// From the last step; initially from the tissue ahead.
double BurrRemovalModel::resistance(const volume::CutMask& mask)
{
  if (m_resistance > 0.0)
    return m_resistance;
  m_resistance = m_search.ahead(mask, m_wish.place, m_wish.into).value_or(0.0);
  if (m_resistance > 0.0)
    m_balance.predicted += std::exchange(m_unpriced, 0.0) / m_resistance;
  return m_resistance;
}

void BurrRemovalModel::account(const dissection::RemovalStep& step)
{
  m_owed -= step.work;
  m_balance.removed += step.volume;
  m_resistance = step.work / step.volume;
  m_patch = step.patch;
  m_bitten = true;
  // The patch grew with the step, which used the mean of its old and new arm.
  m_biteArm = armOf(m_patch.middle, m_patch.spread);
  const double arm = m_patch.arm;
  m_arm = 0.5 * (std::exchange(m_patchArm, arm) + arm);
  const double more = std::max((m_arm / m_pressedArm - 1.0) * step.work, -std::max(m_owed, 0.0));
  m_owed += more;
  m_balance.predicted += more / m_resistance;
}

void BurrRemovalModel::forfeit(double work)
{
  m_owed -= work;
  if (m_resistance > 0.0)
    m_balance.forfeited += work / m_resistance;
  else
    m_unpriced -= work; // nothing could be removed: no volume was predicted
}

std::optional<dissection::SweptSphere> BurrRemovalModel::nextCut(const volume::CutMask& mask)
{
  if (!std::exchange(m_pressed, false))
    return std::nullopt;
  if (!(resistance(mask) > 0.0))
  {
    forfeit(m_owed);
    return std::nullopt;
  }
  const bool little = m_owed * m_search.yielding() < kMinAdvance * m_voxel;
  if (little && m_search.yielding() > 0.0 && m_owed < kMaxWait * m_rate)
    return std::nullopt;
  m_wish.work = m_owed;
  const auto step = m_search.find(mask, m_wish);
  if (step && step->volume > 0.0)
  {
    account(*step);
    m_pressed = step->capped;
    return step->burr;
  }
  // Nothing within reach may be removed, or the tool is held back: work is not saved for later.
  if (step)
    forfeit(m_owed);
  else if (const double most = kMaxOwed * m_rate; m_owed > most)
    forfeit(m_owed - most);
  return std::nullopt;
}

void BurrRemovalModel::release()
{
  forfeit(m_owed);
  m_owed = m_unpriced = 0.0;
  m_resistance = 0.0;
  m_bitten = false;
  m_pressed = false;
  m_search.forget();
}

RemovalBalance BurrRemovalModel::balance() const noexcept
{
  RemovalBalance balance = m_balance;
  balance.owed = m_resistance > 0.0 ? m_owed / m_resistance : 0.0;
  return balance;
}

} // namespace petrous::session
