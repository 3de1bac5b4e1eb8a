#include "petrous/Appearance/StructureLook.h"

#include <sstream>

#include "petrous/Core/Error.h"

namespace petrous::appearance
{

void setFlags(StructureLook& look, const std::string& flags)
{
  StructureLook result = look;
  result.shown = result.touchable = result.drillable = false;
  std::istringstream list(flags);
  for (std::string flag; std::getline(list, flag, ',');)
  {
    if (flag == "shown")
      result.shown = true;
    else if (flag == "touchable")
      result.touchable = true;
    else if (flag == "drillable")
      result.drillable = true;
    else if (flag != "none")
      throw core::InvalidParameter("flag '" + flag +
                                   "' is unknown; use shown, touchable, drillable or none");
  }
  look = result;
}

std::string flagsOf(const StructureLook& look)
{
  std::string flags;
  const auto add = [&flags](bool holds, const char* name)
  {
    if (holds)
      flags += (flags.empty() ? "" : ",") + std::string(name);
  };
  add(look.shown, "shown");
  add(look.touchable, "touchable");
  add(look.drillable, "drillable");
  return flags.empty() ? "none" : flags;
}

} // namespace petrous::appearance
