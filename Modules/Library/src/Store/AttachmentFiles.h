#pragma once

#include <filesystem>
#include <string>

#include "petrous/Core/Progress.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Scene/Case.h"

namespace petrous::library
{

/// Stores the content of every attachment that has no object yet, or whose object is not in this
/// store while its source is known. Throws LibraryError and core::OutputFileError.
void storeAttachments(scene::Case& value, ObjectStore& store, const core::Progress& progress = {});

/// By how the file begins. Throws core::InputFileError.
bool isOfKind(const std::filesystem::path& file, scene::Attachment::Kind kind);

std::string attachmentText(const scene::Attachment& attachment); ///< for messages

} // namespace petrous::library
