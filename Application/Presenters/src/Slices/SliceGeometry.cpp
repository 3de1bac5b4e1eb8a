#include "petrous/Presenters/SliceGeometry.h"

#include <algorithm>
#include <cmath>

#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Interaction/OrbitCamera.h"

namespace petrous::presenters
{

namespace
{
constexpr double kMargin = 1.04;
} // namespace

SliceAxes axesOf(SliceOrientation orientation)
{
  const Eigen::Vector3d left = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d posterior = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d superior = Eigen::Vector3d::UnitZ();
  switch (orientation)
  {
  case SliceOrientation::Axial:
    return {left, posterior, superior};
  case SliceOrientation::Coronal:
    return {left, -superior, posterior};
  case SliceOrientation::Sagittal:
    break;
  }
  return {posterior, -superior, left};
}

const char* nameOf(SliceOrientation orientation)
{
  return orientation == SliceOrientation::Axial     ? "Axial"
         : orientation == SliceOrientation::Coronal ? "Coronal"
                                                    : "Sagittal";
}

SliceGeometry::SliceGeometry(SliceOrientation orientation, const Eigen::Vector3d& center,
                             double mmPerPixel, int width, int height)
  : SliceGeometry(orientation, axesOf(orientation), center, mmPerPixel, width, height)
{
}

SliceGeometry::SliceGeometry(SliceOrientation orientation, const SliceAxes& axes,
                             const Eigen::Vector3d& center, double mmPerPixel, int width,
                             int height)
  : m_orientation(orientation)
  , m_axes(axes)
  , m_center(center)
  , m_mmPerPixel(mmPerPixel)
  , m_width(width)
  , m_height(height)
{
  if (!(mmPerPixel > 0.0) || width < 1 || height < 1)
    throw core::InvalidParameter("slice: a picture of " + std::to_string(width) + " x " +
                                 std::to_string(height) + " pixels of " +
                                 core::plainText(mmPerPixel) + " mm; all must be above 0");
}

SliceGeometry SliceGeometry::fitting(SliceOrientation orientation, const core::GridGeometry& grid,
                                     const Eigen::Vector3d& through, int width, int height)
{
  return fitting(orientation, axesOf(orientation), grid, through, width, height);
}

SliceGeometry SliceGeometry::fitting(SliceOrientation orientation, const SliceAxes& axes,
                                     const core::GridGeometry& grid, const Eigen::Vector3d& through,
                                     int width, int height)
{
  const core::PatientBox bounds = grid.patientBounds();
  const Eigen::Vector3d extent = bounds.sizes();
  const double across = extent.dot(axes.right.cwiseAbs());
  const double down = extent.dot(axes.down.cwiseAbs());
  const double mmPerPixel =
      std::max({kMargin * across / width, kMargin * down / height, 1e-3 * grid.minSpacing()});
  const Eigen::Vector3d middle = bounds.center();
  const Eigen::Vector3d center = middle + axes.next * axes.next.dot(through - middle);
  return {orientation, axes, center, mmPerPixel, width, height};
}

Eigen::Vector3d SliceGeometry::patientFromPixel(double column, double row) const
{
  return m_center + m_mmPerPixel * ((column - 0.5 * (m_width - 1)) * m_axes.right +
                                    (row - 0.5 * (m_height - 1)) * m_axes.down);
}

Eigen::Vector2d SliceGeometry::pixelFromPatient(const Eigen::Vector3d& patient) const
{
  const Eigen::Vector3d offset = (patient - m_center) / m_mmPerPixel;
  return {offset.dot(m_axes.right) + 0.5 * (m_width - 1),
          offset.dot(m_axes.down) + 0.5 * (m_height - 1)};
}

SliceGeometry::EdgeLetters SliceGeometry::edgeLetters() const
{
  using interaction::directionLetters;
  return {directionLetters(-m_axes.right), directionLetters(m_axes.right),
          directionLetters(-m_axes.down), directionLetters(m_axes.down)};
}

double scaleBarLength(double longest)
{
  if (!(longest > 0.0))
    return 0.0;
  const double decade = std::pow(10.0, std::floor(std::log10(longest)));
  for (const double step : {5.0, 2.0})
    if (step * decade <= longest)
      return step * decade;
  return decade;
}

SliceGeometry zoomed(const SliceGeometry& whole, double zoom, const Eigen::Vector3d& offset)
{
  const SliceAxes& axes = whole.axes();
  const Eigen::Vector3d inPlane = offset - axes.next.dot(offset) * axes.next;
  return {whole.orientation(),       axes,          whole.center() + inPlane,
          whole.mmPerPixel() / zoom, whole.width(), whole.height()};
}

} // namespace petrous::presenters
