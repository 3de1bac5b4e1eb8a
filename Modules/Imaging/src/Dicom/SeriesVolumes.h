#pragma once

#include <string>
#include <vector>

#include "petrous/Imaging/SeriesGeometry.h"

namespace petrous::imaging
{

/// Whether the directions of two placed slices agree at their corners.
bool sameTurn(const SliceHeader& a, const SliceHeader& b);
/// Whether two placed slices have the same pixels and field of view.
bool sameSize(const SliceHeader& a, const SliceHeader& b);
bool isLocalizer(const SliceHeader& slice); ///< says so
/// Whether the file states plausible position, orientation and spacing.
bool isPlaced(const SliceHeader& slice);

struct NamedSlices
{
  std::string name; ///< e.g. "echo 2", "b 1000"; distinct within the series
  std::vector<SliceHeader> slices;
  bool isSetAside =
      false; ///< too few of their orientation, size or place for a stack, beside several
};

/// The consistent stacks of a series of which several share their places, lie beside each other, or
/// differ in orientation, size or tilt. One unnamed entry holding all slices if it is one stack, or
/// if nothing in the headers tells its stacks apart. Slices of no stack stay with the largest,
/// where they become findings; those that differ from several stacks in orientation or size are set
/// aside.
std::vector<NamedSlices> splitVolumes(const std::vector<SliceHeader>& slices);

} // namespace petrous::imaging
