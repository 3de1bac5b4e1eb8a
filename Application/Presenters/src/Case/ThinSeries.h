#pragma once

#include <cstddef>

#include "petrous/Imaging/DicomScan.h"

namespace petrous::presenters
{

/// Every few of the slices, fewer than twice `count` of them, with the geometry of these: an uneven
/// step at the end is not straight.
imaging::DicomSeries thinSeries(const imaging::DicomSeries& series, std::size_t count);

} // namespace petrous::presenters
