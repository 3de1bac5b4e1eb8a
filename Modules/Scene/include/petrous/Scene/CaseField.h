#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "petrous/Dissection/RemovedVolume.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/LabelField.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::scene
{

/// Scale of c_CT, HU: it sets the unit of f, not where the surface lies.
constexpr double kFieldScale = 1000.0;

/// Structures of a case as a label field takes them. `structures` point into the case and hold as
/// long as its lists do.
struct LabelSources
{
  std::vector<volume::LabelSource> sources;
  std::vector<const StructurePart*> structures; ///< material i is structures[i - 1]
};

/// The structures whose looks are wanted, in the order in which they take a voxel that several
/// claim: solids before lumens, then by the priority of the look, then the smaller first.
/// Priorities come from the presets (Resources/structures.json): nerve, artery, vein, ossicle,
/// inner ear, tumour, cholesteatoma, dura, others, muscle, bone; of lumens, the ear canal before
/// air cells. Loads the labels that are wanted. Throws InvalidParameter when more than 255
/// structures are.
LabelSources labelSources(const Case& value,
                          const std::function<bool(const appearance::StructureLook&)>& wanted);

/// The tissue field of a case. The mask is the case's present one, shared and read as it stands; a
/// case without loaded dissection has none. Loads the CT, and labels only where a solid structure
/// is touchable. A structure whose `touchable` is off is not in it. Its structures are united by
/// volume::makeLabelField, as the eye's are. Throws CancelledError.
volume::TissueField tissueField(const Case& value, const core::Progress& progress = {});

/// Structures that the drill must leave (`drillable` off), lumens among them.
dissection::ProtectedTissue protectedTissue(const Case& value, const core::Progress& progress = {});

/// The structures that a stroke can take something of (`drillable` on), with their voxels. Loads
/// the labels.
std::vector<dissection::NamedStructure> drillableStructures(const Case& value);

} // namespace petrous::scene
