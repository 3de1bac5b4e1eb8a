#pragma once

#include <memory>
#include <vector>

#include "petrous/Dissection/RemovedVolume.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::scene
{

/// Scale of c_CT, HU: it sets the unit of f, not where the surface lies.
constexpr double kFieldScale = 1000.0;

/// The tissue field of a case. The mask is the case's present one, shared and read as it stands; a
/// case without loaded dissection has none. Loads the CT, and labels only where a solid structure
/// is touchable. A structure whose `touchable` is off is not in it.
volume::TissueField tissueField(const Case& value);

/// Structures that the drill must leave (`drillable` off).
dissection::ProtectedTissue protectedTissue(const Case& value);

/// The structures that a stroke can take something of (`drillable` on), with their voxels. Loads
/// the labels.
std::vector<dissection::NamedStructure> drillableStructures(const Case& value);

} // namespace petrous::scene
