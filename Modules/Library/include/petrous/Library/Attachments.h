#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Library/Library.h"
#include "petrous/Scene/Attachment.h"

namespace petrous::library
{

constexpr std::uint64_t kLargestEmbedded = std::uint64_t{2} << 30; ///< bytes; larger: linked
constexpr std::uint64_t kLargestPng = std::uint64_t{256} << 20;    ///< bytes

struct AttachOptions
{
  /// In the case; empty: by its kind ("document.pdf"), as a file's name may be a patient's.
  std::string name;
  std::string note;
  std::string date;  ///< ISO 8601; empty: today
  bool link = false; ///< only where the file is, its size and its hash are kept
};

/// An attachment of a file, for the next save of the case; `source` is set unless it is a link. Its
/// kind is told by how the file begins: a recording of the tool, PNG, PDF, or a video (MP4 or MOV,
/// Matroska or WebM, AVI, MPEG, WMV, FLV, Ogg; sound likewise). Throws InvalidParameter naming the
/// file for anything else, one that is too large, or no regular file.
scene::Attachment attachmentOf(const std::filesystem::path& file, const AttachOptions& options,
                               const core::Progress& progress = {});

/// The same of a PNG in memory.
scene::Attachment screenshotOf(std::vector<std::uint8_t> png, const AttachOptions& options);

bool hasAttachment(const scene::Case& value, scene::Attachment::Kind kind) noexcept;

/// Adds it to the case, under a name that is free. Returns the name.
std::string attach(scene::Case& value, scene::Attachment attachment);

/// A PNG with nothing but IHDR, PLTE, tRNS, gAMA, sRGB, pHYs, IDAT and IEND [PNG, 2nd edition]:
/// without texts, times, EXIF, and what follows its end. Throws InvalidParameter for what is not a
/// PNG, or one with a wrong checksum.
std::vector<std::uint8_t> cleanedPng(const std::vector<std::uint8_t>& png);

/// What is wrong with the file of an attachment, without reading all of it: missing, or of another
/// size. Empty: nothing.
std::string attachmentProblem(const Library& library, const scene::Attachment& attachment);

/// The same after all of it is read: also another content of the same size is "changed". Throws
/// CancelledError.
std::string attachmentChange(const Library& library, const scene::Attachment& attachment,
                             const core::Progress& progress = {});

/// Where its content lies: in the library, where it is linked, or, not yet saved, where it comes
/// from. Throws InvalidParameter naming it if that is nowhere yet.
std::filesystem::path attachmentFile(const Library& library, const scene::Attachment& attachment);

/// Copies the file of an attachment, verified against its hash, to `out`. Throws LibraryError
/// (NotFound, Damaged), core::OutputFileError, CancelledError; `out` is then as it was.
void extractAttachment(const Library& library, const scene::Case& value,
                       const scene::Attachment& attachment, const std::filesystem::path& out,
                       const core::Progress& progress = {});

} // namespace petrous::library
