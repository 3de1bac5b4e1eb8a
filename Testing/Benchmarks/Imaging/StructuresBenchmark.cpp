#include "StructuresBenchmark.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gdcmSequenceOfItems.h>
#include <gdcmWriter.h>

#include "ChildProcess.h"
#include "ProcessMemory.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Imaging/DicomScan.h"
#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Imaging/StructureSet.h"

namespace petrous::imaging
{

namespace
{

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Contour = std::vector<Eigen::Vector3d>;
using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
constexpr double kFewestVoxels = 50.0;

double secondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// Written files ----------------------------------------------------------------------------------

void put(gdcm::DataSet& data, std::uint32_t tag, gdcm::VR::VRType vr, std::string value)
{
  if (value.size() % 2 != 0)
    value += vr == gdcm::VR::UI ? '\0' : ' ';
  gdcm::DataElement element(
      gdcm::Tag(static_cast<std::uint16_t>(tag >> 16), static_cast<std::uint16_t>(tag)));
  element.SetVR(vr);
  element.SetByteValue(value.data(), gdcm::VL(static_cast<std::uint32_t>(value.size())));
  data.Replace(element);
}

void put(gdcm::DataSet& data, std::uint32_t tag, const std::vector<gdcm::DataSet>& items)
{
  const gdcm::SmartPointer<gdcm::SequenceOfItems> sequence = new gdcm::SequenceOfItems;
  sequence->SetLengthToUndefined();
  for (const gdcm::DataSet& content : items)
  {
    gdcm::Item item;
    item.SetVLToUndefined();
    item.SetNestedDataSet(content);
    sequence->AddItem(item);
  }
  gdcm::DataElement element(
      gdcm::Tag(static_cast<std::uint16_t>(tag >> 16), static_cast<std::uint16_t>(tag)));
  element.SetVR(gdcm::VR::SQ);
  element.SetValue(*sequence);
  element.SetVLToUndefined();
  data.Replace(element);
}

void writeStructureSet(const fs::path& path, const StructureSet& set, const std::string& seriesUid)
{
  gdcm::Writer writer;
  gdcm::DataSet& data = writer.GetFile().GetDataSet();
  put(data, 0x00080016, gdcm::VR::UI, "1.2.840.10008.5.1.4.1.1.481.3");
  put(data, 0x00080018, gdcm::VR::UI, deterministicUid(3, "structures.instance"));
  put(data, 0x00080060, gdcm::VR::CS, "RTSTRUCT");
  put(data, 0x0020000d, gdcm::VR::UI, deterministicUid(1, "structures.study"));
  put(data, 0x0020000e, gdcm::VR::UI, deterministicUid(2, "structures.series"));
  put(data, 0x30060002, gdcm::VR::SH, "benchmark");
  gdcm::DataSet series;
  put(series, 0x0020000e, gdcm::VR::UI, seriesUid);
  gdcm::DataSet study;
  put(study, 0x30060014, {series});
  gdcm::DataSet frame;
  put(frame, 0x00200052, gdcm::VR::UI, set.frameOfReferenceUid);
  put(frame, 0x30060012, {study});
  put(data, 0x30060010, {frame});
  std::vector<gdcm::DataSet> rois;
  std::vector<gdcm::DataSet> drawn;
  for (std::size_t n = 0; n < set.rois.size(); ++n)
  {
    const std::string number = std::to_string(n + 1);
    gdcm::DataSet& roi = rois.emplace_back();
    put(roi, 0x30060022, gdcm::VR::IS, number);
    put(roi, 0x30060024, gdcm::VR::UI, set.frameOfReferenceUid);
    put(roi, 0x30060026, gdcm::VR::LO, set.rois[n].name);
    std::vector<gdcm::DataSet> contours;
    for (const Contour& contour : set.rois[n].contours)
    {
      std::string text;
      for (const Vector3d& p : contour)
        for (const double value : p)
          text += (text.empty() ? "" : "\\") + core::fixedText(value, 4);
      gdcm::DataSet& one = contours.emplace_back();
      put(one, 0x30060042, gdcm::VR::CS, "CLOSED_PLANAR");
      put(one, 0x30060046, gdcm::VR::IS, std::to_string(contour.size()));
      put(one, 0x30060050, gdcm::VR::DS, text);
    }
    gdcm::DataSet& content = drawn.emplace_back();
    put(content, 0x3006002a, gdcm::VR::IS, "255\\128\\0");
    put(content, 0x30060040, contours);
    put(content, 0x30060084, gdcm::VR::IS, number);
  }
  put(data, 0x30060020, rois);
  put(data, 0x30060039, drawn);
  writer.GetFile().GetHeader().SetDataSetTransferSyntax(
      gdcm::TransferSyntax::ExplicitVRLittleEndian);
  writer.SetFileName(path.c_str());
  if (!writer.Write())
    throw core::Error(core::Fault::Refused, path.string() + ": cannot be written");
}

Contour circle(const Vector3d& center, double radius)
{
  Contour contour;
  constexpr int kCorners = 120;
  for (int n = 0; n < kCorners; ++n)
    contour.push_back(center + radius * Vector3d(std::cos(2.0 * kPi * n / kCorners),
                                                 std::sin(2.0 * kPi * n / kCorners), 0.0));
  return contour;
}

/// Balls of 1.5 to 15 mm, a tube as wide as a nerve, and a ball with a hole through it.
StructureSet writtenSet(const core::GridGeometry& grid)
{
  StructureSet set;
  set.frameOfReferenceUid = deterministicUid(1, "structures.frame");
  const double step = grid.spacing()[2];
  const Vector3d center = grid.center();
  const auto add = [&](const std::string& name, const auto& contoursAt)
  {
    StructureSet::Roi& roi = set.rois.emplace_back();
    roi.name = name;
    for (int k = 1; k + 1 < grid.dims()[2]; ++k)
      contoursAt(roi.contours, grid.origin()[2] + k * step);
  };
  const auto ball = [&](double radius, double hole)
  {
    return [=](std::vector<Contour>& contours, double z)
    {
      const Vector3d c(center[0] + 0.13, center[1] - 0.07, z);
      const double inside = radius * radius - std::pow(z - center[2] - 0.11, 2);
      if (inside <= 0.01)
        return;
      contours.push_back(circle(c, std::sqrt(inside)));
      if (hole > 0.0 && std::sqrt(inside) > hole + 0.3)
        contours.push_back(circle(c, hole));
    };
  };
  for (const double radius : {1.5, 3.0, 6.0, 15.0})
    add("ball_" + core::generalText(radius) + "_mm", ball(radius, 0.0));
  add("ball_with_hole", ball(12.0, 4.0));
  add("tube_of_1.2_mm",
      [&](std::vector<Contour>& contours, double z)
      {
        if (std::abs(z - center[2]) < 10.0)
          contours.push_back(circle(
              {center[0] + 4.0 * std::sin(0.3 * z), center[1] + 0.2 * (z - center[2]), z}, 0.6));
      });
  return set;
}

// Truth ------------------------------------------------------------------------------------------

/// Corners in voxels, and the axis that they are planar across.
struct Planar
{
  Contour corners;
  std::size_t across = 2;
  double plane = 0.0;

  std::size_t u() const { return (across + 1) % 3; }
  std::size_t v() const { return (across + 2) % 3; }
};

double area(const Planar& contour) // shoelace
{
  double twice = 0.0;
  const Contour& p = contour.corners;
  const auto u = static_cast<Eigen::Index>(contour.u());
  const auto v = static_cast<Eigen::Index>(contour.v());
  for (std::size_t n = 0; n < p.size(); ++n)
  {
    const Vector3d& next = p[(n + 1) % p.size()];
    twice += p[n][u] * next[v] - next[u] * p[n][v];
  }
  return std::abs(0.5 * twice);
}

bool surrounds(const Planar& contour, const Vector3d& q)
{
  bool in = false;
  const Contour& p = contour.corners;
  const auto u = static_cast<Eigen::Index>(contour.u());
  const auto v = static_cast<Eigen::Index>(contour.v());
  for (std::size_t n = 0; n < p.size(); ++n)
  {
    const Vector3d& a = p[n];
    const Vector3d& b = p[(n + 1) % p.size()];
    if ((a[v] > q[v]) != (b[v] > q[v]) &&
        q[u] < a[u] + (q[v] - a[v]) / (b[v] - a[v]) * (b[u] - a[u]))
      in = !in;
  }
  return in;
}

/// Voxels that a structure's polygons enclose: areas, those in others subtracted, times the least
/// distance of two planes; without planes outside the grid. nullopt: not planar across an axis of
/// the grid, or partly beside it.
std::optional<double> voxelsByShoelace(const StructureSet::Roi& roi, const core::GridGeometry& grid)
{
  std::vector<Planar> contours;
  std::vector<double> planes;
  for (const Contour& contour : roi.contours)
  {
    Planar planar;
    for (const Vector3d& p : contour)
      planar.corners.push_back(grid.voxelFromPatient(p));
    double flattest = 1e30;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const auto axis = static_cast<Eigen::Index>(a);
      double lower = 1e30, upper = -1e30;
      for (const Vector3d& p : planar.corners)
      {
        lower = std::min(lower, p[axis]);
        upper = std::max(upper, p[axis]);
      }
      if (upper - lower < flattest)
      {
        flattest = upper - lower;
        planar.across = a;
        planar.plane = 0.5 * (lower + upper);
      }
    }
    if (flattest > 0.1 || (!contours.empty() && planar.across != contours.front().across))
      return std::nullopt;
    planes.push_back(planar.plane);
    const core::Index3& dims = grid.dims();
    if (planar.plane < -0.5 || planar.plane > dims[planar.across] - 0.5)
      continue;
    for (const std::size_t a : {planar.u(), planar.v()})
      for (const Vector3d& p : planar.corners)
        if (p[static_cast<Eigen::Index>(a)] < -0.5 ||
            p[static_cast<Eigen::Index>(a)] > dims[a] - 0.5)
          return std::nullopt;
    contours.push_back(std::move(planar));
  }
  std::sort(planes.begin(), planes.end());
  double step = 1e30;
  for (std::size_t n = 1; n < planes.size(); ++n)
    if (planes[n] - planes[n - 1] > 0.1)
      step = std::min(step, planes[n] - planes[n - 1]);
  if (step > 1e29)
    step = 1.0;
  double voxels = 0.0;
  for (const Planar& contour : contours)
  {
    bool isHole = false;
    for (const Planar& other : contours)
      if (&other != &contour && std::abs(other.plane - contour.plane) < 0.1)
        isHole ^= surrounds(other, contour.corners.front());
    voxels += (isHole ? -1.0 : 1.0) * area(contour) * step;
  }
  return voxels;
}

// Structure sets ---------------------------------------------------------------------------------

using Volumes = std::map<std::string, double>; ///< mm^3, by name

void addVolumes(const std::vector<volume::LabelMap>& maps, Volumes& volumes)
{
  for (const volume::LabelMap& map : maps)
    for (const volume::Segment& segment : map.segments)
      volumes[segment.name] = map.volume(segment);
}

/// By plastimatch, which writes a file for each structure; its time. Empty: it failed.
std::pair<Volumes, double> byPlastimatch(const fs::path& set, const fs::path& images,
                                         const fs::path& out)
{
  const auto times = registration::runProcess(
      {"plastimatch", "convert", "--input", set.string(), "--referenced-ct", images.string(),
       "--output-prefix", out.string(), "--prefix-format", "nrrd"});
  Volumes volumes;
  std::error_code none;
  if (times.status == 0)
    for (const auto& entry : fs::directory_iterator(out, none))
    {
      const volume::LabelMap labels = readLabelFile(entry.path());
      if (!labels.segments.empty())
        volumes[entry.path().stem().string()] = labels.volume(labels.segments.front());
    }
  fs::remove_all(out, none);
  return {volumes, times.seconds};
}

void measureSet(const std::string& scene, const fs::path& path, const core::GridGeometry& grid,
                const fs::path& workFolder, bool hasPeer, int rounds, core::BenchmarkReport& report)
{
  const StructureSet set = readStructureSet(path);
  std::vector<double> seconds;
  Volumes ours;
  for (int round = -1; round < rounds; ++round)
  {
    const Clock::time_point start = Clock::now();
    const LoadedLabels loaded = labelsOf(readStructureSet(path), grid, path);
    if (round >= 0)
      seconds.push_back(secondsSince(start));
    addVolumes(loaded.maps, ours);
  }
  std::pair<Volumes, double> peer;
  if (hasPeer)
    peer = byPlastimatch(path, path.parent_path(), workFolder / "plastimatch");
  for (const StructureSet::Roi& roi : set.rois)
  {
    const auto voxels = voxelsByShoelace(roi, grid);
    if (!voxels || *voxels < kFewestVoxels)
      continue;
    const double wanted = *voxels * grid.voxelVolume();
    core::BenchmarkPoint point;
    point.scene = scene;
    point.setting["structure"] = roi.name;
    point.errorUnit = "%, volume against its polygons";
    const auto add = [&](const std::string& name, double time, const Volumes& volumes)
    {
      const auto found = volumes.find(roi.name);
      if (found == volumes.end() && !name.empty())
        return; // names of files may differ
      point.peer = name;
      point.isDefault = name.empty();
      point.seconds = time;
      const double volume = found == volumes.end() ? 0.0 : found->second;
      point.error = 100.0 * std::abs(volume - wanted) / wanted;
      point.extra = {{"polygon_voxels", *voxels}, {"mm3", volume}};
      report.points.push_back(point);
    };
    add("", median(seconds), ours);
    if (hasPeer)
      add("plastimatch", peer.second, peer.first);
  }
}

// Segmentations ----------------------------------------------------------------------------------

constexpr int kSegments = 20;

/// Ellipsoids beside each other, each on as many slices.
volume::LabelMap twentySegments(int edge, int slices)
{
  const core::GridGeometry grid({edge, edge, 5 * slices}, {0.4, 0.4, 0.6}, Vector3d::Zero());
  auto voxels = volume::makeZeroVolume<std::uint16_t>(grid);
  std::vector<volume::Segment> names;
  for (int n = 0; n < kSegments; ++n)
  {
    const Vector3d center((n % 5 + 0.5) * edge / 5.0, (n / 5 + 0.5) * edge / 4.0,
                          (n % 5 + 0.5) * slices - 0.5);
    for (int k = (n % 5) * slices; k < (n % 5 + 1) * slices; ++k)
      for (int j = 0; j < edge; ++j)
        for (int i = 0; i < edge; ++i)
        {
          const Vector3d d = Vector3d(i, j, k) - center;
          if (Vector3d(d[0] / (0.09 * edge), d[1] / (0.11 * edge), d[2] / (0.5 * slices)).norm() <=
              1.0)
            voxels->at(i, j, k) = static_cast<std::uint16_t>(n + 1);
        }
    volume::Segment& segment = names.emplace_back();
    segment.name = "segment " + std::to_string(n + 1);
    segment.index = static_cast<std::uint16_t>(n + 1);
  }
  return volume::makeLabelMap(std::move(voxels), std::move(names));
}

/// What a script of pydicom and numpy does: a label grid of all frames. Prints seconds, the peak
/// memory in MB beyond the modules', and the voxels of each segment.
constexpr const char* kPydicom = R"(
import sys, time, resource
import numpy, pydicom
from pydicom.pixel_data_handlers import numpy_handler
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
times = []
for _ in range(3):
    start = time.perf_counter()
    file = pydicom.dcmread(sys.argv[1])
    frames = file.pixel_array
    places = [float(f.PlanePositionSequence[0].ImagePositionPatient[2])
              for f in file.PerFrameFunctionalGroupsSequence]
    numbers = [int(f.SegmentIdentificationSequence[0].ReferencedSegmentNumber)
               for f in file.PerFrameFunctionalGroupsSequence]
    heights = sorted(set(places))
    at = {z: k for k, z in enumerate(heights)}
    grid = numpy.zeros((len(heights), file.Rows, file.Columns), numpy.uint16)
    for frame, z, number in zip(frames, places, numbers):
        grid[at[z]][frame != 0] = number
    times.append(time.perf_counter() - start)
peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
print(sorted(times)[1], peak * 1024 / 1e6, *numpy.bincount(grid.ravel(), minlength=21)[1:])
)";

void measureSegmentation(const fs::path& workFolder, bool quick, int rounds,
                         core::BenchmarkReport& report)
{
  const int edge = quick ? 128 : 512;
  const int slices = quick ? 2 : 20; // of each segment
  const fs::path path = workFolder / "segmentation.dcm";
  const volume::LabelMap truth = twentySegments(edge, slices);
  SegmentationDescription description;
  description.description = "benchmark";
  description.studyUid = deterministicUid(4, "structures.study");
  description.seriesUid = deterministicUid(4, "structures.series");
  description.frameOfReferenceUid = deterministicUid(4, "structures.frame");
  for (const volume::Segment& segment : truth.segments)
  {
    SegmentationDescription::Segment& one = description.segments.emplace_back();
    one.index = segment.index;
    one.label = segment.name;
  }
  writeDicomSegmentation(path, {truth}, description);

  const double gridMb = static_cast<double>(truth.voxels->size()) * 2.0 / 1e6;
  std::vector<double> seconds;
  double peak = 0.0;
  double worst = 0.0;
  for (int round = -1; round < rounds; ++round)
  {
    resetPeakMemory();
    const double before = residentMb();
    const Clock::time_point start = Clock::now();
    const LoadedLabels loaded = loadLabels(path);
    const double time = secondsSince(start);
    if (round < 0) // libraries are initialised
      continue;
    seconds.push_back(time);
    peak = std::max(peak, peakMb() - before);
    Volumes volumes;
    addVolumes(loaded.maps, volumes);
    for (const volume::Segment& segment : truth.segments)
      worst = std::max(worst, 100.0 * std::abs(volumes[segment.name] - truth.volume(segment)) /
                                  truth.volume(segment));
  }
  core::BenchmarkPoint point;
  point.scene = "DICOM SEG, " + std::to_string(kSegments * slices) + " frames of " +
                std::to_string(edge) + "^2, " + std::to_string(kSegments) + " segments";
  point.isDefault = true;
  point.seconds = median(seconds);
  point.error = worst;
  point.errorUnit = "%, worst volume against what was written";
  point.extra = {{"peak_mb", peak}, {"peak_label_grids", peak / gridMb}, {"label_grid_mb", gridMb}};
  report.points.push_back(point);

  const fs::path answer = workFolder / "pydicom.txt";
  if (registration::runProcess({"/usr/bin/python3", "-c", kPydicom, path.string()}, answer)
          .status != 0)
  {
    report.machine["pydicom"] = "not installed, or it failed";
    return;
  }
  std::ifstream stream(answer);
  stream.imbue(std::locale::classic());
  double time = 0.0;
  stream >> time >> peak;
  worst = 0.0;
  for (const volume::Segment& segment : truth.segments)
  {
    double voxels = 0.0;
    stream >> voxels;
    const auto wanted = static_cast<double>(segment.voxels);
    worst = std::max(worst, 100.0 * std::abs(voxels - wanted) / wanted);
  }
  point.peer = "pydicom and numpy";
  point.isDefault = false;
  point.seconds = time;
  point.error = worst;
  point.extra = {{"peak_mb", peak}, {"peak_label_grids", peak / gridMb}, {"label_grid_mb", gridMb}};
  report.points.push_back(point);
}

} // namespace

core::BenchmarkReport runStructuresBenchmark(const fs::path& workFolder, const fs::path& data,
                                             bool quick, const core::Progress& progress)
{
  core::BenchmarkReport report;
  report.name = "structures";
  report.title = "Structures from DICOM: time, and volume against what the file encloses";
  const int rounds = quick ? 3 : 5;
  const bool hasPeer = registration::runProcess({"plastimatch", "--version"}).status == 0;
  report.machine["plastimatch"] = hasPeer ? "a process of its own" : "not installed";

  const core::GridGeometry grid(quick ? core::Index3{128, 128, 64} : core::Index3{256, 256, 128},
                                quick ? Vector3d(0.4, 0.4, 0.8) : Vector3d(0.2, 0.2, 0.4),
                                Vector3d(-20.0, 5.0, 100.0));
  const fs::path folder = workFolder / "written";
  SeriesDescription description;
  description.description = "structures";
  description.studyUid = deterministicUid(1, "structures.study");
  description.seriesUid = deterministicUid(1, "structures.images");
  description.frameOfReferenceUid = deterministicUid(1, "structures.frame");
  writeDicomSeries(folder,
                   volume::IntensityVolume(std::make_shared<volume::Volume<std::int16_t>>(grid)),
                   description);
  writeStructureSet(folder / "set.dcm", writtenSet(grid), description.seriesUid);
  measureSet("written set, " + core::generalText(grid.spacing()[0]) + " mm", folder / "set.dcm",
             grid, workFolder, hasPeer, rounds, report);
  fs::remove_all(folder);
  progress.report(0.4, "measure structures");

  std::vector<fs::path> published;
  if (!data.empty())
    for (const auto& entry : fs::recursive_directory_iterator(data))
      if (entry.is_regular_file() && entry.path().extension() == ".dcm" &&
          isStructureSet(entry.path()))
        published.push_back(entry.path());
  std::sort(published.begin(), published.end());
  for (const fs::path& path : published)
  {
    progress.check("measure structures");
    try
    {
      const ScanResult scan = scanDicom(path.parent_path(), {});
      const DicomSeries& series = chooseSeries(scan, path.parent_path());
      if (series.geometry.grid)
        measureSet("published " + path.filename().string(), path, *series.geometry.grid, workFolder,
                   hasPeer, rounds, report);
    }
    catch (const core::Error&)
    {
      continue; // without its images, or broken on purpose
    }
  }
  progress.report(0.6, "measure segmentations");
  measureSegmentation(workFolder, quick, rounds, report);
  return report;
}

} // namespace petrous::imaging
