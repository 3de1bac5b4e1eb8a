#pragma once

#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Presenters/Measuring.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/CutMask.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::presenters
{

class StructureSurfaces;
struct SurfaceUncertainty;

/// How near what was drilled came to a structure.
struct DissectionDistance
{
  std::string name;
  Quantity distance;    ///< mm; 0: reached
  double removed = 0.0; ///< mm^3 removed from it by the finished strokes, as they recorded it
  Eigen::Vector3d place{0.0, 0.0, 0.0}; ///< of the tissue removed, patient LPS mm
  /// The point of the structure's surface that is nearest to `place`; where it was reached,
  /// `place`.
  Eigen::Vector3d onStructure{0.0, 0.0, 0.0};
};

/// Half-width of the distance of what was drilled from a structure: of its surface, and of half the
/// longest edge of the CT's voxels for the wall, independently; none where the former is unknown.
std::optional<double> wallUncertainty(const scene::Case& value, const SurfaceUncertainty& surface);

/// The tissue that a mask takes away, as points: the centres of its voxels, and its walls on the
/// edges between them, where the remaining fraction is one half, linearly. Where the burr was in
/// air nothing was removed.
class RemovedTissue
{
public:
  /// `tissue`: before any mask. Throws CancelledError.
  RemovedTissue(const volume::TissueField& tissue, const volume::CutMask& mask,
                const core::Progress& progress = {});

  bool empty() const noexcept { return m_cells.empty(); }

  struct Nearest
  {
    double distance; ///< mm, from the structure's surface; 0: reached
    Eigen::Vector3d place;
  };
  /// None if nothing was removed. Throws CancelledError.
  std::optional<Nearest> nearest(StructureSurfaces& surfaces, std::size_t structure,
                                 const core::Progress& progress = {}) const;

private:
  struct Cell
  {
    std::vector<Eigen::Vector3d> points; // patient LPS mm
    Eigen::Vector3d center{0.0, 0.0, 0.0};
    double radius = 0.0; // mm, around `center`
  };
  static void addPoints(const volume::TissueField& tissue, const volume::CutMask& mask,
                        const core::Index3& voxel, std::vector<Eigen::Vector3d>& points);
  static std::vector<Cell> cellsOf(const volume::TissueField& tissue, const volume::CutMask& mask,
                                   const core::IndexBox& box);

  std::vector<Cell> m_cells;
};

/// The distance of the tissue removed (RemovedTissue) from each structure that is drawn or
/// touchable as a volume, nearest first.
///
/// The uncertainty is wallUncertainty. Loads the CT and labels; needs the dissection loaded, else
/// throws InvalidParameter. Empty where nothing was removed. Throws CancelledError.
std::vector<DissectionDistance> dissectionDistances(const scene::Case& value,
                                                    const core::Progress& progress = {});

} // namespace petrous::presenters
