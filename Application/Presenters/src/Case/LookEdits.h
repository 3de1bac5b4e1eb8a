#pragma once

#include <string>
#include <vector>

#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::presenters
{

/// What a change of appearances is called in the menu.
struct LookEdit
{
  std::string what;          ///< "colour of facial nerve", "hide 3 structures"
  bool isContinuous = false; ///< a further change of the kind continues it
};

/// Of the same parts, at least one of which changes.
LookEdit lookEdit(const std::vector<PartLook>& before, const std::vector<PartLook>& after,
                  const char* bone);

} // namespace petrous::presenters
