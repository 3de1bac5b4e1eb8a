#include <cmath>

#include "PhantomAnatomy.h"

namespace petrous::phantom::anatomy
{
namespace
{

using namespace shapes;
using Eigen::Vector3d;

const Point kVestibule(-38.4, 1.0, 1.4);
const Point kOvalWindow(-40.62, 0.9, 1.0);
const Point kStapesHead(-43.6, 0.8, 0.6);
const Point kUmbo(-46.4, -1.9, -0.2);

/// The drum: a shallow cone, 9 mm wide, whose outer side faces laterally, anteriorly and
/// inferiorly.
struct Drum
{
  Vector3d normal = Vector3d(-0.88, -0.28, -0.38).normalized(); // out of the ear
  double depth = 1.6;
  double radius = 4.5;
  Point center = kUmbo + depth * normal;

  /// mm lateral of the membrane's middle surface.
  double side(const Point& p) const
  {
    const Vector3d q = p - center;
    const double height = q.dot(normal);
    const double ring = (q - height * normal).norm();
    const double cone = -depth * (1.0 - std::min(ring / radius, 1.0));
    return (height - cone) / std::hypot(1.0, depth / radius);
  }
};

/// Two and a half turns about the modiolus, a logarithmic spiral that rises to the apex.
///   r(theta) = 4.2 exp(-b theta),  tube radius 1.0 exp(-c theta)
/// Seen from the apex, a right cochlea turns anticlockwise from the base.
std::vector<Knot> cochlearSpiral()
{
  const Point base(-37.6, -4.4, -0.9);
  const Vector3d apex = Vector3d(-0.66, -0.72, -0.20).normalized();
  const Vector3d back = (Vector3d::UnitY() - apex.y() * apex).normalized();
  const Vector3d turn = apex.cross(back);
  constexpr double kEnd = 5.0 * 3.14159265358979323846;
  const double b = std::log(4.2 / 1.0) / kEnd;
  const double c = std::log(1.0 / 0.5) / kEnd;
  std::vector<Knot> knots;
  knots.push_back({Point(-39.2, 0.2, -0.2), 0.9}); // hook, from the vestibule
  constexpr int kPieces = 180;
  for (int i = 6; i <= kPieces; ++i)
  {
    const double theta = kEnd * i / kPieces;
    const double r = 4.2 * std::exp(-b * theta);
    const double rise = 4.0 * theta / kEnd;
    knots.push_back({base + rise * apex + r * (std::cos(theta) * back + std::sin(theta) * turn),
                     1.0 * std::exp(-c * theta)});
  }
  return knots;
}

/// A semicircular canal: circle in a plane, from angle `first` to `last` (radians, from u to v),
/// with both ends extended into the vestibule, one of them widened to an ampulla.
struct Arc
{
  CanalPlane plane;
  Vector3d u;
  Vector3d v;
  double first;
  double last;

  Point at(double angle) const
  {
    return plane.center + plane.radius * (std::cos(angle) * u + std::sin(angle) * v);
  }
};

constexpr double kCanalRadius = 0.5; // of the tube: 1.0 mm wide
constexpr double kAmpullaRadius = 0.95;

Shape canalShape(const Arc& arc, const Point& firstEnd, const Point& lastEnd, bool ampullaFirst)
{
  std::vector<Knot> knots{{firstEnd, kCanalRadius}};
  constexpr int kPieces = 64;
  for (int i = 0; i <= kPieces; ++i)
    knots.push_back({arc.at(arc.first + (arc.last - arc.first) * i / kPieces), kCanalRadius});
  knots.push_back({lastEnd, kCanalRadius});
  const Point ampulla = ampullaFirst ? arc.at(arc.first) : arc.at(arc.last);
  return blend({tube(knots), sphere(ampulla, kAmpullaRadius)}, 0.6);
}

Arc lateralArc()
{
  // tilted by 25 degrees, anterior end up
  const double tilt = 25.0 * 3.14159265358979323846 / 180.0;
  const Vector3d v(0.0, -std::cos(tilt), std::sin(tilt));
  const Vector3d u(-1.0, 0.0, 0.0);
  return {{kVestibule + Vector3d(-2.1, 1.0, 2.8), u.cross(v), 2.9}, u, v, 2.25, -2.25};
}

Arc superiorArc()
{
  const Vector3d u = Vector3d(-1.0, -1.0, 0.0).normalized(); // anterolateral
  return {{kVestibule + Vector3d(0.3, 0.3, 4.2), u.cross(Vector3d::UnitZ()), 3.3},
          u,
          Vector3d::UnitZ(),
          -0.9,
          3.14159265358979323846 + 0.9};
}

Arc posteriorArc()
{
  const Vector3d u = Vector3d(-1.0, 1.0, 0.0).normalized(); // posterolateral
  return {{kVestibule + Vector3d(1.45, 1.45, 0.0) + 3.0 * u + Vector3d(0.0, 0.0, -0.4),
           u.cross(Vector3d::UnitZ()), 3.3},
          u,
          Vector3d::UnitZ(),
          2.5,
          -2.45};
}

void addLabyrinth(Ear& ear)
{
  ear.vestibule = ellipsoid(kVestibule, {2.0, 2.7, 2.4});
  const Point inner = kVestibule + Vector3d(0.0, 0.3, 0.2);
  const Arc lateral = lateralArc();
  const Arc superior = superiorArc();
  const Arc posterior = posteriorArc();
  const Point crus = kVestibule + Vector3d(1.0, 1.2, 0.9); // opening of the common crus
  ear.lateral = canalShape(lateral, inner + Vector3d(-0.6, -0.8, 1.0),
                           inner + Vector3d(-0.6, 0.9, 0.5), true);
  ear.superior = canalShape(superior, inner + Vector3d(-0.8, -0.8, 0.8), crus, true);
  ear.posterior =
      canalShape(posterior, superior.at(superior.last), inner + Vector3d(0.4, 1.2, -0.9), false);
  ear.superior = remembered(ear.superior);
  ear.cochlea = remembered(tube(cochlearSpiral()));
  ear.labyrinth =
      remembered(merge({ear.vestibule, ear.cochlea, ear.lateral, ear.superior, ear.posterior}));
}

void addOssicles(Ear& ear)
{
  const Point lateralProcess(-48.4, -2.9, 3.1);
  ear.malleus = blend({ellipsoid({-46.2, -3.6, 6.5}, {1.25, 1.2, 1.5}),
                       tube(spline({{{-46.3, -3.6, 6.0}, 0.7},
                                    {{-47.1, -3.3, 4.5}, 0.6},
                                    {{-47.5, -3.0, 3.3}, 0.6},
                                    {{-46.9, -2.4, 1.3}, 0.5},
                                    {kUmbo, 0.45}})),
                       capsule({{-47.4, -3.1, 3.5}, 0.5}, {lateralProcess, 0.35})},
                      0.5);
  ear.incus = blend({ellipsoid({-46.3, -0.45, 6.5}, {1.1, 1.45, 1.45}),
                     capsule({{-46.3, 0.4, 6.6}, 0.95}, {{-46.9, 4.0, 6.2}, 0.35}),
                     tube(spline({{{-46.3, -0.1, 6.0}, 0.75},
                                  {{-46.1, 0.9, 3.6}, 0.45},
                                  {{-45.6, 1.3, 1.6}, 0.35},
                                  {{-45.2, 1.2, 0.7}, 0.33},
                                  {{-44.45, 0.9, 0.6}, 0.33}}))},
                    0.5);
  const Vector3d along = Vector3d::UnitY();
  const auto crus = [&](double side)
  {
    return tube(spline({{kOvalWindow + Vector3d(-0.1, side * 1.15, 0.0), 0.2},
                        {kOvalWindow + Vector3d(-1.0, side * 1.1, -0.1), 0.2},
                        {kOvalWindow + Vector3d(-1.9, side * 0.75, -0.25), 0.2},
                        {kStapesHead + Vector3d(0.25, side * 0.1, 0.0), 0.25}},
                       0.15));
  };
  ear.stapes = blend({disc(kOvalWindow, along, Vector3d::UnitZ(), 1.45, 0.7, 0.16), crus(-1.0),
                      crus(1.0), sphere(kStapesHead, 0.4)},
                     0.2);
}

std::vector<Knot> facialKnots()
{
  // Labyrinthine segment, geniculate ganglion, tympanic segment above the oval window, second genu
  // below the lateral canal, mastoid segment, stylomastoid foramen.
  return {{{-20.0, 0.0, 2.6}, 0.6},   {{-27.0, -0.4, 2.3}, 0.6},  {{-33.5, -1.2, 2.5}, 0.6},
          {{-35.4, -2.2, 3.4}, 0.5},  {{-37.3, -4.0, 4.6}, 0.55}, {{-38.6, -5.6, 5.2}, 0.9},
          {{-40.1, -4.6, 4.9}, 0.6},  {{-41.8, -2.1, 4.1}, 0.6},  {{-43.3, 0.7, 3.2}, 0.6},
          {{-44.8, 3.2, 2.1}, 0.6},   {{-45.5, 4.7, 0.2}, 0.6},   {{-46.0, 5.4, -4.0}, 0.6},
          {{-46.6, 6.0, -10.0}, 0.6}, {{-46.9, 6.0, -15.0}, 0.6}, {{-47.6, 4.6, -19.5}, 0.65},
          {{-50.0, 0.0, -24.0}, 0.7}, {{-54.0, -7.0, -30.0}, 0.7}};
}

void addNerves(Ear& ear)
{
  ear.facialNerve = tube(spline(facialKnots(), 0.3));
  ear.facialCanal = remembered(tube(facialCanalAxis()));
  ear.facialWall = remembered(grown(ear.facialCanal, 0.35));
  ear.chorda = tube(spline({{{-46.5, 5.9, -9.0}, 0.25},
                            {{-47.6, 4.5, -4.0}, 0.25},
                            {{-48.2, 2.7, 1.0}, 0.25},
                            {{-47.4, 0.3, 3.8}, 0.25},
                            {{-46.3, -2.6, 4.2}, 0.25},
                            {{-46.4, -5.4, 3.6}, 0.25},
                            {{-46.0, -8.5, 2.6}, 0.25}},
                           0.2));
  ear.meatus = tube(spline({{{-21.0, 1.6, 1.2}, 3.6},
                            {{-25.5, 0.6, 1.2}, 2.6},
                            {{-29.5, 0.1, 1.2}, 2.3},
                            {{-33.0, -0.5, 1.3}, 2.0}}));
  ear.eighthNerve = tube(spline({{{-19.0, 1.5, 0.6}, 0.9},
                                 {{-27.0, 0.6, 0.4}, 0.9},
                                 {{-33.0, -0.8, 0.4}, 0.8},
                                 {{-35.0, -2.2, 0.0}, 0.5}}));
}

} // namespace

std::array<CanalPlane, 3> canalPlanes()
{
  return {lateralArc().plane, superiorArc().plane, posteriorArc().plane};
}

std::vector<Knot> facialCanalAxis()
{
  const std::vector<Knot> nerve = facialKnots();
  std::vector<Knot> axis = spline({nerve.begin() + 3, nerve.begin() + 14}, 0.3);
  for (Knot& knot : axis)
    knot.radius += 0.3;
  return axis;
}

Ear makeEar(const Skull& skull)
{
  Ear ear;
  const Drum drum;
  const Shape outer = tube(spline({{{-80.0, 3.5, -2.5}, 4.2},
                                   {{-67.0, 1.4, 0.3}, 3.8},
                                   {{-59.0, -1.2, 1.3}, 3.5},
                                   {{-53.0, -2.0, 0.4}, 3.6},
                                   {{-48.5, -2.3, -0.7}, 4.4},
                                   {{-46.0, -2.1, -0.6}, 4.4}}));
  const Shape lateralOfDrum{[drum](const Point& p) { return -drum.side(p); }, everywhere()};
  ear.canal = remembered(common({outer, lateralOfDrum, skull.skin}));
  ear.drum = {[drum](const Point& p)
              {
                const Vector3d q = p - drum.center;
                const double height = q.dot(drum.normal);
                const double ring = (q - height * drum.normal).norm() - drum.radius - 0.3;
                return std::max(std::abs(drum.side(p)) - 0.15, ring);
              },
              Box(drum.center.array() - 5.0, drum.center.array() + 5.0)};
  ear.annulus = torus(drum.center, drum.normal, drum.radius + 0.2, 0.45);

  // Tympanic cavity: 15 mm high and long, 2 mm wide at the umbo; the tegmen is its roof.
  const Shape meso = ellipsoid({-45.2, -2.2, -0.2}, {3.0, 5.6, 6.2});
  const Shape epi = ellipsoid({-46.4, -1.0, 7.0}, {2.7, 4.9, 4.6});
  const Shape aditus = capsule({{-46.6, 2.0, 7.2}, 2.5}, {{-47.8, 5.5, 7.4}, 2.6});
  const Shape tubal = tube(spline({{{-45.0, -6.0, 0.5}, 2.2},
                                   {{-42.5, -11.5, -1.0}, 1.3},
                                   {{-35.0, -22.0, -5.0}, 0.8},
                                   {{-27.0, -33.0, -11.0}, 0.8}}));
  const Shape behindDrum{[drum](const Point& p) { return drum.side(p); }, everywhere()};
  const Shape lower = common({merge({meso, grown(outer, -0.4)}), behindDrum});
  const Shape underTegmen{[cranial = skull.cranial](const Point& p)
                          { return kTegmenThickness - cranial(p); },
                          everywhere()};
  ear.cavity = remembered(blendCommon(blend({lower, epi, aditus, tubal}, 0.8), underTegmen, 0.4));
  ear.antrum =
      remembered(blendCommon(ellipsoid({-48.8, 7.2, 7.2}, {3.4, 4.6, 4.4}), underTegmen, 0.4));

  addLabyrinth(ear);
  addOssicles(ear);
  addNerves(ear);

  const Vector3d along = Vector3d::UnitY();
  ear.windows = merge(
      {disc(kOvalWindow + Vector3d(-0.9, 0.0, 0.0), along, Vector3d::UnitZ(), 1.7, 0.95, 0.85),
       capsule({{-40.9, 0.3, -1.9}, 0.6}, {{-42.6, 0.9, -2.2}, 0.8})});

  // Extends from the posterior epitympanum around the incus into the antrum.
  const Shape sac = blend({ellipsoid({-48.4, 5.8, 7.4}, {2.7, 3.3, 2.7}),
                           ellipsoid({-47.6, 1.2, 7.7}, {1.6, 3.0, 2.2})},
                          1.5);
  ear.cholesteatoma = common({sac, merge({ear.cavity, ear.antrum})});
  return ear;
}

} // namespace petrous::phantom::anatomy
