#pragma once

#include "SimulatedPairs.h"
#include "petrous/Core/Progress.h"

namespace petrous::cli
{

/// The built-in phantom as a body for simulated pairs: T2 from its shapes, T1 from its HU.
registration::SimulationBody phantomBody(bool quick, const core::Progress& progress);

/// A phantom patient as created by `petrous sample`: CT, MR of 0.6 x 0.6 x 0.8 mm sampled from the
/// analytic shapes, and the motion between them. The target is the ear's centre.
registration::RegistrationPair phantomPair(std::uint64_t seed, bool quick,
                                           const core::Progress& progress);

} // namespace petrous::cli
