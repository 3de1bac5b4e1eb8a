#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "PhantomShapes.h"

/// The anatomy of the phantom as shapes in patient LPS mm: -x is lateral (a right ear), -y is
/// anterior, +z superior. Dimensions follow textbooks of otologic anatomy; each builder lists those
/// relevant to the surgeon.
namespace petrous::phantom::anatomy
{

/// Skull and its contents, without the ear.
struct Skull
{
  shapes::Shape skin;    ///< the head with its soft tissue
  shapes::Shape bone;    ///< outer surface of bone, cranial cavity not subtracted
  shapes::Shape cranial; ///< inner surface of the dura
  shapes::Shape condyle; ///< of the mandible
  shapes::Shape joint;   ///< its surrounding soft tissue
  shapes::Shape sigmoid;
  shapes::Shape jugular;
  shapes::Shape carotid;
};
Skull makeSkull();

/// Ear structures and nerves.
struct Ear
{
  shapes::Shape canal;   ///< external auditory canal, lumen to the drum
  shapes::Shape drum;    ///< tympanic membrane
  shapes::Shape annulus; ///< tympanic ring
  shapes::Shape cavity;  ///< air of meso- and epitympanum, aditus and Eustachian tube
  shapes::Shape antrum;
  shapes::Shape malleus;
  shapes::Shape incus;
  shapes::Shape stapes;
  shapes::Shape windows; ///< niches of oval and round window, air
  shapes::Shape vestibule;
  shapes::Shape cochlea;
  shapes::Shape lateral; ///< semicircular canals
  shapes::Shape superior;
  shapes::Shape posterior;
  shapes::Shape labyrinth; ///< all fluid spaces of the inner ear
  shapes::Shape meatus;    ///< internal auditory canal
  shapes::Shape eighthNerve;
  shapes::Shape facialNerve;
  shapes::Shape facialCanal; ///< lumen of the facial nerve
  shapes::Shape facialWall;  ///< outer surface of the canal's bone
  shapes::Shape chorda;
  shapes::Shape cholesteatoma;
};
Ear makeEar(const Skull& skull);

/// Axes and centres against which tests check the shapes.
struct CanalPlane
{
  shapes::Point center;
  Eigen::Vector3d normal;
  double radius;
};
std::array<CanalPlane, 3> canalPlanes(); ///< lateral, superior, posterior

/// Axis of the facial nerve's bony canal, and the radius of its lumen.
std::vector<shapes::Knot> facialCanalAxis();

/// Region of the mastoid, perilabyrinthine and zygomatic cells, without cortex and plates.
shapes::Shape cellRegion(const Skull& skull, const Ear& ear);

/// One layer: a later layer covers the ones before.
struct Layer
{
  shapes::Shape shape;
  double ct = 0.0;  ///< HU
  double mr = 0.0;  ///< arbitrary units, T2-like
  std::string name; ///< empty: not a structure
  std::array<float, 3> color{};
  bool solid = true;
  double mesh = 0.0;   ///< mm, sampling distance of its surface; 0: no surface
  double mottle = 0.0; ///< relative standard deviation of the intensity due to trabeculae
};
std::vector<Layer> paint(std::uint64_t seed, bool cholesteatoma);

/// Distance to the floor of the cranial cavity above ear and mastoid, mm (positive in bone).
constexpr double kTegmenThickness = 1.2;

} // namespace petrous::phantom::anatomy
