#include "petrous/Presenters/CaseExport.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include <tbb/parallel_for.h>

#include "BoxOnGrid.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Imaging/FileFormats.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Imaging/VolumeFile.h"
#include "petrous/Library/LibraryFiles.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Presenters/CaseDicom.h"
#include "petrous/Presenters/CaseTransfer.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/LeavingImages.h"
#include "petrous/Presenters/MrOnCt.h"
#include "petrous/Rendering/SurfaceExtraction.h"
#include "petrous/Scene/CaseField.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Volume/MeshDecimation.h"
#include "petrous/Volume/MeshMeasure.h"
#include "petrous/Volume/Rounded.h"

namespace petrous::presenters
{

namespace
{

using Warn = std::function<void(const std::string&)>;

// What stands where tissue was removed.
double airOf(const scene::Case& value)
{
  constexpr double kAirHu = -1000.0;
  return displayOf(value).hounsfield ? kAirHu : value.ct.range.min;
}

// Whether the target is a folder, for a DICOM series.
bool isSeries(const ExportOptions& options)
{
  std::error_code ignored;
  return !options.out.empty() &&
         (options.out.back() == '/' || std::filesystem::is_directory(options.out, ignored)) &&
         (options.what == "ct" || options.what == "mr" || options.what == "dissected");
}

// The file for the names of labels in a format without names.
std::optional<std::string> labelTable(const ExportOptions& options)
{
  const imaging::FileFormat* format = imaging::formatOf(options.out);
  if (options.what != "labels" || !format || format->name != "NIfTI")
    return std::nullopt;
  const std::filesystem::path path(options.out);
  return (path.parent_path() / (imaging::baseName(path) + ".label")).string();
}

// Whether the target is a DICOM segmentation.
bool isSegmentation(const ExportOptions& options)
{
  const imaging::FileFormat* format = imaging::formatOf(options.out);
  return options.what == "labels" && format && (format->writes & imaging::kSegmentation) != 0;
}

// The CT after removal: untouched voxels keep their value, removed ones are air, and in between the
// value is capped so that the surface at `iso` is the cut surface of f.
template <class T>
volume::Volume<T> dissected(const volume::Volume<T>& ct, const volume::CutMask& mask, double iso,
                            double air)
{
  volume::Volume<T> result(ct.geometry());
  const core::Index3 n = ct.geometry().dims();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
      {
        const std::uint16_t left = mask.at(i, j, k);
        T value = ct.at(i, j, k);
        if (left != volume::CutMask::kUntouched)
        {
          const double share = static_cast<double>(left) / volume::CutMask::kUntouched;
          const double cap = iso + (share - 0.5) * 2.0 * (iso - air);
          if (cap < static_cast<double>(value))
            value = volume::rounded<T>(cap);
        }
        result.at(i, j, k) = value;
      }
  return result;
}

const scene::ImagePart& chooseMr(const scene::Case& value, const std::string& name)
{
  if (value.mr.empty())
    throw core::InvalidParameter("case '" + value.name + "' has no MR");
  if (name.empty() && value.mr.size() == 1)
    return value.mr.front();
  std::string there;
  for (const auto& mr : value.mr)
  {
    if (mr.name == name)
      return mr;
    there += (there.empty() ? "" : ", ") + mr.name;
  }
  throw ExportChoiceError("export mr: give --part NAME; there are: " + there);
}

// The nearest voxel of the labels, for each voxel of the CT.
volume::LabelMap onGrid(const volume::LabelMap& labels, const core::GridGeometry& ct,
                        const core::Progress& progress)
{
  const volume::Volume<std::uint16_t>& source = *labels.voxels;
  auto result = volume::makeZeroVolume<std::uint16_t>(ct);
  const core::GridGeometry& grid = source.geometry();
  const core::Index3& m = grid.dims();
  const core::Index3& n = ct.dims();
  std::atomic<int> done{0};
  tbb::parallel_for(0, n[2],
                    [&](int k)
                    {
                      progress.report(static_cast<double>(done.fetch_add(1)) / n[2], "resampling");
                      for (int j = 0; j < n[1]; ++j)
                        for (int i = 0; i < n[0]; ++i)
                        {
                          const Eigen::Vector3d at =
                              grid.voxelFromPatient(ct.patientFromVoxel(Eigen::Vector3d(i, j, k)));
                          const Eigen::Array3d nearest = at.array().round();
                          if ((nearest >= 0.0).all() && nearest[0] < m[0] && nearest[1] < m[1] &&
                              nearest[2] < m[2])
                            result->at(i, j, k) = source.at(static_cast<int>(nearest[0]),
                                                            static_cast<int>(nearest[1]),
                                                            static_cast<int>(nearest[2]));
                        }
                    });
  return volume::makeLabelMap(std::move(result), labels.segments);
}

// "'cochlea' lies on the CT".
std::string spaceText(const PlacedLabels& labels)
{
  return "'" + labels.structures.front()->name + "' lies on " +
         (labels.drawnOn.empty() ? "the CT"
                                 : "the MR '" + labels.drawnOn + "', which is elsewhere");
}

// "'cochlea' has voxels of 0.3 x 0.3 x 0.6 mm from (12, 3.5, -8) mm on".
std::string gridText(const PlacedLabels& labels)
{
  const core::GridGeometry& grid = labels.map->voxels->geometry();
  const auto three = [](const Eigen::Vector3d& v, const char* between)
  {
    return core::plainText(v.x(), 5) + between + core::plainText(v.y(), 5) + between +
           core::plainText(v.z(), 5);
  };
  return "'" + labels.structures.front()->name + "' has voxels of " + three(grid.spacing(), " x ") +
         " mm from (" + three(grid.origin(), ", ") + ") on";
}

// Structures of which the CT's grid would not take all. Returns their names.
std::set<std::string> warnOfWhatIsBeyond(const Warn& warn, const PlacedLabels& labels,
                                         const core::GridGeometry& ct)
{
  std::set<std::string> names;
  const core::GridGeometry& grid = labels.map->voxels->geometry();
  const auto boxes = volume::boxesOf(*labels.map);
  for (const auto* structure : labels.structures)
    for (std::size_t n = 0; n < boxes.size(); ++n)
    {
      if (labels.map->segments[n].index != structure->index || boxes[n].empty())
        continue;
      if (!isWithin(ct, grid, boxes[n]) && names.insert(structure->name).second)
        warn("'" + structure->name + "' reaches beyond the CT; what is outside is not written");
    }
  return names;
}

// What the CT's grid made of the structures: warns where more than a hundredth is gone or added.
// `beyond`: of warnOfWhatIsBeyond.
void compareVolumes(const Warn& warn, const PlacedLabels& labels, const volume::LabelMap& own,
                    const std::set<std::string>& beyond,
                    std::vector<ExportSummary::Resampled>& resampled)
{
  constexpr double kNoted = 0.01; // share of the volume
  const auto volumeOf = [](const volume::LabelMap& map, std::uint16_t index)
  {
    double volume = 0.0;
    for (const volume::Segment& segment : map.segments)
      volume += segment.index == index ? map.volume(segment) : 0.0;
    return volume;
  };
  for (const auto* structure : labels.structures)
  {
    const double before = volumeOf(own, structure->index);
    const double after = volumeOf(*labels.map, structure->index);
    resampled.push_back({structure->name, before, after});
    if (std::abs(after - before) <= kNoted * before)
      continue;
    const std::string change = core::plainText(before, 3) + " mm3";
    warn("'" + structure->name + "' " +
         (after == 0.0
              ? "has no voxel on the CT's grid, of " + change
              : "has " + core::plainText(after, 3) + " mm3 on the CT's grid, of " + change) +
         (beyond.count(structure->name) > 0
              ? ": the rest lies outside of it; without --on-ct it is written whole"
              : ": its voxels are finer than the CT's; without --on-ct it keeps its own"));
  }
}

// The label maps with structures that are asked for (all, or the one named), all on one grid in one
// space.
std::vector<PlacedLabels> placedLabels(const Warn& warn, const scene::Case& value,
                                       const ExportOptions& options, const LeftOut& leftOut,
                                       ExportSummary& summary, const core::Progress& progress)
{
  const std::string& only = options.part;
  const auto isLeftOut = [&](const scene::LabelPart& labels)
  {
    return std::any_of(leftOut.labels.begin(), leftOut.labels.end(),
                       [&](const auto& part) { return &value.labels[part.index] == &labels; });
  };
  std::vector<PlacedLabels> placed;
  for (const auto& part : value.labels)
  {
    PlacedLabels labels;
    for (const auto& structure : part.structures)
      if (only.empty() || structure.name == only)
        labels.structures.push_back(&structure);
    if (labels.structures.empty())
      continue;
    if (isLeftOut(part))
    {
      if (!only.empty())
        throw core::InvalidParameter("export labels: '" + only +
                                     "' is missing or damaged, and nothing else is asked for");
      continue;
    }
    if (const std::string guessed = guessedNote(part); !guessed.empty())
      warn(guessed);
    const std::string& name = labels.structures.front()->name;
    labels.map = scene::labelsOnCt(value, part);
    if (!labels.map)
    {
      if (options.onCt)
        throw core::InvalidParameter("export labels: '" + name + "' " +
                                     scene::missingPlace(value, name));
      for (const auto* structure : labels.structures)
        warn("'" + structure->name + "' is written where its MR has it, not on the CT: " +
             scene::missingPlace(value, structure->name));
      labels.map = part.labels.get();
      labels.drawnOn = scene::placementOf(value, part).drawnOn;
    }
    if (options.onCt && !core::sameGrid(labels.map->voxels->geometry(), value.ct.geometry))
    {
      const std::set<std::string> beyond = warnOfWhatIsBeyond(warn, labels, value.ct.geometry);
      const std::shared_ptr<const volume::LabelMap> own = labels.map;
      labels.map =
          std::make_shared<const volume::LabelMap>(onGrid(*own, value.ct.geometry, progress));
      compareVolumes(warn, labels, *own, beyond, summary.resampled);
    }
    if (!placed.empty() && labels.drawnOn != placed.front().drawnOn)
      throw ExportChoiceError("export labels: " + spaceText(labels) + ", and " +
                              spaceText(placed.front()) +
                              "; register the MR first, or export it alone with --part");
    placed.push_back(std::move(labels));
  }
  if (placed.empty())
    throw core::InvalidParameter("case '" + value.name + "' has no " +
                                 (only.empty() ? "structures" : "structure '" + only + "'"));
  const std::string& drawnOn = placed.front().drawnOn;
  const core::GridGeometry& image =
      drawnOn.empty() ? value.ct.geometry : chooseMr(value, drawnOn).geometry;
  if (const auto other = padToOneGrid(placed, image, progress))
    throw ExportGridError(
        "export labels: " + gridText(placed[*other]) + ", and " + gridText(placed.front()) +
        ": no one grid holds both without resampling; export it alone with --part, or all on the " +
        primaryName(value) + "'s grid with --on-ct");
  return placed;
}

// All structures, numbered in order, in layers within which none overlaps another; with
// `inOneLayer` in a single one, in which the earlier structure keeps the voxel, and a warning.
std::vector<volume::LabelMap> layersOf(const Warn& warn, const std::vector<PlacedLabels>& placed,
                                       bool inOneLayer, const core::Progress& progress)
{
  struct Layer
  {
    std::shared_ptr<volume::Volume<std::uint16_t>> voxels;
    std::vector<volume::Segment> segments;
  };
  std::vector<Layer> layers;
  std::uint16_t index = 0;
  std::size_t all = 0;
  for (const PlacedLabels& labels : placed)
    all += labels.structures.size();
  for (const PlacedLabels& labels : placed)
  {
    const auto boxes = volume::boxesOf(*labels.map);
    for (const auto* structure : labels.structures)
    {
      progress.report(static_cast<double>(index) / static_cast<double>(all), "writing structures");
      const volume::Volume<std::uint16_t>& source = *labels.map->voxels;
      core::IndexBox box;
      for (std::size_t n = 0; n < boxes.size(); ++n)
        if (labels.map->segments[n].index == structure->index)
          box = boxes[n];
      // Calls visit(place) for each voxel of the structure.
      const auto forEachVoxel = [&](const auto& visit)
      {
        for (int k = box.lower[2]; k < box.upper[2]; ++k)
          for (int j = box.lower[1]; j < box.upper[1]; ++j)
          {
            const std::size_t row = static_cast<std::size_t>(&source.at(0, j, k) - source.data());
            for (int i = box.lower[0]; i < box.upper[0]; ++i)
              if (const std::size_t p = row + static_cast<std::size_t>(i);
                  source.data()[p] == structure->index)
                visit(p);
          }
      };
      const auto overlap = [&](const Layer& layer)
      {
        std::size_t count = 0;
        forEachVoxel([&](std::size_t p) { count += layer.voxels->data()[p] != 0 ? 1 : 0; });
        return count;
      };
      auto layer = layers.begin();
      if (inOneLayer && layer != layers.end())
      {
        if (const std::size_t lost = overlap(*layer); lost > 0)
          warn("'" + structure->name + "': " + std::to_string(lost) +
               " voxels are not written, as structures before it have them; .seg.nrrd "
               "and .dcm keep structures that overlap");
      }
      else
        layer = std::find_if(layers.begin(), layers.end(),
                             [&](const Layer& each) { return overlap(each) == 0; });
      if (layer == layers.end())
        layer = layers.insert(layers.end(),
                              {volume::makeZeroVolume<std::uint16_t>(source.geometry()), {}});
      ++index;
      std::uint16_t* voxels = layer->voxels->data();
      forEachVoxel(
          [&](std::size_t p)
          {
            if (voxels[p] == 0)
              voxels[p] = index;
          });
      volume::Segment segment;
      segment.name = structure->name;
      segment.index = index;
      segment.color = structure->look.color;
      layer->segments.push_back(std::move(segment));
    }
  }
  std::vector<volume::LabelMap> maps;
  for (Layer& layer : layers)
    maps.push_back(volume::makeLabelMap(std::move(layer.voxels), std::move(layer.segments)));
  return maps;
}

template <class T>
std::shared_ptr<const volume::IntensityVolume> shared(volume::Volume<T> voxels,
                                                      std::optional<double> padding)
{
  return std::make_shared<const volume::IntensityVolume>(
      std::make_shared<const volume::Volume<T>>(std::move(voxels)), padding);
}

// A DICOM series, whole or not at all.
void writeSeries(const Warn& warn, const library::Library& library, const ExportOptions& options,
                 const scene::Case& value, const scene::ImagePart& part,
                 const volume::IntensityVolume& image, const std::string& drawnOn,
                 const core::Progress& progress)
{
  core::OutputFolder folder(options.out);
  if (const auto error = writeCaseSeries(folder.path(), value, options.what, part, image, drawnOn,
                                         options.onCt, dicomOptionsOf(value, library), progress);
      error && *error > 0.0)
    warn(roundingNote("the image", *error));
  progress.check("writing DICOM slices");
  folder.commit();
}

// One structure as a surface, with its colour: of its voxels on the CT, or the mesh that it is.
std::pair<core::TriangleMesh, std::array<float, 3>>
structureMesh(const Warn& warn, const scene::Case& value, const std::string& name,
              const core::Progress& progress, ExportSummary& summary)
{
  for (const auto& part : value.labels)
    for (const auto& structure : part.structures)
      if (structure.name == name)
      {
        const auto placed = scene::labelsOnCt(value, part);
        if (!placed)
          warn("'" + name + "' is written where its MR has it, not on the CT: " +
               scene::missingPlace(value, name));
        const volume::LabelMap& map = *(placed ? placed : part.labels.get());
        summary.voxelsVolume = structure.volume;
        return {rendering::extractLabel(*map.voxels, structure.index, progress),
                structure.look.color};
      }
  for (const auto& part : value.meshes)
    if (part.name == name)
    {
      const auto placed = scene::meshOnCt(value, part);
      if (!placed)
        warn("'" + name + "' is written where its MR has it, not on the CT: " +
             scene::missingPlace(value, name));
      return {volume::oriented(*(placed ? placed : part.mesh.get())), part.look.color};
    }
  throw core::InvalidParameter("case '" + value.name + "' has no structure '" + name + "'");
}

} // namespace

unsigned exportContent(const std::string& what)
{
  if (what == "labels")
    return imaging::kLabels | imaging::kSegmentation;
  if (what == "surface" || what == "structure")
    return imaging::kMesh;
  return imaging::kImage;
}

std::string coordinatesOf(const ExportOptions& options)
{
  const imaging::FileFormat* format = isSeries(options) ? nullptr : imaging::formatOf(options.out);
  return coordinatesOf(imaging::MeshSpace{format && format->name == "NIfTI", 1.0});
}

std::vector<std::string> exportedFiles(const ExportOptions& options)
{
  if (!isSeries(options))
    imaging::writingFormat(options.out, exportContent(options.what));
  if (options.onCt && options.what != "mr" && options.what != "labels")
    throw ExportChoiceError("--on-ct is for --what mr and labels");
  if (options.triangles && options.what != "surface" && options.what != "structure")
    throw ExportChoiceError("--triangles is for --what surface and structure");
  if (options.mask.any() && options.what != "ct" && options.what != "mr" &&
      options.what != "dissected" && options.what != "surface")
    throw ExportChoiceError("--mask-face and --roi are for --what ct, mr, dissected and surface");
  if (options.what == "structure" && options.part.empty())
    throw ExportChoiceError("export structure: give --part NAME");
  std::vector<std::string> files{options.out};
  if (const auto table = labelTable(options))
    files.push_back(*table);
  return files;
}

ExportSummary exportCase(const library::Library& library, scene::Case& value,
                         const ExportOptions& options, const LeftOut& leftOut,
                         const std::function<void(const std::string&)>& warn,
                         const core::Progress& progress)
{
  for (const std::string& file : exportedFiles(options))
    library::refuseOverwriting(file, library.folder());
  for (const std::string& warning :
       identityWarnings(value, options, &library)) // before anything is written
    warn(warning);
  if (options.mask.any())
  {
    library.loadDissection(value);
    scene::ImageMask mask = options.mask;
    mask.images.emplace({options.what == "mr" ? chooseMr(value, options.part).name : ""});
    for (const std::string& note : maskLeavingImages(library, value, mask, progress.part(0.0, 0.1)))
      warn(note);
  }
  ExportSummary summary;
  if (isSegmentation(options) || isSeries(options))
    summary.patient = CaseIdentifiers(value).patient(library);
  // Voxels mapped for the file must be what was stored.
  const auto checked = [&](const scene::ImagePart& image)
  {
    auto volume = image.volume.get();
    library.checkVoxels(value, progress);
    return volume;
  };
  const auto mask = [&]() -> const volume::CutMask&
  {
    library.loadDissection(value);
    return value.dissection.mask();
  };
  const auto warnOfGuesses = [&](const scene::ImagePart& part)
  {
    if (const std::string guessed = guessedNote(part); !guessed.empty())
      warn(guessed);
  };
  const auto writeImage = [&](const scene::ImagePart& part, const volume::IntensityVolume& image,
                              const std::string& drawnOn)
  {
    warnOfGuesses(part);
    if (isSeries(options))
    {
      writeSeries(warn, library, options, value, part, image, drawnOn, progress.part(0.5, 1.0));
      summary.instances = static_cast<std::size_t>(image.geometry().dims()[2]);
      summary.words = ", " + std::to_string(image.geometry().dims()[2]) + " DICOM files";
    }
    else
      imaging::writeVolume(options.out, image, progress.part(0.5, 1.0),
                           &part == &value.ct && displayOf(value).hounsfield);
  };
  const auto writeSurface = [&](core::TriangleMesh mesh, const std::array<float, 3>& color)
  {
    std::string decimation = "not decimated";
    if (options.triangles && mesh.triangles.size() > *options.triangles)
    {
      const std::size_t before = mesh.triangles.size();
      auto fewer = volume::decimated(mesh, *options.triangles, progress.part(0.7, 1.0));
      mesh = std::move(fewer.mesh);
      if (mesh.triangles.size() > *options.triangles)
        warn("it keeps " + std::to_string(mesh.triangles.size()) + " triangles instead of " +
             std::to_string(*options.triangles) + ": " + fewer.limit +
             (fewer.pieces > 1
                  ? " (it is of " + std::to_string(fewer.pieces) + " pieces that are not connected)"
                  : std::string()));
      if (fewer.selfIntersections > 0)
        warn("the decimated surface passes through itself in " +
             std::to_string(fewer.selfIntersections) +
             " pairs of triangles; ask for more triangles if the other program objects");
      summary.decimation =
          ExportSummary::Decimation{before,        *options.triangles, fewer.fromGiven,
                                    fewer.toGiven, fewer.mean,         fewer.selfIntersections};
      decimation = "decimated from " + std::to_string(before) + ", at most " +
                   core::plainText(fewer.hausdorff(), 3) + " mm from it (mean " +
                   core::plainText(fewer.mean, 3) + " mm)";
    }
    const bool closed = mesh.isClosed();
    // Of a mesh from a file, parts may overlap; surfaces that are extracted have none that do.
    const bool isFromFile = options.what == "structure" && !summary.voxelsVolume;
    std::optional<double> enclosed; // mm^3
    if (closed)
      enclosed = isFromFile ? volume::measure(mesh).volume : mesh.signedVolume();
    summary.triangles = mesh.triangles.size();
    summary.closed = closed;
    summary.words = ", " + std::to_string(mesh.triangles.size()) + " triangles, " + decimation +
                    ", " +
                    (enclosed ? "closed, " + core::fixedText(*enclosed, 2) + " mm3" : "not closed");
    summary.volume = enclosed;
    imaging::writeMesh(options.out, mesh, color);
  };
  if (options.what == "ct")
    writeImage(value.ct, *checked(value.ct), "");
  else if (options.what == "mr")
  {
    const scene::ImagePart& mr = chooseMr(value, options.part);
    if (options.onCt && !mr.registered)
      throw core::InvalidParameter("export mr: '" + mr.name + "' is not registered with the " +
                                   primaryName(value) + "; register it first");
    const auto image = checked(mr);
    if (!options.onCt)
      writeImage(mr, *image, mr.name);
    else
      writeImage(mr, *mrOnCt(*image, value.ct.geometry, mr.mrFromCt, progress.part(0.0, 0.5)), "");
  }
  else if (options.what == "labels")
  {
    const auto placed =
        placedLabels(warn, value, options, leftOut, summary, progress.part(0.0, 0.4));
    if (isSegmentation(options))
    {
      const std::string& drawnOn = placed.front().drawnOn;
      const std::string series = CaseIdentifiers(value).series(
          drawnOn.empty() ? "ct" : "mr",
          *checked(drawnOn.empty() ? value.ct : chooseMr(value, drawnOn)));
      summary.segments =
          writeCaseSegmentation(options.out, value, placed, series, dicomOptionsOf(value, library),
                                progress.part(0.5, 1.0));
    }
    else
    {
      const bool holdsLayers = imaging::formatOf(options.out)->ending == ".seg.nrrd";
      const auto layers = layersOf(warn, placed, !holdsLayers, progress.part(0.4, 0.6));
      summary.layers = layers.size();
      std::map<std::uint16_t, volume::SegmentCodes> codes; // numbered as by layersOf
      std::uint16_t index = 0;
      for (const PlacedLabels& labels : placed)
        for (const auto* structure : labels.structures)
          codes[++index] = structure->codes;
      imaging::writeLabelLayers(options.out, layers, progress.part(0.6, 1.0), codes);
      if (const auto table = labelTable(options))
      {
        imaging::writeLabelTable(*table, layers.front().segments);
        summary.names = *table;
        summary.words = ", its names in " + *table;
      }
    }
  }
  else if (options.what == "mask")
    imaging::writeVolume(options.out, mask().dense(), progress);
  else if (options.what == "dissected")
  {
    const auto image = checked(value.ct);
    image->visit(
        [&](const auto& ct)
        {
          writeImage(value.ct,
                     *shared(dissected(ct, mask(), value.iso, airOf(value)), image->padding()), "");
        });
  }
  else if (options.what == "structure")
  {
    const core::Progress making = progress.part(0.0, 0.7);
    auto [mesh, color] = structureMesh(warn, value, options.part, making, summary);
    writeSurface(std::move(mesh), color);
  }
  else // surface
  {
    mask();
    checked(value.ct);
    warnOfGuesses(value.ct);
    const volume::TissueField field = scene::tissueField(value);
    writeSurface(
        rendering::extractSurface(field, field.geometry().fullBox(), progress.part(0.0, 0.7)),
        value.boneLook.color);
  }
  if (summary.patient && summary.patient->isNameHidden()) // in files that were written
    warn("the name of the case is not the patient's name in the files, but the ID '" +
         summary.patient->id + "': " + summary.patient->whyNameHidden);
  return summary;
}

} // namespace petrous::presenters
