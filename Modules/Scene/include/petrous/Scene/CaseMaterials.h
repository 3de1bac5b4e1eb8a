#pragma once

#include "petrous/Dissection/Catalogues.h"
#include "petrous/Dissection/TissueResistance.h"
#include "petrous/Scene/Case.h"

namespace petrous::scene
{

/// What a burr of that kind meets in the case, place by place. A structure is of its look's tissue
/// (StructureAppearance::tissue); where structures overlap, the one with the lowest priority number
/// counts. Everything else is bone by its density: the catalogue's ramp, stretched to where bone
/// lies among the case's intensities. Loads the CT, and the labels and meshes that have a tissue.
/// Throws InvalidParameter that names the structure whose tissue there is no material for.
dissection::TissueResistance tissueResistance(const Case& value,
                                              const dissection::Catalogues& catalogues,
                                              dissection::Burr::Kind burr);

} // namespace petrous::scene
