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

/// Scale of c_CT, HU: sets the unit of f, not the position of the surface.
constexpr double kFieldScale = 1000.0;

/// Structures of a case as input to a label field. `structures` point into the case and are valid
/// as long as its lists.
struct LabelSources
{
  std::vector<volume::LabelSource> sources;
  std::vector<const StructurePart*> structures; ///< material i is structures[i - 1]
  std::vector<const LabelPart*> parts;          ///< the parts of these structures
};

/// The structures whose appearance satisfies `wanted` and that have a place in CT space
/// (Placement.h; this also holds for all functions below), in the order in which they claim a voxel
/// that several share: solids before lumens, then by priority of the appearance, then by increasing
/// volume. Priorities come from the presets (Resources/structures.json): nerve, artery, vein,
/// ossicle, inner ear, tumour, cholesteatoma, dura, others, muscle, bone; among lumens, the ear
/// canal before air cells. Loads the labels of these structures. Throws InvalidParameter for more
/// than 255 structures.
LabelSources
labelSources(const Case& value,
             const std::function<bool(const appearance::StructureAppearance&)>& wanted);

/// volume::makeLabelField of these sources; read from and stored in the case's derived data.
std::shared_ptr<const volume::LabelField> labelField(const Case& value, const LabelSources& sources,
                                                     const core::Progress& progress = {});

/// A mesh voxelized for haptics and drilling (volume::solidOf).
struct MeshSolid
{
  const MeshPart* part; ///< points into the case
  volume::TissueField::SolidUnion occupancy;
};

/// The meshes whose appearance satisfies `wanted`, unless superseded or impossible to voxelize. A
/// structure that exists both as label and as mesh is represented by the label alone, in rendering
/// and haptics. Voxels are computed on first use and cached with the case. Loads these meshes.
/// Throws CancelledError.
std::vector<MeshSolid>
meshSolids(const Case& value,
           const std::function<bool(const appearance::StructureAppearance&)>& wanted,
           const core::Progress& progress = {});

/// All meshes of the case that may contain one of these points (patient LPS mm).
std::vector<MeshSolid> meshSolidsAt(const Case& value, const std::vector<Eigen::Vector3d>& points,
                                    const core::Progress& progress = {});

/// Why the structure of the mesh's name cannot be touched, phrased to follow that name; empty if it
/// can. Loads the mesh, but does not voxelize it.
std::string untouchable(const Case& value, const MeshPart& mesh);

/// The tissue field of a case. The mask is the case's current one, shared and read live; without a
/// loaded dissection there is none. Loads the CT, and labels and meshes only if a solid one is
/// touchable. Structures with `touchable` off are excluded. Structures are united as by
/// volume::makeLabelField, as in rendering; each mesh is a separate solid. Throws CancelledError.
volume::TissueField tissueField(const Case& value, const core::Progress& progress = {});

/// Like tissueField, for queries at few places: the union of the structures is computed only in the
/// regions queried (TissueField::prepare), unless the derived data contain all of it. Not
/// thread-safe.
volume::TissueField regionalTissueField(const Case& value, const core::Progress& progress = {});

/// A deformable structure or mesh.
struct SoftSolid
{
  std::string name;
  std::shared_ptr<const volume::DistanceMap> depth;
  double stiffness = 0.0; ///< N/mm (StructureAppearance::stiffness)
};

/// The tissue of a case for haptics: soft structures are not part of f.
struct TouchTissue
{
  volume::TissueField rigid;
  std::vector<SoftSolid> soft;
  std::optional<std::string> key; ///< derived-data key of the rigid tissue, without the mask
};

/// `whole` is the case's tissueField, which is also the rigid field if no touchable structure is
/// soft. A distance map is computed for each soft structure from its own voxels (some seconds
/// each). Where a rigid structure shares voxels with it, or bone intensity extends into it, the
/// tissue is rigid. Throws CancelledError.
TouchTissue touchTissue(const Case& value, const volume::TissueField& whole,
                        const core::Progress& progress = {});

/// Structures and meshes that must not be drilled (`drillable` off), including lumens. `regional`:
/// the union of the structures is computed only around the cuts as they are made
/// (ProtectedTissue::prepare), unless the derived data contain all of it; not thread-safe.
dissection::ProtectedTissue protectedTissue(const Case& value, const core::Progress& progress = {},
                                            bool regional = false);

/// The structures and meshes that a stroke can remove (`drillable` on), with their voxels. Loads
/// the labels and these meshes.
std::vector<dissection::NamedStructure> drillableStructures(const Case& value);

} // namespace petrous::scene
