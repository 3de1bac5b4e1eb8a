#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/PatientBox.h"
#include "petrous/Core/Progress.h"
#include "petrous/Imaging/DicomScan.h"
#include "petrous/Volume/ImageProvenance.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::imaging
{

/// DicomError of the reason BitsUnclear. The message says what each way gives.
struct BitsUnclearError : DicomError
{
  BitsUnclearError(const std::string& message, bool canBeKept)
    : DicomError(Reason::BitsUnclear, message)
    , canKeep(canBeKept)
  {
  }
  bool canKeep; ///< UndeclaredBits::Keep is possible; LeaveOut always is
};

struct ReadOptions
{
  /// Only slices that intersect the box are read, and only the box is stored. The grid is the
  /// smallest whose hull covers it.
  std::optional<core::PatientBox> roi;

  /// Reads a series whose verdict is Repairable too, resampled to a straight, even grid by the
  /// slices' positions: gantry tilt, uneven spacing, single missing slices, duplicates, a rescale
  /// of each slice's own. What was changed and guessed is in `notes`.
  bool repair = false;

  /// Reads the series even if the verdict is not Ok: slice k of the volume is geometry.slices[k],
  /// placed on geometry.grid. For repair code that knows the true slice positions; never for
  /// display.
  bool acceptDefects = false;

  /// Refuse: throws BitsUnclearError, which says what each of the others gives. Keep throws it
  /// where the bits cannot be kept.
  UndeclaredBits undeclaredBits = UndeclaredBits::Refuse;

  /// Bytes that the voxels may take while they are read; 0: what the machine has left.
  std::uint64_t memory = 0;
};

/// Decodes a series in parallel, each slice directly into the volume.
///
/// Values are slope * stored + intercept per slice: int16 if they fit, else uint16, else float.
/// PixelPaddingValue becomes the volume's padding (in rescaled units) if it does not exceed any
/// real value; padding that would be mistaken for tissue is replaced by the smallest real value (at
/// most -1024 for CT) and reported in `notes`.
///
/// provenance  what repair guessed and moved, and what the headers state of the pixels
///
/// Throws DicomError (Misleading, Unreadable, Unsupported, OutsideRoi, TooLarge), BitsUnclearError
/// and CancelledError.
volume::IntensityVolume readSeries(const DicomSeries& series, const ReadOptions& options,
                                   const core::Progress& progress,
                                   std::vector<std::string>* notes = nullptr,
                                   volume::ImageProvenance* provenance = nullptr);

/// Whether the memory that is free may hold a series, without a region and repair: at 16 bits a
/// voxel, the least that readSeries takes. `memory`: bytes; 0: what is free.
bool mayFitMemory(const DicomSeries& series, std::uint64_t memory = 0);

/// False for a DICOM file whose data set is deflated (PS3.5 A.5) and damaged, or larger than 256 MB
/// when it is inflated: a few kilobytes can stand for more than there is memory, so other readers
/// are to be given no such file. True for what is not deflated.
bool canBeInflated(const std::filesystem::path& file);

} // namespace petrous::imaging
