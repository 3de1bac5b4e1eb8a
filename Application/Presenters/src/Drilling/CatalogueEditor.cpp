#include "petrous/Presenters/CatalogueEditor.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Dissection/BurrName.h"
#include "petrous/Dissection/RemovalLaw.h"

namespace petrous::presenters
{

namespace
{

using Json = nlohmann::ordered_json;
using dissection::AbrasiveWear;
using dissection::kPascalOfGiga;
using dissection::kPascalOfVickers;
using dissection::OrthogonalCutting;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr const char* kMaterialsFile = "materials.json";
constexpr const char* kBurrsFile = "burrs.json";

// Without what conversion to SI and back adds.
double rounded(double value)
{
  return core::parseDouble(core::generalText(value, 12)).value_or(value);
}

void checkName(const std::string& name)
{
  if (!dissection::isCatalogueName(name))
    throw core::InvalidParameter("'" + name +
                                 "' cannot be a material's name: it has a to z, 0 to 9 and "
                                 "hyphens, at most 40");
}

bool isPositive(double value)
{
  return value > 0.0 && std::isfinite(value);
}

void requireWithin(bool holds, const std::string& range, double value)
{
  if (!holds)
    throw core::InvalidParameter("must lie " + range + ", it is " + core::plainText(value));
}

void requireAtMost(double limit, double value)
{
  requireWithin(value > 0.0 && value <= limit, "above 0 and at most at " + core::plainText(limit),
                value);
}

void checkNumbers(const CatalogueEditor::Material& material)
{
  requireWithin(isPositive(material.specificEnergy), "above 0 GPa", material.specificEnergy);
  requireAtMost(OrthogonalCutting::kMaxFriction, material.friction);
  requireWithin(isPositive(material.hardness), "above 0 HV", material.hardness);
}

void checkNumbers(const CatalogueEditor::Burr& burr)
{
  if (burr.kind == dissection::Burr::Kind::Diamond)
  {
    requireWithin(burr.grit >= 0.0 && burr.grit <= dissection::kMaxGrit,
                  "within 0 to " + core::plainText(dissection::kMaxGrit) + " micrometres",
                  burr.grit);
    return requireAtMost(AbrasiveWear::kMaxWearCoefficient, burr.constant);
  }
  const std::string steepest = core::plainText(rounded(OrthogonalCutting::kMaxRake / kDegree));
  requireWithin(std::abs(kDegree * burr.constant) <= OrthogonalCutting::kMaxRake,
                "within -" + steepest + " to " + steepest + " degrees", burr.constant);
}

// With a copy of a row, under a free name, at the end of one of the tables.
template <typename Tables, typename Row>
Tables withLike(Tables tables, std::vector<Row> Tables::*which, std::size_t like)
{
  std::vector<Row>& rows = tables.*which;
  Row added = rows.at(like);
  added.source.clear(); // of other numbers from now on: nobody has stated it
  added.certainty.clear();
  const std::string base = added.name;
  for (int n = 2; std::any_of(rows.begin(), rows.end(),
                              [&added](const Row& one) { return one.name == added.name; });
       ++n)
    added.name = base + "-" + std::to_string(n);
  rows.push_back(std::move(added));
  return tables;
}

// Of other numbers: what was stated of those before does not hold of them, what is set together
// with them does.
template <typename Row>
void dropStatements(Row& now, const Row& before)
{
  for (std::string Row::*text : {&Row::certainty, &Row::source})
    if (now.*text == before.*text)
      (now.*text).clear();
}

template <typename Tables, typename Row>
Tables without(Tables tables, std::vector<Row> Tables::*which, std::size_t row)
{
  std::vector<Row>& rows = tables.*which;
  rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(row));
  return tables;
}

template <typename Row>
std::vector<std::string> lostNames(const std::vector<Row>& before, const std::vector<Row>& now)
{
  std::vector<std::string> names;
  for (const Row& saved : before)
    if (std::none_of(now.begin(), now.end(),
                     [&saved](const Row& one) { return one.name == saved.name; }))
      names.push_back(saved.name);
  return names;
}

// As the file of a library, or no file where it would be the program's own.
void put(const std::filesystem::path& file, const std::string& text, const std::string& builtIn)
{
  if (text != builtIn)
  {
    core::writeFile(file, text);
    return;
  }
  std::error_code error;
  std::filesystem::remove(file, error);
  if (error)
    throw core::OutputFileError(core::OutputFileError::Reason::NotPermitted, file,
                                "cannot be removed");
}

} // namespace

CatalogueEditor::CatalogueEditor(std::filesystem::path folder)
  : CatalogueEditor(folder, dissection::Catalogues::in(folder))
{
}

CatalogueEditor::CatalogueEditor(std::filesystem::path folder, const dissection::Catalogues& saved)
  : m_folder(std::move(folder))
  , m_builtIn(tablesOf(dissection::Catalogues::builtIn()))
  , m_saved(tablesOf(saved))
  , m_now(m_saved)
{
}

CatalogueEditor CatalogueEditor::repairing(const std::filesystem::path& folder)
{
  using dissection::Catalogues;
  const auto read = [](const auto& from) -> std::optional<Catalogues>
  {
    try
    {
      return from();
    }
    catch (const core::Error&)
    {
      return std::nullopt;
    }
  };
  if (const auto sound = read([&] { return Catalogues::in(folder); }))
    return {folder, *sound};
  // What was replaced counts as changed.
  if (const auto burrs = read([&] { return Catalogues::read({}, folder / kBurrsFile); }))
  {
    CatalogueEditor editor(folder, *burrs);
    editor.m_saved.materials.clear();
    return editor;
  }
  const auto materials = read([&] { return Catalogues::read(folder / kMaterialsFile, {}); });
  CatalogueEditor editor(folder, materials ? *materials : Catalogues::builtIn());
  editor.m_saved.burrs.clear();
  if (!materials)
    editor.m_saved.materials.clear();
  return editor;
}

CatalogueEditor::Tables CatalogueEditor::tablesOf(const dissection::Catalogues& catalogues)
{
  Tables tables;
  tables.bone = catalogues.materials.bone();
  for (const dissection::TissueMaterial& one : catalogues.materials.all())
    tables.materials.push_back({one.name, one.title, rounded(one.specificEnergy / kPascalOfGiga),
                                one.friction, rounded(one.hardness / kPascalOfVickers),
                                one.certainty, one.status});
  for (const dissection::BurrModel& model : catalogues.burrs.all())
    tables.burrs.push_back({model.name, model.kind,
                            model.kind == dissection::Burr::Kind::Cutting
                                ? rounded(model.rake / kDegree)
                                : model.wearCoefficient,
                            model.diameters, model.grit, model.certainty, model.status});
  return tables;
}

std::string CatalogueEditor::materialsJson(const Tables& tables)
{
  Json materials = Json::array();
  for (const Material& one : tables.materials)
    materials.push_back({{"name", one.name},
                         {"title", one.title},
                         {"specific_cutting_energy_gpa", one.specificEnergy},
                         {"friction", one.friction},
                         {"vickers_hardness_hv", one.hardness},
                         {"certainty", one.certainty},
                         {"status", one.source}});
  const Json bone{{"cellular", tables.bone.cellular},
                  {"cortical", tables.bone.cortical},
                  {"from_hu", tables.bone.low},
                  {"to_hu", tables.bone.high}};
  Json root = Json::object();
  root["materials"] = std::move(materials);
  root["bone"] = bone;
  return root.dump(2) + "\n";
}

std::string CatalogueEditor::burrsJson(const Tables& tables)
{
  Json burrs = Json::array();
  for (const Burr& one : tables.burrs)
  {
    Json burr{{"name", one.name}, {"kind", dissection::nameOf(one.kind)}};
    if (one.kind == dissection::Burr::Kind::Cutting)
      burr["rake_deg"] = one.constant;
    else
    {
      burr["wear_coefficient"] = one.constant;
      if (one.grit > 0.0)
        burr["grit_um"] = one.grit;
    }
    burr["diameters_mm"] = one.diameters;
    burr["certainty"] = one.certainty;
    burr["status"] = one.source;
    burrs.push_back(std::move(burr));
  }
  Json root = Json::object();
  root["burrs"] = std::move(burrs);
  return root.dump(2) + "\n";
}

// The catalogues that these tables would be decide.
void CatalogueEditor::take(Tables next)
{
  try
  {
    const dissection::MaterialCatalogue materials(materialsJson(next), kMaterialsFile);
    const dissection::BurrCatalogue burrs(burrsJson(next), kBurrsFile);
    dissection::checkPairs(materials, burrs);
  }
  catch (const core::InvalidParameter& error) // there is no file yet
  {
    std::string why = error.what();
    for (const char* file : {kMaterialsFile, kBurrsFile})
      if (const std::string before = std::string(file) + ": "; why.rfind(before, 0) == 0)
        why.erase(0, before.size());
    throw core::InvalidParameter(why);
  }
  m_now = std::move(next);
}

bool CatalogueEditor::isBuiltIn(std::size_t material) const
{
  const std::string& name = m_now.materials.at(material).name;
  return std::any_of(m_builtIn.materials.begin(), m_builtIn.materials.end(),
                     [&name](const Material& one) { return one.name == name; });
}

bool CatalogueEditor::isUsualBurr(std::size_t burr) const
{
  return dissection::parseBurrKind(m_now.burrs.at(burr).name).has_value();
}

std::vector<std::string> CatalogueEditor::lostMaterials() const
{
  return lostNames(m_saved.materials, m_now.materials);
}

std::vector<std::string> CatalogueEditor::lostBurrs() const
{
  return lostNames(m_saved.burrs, m_now.burrs);
}

void CatalogueEditor::setMaterial(std::size_t row, const Material& material)
{
  checkNumbers(material);
  Tables next = m_now;
  Material& present = next.materials.at(row);
  if (material.name != present.name)
  {
    if (isBuiltIn(row))
      throw core::InvalidParameter("material '" + present.name +
                                   "' has its name for good: presets give it to structures");
    checkName(material.name);
    for (std::string* end : {&next.bone.cellular, &next.bone.cortical})
      if (*end == present.name)
        *end = material.name;
  }
  const Material before = std::exchange(present, material);
  if (present.specificEnergy != before.specificEnergy || present.friction != before.friction ||
      present.hardness != before.hardness)
    dropStatements(present, before);
  take(std::move(next));
}

std::size_t CatalogueEditor::addMaterial(std::size_t like)
{
  Tables next = withLike(m_now, &Tables::materials, like);
  next.materials.back().title = next.materials.back().name;
  take(std::move(next));
  return m_now.materials.size() - 1;
}

void CatalogueEditor::removeMaterial(std::size_t row)
{
  if (isBuiltIn(row))
    throw core::InvalidParameter("material '" + m_now.materials[row].name +
                                 "' cannot be removed: presets give it to structures");
  take(without(m_now, &Tables::materials, row));
}

void CatalogueEditor::setBurr(std::size_t row, const Burr& burr)
{
  Tables next = m_now;
  const auto kind = next.burrs.at(row).kind;
  if (burr.name != next.burrs[row].name && isUsualBurr(row))
    throw core::InvalidParameter("burr '" + next.burrs[row].name +
                                 "' has its name for good: it is the usual one of its kind");
  const Burr before = std::exchange(next.burrs[row], burr);
  next.burrs[row].kind = kind;
  if (burr.constant != before.constant || burr.grit != before.grit)
    dropStatements(next.burrs[row], before);
  checkNumbers(next.burrs[row]);
  auto& diameters = next.burrs[row].diameters;
  std::sort(diameters.begin(), diameters.end());
  diameters.erase(std::unique(diameters.begin(), diameters.end()), diameters.end());
  take(std::move(next));
}

std::size_t CatalogueEditor::addBurr(std::size_t like)
{
  take(withLike(m_now, &Tables::burrs, like));
  return m_now.burrs.size() - 1;
}

void CatalogueEditor::removeBurr(std::size_t row)
{
  if (isUsualBurr(row))
    throw core::InvalidParameter("burr '" + m_now.burrs[row].name +
                                 "' cannot be removed: it is the usual one of its kind");
  take(without(m_now, &Tables::burrs, row));
}

void CatalogueEditor::setBuiltIn()
{
  m_now = m_builtIn;
}

bool CatalogueEditor::changed() const
{
  return materialsJson(m_now) != materialsJson(m_saved) || burrsJson(m_now) != burrsJson(m_saved);
}

void CatalogueEditor::save()
{
  // What was written by hand stays if its table has not changed.
  if (const std::string text = materialsJson(m_now); text != materialsJson(m_saved))
    put(m_folder / kMaterialsFile, text, materialsJson(m_builtIn));
  m_saved.materials = m_now.materials;
  m_saved.bone = m_now.bone;
  if (const std::string text = burrsJson(m_now); text != burrsJson(m_saved))
    put(m_folder / kBurrsFile, text, burrsJson(m_builtIn));
  m_saved.burrs = m_now.burrs;
}

std::string diametersText(const std::vector<double>& diameters)
{
  std::string text;
  for (const double diameter : diameters)
    text += (text.empty() ? "" : ", ") + core::plainText(diameter);
  return text;
}

std::vector<double> diametersFrom(const std::string& text)
{
  const bool hasSemicolon = text.find(';') != std::string::npos;
  const auto separates = [&](std::size_t at)
  {
    const bool isLast = at + 1 >= text.size();
    return at >= text.size() || text[at] == ';' || text[at] == ' ' ||
           (text[at] == ',' && !hasSemicolon && (isLast || text[at + 1] == ' '));
  };
  std::vector<double> diameters;
  std::string word;
  for (std::size_t at = 0; at <= text.size(); ++at)
    if (!separates(at))
      word += text[at];
    else if (!word.empty())
    {
      std::string number = word;
      std::replace(number.begin(), number.end(), ',', '.');
      const auto diameter = core::parseDouble(number);
      if (!diameter || !(*diameter > 0.0 && *diameter <= dissection::kMaxBurrDiameter))
        throw core::InvalidParameter("'" + word + "' is not a diameter: numbers above 0, up to " +
                                     core::plainText(dissection::kMaxBurrDiameter) + " mm");
      diameters.push_back(*diameter);
      word.clear();
    }
  if (diameters.empty())
    throw core::InvalidParameter("a burr needs at least one diameter");
  return diameters;
}

} // namespace petrous::presenters
