#pragma once

#include <string>

#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// Whether strokes record under its name what was removed from a part.
inline bool isRecorded(const scene::Case& value, const std::string& name)
{
  for (const auto& stroke : value.dissection.strokes())
    for (const auto& touched : stroke->info.structures)
      if (touched.name == name)
        return true;
  return false;
}

} // namespace petrous::presenters
