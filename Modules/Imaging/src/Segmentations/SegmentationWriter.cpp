#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/LU>
#include <gdcmDataSet.h>
#include <gdcmFile.h>
#include <gdcmMediaStorage.h>
#include <gdcmWriter.h>

#include "DicomDataSet.h"
#include "OutputFile.h"
#include "SegmentationReader.h"
#include "petrous/Core/Error.h"
#include "petrous/Imaging/DicomWriter.h"

namespace petrous::imaging
{
namespace
{

using gdcm::DataSet;
using Algorithm = SegmentationDescription::Algorithm;
using Modality = SeriesDescription::Modality;

struct Frame
{
  std::size_t segment;
  int slice;
};

void putShorts(DataSet& data, std::uint16_t group, std::uint16_t element, const char* vr,
               const std::vector<std::uint16_t>& values)
{
  std::vector<char> bytes;
  for (const std::uint16_t value : values)
  {
    bytes.push_back(static_cast<char>(value & 0xFF));
    bytes.push_back(static_cast<char>(value >> 8));
  }
  putBytes(data, group, element, vr, bytes);
}

constexpr int kLongestText = 1024; // characters of a short text (ST)

/// A long string (LO): without the backslash, which separates values, or control characters, and
/// cut at a whole character.
std::string longString(const std::string& text, int longest = kLongestName)
{
  std::string result;
  int characters = 0;
  for (const char c : text)
  {
    const bool begins = (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    if (begins && ++characters > longest)
      break;
    result += c == '\\' ? '/' : static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return result;
}

/// A code of more than 16 characters is a Long Code Value.
DataSet code(const CodedConcept& concept)
{
  constexpr std::size_t kLongestShort = 16;
  DataSet d;
  if (concept.value.size() <= kLongestShort)
    put(d, 0x0008, 0x0100, "SH", longString(concept.value));
  put(d, 0x0008, 0x0102, "SH", longString(concept.scheme).substr(0, kLongestShort));
  put(d, 0x0008, 0x0104, "LO", longString(concept.meaning));
  if (concept.value.size() > kLongestShort)
    put(d, 0x0008, 0x0119, "UC", longString(concept.value));
  return d;
}

DataSet segmentItem(const SegmentationDescription::Segment& segment, std::size_t number)
{
  static constexpr std::array<const char*, 3> kAlgorithms{"MANUAL", "SEMIAUTOMATIC", "AUTOMATIC"};
  if (segment.label.empty())
    throw core::InvalidParameter("DICOM segmentation: segment " + std::to_string(number) +
                                 " has no name");
  if (segment.algorithm != Algorithm::Manual && segment.algorithmName.empty())
    throw core::InvalidParameter("DICOM segmentation: the algorithm of segment " +
                                 std::to_string(number) + " has no name");
  DataSet d;
  put(d, 0x0062, 0x0004, static_cast<std::uint16_t>(number));
  put(d, {{0x0062, 0x0005, "LO", longString(segment.label)},
          {0x0062, 0x0008, "CS", kAlgorithms[static_cast<std::size_t>(segment.algorithm)]}});
  // A label holds no more: SegmentationReader takes the whole name from the description.
  if (const std::string whole = longString(segment.label, kLongestText);
      whole != longString(segment.label))
    put(d, 0x0062, 0x0006, "ST", whole);
  if (segment.algorithm != Algorithm::Manual)
    put(d, 0x0062, 0x0009, "LO", longString(segment.algorithmName));
  const std::array<std::uint16_t, 3> lab = cieLabFromColor(segment.color);
  putShorts(d, 0x0062, 0x000D, "US", {lab.begin(), lab.end()});
  putSequence(d, 0x0062, 0x0003, {code(segment.category)});
  DataSet type = code(segment.type);
  if (!segment.typeModifier.empty())
    putSequence(type, 0x0062, 0x0011, {code(segment.typeModifier)});
  putSequence(d, 0x0062, 0x000F, {type});
  if (!segment.region.empty())
  {
    DataSet region = code(segment.region);
    if (!segment.regionModifier.empty())
      putSequence(region, 0x0008, 0x2220, {code(segment.regionModifier)});
    putSequence(d, 0x0008, 0x2218, {region});
  }
  return d;
}

DataSet instance(const std::string& sopClass, const std::string& uid)
{
  DataSet d;
  put(d, {{0x0008, 0x1150, "UI", sopClass}, {0x0008, 0x1155, "UI", uid}});
  return d;
}

std::string sourceClass(const SegmentationDescription::Source& source)
{
  return gdcm::MediaStorage(source.modality == Modality::Ct ? gdcm::MediaStorage::CTImageStorage
                                                            : gdcm::MediaStorage::MRImageStorage)
      .GetString();
}

/// What all frames have in common.
DataSet sharedGroups(const core::GridGeometry& grid)
{
  const Eigen::Matrix3d& axes = grid.direction();
  DataSet orientation, measures, d;
  put(orientation, 0x0020, 0x0037, "DS",
      decimals({axes(0, 0), axes(1, 0), axes(2, 0), axes(0, 1), axes(1, 1), axes(2, 1)}));
  put(measures, {{0x0018, 0x0050, "DS", decimal(grid.spacing()[2])},
                 {0x0018, 0x0088, "DS", decimal(grid.spacing()[2])},
                 {0x0028, 0x0030, "DS", decimals({grid.spacing()[1], grid.spacing()[0]})}});
  putSequence(d, 0x0020, 0x9116, {orientation});
  putSequence(d, 0x0028, 0x9110, {measures});
  return d;
}

DataSet frameGroups(const Frame& frame, const core::GridGeometry& grid,
                    const SegmentationDescription& description)
{
  DataSet content, position, segment, d;
  const std::array<std::uint16_t, 2> index{static_cast<std::uint16_t>(frame.segment + 1),
                                           static_cast<std::uint16_t>(frame.slice + 1)};
  putShorts(content, 0x0020, 0x9157, "UL", {index[0], 0, index[1], 0}); // 32 bits each
  const Eigen::Vector3d at =
      grid.origin() + frame.slice * grid.spacing()[2] * grid.direction().col(2);
  put(position, 0x0020, 0x0032, "DS", decimals({at.x(), at.y(), at.z()}));
  put(segment, 0x0062, 0x000B, index[0]);
  if (description.source && description.source->onSlices)
  {
    DataSet image = instance(sourceClass(*description.source),
                             instanceUid(description.source->seriesUid, frame.slice));
    putSequence(image, 0x0040, 0xA170,
                {code({"121322", "DCM", "Source image for image processing operation"})});
    put(image, 0x0028, 0x135A, "CS", "YES");
    DataSet derivation;
    putSequence(derivation, 0x0008, 0x2112, {image});
    putSequence(derivation, 0x0008, 0x9215, {code({"113076", "DCM", "Segmentation"})});
    putSequence(d, 0x0008, 0x9124, {derivation});
  }
  putSequence(d, 0x0020, 0x9111, {content});
  putSequence(d, 0x0020, 0x9113, {position});
  putSequence(d, 0x0062, 0x000A, {segment});
  return d;
}

/// Frames are ordered by segment, then by position.
void putDimensions(DataSet& d, const std::string& uid)
{
  DataSet organization;
  put(organization, 0x0020, 0x9164, "UI", uid);
  putSequence(d, 0x0020, 0x9221, {organization});
  const auto dimension = [&uid](std::uint16_t group, std::uint16_t element, std::uint16_t inGroup,
                                std::uint16_t inElement, const char* label)
  {
    DataSet item;
    put(item, 0x0020, 0x9164, "UI", uid);
    putShorts(item, 0x0020, 0x9165, "AT", {group, element});
    putShorts(item, 0x0020, 0x9167, "AT", {inGroup, inElement});
    put(item, 0x0020, 0x9421, "LO", label);
    return item;
  };
  putSequence(d, 0x0020, 0x9222,
              {dimension(0x0062, 0x000B, 0x0062, 0x000A, "Segment"),
               dimension(0x0020, 0x0032, 0x0020, 0x9113, "Position")});
}

void putHeader(DataSet& d, const SegmentationDescription& description,
               const core::GridGeometry& grid, std::size_t frames)
{
  const std::string instanceOf = instanceUid(description.seriesUid, 0);
  putIdentification(d, description);
  putDeidentified(d);
  put(d, {{0x0008, 0x0005, "CS", "ISO_IR 192"},
          {0x0008, 0x0008, "CS", "DERIVED\\PRIMARY"},
          {0x0008, 0x0016, "UI",
           gdcm::MediaStorage(gdcm::MediaStorage::SegmentationStorage).GetString()},
          {0x0008, 0x0018, "UI", instanceOf},
          {0x0008, 0x0020, "DA", ""},
          {0x0008, 0x0023, "DA", "19000101"},
          {0x0008, 0x0030, "TM", ""},
          {0x0008, 0x0033, "TM", "000000"},
          {0x0008, 0x0060, "CS", "SEG"},
          {0x0008, 0x1030, "LO", ""},
          {0x0008, 0x103E, "LO", longString(description.description)},
          {0x0008, 0x1090, "LO", "Petrous"},
          {0x0018, 0x1000, "LO", "0"},
          {0x0020, 0x0013, "IS", "1"},
          {0x0028, 0x0008, "IS", std::to_string(frames)},
          {0x0028, 0x2110, "CS", "00"},
          {0x0062, 0x0001, "CS", "BINARY"},
          {0x0070, 0x0080, "CS", "SEGMENTATION"},
          {0x0070, 0x0081, "LO", ""},
          {0x0070, 0x0084, "PN", ""}});
  putPixelFormat(d, grid, 1, false);
  putDimensions(d, deterministicUid(0, description.seriesUid + "/dimensions"));
  if (const auto& source = description.source)
  {
    DataSet series;
    std::vector<DataSet> instances;
    for (int k = 0; k < source->slices; ++k)
      instances.push_back(instance(sourceClass(*source), instanceUid(source->seriesUid, k)));
    putSequence(series, 0x0008, 0x114A, instances);
    put(series, 0x0020, 0x000E, "UI", source->seriesUid);
    putSequence(d, 0x0008, 0x1115, {series});
  }
  std::vector<DataSet> segments;
  for (const auto& segment : description.segments)
    segments.push_back(segmentItem(segment, segments.size() + 1));
  putSequence(d, 0x0062, 0x0002, segments);
}

/// The slices in which each segment has voxels, in one pass over each map.
std::vector<Frame> framesOf(const std::vector<volume::LabelMap>& maps,
                            const SegmentationDescription& description,
                            const core::Progress& progress)
{
  std::vector<Frame> frames;
  for (std::size_t map = 0; map < maps.size(); ++map)
  {
    std::vector<std::vector<std::size_t>> segmentsOf(65536);
    for (std::size_t s = 0; s < description.segments.size(); ++s)
      if (description.segments[s].map == map)
        segmentsOf[description.segments[s].index].push_back(s);
    const auto& voxels = *maps[map].voxels;
    const core::Index3& n = voxels.geometry().dims();
    std::vector<int> lastSlice(65536, -1);
    for (int k = 0; k < n[2]; ++k)
    {
      progress.report((static_cast<double>(map) + static_cast<double>(k) / n[2]) /
                          static_cast<double>(maps.size()),
                      "writing segments");
      for (int j = 0; j < n[1]; ++j)
        volume::forEachLabel(&voxels.at(0, j, k), n[0],
                             [&](int, std::uint16_t label)
                             {
                               if (std::exchange(lastSlice[label], k) != k)
                                 for (const std::size_t s : segmentsOf[label])
                                   frames.push_back({s, k});
                             });
    }
  }
  std::sort(frames.begin(), frames.end(),
            [](const Frame& a, const Frame& b)
            { return std::pair(a.segment, a.slice) < std::pair(b.segment, b.slice); });
  return frames;
}

/// One bit a pixel, the least significant bit of a byte first; frames begin within a byte.
std::vector<char> pixelsOf(const std::vector<Frame>& frames,
                           const std::vector<volume::LabelMap>& maps,
                           const SegmentationDescription& description,
                           const core::Progress& progress)
{
  const core::Index3& n = maps.front().voxels->geometry().dims();
  const std::size_t count = static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]);
  const std::size_t bytes = (count * frames.size() + 7) / 8;
  if (bytes > std::numeric_limits<std::uint32_t>::max() - 2)
    throw core::InvalidParameter(
        "DICOM segmentation: its frames need more than 4 GB; export fewer structures at a time");
  std::vector<char> pixels(bytes + bytes % 2, '\0');
  for (std::size_t f = 0; f < frames.size(); ++f)
  {
    progress.report(static_cast<double>(f) / static_cast<double>(frames.size()),
                    "writing segments");
    const auto& segment = description.segments[frames[f].segment];
    const std::uint16_t* slice = &maps[segment.map].voxels->at(0, 0, frames[f].slice);
    for (int j = 0; j < n[1]; ++j) // a slice may have more pixels than an int counts
    {
      const std::size_t row = static_cast<std::size_t>(j) * static_cast<std::size_t>(n[0]);
      volume::forEachLabel(slice + row, n[0],
                           [&](int i, std::uint16_t label)
                           {
                             if (label != segment.index)
                               return;
                             const std::size_t bit = f * count + row + static_cast<std::size_t>(i);
                             pixels[bit / 8] = static_cast<char>(
                                 static_cast<unsigned char>(pixels[bit / 8]) | (1U << bit % 8));
                           });
    }
  }
  return pixels;
}

} // namespace

void writeDicomSegmentation(const std::filesystem::path& path,
                            const std::vector<volume::LabelMap>& maps,
                            const SegmentationDescription& description,
                            const core::Progress& progress)
{
  checkUid(description.studyUid, "study's UID");
  checkUid(description.seriesUid, "series' UID");
  checkUid(description.frameOfReferenceUid, "frame of reference's UID");
  if (description.source)
    checkUid(description.source->seriesUid, "source series' UID");
  if (maps.empty() || description.segments.empty() || description.segments.size() > 65535)
    throw core::InvalidParameter("DICOM segmentation: it has no segments, or more than 65535");
  for (const auto& map : maps)
    if (!map.voxels || !core::sameGrid(map.voxels->geometry(), maps.front().voxels->geometry()))
      throw core::InvalidParameter("DICOM segmentation: its label maps lie on different grids");
  const core::GridGeometry& grid = maps.front().voxels->geometry();
  if (grid.dims()[0] > 65535 || grid.dims()[1] > 65535 || grid.dims()[2] > 65535)
    throw core::InvalidParameter("DICOM segmentation: a grid holds at most 65535 voxels a side");
  if (description.source && description.source->onSlices &&
      description.source->slices != grid.dims()[2])
    throw core::InvalidParameter("DICOM segmentation: its source has other slices");
  for (const auto& segment : description.segments)
    if (segment.map >= maps.size() || segment.index == 0)
      throw core::InvalidParameter("DICOM segmentation: a segment is of no label map");

  const std::vector<Frame> frames = framesOf(maps, description, progress.part(0.0, 0.4));
  if (frames.empty())
    throw core::InvalidParameter("DICOM segmentation: no segment has a voxel");
  gdcm::Writer writer;
  DataSet& data = writer.GetFile().GetDataSet();
  putHeader(data, description, grid, frames.size());
  putSequence(data, 0x5200, 0x9229, {sharedGroups(grid)});
  std::vector<DataSet> groups;
  groups.reserve(frames.size());
  for (const Frame& frame : frames)
    groups.push_back(frameGroups(frame, grid, description));
  putSequence(data, 0x5200, 0x9230, groups);
  putBytes(data, 0x7FE0, 0x0010, "OB",
           pixelsOf(frames, maps, description, progress.part(0.4, 0.5)));
  OutputFile file(path);
  file.write(encoded(writer, path));
  progress.check("writing segments");
  file.commit();
}

} // namespace petrous::imaging
