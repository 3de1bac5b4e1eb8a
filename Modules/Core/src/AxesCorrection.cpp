#include "petrous/Core/AxesCorrection.h"

#include <Eigen/LU>

#include "petrous/Core/Error.h"

namespace petrous::core
{

namespace
{

constexpr char kPlus[] = {'L', 'P', 'S'};
constexpr char kMinus[] = {'R', 'A', 'I'};

/// Upper case, with S and I for the head and feet; 0: none of the six.
char directionOf(char letter)
{
  switch (letter)
  {
  case 'L':
  case 'l':
    return 'L';
  case 'R':
  case 'r':
    return 'R';
  case 'P':
  case 'p':
    return 'P';
  case 'A':
  case 'a':
    return 'A';
  case 'S':
  case 's':
  case 'H':
  case 'h':
    return 'S';
  case 'I':
  case 'i':
  case 'F':
  case 'f':
    return 'I';
  default:
    return 0;
  }
}

int axisOf(char direction)
{
  return direction == 'L' || direction == 'R' ? 0 : direction == 'P' || direction == 'A' ? 1 : 2;
}

bool isPlus(char direction)
{
  return direction == 'L' || direction == 'P' || direction == 'S';
}

} // namespace

AxesCorrection AxesCorrection::parse(std::string_view letters)
{
  AxesCorrection correction;
  std::array<int, 3> uses{};
  bool isGood = letters.size() == correction.m_letters.size();
  for (std::size_t n = 0; isGood && n < letters.size(); ++n)
  {
    const char direction = directionOf(letters[n]);
    correction.m_letters[n] = direction;
    isGood = direction != 0 && ++uses[static_cast<std::size_t>(axisOf(direction))] == 1;
  }
  if (!isGood)
    throw InvalidParameter("axes: '" + std::string(letters) +
                           "' is not one letter each of R or L, A or P, and S or I (H or F), such "
                           "as LPS (as the file states them) or RPS (left and right exchanged)");
  return correction;
}

bool AxesCorrection::isMirroring() const noexcept
{
  return matrix().determinant() < 0.0;
}

Eigen::Matrix3d AxesCorrection::matrix() const noexcept
{
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  for (std::size_t n = 0; n < m_letters.size(); ++n)
    matrix(axisOf(m_letters[n]), static_cast<int>(n)) = isPlus(m_letters[n]) ? 1.0 : -1.0;
  return matrix;
}

AxesCorrection AxesCorrection::of(const Eigen::Matrix3d& matrix) noexcept
{
  AxesCorrection correction;
  for (int n = 0; n < 3; ++n)
    for (int axis = 0; axis < 3; ++axis)
      if (matrix(axis, n) != 0.0)
        correction.m_letters[static_cast<std::size_t>(n)] =
            matrix(axis, n) > 0.0 ? kPlus[axis] : kMinus[axis];
  return correction;
}

AxesCorrection AxesCorrection::inverse() const noexcept
{
  return of(matrix().transpose());
}

AxesCorrection AxesCorrection::operator*(const AxesCorrection& other) const noexcept
{
  return of(matrix() * other.matrix());
}

GridGeometry AxesCorrection::applied(const GridGeometry& stated) const
{
  return applied(stated, stated.center());
}

GridGeometry AxesCorrection::applied(const GridGeometry& stated,
                                     const Eigen::Vector3d& center) const
{
  if (isIdentity())
    return stated;
  const Eigen::Matrix3d p = matrix();
  return {stated.dims(), stated.spacing(), center + p * (stated.origin() - center),
          p * stated.direction()};
}

} // namespace petrous::core
