#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/AxesCorrection.h"
#include "petrous/Core/Progress.h"
#include "petrous/Imaging/ImageFile.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Imaging/PatientKey.h"
#include "petrous/Imaging/SeriesGeometry.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// A file that becomes a part of a case, with the user's name for it (may be empty).
struct PartSource
{
  std::string name;
  std::filesystem::path path;
  /// Structures: the MR in whose patient space they are defined, "ct" for the CT's; empty:
  /// unspecified.
  std::string drawnOn = {};
  /// MR: which series and volume of a DICOM folder (imaging::chooseSeries); empty: automatic.
  std::string series = {};
  bool repair = false;                                                      ///< MR: as CaseSources
  imaging::UndeclaredBits undeclaredBits = imaging::UndeclaredBits::Refuse; ///< likewise
  /// MR: crops it on load, patient LPS mm of the MR itself.
  std::optional<core::PatientBox> roi = std::nullopt;
  /// MR, DICOM SEG, RT structure set: whether it may state another patient than the case's images
  /// do.
  bool isOtherPatient = false;
  /// Meshes: whether the file is in RAS (else LPS), and its unit in mm; nullopt: as it states,
  /// else LPS mm if that fits the image. The unit also of other files of voxels.
  std::optional<bool> isRas = std::nullopt;
  std::optional<double> unit = std::nullopt;
  /// MR and structures whose file leaves open which side of the patient is left: as CaseSources.
  std::optional<bool> assumeRas = std::nullopt;
  /// Structures: a table of names for this file alone; empty: PartSources::labelNames.
  std::filesystem::path labelNames = {};
  /// Structures, and meshes of a file's objects: those whose names are taken are left out;
  /// otherwise none is added.
  bool skipsTaken = false;
  /// Names that are taken get a number: "nerve 2".
  bool numbersTaken = false;
  /// Other names than the part, or its structures, would have.
  std::map<std::string, std::string> newNames = {};
  /// Of an MR, as CaseSources. Of structures and meshes: theirs, about their image's centre and in
  /// place of its; "LPS" leaves them where they are, also if an MR of their grid is added later.
  std::optional<core::AxesCorrection> axes = std::nullopt;
  std::string description = {}; ///< MR: SourceContent's
  /// Meshes: of a file that holds several objects each becomes a part of its own, named as
  /// structures of a file are: "NAME object", without words that may be a patient's name.
  bool isPerObject = false;
  /// Structures: added where they lie although they may have been drawn on the slices of the CT as
  /// they were before its repair (LabelsUnrepaired).
  bool asTheyLie = false;

  /// "NAME=FILE" or "FILE". A string that is the path of an existing file is a FILE.
  static PartSource parse(const std::string& text);

  /// As parse, optionally followed by "#UID", "#UID#VOLUME" or "##VOLUME".
  static PartSource parseSeries(const std::string& text);

  /// As parse, optionally followed by "@MR".
  static PartSource parseDrawn(const std::string& text);
};

/// What a file name says about the structure in it, without anything that may be a patient's name.
struct FileName
{
  std::string name;     ///< its words that are structure names, or empty
  bool isWhole = false; ///< these are all of it ("facial_nerve_left"); otherwise ask or warn
};
FileName fileName(const std::filesystem::path& path);

/// What the structures of a folder of masks are called in a case, in its order: without the words
/// that most of its files share, which may be a patient's name. "structure": nothing is left.
std::vector<std::string> maskNames(const imaging::LoadedLabels& folder);

struct PartSources
{
  std::vector<PartSource> mr; ///< DICOM folders, NIfTI, NRRD, MetaImage
  /// NIfTI, NRRD (.seg.nrrd too), MetaImage, DICOM SEG and RT structure sets; a folder of masks
  std::vector<PartSource> labels;
  /// A table of names for those of `labels` that have none (imaging::loadLabels); empty: none. Of
  /// several sources, one of a single structure keeps its own.
  std::filesystem::path labelNames = {};
  std::vector<PartSource> meshes; ///< OBJ, STL, PLY, VTP
  /// A hash of a frame of reference or patient as the library of a stored case keeps it
  /// (library::saltedFrame), so that a new file's can be compared with it; empty: only cases that
  /// are not stored are compared.
  scene::IdentitySalt salted = {};
};

/// A mesh that probably counts otherwise than it was read: the user has to say how.
struct MeshSpaceUnclear : core::InvalidParameter
{
  MeshSpaceUnclear(std::filesystem::path file, const std::string& problem,
                   std::vector<imaging::MeshSpace> spaces);
  std::filesystem::path path;
  /// How the file may count; the first is how it was read, with the others the mesh lies in its
  /// image.
  std::vector<imaging::MeshSpace> likely;
};

/// An MR or structures that state another patient than an image of the case: the user has to say
/// whether they may.
struct OtherPatient : core::Error
{
  /// `differences`: at least one.
  OtherPatient(const std::filesystem::path& file, const imaging::PatientDifferences& differences);
  std::string differing; ///< "patient ID and patient name": what differs, never its value
};

/// A file of voxels that leaves open which side of the patient is left: the user has to say.
struct ImageSideUnclear : core::InvalidParameter
{
  /// `option`: of the command, that says it.
  ImageSideUnclear(const std::filesystem::path& file, const std::string& option);
};

/// A file of voxels whose unit of length makes no sense (imaging::UnitDoubt): the user has to say.
struct ImageUnitUnclear : core::InvalidParameter
{
  /// `option`: of the command, that says it.
  ImageUnitUnclear(const std::filesystem::path& file, const imaging::UnitDoubt& doubt,
                   const std::string& option);
  imaging::UnitDoubt doubt;
};
/// Of a length in mm: "nm", "µm", "mm", "cm", "inch" or "m"; of another, the length: "2 mm".
std::string unitName(double unit);
/// A length in mm of about three digits, without an exponent.
std::string lengthText(double mm);

/// Structures that state another frame of reference than each image of the case: the user has to
/// say on which image they were drawn. Likewise of structures and meshes that do not tell whether
/// they lie in an image's space as its file states it or with its axes corrected.
struct FrameUnclear : core::InvalidParameter
{
  /// `image`: primaryName.
  FrameUnclear(const std::filesystem::path& file, const std::string& image);
  /// `image`: the part's name. `option`: of the command, that says that they are not moved.
  FrameUnclear(const std::filesystem::path& file, const std::string& image,
               const core::AxesCorrection& axes, const std::string& option);
};

/// Structures on another lattice than the CT, which was repaired: a program that takes the slices
/// of a tilted or gapped stack for straight and even places what was drawn on them elsewhere. The
/// user has to say whether they lie where they belong. Not thrown of DICOM, which states where each
/// slice or contour lies.
struct LabelsUnrepaired : core::InvalidParameter
{
  LabelsUnrepaired(const std::filesystem::path& file, double apart);
  double apart; ///< mm, by how much they lie elsewhere at most
};

/// Names of a part or of structures of one source that the case has already: the user has to say
/// what they are called here (PartSource::newNames), or that the others come without them.
struct NamesTaken : core::Error
{
  /// `message`: of a part that is one.
  NamesTaken(const std::string& message, const std::string& name);
  /// `others`: how many structures are left without them.
  NamesTaken(const std::filesystem::path& file, std::vector<std::string> names, std::size_t others);
  std::vector<std::string> names;
  std::size_t others;
};

/// "LPS mm", "RAS m", ..
std::string textOf(const imaging::MeshSpace& space);
/// "LPS (DICOM, ITK), mm", "RAS (Slicer, NIfTI), m", ..
std::string coordinatesOf(const imaging::MeshSpace& space);

/// What became of a structure of a file.
struct StructureReport
{
  enum class Status
  {
    Read,
    Empty,   ///< no voxel
    Skipped, ///< its name is taken (PartSource::skipsTaken), or it lies outside (leaveOutside)
    Unread   ///< what describes it is damaged or not read here; the part's notes say why
  };
  std::string name;
  Status status = Status::Read;
  std::uint64_t voxels = 0;
  double volume = 0.0;                             ///< mm^3, of the voxels
  std::optional<double> fileVolume = std::nullopt; ///< mm^3, by the file's own contours or frames
  std::size_t layer = 0;                           ///< of its source's overlapping structures
  std::string why = {};                            ///< of Unread: "it holds ..", if known
  bool isOutside = false;                          ///< wholly outside the primary image
  std::filesystem::path file = {};                 ///< of Read

  /// How far the voxels' volume is from the file's, in parts of the file's (0.01: 1 % more);
  /// nullopt if the file encloses none.
  std::optional<double> volumeError() const;
};

/// "read", "empty", "skipped" or "unread"
const char* nameOf(StructureReport::Status status);

/// Takes the structures that a report says lie wholly outside of the primary image out of the case
/// again; their reports are then Skipped. What was noted of a file stays with what is left of it.
void leaveOutside(scene::Case& value, std::vector<StructureReport>& reports);

/// Counts over the structures of files.
struct StructureSummary
{
  std::size_t read = 0, empty = 0, skipped = 0, unread = 0;
  /// The structure whose voxels are farthest from the volume by the file, of those with one;
  /// nullptr if there is none. Into the reports.
  const StructureReport* worst = nullptr;
  std::string text; ///< one line, e.g. "58 structures read, 1 empty, 1 not read"
};
StructureSummary summaryOf(const std::vector<StructureReport>& reports);

struct CaseSources
{
  std::filesystem::path ct; ///< primary image: DICOM folder or file, NIfTI, NRRD or MetaImage
  /// What it is, if the file does not say or is wrong; Unknown: by the DICOM modality, else by the
  /// values, and the image's notes say so.
  scene::Modality modality = scene::Modality::Unknown;
  std::string series;  ///< which of a folder (imaging::chooseSeries); empty: chosen automatically
  bool repair = false; ///< resamples what imaging::ReadOptions::repair can
  imaging::UndeclaredBits undeclaredBits = imaging::UndeclaredBits::Refuse; ///< likewise
  std::optional<core::PatientBox> roi; ///< crops the CT on load
  /// A primary image whose file leaves open which side of the patient is left: whether its axes
  /// are taken as RAS (else LPS); nullopt: it is refused.
  std::optional<bool> assumeRas = std::nullopt;
  /// Of its file of voxels, mm; nullopt: as it states, and if that is in doubt, it is refused.
  std::optional<double> unit = std::nullopt;
  /// Of the axes that its file states, which are wrong; after all of the above.
  core::AxesCorrection axes = {};
  PartSources parts;
};

/// A case built in memory, not saved. What was accepted or assumed is in the parts' notes. Labels
/// whose image is unspecified, and whose grid is that of one MR and not the CT's, are taken as
/// drawn on that MR; so is a DICOM SEG in the frame of reference of an MR and not the CT's, and one
/// in neither, nor in that of files exported from the case (exportedFrame), is refused unless
/// "FILE@ct" says otherwise. What was drawn on an image in the axes that its file states follows
/// their correction: labels on that grid, or in the file's frame of reference, and what the user
/// says was drawn on it; what does not tell is FrameUnclear. Throws the imaging module's errors,
/// ImageSideUnclear, InvalidParameter (also if several MR images have that grid), OtherPatient,
/// CancelledError.
scene::Case buildCase(const std::string& name, const CaseSources& sources,
                      const core::Progress& progress,
                      std::vector<StructureReport>* report = nullptr);

/// Adds parts to a case; strong exception guarantee. Structure names must be new to the case's
/// labels, mesh names to its meshes. Label files that may have been drawn on the slices before the
/// CT's repair are LabelsUnrepaired unless their source says that they lie where they belong. A
/// part without a given name is named by the structure words of its file name (fileName), and its
/// notes say so. An MR or a file of structures, if it and an image of the case state different
/// patients (imaging::samePatient), is OtherPatient unless its source allows it; its notes then say
/// so. An MR or label file that leaves open which side of the patient is left is ImageSideUnclear
/// unless its source says it, or it is a label file with the grid of an image of the case, which it
/// follows. Throws NamesTaken (Refused) for names that are taken; InvalidParameter for labels
/// without a voxel, and for a mesh that extends beyond the image on which it was drawn by more than
/// volume::maxReach; MeshSpaceUnclear for one that lies in it only in another frame or unit.
/// `report`, if given, gets every structure of `parts.labels`.
void addParts(scene::Case& value, const PartSources& parts, const core::Progress& progress,
              std::vector<StructureReport>* report = nullptr);

/// A part that could not be added.
struct PartFailure
{
  PartSource source;
  std::string why;                                      ///< names the file
  std::vector<imaging::MeshSpace> likely = {};          ///< of MeshSpaceUnclear
  bool isOtherPatient = false;                          ///< OtherPatient
  std::string differing = {};                           ///< likewise
  bool isSideUnclear = false;                           ///< ImageSideUnclear
  imaging::UnitDoubt unitDoubt = {};                    ///< ImageUnitUnclear
  bool isBitsUnclear = false;                           ///< imaging::BitsUnclearError
  bool canKeepBits = false;                             ///< likewise
  bool isFrameUnclear = false;                          ///< FrameUnclear
  double unrepaired = 0.0;                              ///< mm; LabelsUnrepaired
  std::vector<std::string> taken = {};                  ///< NamesTaken
  std::size_t others = 0;                               ///< likewise
  std::vector<PartSource> PartSources::*kind = nullptr; ///< of which it is one
};

/// As addParts, one part after the other: those that can be added are, the others are returned.
/// Throws CancelledError; the case is unchanged then.
std::vector<PartFailure> addSoundParts(scene::Case& value, const PartSources& parts,
                                       const core::Progress& progress,
                                       std::vector<StructureReport>* report = nullptr);

/// The frame of reference UID of DICOM files that are exported from a case: of those in the CT's
/// space, or of those in the space of the MR `drawnOn`.
std::string exportedFrame(const scene::Case& value, const std::string& drawnOn);

/// Adds structures made in this program, on a grid in the CT's patient space, as if they had been
/// read from a file: each looks as its name says. Their names are those of the map's segments.
/// Throws InvalidParameter for a name that is not valid or is in the case already, and for a
/// structure without a voxel; the case is unchanged then.
void addStructures(scene::Case& value, volume::LabelMap labels);

/// What `structure` keeps of the one that it replaces: the look, and what it is; how it was made is
/// its own.
void keepIdentity(scene::StructurePart& structure, const scene::StructurePart& replaced);
/// Whether a structure with the look of `preset` keeps it under this name: unless that is the name
/// of another kind of structure.
bool keepsLook(const std::string& name, const std::string& preset);

/// The colours of all structures and meshes, for one that is to differ (DistinctColors).
std::vector<std::array<float, 3>> structureColors(const scene::Case& value);

} // namespace petrous::presenters
