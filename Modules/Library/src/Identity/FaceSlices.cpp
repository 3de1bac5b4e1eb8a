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
    File found;
    try
    {
      imaging::ReadOptions options;
      options.repair = true;
      const volume::IntensityVolume image =
          imaging::readSeries(series, options, part.part(0.0, 0.7));
      volume::FaceFinding finding = volume::findFace(
          image, volume::skinScale(image, series.modality == "MR"), false, part.part(0.7, 1.0));
      found.text = finding.text;
      if (finding.kind == volume::FaceFinding::Kind::Face)
        found.region = std::make_shared<const volume::FaceRegion>(std::move(finding.region));
    }
    catch (const imaging::DicomError&)
    {
      continue;
    }
    for (const imaging::SliceHeader& slice : series.geometry.slices)
    {
      File& file = m_files.emplace(key(slice.file), found).first->second;
      file.frames.push_back(slice);
    }
  }
  for (auto& [path_, file] : m_files)
    std::sort(file.frames.begin(), file.frames.end(),
              [](const imaging::SliceHeader& a, const imaging::SliceHeader& b)
              { return a.pixels.offset < b.pixels.offset; });
}

const FaceSlices::File* FaceSlices::find(const fs::path& file) const
{
  const auto found = m_files.find(key(file));
  return found == m_files.end() ? nullptr : &found->second;
}

std::string maskFaceInPixels(DcmItem& dataSet, const FaceSlices::File& file)
{
  const imaging::PixelFormat& format = file.frames.front().pixels;
  if (format.isEncapsulated)
    return "its face cannot be masked while its pixels are compressed: decompress it first";
  Sint32 frames = 1;
  if (dataSet.findAndGetSint32(DCM_NumberOfFrames, frames).bad() || frames < 1)
    frames = 1;
  if (file.frames.size() != static_cast<std::size_t>(frames))
    return "its face cannot be masked: some of its frames are in no volume";
  const auto isOdd = [&](const imaging::SliceHeader& slice)
  {
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
  for (const imaging::SliceHeader& slice : file.frames)
    wanted += static_cast<std::size_t>(slice.rows) * static_cast<std::size_t>(slice.columns);
  if (element->getLength() < 2 * wanted)
    return "the pixel data do not match rows, columns and frames";
  const double least = format.isSigned ? -std::ldexp(1.0, format.bitsStored - 1) : 0.0;
  const double most = std::ldexp(1.0, format.bitsStored - (format.isSigned ? 1 : 0)) - 1.0;
  Uint16* cell = cells;
  for (const imaging::SliceHeader& slice : file.frames)
  {
    const double stored = (file.region->air - slice.intercept) / slice.slope;
    const auto air = static_cast<Uint16>(std::lround(std::clamp(stored, least, most)));
    const Eigen::Vector3d right = *slice.rowDirection * (*slice.pixelSpacing)[1];
    const Eigen::Vector3d down = *slice.columnDirection * (*slice.pixelSpacing)[0];
    for (int row = 0; row < slice.rows; ++row)
      for (int column = 0; column < slice.columns; ++column, ++cell)
        if (file.region->covers(*slice.position + down * row + right * column))
          *cell = air;
  }
  return {};
}

} // namespace petrous::library
