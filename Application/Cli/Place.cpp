#include "Place.h"

#include <algorithm>

#include "Context.h"
#include "Numbers.h"
#include "petrous/Presenters/CaseRegistration.h"

namespace petrous::cli
{

namespace
{

bool isPart(const scene::Case& value, const std::string& name)
{
  return scene::findStructure(value, name) ||
         std::any_of(value.meshes.begin(), value.meshes.end(),
                     [&name](const scene::MeshPart& mesh) { return mesh.name == name; });
}

} // namespace

Place parsePlace(const std::string& text, const scene::Case& value, const std::string& option)
{
  if (isPart(value, text))
    return {presenters::placeOf(value, text).point, text};
  if (std::count(text.begin(), text.end(), ',') != 2)
    throw UsageError(option + ": x,y,z in mm or the name of a structure of the case, not '" + text +
                     "'");
  const auto n = parseNumbers(text, 3, option + " x,y,z");
  return {{n[0], n[1], n[2]}, {}};
}

} // namespace petrous::cli
