#pragma once

#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Imaging/DicomScan.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::imaging
{

/// The straight grid that a repairable series is resampled to, and how.
///
///   t_m = t_0 + m h                     place of slice m of the grid along the normal, mm
///   f(x, y, t_m) = (1 - w) s_a(x - u_a, y - v_a) + w s_b(x - u_b, y - v_b)
///
/// a and b are the true neighbours of t_m, w = (t_m - t_a) / (t_b - t_a), and (u, v) a slice's
/// sideways shift in pixels by its ImagePositionPatient alone. Both shear and spacing are undone by
/// linear interpolation; a shift along one axis interpolates along that axis only.
class SeriesRepair
{
public:
  explicit SeriesRepair(const SeriesGeometry& geometry);

  const core::GridGeometry& grid() const noexcept { return m_grid; }

  /// `stacked`: slice k holds the values of geometry.slices[k]. Returns `box` of the grid.
  /// Where no slice reaches lies `stacked`'s padding or smallest value.
  volume::IntensityVolume resample(const volume::IntensityVolume& stacked,
                                   const core::IndexBox& box, const core::Progress& progress) const;

  /// The slices of `box`, from its first on, that are interpolated between neighbours.
  std::vector<int> interpolated(const core::IndexBox& box) const;

  /// What was changed and guessed, one sentence each. Slices are numbered from 1, as in `box`.
  std::vector<std::string> notes(const core::IndexBox& box) const;

private:
  struct Slice
  {
    int index = 0;      ///< in `stacked`
    double place = 0.0; ///< t_k - t_0, mm
    double u = 0.0;     ///< pixels, relative to the grid's first column
    double v = 0.0;     ///< pixels, relative to the grid's first row
  };
  struct Blend
  {
    const Slice* a = nullptr;
    const Slice* b = nullptr;
    double weight = 0.0; ///< of b
  };
  Blend blendAt(int m) const;
  std::string blendNote(const core::IndexBox& box) const; ///< empty: nothing was interpolated
  std::string lossNote(const core::IndexBox& box) const;  ///< empty: all that was measured is there

  std::vector<Slice> m_slices; ///< without duplicates
  bool m_isUneven = false;
  bool m_isMissing = false; ///< and not uneven
  core::GridGeometry m_grid;
  std::vector<std::string> m_notes;
};

} // namespace petrous::imaging
