#include "FaceSlices.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <system_error>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcdeftag.h>
#include <dcmtk/dcmdata/dcelem.h>
#include <dcmtk/dcmdata/dcitem.h>

#include "petrous/Imaging/DicomReader.h"
#include "petrous/Imaging/DicomScan.h"

namespace petrous::library
{

namespace
{

namespace fs = std::filesystem;

fs::path key(const fs::path& file)
{
  std::error_code ignored;
  return fs::weakly_canonical(file, ignored);
}

} // namespace

FaceSlices::FaceSlices(const fs::path& path, const core::Progress& progress)
{
  imaging::ScanResult scan;
  try
  {
    scan = imaging::scanDicom(path, progress.part(0.0, 0.2));
  }
  catch (const imaging::DicomError&)
  {
    return; // what cannot be read is left out later, file by file
  }
  for (std::size_t n = 0; n < scan.series.size(); ++n)
  {
    const imaging::DicomSeries& series = scan.series[n];
    const auto count = static_cast<double>(scan.series.size());
    const core::Progress part = progress.part(0.2 + 0.8 * static_cast<double>(n) / count,
                                              0.2 + 0.8 * static_cast<double>(n + 1) / count);
    constexpr std::size_t kLeastSlices = 3;
    if ((series.modality != "CT" && series.modality != "MR") ||
        series.geometry.verdict == imaging::Verdict::Refused ||
        series.geometry.slices.size() < kLeastSlices)
      continue;
    std::shared_ptr<const volume::FaceRegion> region;
    std::string text, doubt;
    try
    {
      imaging::ReadOptions options;
      options.repair = true;
      const volume::IntensityVolume image =
          imaging::readSeries(series, options, part.part(0.0, 0.7));
      volume::FaceFinding finding = volume::findFace(
          image, volume::skinScale(image, series.modality == "MR"), false, part.part(0.7, 1.0));
      if (finding.kind == volume::FaceFinding::Kind::Doubtful)
        doubt = finding.text;
      else if (finding.canBeMasked())
        region = std::make_shared<const volume::FaceRegion>(std::move(finding.region));
      else
        text = finding.text;
    }
    catch (const imaging::DicomError&)
    {
      continue;
    }
    // A file of several volumes (phases, directions) has what was found in each of them.
    for (const imaging::SliceHeader& slice : series.geometry.slices)
    {
      File& file = m_files[key(slice.file)];
      Frame& frame = file.frames[slice.pixels.offset];
      frame.slice = slice;
      if (region)
        frame.region = region;
      if (!text.empty())
        file.texts.insert(text);
      if (!doubt.empty())
        file.doubt = doubt;
    }
  }
  // What one volume of a file shows lies in the others too, even if it was not found there.
  for (auto& [path_, file] : m_files)
  {
    const auto seen = std::find_if(file.frames.begin(), file.frames.end(),
                                   [](const auto& entry) { return entry.second.region; });
    if (seen == file.frames.end())
      continue;
    const auto region = seen->second.region;
    for (auto& [offset, frame] : file.frames)
      if (!frame.region)
        frame.region = region;
  }
}

bool FaceSlices::File::hasFace() const
{
  return std::any_of(frames.begin(), frames.end(),
                     [](const auto& entry) { return entry.second.region != nullptr; });
}

std::string unmaskable(const FaceSlices::File& file, std::size_t frames)
{
  if (!file.doubt.empty())
    return "its face cannot be masked: " + file.doubt;
  if (file.frames.size() != frames)
    return "its face cannot be masked: some of its frames are in no volume";
  return {};
}

const FaceSlices::File* FaceSlices::find(const fs::path& file) const
{
  const auto found = m_files.find(key(file));
  return found == m_files.end() ? nullptr : &found->second;
}

std::string maskFaceInPixels(DcmItem& dataSet, const FaceSlices::File& file)
{
  const imaging::PixelFormat& format = file.frames.begin()->second.slice.pixels;
  if (format.isEncapsulated)
    return "its face cannot be masked while its pixels are compressed: decompress it first";
  const auto isOdd = [](const auto& entry)
  {
    const imaging::SliceHeader& slice = entry.second.slice;
    return !slice.position || !slice.rowDirection || !slice.columnDirection ||
           !slice.pixelSpacing || slice.hasModalityLut || slice.slope == 0.0;
  };
  if (format.bitsAllocated != 16 || format.samplesPerPixel != 1 ||
      format.highBit != format.bitsStored - 1 || format.bitsStored < 2 ||
      std::any_of(file.frames.begin(), file.frames.end(), isOdd))
    return "its face cannot be masked: its pixels are of an unusual form";
  DcmElement* element = nullptr;
  Uint16* cells = nullptr;
  if (dataSet.findAndGetElement(DCM_PixelData, element).bad() || !element ||
      element->getUint16Array(cells).bad() || !cells)
    return "the pixel data do not match rows, columns and frames";
  std::size_t wanted = 0;
  for (const auto& [offset, frame] : file.frames)
    wanted +=
        static_cast<std::size_t>(frame.slice.rows) * static_cast<std::size_t>(frame.slice.columns);
  if (element->getLength() < 2 * wanted)
    return "the pixel data do not match rows, columns and frames";
  const double least = format.isSigned ? -std::ldexp(1.0, format.bitsStored - 1) : 0.0;
  const double most = std::ldexp(1.0, format.bitsStored - (format.isSigned ? 1 : 0)) - 1.0;
  Uint16* cell = cells;
  for (const auto& [offset, frame] : file.frames)
  {
    const imaging::SliceHeader& slice = frame.slice;
    const double stored = (frame.region->air - slice.intercept) / slice.slope;
    const auto air = static_cast<Uint16>(std::lround(std::clamp(stored, least, most)));
    const Eigen::Vector3d right = *slice.rowDirection * (*slice.pixelSpacing)[1];
    const Eigen::Vector3d down = *slice.columnDirection * (*slice.pixelSpacing)[0];
    for (int row = 0; row < slice.rows; ++row)
      for (int column = 0; column < slice.columns; ++column, ++cell)
        if (frame.region->covers(*slice.position + down * row + right * column))
          *cell = air;
  }
  return {};
}

} // namespace petrous::library
