#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "petrous/Core/NumberText.h"
#include "petrous/Core/Progress.h"
#include "petrous/Imaging/FileError.h"

namespace petrous::imaging
{

/// The key under which files that this program writes keep the padding value: of a NRRD, or
/// "petrous_padding=VALUE" in the description of a NIfTI and the comment of a MetaImage.
constexpr const char* kPaddingKey = "petrous_padding";

/// The key under which files that this program writes say that their values are Hounsfield units:
/// of a NRRD and a MetaImage, or "petrous_unit=HU" as the intent_name of a NIfTI.
constexpr const char* kUnitKey = "petrous_unit";
constexpr const char* kHounsfield = "HU";

/// The value in "petrous_padding=VALUE"; nullopt for other text.
std::optional<double> paddingIn(std::string_view text);

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "files are written in host byte order");

/// Throws FileError "PATH: text"; control characters in the path are replaced by '?'.
[[noreturn]] void fail(FileError::Reason reason, const std::filesystem::path& path,
                       const std::string& text, core::Fault fault = core::Fault::BadInput);

/// The file name in lower case, for comparing extensions.
std::string lowerName(const std::filesystem::path& path);
bool endsWith(std::string_view text, std::string_view end);

/// Throws FileError (UnknownFormat) for a file that is not of the format that its name says; names
/// the one that it is in, if that is recognised.
[[noreturn]] void failFormat(const std::filesystem::path& path, std::string_view expected);
/// Throws so for a file that is recognised as one of another format.
void checkFormat(const std::filesystem::path& path, std::string_view expected);

/// Size of a file to be read. Throws NotFound for a missing file or a folder, Unreadable for an
/// empty file or one that cannot be opened.
std::uintmax_t checkedFileSize(const std::filesystem::path& path);

/// Throws FileError (Unsupported) for a file above 4 GiB, the limit for reading whole files, and
/// CancelledError.
std::string readWholeFile(const std::filesystem::path& path, const core::Progress& progress);

/// The first `limit` bytes of a file, or fewer if it is shorter.
std::string readBytes(const std::filesystem::path& path, std::uintmax_t limit);

/// The voxel file named by a detached header, relative to the header. One that lies neither beside
/// the header nor below is noted, once. Throws NotFound.
std::filesystem::path detachedFile(const std::filesystem::path& header, const std::string& name,
                                   std::vector<std::string>& notes);

using core::exactText;
using core::PlainNumbers;

/// Four significant digits, for messages.
std::string roughText(double value);
std::string dimsText(const std::vector<std::uint64_t>& dims);

/// All of `text` as a finite number, locale-independent.
std::optional<double> parseDouble(std::string_view text);
std::optional<float> parseFloat(std::string_view text);
/// All of `text` as an integer.
std::optional<std::int64_t> parseInteger(std::string_view text);

std::string_view trimmed(std::string_view text);
/// Removes the next word from the front of `text`; empty at its end.
std::string_view takeWord(std::string_view& text);
/// Removes the next line from the front of `text`; returned without line end.
std::string_view takeLine(std::string_view& text);

} // namespace petrous::imaging
