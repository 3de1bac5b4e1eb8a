#pragma once

#include <memory>

#include "petrous/Session/TickRecord.h"

class vtkRenderer;

namespace petrous::interaction
{

/// How a force is displayed.
struct ForceLook
{
  double millimetresPerNewton = 3.0; ///< of the arrow, in (0, 1000]
  double fullScale = 5.0;            ///< N: end of the bar, and maximum of the arrow; > 0.1
  double least = 0.02;               ///< N: below it no arrow is shown, >= 0
  double thickness = 0.8;            ///< mm, of the arrow's shaft, in (0, 20]
  double pixels = 1.0;               ///< screen pixels per bar pixel, in [0.25, 8]: 2 for high-DPI
};

/// Displays the force on the hand as an arrow at the tool and as a bar with its value in the lower
/// left corner, with and without a force-feedback device.
///
/// Shows the coupling's force before the device's limits, so a mouse has one as well; none while
/// the servo renders none (fault, pause) or a pointer's tool hovers. The arrow starts at the burr's
/// centre and points in the direction of the force on the hand. It is drawn on top of tool and
/// tissue, so that it is always visible. Main thread only.
class ForceDisplay
{
public:
  /// Throws InvalidParameter naming the first invalid value.
  explicit ForceDisplay(const ForceLook& look = {});
  ~ForceDisplay();
  ForceDisplay(const ForceDisplay&) = delete;
  ForceDisplay& operator=(const ForceDisplay&) = delete;

  void addTo(vtkRenderer* renderer) const;
  void removeFrom(vtkRenderer* renderer) const;

  void setLook(const ForceLook& look); ///< throws InvalidParameter
  void setArrowShown(bool shown);
  void setBarShown(bool shown);

  void update(const session::TickRecord& record);
  double force() const noexcept; ///< N, as displayed

private:
  class Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

} // namespace petrous::interaction
