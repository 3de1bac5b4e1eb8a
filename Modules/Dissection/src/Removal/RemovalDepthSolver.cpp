#include "petrous/Dissection/RemovalDepthSolver.h"

#include <algorithm>
#include <cmath>

#include "RemovalStencil.h"

namespace petrous::dissection
{

namespace
{

using Eigen::Vector3d;

constexpr double kSkin = 0.02;    // voxels by which a search starts before the end of the last step
constexpr double kBeside = 0.25;  // voxels: lateral distance within which the last step is reused
constexpr double kAim = 0.96;     // fraction of the work
constexpr double kFinest = 1e-4;  // voxels; twice a quantisation step of the mask
constexpr double kMinBite = 1e-3; // sub-cells; below this is rounding error of the float sums
constexpr int kMaxTrials = 40;    // bisection alone needs 14
constexpr double kAheadOf = 2.0;  // voxels, search distance for the first tissue
constexpr double kAheadStep = 0.25;

double checkedRadius(double radius)
{
  if (!(radius > 0.0) || !std::isfinite(radius))
    throw core::InvalidParameter("bite: the burr's radius must be above 0 mm");
  return radius;
}

} // namespace

struct RemovalDepthSolver::Parts
{
  Parts(const volume::TissueField& field, const TissueResistance& w, ProtectedTissue keep, double r)
    : tissue(field)
    , resistance(w)
    , h(field.geometry().minSpacing())
    , burr(checkedRadius(r))
    , radius(r + kClearance * h)
    , window(field, w, std::move(keep))
  {
  }

  const volume::TissueField& tissue;
  const TissueResistance& resistance;
  double h;      // mm
  double burr;   // mm, radius
  double radius; // mm, of the cut
  RemovalStencil window;
  // Result of the last step.
  bool known = false;
  Vector3d end{0.0, 0.0, 0.0};
  double yielding = 0.0; // mm/(N mm)

  // Where the last step ended, in the direction of advance, if it is a valid start.
  std::optional<double> lastEnd(const Wish& wish) const
  {
    if (!known)
      return std::nullopt;
    const Vector3d way = end - wish.place;
    const double along = way.dot(wish.into);
    if ((way - along * wish.into).norm() > kBeside * h)
      return std::nullopt;
    return along;
  }
};

namespace
{

// Bracket [low, high] of the depth. Work increases with depth.
struct Bracket
{
  double low, high;
  double workLow = 0.0;
  bool triedLow = false;
  double workHigh = -1.0; // negative: not tried

  // Next trial depth for the target work.
  double next(double aim, int trial, double guess) const
  {
    const double width = high - low;
    double x = 0.5 * (low + high);
    if (workHigh < 0.0 && !triedLow)
      x = guess;
    else if (workHigh < 0.0)
      x = trial < 3 && workLow > 0.0 ? low + (aim / workLow - 1.0) * (low - start) : high;
    else if (trial % 3 != 2 && workHigh > workLow)
      x = low + width * (aim - workLow) / (workHigh - workLow);
    return std::clamp(x, triedLow ? low + 0.02 * width : low, high);
  }
  double start = 0.0; // depth, approximately, at which nothing is removed
};

} // namespace

RemovalDepthSolver::RemovalDepthSolver(const volume::TissueField& tissue,
                                       const TissueResistance& resistance, ProtectedTissue keep,
                                       double radius)
  : m_parts(std::make_unique<Parts>(tissue, resistance, std::move(keep), radius))
{
}

RemovalDepthSolver::~RemovalDepthSolver() = default;

std::optional<RemovalStep> RemovalDepthSolver::find(const volume::CutMask& mask, const Wish& wish)
{
  Parts& p = *m_parts;
  const std::optional<double> last = p.lastEnd(wish);
  const double begin = last.value_or(0.0);
  Bracket bracket{};
  bracket.start = begin;
  bracket.low = (last ? begin : std::min(begin, 0.0)) - kSkin * p.h;
  bracket.high = std::min(begin + kStep * p.h, wish.deepest);
  if (!(bracket.low < bracket.high) || !(wish.work > 0.0))
    return std::nullopt;
  const double top = bracket.high;
  double guess = last && p.yielding > 0.0 ? begin + kAim * wish.work * p.yielding
                                          : begin + 0.1 * (top - begin);
  const auto at = [&wish](double depth) -> Vector3d { return wish.place + depth * wish.into; };
  bool found = false;
  double depth = 0.0;
  for (double back = kSkin * p.h; !found; back = std::max(4.0 * back, kStep * p.h))
  {
    if (!p.window.gather(mask, {at(bracket.low), at(bracket.high), p.radius}))
      return RemovalStep{{at(top), at(top), p.radius}, top, 0.0, 0.0, {}, true};
    for (int trial = 0; trial < kMaxTrials && !found; ++trial)
    {
      if (bracket.high - bracket.low < kFinest * p.h)
        break;
      depth = bracket.next(kAim * wish.work, trial, guess);
      const double work = p.window.work(at(depth), p.radius);
      if (work > wish.work)
      {
        bracket.high = depth;
        bracket.workHigh = work;
        continue;
      }
      bracket.low = depth;
      bracket.workLow = work;
      bracket.triedLow = true;
      found = work >= kEnough * wish.work || depth >= top;
    }
    if (found || bracket.triedLow)
      break;
    // Too much even at the lower end: the burr penetrates the remaining tissue there.
    const double farthest = -kFarthest * p.radius;
    if (bracket.low <= farthest)
      return std::nullopt;
    bracket.low = std::max(bracket.low - back, farthest);
    bracket.start = bracket.low;
    guess = 0.5 * (bracket.low + bracket.high);
  }
  if (!found)
    depth = bracket.low;
  RemovalStencil::Taken taken = p.window.taken(at(depth), p.radius, wish.spindle);
  const bool capped = depth >= top;
  if (!(taken.volume > kMinBite * p.window.partVolume() && taken.work > 0.0))
  {
    if (!capped)
      return std::nullopt;
    taken = {};
  }
  if (bracket.workHigh > bracket.workLow && bracket.triedLow)
    p.yielding = (bracket.high - bracket.low) / (bracket.workHigh - bracket.workLow);
  else if (taken.work > 0.0 && depth > begin)
    p.yielding = (depth - begin) / taken.work;
  p.known = true;
  p.end = at(depth);
  taken.patch.arm *= p.burr / p.radius; // the cut is wider than the burr, whose teeth do the work
  return RemovalStep{
      {p.end, p.end, p.radius}, depth, taken.volume, taken.work, taken.patch, capped};
}

std::optional<double> RemovalDepthSolver::ahead(const volume::CutMask& mask, const Vector3d& place,
                                                const Vector3d& into) const
{
  const Parts& p = *m_parts;
  const core::GridGeometry& grid = p.tissue.geometry();
  for (double s = -p.radius; s <= p.radius + kAheadOf * p.h; s += kAheadStep * p.h)
  {
    const Vector3d point = place + s * into;
    const Vector3d voxel = grid.voxelFromPatient(point);
    if (grid.hullContains(voxel) && mask.sample(voxel) > 0.5 && p.tissue.uncut(point) > 0.0)
      return p.resistance.at(point);
  }
  return std::nullopt;
}

double RemovalDepthSolver::yielding() const noexcept
{
  return m_parts->yielding;
}

void RemovalDepthSolver::forget() noexcept
{
  m_parts->known = false;
  m_parts->yielding = 0.0;
}

double RemovalDepthSolver::radius() const noexcept
{
  return m_parts->burr;
}

} // namespace petrous::dissection
