#pragma once

#include <optional>
#include <string>

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include "petrous/Interaction/ForceDisplay.h"
#include "petrous/Interaction/ToolView.h"

class vtkRenderer;
class vtkTextActor;

namespace petrous::workstation
{

/// Overlay of a tool in a renderer: its force, a line to the device pose, and what a pointer reads,
/// beside the force bar. Removed from the renderer on destruction.
class TouchOverlay
{
public:
  /// `form`: the tool; only its radius, handpiece (a pointer has none), finish and instrument
  /// count.
  TouchOverlay(vtkRenderer& renderer, const rendering::ToolPose& form);
  ~TouchOverlay();
  TouchOverlay(const TouchOverlay&) = delete;
  TouchOverlay& operator=(const TouchOverlay&) = delete;

  bool shows(const rendering::ToolPose& form) const noexcept; ///< a tool of this form
  const std::optional<rendering::ToolPose>& tool() const noexcept { return m_tool; }

  /// Returns true if the picture changed.
  bool update(const session::TickRecord& record);
  /// UTF-8, several lines; empty: no reading. Likewise.
  bool setReading(const std::string& text);
  /// What the surgeon must see now, UTF-8, several lines, at the upper edge; likewise.
  bool setWarning(const std::string& text);
  void setCovered(double share); ///< fraction of the height, from the top: warnings are below

private:
  vtkSmartPointer<vtkRenderer> m_renderer;
  rendering::ToolPose m_form;
  interaction::ToolView m_view;
  interaction::ForceDisplay m_force;
  vtkNew<vtkTextActor> m_reading;
  vtkNew<vtkTextActor> m_warning;
  std::string m_text, m_warningText;         // as shown
  std::optional<rendering::ToolPose> m_tool; // as last drawn
  double m_shownForce = 0.0;                 // N
  double m_shownLag = 0.0;                   // mm
};

} // namespace petrous::workstation
