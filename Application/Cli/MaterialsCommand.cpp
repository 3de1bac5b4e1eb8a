#include "Commands.h"
#include "Numbers.h"
#include "petrous/Appearance/SoftTissues.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Dissection/BurrName.h"
#include "petrous/Presenters/CatalogueEditor.h"

namespace petrous::cli
{

namespace
{

using core::plainText;
using presenters::CatalogueEditor;

// As the window's table says it.
std::string provenance(const std::string& certainty, const std::string& source)
{
  const auto stated = [](const std::string& text)
  { return text.empty() ? std::string("not stated") : text; };
  return "\n      certainty: " + stated(certainty) + "\n      source: " + stated(source);
}

nlohmann::json materialsJson(const Context& context, const CatalogueEditor& tables)
{
  nlohmann::json materials = nlohmann::json::array();
  context.print("materials:");
  for (const auto& one : tables.materials())
  {
    materials.push_back({{"name", one.name},
                         {"title", one.title},
                         {"specific_cutting_energy_gpa", one.specificEnergy},
                         {"friction", one.friction},
                         {"vickers_hardness_hv", one.hardness},
                         {"certainty", one.certainty},
                         {"status", one.source}});
    context.print("  " + one.name + ": cutting energy " + plainText(one.specificEnergy) +
                  " GPa, friction " + plainText(one.friction) + ", hardness " +
                  plainText(one.hardness) + " HV" + provenance(one.certainty, one.source));
  }
  return materials;
}

nlohmann::json burrsJson(const Context& context, const CatalogueEditor& tables)
{
  nlohmann::json burrs = nlohmann::json::array();
  context.print("burrs:");
  for (const auto& one : tables.burrs())
  {
    const bool isCutting = one.kind == dissection::Burr::Kind::Cutting;
    nlohmann::json burr{{"name", one.name},
                        {"kind", dissection::nameOf(one.kind)},
                        {isCutting ? "rake_deg" : "wear_coefficient", one.constant},
                        {"diameters_mm", one.diameters},
                        {"certainty", one.certainty},
                        {"status", one.source}};
    std::string line = "  " + one.name + ": " + dissection::nameOf(one.kind) + ", " +
                       (isCutting ? "rake " + plainText(one.constant) + " degrees"
                                  : "wear coefficient " + plainText(one.constant));
    if (one.grit > 0.0)
    {
      burr["grit_um"] = one.grit;
      line += ", grit " + plainText(one.grit) + " um";
    }
    burrs.push_back(std::move(burr));
    context.print(line + "; " + presenters::diametersText(one.diameters) + " mm" +
                  provenance(one.certainty, one.source));
  }
  return burrs;
}

nlohmann::json softTissuesJson(const Context& context)
{
  nlohmann::json tissues = nlohmann::json::array();
  context.print("soft tissues (appearance --stiffness PART=NAME):");
  for (const auto& one : appearance::softTissues())
  {
    tissues.push_back({{"name", one.name},
                       {"title", one.title},
                       {"stiffness_n_per_mm", one.stiffness},
                       {"lowest_n_per_mm", one.lowest},
                       {"highest_n_per_mm", one.highest},
                       {"certainty", one.certainty},
                       {"status", one.status}});
    context.print("  " + one.name + ": " + plainText(one.stiffness) + " N/mm (" +
                  plainText(one.lowest) + " to " + plainText(one.highest) + ")" +
                  provenance(one.certainty, one.status));
  }
  return tissues;
}

void list(const Context& context)
{
  const CatalogueEditor tables(context.openLibrary().folder());
  const auto& bone = tables.bone();
  nlohmann::json answer;
  answer["materials"] = materialsJson(context, tables);
  answer["bone"] = {{"cellular", bone.cellular},
                    {"cortical", bone.cortical},
                    {"from_hu", bone.low},
                    {"to_hu", bone.high}};
  answer["burrs"] = burrsJson(context, tables);
  answer["soft_tissues"] = softTissuesJson(context);
  context.printJson(answer);
}

} // namespace

void addMaterialsCommand(CLI::App& app, Context& context)
{
  context.addCommand(
      app, "materials",
      "Materials, burrs and soft tissues with sources; with --json as materials.json "
      "and burrs.json",
      [&context] { list(context); });
}

} // namespace petrous::cli
