#pragma once

#include <nlohmann/json.hpp>

#include "petrous/Scene/Case.h"

namespace petrous::scene
{

// The parts of a manifest that are also in a journal. `...In` throws json::exception or
// InvalidParameter.

/// Text of a manifest, which may be another's: terminals obey what may stand in it. A case at home
/// is never refused for that: what is not seen is left out (withoutInvisible).
std::string plainIn(const nlohmann::json& j);

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
