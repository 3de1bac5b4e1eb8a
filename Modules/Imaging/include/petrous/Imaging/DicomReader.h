#pragma once

#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/PatientBox.h"
#include "petrous/Core/Progress.h"
#include "petrous/Imaging/DicomScan.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::imaging
{

struct ReadOptions
{
  /// Only slices that meet the box are read and only the
  /// box is stored. The grid is the smallest whose hull covers it.
  std::optional<core::PatientBox> roi;

  /// Read although the verdict is not ok: slice k of the volume is geometry.slices[k], laid on
  /// geometry.grid. For a repair, which knows where the slices really are; never for showing.
  bool acceptDefects = false;
};

/// Decodes a series in parallel, each slice straight into its place in the volume.
///
/// Values are slope * stored + intercept, slice by slice: int16 where the values fit it, else
/// uint16, else float. PixelPaddingValue becomes the volume's padding (in rescaled units) where
/// it does not exceed any real value; a padding that would pass for tissue is replaced by the
/// smallest real value (at most -1024 in CT), and `notes` says so.
///
/// Throws DicomError (Misleading, Unreadable, Unsupported, OutsideRoi) and CancelledError.
volume::IntensityVolume readSeries(const DicomSeries& series, const ReadOptions& options,
                                   const core::Progress& progress,
                                   std::vector<std::string>* notes = nullptr);

} // namespace petrous::imaging
