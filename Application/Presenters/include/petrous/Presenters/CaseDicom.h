#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/Error.h"
#include "petrous/Core/Fingerprint.h"
#include "petrous/Core/Progress.h"
#include "petrous/Library/Library.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// Study ID (0020,0010) of DICOM objects of a case of this name: a hash, by which a node finds the
/// case whatever the patient is called there.
std::string studyIdOf(const std::string& caseName);
/// The same of a case whose name does not leave: only this library, by its salt, can tell whether a
/// name is behind it.
std::string hiddenStudyIdOf(const library::Library& library, const std::string& caseName);
/// The name of a case as CasePatient::name states it: without '^' and '=', and cut.
std::string toldName(const std::string& caseName);
/// Whether it has the form of one.
bool isStudyId(const std::string& text);

/// Whom DICOM objects name as the patient.
struct CasePatient
{
  std::string id;   ///< (0010,0020) imaging::casePatientId
  std::string name; ///< (0010,0010) "Petrous^" and the case's name, or the ID
  /// Why the case's name does not leave, and what would allow it: it has what looks like a
  /// patient's (IdentityText), or nothing is known of the patient's name with which it could be
  /// compared, as in a case that was restored. Empty: it leaves.
  std::string whyNameHidden;

  bool isNameHidden() const { return !whyNameHidden.empty(); }
};

/// Identifiers of DICOM files that are written of a case: derived from the case's ID and name and
/// the voxels, so that what is written at different times belongs together. Images and
/// segmentations of one case share the patient, the study and, in one space, the frame of reference
/// (exportedFrame). A node knows a study by one patient and one name: a case that was renamed is
/// another one there. Refers to the case.
class CaseIdentifiers
{
public:
  explicit CaseIdentifiers(const scene::Case& value);

  std::string study() const;
  /// Of what the program's former version sent.
  std::string formerStudy() const;

  /// Nobody: by it a node tells cases apart. `library`: of the case.
  CasePatient patient(const library::Library& library) const;

  /// `drawnOn`: the MR whose space it is; empty: the CT's.
  std::string frameOfReference(const std::string& drawnOn) const;

  /// `what`: "ct", "mr" or "dissected".
  std::string series(const std::string& what, const volume::IntensityVolume& image) const;

  core::Fingerprint fingerprint() const { return m_case; }

private:
  const scene::Case& m_value;
  core::Fingerprint m_case;
};

/// A label map as it is written: in one space, with those of its structures that are asked for.
struct PlacedLabels
{
  std::shared_ptr<const volume::LabelMap> map;
  std::string drawnOn; ///< the MR in whose space it lies; empty: in the CT's
  std::vector<const scene::StructurePart*> structures;
};

/// Brings label maps whose grids are parts of one lattice (equal axes, up to their order and sense,
/// and voxel centres that coincide within 0.01 mm) onto one grid: that of `image`, where it is on
/// the lattice and contains all of them, else the smallest that contains all. Voxels are copied,
/// none is resampled or lost. Returns nullopt, or, changing nothing, a map that cannot be brought
/// onto a grid with the first one: the lattices differ, or they lie so far apart that the grid
/// would have more than eight times the voxels of the largest and of the image.
std::optional<std::size_t> padToOneGrid(std::vector<PlacedLabels>& placed,
                                        const core::GridGeometry& image,
                                        const core::Progress& progress = {});

/// The voxels of an image are fractions that the 16 bits of a DICOM series do not hold.
struct FractionsError : core::InvalidParameter
{
  using core::InvalidParameter::InvalidParameter;
};

/// What all objects of a case state.
struct CaseDicomOptions
{
  CasePatient patient;
  std::string studyId;
  int segmentationNumber = 10; ///< series number; the highest of a study is the latest
};

CaseDicomOptions dicomOptionsOf(const scene::Case& value, const library::Library& library);

/// Writes a DICOM series (imaging::writeDicomSeries) with identifiers of its own and nothing of the
/// patient's into a folder that is to be committed by the caller. Equal voxels give equal files.
///
/// what     "ct", "mr" or "dissected"
/// part     of the case, which `image` is or was made from: its provenance is written with it
/// drawnOn  the MR whose space it is; empty: the CT's
/// onCt     an MR, resampled on the CT's grid
///
/// Fractions are written with a rescale slope; returns by how much a voxel is off at most (nullopt:
/// there are none). Throws FractionsError for a CT whose fractions would be off by more than half a
/// unit and for an MR with a voxel that is not finite, and like writeDicomSeries.
std::optional<double> writeCaseSeries(const std::filesystem::path& folder, const scene::Case& value,
                                      const std::string& what, const scene::ImagePart& part,
                                      const volume::IntensityVolume& image,
                                      const std::string& drawnOn, bool onCt,
                                      const CaseDicomOptions& options,
                                      const core::Progress& progress);

/// What the user is told of it.
std::string roundingNote(const std::string& name, double error);

/// Likewise of the slices that repair interpolated, and of left and right that are assumed; empty:
/// nothing is.
std::string guessedNote(const scene::ImagePart& part);

/// Likewise of the place of structures.
std::string guessedNote(const scene::LabelPart& part);

/// Writes structures as a DICOM segmentation that belongs to the series of the CT, or of the MR,
/// which writeCaseSeries writes; `placed`: on one grid in one space. Returns the number of
/// segments. Throws like imaging::writeDicomSegmentation.
std::size_t writeCaseSegmentation(const std::filesystem::path& path, const scene::Case& value,
                                  const std::vector<PlacedLabels>& placed,
                                  const std::string& sourceSeries, const CaseDicomOptions& options,
                                  const core::Progress& progress);

} // namespace petrous::presenters
