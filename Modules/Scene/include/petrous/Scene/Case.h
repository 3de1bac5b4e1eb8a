#pragma once

#include <cstdint>
#include <filesystem>
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
#include "petrous/Scene/Attachment.h"
#include "petrous/Scene/Description.h"
#include "petrous/Scene/ImagePart.h"
#include "petrous/Scene/Measurement.h"
#include "petrous/Scene/MeshTouch.h"
#include "petrous/Scene/MrReading.h"
#include "petrous/Scene/TransformedPart.h"
#include "petrous/Scene/ViewState.h"
#include "petrous/Volume/IntensityScale.h"
#include "petrous/Volume/LabelMap.h"
#include "petrous/Volume/SegmentCodes.h"

namespace petrous::scene
{

/// A segmented structure of a label map.
/// Tubes of a structure that were traced through points (segmentation::traceTube), all together:
/// how much of them is a guess.
struct TracedTubes
{
  double length = 0.0;        ///< mm
  double unresolved = 0.0;    ///< mm of it, where path and radius follow the points alone
  std::uint64_t bridging = 0; ///< voxels that bridge gaps where a tube is thinner than they are

  bool operator==(const TracedTubes& other) const
  {
    return length == other.length && unresolved == other.unresolved && bridging == other.bridging;
  }
  TracedTubes& operator+=(const TracedTubes& other)
  {
    length += other.length;
    unresolved += other.unresolved;
    bridging += other.bridging;
    return *this;
  }
};

struct StructurePart
{
  std::string name;
  std::uint16_t index = 0;
  std::uint64_t voxels = 0;
  double volume = 0.0; ///< mm^3, number of voxels times voxel volume
  appearance::StructureAppearance look;
  volume::SegmentCodes codes = {}; ///< as the file said that it was read from
  /// The MRs that it was made from in this program, on the primary image's grid; of one from a file
  /// none is known (LabelPart::drawnOn).
  MrReadings readings = {};
  TracedTubes tubes = {}; ///< of one from a file not known
};

/// What of the place of structures was assumed when their file was read.
struct LabelProvenance
{
  std::optional<bool> assumedRas; ///< as volume::ImageProvenance
  /// Whether the file's frame of reference is not known to be that of the image whose space they
  /// are taken to lie in: it could not be compared, or the user overruled it (FILE@ct).
  bool isFrameAssumed = false;
  core::AxesCorrection axes = {}; ///< as volume::ImageProvenance; with the image's, or their own
};

/// A label map with the structures that the case uses.
struct LabelPart
{
  std::string object;
  core::Lazy<volume::LabelMap> labels; ///< as drawn; in CT space: labelsOnCt (Placement.h)
  std::vector<StructurePart> structures;
  std::vector<std::string> notes; ///< what was assumed or skipped on reading the file, for the user
  LabelProvenance provenance;
  /// The MR in whose patient space the labels lie; empty: the CT's. nullopt if an older case does
  /// not state it (placementOf).
  std::optional<std::string> drawnOn;
  TransformedPart<volume::LabelMap> moved;
};

struct MeshPart
{
  std::string name;
  std::string object;
  std::size_t triangles = 0;
  std::vector<std::string> notes;      ///< what was assumed on reading the file, for the user
  core::Lazy<core::TriangleMesh> mesh; ///< as drawn; in CT space: meshOnCt (Placement.h)
  appearance::StructureAppearance look;
  std::string drawnOn; ///< the MR in whose patient space it lies; empty: the CT's
  TransformedPart<core::TriangleMesh> moved;
  MeshTouch touch; ///< its voxels for haptics and drilling: see CaseField.h
};

/// A file or folder from which parts of a case were read.
struct PartsOrigin
{
  std::filesystem::path path;
  std::filesystem::file_time_type read; ///< when
};

/// One patient's case as a value: its parts, their appearance, and what was drilled.
///
/// A copy is the case at this moment, also for another thread: a tool that cuts this one does not
/// change it. The mask is loaded only for drilling, rendering or queries of the field
/// (Library::loadDissection).
struct Case
{
  std::string name;
  std::string id;             ///< random, of the saved case; differs in a copy; may be empty
  std::uint64_t revision = 0; ///< of the manifest on disk; 0: never saved
  double iso = 300.0;         ///< HU
  /// HU of dense bone, to which presets are scaled; different in an uncalibrated image.
  double denseBone = volume::IntensityScale{}.dense;
  /// Estimated from the histogram; nullopt: in HU, an MR, not known, or of an older program.
  std::optional<volume::SoftTissueValues> softTissueValues;
  ImagePart ct; ///< the primary image: a CT, or an MR (ImagePart::modality)
  appearance::StructureAppearance boneLook = appearance::boneLook(); ///< of the CT itself
  /// Of what is neither bone nor a structure; not shown at first.
  appearance::StructureAppearance softTissue = appearance::softTissueLook();
  std::vector<ImagePart> mr;
  std::vector<LabelPart> labels;
  std::vector<MeshPart> meshes;
  std::optional<core::CameraPose> camera; ///< last view; nullopt: lateral view
  ViewState view;
  Description description;
  std::vector<Attachment> attachments;
  std::vector<Measurement> measurements;
  /// Since it was opened; Library::save remembers them. Not in the manifest.
  std::vector<PartsOrigin> origins;

  dissection::Dissection dissection; ///< the strokes, their history and the mask

  /// Persistent cache of data derived from the parts; nullptr: none.
  std::shared_ptr<core::DerivedStore> derived;

  std::size_t applied() const { return dissection.applied(); } ///< applied strokes
  double removedVolume() const;                                ///< mm^3, of the applied strokes
  volume::IntensityScale intensityScale() const { return {iso, denseBone}; }
};

/// The structure, or nullptr.
StructurePart* findStructure(Case& value, const std::string& name);
const StructurePart* findStructure(const Case& value, const std::string& name);
MeshPart* findMesh(Case& value, const std::string& name);
const ImagePart* findMr(const Case& value, const std::string& name);

/// Whether the name means the CT itself: "ct", or "bone" if no structure or mesh has that name.
bool meansBone(const Case& value, const std::string& name);

/// The name by which Case::softTissue is meant, which no part can have.
constexpr const char* kSoftTissue = "ct:soft-tissue";

/// Whether the name means Case::softTissue: kSoftTissue, or "soft-tissue" if no structure or mesh
/// has that name.
bool meansSoftTissue(const Case& value, const std::string& name);

/// The names of all parts of the case, for generating unique ones. Always includes "ct".
std::vector<std::string> partNames(const Case& value);

/// What of the case has this name: "image", "MR", "structure" or "mesh"; nullptr: nothing, so that
/// a new part of any kind may have it. Names are unique over all kinds.
const char* kindOfPart(const Case& value, const std::string& name);

/// Removes a structure, a mesh or an MR: one of them, in this order, where an older case has
/// several of one name. Appearances that read a removed MR read the CT again (soft
/// tissue with a function of it), and it no longer lies
/// over the slices; measurements along what was removed remember that. Throws InvalidParameter
/// listing the existing parts, Error (Refused) for an MR on which remaining structures were drawn.
void removePart(Case& value, const std::string& name);

/// Throws InvalidParameter unless the name is a valid file name on every system: 1 to 100 bytes of
/// UTF-8, no control characters, none of / \ : * ? " < > |, no leading or trailing dot or space, no
/// leading dash.
void checkCaseName(const std::string& name);

/// Throws InvalidParameter unless the name is valid for a part: 1 to 200 bytes of UTF-8 without
/// control characters, and neither "ct" nor kSoftTissue.
void checkPartName(const std::string& name);

/// Throws InvalidParameter unless the name is valid for a sign-off: 1 to 100 bytes of UTF-8 without
/// control characters, not blank.
void checkPersonName(const std::string& name);

/// Keeps `camera` and the slices of the case's view, without the MR over them, under a name; one of
/// the same name is replaced. Throws InvalidParameter naming a name or number that is not valid.
void saveView(Case& value, const std::string& name, const core::CameraPose& camera);

/// Camera, slices without the MR over them, and clipping, as a branch is left with them.
ViewState::Saved presentView(const Case& value);

/// Makes what a saved view has the case's own; the MR over the slices stays.
void showSaved(Case& value, const ViewState::Saved& saved);

} // namespace petrous::scene
