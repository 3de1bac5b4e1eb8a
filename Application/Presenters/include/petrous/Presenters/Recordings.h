#pragma once

#include <filesystem>

#include "petrous/Library/Library.h"

namespace petrous::presenters
{

/// Where a session that begins now is recorded unless the user says otherwise:
///
///   LIBRARY/recordings/CASE 2026-03-01 09-30-00.ticks     local time; " (2)" where there is one
///
/// beside the cases, so that who copies the library has both, and out of what a case's archive
/// carries. Makes the folder; throws core::Error (Refused) when it cannot.
std::filesystem::path newRecording(const library::Library& library, const scene::Case& value);

} // namespace petrous::presenters
