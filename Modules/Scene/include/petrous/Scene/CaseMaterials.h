#pragma once

#include "petrous/Dissection/Catalogues.h"
#include "petrous/Dissection/TissueResistance.h"
#include "petrous/Scene/Case.h"

namespace petrous::scene
{

/// Drilling resistance of the case's tissue for this burr. A structure has the tissue of its
/// appearance (StructureAppearance::tissue); where structures overlap, the lowest priority
/// number wins. Everything else is bone according to its density: the catalogue's ramp, rescaled to
/// the bone range of the case's intensities; of a case whose primary image is an MR, which shows no
/// density, it is soft tissue. Loads the CT, and the labels and meshes that have a
/// tissue. Throws InvalidParameter naming the structure for whose tissue there is no material, or
/// the burr if the catalogue has none of its name.
dissection::TissueResistance tissueResistance(const Case& value,
                                              const dissection::Catalogues& catalogues,
                                              const dissection::Burr& used);

} // namespace petrous::scene
