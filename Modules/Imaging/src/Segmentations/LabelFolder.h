#pragma once

#include <filesystem>

#include "petrous/Imaging/LabelFile.h"

namespace petrous::imaging
{

/// Reads a folder of masks, one structure a file (loadLabels). Throws FileError (Unsupported) if
/// none of its files is one, CancelledError.
LoadedLabels readLabelFolder(const std::filesystem::path& folder, const core::Progress& progress,
                             const std::vector<ImageGrid>& images, const std::optional<bool>& isRas,
                             const std::optional<double>& unit);

} // namespace petrous::imaging
