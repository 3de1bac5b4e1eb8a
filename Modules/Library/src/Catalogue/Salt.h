#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "petrous/Scene/ImagePart.h"

namespace petrous::library
{

/// 128 bits of the system's random generator, as hexadecimal digits.
std::string drawnId();

/// The library's secret salt, drawn once. The library must be locked where there is none yet.
/// Throws LibraryError if it is not what this program wrote.
std::string saltOf(const std::filesystem::path& library);

/// Whether it is there, and what this program wrote.
bool hasSalt(const std::filesystem::path& library) noexcept;

/// `salt`, which may be called by several threads, returns the salt.
scene::IdentitySalt identitySalt(std::function<std::string()> salt);

} // namespace petrous::library
