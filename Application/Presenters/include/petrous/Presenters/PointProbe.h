#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Presenters/StructureSurfaces.h"
#include "petrous/Scene/Case.h"
#include "petrous/Scene/CaseField.h"
#include "petrous/Volume/NearestSurface.h"

namespace petrous::presenters
{

/// Values at a point.
struct PlaceReading
{
  std::optional<double> hounsfield;  ///< none outside the CT
  std::string structure;             ///< that contains the point; empty: none
  std::optional<double> surface;     ///< mm to the nearest surface of the tissue as drilled,
                                     ///< negative inside tissue; none beyond kReach
  std::optional<NearStructure> near; ///< the nearest visible one unless in one; none beyond kReach
  bool isNearKnown = true;           ///< false: the distances are still being measured
};

/// A wall of tissue at a point of its surface.
struct WallReading
{
  /// Where a way through the wall ends: at another structure, a cavity, or the air.
  struct End
  {
    Eigen::Vector3d point{0.0, 0.0, 0.0}; ///< patient LPS mm
    std::string behind; ///< the structure or lumen there; empty: none is known, a cavity
  };
  Eigen::Vector3d surface{0.0, 0.0, 0.0}; ///< where it begins, patient LPS mm
  Eigen::Vector3d inward{0.0, 0.0, 1.0};  ///< unit, along the normal
  std::optional<End> along;               ///< the normal; none within kThickest
  /// Of all straight ways within kTilt of the normal; none if `along` is none.
  std::optional<End> shortest;
};

/// Evaluates a case at points, as `petrous probe` does. Valid for the tissue at construction:
/// create a new one after drilling. Not thread-safe.
class PointProbe
{
public:
  static constexpr double kReach = 20.0; ///< mm, search distance for the nearest surface

  /// field  of the case; both must outlive this
  /// Loads the labels and voxelizes meshes that have no voxels yet, visible or not.
  PointProbe(const scene::Case& value, const volume::TissueField& field);

  PlaceReading at(const Eigen::Vector3d& patient); ///< LPS mm

  static constexpr double kThickest = 30.0; ///< mm, of a wall
  static constexpr double kTilt = 75.0;     ///< degrees
  /// The wall at the surface nearest to the point; none if that is farther than 3 mm. A structure
  /// that contains the surface is part of the wall, as a labelled temporal bone is; so are the
  /// partitions in a lumen.
  std::optional<WallReading> wall(const Eigen::Vector3d& patient,
                                  const core::Progress& progress = {});

private:
  struct Labels
  {
    std::shared_ptr<const volume::LabelMap> map;
    std::vector<scene::StructurePart> structures;
  };
  std::string structureAt(const Eigen::Vector3d& patient) const;
  std::optional<WallReading::End> wayOut(const Eigen::Vector3d& from,
                                         const Eigen::Vector3d& direction, double reach,
                                         const std::string& own);
  const volume::Volume<float>* occupancyOf(const std::string& structure);

  const scene::Case& m_value;
  const volume::TissueField& m_field;
  std::shared_ptr<const volume::IntensityVolume> m_ct;
  std::vector<Labels> m_labels;
  std::vector<scene::MeshSolid> m_meshes;
  volume::NearestSurfaceSearch m_surface;
  std::map<std::string, std::shared_ptr<const volume::Volume<float>>> m_occupancies;
};

} // namespace petrous::presenters
