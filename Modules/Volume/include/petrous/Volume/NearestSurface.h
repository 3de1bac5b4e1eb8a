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

/// Searches the nearest point of the surface f = 0, on f itself.
///
/// The faces of the scan are no surface, whatever they cut (Documentation/frames.md, "Domain").
///
/// The grid is looked at in blocks of cells, the nearest first; which cells of a block the surface
/// crosses is kept, so that many questions cost little. The field must outlive the search and must
/// not change meanwhile. Unions of finer voxels than the CT's are looked at themselves, so that a
/// thin mesh is seen where all of the CT's voxel centres around it lie in air; a wall of bone or of
/// the cut between two of them is not seen. Tells the field what it asks (TissueField::prepare).
/// Not thread-safe.
class NearestSurfaceSearch
{
public:
  /// reach  how far a surface is looked for, mm
  NearestSurfaceSearch(const TissueField& field, double reach);

  /// Nothing when no surface lies within reach.
  std::optional<NearestSurface> find(const Eigen::Vector3d& patient)
  {
    return find(patient, m_reach);
  }

  /// For who knows how far the surface is at most.
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
  int m_subdivisions; // of a cell, for the lattice that finds the surface in it
  std::unordered_map<std::uint64_t, std::vector<core::Index3>> m_crossed;
};

} // namespace petrous::volume
