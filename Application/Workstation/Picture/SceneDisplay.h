#pragma once

#include <array>
#include <functional>
#include <memory>

#include <QElapsedTimer>
#include <QObject>
#include <QPointer>
#include <QSurfaceFormat>
#include <QTimer>

#include <vtkNew.h>

#include "petrous/Rendering/ScenePicture.h"
#include "petrous/Rendering/StereoPicture.h"

class vtkGenericOpenGLRenderWindow;
class vtkRenderer;

namespace petrous::session
{
struct TickRecord;
}

namespace petrous::workstation
{

class GhostOverlay;
class MeasureOverlay;
class TouchOverlay;
struct DrawnMeasure;

/// A scene in one OpenGL context: coarse while something moves and fine when static, mono or
/// stereo. Reports frame times and errors.
///
/// The fine picture is drawn in parts of kPart, between which events are handled, and shown as a
/// whole; after kStill it gets more rays a pixel. What is shown at rest does not become coarser by
/// what is drawn over it.
///
/// A second display can follow: it gets the same scene, camera and tool, with textures of its own,
/// since contexts of different windows are not shared here.
class SceneDisplay : public QObject
{
  Q_OBJECT
public:
  /// `shown`: whether rendering makes sense now.
  SceneDisplay(vtkGenericOpenGLRenderWindow& window, std::function<bool()> shown,
               QObject* parent = nullptr);
  ~SceneDisplay() override;

  /// Frees the context's resources; the context must be current. Call before the window is
  /// destroyed. Nothing is rendered afterwards.
  void release();

  rendering::ScenePicture& picture() noexcept { return m_picture; }
  const rendering::ScenePicture& picture() const noexcept { return m_picture; }

  /// Keeps light, background and tool. Throws RenderingError BadContents.
  void setContents(const rendering::SceneContents& contents);
  const rendering::SceneContents& contents() const noexcept { return m_contents; }
  void setLight(const rendering::LightSettings& light);
  void setBackground(const rendering::BackgroundColor& color);
  const rendering::BackgroundColor& background() const noexcept { return m_background; }
  void setTool(const std::optional<rendering::ToolPose>& tool);
  const std::optional<rendering::ToolPose>& tool() const noexcept { return m_contents.tool; }
  /// The tool with its force, from the servo; redrawn if it changed.
  void setTouch(const session::TickRecord& record, const rendering::ToolPose& form);
  /// What a pointer reads, several lines; after setTouch.
  void setReading(const QString& text);
  const QString& reading() const noexcept { return m_reading; }
  /// What the surgeon must see while using a tool, several lines; empty: nothing.
  void setWarning(const QString& text);
  /// Fraction of the picture's height, from the top, that is covered: warnings are placed below.
  void setCovered(double share);
  const QString& warning() const noexcept { return m_warning; }
  /// Marks and measurements over the scene.
  void setMeasures(const std::vector<DrawnMeasure>& measures);
  /// Outlines and handles over the scene that are dragged; not in the follower.
  void setHandles(const std::vector<DrawnMeasure>& handles);
  /// Calls `grab`, which must not throw, while the picture is drawn without them.
  void withoutHandles(const std::function<void()>& grab);
  /// Pixels from the upper left of the renderer's viewport, as drawn last; none behind the camera.
  std::optional<std::array<double, 2>> pixelOf(const Eigen::Vector3d& patient) const;
  /// A recorded tool beside the one in use; none: no ghost.
  void setGhost(const std::optional<rendering::ToolPose>& ghost);
  const std::optional<rendering::ToolPose>& ghost() const noexcept { return m_ghost; }
  void endTouch(); ///< no tool, no force, no reading, no warning
  void setCamera(const core::CameraPose& pose);
  void maskChanged(std::shared_ptr<const volume::CutMask> mask, const core::IndexBox& box);

  void setStereo(rendering::StereoMode mode, const rendering::StereoRig& rig);
  rendering::StereoMode stereo() const noexcept;
  const rendering::StereoPicture* stereoPicture() const noexcept { return m_stereo.get(); }
  void setFirstRow(int row); ///< see StereoPicture

  static constexpr double kPart = 30.0; ///< ms
  static constexpr int kStill = 1000;   ///< ms
  /// Rays a pixel of a picture that rests long; 1: those of the fine picture.
  void setSamples(int samples);
  bool isFine() const; ///< the last frame showed the picture at full resolution

  /// Synchronizes another display from now on; nullptr ends that.
  void setFollower(SceneDisplay* follower);

  /// Who tells, after each frame, whether the driver lost the context; at first the driver itself
  /// (GL_ARB_robustness).
  void setLossQuery(std::function<bool()> isLost);

  /// Renders soon; several calls are coalesced. `moving`: coarser until shortly after the last
  /// call.
  void redraw(bool moving = false);

signals:
  void aboutToDraw();
  /// Frame time; `scale`: of the picture's edge at which rays were cast.
  void drawn(double milliseconds, double scale, bool moving);
  void failed(const QString& why); ///< once, until a frame succeeds again

private:
  void drawNow();
  void refine();
  void refineSoon();
  void frameStarted();
  void frameEnded();
  void setRate();
  vtkGenericOpenGLRenderWindow& m_window;
  std::function<bool()> m_shown;
  std::function<bool()> m_isLost;
  vtkNew<vtkRenderer> m_renderer;
  rendering::ScenePicture m_picture;
  std::unique_ptr<rendering::StereoPicture> m_stereo; // destroyed before m_picture
  rendering::SceneContents m_contents;                // of the last setContents, kept up to date
  rendering::LightSettings m_light;
  rendering::BackgroundColor m_background = rendering::kDefaultBackground;
  std::unique_ptr<MeasureOverlay> m_measures; // destroyed before m_renderer
  std::unique_ptr<MeasureOverlay> m_handles;  // likewise
  std::unique_ptr<TouchOverlay> m_touch;      // while a tool is in use; destroyed before m_renderer
  std::unique_ptr<GhostOverlay> m_ghostOverlay; // destroyed before m_renderer
  std::optional<rendering::ToolPose> m_ghost;
  QString m_reading, m_warning;
  double m_covered = 0.0; // fraction of the height, from the top
  QPointer<SceneDisplay> m_follower;
  QTimer m_settle;
  QTimer m_refine;
  QTimer m_await; // until an instrument's shadow has been measured
  int m_samples;
  QElapsedTimer m_rests; // since the last motion
  QElapsedTimer m_clock;
  std::array<unsigned long, 2> m_observers{}; // of m_window
  double m_rate = 0.0;
  bool m_leads = false; // has a follower
  bool m_follows = false;
  bool m_moving = false;
  bool m_pending = false;
  bool m_failing = false;
};

/// The required surface format; must be set as default before the first widget. `stereo`:
/// quad-buffered, for StereoMode::QuadBuffer.
QSurfaceFormat surfaceFormat(bool stereo = false);

/// Whether the driver supports quad-buffered stereo. Queried on each call.
bool quadBufferOffered();

} // namespace petrous::workstation
