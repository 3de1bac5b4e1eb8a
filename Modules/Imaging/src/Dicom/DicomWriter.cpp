#include "petrous/Imaging/DicomWriter.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include <gdcmAttribute.h>
#include <gdcmFile.h>
#include <gdcmMediaStorage.h>
#include <gdcmWriter.h>

#include "DicomDataSet.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/SplitMix64.h"

namespace petrous::imaging
{
namespace
{

using Modality = SeriesDescription::Modality;

std::string imageType(const SeriesDescription& series)
{
  return std::string(series.derived ? "DERIVED\\SECONDARY" : "ORIGINAL\\PRIMARY") +
         (series.modality == Modality::Ct ? "\\AXIAL" : "\\OTHER");
}

/// The attributes common to all slices of a series.
gdcm::DataSet commonPart(const SeriesDescription& series, const core::GridGeometry& grid,
                         bool isSigned, bool isRescaled)
{
  const bool ct = series.modality == Modality::Ct;
  const Eigen::Matrix3d& axes = grid.direction();
  gdcm::DataSet d;
  // study, series, acquisition, content, instance creation
  const std::pair<std::uint16_t, std::uint16_t> dated[] = {
      {0x0020, 0x0030}, {0x0021, 0x0031}, {0x0022, 0x0032}, {0x0023, 0x0033}, {0x0012, 0x0013}};
  for (const auto& [date, time] : dated)
    put(d, {{0x0008, date, "DA", series.derived ? "" : "20200101"},
            {0x0008, time, "TM", series.derived ? "" : "120000"}});
  if (series.derived) // instance creation may not be empty
  {
    d.Remove(gdcm::Tag(0x0008, 0x0012));
    d.Remove(gdcm::Tag(0x0008, 0x0013));
  }
  putIdentification(d, series);
  put(d, {{0x0008, 0x1030, "LO", series.derived ? "" : "Phantom temporal bone"},
          {0x0008, 0x0060, "CS", ct ? "CT" : "MR"},
          {0x0008, 0x103E, "LO", series.description},
          {0x0018, 0x0015, "CS", "SKULL"},
          {0x0018, 0x5100, "CS", series.derived ? "" : "HFS"},
          {0x0008, 0x1090, "LO", series.derived ? "" : "Phantom"},
          // image
          {0x0008, 0x0008, "CS", imageType(series)},
          {0x0020, 0x0012, "IS", "1"},
          {0x0020, 0x0037, "DS",
           decimals({axes(0, 0), axes(1, 0), axes(2, 0), axes(0, 1), axes(1, 1), axes(2, 1)})},
          {0x0028, 0x0030, "DS", decimals({grid.spacing()[1], grid.spacing()[0]})},
          {0x0018, 0x0050, "DS", decimal(grid.spacing()[2])},
          {0x0028, 0x1050, "DS", decimal(series.windowCenter)},
          {0x0028, 0x1051, "DS", decimal(series.windowWidth)}});
  putPixelFormat(d, grid, 16, isSigned);
  if (series.faults.burnedIn != BurnedInText::None)
    put(d, 0x0028, 0x0301, "CS", "YES");
  else if (series.derived)
    putDeidentified(d);
  if (series.derived) // names of a case
    put(d, 0x0008, 0x0005, "CS", "ISO_IR 192");
  if (series.faults.isLossy) // stays for ever (PS3.3 C.7.6.1.1.5)
    put(d, 0x0028, 0x2110, "CS", "01");
  if (series.faults.isLossy && series.faults.lossyRatio)
    put(d, 0x0028, 0x2112, "DS", decimal(*series.faults.lossyRatio));
  if (!series.derivation.empty())
    put(d, 0x0008, 0x2111, "ST", series.derivation);
  if (isRescaled)
    put(d, {{0x0028, 0x1052, "DS", decimal(series.rescaleIntercept)},
            {0x0028, 0x1053, "DS", decimal(series.rescaleSlope)},
            {0x0028, 0x1054, "LO", ct ? series.rescaleType : "US"}});
  if (ct)
    put(d, {{0x0018, 0x0060, "DS", series.derived ? "" : "120"}});
  if (ct && !series.derived)
    put(d, 0x0018, 0x1210, "SH", "BONE");
  if (!ct)
    put(d, {{0x0018, 0x0020, "CS", series.derived ? "RM" : "SE"},
            {0x0018, 0x0021, "CS", series.derived ? "NONE" : "SK"},
            {0x0018, 0x0022, "CS", ""},
            {0x0018, 0x0023, "CS", series.derived ? "" : "3D"},
            {0x0018, 0x0080, "DS", series.derived ? "" : "2000"},
            {0x0018, 0x0081, "DS", series.derived ? "" : "250"},
            {0x0018, 0x0091, "IS", series.derived ? "" : "100"},
            {0x0018, 0x0088, "DS", decimal(grid.spacing()[2])}});
  return d;
}

/// What stands for `value` in a file.
double storedOf(double value, double slope, double intercept)
{
  return std::round((value - intercept) / slope);
}

constexpr double kMostStored = 65535.0; // of float voxels

/// Whether float voxels are kept within half a step, or exactly where nothing is rescaled.
void requireKept(const volume::Volume<float>& image, double slope, double intercept)
{
  const double most = slope == 1.0 && intercept == 0.0 ? 0.0 : 0.5 * slope * (1.0 + 1e-6);
  const float* values = image.data();
  for (std::size_t v = 0; v < image.size(); ++v)
  {
    const double value = static_cast<double>(values[v]);
    const double stored = std::clamp(storedOf(value, slope, intercept), 0.0, kMostStored);
    if (!(std::abs(slope * stored + intercept - value) <=
          most + 1e-9 * std::max(std::abs(value), std::abs(intercept))))
      throw core::InvalidParameter(
          "DICOM series: float voxels do not fit 16 bits with this rescale");
  }
}

/// What voxels are stored as.
template <class T>
using Stored = std::conditional_t<std::is_floating_point_v<T>, std::uint16_t, T>;

template <class T>
std::vector<char> storedValues(const volume::Volume<T>& image, int k, double slope,
                               double intercept)
{
  const core::Index3& dims = image.geometry().dims();
  const std::size_t count = static_cast<std::size_t>(dims[0]) * static_cast<std::size_t>(dims[1]);
  using S = Stored<T>;
  const T* values = image.data() + image.geometry().linearIndex(0, 0, k);
  std::vector<char> bytes(2 * count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const double stored = storedOf(static_cast<double>(values[i]), slope, intercept);
    const auto bits = static_cast<std::uint16_t>(
        static_cast<S>(std::clamp(stored, static_cast<double>(std::numeric_limits<S>::lowest()),
                                  static_cast<double>(std::numeric_limits<S>::max()))));
    bytes[2 * i] = static_cast<char>(bits & 0xFF);
    bytes[2 * i + 1] = static_cast<char>(bits >> 8);
  }
  return bytes;
}

} // namespace

std::string deterministicUid(std::uint64_t seed, const std::string& role)
{
  std::uint64_t low = core::splitMix64(seed ^ 0x706574726F7573ULL);
  for (const char c : role)
    low = core::splitMix64(low ^ static_cast<unsigned char>(c));
  const std::uint64_t high = core::splitMix64(low);
  // version 8 (free use) and variant bits of a UUID, written as one decimal integer
  std::array<std::uint32_t, 4> words{static_cast<std::uint32_t>(high >> 32),
                                     (static_cast<std::uint32_t>(high) & 0xFFFF0FFFU) | 0x00008000U,
                                     (static_cast<std::uint32_t>(low >> 32) & 0x3FFFFFFFU) |
                                         0x80000000U,
                                     static_cast<std::uint32_t>(low)};
  std::string digits;
  while (words[0] != 0 || words[1] != 0 || words[2] != 0 || words[3] != 0)
  {
    std::uint64_t rest = 0;
    for (std::uint32_t& word : words)
    {
      const std::uint64_t part = (rest << 32) | word;
      word = static_cast<std::uint32_t>(part / 10);
      rest = part % 10;
    }
    digits.insert(digits.begin(), static_cast<char>('0' + rest));
  }
  return "2.25." + digits;
}

std::optional<StoredFractions> storedFractions(const volume::Volume<float>& image)
{
  constexpr int kFinest = 16; // 2^-16
  const float* begin = image.data();
  const float* end = begin + image.size();
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  int binary = 0; // places after the point that all voxels need
  for (const float* v = begin; v != end; ++v)
  {
    if (!std::isfinite(*v))
      return std::nullopt;
    low = std::min(low, static_cast<double>(*v));
    high = std::max(high, static_cast<double>(*v));
    while (binary <= kFinest && std::ldexp(*v, binary) != std::nearbyint(std::ldexp(*v, binary)))
      ++binary;
  }
  StoredFractions result;
  const auto asWritten = [](double value) // as the file's decimal string holds it
  { return core::parseDouble(decimal(value)).value_or(value); };
  const bool isBinary = binary <= kFinest && std::ldexp(high - low, binary) <= kMostStored;
  result.slope = isBinary ? std::ldexp(1.0, -binary) : (high - low) / kMostStored;
  result.slope = result.slope > 0.0 ? asWritten(result.slope) : 1.0;
  result.intercept = asWritten(low);
  if (!(result.slope > 0.0))
    return std::nullopt;
  for (const float* v = begin; v != end; ++v)
  {
    const double value = static_cast<double>(*v);
    const double stored =
        std::clamp(storedOf(value, result.slope, result.intercept), 0.0, kMostStored);
    result.error =
        std::max(result.error, std::abs(result.slope * stored + result.intercept - value));
  }
  return result;
}

std::string instanceUid(const std::string& seriesUid, int k)
{
  return deterministicUid(0, seriesUid + "/" + std::to_string(k));
}

void writeDicomSeries(const std::filesystem::path& folder, const volume::IntensityVolume& image,
                      const SeriesDescription& description,
                      const std::optional<Eigen::Vector3d>& sliceStep,
                      const core::Progress& progress)
{
  checkUid(description.studyUid, "study's UID");
  checkUid(description.seriesUid, "series' UID");
  checkUid(description.frameOfReferenceUid, "frame of reference's UID");
  if (!(description.rescaleSlope > 0.0))
    throw core::InvalidParameter("DICOM series: the rescale slope must be above 0");
  const bool ct = description.modality == Modality::Ct;
  const bool isFloat =
      std::holds_alternative<std::shared_ptr<const volume::Volume<float>>>(image.voxels());
  if (!ct && !isFloat && (description.rescaleSlope != 1.0 || description.rescaleIntercept != 0.0))
    throw core::InvalidParameter("DICOM series: an MR image has no rescale");
  const core::GridGeometry& grid = image.geometry();
  if (grid.dims()[0] > 65535 || grid.dims()[1] > 65535)
    throw core::InvalidParameter("DICOM series: a slice holds at most 65535 voxels a side");

  std::error_code fault;
  std::filesystem::create_directories(folder, fault);
  if (fault)
    throw core::Error(core::Fault::Refused,
                      folder.string() + ": cannot be made: " + fault.message());

  image.visit(
      [&](const auto& voxels)
      {
        using T = typename std::decay_t<decltype(voxels)>::Value;
        {
          using S = Stored<T>;
          if constexpr (std::is_floating_point_v<T>)
            requireKept(voxels, description.rescaleSlope, description.rescaleIntercept);
          const gdcm::MediaStorage storage(ct ? gdcm::MediaStorage::CTImageStorage
                                              : gdcm::MediaStorage::MRImageStorage);
          const Eigen::Vector3d step =
              sliceStep.value_or(grid.spacing()[2] * grid.direction().col(2));
          const int slices = grid.dims()[2];
          // What no voxel has need not fit.
          const auto isPadding = [&image](T value)
          { return static_cast<double>(value) == *image.padding(); };
          const auto padding =
              image.padding() &&
                      std::any_of(voxels.data(), voxels.data() + voxels.size(), isPadding)
                  ? image.padding()
                  : std::nullopt;
          std::atomic<int> done{0};
          const auto writeSlice = [&](int k)
          {
            progress.report(static_cast<double>(done.fetch_add(1)) / slices,
                            "writing DICOM slices");
            gdcm::Writer writer;
            gdcm::DataSet& data = writer.GetFile().GetDataSet();
            // GDCM's reference counts are not thread-safe, so slices share no values
            data = commonPart(description, grid, std::is_signed_v<S>, ct || isFloat);
            if (padding)
            {
              const double stored =
                  storedOf(*padding, description.rescaleSlope, description.rescaleIntercept);
              if (!(stored >= static_cast<double>(std::numeric_limits<S>::lowest()) &&
                    stored <= static_cast<double>(std::numeric_limits<S>::max())))
                throw core::InvalidParameter(
                    "DICOM series: the padding value " + core::plainText(*padding) +
                    " does not fit its 16 bits with this rescale; choose another");
              put(data, 0x0028, 0x0120, static_cast<std::uint16_t>(static_cast<S>(stored)),
                  std::is_signed_v<S> ? "SS" : "US");
            }
            if (volume::contains(description.interpolated, k))
            {
              put(data, 0x0008, 0x0008, "CS", imageType(description) + "\\" + kInterpolatedType);
              put(data, 0x0008, 0x2111, "ST",
                  "This slice was interpolated between its neighbours, nothing was measured in "
                  "it. " +
                      description.derivation);
            }
            if (ct && sliceStep)
            {
              const double lean =
                  std::acos(std::clamp(step.normalized().dot(grid.direction().col(2)), -1.0, 1.0));
              put(data, 0x0018, 0x1120, "DS", decimal(lean * 180.0 / 3.14159265358979323846));
            }
            const Eigen::Vector3d position = grid.origin() + k * step;
            put(data, {{0x0008, 0x0016, "UI", storage.GetString()},
                       {0x0008, 0x0018, "UI", instanceUid(description.seriesUid, k)},
                       {0x0020, 0x0013, "IS", std::to_string(k + 1)},
                       {0x0020, 0x0032, "DS", decimals({position.x(), position.y(), position.z()})},
                       {0x0020, 0x1041, "DS", decimal(position.z())}});
            putBytes(
                data, 0x7FE0, 0x0010, "OW",
                storedValues(voxels, k, description.rescaleSlope, description.rescaleIntercept));

            std::array<char, 32> name{};
            std::snprintf(name.data(), name.size(), "slice-%04d.dcm", k + 1);
            const std::filesystem::path file = folder / name.data();
            const std::string content = encoded(writer, file);
            std::ofstream stream(file, std::ios::binary | std::ios::trunc);
            stream.write(content.data(), static_cast<std::streamsize>(content.size()));
            stream.close();
            if (!stream)
              throw core::Error(core::Fault::Refused,
                                file.string() + ": cannot be written; is the disk full?");
          };
          writeSlice(0); // GDCM's dictionaries are initialized on first use, so single-threaded
          tbb::parallel_for(1, slices, writeSlice);
        }
      });
}

} // namespace petrous::imaging
