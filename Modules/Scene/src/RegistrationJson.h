#pragma once

#include <nlohmann/json.hpp>

#include "petrous/Scene/Registration.h"

namespace petrous::scene
{

// The registration of an MR in a manifest. `...In` throws json::exception or InvalidParameter.

nlohmann::json poseOut(const core::RigidTransform& x);
core::RigidTransform poseIn(const nlohmann::json& j);

nlohmann::json registrationOut(const Registration& registration);
Registration registrationIn(const nlohmann::json& j);

} // namespace petrous::scene
