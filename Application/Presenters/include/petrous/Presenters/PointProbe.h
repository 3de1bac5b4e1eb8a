#pragma once

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

private:
  struct Labels
  {
    std::shared_ptr<const volume::LabelMap> map;
    std::vector<scene::StructurePart> structures;
  };
  std::string structureAt(const Eigen::Vector3d& patient) const;

  std::shared_ptr<const volume::IntensityVolume> m_ct;
  std::vector<Labels> m_labels;
  std::vector<scene::MeshSolid> m_meshes;
  volume::NearestSurfaceSearch m_surface;
};

} // namespace petrous::presenters
