#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Library/Library.h"

namespace petrous::library
{

/// Format of archives: one zip file (APPNOTE 6.3, zip64 where needed).
///
///     petrous.json              format, name of the case, the objects with their size in bytes
///     case.json                 the manifest, as in the library
///     ct.nrrd, mr/NAME.nrrd     images, the library's objects with gzip encoding
///     labels/NAME.seg.nrrd, meshes/NAME.obj, strokes/NUMBER.stroke    objects as they are
///     attachments/NAME          likewise
///
/// petrous.json also has the thumbnail ("thumbnail_png", base64), where there is one and images go
/// along: there, programs that know none pass over it.
///
/// Other programs open the parts as they are unzipped. What is restored is the library's objects
/// to the byte: their names are the SHA-256 of their content. Label maps are as the case shows
/// them: one whose structures were renamed, or removed in part, is written anew for the archive.
constexpr int kArchiveFormat = 1;
constexpr const char* kArchiveEnding = ".petrous";

struct ArchiveOptions
{
  /// Only the manifest, the strokes and small attachments: no image, label map or mesh. It is
  /// restored where the very same CT is.
  bool planOnly = false;
  /// Of the images' compression, 1 (fast) to 12 (small). nullopt: the fastest mix of two levels
  /// up to 7 that makes the image no larger than gzip -6 does, by samples of it; where none does,
  /// as of white noise, the smallest.
  std::optional<int> level = {};
  bool withoutNotes = false; ///< Description::note stays here
  /// Dates, times (of the operation, attachments and strokes) and who signed registrations go
  /// along. They identify: with the list of a day's operations, everybody knows who the patient is.
  /// Else a registration that was signed stays so, without who and when.
  bool keepIdentity = false;
  /// Videos go along, linked ones as embedded; they may show or name the patient.
  bool withVideos = false;
  /// So do documents: a PDF names its author, and reports their patient.
  bool withDocuments = false;
  /// Changes the copy of the case that is written (scene::maskImages); returns sentences for the
  /// user. Images that it leaves without an object are written to the archive alone, and no
  /// thumbnail goes along. Not called for a plan.
  std::function<std::vector<std::string>(scene::Case&, const core::Progress&)> prepare = {};
};

/// A plan takes screenshots and recordings along up to this size, bytes; and no other attachments.
constexpr std::uint64_t kLargestOfPlan = 16U << 20;

/// Whether an attachment goes along, by its kind and size.
bool takesAlong(const ArchiveOptions& options, const scene::Attachment& attachment) noexcept;

struct ArchiveSummary
{
  std::string name;              ///< of the case
  std::size_t parts = 0;         ///< objects
  std::uintmax_t inputBytes = 0; ///< of these objects in the library
  std::uintmax_t archiveBytes = 0;
  bool planOnly = false;
  bool durable = true;            ///< false: complete, but the disk did not confirm it
  std::vector<std::string> notes; ///< for the user: what of the description stayed, or went along
};

/// Writes a saved case to one file, complete or not at all. Every object is verified against its
/// hash as it is read. Throws LibraryError (NotFound, Damaged), ManifestError,
/// core::OutputFileError, CancelledError; the file is then as it was.
ArchiveSummary archiveCase(const Library& library, const std::string& name,
                           const std::filesystem::path& file, const ArchiveOptions& options = {},
                           const core::Progress& progress = {});

struct RestoreOptions
{
  std::string name; ///< of the new case; empty: that of the archive
  /// A case of this library with the very same CT, for an archive of a plan; empty: any such case.
  std::string ct;
};

struct RestoreSummary
{
  std::string name;
  std::size_t parts = 0;    ///< objects of the archive
  std::size_t newParts = 0; ///< of these, how many the library did not have
  bool planOnly = false;
  std::vector<std::string> notes; ///< for the user, e.g. parts that a plan does not bring along
};

/// What an archive says of itself, without its objects. Throws like restoreCase.
ArchiveSummary inspectArchive(const std::filesystem::path& file);

/// Adds the case of an archive to the library. The archive is checked as a whole before anything
/// is written (names, sizes, duplicate or foreign entries, free space), each object against its
/// hash before the case appears. Throws LibraryError (Damaged, NotFound, NameTaken, DiskFull,
/// Unwritable), ManifestError, CancelledError; the library is then as it was.
RestoreSummary restoreCase(Library& library, const std::filesystem::path& file,
                           const RestoreOptions& options = {}, const core::Progress& progress = {});

} // namespace petrous::library
