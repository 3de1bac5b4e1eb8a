#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "petrous/Dissection/Catalogues.h"

namespace petrous::presenters
{

/// A library's materials and burrs as tables, in the units of their files. A change that the
/// removal laws do not allow is refused as a whole.
class CatalogueEditor
{
public:
  struct Material
  {
    std::string name;            ///< in commands and cases: a to z, 0 to 9 and hyphens
    std::string title;           ///< display name
    double specificEnergy = 0.0; ///< GPa
    double friction = 0.0;       ///< -
    double hardness = 0.0;       ///< HV
    std::string certainty = {};  ///< how certain the numbers are; empty: not stated
    std::string source = {};     ///< of the numbers; empty: not stated
  };

  struct Burr
  {
    std::string name; ///< in commands and cases: a to z, 0 to 9 and hyphens
    dissection::Burr::Kind kind = dissection::Burr::Kind::Cutting;
    double constant = 0.0;         ///< rake in degrees of a cutting burr, wear coefficient of a
                                   ///< diamond one
    std::vector<double> diameters; ///< mm, ascending
    double grit = 0.0;             ///< um, mean diameter of a diamond burr's grains; 0: not stated
    std::string certainty = {};
    std::string source = {};
  };

  /// Reads the catalogues of a library's folder. Throws as dissection::Catalogues::in.
  explicit CatalogueEditor(std::filesystem::path folder);

  /// With the built-in table in place of a file that cannot be understood; save() replaces the
  /// file.
  static CatalogueEditor repairing(const std::filesystem::path& folder);

  const std::vector<Material>& materials() const noexcept { return m_now.materials; }
  const std::vector<Burr>& burrs() const noexcept { return m_now.burrs; }
  const dissection::BoneRamp& bone() const noexcept { return m_now.bone; }
  /// The tables as materials.json and burrs.json have them.
  std::string materialsText() const { return materialsJson(m_now); }
  std::string burrsText() const { return burrsJson(m_now); }

  /// Whether presets, or cases by themselves, give that material to structures: it has its name for
  /// good.
  bool isBuiltIn(std::size_t material) const;

  /// Whether it is the usual burr of its kind: it has its name for good.
  bool isUsualBurr(std::size_t burr) const;

  /// Names of materials that cases may refer to and that would no longer exist once saved.
  std::vector<std::string> lostMaterials() const;
  std::vector<std::string> lostBurrs() const; ///< likewise

  // These throw InvalidParameter, without effect. A number out of its range is told by the range in
  // the table's unit: "must lie above 0 GPa, it is -3". If a number other than a diameter changes,
  // its row loses the certainty and the source that were stated of the number before, and keeps
  // those that are set with it.
  void setMaterial(std::size_t row, const Material& material);
  /// With the numbers of a row, under a free name, without source and certainty; returns the new
  /// row.
  std::size_t addMaterial(std::size_t like);
  void removeMaterial(std::size_t row);
  void setBurr(std::size_t row, const Burr& burr); ///< its kind stays
  std::size_t addBurr(std::size_t like);           ///< likewise
  void removeBurr(std::size_t row);

  void setBuiltIn(); ///< all as it comes with the program
  bool changed() const;

  /// Writes materials.json and burrs.json in the folder, each only if its table has changed; what
  /// is as it comes with the program has no file there. Throws core::OutputFileError.
  void save();

private:
  struct Tables
  {
    std::vector<Material> materials;
    dissection::BoneRamp bone;
    std::vector<Burr> burrs;
  };
  CatalogueEditor(std::filesystem::path folder, const dissection::Catalogues& saved);
  static Tables tablesOf(const dissection::Catalogues& catalogues);
  static std::string materialsJson(const Tables& tables);
  static std::string burrsJson(const Tables& tables);
  void take(Tables next);

  std::filesystem::path m_folder;
  Tables m_builtIn, m_saved, m_now;
};

/// "1, 2, 2.3".
std::string diametersText(const std::vector<double>& diameters);
/// And back; blanks and semicolons separate. A comma separates where a blank or the end follows and
/// there is no semicolon; otherwise it is decimal. Throws InvalidParameter unless all are diameters
/// above 0, up to kMaxBurrDiameter.
std::vector<double> diametersFrom(const std::string& text);

} // namespace petrous::presenters
