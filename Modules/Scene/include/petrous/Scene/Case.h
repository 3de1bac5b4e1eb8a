#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Core/CameraPose.h"
#include "petrous/Core/DerivedStore.h"
#include "petrous/Core/Lazy.h"
#include "petrous/Core/TriangleMesh.h"
#include "petrous/Dissection/Dissection.h"
#include "petrous/Scene/ImagePart.h"
#include "petrous/Scene/MeshTouch.h"
#include "petrous/Scene/TransformedPart.h"
#include "petrous/Volume/IntensityScale.h"
#include "petrous/Volume/LabelMap.h"

namespace petrous::scene
{

/// A structure drawn in a label map.
struct StructurePart
{
  std::string name;
  std::uint16_t index = 0;
  std::uint64_t voxels = 0;
  double volume = 0.0; ///< mm^3, voxel count times voxel volume
  appearance::StructureAppearance look;
};

/// A label map with the structures that the case uses of it.
struct LabelPart
{
  std::string object;
  core::Lazy<volume::LabelMap> labels; ///< as they were drawn; on the CT: labelsOnCt (Placement.h)
  std::vector<StructurePart> structures;
  std::vector<std::string> notes; ///< what was assumed or left out when the file was read, in words
  /// The MR in whose patient space they lie; empty: the CT's. Nothing where an older case does not
  /// say it (placementOf).
  std::optional<std::string> drawnOn;
  TransformedPart<volume::LabelMap> moved;
};

struct MeshPart
{
  std::string name;
  std::string object;
  std::size_t triangles = 0;
  std::vector<std::string> notes;      ///< what was assumed when the file was read, in words
  core::Lazy<core::TriangleMesh> mesh; ///< as it was drawn; on the CT: meshOnCt (Placement.h)
  appearance::StructureAppearance look;
  std::string drawnOn; ///< the MR in whose patient space it lies; empty: the CT's
  TransformedPart<core::TriangleMesh> moved;
  MeshTouch touch; ///< its voxels for hand and drill: see CaseField.h
};

/// A stroke as the case lists it; its voxels lie in `object`.
struct StrokePart
{
  std::string object;
  std::size_t bytes = 0; ///< on disk
  dissection::StrokeInfo info;
  std::shared_ptr<const dissection::Stroke>
      stroke; ///< with its voxels; null until these are loaded
};

/// One patient's case as a value: what was put together, how it looks, what was drilled.
///
/// What is known of the strokes is always there; their voxels are in `dissection`, which is loaded
/// only where somebody drills, draws or asks the field (Library::loadDissection). Then `history` is
/// that of `dissection` as of the last call of a function here: its own may be moved on by another
/// thread.
struct Case
{
  std::string name;
  std::string id;             ///< random, of the saved case; a copy has another; may be empty
  std::uint64_t revision = 0; ///< of the manifest on disk; 0: never saved
  double iso = 300.0;         ///< HU
  /// HU of dense bone, where presets put their densest look; another number in an image that is not
  /// calibrated.
  double denseBone = volume::IntensityScale{}.dense;
  ImagePart ct;
  appearance::StructureAppearance boneLook = appearance::boneLook(); ///< of the CT's own tissue
  std::vector<ImagePart> mr;
  std::vector<LabelPart> labels;
  std::vector<MeshPart> meshes;
  std::optional<core::CameraPose> camera; ///< last view; none: the lateral one

  std::vector<StrokePart> strokes; ///< all, in the order in which they were made
  dissection::History history;     ///< how they follow each other, and which are done
  std::shared_ptr<dissection::Dissection> dissection;

  /// Where what follows from the parts is kept between programs; null: nowhere.
  std::shared_ptr<core::DerivedStore> derived;

  std::size_t applied() const { return history.applied(); } ///< strokes that are done
  double removedVolume() const;                             ///< mm^3, of those
  volume::IntensityScale intensityScale() const { return {iso, denseBone}; }
};

/// Steps `count` strokes back (or forth) along the present branch, also in the voxels where they
/// are loaded. Returns how many steps there were. Throws as Dissection::follow does.
std::size_t undo(Case& value, std::size_t count);
std::size_t redo(Case& value, std::size_t count);

/// Closes the open stroke of `dissection` and lists it. Null when it changed nothing.
std::shared_ptr<const dissection::Stroke> endStroke(Case& value);

/// Lists a stroke that `dissection` has already, at the present state.
void listStroke(Case& value, const std::shared_ptr<const dissection::Stroke>& stroke);

/// The structure, or null.
StructurePart* findStructure(Case& value, const std::string& name);
const StructurePart* findStructure(const Case& value, const std::string& name);
MeshPart* findMesh(Case& value, const std::string& name);
const ImagePart* findMr(const Case& value, const std::string& name);

/// Whether the name means the CT's own tissue: "ct", and "bone" where no structure or mesh is
/// called that.
bool meansBone(const Case& value, const std::string& name);

/// Every name a part of the case goes by, to keep new ones apart. "ct" is always among them.
std::vector<std::string> partNames(const Case& value);

/// Removes an MR, a structure or a mesh; looks that read a removed MR read the CT again. Throws
/// InvalidParameter naming the parts there are, Error (Refused) for an MR on which structures were
/// drawn that are still there.
void removePart(Case& value, const std::string& name);

/// Throws InvalidParameter unless the name fits a file on every system: 1 to 100 bytes of UTF-8, no
/// control characters, none of / \ : * ? " < > |, no dot or space at the ends, not a leading dash.
void checkCaseName(const std::string& name);

/// Throws InvalidParameter unless a part can go by this name: 1 to 200 bytes of UTF-8 without
/// control characters, and not "ct".
void checkPartName(const std::string& name);

/// Throws InvalidParameter unless somebody can sign by this name: 1 to 100 bytes of UTF-8 without
/// control characters, not blank.
void checkPersonName(const std::string& name);

} // namespace petrous::scene
