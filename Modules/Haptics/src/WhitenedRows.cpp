#include "WhitenedRows.h"

#include <cmath>

namespace petrous::haptics
{

WhitenedRows::WhitenedRows(std::size_t capacity)
  : normal(capacity, 6)
  , bound(capacity)
  , slack(capacity)
  , length(capacity)
  , row(capacity)
{
}

bool WhitenedRows::add(const Vector6& whitened, double limit, std::size_t callersRow) noexcept
{
  const double largest = whitened.cwiseAbs().maxCoeff();
  if (!(largest < kLongest))
    return false;
  const bool zero = largest < 1.0 / kLongest;
  const double norm = zero ? 1.0 : whitened.norm();
  if (!std::isfinite(limit / norm))
    return false;
  if (zero)
    normal.row(count).setZero();
  else
    normal.row(count) = whitened.transpose() / norm;
  bound[count] = limit / norm;
  length[count] = norm;
  row[count] = callersRow;
  ++count;
  return true;
}

} // namespace petrous::haptics
