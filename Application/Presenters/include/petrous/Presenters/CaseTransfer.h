#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Imaging/SeriesGeometry.h"
#include "petrous/Library/Archive.h"
#include "petrous/Library/Library.h"
#include "petrous/Network/DicomNode.h"
#include "petrous/Presenters/CaseDicom.h"
#include "petrous/Scene/ImageMask.h"

namespace petrous::presenters
{

struct ExportOptions;

struct SendParts
{
  bool ct = false; ///< the primary image, if it is a CT
  bool mr = false; ///< all MRs, the primary image among them if it is one
  bool labels = false;
  bool scene = false;
  bool note = true;           ///< of the description, with the scene
  bool videos = false;        ///< attached ones, with the scene; they may show or name the patient
  bool documents = false;     ///< likewise
  scene::ImageMask mask = {}; ///< of the images that are sent
  bool primary = false;       ///< the primary image alone, be it CT or MR
};

/// Whether an image leaves, as a series or in the scene: an MR by its name, the primary image by an
/// empty one.
bool isSent(const scene::Case& value, const SendParts& parts, const std::string& mr);

/// What of a case leaves the house with sendCase, and what does not: a sentence each, for the user
/// to read before. A case holds none of the attributes that identify a patient (PS3.15 Table
/// E.1-1); what remains is what the user typed, and the anatomy itself.
struct IdentityReport
{
  std::vector<std::string> leaves;
  std::vector<std::string> stays;
  std::vector<std::string> warnings; ///< what may identify the patient all the same
  /// Which names the warnings count: to show, and never to be kept or logged.
  std::vector<std::string> counted;

  std::string text() const;
};

/// `faces`: images that leave in which a face can be recognised (facesToMask); nullptr: not looked
/// for, and then images that hold a whole head are warned of. Reads no voxels. `library`: of the
/// case, by whose salt texts are compared with the patient's name (IdentityText); nullptr: they are
/// not.
IdentityReport identityReport(const scene::Case& value, const SendParts& parts,
                              const std::vector<scene::ImageWithFace>* faces = nullptr,
                              const library::Library* library = nullptr);
/// The same of an archive with these options (library::archiveCase), of which `mask` is what
/// `prepare` does to the images.
IdentityReport identityReport(const scene::Case& value, const library::ArchiveOptions& options,
                              const scene::ImageMask& mask = {},
                              const library::Library* library = nullptr,
                              const std::vector<scene::ImageWithFace>* faces = nullptr);
/// That a face can be recognised in images which leave as they are, and what to do about it, in
/// sentences for the user; none: in none of them.
std::vector<std::string> faceWarnings(const std::vector<scene::ImageWithFace>& left);
/// What may identify the patient in a file that exportCase writes.
std::vector<std::string> identityWarnings(const scene::Case& value, const ExportOptions& options,
                                          const library::Library* library = nullptr);

/// scene::imagesWithFace, without reading a case whose images are all smaller than a head.
std::vector<scene::ImageWithFace> facesToMask(const scene::Case& value,
                                              const core::Progress& progress = {},
                                              scene::FaceFindings* found = nullptr);

struct SendSummary
{
  network::Transfer transfer;
  std::string studyUid;           ///< made by this program; nobody's identity
  CasePatient patient;            ///< under which the node has it
  std::vector<std::string> notes; ///< for the user: what was left out, and why
};

/// Why what a node confirmed could not be counted there: "lists none of them (yet)", after "it
/// confirmed every instance, but"; empty: it lists all of them.
std::string unlistedText(const network::Transfer& sent);

/// Sends a case of the library to a DICOM node: CT and MR as series, structures as DICOM
/// segmentations that refer to them, and the scene as Raw Data (network::writeSceneObjects), from
/// which receiveCase restores the very same case. Every object is written from the case, which
/// holds no identity, and belongs to one study. Throws InvalidParameter if a part that is asked for
/// by itself cannot be written, NetworkError, LibraryError, CancelledError.
SendSummary sendCase(const library::Library& library, const std::string& name,
                     const network::Node& node, const SendParts& parts,
                     const core::Progress& progress = {});

/// What is looked for at a node. Empty: all cases of Petrous there.
struct StudySearch
{
  /// Part of the name of a case; capitals do not count, `*` stands for any text. Then the filter's
  /// patient and dates do not count: cases have none of their own.
  std::string caseName;
  network::StudyFilter filter;
};

struct FoundStudy
{
  network::Study study;
  bool isCase = false;  ///< sent, or exported, by Petrous
  std::string caseName; ///< empty: not known, as it may identify the patient
  /// Where `caseName` is that of a case of the library and the node has another patient's name
  /// than that case is sent under: that name.
  std::string otherName;
};

/// What a search found.
struct FoundStudies
{
  std::vector<FoundStudy> studies;
  std::vector<std::string> notes; ///< for the user: what was not looked for, and why
};

/// The studies that a search finds at a node. Cases of Petrous state no date: those that are not
/// excluded otherwise are found by every range of dates. The cases of the library are known also
/// where the node does not tell their names, and where the former version of the program sent them.
/// Throws NetworkError, LibraryError, CancelledError.
FoundStudies searchStudies(const network::Node& node, const StudySearch& search,
                           const library::Library& library, const core::Progress& progress = {});

struct ReceiveRequest
{
  std::string studyUid; ///< empty: by `caseName`
  std::string caseName; ///< the case of which a scene was sent
  std::string series;   ///< of a study without a scene: the CT; empty: chosen
  std::string as;       ///< name of the new case; empty: that of the scene
  bool repair = false;  ///< as CaseSources
  imaging::UndeclaredBits undeclaredBits = imaging::UndeclaredBits::Refuse; ///< likewise
  /// Keeps what arrives, and takes from there what arrived before; empty: a folder of its own,
  /// which is removed. DICOM files of a hospital's study hold the patient's identity.
  std::filesystem::path partial;
};

struct ReceiveSummary
{
  network::Transfer transfer;
  std::string name;   ///< of the new case
  bool scene = false; ///< restored from a scene; else built from images
  std::vector<std::string> notes;
};

/// The library has a case of the name under which one was to be received.
struct NameTakenError : library::LibraryError
{
  NameTakenError(const std::string& taken, const std::string& message)
    : LibraryError(Reason::NameTaken, message)
    , name(taken)
  {
  }
  std::string name;
};

/// Adds a case that a DICOM node has to the library: the latest scene of the study, or, where there
/// is none, a case built from its CT, MR and segmentations. The library is unchanged unless
/// everything arrived. Throws NetworkError, NameTakenError (before anything is transferred, where
/// the node tells the scene's case), LibraryError, DicomError, InvalidParameter, CancelledError.
ReceiveSummary receiveCase(library::Library& library, const network::Node& node,
                           const ReceiveRequest& request, const core::Progress& progress = {});

} // namespace petrous::presenters
