#pragma once

#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "petrous/Scene/Case.h"

namespace petrous::cli
{

nlohmann::json vectorJson(const Eigen::Vector3d& vector);

/// Row-major, columns are the axes.
nlohmann::json directionJson(const Eigen::Matrix3d& direction);

/// dims, spacing_mm, origin_mm, direction.
nlohmann::json gridJson(const core::GridGeometry& grid);

/// preset, color, opacity, flags, solid, shininess, priority, stiffness_n_per_mm (null: rigid),
/// source ("ct" or an MR's name) and transfer: null, or {"relative", "points"} as a --tf file has
/// them.
nlohmann::json lookJson(const appearance::StructureAppearance& look);

/// Why the hand does not feel a mesh (scene::untouchable), or the mesh's file cannot be read; empty
/// when it does feel it.
std::string touchRefusal(const scene::Case& value, const scene::MeshPart& mesh);

/// 16 numbers, row-major.
nlohmann::json transformJson(const core::RigidTransform& transform);

/// How an MR came to lie on the CT; null where it does not.
nlohmann::json registrationJson(const scene::ImagePart& mr);

/// What `petrous info` gives.
nlohmann::json infoJson(const scene::Case& value);

/// [{"label", "volume_mm3"}].
nlohmann::json touchedJson(const std::vector<dissection::TouchedStructure>& structures);

/// What `petrous history` gives of the strokes. Numbers count from 1; parent 0 is untouched bone.
nlohmann::json strokesJson(const scene::Case& value);

/// A branch and what it took, up to where it stands.
nlohmann::json branchJson(const scene::Case& value, const dissection::History::Branch& branch);

/// Voxels and bricks of the case that are in memory now, in bytes.
std::map<std::string, std::size_t> residentResources(const scene::Case& value);

} // namespace petrous::cli
