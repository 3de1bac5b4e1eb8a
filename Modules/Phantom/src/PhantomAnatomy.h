#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "PhantomShapes.h"

/// The anatomy of the phantom as shapes in patient LPS mm: -x is lateral (a right ear), -y is
/// anterior, +z superior. Dimensions follow textbooks of otologic anatomy; each builder names
/// those that matter to the hand.
namespace petrous::phantom::anatomy
{

/// Skull and what lies in it, without the ear.
struct Skull
{
  shapes::Shape skin;    ///< the head with its soft tissue
  shapes::Shape bone;    ///< outer surface of bone, cranial cavity not taken out
  shapes::Shape cranial; ///< inside of the dura
  shapes::Shape condyle; ///< of the mandible
  shapes::Shape joint;   ///< soft tissue round it
  shapes::Shape sigmoid;
  shapes::Shape jugular;
  shapes::Shape carotid;
};
Skull makeSkull();

/// Hearing and balance, and the nerves.
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
  shapes::Shape facialCanal; ///< lumen in which the nerve lies
  shapes::Shape facialWall;  ///< outside of the canal's bone
  shapes::Shape chorda;
  shapes::Shape cholesteatoma;
};
Ear makeEar(const Skull& skull);

/// Axes and centres that tests hold against the shapes.
struct CanalPlane
{
  shapes::Point center;
  Eigen::Vector3d normal;
  double radius;
};
std::array<CanalPlane, 3> canalPlanes(); ///< lateral, superior, posterior

/// Where mastoid, perilabyrinthine and zygomatic cells are, cortex and plates left out.
shapes::Shape cellRegion(const Skull& skull, const Ear& ear);

/// One coat of paint: a later layer covers the ones before.
struct Layer
{
  shapes::Shape shape;
  double ct = 0.0;  ///< HU
  double mr = 0.0;  ///< arbitrary units, T2-like
  std::string name; ///< empty: no structure
  std::array<float, 3> color{};
  bool solid = true;
  double mesh = 0.0;   ///< mm between the samples of its surface; 0: it has none
  double mottle = 0.0; ///< share by which trabeculae vary the intensity, standard deviation
};
std::vector<Layer> paint(std::uint64_t seed, bool cholesteatoma);

/// Distance to the cranial cavity's floor above ear and mastoid, mm (positive in bone).
constexpr double kTegmenThickness = 1.2;

} // namespace petrous::phantom::anatomy
