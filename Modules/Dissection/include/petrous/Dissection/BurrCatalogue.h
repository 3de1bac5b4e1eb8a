#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "petrous/Dissection/MaterialCatalogue.h"
#include "petrous/Dissection/Stroke.h"

namespace petrous::dissection
{

constexpr double kMaxBurrDiameter = 10.0; ///< mm

/// A kind of burr: its constants in the removal laws.
struct BurrModel
{
  Burr::Kind kind = Burr::Kind::Cutting;
  double rake = 0.0;             ///< alpha, rad; cutting burr only
  double wearCoefficient = 0.0;  ///< k; diamond burr only
  std::vector<double> diameters; ///< mm, commercially available
  std::string status;            ///< source and reliability of the numbers
};

/// The burrs (Resources/burrs.json), one model of each kind.
class BurrCatalogue
{
public:
  /// The built-in catalogue.
  static BurrCatalogue builtIn();

  /// From JSON text; `source` names it in errors. Throws InvalidParameter naming the error and what
  /// would be valid.
  BurrCatalogue(std::string_view json, const std::string& source);

  const BurrModel& model(Burr::Kind kind) const noexcept;

private:
  std::vector<BurrModel> m_models; // by kind
};

/// Energy per unit volume to remove the material with this burr: the law's resistance, N/mm^2 = N
/// mm / mm^3. Throws InvalidParameter naming both if the pair is outside the law's domain.
double resistanceOf(const TissueMaterial& material, const BurrModel& burr);

/// Throws as resistanceOf for the first pair outside its law's domain. For use when catalogues are
/// loaded, so that no error occurs during drilling.
void checkPairs(const MaterialCatalogue& materials, const BurrCatalogue& burrs);

} // namespace petrous::dissection
