#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace petrous::appearance
{

/// Force per depth, N/mm, of a ball pressed into incompressible tissue that is thick compared with
/// the contact, at that depth [Hertz]: F / d = 4/3 E / (1 - nu^2) sqrt(R d), nu = 1/2.
///   modulus  E, N/mm^2, > 0
///   radius   R of the ball, mm, > 0
///   depth    d, mm, > 0
/// Throws InvalidParameter.
double indentationStiffness(double modulus, double radius, double depth);

/// Force per deflection, N/mm, of a point load in the middle of a thin flat incompressible plate
/// that is clamped at a circle, for small deflections [Timoshenko and Woinowsky-Krieger]: 16 pi D /
/// a^2, D = E t^3 / (12 (1 - nu^2)), nu = 1/2.
///   modulus    E, N/mm^2, > 0
///   thickness  t, mm, > 0
///   radius     a of the circle, mm, > 0
/// Throws InvalidParameter.
double plateStiffness(double modulus, double thickness, double radius);

/// How a kind of soft tissue yields under a burr (StructureAppearance::stiffness), derived from
/// published moduli.
struct SoftTissue
{
  std::string name;       ///< identifies it, e.g. "nerve"; a to z and hyphens
  std::string title;      ///< display name
  double stiffness = 0.0; ///< N/mm, to two digits
  double lowest = 0.0;    ///< N/mm, from the lowest published values
  double highest = 0.0;
  std::string certainty; ///< e.g. "derived, within a factor of 8"
  std::string status;    ///< where the numbers come from
};

/// The kinds that come with the program (Resources/soft-tissues.json).
const std::vector<SoftTissue>& softTissues();

/// From JSON text; `source` names it in errors. Throws InvalidParameter.
std::vector<SoftTissue> parseSoftTissues(std::string_view json, const std::string& source);

/// nullptr: there is none of that name.
const SoftTissue* findSoftTissue(const std::string& name);

} // namespace petrous::appearance
