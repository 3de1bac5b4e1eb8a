#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Core/PatientBox.h"
#include "petrous/Core/Progress.h"
#include "petrous/Core/RigidTransform.h"
#include "petrous/Core/TriangleMesh.h"
#include "petrous/Volume/LabelMap.h"
#include "petrous/Volume/Volume.h"

namespace petrous::phantom
{

/// Parameters of a phantom patient. The gross anatomy is fixed; the seed varies the pattern of the
/// mastoid cells and the patient's motion between the CT and the MR scanner.
struct PhantomRecipe
{
  std::uint64_t seed = 1;
  bool cholesteatoma = true;
};

/// One named structure. Structures never overlap: where shapes intersect, one of them is carved.
struct PhantomStructure
{
  std::string name;             ///< lower case with underscores, e.g. "facial_nerve"
  std::array<float, 3> color{}; ///< 0 to 1
  bool solid = true;            ///< false: a lumen (air)
  bool meshed = false;          ///< whether the sample patient has a surface mesh of it
  double hounsfield = 0.0;
  Eigen::Vector3d lower; ///< patient LPS mm; box around {signed distance <= 0}
  Eigen::Vector3d upper;
};

/// A vertex of a tube's axis.
struct AxisPoint
{
  Eigen::Vector3d position; ///< patient LPS mm
  double radius = 0.0;      ///< mm
};

/// Sample positions, not necessarily a rectangular grid: p_P = origin + step * index.
struct ScanGrid
{
  core::Index3 dims{1, 1, 1};
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();   ///< patient LPS mm
  Eigen::Matrix3d step = Eigen::Matrix3d::Identity(); ///< columns: mm per voxel along each axis

  ScanGrid() = default;
  ScanGrid(const core::GridGeometry& geometry); // NOLINT: any grid is a scan grid
};

/// An analytic right temporal bone of an adult in patient LPS mm, centred on center().
///
/// Every tissue is a signed distance (mm, negative inside, |gradient| about 1 near the surface),
/// painted in order, so each point has exactly one tissue. Immutable and thread-safe. The same
/// recipe gives the same phantom on every machine.
class Phantom
{
public:
  enum class Modality
  {
    Ct, ///< HU
    Mr  ///< T2-like, arbitrary units: fluid bright, bone and air dark
  };

  explicit Phantom(const PhantomRecipe& recipe = {});
  ~Phantom();
  Phantom(Phantom&&) noexcept;
  Phantom& operator=(Phantom&&) noexcept;

  const PhantomRecipe& recipe() const noexcept { return m_recipe; }
  static Eigen::Vector3d center() noexcept; ///< of the ear, patient LPS mm
  static Eigen::Vector3d extent() noexcept; ///< mm, extent of the ear along x, y, z

  double hounsfield(const Eigen::Vector3d& patient) const;
  double mrIntensity(const Eigen::Vector3d& patient) const; ///< at the patient position of the CT

  /// In the order of their label indices 1, 2, ...
  const std::vector<PhantomStructure>& structures() const noexcept { return m_structures; }
  std::size_t indexOf(const std::string& name) const; ///< throws InvalidParameter

  /// To the structure's surface as painted (carved by later layers), mm.
  double signedDistance(std::size_t structure, const Eigen::Vector3d& patient) const;
  double signedDistance(const std::string& name, const Eigen::Vector3d& patient) const;

  /// Distance to the cranial cavity, mm, positive in bone: distance from a drill to the dura.
  double distanceToCranialCavity(const Eigen::Vector3d& patient) const;

  /// mm^3 of the structure within a patient box, by adaptive quadrature of the signed distance
  /// (error about 0.1 %).
  double volume(std::size_t structure, const core::PatientBox& within) const;

  /// A closed surface oriented outwards, cut flat at the patient box, with vertices on the zero
  /// level of the signed distance. Sampled at `resolution` mm; 0: as fine as the structure's shape
  /// needs.
  core::TriangleMesh surface(std::size_t structure, const core::PatientBox& within,
                             double resolution = 0.0) const;

  /// Axis of the bony canal of the facial nerve, from the internal auditory canal to the
  /// stylomastoid foramen, with the radius of its lumen: a polyline, the same for every recipe.
  static std::vector<AxisPoint> facialCanalAxis();

  /// X_MR_CT: maps CT patient points to MR patient points, mm. Depends only on the seed.
  core::RigidTransform mrFromCt() const;

  struct Scene; ///< the painted shapes, PhantomScene.h
  const Scene& scene() const noexcept { return *m_scene; }

private:
  PhantomRecipe m_recipe;
  std::vector<PhantomStructure> m_structures;
  std::unique_ptr<const Scene> m_scene;
};

/// Acquisition parameters of a simulated scan.
struct ScanSettings
{
  Phantom::Modality modality = Phantom::Modality::Ct;
  double noise = 20.0; ///< standard deviation of white Gaussian noise, in the image's units
  /// Sigma of the Gaussian point spread, mm; negative: 0.75 voxel, at most 0.25 mm.
  double pointSpread = -1.0;
  std::uint64_t seed = 1;               ///< of the noise
  core::RigidTransform patientFromScan; ///< maps scan positions to phantom positions
};

/// Simulates a scan of the phantom: partial volume from the signed distances (exact for a plane
/// border), a separable Gaussian, then noise from a counter-based generator, so that the result
/// does not depend on the number of threads. Rounded to integers. Memory: the result plus a few
/// slices.
///
/// The volume has the geometry of `grid` if its axes are perpendicular. For a sheared grid (tilted
/// gantry) it has the in-plane axes and the spacing along the slice normal, and only the scan grid
/// defines the slice positions.
///
/// Throws CancelledError.
volume::Volume<std::int16_t> samplePhantom(const Phantom& phantom, const ScanGrid& grid,
                                           const ScanSettings& settings,
                                           const core::Progress& progress = {});

/// Every structure on one grid, index = position in structures() + 1; a voxel belongs to the
/// structure that contains its centre. Throws CancelledError.
volume::LabelMap labelPhantom(const Phantom& phantom, const core::GridGeometry& geometry,
                              const core::Progress& progress = {});

} // namespace petrous::phantom
