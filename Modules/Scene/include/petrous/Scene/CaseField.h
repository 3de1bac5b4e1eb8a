#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Dissection/RemovedVolume.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/DistanceMap.h"
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
  std::vector<const LabelPart*> parts;          ///< that they are of
};

/// The structures whose looks are wanted and that have a place on the CT (Placement.h; of all that
/// follows here too), in the order in which they take a voxel that several
/// claim: solids before lumens, then by the priority of the look, then the smaller first.
/// Priorities come from the presets (Resources/structures.json): nerve, artery, vein, ossicle,
/// inner ear, tumour, cholesteatoma, dura, others, muscle, bone; of lumens, the ear canal before
/// air cells. Loads the labels that are wanted. Throws InvalidParameter when more than 255
/// structures are.
LabelSources labelSources(const Case& value,
                          const std::function<bool(const appearance::StructureAppearance&)>& wanted);

/// volume::makeLabelField of these; taken from the case's derived data where it is kept there, and
/// kept there then.
std::shared_ptr<const volume::LabelField> labelField(const Case& value, const LabelSources& sources,
                                                     const core::Progress& progress = {});

/// A mesh that hand and drill know, as the voxels that they know it by (volume::solidOf).
struct MeshSolid
{
  const MeshPart* part; ///< points into the case
  volume::TissueField::SolidUnion occupancy;
};

/// The meshes whose looks are wanted, as far as they stand for themselves and can become voxels.
/// A structure that comes as label and as mesh is the label, to the eye as to the hand: its mesh
/// stands for nothing. Voxels are made when first asked for and kept with the case. Loads these
/// meshes. Throws CancelledError.
std::vector<MeshSolid>
meshSolids(const Case& value, const std::function<bool(const appearance::StructureAppearance&)>& wanted,
           const core::Progress& progress = {});

/// Those of all the case's meshes in which one of these points (patient LPS mm) may lie.
std::vector<MeshSolid> meshSolidsAt(const Case& value, const std::vector<Eigen::Vector3d>& points,
                                    const core::Progress& progress = {});

/// Why the hand does not feel what goes by the mesh's name, in words that follow that name; empty
/// when it does. Loads the mesh, makes no voxels.
std::string untouchable(const Case& value, const MeshPart& mesh);

/// The tissue field of a case. The mask is the case's present one, shared and read as it stands; a
/// case without loaded dissection has none. Loads the CT, and labels and meshes only where a solid
/// one is touchable. A structure whose `touchable` is off is not in it. Its structures are united
/// by volume::makeLabelField, as the eye's are; each mesh is a solid of its own. Throws
/// CancelledError.
volume::TissueField tissueField(const Case& value, const core::Progress& progress = {});

/// The same for who asks at few places: the union of the structures is worked out round them as
/// they are asked for (TissueField::prepare), unless the derived data have the whole of it.
/// One thread.
volume::TissueField regionalTissueField(const Case& value, const core::Progress& progress = {});

/// A structure or mesh that yields under the hand.
struct SoftSolid
{
  std::string name;
  std::shared_ptr<const volume::DistanceMap> depth;
  double stiffness = 0.0; ///< N/mm (StructureAppearance::stiffness)
};

/// The tissue of a case as a tool meets it: soft structures take no part in f.
struct TouchTissue
{
  volume::TissueField rigid;
  std::vector<SoftSolid> soft;
  std::optional<std::string> key; ///< of what is rigid, but for the mask, among derived data
};

/// `whole` is the case's tissueField, and what is rigid where no touchable structure is soft. Each
/// soft structure is measured for itself, from the surface that its own voxels give (some seconds
/// each). Where a rigid structure has the same voxels, or bone's intensity reaches into it, it is
/// rigid there. Throws CancelledError.
TouchTissue touchTissue(const Case& value, const volume::TissueField& whole,
                        const core::Progress& progress = {});

/// Structures and meshes that the drill must leave (`drillable` off), lumens among them.
/// `regional`: the union of the structures is worked out round the cuts as they are made
/// (ProtectedTissue::prepare), unless the derived data have the whole of it; for one thread.
dissection::ProtectedTissue protectedTissue(const Case& value, const core::Progress& progress = {},
                                            bool regional = false);

/// The structures and meshes that a stroke can take something of (`drillable` on), with their
/// voxels. Loads the labels and these meshes.
std::vector<dissection::NamedStructure> drillableStructures(const Case& value);

} // namespace petrous::scene
