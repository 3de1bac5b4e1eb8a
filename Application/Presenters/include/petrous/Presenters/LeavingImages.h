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

/// The same for library::ArchiveOptions::prepare, without the MRs of these names, which throws like
/// scene::removeMr; empty for a mask that masks nothing, and no MR.
std::function<std::vector<std::string>(scene::Case&, const core::Progress&)>
maskForArchive(const library::Library& library, const scene::ImageMask& mask,
               const std::vector<std::string>& withoutMrs = {});

/// Takes MRs out of a copy of a case. Throws InvalidParameter for a name of none, and Error
/// (Refused) for one on which structures were drawn.
void leaveOutMrs(scene::Case& value, const std::vector<std::string>& names);

} // namespace petrous::presenters
