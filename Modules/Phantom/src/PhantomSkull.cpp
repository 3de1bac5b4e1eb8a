#include <cmath>

#include "PhantomAnatomy.h"

namespace petrous::phantom::anatomy
{
namespace
{

using namespace shapes;

/// Floor of the middle fossa: level above ear and mastoid, raised above the superior canal (arcuate
/// eminence), falling towards the temporal pole.
Shape middleFossa()
{
  return {[](const Point& p)
          {
            constexpr double kLevel = 12.2;
            constexpr double kFall = 0.55;
            const double ahead = 0.5 * (-8.0 - p.y());
            const double soft = ahead > 30.0 ? ahead : std::log1p(std::exp(ahead));
            const double slope = kFall / (1.0 + std::exp(-ahead));
            const double u = (p.x() + 38.5) / 3.2;
            const double v = (p.y() - 1.3) / 3.2;
            const double bump = 1.2 * std::exp(-0.5 * (u * u + v * v));
            const double height = kLevel - 2.0 * kFall * soft + bump;
            const double steep = slope * slope + bump * bump * (u * u + v * v) / (3.2 * 3.2);
            return (height - p.z()) / std::sqrt(1.0 + steep);
          },
          everywhere()};
}

Shape cranialCavity()
{
  // The posterior face of the petrous pyramid runs from posterolateral to anteromedial.
  const Eigen::Vector3d face = Eigen::Vector3d(0.66, 0.745, 0.10).normalized();
  const Shape behind = halfSpace(-face, 15.8);
  const Shape floor = halfSpace(Eigen::Vector3d(0.0, 0.05, -1.0).normalized(), 18.0);
  const Shape posterior = blendCommon(behind, floor, 8.0);
  const Shape vault = sphere({15.0, 12.0, 15.0}, 73.5);
  return blendCommon(blend({middleFossa(), posterior}, 5.0), vault, 6.0);
}

} // namespace

Skull makeSkull()
{
  Skull s;
  s.cranial = remembered(cranialCavity());

  const Shape mastoid = capsule({{-50.0, 12.0, 2.0}, 11.5}, {{-52.5, 9.5, -20.5}, 5.8});
  const Shape petrous = capsule({{-50.0, 6.0, 0.5}, 12.0}, {{-14.0, -17.0, 0.0}, 8.0});
  const Shape tympanic = capsule({{-61.0, -0.5, 1.0}, 6.0}, {{-47.0, -2.5, -1.0}, 8.5});
  const Shape zygoma = tube(
      spline({{{-55.0, 0.0, 6.5}, 4.5}, {{-61.0, -12.0, 5.0}, 3.6}, {{-66.5, -36.0, 3.5}, 3.0}}));
  const Shape styloid = tube(spline(
      {{{-45.0, 1.0, -11.0}, 3.2}, {{-44.5, -0.5, -18.0}, 1.8}, {{-42.5, -5.0, -34.0}, 1.1}}));
  const Shape vault = grown(s.cranial, 4.2); // squama, occiput and the floors of the fossae
  const Shape digastric = capsule({{-46.5, 24.0, -21.0}, 3.2}, {{-47.5, 5.0, -22.0}, 2.4});

  s.joint = ellipsoid({-53.5, -17.0, -5.5}, {9.5, 7.0, 8.0});
  s.condyle = blend({ellipsoid({-53.5, -17.0, -5.5}, {7.0, 3.6, 4.5}),
                     capsule({{-54.0, -17.5, -8.0}, 3.0}, {{-56.0, -19.0, -34.0}, 4.0})},
                    2.0);
  // the mastoid continues smoothly into the occiput
  const Shape angle = capsule({{-49.0, 13.0, 5.0}, 11.5}, {{-40.0, 38.0, 2.0}, 11.0});
  const Shape solid = blend({vault, mastoid, angle, petrous, tympanic, zygoma}, 4.0);
  const Shape carved =
      blendCommon(blendCommon(solid, complement(s.joint), 2.0), complement(digastric), 1.5);
  s.bone = remembered(blend({carved, styloid}, 1.0));

  // Veins: the sigmoid sinus curves from the transverse sinus inferiorly and medially to the bulb.
  s.sigmoid = tube(spline({{{-41.0, 44.0, 6.0}, 4.4},
                           {{-48.0, 31.0, 6.5}, 4.5},
                           {{-51.5, 21.0, 3.5}, 4.6},
                           {{-51.0, 17.0, -4.0}, 4.5},
                           {{-47.5, 15.0, -11.0}, 4.3},
                           {{-42.5, 11.5, -14.0}, 4.1}}));
  s.jugular = blend(
      {ellipsoid({-38.5, 6.5, -11.5}, {4.3, 4.3, 4.6}), tube(spline({{{-42.5, 11.5, -14.0}, 3.8},
                                                                     {{-38.8, 7.2, -12.5}, 4.0},
                                                                     {{-38.5, 4.5, -20.0}, 3.9},
                                                                     {{-39.5, 2.0, -36.0}, 4.0}}))},
      1.5);
  s.carotid = tube(spline({{{-40.0, -7.0, -38.0}, 2.7},
                           {{-39.5, -8.5, -22.0}, 2.7},
                           {{-39.5, -10.5, -12.0}, 2.7},
                           {{-37.5, -13.0, -7.5}, 2.7},
                           {{-31.0, -16.5, -5.5}, 2.7},
                           {{-19.0, -23.0, -4.0}, 2.6},
                           {{-9.0, -28.0, 1.0}, 2.5}}));

  const Shape neck = capsule({{-8.0, 4.0, -15.0}, 55.0}, {{-6.0, 2.0, -90.0}, 50.0});
  s.skin =
      blend({sphere({15.0, 12.0, 15.0}, 84.0), grown(mastoid, 5.5), grown(zygoma, 5.0), neck}, 8.0);
  s.skin = remembered(s.skin);
  s.sigmoid = remembered(s.sigmoid);
  s.jugular = remembered(s.jugular);
  s.condyle = remembered(s.condyle);
  return s;
}

Shape cellRegion(const Skull& skull, const Ear& ear)
{
  const Shape extent = blend({ellipsoid({-53.0, 12.0, -3.0}, {10.5, 13.0, 20.0}),
                              ellipsoid({-47.5, 8.0, 8.0}, {9.0, 9.0, 5.0}),
                              ellipsoid({-56.0, -1.0, 9.0}, {6.5, 7.0, 4.0})},
                             3.0);
  return {[=](const Point& p)
          {
            double d = extent(p);
            // cheap borders first; once outside, always outside
            if (d > 6.0)
              return d;
            // at least `gap` mm from a shape, which is evaluated only where it can decide
            const auto keepOff = [&](const Shape& shape, double gap)
            {
              const double near = std::max(gap - d, 0.0);
              if (shape.box.squaredExteriorDistance(p) <= near * near)
                d = std::max(d, gap - shape(p));
            };
            d = std::max(d, skull.bone(p) + 2.2);
            keepOff(skull.cranial, kTegmenThickness);
            keepOff(skull.sigmoid, 1.0);
            keepOff(ear.canal, 1.2);
            keepOff(skull.joint, 1.0);
            keepOff(ear.antrum, 0.5);
            keepOff(ear.cavity, 0.8);
            keepOff(ear.facialCanal, 1.1);
            keepOff(ear.labyrinth, 2.0);
            keepOff(skull.jugular, 1.2);
            return d;
          },
          extent.box};
}

} // namespace petrous::phantom::anatomy
