#include "petrous/Imaging/ImageFile.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "FileHelpers.h"
#include "MemoryCheck.h"
#include "VoxelSource.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/SystemMemory.h"
#include "petrous/Imaging/ImagePreview.h"

namespace petrous::imaging
{

namespace
{

using Voxels = volume::IntensityVolume::Voxels;

template <class Out, class In>
Voxels converted(const core::GridGeometry& geometry, const In* in)
{
  auto volume = std::make_shared<volume::Volume<Out>>(geometry);
  std::transform(in, in + volume->size(), volume->data(),
                 [](In value) { return static_cast<Out>(value); });
  return std::shared_ptr<const volume::Volume<Out>>(std::move(volume));
}

template <class T>
Voxels adopted(const core::GridGeometry& geometry, const std::shared_ptr<void>& raw)
{
  return std::make_shared<const volume::Volume<T>>(
      geometry, std::shared_ptr<T>(raw, static_cast<T*>(raw.get())));
}

/// Minimum and maximum value, and whether all values are integral.
struct Contents
{
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
  bool whole = true;
};

template <class T>
Contents contentsOf(const T* in, std::size_t count)
{
  Contents contents;
  for (std::size_t v = 0; v < count; ++v)
  {
    const auto value = static_cast<double>(in[v]);
    contents.min = std::min(contents.min, value);
    contents.max = std::max(contents.max, value);
    if constexpr (std::is_floating_point_v<T>)
      contents.whole = contents.whole && std::isfinite(value) && value == std::floor(value);
  }
  return contents;
}

template <class Out>
bool fits(const Contents& contents)
{
  return contents.whole && contents.min >= std::numeric_limits<Out>::lowest() &&
         contents.max <= std::numeric_limits<Out>::max();
}

template <class T>
double roundingOf(const T* in, std::size_t count)
{
  double worst = 0.0;
  for (std::size_t v = 0; v < count; ++v)
  {
    const auto value = static_cast<double>(in[v]);
    worst = std::max(worst, std::abs(value - static_cast<double>(static_cast<float>(in[v]))));
  }
  return worst;
}

/// `rounding`: by how much values that the file states exactly were rounded to float.
template <class T>
Voxels keepOrNarrow(const core::GridGeometry& geometry, const std::shared_ptr<void>& raw,
                    bool rescaled, double& rounding)
{
  const auto* in = static_cast<const T*>(raw.get());
  constexpr bool kKept = std::is_same_v<T, std::int16_t> || std::is_same_v<T, std::uint16_t>;
  if constexpr (kKept)
    return adopted<T>(geometry, raw);
  else if constexpr (sizeof(T) == 1)
    return converted<std::int16_t>(geometry, in);
  else
  {
    if constexpr (std::is_same_v<T, float>)
      if (!rescaled)
        return adopted<float>(geometry, raw);
    const Contents contents = contentsOf(in, geometry.voxelCount());
    if (fits<std::int16_t>(contents))
      return converted<std::int16_t>(geometry, in);
    if (fits<std::uint16_t>(contents))
      return converted<std::uint16_t>(geometry, in);
    if constexpr (std::is_same_v<T, float>)
      return adopted<float>(geometry, raw);
    else
    {
      if (!rescaled)
        rounding = roundingOf(in, geometry.voxelCount());
      return converted<float>(geometry, in);
    }
  }
}

/// A non-finite value would propagate to every sample, picture and force near it.
void requireFinite(const std::filesystem::path& path, const Voxels& voxels)
{
  const auto* volume = std::get_if<std::shared_ptr<const volume::Volume<float>>>(&voxels);
  if (!volume)
    return;
  const float* data = (*volume)->data();
  const auto count = std::count_if(data, data + (*volume)->size(),
                                   [](float value) { return !std::isfinite(value); });
  if (count > 0)
    fail(FileError::Reason::Unsupported, path,
         "holds " + std::to_string(count) +
             " voxels that are not finite numbers (NaN, infinite or beyond float); give them the "
             "value of what lies outside the scanned field, such as -1024 in a CT");
}

core::IndexBox boxOf(const std::filesystem::path& path, const core::GridGeometry& geometry,
                     const std::optional<core::PatientBox>& roi)
{
  if (!roi)
    return geometry.fullBox();
  const core::IndexBox box = geometry.boxCovering(roi->min(), roi->max());
  const core::Index3 size = box.size();
  if (*std::min_element(size.begin(), size.end()) >= 2)
    return box;
  const auto bounds = geometry.patientBounds();
  std::string range;
  for (int a = 0; a < 3; ++a)
    range += (a ? ", " : "") + roughText(bounds.min()[a]) + " to " + roughText(bounds.max()[a]);
  fail(FileError::Reason::Unsupported, path,
       "lies outside the region of interest, or that is thinner than a voxel; the image spans (x, "
       "y, z in LPS mm) " +
           range);
}

/// The space in which the file counts: as it states it, unless the user did.
void settle(VoxelSource& source, const std::optional<double>& unit,
            const std::optional<bool>& isRas)
{
  if (unit)
    source.settleUnit(unit, {});
  source.takeFileUnit();
  if (isRas)
    source.settleSide(isRas, {});
}

/// `volume`: as readImageFile.
void requireImage(const std::filesystem::path& path, VoxelSource& source, std::size_t volume)
{
  if (volume > 0)
    source.select(volume);
  source.requireOneVolume(true);
  if (source.components() > 1)
    fail(FileError::Reason::Unsupported, path,
         "holds " + std::to_string(source.components()) +
             " numbers a voxel (vectors or colours); an image of one number a voxel is needed");
  const auto& dims = source.geometry().dims();
  if (*std::min_element(dims.begin(), dims.end()) < 2)
    fail(FileError::Reason::Unsupported, path,
         "is a single slice; a volume of at least 2 voxels along each axis is needed");
}

} // namespace

LoadedImage readImageFile(const std::filesystem::path& path,
                          const std::optional<core::PatientBox>& roi,
                          const core::Progress& progress, const std::optional<bool>& isRas,
                          std::size_t volume, const std::optional<double>& unit)
{
  progress.report(0.0, "reading image");
  VoxelSource source(path);
  settle(source, unit, isRas);
  requireImage(path, source, volume);
  const core::IndexBox box = boxOf(path, source.geometry(), roi);
  const core::GridGeometry geometry = source.geometry().cropped(box);
  auto raw = source.read(box, progress.part(0.0, 0.8));
  double rounding = 0.0;
  Voxels voxels = visitComponent(
      source.component(), [&](auto type)
      { return keepOrNarrow<decltype(type)>(geometry, raw, source.rescaled(), rounding); });
  raw.reset();
  requireFinite(path, voxels);

  LoadedImage image;
  image.notes = source.notes();
  if (rounding > 0.0)
    image.notes.push_back("Values were rounded to 32-bit floating point, by up to " +
                          core::plainText(rounding, 3) + ".");
  image.assumedRas = source.assumedRas();
  image.isHounsfield = source.isHounsfield();
  image.volume =
      std::make_shared<const volume::IntensityVolume>(std::move(voxels), source.padding());
  progress.report(1.0, "reading image");
  return image;
}

ImagePreview previewImageFile(const std::filesystem::path& path, std::size_t slices,
                              const core::Progress& progress, const std::optional<bool>& isRas,
                              std::uint64_t memory, std::size_t volume,
                              const std::optional<double>& unit)
{
  VoxelSource source(path);
  settle(source, unit, isRas);
  requireImage(path, source, volume);
  const core::GridGeometry& grid = source.geometry();
  core::Index3 dims = grid.dims();
  const int step = std::max(dims[2] / static_cast<int>(std::max<std::size_t>(slices, 2)), 1);
  const core::Index3 whole = dims;
  dims[2] = (whole[2] + step - 1) / step;
  const std::size_t voxelBytes =
      visitComponent(source.component(), [](auto type) { return sizeof type; });
  const auto needed = [&]
  {
    return static_cast<std::uint64_t>(dims[0]) * static_cast<std::uint64_t>(dims[1]) *
           static_cast<std::uint64_t>(dims[2]) *
           (voxelBytes + sizeof(float)); // as read, and at most as converted
  };
  const std::uint64_t free = memory > 0 ? memory : core::systemMemory().available;
  int plane = 1; // with a slice in decoding, and what else runs
  while (needed() > free / 2 && free > 0 && std::min(whole[0], whole[1]) / (plane + 1) >= 2)
  {
    ++plane;
    dims[0] = (whole[0] + plane - 1) / plane;
    dims[1] = (whole[1] + plane - 1) / plane;
  }
  requireMemory(path, needed(), "give a smaller file", free);
  const core::GridGeometry few(dims,
                               grid.spacing().cwiseProduct(Eigen::Vector3d(plane, plane, step)),
                               grid.origin(), grid.direction());
  const std::size_t kept =
      static_cast<std::size_t>(dims[0]) * static_cast<std::size_t>(dims[1]) * voxelBytes;
  const auto buffer = std::make_shared<std::vector<char>>(kept * static_cast<std::size_t>(dims[2]));
  source.forEachSlice(
      [&](int k, const void* values)
      {
        const char* from = static_cast<const char*>(values);
        char* to = buffer->data() + kept * static_cast<std::size_t>(k / step);
        if (plane == 1)
          std::memcpy(to, from, kept);
        else
          for (int j = 0; j < whole[1]; j += plane)
            for (int i = 0; i < whole[0]; i += plane, to += voxelBytes)
              std::memcpy(to,
                          from + voxelBytes * (static_cast<std::size_t>(j) *
                                                   static_cast<std::size_t>(whole[0]) +
                                               static_cast<std::size_t>(i)),
                          voxelBytes);
        progress.report(static_cast<double>(k) / whole[2], "reading image");
        return true;
      },
      progress, step);
  const std::shared_ptr<void> raw(buffer, buffer->data());
  double rounding = 0.0;
  Voxels voxels = visitComponent(
      source.component(), [&](auto type)
      { return keepOrNarrow<decltype(type)>(few, raw, source.rescaled(), rounding); });
  requireFinite(path, voxels);
  return {std::make_shared<const volume::IntensityVolume>(std::move(voxels), source.padding()),
          grid};
}

std::optional<double> likelyUnit(const UnitDoubt& doubt)
{
  return doubt.likely.empty() ? std::nullopt : std::optional(doubt.likely.front());
}

ImageHeader readImageHeader(const std::filesystem::path& path,
                            const std::optional<std::size_t>& volume)
{
  VoxelSource source(path);
  if (volume)
    requireImage(path, source, *volume);
  return {source.geometry(), source.components(), source.volumes(), source.assumedRas(),
          source.unitDoubt()};
}

std::size_t volumeNumber(const std::filesystem::path& path, const std::string& selector)
{
  const std::string text = selector.substr(selector.find('#') + 1); // all of it without one
  if (text.empty())
    return 0;
  const auto number = parseInteger(text);
  if (!number || *number < 1)
  {
    const std::size_t volumes = VoxelSource(path).volumes();
    fail(FileError::Reason::Unsupported, path,
         "is a file of voxels, whose volumes are told by number; " +
             (volumes == 1 ? std::string("it holds one, so name none")
                           : "name one of 1 to " + std::to_string(volumes)));
  }
  return static_cast<std::size_t>(*number);
}

std::optional<bool> assumedRasOf(const std::filesystem::path& path)
{
  return VoxelSource(path).assumedRas();
}

UnitDoubt unitDoubtOf(const std::filesystem::path& path)
{
  return VoxelSource(path).unitDoubt();
}

} // namespace petrous::imaging
