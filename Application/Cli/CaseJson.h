#pragma once

#include <map>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "Context.h"
#include "petrous/Presenters/CaseTransfer.h"
#include "petrous/Presenters/SurfaceUncertainty.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/MeshMeasure.h"

namespace petrous::cli
{

nlohmann::json vectorJson(const Eigen::Vector3d& vector);

/// Row-major, columns are the axes.
nlohmann::json directionJson(const Eigen::Matrix3d& direction);

/// dims, spacing_mm, origin_mm, direction.
nlohmann::json gridJson(const core::GridGeometry& grid);

/// The flags and each property (kStructureProperties): one that is off has its word, or null where
/// neither a word nor 0 is a value; transfer: null, or {"relative", "points"} as a --tf file has
/// them.
nlohmann::json lookJson(const appearance::StructureAppearance& look);
/// `foot` and `peak` of Case::softTissueValues, or null.
nlohmann::json softTissueValuesJson(const scene::Case& value);

/// Why a mesh is not touchable (scene::untouchable), or its file cannot be read; empty if it is
/// touchable.
std::string touchRefusal(const scene::Case& value, const scene::MeshPart& mesh);

/// What is computed of a mesh.
struct MeshFacts
{
  std::string touchRefusal;                     ///< as the function says
  std::optional<volume::MeshMeasure> measure{}; ///< nothing if the mesh cannot be read
};
/// What is computed of a case.
struct CaseFacts
{
  std::vector<MeshFacts> meshes; ///< of each of the case's meshes
  /// By the name of a structure or mesh that was drawn on a registered MR, in its bounding box;
  /// nothing where its file cannot be read, or the error is not known.
  std::map<std::string, presenters::RegistrationErrorHere> registrationErrors;
};
CaseFacts factsOf(const scene::Case& value);

/// 16 numbers, row-major.
nlohmann::json transformJson(const core::RigidTransform& transform);

/// Who and when; null where the case came without.
nlohmann::json signOffJson(const scene::SignOff& signOff);

/// How an MR was registered to the CT; null if it is not.
nlohmann::json registrationJson(const scene::ImagePart& mr);

/// note, tags, diagnosis, procedure, side, date; text that is not given is "", the date null.
nlohmann::json descriptionJson(const scene::Description& description);

/// A note for the terminal, its lines indented.
std::string indented(const std::string& note);

/// A line, without the note; empty if there is nothing to say.
std::string descriptionLine(const scene::Description& description);

/// Output of `petrous info`.
nlohmann::json infoJson(const scene::Case& value, const CaseFacts& facts);

/// [{"label", "volume_mm3"}].
nlohmann::json touchedJson(const std::vector<dissection::TouchedStructure>& structures);

/// The strokes as in the output of `petrous history`. Numbers start at 1; parent 0 is untouched
/// bone.
nlohmann::json strokesJson(const scene::Case& value);

/// A branch and what it removed, up to its current position.
nlohmann::json branchJson(const scene::Case& value, const dissection::History::Branch& branch);

/// What a dry run says; as JSON: leaves, stays, may_identify.
void printIdentityReport(const Context& context, const presenters::IdentityReport& report);

/// Memory of the case's resident voxels and bricks, bytes.
std::map<std::string, std::size_t> residentResources(const scene::Case& value);

} // namespace petrous::cli
