#include "petrous/Presenters/CaseDicom.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Core/Error.h"
#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Imaging/FileFormats.h"
#include "petrous/Presenters/CaseBuilder.h"

namespace petrous::presenters
{
namespace
{

template <class Voxels>
std::string seriesUid(core::Fingerprint all, const std::string& what,
                      const core::GridGeometry& grid, const Voxels& addVoxels)
{
  all.add(what.data(), what.size());
  all.add(grid.patientFromVoxelLinear().data(), 9 * sizeof(double));
  all.add(grid.origin().data(), 3 * sizeof(double));
  addVoxels(all);
  return imaging::deterministicUid(all.value(), "series");
}

// What the file said from which a structure was read, where it says more than its name does:
// "Tissue" is what 3D Slicer gives to every segment.
void describe(imaging::SegmentationDescription::Segment& segment, const volume::SegmentCodes& codes)
{
  using From = volume::SegmentCodes::Algorithm;
  using To = imaging::SegmentationDescription::Algorithm;
  const auto isGeneral = [](const volume::CodedConcept& code)
  {
    for (const char* general : {"123037004", "85756007", "T-D000A", "T-D0050"})
      if (code.value == general)
        return true;
    return code.empty();
  };
  const auto isWhole = [](const volume::CodedConcept& code)
  { return !code.value.empty() && !code.scheme.empty() && !code.meaning.empty(); };
  if (isWhole(codes.type) && !(isGeneral(codes.type) && !isGeneral(segment.type)))
  {
    segment.type = codes.type;
    if (isWhole(codes.category))
      segment.category = codes.category;
  }
  if (isWhole(codes.typeModifier))
    segment.typeModifier = codes.typeModifier;
  if (isWhole(codes.region))
    segment.region = codes.region;
  if (isWhole(codes.regionModifier))
    segment.regionModifier = codes.regionModifier;
  segment.algorithm = codes.algorithm == From::Manual      ? To::Manual
                      : codes.algorithm == From::Automatic ? To::Automatic
                                                           : To::SemiAutomatic;
  segment.algorithmName = codes.algorithmName.empty() ? "not recorded" : codes.algorithmName;
}

} // namespace

CaseIdentifiers::CaseIdentifiers(const scene::Case& value)
  : m_value(value)
{
  const std::string& id = value.id.empty() ? value.name : value.id;
  m_case.add(id.data(), id.size());
}

std::string CaseIdentifiers::study() const
{
  return imaging::deterministicUid(m_case.value(), "study");
}

std::string CaseIdentifiers::frameOfReference(const std::string& drawnOn) const
{
  return exportedFrame(m_value, drawnOn);
}

std::string CaseIdentifiers::series(const std::string& what,
                                    const volume::IntensityVolume& image) const
{
  return seriesUid(m_case, what, image.geometry(),
                   [&image](core::Fingerprint& all)
                   {
                     image.visit(
                         [&all](const auto& voxels)
                         { all.add(voxels.data(), voxels.size() * sizeof *voxels.data()); });
                   });
}

void writeCaseSeries(const std::filesystem::path& folder, const scene::Case& value,
                     const std::string& what, const volume::IntensityVolume& image,
                     const std::string& drawnOn, bool onCt, const CaseDicomOptions& options,
                     const core::Progress& progress)
{
  if (std::holds_alternative<std::shared_ptr<const volume::Volume<float>>>(image.voxels()))
    throw core::InvalidParameter(
        "export " + what +
        ": its voxels are fractions, and a DICOM series holds whole numbers; write " +
        imaging::orText(imaging::writtenEndings(imaging::kImage)));
  using Modality = imaging::SeriesDescription::Modality;
  const CaseIdentifiers identifiers(value);
  imaging::SeriesDescription series;
  const bool isMr = what == "mr" || value.ct.modality == scene::Modality::Mr;
  series.modality = isMr ? Modality::Mr : Modality::Ct;
  series.derived = true;
  series.description = what == "dissected" ? (isMr ? "MR, dissected" : "CT, dissected")
                       : what == "ct"      ? (isMr ? "MR" : "CT")
                       : onCt              ? "MR, resampled on the CT"
                                           : "MR";
  series.seriesNumber = what == "ct" ? 1 : what == "mr" ? 2 : 3;
  series.patientId = "ANONYMOUS";
  series.patientName = "Anonymous";
  series.studyUid = identifiers.study();
  series.studyId = options.studyId;
  series.seriesUid = identifiers.series(what, image);
  series.frameOfReferenceUid = identifiers.frameOfReference(drawnOn);
  if (!isMr && value.denseBone != volume::IntensityScale{}.dense)
    series.rescaleType = "US";
  if (series.modality == Modality::Mr)
  {
    const volume::ValueRange range = image.range();
    series.windowCenter = 0.5 * (range.min + range.max);
    series.windowWidth = std::max(range.max - range.min, 1.0);
  }
  imaging::writeDicomSeries(folder, image, series, std::nullopt, progress);
}

std::size_t writeCaseSegmentation(const std::filesystem::path& path, const scene::Case& value,
                                  const std::vector<PlacedLabels>& placed,
                                  const std::string& sourceSeries, const CaseDicomOptions& options,
                                  const core::Progress& progress)
{
  using Segmentation = imaging::SegmentationDescription;
  const std::string& drawnOn = placed.front().drawnOn;
  const core::GridGeometry& grid = placed.front().map->voxels->geometry();
  const CaseIdentifiers identifiers(value);
  const auto presets = appearance::StructurePresets::builtIn();
  Segmentation segmentation;
  std::vector<volume::LabelMap> maps;
  for (const PlacedLabels& labels : placed)
  {
    for (const auto* structure : labels.structures)
    {
      const auto code = presets.codeFor(structure->name, structure->look.preset);
      Segmentation::Segment segment;
      segment.map = maps.size();
      segment.index = structure->index;
      segment.label = structure->name;
      segment.color = structure->look.color;
      segment.category = {code.category, "SCT", code.categoryMeaning};
      segment.type = {code.type, "SCT", code.typeMeaning};
      describe(segment, structure->codes);
      segmentation.segments.push_back(std::move(segment));
    }
    maps.push_back(*labels.map);
  }
  const scene::ImagePart* source = drawnOn.empty() ? &value.ct : nullptr;
  for (const auto& mr : value.mr)
    if (!source && mr.name == drawnOn)
      source = &mr;
  if (source)
    segmentation.source = Segmentation::Source{
        drawnOn.empty() && value.ct.modality != scene::Modality::Mr
            ? imaging::SeriesDescription::Modality::Ct
            : imaging::SeriesDescription::Modality::Mr,
        sourceSeries, source->geometry.dims()[2], core::sameGrid(source->geometry, grid)};
  segmentation.description = "Segmentation";
  segmentation.studyUid = identifiers.study();
  segmentation.studyId = options.studyId;
  segmentation.frameOfReferenceUid = identifiers.frameOfReference(drawnOn);
  segmentation.seriesUid = seriesUid(
      identifiers.fingerprint(), "labels", grid,
      [&](core::Fingerprint& all)
      {
        for (const auto& map : maps)
          all.add(map.voxels->data(), map.voxels->size() * sizeof(std::uint16_t));
        for (const auto& segment : segmentation.segments)
        {
          all.add(segment.label.c_str(), segment.label.size() + 1);
          all.add(segment.color.data(), sizeof segment.color);
          for (const auto* concept : {&segment.type, &segment.typeModifier, &segment.region})
            if (!concept->empty())
              all.add(concept->value.c_str(), concept->value.size() + 1);
          all.add(&segment.algorithm, sizeof segment.algorithm);
          all.add(segment.algorithmName.c_str(), segment.algorithmName.size() + 1);
          all.add(&segment.map, sizeof segment.map);
          all.add(&segment.index, sizeof segment.index);
        }
      });
  imaging::writeDicomSegmentation(path, maps, segmentation, progress);
  return segmentation.segments.size();
}

} // namespace petrous::presenters
