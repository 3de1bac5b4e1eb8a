#pragma once

#include <memory>
#include <string>
#include <vector>

#include "petrous/Dissection/Stroke.h"
#include "petrous/Volume/LabelMap.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::dissection
{

/// A structure whose removed volume is measured.
struct NamedStructure
{
  std::string name;
  std::shared_ptr<const volume::LabelMap> labels;
  std::uint16_t index = 0;
};

struct RemovedVolume
{
  double total = 0.0;                       ///< mm^3 removed from {f > 0}
  std::vector<TouchedStructure> structures; ///< those with a removed volume above 0
};

/// The bricks of which two masks of one grid hold other versions.
std::vector<std::size_t> changedBricks(const volume::CutMask& before, const volume::CutMask& after);

/// Volume removed from {f > 0} between two masks, by quadrature of the interpolated fields with 4^3
/// points per cell, each weighted by the occupancy of its sub-cell in tissue and mask
/// (Documentation/adr/0011). `bricks` are those in which the masks differ. `tissue` is evaluated
/// before any mask.
RemovedVolume measureRemoved(const volume::TissueField& tissue, const volume::CutMask& before,
                             const volume::CutMask& after, const std::vector<std::size_t>& bricks,
                             const std::vector<NamedStructure>& structures);

} // namespace petrous::dissection
