#pragma once

#include <functional>
#include <string>
#include <vector>

#include "petrous/Library/Library.h"
#include "petrous/Scene/ImageMask.h"

namespace petrous::presenters
{

/// Masks the images of a copy of a case that was opened in this library, after they were verified
/// against their hash; returns sentences for the user. Throws like scene::maskImages, LibraryError.
std::vector<std::string> maskLeavingImages(const library::Library& library, scene::Case& value,
                                           const scene::ImageMask& mask,
                                           const core::Progress& progress = {});

/// The same for library::ArchiveOptions::prepare; empty for a mask that masks nothing.
std::function<std::vector<std::string>(scene::Case&, const core::Progress&)>
maskForArchive(const library::Library& library, const scene::ImageMask& mask);

} // namespace petrous::presenters
