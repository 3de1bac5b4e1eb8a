#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "CaseJson.h"
#include "CaseWarnings.h"
#include "Commands.h"
#include "Numbers.h"
#include "petrous/Core/Fingerprint.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Imaging/FileFormats.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Imaging/VolumeFile.h"
#include "petrous/Presenters/MrOnCt.h"
#include "petrous/Rendering/SurfaceExtraction.h"
#include "petrous/Scene/CaseField.h"
#include "petrous/Scene/Placement.h"

namespace petrous::cli
{

namespace
{

constexpr double kAirHu = -1000.0;

struct Options
{
  std::string caseName, what, out, part;
  bool onCt = false;
  bool withoutDamaged = false;

  /// Whether --out is a folder, for a DICOM series.
  bool isSeries() const
  {
    std::error_code ignored;
    return !out.empty() && (out.back() == '/' || std::filesystem::is_directory(out, ignored)) &&
           (what == "ct" || what == "mr" || what == "dissected");
  }
};

template <class T>
T rounded(double value)
{
  if constexpr (std::is_integral_v<T>)
    return static_cast<T>(std::lround(std::clamp(value, double{std::numeric_limits<T>::min()},
                                                 double{std::numeric_limits<T>::max()})));
  else
    return static_cast<T>(value);
}

// The CT after removal: untouched voxels keep their value, removed ones are air, and in between the
// value is capped so that the surface at `iso` is the cut surface of f.
template <class T>
volume::Volume<T> dissected(const volume::Volume<T>& ct, const volume::CutMask& mask, double iso)
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
          const double cap = iso + (share - 0.5) * 2.0 * (iso - kAirHu);
          if (cap < static_cast<double>(value))
            value = rounded<T>(cap);
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
  throw UsageError("export mr: give --part NAME; there are: " + there);
}

// All structures of label maps that share a grid, merged into one map and numbered in order; where
// two overlap the earlier one is kept.
volume::LabelMap mergedLabels(const Context& context, const scene::Case& value,
                              const std::string& only, const presenters::LeftOut& leftOut)
{
  const auto isLeftOut = [&](const scene::LabelPart& labels)
  {
    return std::any_of(leftOut.labels.begin(), leftOut.labels.end(),
                       [&](const auto& part) { return &value.labels[part.index] == &labels; });
  };
  std::shared_ptr<volume::Volume<std::uint16_t>> voxels;
  std::vector<volume::Segment> segments;
  for (const auto& part : value.labels)
    for (const auto& structure : part.structures)
    {
      if (!only.empty() && structure.name != only)
        continue;
      if (isLeftOut(part))
      {
        if (!only.empty())
          throw core::InvalidParameter("export labels: '" + only +
                                       "' is missing or damaged, and nothing else is asked for");
        continue;
      }
      const auto placed = scene::labelsOnCt(value, part);
      if (!placed)
        context.warn("'" + structure.name + "' is written where its MR has it, not on the CT: " +
                     scene::missingPlace(value, structure.name));
      const auto& source = *(placed ? placed : part.labels.get())->voxels;
      if (!voxels)
        voxels =
            std::make_shared<volume::Volume<std::uint16_t>>(source.geometry(), std::uint16_t{0});
      if (!core::sameGrid(voxels->geometry(), source.geometry()))
        throw UsageError("export labels: '" + structure.name +
                         "' lies on another grid; export it alone with --part");
      const auto index = static_cast<std::uint16_t>(segments.size() + 1);
      std::transform(voxels->data(), voxels->data() + voxels->size(), source.data(), voxels->data(),
                     [&structure, index](std::uint16_t present, std::uint16_t own)
                     { return present == 0 && own == structure.index ? index : present; });
      volume::Segment segment;
      segment.name = structure.name;
      segment.index = index;
      segment.color = structure.look.color;
      segments.push_back(std::move(segment));
    }
  if (!voxels)
    throw core::InvalidParameter("case '" + value.name + "' has no " +
                                 (only.empty() ? "structures" : "structure '" + only + "'"));
  return volume::makeLabelMap(std::move(voxels), std::move(segments));
}

template <class T>
std::shared_ptr<const volume::IntensityVolume> shared(volume::Volume<T> voxels,
                                                      std::optional<double> padding)
{
  return std::make_shared<const volume::IntensityVolume>(
      std::make_shared<const volume::Volume<T>>(std::move(voxels)), padding);
}

imaging::FileContent contentOf(const std::string& what)
{
  if (what == "labels")
    return imaging::kLabels;
  if (what == "surface" || what == "structure")
    return imaging::kMesh;
  return imaging::kImage;
}

// A DICOM series with identifiers of its own and nothing of the patient's. Images of one case share
// study and, in the CT's space, frame of reference; equal voxels give equal files.
void writeSeries(const Options& options, const scene::Case& value,
                 const volume::IntensityVolume& image, const std::string& space,
                 const core::Progress& progress)
{
  if (std::holds_alternative<std::shared_ptr<const volume::Volume<float>>>(image.voxels()))
    throw core::InvalidParameter(
        "export " + options.what +
        ": its voxels are fractions, and a DICOM series holds whole numbers; write " +
        imaging::orText(imaging::writtenEndings(imaging::kImage)));
  using Modality = imaging::SeriesDescription::Modality;
  const std::string& id = value.id.empty() ? value.name : value.id;
  core::Fingerprint ofCase;
  ofCase.add(id.data(), id.size());
  core::Fingerprint ofImage = ofCase;
  ofImage.add(options.what.data(), options.what.size());
  const core::GridGeometry& grid = image.geometry();
  ofImage.add(grid.patientFromVoxelLinear().data(), 9 * sizeof(double));
  ofImage.add(grid.origin().data(), 3 * sizeof(double));
  image.visit([&](const auto& voxels)
              { ofImage.add(voxels.data(), voxels.size() * sizeof *voxels.data()); });

  imaging::SeriesDescription series;
  series.modality = options.what == "mr" ? Modality::Mr : Modality::Ct;
  series.derived = true;
  series.description = options.what == "dissected" ? "CT, dissected"
                       : options.what == "ct"      ? "CT"
                       : options.onCt              ? "MR, resampled on the CT"
                                                   : "MR";
  series.seriesNumber = options.what == "ct" ? 1 : options.what == "mr" ? 2 : 3;
  series.patientId = "ANONYMOUS";
  series.patientName = "Anonymous";
  series.studyUid = imaging::deterministicUid(ofCase.value(), "study");
  series.seriesUid = imaging::deterministicUid(ofImage.value(), "series");
  series.frameOfReferenceUid = imaging::deterministicUid(ofCase.value(), "frame " + space);
  if (value.denseBone != volume::IntensityScale{}.dense)
    series.rescaleType = "US";
  if (series.modality == Modality::Mr)
  {
    const volume::ValueRange range = image.range();
    series.windowCenter = 0.5 * (range.min + range.max);
    series.windowWidth = std::max(range.max - range.min, 1.0);
  }
  core::OutputFolder folder(options.out);
  imaging::writeDicomSeries(folder.path(), image, series, std::nullopt, progress);
  progress.check("writing DICOM slices");
  folder.commit();
}

// One structure as a surface: of its voxels on the CT, or the mesh that it is.
core::TriangleMesh structureMesh(const Context& context, const scene::Case& value,
                                 const std::string& name, const core::Progress& progress,
                                 nlohmann::json& json)
{
  for (const auto& part : value.labels)
    for (const auto& structure : part.structures)
      if (structure.name == name)
      {
        const auto placed = scene::labelsOnCt(value, part);
        if (!placed)
          context.warn("'" + name + "' is written where its MR has it, not on the CT: " +
                       scene::missingPlace(value, name));
        const volume::LabelMap& map = *(placed ? placed : part.labels.get());
        json["voxels_mm3"] = structure.volume;
        return rendering::extractLabel(*map.voxels, structure.index, progress);
      }
  for (const auto& part : value.meshes)
    if (part.name == name)
    {
      const auto placed = scene::meshOnCt(value, part);
      if (!placed)
        context.warn("'" + name + "' is written where its MR has it, not on the CT: " +
                     scene::missingPlace(value, name));
      return *(placed ? placed : part.mesh.get());
    }
  throw core::InvalidParameter("case '" + value.name + "' has no structure '" + name + "'");
}

void exportCase(const Context& context, const Options& options)
{
  if (!options.isSeries()) // before anything is computed
    imaging::writingFormat(options.out, contentOf(options.what));
  if (options.onCt && options.what != "mr")
    throw UsageError("--on-ct is for --what mr");
  if (options.what == "structure" && options.part.empty())
    throw UsageError("export structure: give --part NAME");
  context.refuseOverwriting({options.out});
  const library::Library library = context.openLibrary();
  scene::Case value = library.open(options.caseName);
  const core::Progress progress = context.progress();
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
  presenters::LeftOut leftOut;
  // Labels that are written are read, and thus checked; the surface is that of all structures.
  if (options.what == "surface" || (options.what == "labels" && options.withoutDamaged))
    leftOut = leaveOutDamaged(context, library, value, options.withoutDamaged);
  nlohmann::json json{{"case", value.name}, {"what", options.what}, {"out", options.out}};
  std::string words;
  const auto writeImage = [&](const volume::IntensityVolume& image, const std::string& space)
  {
    if (options.isSeries())
    {
      writeSeries(options, value, image, space, progress.part(0.5, 1.0));
      json["instances"] = image.geometry().dims()[2];
      words = ", " + std::to_string(image.geometry().dims()[2]) + " DICOM files";
    }
    else
      imaging::writeVolume(options.out, image, progress.part(0.5, 1.0));
  };
  const auto writeSurface = [&](const core::TriangleMesh& mesh)
  {
    const bool closed = mesh.isClosed();
    json["triangles"] = mesh.triangles.size();
    json["closed"] = closed;
    json["decimation"] = "none";
    words =
        ", " + std::to_string(mesh.triangles.size()) + " triangles, not decimated, " +
        (closed ? "closed, " + core::generalText(mesh.signedVolume(), 5) + " mm3" : "not closed");
    if (closed)
      json["volume_mm3"] = mesh.signedVolume();
    imaging::writeMesh(options.out, mesh);
  };
  if (options.what == "ct")
    writeImage(*checked(value.ct), "CT");
  else if (options.what == "mr")
  {
    const scene::ImagePart& mr = chooseMr(value, options.part);
    if (options.onCt && !mr.registered)
      throw core::InvalidParameter("export mr: '" + mr.name +
                                   "' is not registered with the CT; register it first");
    const auto image = checked(mr);
    if (!options.onCt)
      writeImage(*image, "MR " + mr.name);
    else
      writeImage(*presenters::mrOnCt(*image, value.ct.geometry, mr.mrFromCt,
                                     progress.part(0.0, 0.5)),
                 "CT");
  }
  else if (options.what == "labels")
    imaging::writeLabelFile(options.out, mergedLabels(context, value, options.part, leftOut));
  else if (options.what == "mask")
    imaging::writeVolume(options.out, mask().dense(), progress);
  else if (options.what == "dissected")
  {
    const auto image = checked(value.ct);
    image->visit(
        [&](const auto& ct)
        { writeImage(*shared(dissected(ct, mask(), value.iso), image->padding()), "CT"); });
  }
  else if (options.what == "structure")
    writeSurface(structureMesh(context, value, options.part, progress, json));
  else // surface
  {
    mask();
    checked(value.ct);
    const volume::TissueField field = scene::tissueField(value);
    writeSurface(rendering::extractSurface(field, field.geometry().fullBox(), progress));
  }
  context.print(options.out + ": " + options.what + " of '" + value.name + "'" + words);
  json["left_out"] = leftOutJson(value, leftOut);
  context.printJson(json);
}

} // namespace

void addExportCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(app, "export", "Voxels or a surface for other programs",
                                         [options, &context] { exportCase(context, *options); });
  command->add_option("CASE", options->caseName)->required();
  command
      ->add_option("--what", options->what, "ct, mr, labels, mask, dissected, surface or structure")
      ->check(oneOf({"ct", "mr", "labels", "mask", "dissected", "surface", "structure"}))
      ->required();
  command
      ->add_option(
          "--out", options->out,
          "Voxels: " + imaging::orText(imaging::writtenEndings(imaging::kImage)) +
              "; labels: " + imaging::orText(imaging::writtenEndings(imaging::kLabels)) +
              "; surface, structure: " + imaging::orText(imaging::writtenEndings(imaging::kMesh)) +
              "; mm LPS. FOLDER/: ct, mr or dissected as a DICOM series")
      ->type_name("F")
      ->required();
  auto* part = command->add_option("--part", options->part, "One MR or structure of several")
                   ->type_name("NAME");
  command->add_option("NAME", options->part, "As --part: 'export ear --what structure NAME'")
      ->excludes(part);
  command->add_flag("--on-ct", options->onCt, "An MR resampled on the CT's grid");
  addWithoutDamaged(*command, options->withoutDamaged);
}

} // namespace petrous::cli
