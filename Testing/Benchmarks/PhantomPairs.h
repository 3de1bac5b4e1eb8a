#pragma once

#include "SimulatedPairs.h"
#include "petrous/Core/Progress.h"

namespace petrous::cli
{

/// The built-in phantom as a body to draw pairs from: its T2 from its own shapes, its T1 from its
/// HU.
registration::SimulationBody phantomBody(bool quick, const core::Progress& progress);

/// A phantom patient as `petrous sample` makes it: CT, MR of 0.6 x 0.6 x 0.8 mm sampled from the
/// shapes themselves, and the motion between them. The target is the ear's middle.
registration::RegistrationPair phantomPair(std::uint64_t seed, bool quick,
                                           const core::Progress& progress);

} // namespace petrous::cli
