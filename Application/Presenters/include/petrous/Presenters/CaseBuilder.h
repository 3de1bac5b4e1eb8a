#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Imaging/ImageFile.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// A file that becomes a part of a case, with the name the user gave it (may be empty).
struct PartSource
{
  std::string name;
  std::filesystem::path path;
  /// Structures: the MR in whose patient space they lie, "ct" for the CT's; empty: not said.
  std::string drawnOn = {};
  std::string seriesUid = {}; ///< MR: which series of a DICOM folder; empty: the one that is meant

  /// "NAME=FILE" or "FILE". What names a file that is there is a FILE, whatever it contains.
  static PartSource parse(const std::string& text);

  /// The same, and "@MR" may follow.
  static PartSource parseDrawn(const std::string& text);
};

/// What a file's own name says of the structure in it, without what may be a patient's name.
struct FileName
{
  std::string name;     ///< the words of it that structures are called by, or empty
  bool isWhole = false; ///< these are all of it ("facial_nerve_left"); otherwise ask, or say so
};
FileName fileName(const std::filesystem::path& path);

struct PartSources
{
  std::vector<PartSource> mr;     ///< DICOM folders, NIfTI, NRRD, MetaImage
  std::vector<PartSource> labels; ///< NIfTI, NRRD (.seg.nrrd too), MetaImage
  std::vector<PartSource> meshes; ///< OBJ, STL, PLY
};

struct CaseSources
{
  std::filesystem::path ct;            ///< DICOM folder or file, NIfTI, NRRD or MetaImage
  std::string seriesUid;               ///< which series of a folder; empty: the one that is meant
  std::optional<core::PatientBox> roi; ///< crops the CT on load
  PartSources parts;
};

/// A case put together in memory, not saved. What was accepted or assumed on the way is in the
/// parts' notes. Labels of which nobody says on what they were drawn, and that have the grid of one
/// MR and not the CT's, were drawn on that MR. Throws the imaging module's errors, InvalidParameter
/// (also where several MR images have that grid), CancelledError.
scene::Case buildCase(const std::string& name, const CaseSources& sources,
                      const core::Progress& progress);

/// Adds parts to a case; on an exception the case is as before. Structure names must be new to the
/// case's labels, mesh names to its meshes. A part that nobody named is named by its file's words
/// for structures alone (fileName), and its notes say so. Refused (InvalidParameter) are
/// labels without a voxel, and a mesh that reaches beyond the image on which it was drawn farther
/// than volume::mostReach.
void addParts(scene::Case& value, const PartSources& parts, const core::Progress& progress);

} // namespace petrous::presenters
