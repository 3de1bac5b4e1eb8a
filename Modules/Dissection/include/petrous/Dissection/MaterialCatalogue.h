#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace petrous::dissection
{

/// What a drill meets: the constants of the removal laws, SI.
struct TissueMaterial
{
  std::string name;            ///< e.g. "cortical-bone": the word of commands and manifests
  std::string title;           ///< for people
  double specificEnergy = 0.0; ///< W_c, Pa, at surgical drill speeds
  double friction = 0.0;       ///< mu
  double hardness = 0.0;       ///< H, Pa
  std::string status;          ///< where the numbers come from, and how sure they are
};

/// Bone that nobody labelled: between two materials by its density, linear in HU.
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
  /// The catalogue that the program carries.
  static MaterialCatalogue builtIn();

  /// From JSON text; `source` names it in errors. Throws InvalidParameter "SOURCE: material 'NAME':
  /// ..." that says what is wrong and what would be right.
  MaterialCatalogue(std::string_view json, const std::string& source);

  const std::vector<TissueMaterial>& all() const noexcept { return m_materials; }
  const BoneRamp& bone() const noexcept { return m_bone; }

  bool contains(const std::string& name) const noexcept;

  /// Throws InvalidParameter listing the names that there are.
  const TissueMaterial& material(const std::string& name) const;

private:
  std::vector<TissueMaterial> m_materials;
  BoneRamp m_bone;
};

} // namespace petrous::dissection
