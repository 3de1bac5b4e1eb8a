#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "petrous/Volume/TissueField.h"

namespace petrous::volume
{

struct NearestSurface
{
  double distance = 0.0;                 ///< mm; negative in tissue
  Eigen::Vector3d point{0.0, 0.0, 0.0};  ///< on the surface, patient LPS mm
  Eigen::Vector3d normal{0.0, 0.0, 0.0}; ///< there, out of the tissue, patient axes
};

/// Search for the nearest point of the surface f = 0, on f itself.
///
/// The faces of the scan are not surface, whatever they intersect (Documentation/frames.md,
/// "Domain").
///
/// The grid is searched in blocks of cells, nearest first; the crossed cells of each block are
/// cached, so that repeated queries are cheap. The field must outlive the search and must not
/// change meanwhile. Unions with finer voxels than the CT's are sampled at their own resolution, so
/// that a thin mesh is found even where all CT voxel centres around it are in air; a wall of bone
/// or of the cut between two CT voxels is not. Calls TissueField::prepare for the regions that it
/// reads. Not thread-safe.
class NearestSurfaceSearch
{
public:
  /// reach  maximum search distance, mm
  NearestSurfaceSearch(const TissueField& field, double reach);

  /// Returns nullopt if no surface is within reach.
  std::optional<NearestSurface> find(const Eigen::Vector3d& patient)
  {
    return find(patient, m_reach);
  }

  /// For callers with a known upper bound of the distance.
  std::optional<NearestSurface> find(const Eigen::Vector3d& patient, double reach);

private:
  struct Candidate
  {
    double distance;
    core::Index3 block;
  };
  std::vector<Candidate> blocksWithinReach(const Eigen::Vector3d& patient, double reach) const;
  const std::vector<core::Index3>& crossedCells(const core::Index3& block);
  void prepareBlock(const core::IndexBox& corners) const;
  void markFine(const core::IndexBox& corners, bool* cells) const;

  const TissueField& m_field;
  double m_reach;
  int m_subdivisions; // of a cell, for the lattice that locates the surface in it
  std::unordered_map<std::uint64_t, std::vector<core::Index3>> m_crossed;
};

} // namespace petrous::volume
