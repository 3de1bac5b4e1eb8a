#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "petrous/Dissection/MaterialCatalogue.h"
#include "petrous/Dissection/Stroke.h"

namespace petrous::dissection
{

constexpr double kMaxBurrDiameter = 10.0; ///< mm
constexpr double kMaxGrit = 1000.0;       ///< um

/// Wear coefficient of grains of that mean diameter, um, from that of coarse ones: wear does not
/// depend on the size of the grains above some 100 um, and falls with it below, here in proportion
/// (Documentation/equations.md, "grit"). Throws InvalidParameter unless both are above 0.
double wearOfGrit(double grit, double coarse);

/// A burr in all its diameters: its constants in the removal laws.
struct BurrModel
{
  std::string name; ///< identifies it; see isCatalogueName
  Burr::Kind kind = Burr::Kind::Cutting;
  double rake = 0.0;            ///< alpha, rad; cutting burr only
  double wearCoefficient = 0.0; ///< k; diamond burr only
  double grit = 0.0; ///< mean diameter of the grains, um; diamond burr only; 0: not stated
  std::vector<double> diameters; ///< mm, commercially available
  std::string certainty;         ///< how certain the numbers are; empty: not stated
  std::string status;            ///< where they come from
};

/// The burrs (Resources/burrs.json): any number of each kind, among them the usual one, which has
/// the kind's name.
class BurrCatalogue
{
public:
  /// The built-in catalogue.
  static BurrCatalogue builtIn();

  /// From JSON text; `source` names it in errors. A burr without a name is the usual one of its
  /// kind. Throws InvalidParameter naming the error and what would be valid.
  BurrCatalogue(std::string_view json, const std::string& source);

  /// The usual ones, cutting and diamond, then the others in the order of the file.
  const std::vector<BurrModel>& all() const noexcept { return m_models; }

  const BurrModel& model(Burr::Kind kind) const noexcept; ///< the usual one
  const BurrModel* find(const std::string& name) const noexcept;

  /// Throws InvalidParameter naming those that there are.
  const BurrModel& model(const std::string& name) const;

  /// That of a burr's name. Throws as above, also if it is of another kind here.
  const BurrModel& model(const Burr& burr) const;

private:
  std::vector<BurrModel> m_models; // see all()
};

/// Makes it a burr of that model; diameter and speed stay.
void setModel(Burr& burr, const BurrModel& model);

/// Energy per unit volume to remove the material with this burr: the law's resistance, N/mm^2 = N
/// mm / mm^3. Throws InvalidParameter naming both if the pair is outside the law's domain.
double resistanceOf(const TissueMaterial& material, const BurrModel& burr);

/// Throws as resistanceOf for the first pair outside its law's domain. For use when catalogues are
/// loaded, so that no error occurs during drilling.
void checkPairs(const MaterialCatalogue& materials, const BurrCatalogue& burrs);

} // namespace petrous::dissection
