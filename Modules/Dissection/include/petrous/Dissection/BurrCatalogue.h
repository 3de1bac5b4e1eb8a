#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "petrous/Dissection/MaterialCatalogue.h"
#include "petrous/Dissection/Stroke.h"

namespace petrous::dissection
{

/// A kind of burr: the constants that it brings into the removal laws.
struct BurrModel
{
  Burr::Kind kind = Burr::Kind::Cutting;
  double rake = 0.0;             ///< alpha, rad; of a cutting burr
  double wearCoefficient = 0.0;  ///< k; of a diamond burr
  std::vector<double> diameters; ///< mm, that are sold
  std::string status;            ///< where the numbers come from, and how sure they are
};

/// The burrs (Resources/burrs.json), one model of each kind.
class BurrCatalogue
{
public:
  /// The catalogue that the program carries.
  static BurrCatalogue builtIn();

  /// From JSON text; `source` names it in errors. Throws InvalidParameter that says what is wrong
  /// and what would be right.
  BurrCatalogue(std::string_view json, const std::string& source);

  const BurrModel& model(Burr::Kind kind) const noexcept;

private:
  std::vector<BurrModel> m_models; // by kind
};

/// What a unit of volume of the material takes from the burr: the law's resistance, in N/mm^2 =
/// N mm / mm^3. Throws InvalidParameter that names both where the pair is out of the law's domain.
double resistanceOf(const TissueMaterial& material, const BurrModel& burr);

/// Throws as resistanceOf for the first pair that is out of its law's domain: for the time at which
/// catalogues are loaded, so that nothing is found out while a tool is in the hand.
void checkPairs(const MaterialCatalogue& materials, const BurrCatalogue& burrs);

} // namespace petrous::dissection
