#pragma once

#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// Whether the structures of two parts lie on one label map: of one object of the library, or made
/// in memory and the same there. Reads none.
inline bool haveSameLabels(const scene::LabelPart& one, const scene::LabelPart& other)
{
  if (!one.object.empty() && !other.object.empty())
    return one.object == other.object;
  const auto labels = one.labels.peek();
  return labels && labels == other.labels.peek();
}

} // namespace petrous::presenters
