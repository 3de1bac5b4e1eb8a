#include "WhitenedRows.h"

#include <cmath>

#include "petrous/Haptics/ContactQp.h"

namespace petrous::haptics
{

template <int N>
WhitenedRows<N>::WhitenedRows(std::size_t capacity)
  : normal(capacity, N)
  , bound(capacity)
  , slack(capacity)
  , length(capacity)
  , row(capacity)
{
}

template <int N>
bool WhitenedRows<N>::add(const Vector& whitened, double limit, std::size_t callersRow) noexcept
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

template struct WhitenedRows<ContactQp::kSize>;
template struct WhitenedRows<SharedContactQp::kSize>;

} // namespace petrous::haptics
