#pragma once

#include <array>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include "petrous/Core/GridGeometry.h"

namespace petrous::core
{

/// The correction of axes that a file states wrongly: a signed permutation of the patient's axes.
///
/// Written as three letters, where that really points which the file calls left, posterior and
/// superior: "LPS" corrects nothing, "RPS" is of a file that is mirrored, "LPI" of one whose head
/// and feet are exchanged. One of determinant -1 mirrors, as a mirrored file needs it.
///
///   p = c + P (q - c)      p, q: patient points as they are and as the file states them, LPS mm
///
/// c is the centre of the image's grid, which stays.
class AxesCorrection
{
public:
  AxesCorrection() = default; ///< "LPS"

  /// R or L, A or P, S (or H) or I (or F), each axis once, in any case. Throws InvalidParameter.
  static AxesCorrection parse(std::string_view letters);

  std::string letters() const { return {m_letters.begin(), m_letters.end()}; }

  /// Where that really points which the file calls left (0), posterior (1) or superior (2): one of
  /// R, L, A, P, S and I.
  char letter(std::size_t axis) const { return m_letters.at(axis); }

  bool isIdentity() const noexcept { return *this == AxesCorrection(); }
  bool isMirroring() const noexcept; ///< its determinant is -1

  Eigen::Matrix3d matrix() const noexcept; ///< P
  AxesCorrection inverse() const noexcept;

  /// The grid as it is, of one as its file states it: about its centre, or about `center`.
  GridGeometry applied(const GridGeometry& stated) const;
  GridGeometry applied(const GridGeometry& stated, const Eigen::Vector3d& center) const;

  /// First `other`, then this.
  AxesCorrection operator*(const AxesCorrection& other) const noexcept;

  bool operator==(const AxesCorrection& other) const noexcept
  {
    return m_letters == other.m_letters;
  }
  bool operator!=(const AxesCorrection& other) const noexcept { return !(*this == other); }

private:
  static AxesCorrection of(const Eigen::Matrix3d& matrix) noexcept;

  std::array<char, 3> m_letters{'L', 'P', 'S'};
};

} // namespace petrous::core
