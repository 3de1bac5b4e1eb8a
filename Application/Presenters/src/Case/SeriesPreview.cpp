#include "petrous/Presenters/SeriesPreview.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "ThinSeries.h"
#include "petrous/Imaging/DicomReader.h"
#include "petrous/Imaging/DicomScan.h"
#include "petrous/Imaging/FileFormats.h"
#include "petrous/Imaging/ImageFile.h"
#include "petrous/Imaging/ImagePreview.h"
#include "petrous/Library/DerivedCache.h"
#include "petrous/Volume/IntensityScale.h"

namespace petrous::presenters
{

namespace fs = std::filesystem;

namespace
{

constexpr std::size_t kSlices = 128; // of a preview, at most twice as many
constexpr double kSlab = 3.0;        // mm, half its thickness

ScanPreview previewOf(volume::IntensityVolume image, const core::GridGeometry& grid)
{
  ScanPreview preview;
  preview.grid = grid;
  preview.bytesPerVoxel = image.bytes() / std::max<std::size_t>(image.geometry().voxelCount(), 1);
  scene::ImagePart& ct = preview.value.ct;
  ct.geometry = image.geometry();
  ct.range = image.range();
  const auto scale = volume::suggestScale(volume::IntensityHistogram(image));
  if (!scale.calibrated)
  {
    preview.value.iso = scale.iso;
    preview.value.denseBone = scale.dense;
  }
  ct.volume = std::make_shared<const volume::IntensityVolume>(std::move(image));
  return preview;
}

imaging::DicomSeries thinnedOut(const imaging::DicomSeries& series)
{
  imaging::DicomSeries thin = thinSeries(series, kSlices);
  return thin.geometry.verdict == imaging::Verdict::Ok ? thin : series;
}

// The orientation of the picture that shows the stack's normal, and the in-plane axis along which
// its slices are shifted more.
SliceOrientation sideOf(const imaging::SeriesGeometry& geometry)
{
  const Eigen::Matrix3d& axes = geometry.grid->direction();
  const Eigen::Vector3d shift =
      axes.transpose() * (*geometry.slices.back().position - *geometry.slices.front().position);
  Eigen::Index across = 0;
  axes.col(std::abs(shift[0]) > std::abs(shift[1]) ? 1 : 0).cwiseAbs().maxCoeff(&across);
  return across == 0   ? SliceOrientation::Sagittal
         : across == 1 ? SliceOrientation::Coronal
                       : SliceOrientation::Axial;
}

core::PatientBox slabOf(const core::GridGeometry& grid, SliceOrientation orientation)
{
  core::PatientBox box = grid.patientBounds();
  const Eigen::Vector3d center = grid.center();
  const Eigen::Vector3d across = axesOf(orientation).next.cwiseAbs();
  const double half = std::max(kSlab, grid.spacing().maxCoeff());
  for (Eigen::Index a = 0; a < 3; ++a)
  {
    box.min()[a] = across[a] > 0.5 ? center[a] - half : box.min()[a] - grid.spacing().sum();
    box.max()[a] = across[a] > 0.5 ? center[a] + half : box.max()[a] + grid.spacing().sum();
  }
  return box;
}

} // namespace

imaging::DicomSeries thinSeries(const imaging::DicomSeries& series, std::size_t count)
{
  const auto& slices = series.geometry.slices;
  const std::size_t step = std::max<std::size_t>(slices.size() / count, 1);
  if (step == 1)
    return series;
  std::vector<imaging::SliceHeader> few;
  for (std::size_t n = 0; n < slices.size(); n += step)
    few.push_back(slices[n]);
  imaging::DicomSeries thin = series;
  thin.geometry = imaging::assess(std::move(few));
  return thin;
}

std::size_t ScanPreview::voxelsIn(const core::PatientBox& box) const
{
  return grid.boxCovering(box.min(), box.max()).count();
}

ScanPreview previewScan(const fs::path& path, const std::string& selector, bool repair,
                        const core::Progress& progress, const std::optional<bool>& assumeRas,
                        const std::optional<double>& unit)
{
  if (!fs::is_directory(path) && imaging::isReadAs(path, imaging::kImage | imaging::kLabels))
  {
    const auto image = imaging::previewImageFile(path, kSlices, progress, assumeRas, 0,
                                                 imaging::volumeNumber(path, selector), unit);
    return previewOf(*image.volume, image.grid);
  }
  const auto scan = imaging::scanDicom(path, progress.part(0.0, 0.3), library::scanCache().get());
  const auto& series = imaging::chooseSeries(scan, path, selector);
  imaging::ReadOptions options;
  options.repair = repair;
  options.undeclaredBits = imaging::UndeclaredBits::LeaveOut; // asked when it is read for good
  const bool isSound = series.geometry.verdict == imaging::Verdict::Ok;
  auto image =
      imaging::readSeries(isSound ? thinnedOut(series) : series, options, progress.part(0.3, 1.0));
  const core::GridGeometry grid = isSound ? *series.geometry.grid : image.geometry();
  return previewOf(std::move(image), grid);
}

RepairPreview previewRepair(const fs::path& path, const std::string& selector,
                            const core::Progress& progress)
{
  const auto scan = imaging::scanDicom(path, progress.part(0.0, 0.2), library::scanCache().get());
  const auto& series = imaging::chooseSeries(scan, path, selector);
  const core::GridGeometry& grid = *series.geometry.grid; // none that is repairable is without
  RepairPreview preview;
  preview.orientation = sideOf(series.geometry);
  imaging::ReadOptions options;
  options.roi = slabOf(grid, preview.orientation);
  options.acceptDefects = true;
  options.undeclaredBits = imaging::UndeclaredBits::LeaveOut; // asked when it is read for good
  preview.before = previewOf(imaging::readSeries(series, options, progress.part(0.2, 0.5)), grid);
  options.acceptDefects = false;
  options.repair = true;
  volume::ImageProvenance provenance;
  auto after =
      imaging::readSeries(series, options, progress.part(0.5, 1.0), &preview.notes, &provenance);
  const core::GridGeometry straight = after.geometry();
  preview.after = previewOf(std::move(after), straight);
  preview.after.value.ct.notes = preview.notes;
  preview.after.value.ct.provenance = std::move(provenance);
  // One grey window for both.
  preview.after.value.iso = preview.before.value.iso;
  preview.after.value.denseBone = preview.before.value.denseBone;
  return preview;
}

} // namespace petrous::presenters
