#pragma once

#include <Eigen/Core>

#include <vtkNew.h>

class vtkActor;
class vtkArrowSource;

namespace petrous::interaction
{

/// An arrow whose thickness is independent of its length. Drawn on top of all opaque geometry and
/// tissue.
class ForceArrow
{
public:
  ForceArrow();
  ~ForceArrow();

  vtkActor* actor() const { return m_actor; }

  void hide();

  /// from, along  patient mm; |along| > 0 is the arrow's length
  /// thickness    mm, of its shaft; less for a short arrow
  void show(const Eigen::Vector3d& from, const Eigen::Vector3d& along, double thickness,
            const Eigen::Vector3d& color);

private:
  vtkNew<vtkArrowSource> m_source;
  vtkNew<vtkActor> m_actor;
};

} // namespace petrous::interaction
