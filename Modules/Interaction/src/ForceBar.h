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

/// A vertical bar in the lower left corner, starting at 0, with a mark at 1 N and the force as text
/// above it.
class ForceBar
{
public:
  ForceBar();
  ~ForceBar();

  void addTo(vtkRenderer* renderer) const;
  void removeFrom(vtkRenderer* renderer) const;
  void setShown(bool shown);

  /// force      N
  /// fullScale  N at the top of the bar; larger forces fill it
  /// pixels     screen pixels per bar pixel
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
