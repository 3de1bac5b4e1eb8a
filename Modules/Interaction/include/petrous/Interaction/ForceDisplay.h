#pragma once

#include <memory>

#include "petrous/Simulation/TickRecord.h"

class vtkRenderer;

namespace petrous::interaction
{

/// How a force is shown.
struct ForceLook
{
  double millimetresPerNewton = 10.0; ///< of the arrow, in (0, 1000]
  double fullScale = 5.0; ///< N: the bar's end, and where the arrow grows no more; > 0.1
  double least = 0.02;    ///< N: below it there is no arrow, >= 0
  double thickness = 0.8; ///< mm of the arrow's shaft, in (0, 20]
  double pixels = 1.0; ///< of the screen for one of the bar's, in [0.25, 8]: dense screens want 2
};

/// The force on the hand, as an arrow at the tool and as a bar with its number in the lower left
/// corner: for hands that feel it, and for hands that cannot.
///
/// What is shown is the coupling's force before the device's limits, so a mouse has one as well;
/// where the servo gives none (fault, pause), and while a pointer's tool hovers, there is none. The arrow starts at the burr's centre
/// and points where the hand is pushed. It is drawn over tool and tissue, so that it is always
/// seen. Main thread only.
class ForceDisplay
{
public:
  /// Throws InvalidParameter naming the first bad value.
  explicit ForceDisplay(const ForceLook& look = {});
  ~ForceDisplay();
  ForceDisplay(const ForceDisplay&) = delete;
  ForceDisplay& operator=(const ForceDisplay&) = delete;

  void addTo(vtkRenderer* renderer) const;
  void removeFrom(vtkRenderer* renderer) const;

  void setLook(const ForceLook& look); ///< throws InvalidParameter
  void setArrowShown(bool shown);
  void setBarShown(bool shown);

  void update(const simulation::TickRecord& record);
  double force() const noexcept; ///< N, as shown

private:
  class Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

} // namespace petrous::interaction
