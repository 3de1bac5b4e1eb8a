#include "petrous/Presenters/CaseDicom.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Imaging/CasePatient.h"
#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Imaging/FileFormats.h"
#include "petrous/Library/FrameSalt.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Presenters/IdentityText.h"
#include "petrous/Presenters/ProvenanceText.h"

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
  // Free text, often a person's name; of programs, the names that are widely used.
  segment.algorithmName = "not recorded";
  for (const char* program : {"TotalSegmentator", "nnU-Net", "nnUNet", "MONAI", "MONAILabel",
                              "Slicer", "3D Slicer", "ITK-SNAP", "SynthSeg", "FreeSurfer"})
    if (codes.algorithmName == program)
      segment.algorithmName = program;
}

constexpr std::size_t kStudyIdLength = 16; // of a short string (SH)

constexpr double kLatticeTolerance = 0.01; // mm
constexpr std::size_t kLargestGrowth = 8;  // of the largest grid

// voxel of a lattice = axes * voxel of a grid + offset; axes: a signed permutation
struct LatticeMap
{
  Eigen::Matrix3i axes;
  Eigen::Vector3i offset;

  Eigen::Vector3i operator()(int i, int j, int k) const
  {
    return axes * Eigen::Vector3i(i, j, k) + offset;
  }
};

std::optional<LatticeMap> onLattice(const core::GridGeometry& lattice,
                                    const core::GridGeometry& grid)
{
  constexpr double kFarthest = 1e6; // voxels
  const Eigen::Matrix3d axes =
      (lattice.voxelFromPatientLinear() * grid.patientFromVoxelLinear()).array().round();
  const Eigen::Vector3d offset = lattice.voxelFromPatient(grid.origin()).array().round();
  const Eigen::Matrix3d steps = axes.cwiseAbs();
  if ((steps.rowwise().sum().array() != 1.0).any() ||
      (steps.colwise().sum().array() != 1.0).any() || offset.cwiseAbs().maxCoeff() > kFarthest)
    return std::nullopt;
  for (int corner = 0; corner < 8; ++corner)
  {
    Eigen::Vector3d voxel;
    for (int a = 0; a < 3; ++a)
      voxel[a] = (corner >> a & 1) != 0 ? grid.dims()[static_cast<std::size_t>(a)] - 1 : 0;
    const Eigen::Vector3d there = lattice.patientFromVoxel(axes * voxel + offset);
    if ((there - grid.patientFromVoxel(voxel)).norm() > kLatticeTolerance)
      return std::nullopt;
  }
  return LatticeMap{axes.cast<int>(), offset.cast<int>()};
}

core::IndexBox boxOf(const LatticeMap& map, const core::Index3& dims)
{
  const Eigen::Vector3i first = map(0, 0, 0);
  const Eigen::Vector3i last = map(dims[0] - 1, dims[1] - 1, dims[2] - 1);
  core::IndexBox box;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<Eigen::Index>(a);
    box.lower[a] = std::min(first[axis], last[axis]);
    box.upper[a] = std::max(first[axis], last[axis]) + 1;
  }
  return box;
}

// As a component of a person's name (PN), which has 64 characters with the family name.
std::string givenName(std::string text)
{
  constexpr std::size_t kMost = 64 - 8; // characters
  std::replace(text.begin(), text.end(), '=', ' ');
  std::replace(text.begin(), text.end(), '^', ' ');
  const auto starts = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
  std::size_t characters = 0;
  for (std::size_t n = 0; n < text.size(); ++n)
    if (starts(text[n]) && ++characters > kMost)
      return text.substr(0, n);
  return text;
}

// Why the name of a case may not leave as a patient's. That it is not the patient's own is known
// only where the words of that name are, and those of less than three letters are often none of the
// hashes.
std::string whyNameHidden(const scene::Case& value, const library::Library& library)
{
  const IdentityText identity(value, library);
  if (identity.isSaltLost())
    return "the library's salt was lost, so it cannot be compared with the patient's name; it goes "
           "along where that salt is restored from a copy, or the images are imported again";
  if (const scene::PatientHash& patient = value.ct.patient;
      !patient.name.empty() && patient.nameParts.empty() &&
      scene::isComparable(value.ct, library::frameSalter(library)))
    return "the patient's name in its files has no word with which to compare it, as that of a "
           "phantom or a number has none (of images that an older version imported, none was "
           "kept); it goes along where the images are imported again, of files with a person's "
           "name";
  if (!identity.knowsName())
    return "nothing is known of the patient's name with which to compare it; it goes along where "
           "the case was made of DICOM files that state the patient's name, in this library";
  if (identity.mayIdentify(value.name))
    return "it may be the patient's name, number or date; it goes along where the case is renamed";
  constexpr std::size_t kShort = 3; // letters
  const auto isLetter = [](unsigned char c) { return std::isalpha(c) != 0 || c >= 0x80; };
  for (auto begin = value.name.begin(); begin != value.name.end();)
  {
    begin = std::find_if(begin, value.name.end(), isLetter);
    const auto end = std::find_if_not(begin, value.name.end(), isLetter);
    const std::string word(begin, end);
    const auto letters =
        std::count_if(word.begin(), word.end(), [](unsigned char c) { return (c & 0xC0) != 0x80; });
    if (letters > 0 && static_cast<std::size_t>(letters) < kShort && !identity.isOfField(word))
      return "a word of one or two letters cannot be compared with the patient's name; it goes "
             "along where the case is renamed to one without";
    begin = end;
  }
  return {};
}

} // namespace

std::optional<std::size_t> padToOneGrid(std::vector<PlacedLabels>& placed,
                                        const core::GridGeometry& image,
                                        const core::Progress& progress)
{
  const auto gridOf = [&placed](std::size_t n) -> const core::GridGeometry&
  { return placed[n].map->voxels->geometry(); };
  if (placed.empty())
    return std::nullopt;
  bool isOne = true;
  for (std::size_t n = 1; n < placed.size(); ++n)
    isOne = isOne && core::sameGrid(gridOf(0), gridOf(n));
  if (isOne)
    return std::nullopt;
  const bool isImages = onLattice(image, gridOf(0)).has_value();
  const core::GridGeometry lattice = isImages ? image : gridOf(0);
  std::vector<LatticeMap> maps;
  core::IndexBox all;
  for (std::size_t n = 0; n < placed.size(); ++n)
  {
    const auto map = onLattice(lattice, gridOf(n));
    if (!map)
      return n;
    maps.push_back(*map);
    all = all.united(boxOf(*map, gridOf(n).dims()));
  }
  std::size_t largest = image.voxelCount();
  for (std::size_t n = 0; n < placed.size(); ++n)
    largest = std::max(largest, gridOf(n).voxelCount());
  if (all.count() / kLargestGrowth > largest)
    return placed.size() - 1;
  const core::IndexBox full = image.fullBox();
  if (isImages && all.intersected(full) == all)
    all = full;
  const core::GridGeometry grid(
      all.size(), lattice.spacing(),
      lattice.patientFromVoxel(Eigen::Vector3d(all.lower[0], all.lower[1], all.lower[2])),
      lattice.direction());
  for (std::size_t n = 0; n < placed.size(); ++n)
  {
    if (core::sameGrid(gridOf(n), grid))
      continue;
    const volume::Volume<std::uint16_t>& from = *placed[n].map->voxels;
    const core::Index3& dims = from.geometry().dims();
    auto voxels = volume::makeZeroVolume<std::uint16_t>(grid);
    for (int k = 0; k < dims[2]; ++k)
    {
      progress.report((static_cast<double>(n) + static_cast<double>(k) / dims[2]) /
                          static_cast<double>(placed.size()),
                      "bringing the structures onto one grid");
      for (int j = 0; j < dims[1]; ++j)
        volume::forEachLabel(&from.at(0, j, k), dims[0],
                             [&](int i, std::uint16_t label)
                             {
                               const Eigen::Vector3i to = maps[n](i, j, k);
                               voxels->at(to[0] - all.lower[0], to[1] - all.lower[1],
                                          to[2] - all.lower[2]) = label;
                             });
    }
    placed[n].map = std::make_shared<const volume::LabelMap>(
        volume::makeLabelMap(std::move(voxels), placed[n].map->segments));
  }
  return std::nullopt;
}

std::string studyIdOf(const std::string& caseName)
{
  const std::string text = "petrous case " + caseName;
  return library::sha256Of(reinterpret_cast<const std::uint8_t*>(text.data()), text.size())
      .substr(0, kStudyIdLength);
}

std::string hiddenStudyIdOf(const library::Library& library, const std::string& caseName)
{
  return library::saltedFrame(library, "study of case " + caseName).substr(0, kStudyIdLength);
}

std::string toldName(const std::string& caseName)
{
  return givenName(caseName);
}

bool isStudyId(const std::string& text)
{
  return text.size() == kStudyIdLength &&
         text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

CaseIdentifiers::CaseIdentifiers(const scene::Case& value)
  : m_value(value)
{
  m_case.add(value.id.data(), value.id.size());
  m_case.add(value.name.data(), value.name.size());
}

std::string CaseIdentifiers::study() const
{
  return imaging::deterministicUid(m_case.value(), "study");
}

std::string CaseIdentifiers::formerStudy() const
{
  core::Fingerprint all;
  const std::string& id = m_value.id.empty() ? m_value.name : m_value.id;
  all.add(id.data(), id.size());
  return imaging::deterministicUid(all.value(), "study");
}

CasePatient CaseIdentifiers::patient(const library::Library& library) const
{
  const std::string what = "patient";
  core::Fingerprint all = m_case;
  all.add(what.data(), what.size());
  CasePatient patient;
  patient.id = imaging::casePatientId(all.value());
  patient.whyNameHidden = whyNameHidden(m_value, library);
  patient.name = std::string(imaging::kCaseFamilyName) + "^" +
                 (patient.isNameHidden() ? patient.id : givenName(m_value.name));
  return patient;
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

CaseDicomOptions dicomOptionsOf(const scene::Case& value, const library::Library& library)
{
  CaseDicomOptions options;
  options.patient = CaseIdentifiers(value).patient(library);
  options.studyId =
      options.patient.isNameHidden() ? hiddenStudyIdOf(library, value.name) : studyIdOf(value.name);
  return options;
}

std::optional<double> writeCaseSeries(const std::filesystem::path& folder, const scene::Case& value,
                                      const std::string& what, const scene::ImagePart& part,
                                      const volume::IntensityVolume& image,
                                      const std::string& drawnOn, bool onCt,
                                      const CaseDicomOptions& options,
                                      const core::Progress& progress)
{
  using Modality = imaging::SeriesDescription::Modality;
  const CaseIdentifiers identifiers(value);
  imaging::SeriesDescription series;
  const bool isMr = what == "mr" || value.ct.modality == scene::Modality::Mr;
  std::optional<double> error;
  if (const auto* voxels =
          std::get_if<std::shared_ptr<const volume::Volume<float>>>(&image.voxels()))
  {
    constexpr double kCoarsest = 1.0; // of a CT: a step of one unit, an error of half of one
    const auto stored = imaging::storedFractions(**voxels);
    if (!stored || (!isMr && stored->slope > kCoarsest))
      throw FractionsError(
          "export " + what +
          ": its voxels are fractions, and spread too far for the 16 bits of a DICOM series to "
          "hold them within half a unit; write " +
          imaging::orText(imaging::writtenEndings(imaging::kImage)));
    series.rescaleSlope = stored->slope;
    series.rescaleIntercept = stored->intercept;
    error = stored->error;
  }
  series.modality = isMr ? Modality::Mr : Modality::Ct;
  series.derived = true;
  series.faults = part.provenance.pixels;
  series.derivation = derivationText(part, onCt);
  if (!onCt)
    series.interpolated = part.provenance.interpolated;
  series.description = what == "dissected" ? (isMr ? "MR, dissected" : "CT, dissected")
                       : what == "ct"      ? (isMr ? "MR" : "CT")
                       : onCt              ? "MR, resampled on the CT"
                                           : "MR";
  series.seriesNumber = what == "ct" ? 1 : what == "mr" ? 2 : 3;
  series.patientId = options.patient.id;
  series.patientName = options.patient.name;
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
  return error;
}

std::string roundingNote(const std::string& name, double error)
{
  return "the voxels of " + name +
         " are fractions and were written in 16 bits with a rescale slope; they are off by up to " +
         core::plainText(error);
}

std::string guessedNote(const scene::ImagePart& part)
{
  std::string text;
  const std::vector<volume::SliceRange>& slices = part.provenance.interpolated;
  if (!slices.empty())
    text = (volume::sliceCount(slices) == 1 ? "slice " : "slices ") + volume::toString(slices) +
           " interpolated between neighbours: nothing was measured there";
  for (const std::string& one : axesTexts(part.provenance.assumedRas, part.provenance.axes))
    text += (text.empty() ? "" : "; ") + one;
  return text.empty() ? text : "in '" + part.name + "', " + text;
}

std::string guessedNote(const scene::LabelPart& part)
{
  std::string text;
  for (const std::string& one : provenanceTexts(part))
    text += (text.empty() ? (part.structures.size() == 1
                                 ? "'" + part.structures.front().name + "': "
                                 : std::to_string(part.structures.size()) + " structures: ")
                          : "; ") +
            one;
  return text;
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
  segmentation.patientId = options.patient.id;
  segmentation.patientName = options.patient.name;
  segmentation.studyUid = identifiers.study();
  segmentation.studyId = options.studyId;
  segmentation.seriesNumber = options.segmentationNumber;
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
          for (const auto* concept : {&segment.category, &segment.type, &segment.typeModifier,
                                      &segment.region, &segment.regionModifier})
            for (const auto* text : {&concept->value, &concept->scheme, &concept->meaning})
              all.add(text->c_str(), text->size() + 1);
          all.add(&segment.algorithm, sizeof segment.algorithm);
          all.add(segment.algorithmName.c_str(), segment.algorithmName.size() + 1);
          all.add(&segment.map, sizeof segment.map);
          all.add(&segment.index, sizeof segment.index);
        }
        all.add(sourceSeries.c_str(), sourceSeries.size() + 1);
      });
  imaging::writeDicomSegmentation(path, maps, segmentation, progress);
  return segmentation.segments.size();
}

} // namespace petrous::presenters
