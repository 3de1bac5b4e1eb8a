#pragma once

#include <cstdint>
#include <limits>

#include <nlohmann/json.hpp>

#include "petrous/Core/Error.h"
#include "petrous/Scene/Case.h"

namespace petrous::scene
{

// The parts of a manifest that are also in a journal. `...In` throws json::exception or
// InvalidParameter.

/// Text of a manifest, which may be another's: terminals obey what may stand in it. A case at home
/// is never refused for that: what is not seen is left out (withoutInvisible).
std::string plainIn(const nlohmann::json& j);

/// An integer that the type holds: json's own conversion lets one that is too large wrap around.
template <class Number>
Number integerIn(const nlohmann::json& j)
{
  using Limits = std::numeric_limits<Number>;
  const bool isNegative =
      j.is_number_integer() && j.get<std::int64_t>() < 0 && !j.is_number_unsigned();
  const bool isWithin =
      isNegative
          ? Limits::is_signed && j.get<std::int64_t>() >= static_cast<std::int64_t>(Limits::min())
          : j.is_number_integer() &&
                j.get<std::uint64_t>() <= static_cast<std::uint64_t>(Limits::max());
  if (!isWithin)
    throw core::InvalidParameter("a number is no integer, or out of its range");
  return j.get<Number>();
}

nlohmann::json vectorOut(const Eigen::Vector3d& v);
Eigen::Vector3d vectorIn(const nlohmann::json& j);

nlohmann::json cameraOut(const core::CameraPose& camera);
core::CameraPose cameraIn(const nlohmann::json& j);

nlohmann::json strokeOut(const dissection::Stroke& stroke);
dissection::Stroke strokeIn(const nlohmann::json& j);

/// Strokes are numbered from 1 in JSON; 0 is the undrilled state.
nlohmann::json historyOut(const dissection::History& history);
dissection::History historyIn(const nlohmann::json& j);

} // namespace petrous::scene
