#include "NormalizedConstraints.h"

#include <cmath>

#include "petrous/Haptics/ContactQp.h"

namespace petrous::haptics
{

template <int N>
NormalizedConstraints<N>::NormalizedConstraints(std::size_t capacity)
  : normal(capacity, N)
  , bound(capacity)
  , slack(capacity)
  , length(capacity)
  , row(capacity)
{
}

template <int N>
bool NormalizedConstraints<N>::add(const Vector& whitened, double limit,
                                   std::size_t callersRow) noexcept
{
  const double largest = whitened.cwiseAbs().maxCoeff();
  if (!(largest < kMaxLength))
    return false;
  const bool zero = largest < 1.0 / kMaxLength;
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

template struct NormalizedConstraints<ContactQp::kSize>;
template struct NormalizedConstraints<SharedContactQp::kSize>;

} // namespace petrous::haptics
