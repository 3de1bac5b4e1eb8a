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

namespace petrous::simulation
{
struct TickRecord;
}

namespace petrous::workstation
{

class TouchOverlay;

/// A scene in one OpenGL context: coarse while something moves and fine when it is still, for one
/// eye or two. Says how fast it was and what went wrong.
///
/// A second display can follow: it gets the same scene, camera and tool, with textures of its own,
/// since contexts of different windows share none here.
class SceneDisplay : public QObject
{
  Q_OBJECT
public:
  /// `shown`: whether drawing makes sense now.
  SceneDisplay(vtkGenericOpenGLRenderWindow& window, std::function<bool()> shown,
               QObject* parent = nullptr);
  ~SceneDisplay() override;

  /// Frees what the context holds, which must be current; to be called before the window goes.
  /// Nothing is drawn any more.
  void release();

  rendering::ScenePicture& picture() noexcept { return m_picture; }
  const rendering::ScenePicture& picture() const noexcept { return m_picture; }

  /// Light and tool stay. Throws RenderingError BadContents.
  void setContents(const rendering::SceneContents& contents);
  void setLight(const rendering::LightSettings& light);
  void setTool(const std::optional<rendering::ToolPose>& tool);
  const std::optional<rendering::ToolPose>& tool() const noexcept { return m_contents.tool; }
  /// The tool in the hand, with its force, as the servo has it; drawn where it moved.
  void setTouch(const simulation::TickRecord& record, double burrRadius, bool handpiece = true);
  /// What a pointer in the hand reads, some lines; after setTouch.
  void setReading(const QString& text);
  const QString& reading() const noexcept { return m_reading; }
  /// What the surgeon must see while the tool is in the hand, some lines; empty: nothing.
  void setWarning(const QString& text);
  /// What share of the picture, from above, lies under something else: warnings stand below.
  void setCovered(double share);
  const QString& warning() const noexcept { return m_warning; }
  void endTouch(); ///< no tool, no force, no reading, no warning
  void setCamera(const core::CameraPose& pose);
  void maskChanged(std::shared_ptr<const volume::CutMask> mask, const core::IndexBox& box);

  void setStereo(rendering::StereoMode mode, const rendering::StereoRig& rig);
  rendering::StereoMode stereo() const noexcept;
  rendering::StereoRig rig() const;
  void setFirstRow(int row); ///< see StereoPicture

  /// Brings another display up to date and keeps it so; null ends that.
  void setFollower(SceneDisplay* follower);

  /// Draws soon; several calls make one picture. `moving`: coarser until shortly after the last.
  void redraw(bool moving = false);

signals:
  void aboutToDraw();
  /// A frame took so long; `scale`: of the picture's edge at which rays were cast.
  void drawn(double milliseconds, double scale, bool moving);
  void failed(const QString& why); ///< once, until a frame succeeds again

private:
  void drawNow();
  void frameStarted();
  void frameEnded();
  void setRate();
  double scaleOfLastFrame() const;

  vtkGenericOpenGLRenderWindow& m_window;
  std::function<bool()> m_shown;
  vtkNew<vtkRenderer> m_renderer;
  rendering::ScenePicture m_picture;
  std::unique_ptr<rendering::StereoPicture> m_stereo; // ends before m_picture
  rendering::SceneContents m_contents;                // of the last setContents, brought up to date
  rendering::LightSettings m_light;
  std::unique_ptr<TouchOverlay>
      m_touch; // while there is a tool in the hand; ends before m_renderer
  QString m_reading, m_warning;
  double m_covered = 0.0; // of the height, from above
  QPointer<SceneDisplay> m_follower;
  QTimer m_settle;
  QElapsedTimer m_clock;
  std::array<unsigned long, 2> m_observers{}; // of m_window
  double m_rate = 0.0;
  bool m_leads = false; // of two displays
  bool m_follows = false;
  bool m_moving = false;
  bool m_pending = false;
  bool m_failing = false;
};

/// What a display's context is asked for; the default format must be this before the first widget.
/// `stereo`: two buffers, for StereoMode::QuadBuffer.
QSurfaceFormat surfaceFormat(bool stereo = false);

/// Whether the driver gives a context with two buffers. Asks it each time.
bool quadBufferOffered();

} // namespace petrous::workstation
