#include "CaseJson.h"
#include "Commands.h"
#include "Numbers.h"

namespace petrous::cli
{

namespace
{

void list(const Context& context, const scene::Case& value)
{
  nlohmann::json parts = nlohmann::json::array();
  const auto add =
      [&](const std::string& name, const std::string& kind, const appearance::StructureLook& look)
  {
    parts.push_back({{"name", name},
                     {"kind", kind},
                     {"preset", look.preset},
                     {"color", look.color},
                     {"opacity", look.opacity},
                     {"flags", appearance::flagsOf(look)},
                     {"solid", look.solid}});
    context.say("  " + name + " (" + kind + "): " + look.preset + ", " + appearance::flagsOf(look) +
                (look.solid ? "" : ", a lumen"));
  };
  context.say("surface at " + fixed(value.iso, 1) + " HU");
  for (const auto& part : value.labels)
    for (const auto& structure : part.structures)
      add(structure.name, "structure", structure.look);
  for (const auto& mesh : value.meshes)
    add(mesh.name, "mesh", mesh.look);
  context.give({{"case", value.name}, {"iso_hu", value.iso}, {"parts", std::move(parts)}});
}

void setPartFlags(scene::Case& value, const std::string& assignment)
{
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError("--flags PART=shown,touchable,drillable: there is no PART= in it");
  const std::string part = assignment.substr(0, equals);
  const std::string flags = assignment.substr(equals + 1);
  auto* structure = scene::findStructure(value, part);
  auto* mesh = scene::findMesh(value, part);
  if (!structure && !mesh)
  {
    std::string there;
    const auto list = [&there](const std::string& name)
    { there += (there.empty() ? "" : ", ") + name; };
    for (const auto& labels : value.labels)
      for (const auto& other : labels.structures)
        list(other.name);
    for (const auto& other : value.meshes)
      list(other.name);
    throw core::InvalidParameter("case '" + value.name + "' has no structure or mesh '" + part +
                                 "'; it has " + (there.empty() ? "none" : there));
  }
  if (structure)
    appearance::setFlags(structure->look, flags);
  if (mesh)
    appearance::setFlags(mesh->look, flags);
}

} // namespace

void addAppearanceCommand(CLI::App& app, Context& context)
{
  struct Options
  {
    std::string name;
    std::optional<double> iso;
    std::vector<std::string> flags, set, tf, tissue;
    bool list = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(
      app, "appearance", "Surface threshold, and what a structure is to eye, hand and drill",
      [options, &context]
      {
        if (!options->set.empty())
          notBuiltYet("--set");
        if (!options->tf.empty())
          notBuiltYet("--tf");
        if (!options->tissue.empty())
          notBuiltYet("--tissue");
        if (!options->iso && options->flags.empty() && !options->list)
          throw UsageError("appearance: nothing to do; give --iso, --flags or --list");
        library::Library library = context.openLibrary();
        scene::Case value = library.open(options->name);
        if (options->iso)
        {
          if (!std::isfinite(*options->iso) || std::abs(*options->iso) > 32767.0)
            throw UsageError("--iso: must lie within -32767 to 32767 HU");
          value.iso = *options->iso;
        }
        for (const std::string& flags : options->flags)
          setPartFlags(value, flags);
        if (options->iso || !options->flags.empty())
          library.save(value);
        list(context, value);
      });
  command->add_option("CASE", options->name)->required();
  command->add_option("--iso", options->iso, "Surface of bone (300)")->type_name("HU");
  command->add_option("--flags", options->flags, "The flags that hold; 'none' for none of them")
      ->allow_extra_args(false)
      ->type_name("PART=shown,touchable,drillable");
  command->add_flag("--list", options->list, "List what there is");
  // In the contract, not built yet: refused when asked for, not offered.
  command->add_option("--set", options->set)->allow_extra_args(false)->group("");
  command->add_option("--tf", options->tf)->allow_extra_args(false)->group("");
  command->add_option("--tissue", options->tissue)->allow_extra_args(false)->group("");
}

} // namespace petrous::cli
