#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include <vtkSmartPointer.h>

#include "SliceMarks.h"
#include "petrous/Rendering/SceneContents.h"

class vtkRenderer;

namespace petrous::workstation
{

/// Marks and measurements over a scene: lines and handles of constant width in pixels, in front of
/// everything, and labels that do not cover each other. Removed from the renderer on destruction.
class MeasureOverlay
{
public:
  explicit MeasureOverlay(vtkRenderer& renderer);
  ~MeasureOverlay();
  MeasureOverlay(const MeasureOverlay&) = delete;
  MeasureOverlay& operator=(const MeasureOverlay&) = delete;

  /// Returns true if the picture changed.
  bool set(const std::vector<DrawnMeasure>& measures);
  const std::vector<DrawnMeasure>& measures() const noexcept { return m_measures; }

  /// Draws it over what was added to the renderer since.
  void raise();

  /// Before each frame: what is behind the camera is not drawn, handles face the camera, and labels
  /// make room, also for other handles (patient, LPS mm). Where the tool is, a label is faint: burr
  /// and bone are seen through it.
  void place(const std::optional<rendering::ToolPose>& tool = std::nullopt,
             const std::vector<Eigen::Vector3d>& others = {});
  std::vector<Eigen::Vector3d> handles() const; ///< all of them

  /// Pixels from the upper left of the viewport; none behind the camera.
  std::optional<std::array<double, 2>> pixelOf(const Eigen::Vector3d& patient) const;

private:
  struct Drawn;
  void addProps();
  void removeProps();
  void placeHandles(const DrawnMeasure& measure, Drawn& drawn, double scale);
  struct Disc;
  std::vector<Disc> discsOf(const rendering::ToolPose& tool) const;
  vtkSmartPointer<vtkRenderer> m_renderer;
  std::vector<DrawnMeasure> m_measures;
  std::vector<std::unique_ptr<Drawn>> m_drawn;
};

} // namespace petrous::workstation
