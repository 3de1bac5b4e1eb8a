#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace petrous::dissection
{

// Units of materials.json.
constexpr double kPascalOfGiga = 1e9;
constexpr double kPascalOfVickers = 9.807e6; ///< of 1 HV = 1 kgf/mm^2

/// A drillable material: the constants of the removal laws, SI.
struct TissueMaterial
{
  std::string name;            ///< e.g. "cortical-bone"; used in commands and manifests
  std::string title;           ///< display name
  double specificEnergy = 0.0; ///< W_c, Pa, at surgical drill speeds
  double friction = 0.0;       ///< mu
  double hardness = 0.0;       ///< H, Pa
  std::string certainty;       ///< how certain the numbers are; empty: not stated
  std::string status;          ///< where they come from
};

/// Unlabelled bone: interpolated between two materials by density, linear in HU.
struct BoneRamp
{
  std::string cellular; ///< material at `low` and below
  std::string cortical; ///< material at `high` and above
  double low = 300.0;   ///< HU of a calibrated CT
  double high = 1800.0;
};

/// The tissue materials (Resources/materials.json).
class MaterialCatalogue
{
public:
  /// The built-in catalogue.
  static MaterialCatalogue builtIn();

  /// From JSON text; `source` names it in errors. Throws InvalidParameter "SOURCE: material 'NAME':
  /// ..." with the error and what would be valid.
  MaterialCatalogue(std::string_view json, const std::string& source);

  const std::vector<TissueMaterial>& all() const noexcept { return m_materials; }
  const BoneRamp& bone() const noexcept { return m_bone; }

  bool contains(const std::string& name) const noexcept;

  /// Throws InvalidParameter listing the known names.
  const TissueMaterial& material(const std::string& name) const;

private:
  std::vector<TissueMaterial> m_materials;
  BoneRamp m_bone;
};

} // namespace petrous::dissection
