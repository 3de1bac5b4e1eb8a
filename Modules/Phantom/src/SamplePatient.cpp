#include "petrous/Phantom/SamplePatient.h"

#include <atomic>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>

#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Phantom/Phantom.h"

namespace petrous::phantom
{
namespace
{

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using core::InvalidParameter;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kDefaultSpacing = 0.3;
const Eigen::Vector3d kMrSpacing(0.6, 0.6, 0.8);
constexpr double kMrMargin = 10.0; // mm larger than the ear, so that the moved ear is inside

void check(const SampleOptions& options)
{
  const auto within = [](const char* what, double value, const core::NumberRange& range)
  {
    if (!range.contains(value))
      throw InvalidParameter(std::string("sample patient: ") + what + " " + range.refusal(value));
  };
  if (options.spacing)
    within("the spacing", *options.spacing, SampleOptions::kSpacings);
  if (options.dims)
    for (const int n : *options.dims)
      within("each dimension", n, SampleOptions::kDims);
  within("the noise", options.noise, SampleOptions::kNoises);
  within("the tilt", options.tilt, SampleOptions::kTilts);
}

core::GridGeometry centred(const core::Index3& dims, const Eigen::Vector3d& spacing,
                           const Eigen::Vector3d& center)
{
  const Eigen::Vector3d steps(dims[0] - 1, dims[1] - 1, dims[2] - 1);
  return {dims, spacing, center - 0.5 * spacing.cwiseProduct(steps)};
}

/// Slices of a tilted gantry: planes rotated about x, with the table moving along z.
ScanGrid tilted(const core::GridGeometry& upright, double tilt)
{
  ScanGrid grid(upright);
  const double s = upright.spacing()[1];
  grid.step.col(1) =
      Eigen::Vector3d(0.0, s * std::cos(tilt * kDegree), s * std::sin(tilt * kDegree));
  const core::Index3& dims = upright.dims();
  grid.origin =
      upright.center() - 0.5 * grid.step * Eigen::Vector3d(dims[0] - 1, dims[1] - 1, dims[2] - 1);
  return grid;
}

core::PatientBox boxOf(const core::GridGeometry& grid)
{
  const core::PatientBox bounds = grid.patientBounds();
  return {bounds.min() - 0.5 * grid.spacing(), bounds.max() + 0.5 * grid.spacing()};
}

Json list(const Eigen::Vector3d& v)
{
  return Json::array({v.x(), v.y(), v.z()});
}

void makeFolder(const fs::path& folder)
{
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fault)
    throw core::Error(core::Fault::Refused,
                      folder.string() + ": cannot be made: " + fault.message());
}

class Writer
{
public:
  Writer(fs::path folder, const SampleOptions& options)
    : m_folder(std::move(folder))
    , m_options(options)
    , m_phantom(PhantomRecipe{options.seed, true})
    , m_grid(sampleGrid(options))
  {
  }

  void write(const core::Progress& progress)
  {
    writeCt(progress.part(0.0, 0.45));
    writeMr(progress.part(0.45, 0.55));
    writeLabels(progress.part(0.55, 0.85));
    writeMeshes(progress.part(0.85, 1.0));
    writeTruth();
  }

private:
  std::string uid(const char* role) const
  {
    return imaging::deterministicUid(m_options.seed, role);
  }

  void writeCt(const core::Progress& progress)
  {
    const ScanGrid grid = m_options.tilt != 0.0 ? tilted(m_grid, m_options.tilt) : m_grid;
    ScanSettings settings;
    settings.noise = m_options.noise;
    settings.seed = m_options.seed;
    auto ct = std::make_shared<const volume::Volume<std::int16_t>>(
        samplePhantom(m_phantom, grid, settings, progress.part(0.0, 0.7)));
    imaging::SeriesDescription series;
    series.description = "Temporal bone right";
    series.studyUid = uid("study");
    series.seriesUid = uid("ct.series");
    series.frameOfReferenceUid = uid("ct.frame");
    series.rescaleIntercept = -1024.0;
    std::optional<Eigen::Vector3d> step;
    if (m_options.tilt != 0.0)
      step = grid.step.col(2);
    imaging::writeDicomSeries(m_folder / "ct", volume::IntensityVolume(ct), series, step,
                              progress.part(0.7, 1.0));
  }

  void writeMr(const core::Progress& progress)
  {
    const core::RigidTransform motion = m_phantom.mrFromCt();
    const Eigen::Vector3d size =
        ((Phantom::extent().array() + kMrMargin) / kMrSpacing.array()).ceil();
    const core::Index3 dims{static_cast<int>(size[0]), static_cast<int>(size[1]),
                            static_cast<int>(size[2])};
    m_mrGrid = centred(dims, kMrSpacing, motion * Phantom::center());
    ScanSettings settings;
    settings.modality = Phantom::Modality::Mr;
    settings.noise = 0.6 * m_options.noise;
    settings.pointSpread = 0.3;
    settings.seed = m_options.seed + 1;
    settings.patientFromScan = motion.inverse();
    auto mr = std::make_shared<const volume::Volume<std::int16_t>>(
        samplePhantom(m_phantom, m_mrGrid, settings, progress.part(0.0, 0.7)));
    imaging::SeriesDescription series;
    series.modality = imaging::SeriesDescription::Modality::Mr;
    series.description = "T2 3D inner ear right";
    series.seriesNumber = 2;
    series.studyUid = uid("study");
    series.seriesUid = uid("mr.series");
    series.frameOfReferenceUid = uid("mr.frame");
    series.windowCenter = 500.0;
    series.windowWidth = 1000.0;
    imaging::writeDicomSeries(m_folder / "mr", volume::IntensityVolume(mr), series, std::nullopt,
                              progress.part(0.7, 1.0));
  }

  void writeLabels(const core::Progress& progress)
  {
    const volume::LabelMap labels = labelPhantom(m_phantom, m_grid, progress.part(0.0, 0.2));
    m_segments = labels.segments;
    makeFolder(m_folder / "labels");
    imaging::writeLabelFile(m_folder / "labels.seg.nrrd", labels);

    std::atomic<std::size_t> done{0};
    const core::Progress files = progress.part(0.4, 1.0);
    tbb::parallel_for(
        std::size_t{0}, m_segments.size(),
        [&](std::size_t s)
        {
          const volume::Segment& segment = m_segments[s];
          files.report(static_cast<double>(done.fetch_add(1)) /
                           static_cast<double>(m_segments.size()),
                       "writing labels");
          if (segment.voxels == 0)
            return; // outside a small grid, or between the voxels of a coarse one
          auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(m_grid);
          const std::uint16_t* from = labels.voxels->data();
          std::transform(from, from + voxels->size(), voxels->data(),
                         [&](std::uint16_t index)
                         { return static_cast<std::uint16_t>(index == segment.index ? 1 : 0); });
          const volume::LabelMap one{voxels, {{segment.name, 1, segment.color, segment.voxels}}};
          imaging::writeLabelFile(m_folder / "labels" / (segment.name + ".nii.gz"), one);
        });
  }

  void writeMeshes(const core::Progress& progress)
  {
    makeFolder(m_folder / "meshes");
    const core::PatientBox box = boxOf(m_grid);
    const auto& structures = m_phantom.structures();
    m_meshes.resize(structures.size());
    m_volumes.resize(structures.size());
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, structures.size(),
                      [&](std::size_t s)
                      {
                        progress.report(static_cast<double>(done.fetch_add(1)) /
                                            static_cast<double>(structures.size()),
                                        "measuring and writing surfaces");
                        m_volumes[s] = m_phantom.volume(s, box);
                        if (!structures[s].meshed)
                          return;
                        const core::TriangleMesh mesh = m_phantom.surface(s, box);
                        if (mesh.triangles.empty())
                          return; // outside a small grid
                        const std::string name = "meshes/" + structures[s].name + ".obj";
                        imaging::writeMesh(m_folder / name, mesh);
                        m_meshes[s] = {{"file", name},
                                       {"triangles", mesh.triangles.size()},
                                       {"volume_mm3", mesh.signedVolume()}};
                      });
  }

  bool inside(const PhantomStructure& structure) const
  {
    const core::PatientBox box = boxOf(m_grid);
    return box.contains(core::PatientBox(structure.lower, structure.upper));
  }

  void writeTruth() const
  {
    Json truth;
    truth["comment"] = "Analytic phantom of a right temporal bone; patient LPS, mm. 'transform' "
                       "(row-major) takes CT patient points to MR patient points. Volumes are of "
                       "the analytic shapes within the CT's grid, numeric to 0.1 %.";
    truth["seed"] = m_options.seed;
    truth["noise_hu"] = m_options.noise;
    truth["tilt_deg"] = m_options.tilt;
    truth["dims"] = m_grid.dims();
    truth["spacing_mm"] = list(m_grid.spacing());
    truth["origin_mm"] = list(m_grid.origin());
    truth["center_mm"] = list(Phantom::center());
    truth["mr"] = {{"dims", m_mrGrid.dims()},
                   {"spacing_mm", list(m_mrGrid.spacing())},
                   {"origin_mm", list(m_mrGrid.origin())}};
    const Eigen::Matrix4d motion = m_phantom.mrFromCt().matrix();
    truth["transform"] = Json::array();
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column)
        truth["transform"].push_back(motion(row, column));

    const auto& structures = m_phantom.structures();
    truth["structures"] = Json::array();
    for (std::size_t s = 0; s < structures.size(); ++s)
    {
      const volume::Segment& segment = m_segments[s];
      Json one;
      one["name"] = structures[s].name;
      one["index"] = segment.index;
      one["solid"] = structures[s].solid;
      one["color"] = structures[s].color;
      one["hu"] = structures[s].hounsfield;
      one["complete"] = inside(structures[s]); // false: cut off at the volume's border
      one["volume_mm3"] = m_volumes[s];
      one["label"] = segment.voxels > 0 ? Json("labels/" + segment.name + ".nii.gz") : Json();
      one["label_voxels"] = segment.voxels;
      one["label_volume_mm3"] = static_cast<double>(segment.voxels) * m_grid.voxelVolume();
      one["mesh"] = m_meshes[s];
      truth["structures"].push_back(std::move(one));
    }
    core::writeFile(m_folder / "truth.json", truth.dump(1) + "\n");
  }

  fs::path m_folder;
  SampleOptions m_options;
  Phantom m_phantom;
  core::GridGeometry m_grid;
  core::GridGeometry m_mrGrid;
  std::vector<volume::Segment> m_segments;
  std::vector<double> m_volumes; // mm^3
  std::vector<Json> m_meshes;
};

} // namespace

core::GridGeometry sampleGrid(const SampleOptions& options)
{
  check(options);
  const Eigen::Vector3d extent = Phantom::extent();
  double spacing = options.spacing.value_or(kDefaultSpacing);
  core::Index3 dims{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    const double wanted = std::round(extent[static_cast<Eigen::Index>(a)] / spacing);
    dims[a] = static_cast<int>(std::clamp(wanted, 16.0, 1024.0));
  }
  if (options.dims)
  {
    dims = *options.dims;
    if (!options.spacing)
    {
      const Eigen::Vector3d fit = extent.cwiseQuotient(Eigen::Vector3d(dims[0], dims[1], dims[2]));
      spacing = std::clamp(std::round(fit.maxCoeff() * 1e6) / 1e6, 0.05, 5.0);
    }
  }
  return centred(dims, Eigen::Vector3d::Constant(spacing), Phantom::center());
}

void writeSamplePatient(const fs::path& out, const SampleOptions& options,
                        const core::Progress& progress)
{
  check(options);
  core::OutputFolder staged(out);
  Writer(staged.path(), options).write(progress);
  progress.check("sample patient");
  staged.commit();
}

} // namespace petrous::phantom
