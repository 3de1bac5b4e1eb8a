#include "BenchmarkPatients.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "petrous/Core/NumberText.h"
#include "petrous/Dissection/SweptSphereCut.h"
#include "petrous/Imaging/DicomReader.h"
#include "petrous/Phantom/Phantom.h"
#include "petrous/Phantom/SamplePatient.h"
#include "petrous/Volume/TissueExtent.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::cli
{

namespace
{

using appearance::Material;
using appearance::TransferFunction;

constexpr double kBurrRadius = 2.0;           // mm
constexpr double kWindow = 9.0;               // edge of the cavity's opening, mm
constexpr double kRow = 1.5;                  // between rows of the burr's path, mm
constexpr double kLayers[] = {1.5, 3.0, 4.5}; // depth of the burr's tip below the cortex, mm

// Of a structure: opaque.
Material solidMaterial(const std::array<float, 3>& color)
{
  Material material;
  material.transfer = TransferFunction::constant(color, 0.9F, 0.5F);
  return material;
}

// Point on the cortex seen laterally at the target's height and depth; nullopt if there is no bone.
std::optional<Eigen::Vector3d> cortexAt(const volume::TissueField& field,
                                        const Eigen::Vector3d& target, const Eigen::Vector3d& out)
{
  const auto bounds = field.geometry().patientBounds();
  const double border = out.x() > 0.0 ? bounds.max().x() : bounds.min().x();
  Eigen::Vector3d start = target;
  start.x() = border;
  Eigen::Vector3d end = target;
  end.x() = field.geometry().center().x();
  // Along the head's x axis, i.e. `out`.
  if (const auto hit = field.firstHit(start, end))
    return (start - *hit * out).eval();
  return std::nullopt;
}

// Cuts a window behind the ear canal in layers; `target` is its centre, at any x.
void openMastoid(BenchmarkPatient& patient, const Eigen::Vector3d& target)
{
  const volume::TissueField field(patient.ct, {}, nullptr, {kBenchmarkIso, 1000.0});
  patient.mask = std::make_shared<volume::CutMask>(patient.ct->geometry());
  patient.entry = cortexAt(field, target, patient.lateral).value_or(target);
  for (double z = -0.5 * kWindow; z <= 0.5 * kWindow; z += kRow)
  {
    std::vector<Eigen::Vector3d> row;
    for (double y = -0.5 * kWindow; y <= 0.5 * kWindow; y += 1.0)
      if (const auto here = cortexAt(field, target + Eigen::Vector3d(0.0, y, z), patient.lateral))
        row.push_back(*here);
    for (std::size_t n = 1; n < row.size(); ++n)
      for (const double depth : kLayers)
      {
        const Eigen::Vector3d lift = (kBurrRadius - depth) * patient.lateral;
        dissection::cut(*patient.mask, {row[n - 1] + lift, row[n] + lift, kBurrRadius});
      }
  }
  patient.mask->takeDirty();
}

double distanceToSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                         const Eigen::Vector3d& b)
{
  const Eigen::Vector3d along = b - a;
  const double share = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - share * along).norm();
}

// Structures of typical size, at least 9 mm below the cortex, for data without structures.
std::shared_ptr<const volume::LabelMap> standInLabels(const BenchmarkPatient& patient)
{
  const core::GridGeometry& grid = patient.ct->geometry();
  const auto at = [&patient](double deep, double behind, double up)
  { return (patient.entry - deep * patient.lateral + Eigen::Vector3d(0.0, behind, up)).eval(); };
  const Eigen::Vector3d nerve[] = {at(14.0, -5.0, 14.0), at(11.0, -3.0, -16.0)};
  const Eigen::Vector3d sinus[] = {at(9.0, 14.0, 14.0), at(14.0, 5.0, -14.0)};
  const Eigen::Vector3d ball = at(16.0, 2.0, 5.0);
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid);
  const core::Index3& n = grid.dims();
  tbb::parallel_for(0, n[2],
                    [&](int k)
                    {
                      for (int j = 0; j < n[1]; ++j)
                        for (int i = 0; i < n[0]; ++i)
                        {
                          const Eigen::Vector3d p = grid.patientFromVoxel(Eigen::Vector3d(i, j, k));
                          std::uint16_t index = 0;
                          if (distanceToSegment(p, nerve[0], nerve[1]) < 1.5)
                            index = 1;
                          else if (distanceToSegment(p, sinus[0], sinus[1]) < 4.5)
                            index = 2;
                          else if ((p - ball).norm() < 3.5)
                            index = 3;
                          voxels->at(i, j, k) = index;
                        }
                    });
  return std::make_shared<volume::LabelMap>(volume::makeLabelMap(
      voxels, {{"nerve", 1, {}, 0}, {"sinus", 2, {}, 0}, {"labyrinth", 3, {}, 0}}));
}

} // namespace

BenchmarkPatient phantomPatient(int edge, const core::Progress& progress)
{
  phantom::SampleOptions options;
  options.dims = core::Index3{edge, edge, edge};
  const core::GridGeometry grid = phantom::sampleGrid(options);
  const phantom::Phantom phantom;
  BenchmarkPatient patient;
  patient.name = "phantom " + std::to_string(edge) + "^3";
  patient.lateral = {-1.0, 0.0, 0.0}; // a right ear
  patient.ct = std::make_shared<volume::IntensityVolume>(
      std::make_shared<const volume::Volume<std::int16_t>>(
          phantom::samplePhantom(phantom, grid, {}, progress.part(0.0, 0.4))));
  const auto labels = std::make_shared<const volume::LabelMap>(
      phantom::labelPhantom(phantom, grid, progress.part(0.4, 0.7)));
  std::vector<volume::LabelSource> sources;
  for (std::size_t s = 0; s < phantom.structures().size(); ++s)
  {
    const phantom::PhantomStructure& structure = phantom.structures()[s];
    sources.push_back({labels, static_cast<std::uint16_t>(s + 1), static_cast<std::uint8_t>(s + 1),
                       structure.solid});
    patient.structures.push_back(solidMaterial(structure.color));
    patient.structures.back().lumen = !structure.solid;
  }
  patient.labelMap = labels;
  patient.labels = volume::makeLabelField(sources, progress.part(0.7, 0.9));
  openMastoid(patient, phantom::Phantom::center() + Eigen::Vector3d(0.0, 8.0, 5.0));
  return patient;
}

std::shared_ptr<const volume::IntensityVolume> realCt(const std::filesystem::path& data,
                                                      const core::Progress& progress)
{
  if (data.empty() || !std::filesystem::is_directory(data))
    return nullptr;
  const imaging::ScanResult scan = imaging::scanDicom(data, progress.part(0.0, 0.4));
  const imaging::DicomSeries* chosen = nullptr;
  for (const imaging::DicomSeries& series : scan.series)
    if (series.modality == "CT" && series.geometry.verdict == imaging::Verdict::Ok &&
        series.geometry.grid &&
        (!chosen || series.geometry.grid->voxelCount() > chosen->geometry.grid->voxelCount()))
      chosen = &series;
  if (!chosen)
    return nullptr;
  return std::make_shared<volume::IntensityVolume>(
      imaging::readSeries(*chosen, {}, progress.part(0.4, 1.0)));
}

std::optional<BenchmarkPatient> realPatient(const std::filesystem::path& data,
                                            const core::Progress& progress)
{
  BenchmarkPatient patient;
  patient.ct = realCt(data, progress.part(0.0, 0.8));
  if (!patient.ct)
    return std::nullopt;
  const core::GridGeometry& grid = patient.ct->geometry();
  const core::Index3& n = grid.dims();
  patient.name = "real CT " + std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " +
                 std::to_string(n[2]) + " of " + core::generalText(grid.minSpacing(), 2) + " mm";
  const auto extent = volume::tissueExtent(*patient.ct, kBenchmarkIso);
  // Typical position of the mastoid relative to the centre of the head's bone.
  openMastoid(patient, extent.center + Eigen::Vector3d(0.0, 18.0, -42.0));
  const auto labels = standInLabels(patient);
  const std::array<float, 3> colors[] = {
      {0.95F, 0.82F, 0.20F}, {0.25F, 0.35F, 0.80F}, {0.60F, 0.42F, 0.82F}};
  std::vector<volume::LabelSource> sources;
  for (std::uint8_t i = 1; i <= 3; ++i)
  {
    sources.push_back({labels, i, i, true});
    patient.structures.push_back(solidMaterial(colors[i - 1]));
  }
  patient.labelMap = labels;
  patient.labels = volume::makeLabelField(sources, progress.part(0.8, 1.0));
  return patient;
}

scene::Case touchCaseOf(const BenchmarkPatient& patient)
{
  scene::Case value;
  value.name = patient.name;
  value.iso = kBenchmarkIso;
  value.ct.geometry = patient.ct->geometry();
  value.ct.volume = patient.ct;
  scene::LabelPart part;
  part.labels = core::Lazy<volume::LabelMap>(patient.labelMap);
  for (const volume::Segment& segment : patient.labelMap->segments)
  {
    scene::StructurePart structure;
    structure.name = segment.name;
    structure.index = segment.index;
    structure.voxels = segment.voxels;
    const std::size_t row = part.structures.size();
    structure.look.solid = row >= patient.structures.size() || !patient.structures[row].lumen;
    part.structures.push_back(std::move(structure));
  }
  value.labels.push_back(std::move(part));
  value.dissection = dissection::Dissection(value.ct.geometry);
  for (std::size_t n = 0; n < patient.mask->brickCount(); ++n)
    if (const auto& brick = patient.mask->brick(n))
      value.dissection.mask().setBrick(n, brick);
  value.dissection.mask().takeDirty();
  return value;
}

} // namespace petrous::cli
