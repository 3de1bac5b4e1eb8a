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

void printMaterials(const Context& context, const CatalogueEditor& tables)
{
  context.print("materials:");
  for (const auto& one : tables.materials())
    context.print("  " + one.name + ": cutting energy " + plainText(one.specificEnergy) +
                  " GPa, friction " + plainText(one.friction) + ", hardness " +
                  plainText(one.hardness) + " HV" + provenance(one.certainty, one.source));
}

void printBurrs(const Context& context, const CatalogueEditor& tables)
{
  context.print("burrs:");
  for (const auto& one : tables.burrs())
    context.print("  " + one.name + ": " + dissection::nameOf(one.kind) + ", " +
                  (one.kind == dissection::Burr::Kind::Cutting
                       ? "rake " + plainText(one.constant) + " degrees"
                       : "wear coefficient " + plainText(one.constant)) +
                  (one.grit > 0.0 ? ", grit " + plainText(one.grit) + " um" : "") + "; " +
                  presenters::diametersText(one.diameters) + " mm" +
                  provenance(one.certainty, one.source));
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
  printMaterials(context, tables);
  printBurrs(context, tables);
  auto answer = nlohmann::json::parse(tables.materialsText());
  answer.update(nlohmann::json::parse(tables.burrsText()));
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
