#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Presenters/SliceGeometry.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// A scan to be looked at before it becomes a case.
struct ScanPreview
{
  scene::Case value;             ///< its CT alone, coarser or in part, for SlicePresenter
  core::GridGeometry grid;       ///< of the whole scan as it would be read
  std::size_t bytesPerVoxel = 0; ///< as it would be read

  /// Voxels that a region of interest (CaseSources::roi) would keep.
  std::size_t voxelsIn(const core::PatientBox& box) const;
};

/// Reads a scan with every few of its slices; one that needs repair as a whole. `selector`:
/// imaging::chooseSeries. `assumeRas`: as CaseSources. Throws as buildCase does.
ScanPreview previewScan(const std::filesystem::path& path, const std::string& selector, bool repair,
                        const core::Progress& progress,
                        const std::optional<bool>& assumeRas = std::nullopt);

/// A series as its slices lie in the files, evenly and straight above each other, and as repair
/// puts them: both a slab of a few millimetres through the middle, for a picture of `orientation`,
/// which shows the stack from the side and its shear, if any.
struct RepairPreview
{
  ScanPreview before;
  ScanPreview after;
  SliceOrientation orientation = SliceOrientation::Sagittal;
  std::vector<std::string> notes; ///< what repair changes and guesses
};
RepairPreview previewRepair(const std::filesystem::path& path, const std::string& selector,
                            const core::Progress& progress);

/// Slices of an image (indices along the third axis of its grid, increasing) that repair
/// interpolated, according to its notes. Of very many only the first and last are noted; then all
/// between are returned.
std::vector<int> interpolatedSlices(const scene::ImagePart& image);

/// "slices 41-42, 60 interpolated", numbered from 1, for a picture of the image; empty: none is.
std::string interpolatedText(const scene::ImagePart& image);

/// Likewise of all images of a case, "CT: ..", a line each.
std::vector<std::string> interpolatedTexts(const scene::Case& value);

} // namespace petrous::presenters
