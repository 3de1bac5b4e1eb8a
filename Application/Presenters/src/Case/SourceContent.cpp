#include "petrous/Presenters/SourceContent.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "petrous/Imaging/DicomScan.h"
#include "petrous/Imaging/FileFormats.h"
#include "petrous/Imaging/ImageFile.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Imaging/StructureSet.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Volume/IntensityScale.h"

namespace petrous::presenters
{

namespace
{

namespace fs = std::filesystem;

constexpr double kPatches = 0.9;       // of the voxels above 0 have an equal neighbour
constexpr std::size_t kHardlyAny = 16; // values: no scanner yields so few
constexpr double kAir = -500.0;        // HU

// Whether integers from 0 to 65535 in patches, and few distinct ones.
template <class T>
bool isLabelMap(const volume::Volume<T>& image)
{
  const std::size_t count = image.size();
  std::vector<bool> seen(65536, false);
  std::size_t values = 0;
  for (std::size_t n = 0; n < count; ++n)
  {
    const T value = image.data()[n];
    if constexpr (std::is_floating_point_v<T>)
    {
      if (!(value >= T(0) && value <= T(65535)) || value != std::floor(value))
        return false;
    }
    else if constexpr (std::is_signed_v<T>)
    {
      if (value < 0)
        return false;
    }
    const auto index = static_cast<std::size_t>(value);
    if (!seen[index])
    {
      seen[index] = true;
      if (++values > kMaxLabels)
        return false;
    }
  }
  if (!seen[0] || values < 2)
    return false;
  if (values <= kHardlyAny)
    return true;

  const auto& dims = image.geometry().dims();
  const std::size_t steps[3] = {1, static_cast<std::size_t>(dims[0]),
                                static_cast<std::size_t>(dims[0]) *
                                    static_cast<std::size_t>(dims[1])};
  std::uint64_t drawn = 0;
  std::uint64_t joined = 0;
  std::size_t n = 0;
  for (int k = 0; k < dims[2]; ++k)
    for (int j = 0; j < dims[1]; ++j)
      for (int i = 0; i < dims[0]; ++i, ++n)
      {
        const T value = image.data()[n];
        if (value == T(0))
          continue;
        ++drawn;
        const int at[3] = {i, j, k};
        for (std::size_t axis = 0; axis < 3; ++axis)
          if ((at[axis] > 0 && image.data()[n - steps[axis]] == value) ||
              (at[axis] + 1 < dims[axis] && image.data()[n + steps[axis]] == value))
          {
            ++joined;
            break;
          }
      }
  return static_cast<double>(joined) >= kPatches * static_cast<double>(drawn);
}

Content contentOf(const std::string& modality)
{
  return modality == "CT" ? Content::Ct : modality == "MR" ? Content::Mr : Content::Image;
}

std::string whyOf(const std::string& modality)
{
  return modality.empty() ? "says no modality" : "says modality " + modality;
}

SourceContent lookAtDicom(const fs::path& path, const core::Progress& progress)
{
  SourceContent result;
  result.path = path;
  const auto scan = imaging::scanDicom(path, progress);
  const auto isVerdict = [](imaging::Verdict verdict)
  {
    return [verdict](const imaging::DicomSeries& series)
    { return series.geometry.verdict == verdict && series.geometry.grid; };
  };
  const bool sound =
      std::any_of(scan.series.begin(), scan.series.end(), isVerdict(imaging::Verdict::Ok));
  const auto isListed = isVerdict(sound ? imaging::Verdict::Ok : imaging::Verdict::Repairable);
  for (const imaging::DicomSeries& series : scan.series)
    if (isListed(series))
    {
      std::string repair;
      for (const imaging::Finding& finding : series.geometry.findings)
        repair += sound ? "" : (repair.empty() ? "" : " ") + finding.text;
      const imaging::SliceHeader& first = series.geometry.slices.front();
      std::string description = series.description;
      if (!series.volume.empty())
        description += (description.empty() ? "" : ", ") + series.volume;
      result.series.push_back({imaging::selectorOf(series), contentOf(series.modality),
                               series.modality, description, series.geometry.slices.size(),
                               series.geometry.grid->spacing(), first.taken, first.patientPosition,
                               first.kernel, first.file.parent_path().filename().string(), repair});
    }
  if (result.series.size() > 1)
    return result;
  // If none is readable, the reader reports why.
  const std::string modality = result.series.empty() ? imaging::chooseSeries(scan, path).modality
                                                     : result.series.front().modality;
  result.content = contentOf(modality);
  result.why = whyOf(modality);
  if (!result.series.empty())
    result.repair = result.series.front().repair;
  result.series.clear();
  return result;
}

} // namespace

Content contentOf(const volume::IntensityVolume& image)
{
  if (image.visit([](const auto& volume) { return isLabelMap(volume); }))
    return Content::Labels;
  const volume::IntensityHistogram histogram(image);
  const bool air = histogram.count() > 0 && histogram.range().min < kAir;
  return air && volume::suggestScale(histogram).calibrated ? Content::Ct : Content::Image;
}

SourceContent lookAt(const fs::path& path, const core::Progress& progress)
{
  SourceContent result;
  result.path = path;
  const imaging::FileFormat* format = fs::is_directory(path) ? nullptr : imaging::formatOf(path);
  if (format && format->reads == imaging::kMesh)
  {
    result.content = Content::Mesh;
    result.isNameless = !fileName(path).isWhole;
    result.why = "is a surface of triangles";
    return result;
  }
  if ((!format || format->reads == imaging::kDicom) && imaging::isDicomSegmentation(path))
  {
    result.content = Content::Labels;
    result.why = "is a DICOM segmentation";
    return result;
  }
  if ((!format || format->reads == imaging::kDicom) && imaging::isStructureSet(path))
  {
    result.content = Content::Labels;
    result.why = "is a DICOM RT structure set";
    return result;
  }
  if (!format || format->reads == imaging::kDicom)
    return lookAtDicom(path, progress);
  if (format->reads == imaging::kLabels)
  {
    result.content = Content::Labels;
    result.why = "is a segmentation of 3D Slicer";
    return result;
  }
  const auto image = imaging::readImageFile(path, std::nullopt, progress);
  result.content = contentOf(*image.volume);
  result.isNameless = result.content == Content::Labels && !fileName(path).isWhole &&
                      imaging::loadLabels(path, progress).isNamedAfterFile;
  result.why = result.content == Content::Labels
                   ? "has a few whole numbers in patches, as labels do"
               : result.content == Content::Ct ? "is in Hounsfield units"
                                               : "does not say whether it is a CT or an MR, and "
                                                 "its numbers are no Hounsfield units";
  return result;
}

std::string nameOf(Content content)
{
  switch (content)
  {
  case Content::Ct:
    return "CT";
  case Content::Mr:
    return "MR";
  case Content::Labels:
    return "structures";
  case Content::Mesh:
    return "mesh";
  case Content::Image:
    break;
  }
  return "image";
}

} // namespace petrous::presenters
