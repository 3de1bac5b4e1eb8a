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

/// What there is at a place.
struct PlaceReading
{
  std::optional<double> hounsfield;  ///< nothing outside the CT
  std::string structure;             ///< that the place lies in; empty: none
  std::optional<double> surface;     ///< mm to the nearest surface of tissue as it is drilled now,
                                     ///< negative in tissue; nothing beyond kReach
  std::optional<NearStructure> near; ///< the nearest that is shown, where the place lies in none;
                                     ///< nothing beyond kReach
};

/// Reads a case at places, by the same rules as `petrous probe`. Holds for the tissue as it was at
/// the construction: a cut asks for a new one. One thread.
class PointProbe
{
public:
  static constexpr double kReach = 20.0; ///< mm, of the nearest surface

  /// field  of the case, which must outlive this as the case must
  /// Loads the labels and makes the voxels of meshes that have none yet, whatever their looks.
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
