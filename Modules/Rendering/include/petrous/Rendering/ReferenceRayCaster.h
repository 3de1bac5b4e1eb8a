#pragma once

#include <array>
#include <memory>
#include <vector>

#include "petrous/Core/CameraPose.h"
#include "petrous/Core/Progress.h"
#include "petrous/Rendering/Picture.h"
#include "petrous/Rendering/SceneContents.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::rendering
{

/// The ray through a pixel's centre, patient LPS mm.
struct PixelRay
{
  Eigen::Vector3d origin;    ///< perspective: the camera; parallel: on the camera's plane
  Eigen::Vector3d direction; ///< unit
};

/// Rays of a camera for a picture of width x height, rows from the top. The angle is vertical and
/// the parallel scale half the height; pixels are square.
class PixelRays
{
public:
  /// Throws InvalidParameter for a camera without direction, up or extent.
  PixelRays(const core::CameraPose& camera, int width, int height);
  PixelRay through(double column, double row) const; ///< 0, 0 is the centre of the first pixel

private:
  core::CameraPose m_camera;
  Eigen::Vector3d m_right;
  Eigen::Vector3d m_down;
  Eigen::Vector3d m_forward;
  double m_pixel; // edge of a pixel at distance 1 mm (perspective), or in mm
  double m_centerColumn;
  double m_centerRow;
};

struct ReferencePicture
{
  Picture picture;
  DepthImage depth;
};

/// The truth that pictures are held against: the first surface of f along each pixel's ray, in
/// double precision, by constant small steps and bisection, without skipping or early end.
///
/// Only the CPU is used. Lit like the picture: a lamp at the camera. A point that lies inside a
/// shown structure of `contents` has that structure's colour. Translucency is not drawn: f has
/// one first surface.
class ReferenceRayCaster
{
public:
  /// The field must outlive the caster; `contents` gives iso, structures and light.
  ReferenceRayCaster(const volume::TissueField& field, const SceneContents& contents);
  ~ReferenceRayCaster();

  /// Throws RenderingError BadSize, InvalidParameter, CancelledError.
  ReferencePicture render(const core::CameraPose& camera, int width, int height,
                          const core::Progress& progress = {}) const;

private:
  struct Structure
  {
    std::shared_ptr<const volume::Volume<float>> inside;
    std::array<float, 3> color;
  };
  Eigen::Vector3d colorAt(const Eigen::Vector3d& patient, const Eigen::Vector3d& normal) const;

  const volume::TissueField& m_field;
  SceneContents m_contents;
  std::vector<Structure> m_structures;
};

} // namespace petrous::rendering
