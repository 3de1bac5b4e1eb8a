#pragma once

#include <string>

#include "petrous/Scene/FreeName.h"

namespace petrous::cli
{

/// The part that an option names: exactly so, or as lists and the window show it ("sigmoid sinus"
/// of sigmoid_sinus); `text` itself where the case has neither.
inline std::string partNamed(const scene::Case& value, const std::string& text)
{
  const std::string part = scene::partReadAs(value, text);
  return part.empty() ? text : part;
}

} // namespace petrous::cli
