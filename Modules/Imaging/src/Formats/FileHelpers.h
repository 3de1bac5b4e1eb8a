#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "petrous/Core/NumberText.h"
#include "petrous/Imaging/FileError.h"

namespace petrous::imaging
{

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "files are written in host byte order");

/// Throws FileError "PATH: text"; control characters in the path become '?'.
[[noreturn]] void fail(FileError::Reason reason, const std::filesystem::path& path,
                       const std::string& text, core::Fault fault = core::Fault::BadInput);

/// The file name in lower case, for comparing extensions.
std::string lowerName(const std::filesystem::path& path);
bool endsWith(std::string_view text, std::string_view end);

/// File name without .seg.nrrd, .nii.gz or else without its last extension.
std::string baseName(const std::filesystem::path& path);

/// Size of a file that is to be read. Throws NotFound for nothing or a folder, Unreadable for an
/// empty file or one that may not be opened.
std::uintmax_t checkedFileSize(const std::filesystem::path& path);

/// Throws FileError (Unsupported) for a file that is larger than any that is read whole, 4 GiB.
std::string readWholeFile(const std::filesystem::path& path);

/// The first `limit` bytes of a file, or all where there are fewer.
std::string readBytes(const std::filesystem::path& path, std::uintmax_t limit);

/// The file of voxels that a detached header names, beside the header. Throws NotFound.
std::filesystem::path detachedFile(const std::filesystem::path& header, const std::string& name);

using core::exactText;
using core::PlainNumbers;

/// Four significant digits, for messages.
std::string roughText(double value);
std::string dimsText(const std::vector<std::uint64_t>& dims);

/// The whole of `text` as a finite number, whatever the locale.
std::optional<double> parseDouble(std::string_view text);
std::optional<float> parseFloat(std::string_view text);
/// The whole of `text` as a whole number.
std::optional<std::int64_t> parseInteger(std::string_view text);

std::string_view trimmed(std::string_view text);
/// Takes the next word off the front of `text`; empty at its end.
std::string_view takeWord(std::string_view& text);
/// Takes the next line off the front of `text`, without its end.
std::string_view takeLine(std::string_view& text);

} // namespace petrous::imaging
