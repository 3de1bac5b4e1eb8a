#pragma once

#include <memory>
#include <string>
#include <vector>

#include "petrous/Dissection/Stroke.h"
#include "petrous/Volume/LabelMap.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::dissection
{

/// A structure of which a stroke may take something.
struct NamedStructure
{
  std::string name;
  std::shared_ptr<const volume::LabelMap> labels;
  std::uint16_t index = 0;
};

struct RemovedVolume
{
  double total = 0.0;                       ///< mm^3 lost from {f > 0}
  std::vector<TouchedStructure> structures; ///< of which more than nothing was taken
};

/// Volume lost from {f > 0} between two masks, by quadrature of the interpolated fields with 4^3
/// points a cell, each of which counts by how much of its part is tissue and is left
/// (Documentation/adr/0011). `bricks` are those in which the masks differ. `tissue` is asked for f
/// before any mask.
RemovedVolume measureRemoved(const volume::TissueField& tissue, const volume::CutMask& before,
                             const volume::CutMask& after, const std::vector<std::size_t>& bricks,
                             const std::vector<NamedStructure>& structures);

} // namespace petrous::dissection
