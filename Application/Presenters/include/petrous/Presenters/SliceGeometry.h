#pragma once

#include <array>
#include <string>

#include "petrous/Core/GridGeometry.h"

namespace petrous::presenters
{

enum class SliceOrientation
{
  Axial,
  Coronal,
  Sagittal
};

/// Unit vectors in the patient (LPS), perpendicular to each other: along a picture's rows to the
/// right, along its columns down, and towards the next slice.
struct SliceAxes
{
  Eigen::Vector3d right;
  Eigen::Vector3d down;
  Eigen::Vector3d next;
};
SliceAxes axesOf(SliceOrientation orientation);   ///< the next slice is S, P or L
const char* nameOf(SliceOrientation orientation); ///< "Axial", ...

/// The part of the patient shown by a slice picture; a value type.
///
/// Slices are aligned with the patient's axes (LPS), whatever the scanner's, or turned from there
/// (SlicePlanes). Radiological convention: the patient's right is on the picture's left (axial,
/// coronal) and anterior on its left (sagittal); superior, or anterior for axial slices, is up.
/// Pixel centres are integers.
class SliceGeometry
{
public:
  /// `center` is the patient point (LPS mm) in the middle of the picture, on the slice. Throws
  /// InvalidParameter unless the sizes are positive.
  SliceGeometry(SliceOrientation orientation, const Eigen::Vector3d& center, double mmPerPixel,
                int width, int height);

  /// Of a plane that was turned from the one of `orientation`.
  SliceGeometry(SliceOrientation orientation, const SliceAxes& axes, const Eigen::Vector3d& center,
                double mmPerPixel, int width, int height);

  /// The slice through `through` that shows all of `grid`, centred, with a narrow margin.
  static SliceGeometry fitting(SliceOrientation orientation, const core::GridGeometry& grid,
                               const Eigen::Vector3d& through, int width, int height);
  static SliceGeometry fitting(SliceOrientation orientation, const SliceAxes& axes,
                               const core::GridGeometry& grid, const Eigen::Vector3d& through,
                               int width, int height);

  /// From which the plane was turned, if it was: axes() tell where it lies.
  SliceOrientation orientation() const noexcept { return m_orientation; }
  const SliceAxes& axes() const noexcept { return m_axes; }
  const Eigen::Vector3d& center() const noexcept { return m_center; }
  double mmPerPixel() const noexcept { return m_mmPerPixel; }
  int width() const noexcept { return m_width; }
  int height() const noexcept { return m_height; }

  Eigen::Vector3d patientFromPixel(double column, double row) const;
  Eigen::Vector2d
  pixelFromPatient(const Eigen::Vector3d& patient) const; ///< projected onto the slice

  /// Letters of the patient directions at the picture's left, right, top and bottom edge; several,
  /// the strongest first, in a plane that was turned.
  struct EdgeLetters
  {
    std::string left, right, top, bottom;
  };
  EdgeLetters edgeLetters() const;

private:
  SliceOrientation m_orientation;
  SliceAxes m_axes;
  Eigen::Vector3d m_center;
  double m_mmPerPixel;
  int m_width;
  int m_height;
};

/// The slice enlarged, its centre moved by `offset`, patient LPS mm. What of the offset is across
/// the slice's plane, one saved with other axes, is dropped: the depth stays that of `whole`.
SliceGeometry zoomed(const SliceGeometry& whole, double zoom, const Eigen::Vector3d& offset);

/// Length of a scale bar, mm: the largest of 1, 2, 5, 10, 20, ... not exceeding `longest` mm.
double scaleBarLength(double longest);

} // namespace petrous::presenters
