#pragma once

#include <array>
#include <string>

#include <Eigen/Core>

#include <vtkNew.h>

class vtkActor2D;
class vtkPoints;
class vtkRenderer;
class vtkTextActor;

namespace petrous::interaction
{

/// An upright bar in the lower left corner of the picture, 0 at its foot, with a mark at 1 N and
/// the force in words above it.
class ForceBar
{
public:
  ForceBar();
  ~ForceBar();

  void addTo(vtkRenderer* renderer) const;
  void removeFrom(vtkRenderer* renderer) const;
  void setShown(bool shown);

  /// force      N
  /// fullScale  N at the bar's top; what is more fills it
  /// pixels     of the screen for one of the bar's
  void show(double force, double fullScale, double pixels, const Eigen::Vector3d& color);

private:
  enum Part
  {
    Filled,
    Empty,
    Mark,
    kParts
  };
  void place(Part part, double left, double bottom, double right, double top);

  std::array<vtkNew<vtkPoints>, kParts> m_corners;
  std::array<vtkNew<vtkActor2D>, kParts> m_actors;
  vtkNew<vtkTextActor> m_text;
  std::string m_words;
};

} // namespace petrous::interaction
