#include "TissueRay.h"

#include <algorithm>
#include <cmath>

namespace petrous::rendering
{

namespace
{
constexpr double kTolerance = 1e-5;      // relative to the smallest spacing
constexpr double kNothingVisible = 1e-6; // transmittance
constexpr double kGolden = 0.6180339887498949;
const double kGauss = 0.5 / std::sqrt(3.0); // relative to the segment's length, from its middle
} // namespace

struct TissueRay::Walk
{
  const PixelRay& ray;
  const optics::Lamp& lamp;
  GatheredLight light; // colour: of what is displayed as it is
  Eigen::Vector3d lit{0.0, 0.0, 0.0};
  double litShare = 0.0;
  TissueOptics::State state = TissueOptics::kAir;
  double end = 0.0;        // of the drawn region, or the opaque hit
  double t = 0.0;          // up to which tissue is accumulated
  double value = 0.0;      // intensity at t, if `valueKnown`
  bool valueKnown = false; // for the material of `state`

  Eigen::Vector3d at(double distance) const { return ray.origin + distance * ray.direction; }
};

struct TissueRay::Sample
{
  double t;
  TissueOptics::Place place;
};

TissueRay::TissueRay(const SceneContents& contents, double step, int sample)
  : m_optics(contents, sample)
  , m_drawn(contents.ct->geometry(), contents.crop, contents.clipping)
  , m_shadows(m_optics, m_drawn, contents)
  , m_step(step * contents.ct->geometry().minSpacing())
  , m_tolerance(kTolerance * contents.ct->geometry().minSpacing())
{
}

GatheredLight TissueRay::cast(const PixelRay& ray, double end, const optics::Lamp& lamp) const
{
  Walk walk{ray, lamp, {}};
  const RaySpan span = m_drawn.clip(ray);
  const double last = std::min(span.last, end);
  if (!(last > span.first))
    return walk.light;

  walk.t = span.first;
  walk.end = last;
  const auto steps = static_cast<long>(std::ceil((last - span.first) / m_step));
  const auto sample = [&](long i)
  { return sampleAt(ray, std::min(span.first + static_cast<double>(i) * m_step, last)); };
  Sample before = sample(0);
  if (TissueOptics::isSolid(before.place.state))
    // Tissue that contains the camera is cut off there by a face towards the camera.
    addSurface(walk, span.first, before.place.state,
               span.face ? *span.face : Eigen::Vector3d::Zero().eval());
  else if (before.place.state == TissueOptics::kSoft && span.isCut)
    if (const auto section = m_optics.softSection(walk.at(span.first)))
      add(walk, span.first, *section);
  walk.state = before.place.state;
  Sample here = sample(1);
  for (long i = 1; i <= steps && walk.light.transmittance > kNothingVisible; ++i)
  {
    const Sample after = i < steps ? sample(i + 1) : here;
    const auto turn = turningPoint(ray, before, here, after);
    if (turn && turn->t < here.t)
      walkTo(walk, *turn);
    walkTo(walk, here);
    if (turn && turn->t > here.t)
      walkTo(walk, *turn);
    before = here;
    here = after;
  }
  walk.light.color += optics::displayed(walk.lit, walk.litShare, m_optics.light());
  return walk.light;
}

TissueRay::Sample TissueRay::sampleAt(const PixelRay& ray, double t) const
{
  return {t, m_optics.at(ray.origin + t * ray.direction)};
}

// A point between three samples of the same state at which the state differs.
std::optional<TissueRay::Sample> TissueRay::turningPoint(const PixelRay& ray, const Sample& a,
                                                         const Sample& b, const Sample& c) const
{
  const double fall = a.place.margin - b.place.margin;
  const double rise = c.place.margin - b.place.margin;
  if (a.place.state != b.place.state || c.place.state != b.place.state || fall < 0.0 ||
      rise < 0.0 || fall + rise == 0.0 || b.place.margin > std::max(fall, rise))
    return std::nullopt;
  double low = a.t;
  double high = c.t;
  while (high - low > m_tolerance)
  {
    const Sample left = sampleAt(ray, high - kGolden * (high - low));
    const Sample right = sampleAt(ray, low + kGolden * (high - low));
    for (const Sample& sample : {left, right})
      if (sample.place.state != b.place.state)
        return sample;
    if (left.place.margin < right.place.margin)
      high = right.t;
    else
      low = left.t;
  }
  return std::nullopt;
}

// Processes every change of state up to `target` that bisection finds.
void TissueRay::walkTo(Walk& walk, const Sample& target) const
{
  if (!(target.t > walk.t))
    return;
  double known = walk.t; // the state at this point is walk.state
  while (walk.state != target.place.state)
  {
    double low = known;
    double high = target.t;
    TissueOptics::State next = target.place.state;
    while (high - low > m_tolerance)
    {
      const double middle = 0.5 * (low + high);
      const TissueOptics::State state = m_optics.at(walk.at(middle)).state;
      if (state == walk.state)
        low = middle;
      else
      {
        high = middle;
        next = state;
      }
    }
    const double hit = 0.5 * (low + high);
    gather(walk, hit);
    // Outside the hull of the voxels is air, where rounding takes the end of the ray there.
    const bool ends = !TissueOptics::isSolid(next) && hit > walk.end - 2.0 * m_tolerance;
    if (m_optics.isSurface(walk.state, next) && !ends)
      addSurface(walk, hit, next, std::nullopt);
    walk.state = next;
    walk.valueKnown = false;
    known = high;
  }
  gather(walk, target.t);
}

void TissueRay::addSurface(Walk& walk, double t, TissueOptics::State to,
                           const std::optional<Eigen::Vector3d>& face) const
{
  optics::Seen seen;
  if (m_optics.light().shadows && !face && !TissueOptics::isSolid(walk.state))
  {
    const Eigen::Vector3d point = walk.at(t);
    const Eigen::Vector3d normal = m_optics.normalAt(point, walk.state, to);
    const bool turned = normal.dot(walk.ray.direction) > 0.0;
    seen = m_shadows.at(point, turned ? -normal : normal, walk.lamp);
  }
  add(walk, t, m_optics.surfaceAt(walk.ray, t, walk.state, to, face, seen, walk.lamp.focus));
}

void TissueRay::add(Walk& walk, double t, const TissueOptics::Surface& surface)
{
  if (std::isnan(walk.light.depth))
    walk.light.depth = t;
  const double adds = walk.light.transmittance * surface.opacity;
  (surface.isLit ? walk.lit : walk.light.color) += adds * surface.color;
  walk.litShare += surface.isLit ? adds : 0.0;
  walk.light.transmittance *= 1.0 - surface.opacity;
}

// Integrates the tissue of the current state from walk.t on.
void TissueRay::gather(Walk& walk, double to) const
{
  const double from = walk.t;
  walk.t = std::max(from, to);
  if (walk.state == TissueOptics::kAir || !(to > from))
    return;
  const appearance::Material& material = m_optics.materialOf(walk.state);
  const appearance::TransferFunction& transfer = material.transfer;
  if (transfer.transparent())
    return;
  const double a = walk.valueKnown ? walk.value : m_optics.intensity(material, walk.at(from));
  const double b = m_optics.intensity(material, walk.at(to));
  walk.value = b;
  walk.valueKnown = true;

  const auto add = [&](double fraction, double length)
  {
    const auto optics = transfer.at(a + (b - a) * fraction);
    if (!(optics.extinction > 0.0))
      return;
    const double opacity = -std::expm1(-optics.extinction * length);
    const Eigen::Vector3d color(optics.color[0], optics.color[1], optics.color[2]);
    const double at = from + (to - from) * fraction;
    const double adds = walk.light.transmittance * opacity;
    walk.lit += adds * optics::interiorColor(
                           color, m_optics.light(), at, walk.lamp.focus,
                           m_optics.facingIn(walk.state, walk.at(at), walk.ray.direction));
    walk.litShare += adds;
    walk.light.transmittance *= 1.0 - opacity;
  };
  const auto addPiece = [&](double first, double last)
  {
    const double middle = 0.5 * (first + last);
    const double half = 0.5 * (last - first) * (to - from);
    add(middle - kGauss * (last - first), half);
    add(middle + kGauss * (last - first), half);
  };
  const std::vector<appearance::ControlPoint>& points = transfer.points();
  double done = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double bend = points[b > a ? i : points.size() - 1 - i].value;
    const double fraction = (bend - a) / (b - a); // not finite if the intensity is constant
    if (fraction > done && fraction < 1.0)
    {
      addPiece(done, fraction);
      done = fraction;
    }
  }
  addPiece(done, 1.0);
}

} // namespace petrous::rendering
