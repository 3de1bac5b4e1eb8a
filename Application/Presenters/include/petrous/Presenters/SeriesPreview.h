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
/// imaging::chooseSeries. `assumeRas`, `unit`: as CaseSources. Throws as buildCase does.
ScanPreview previewScan(const std::filesystem::path& path, const std::string& selector, bool repair,
                        const core::Progress& progress,
                        const std::optional<bool>& assumeRas = std::nullopt,
                        const std::optional<double>& unit = std::nullopt);

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

} // namespace petrous::presenters
