#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace petrous::library
{

constexpr const char* kThumbnailFolder = "thumbnails";
constexpr std::uintmax_t kLargestThumbnail = 1U << 20; ///< bytes; uncompressed it has 147,648

/// The file of a case's thumbnail, there or not. It goes by the id of the case, so that a case that
/// takes the name of another never shows that one's picture. Empty if the id is none that Library
/// gave (a manifest is not trusted with a path).
std::filesystem::path thumbnailPath(const std::filesystem::path& library, const std::string& id);

/// The ids of all pictures that are there, sound or not.
std::set<std::string> thumbnailIds(const std::filesystem::path& library);

/// The picture of that id; empty if there is none, or none that is sound.
std::vector<std::uint8_t> readThumbnail(const std::filesystem::path& library,
                                        const std::string& id) noexcept;

/// Writes it for that id. The library must be locked. Throws LibraryError.
void writeThumbnail(const std::filesystem::path& library, const std::string& id,
                    const std::vector<std::uint8_t>& png);

} // namespace petrous::library
