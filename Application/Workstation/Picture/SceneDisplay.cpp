#include "SceneDisplay.h"

#include <algorithm>
#include <utility>

#include <QOpenGLContext>

#include <QVTKOpenGLNativeWidget.h>
#include <vtkCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkRenderer.h>

#include "Application.h"
#include "GhostOverlay.h"
#include "MeasureOverlay.h"
#include "Theme.h"
#include "TouchOverlay.h"
#include "petrous/Core/Error.h"
#include "petrous/Rendering/PixelSamples.h"

namespace petrous::workstation
{

namespace
{
constexpr int kSettle = 150;   // ms
constexpr int kAwait = 100;    // ms, from frame to frame
constexpr double kRate = 30.0; // Hz, target frame rate
// A machine that takes so long for a picture gets as long a pause after each part of more samples.
constexpr double kSlow = 500.0; // ms

// A GPU reset (after a driver update or hang) loses all textures.
bool contextLost()
{
  QOpenGLContext* context = QOpenGLContext::currentContext();
  if (!context)
    return false;
  if (!context->isValid())
    return true;
  for (const char* name : {"glGetGraphicsResetStatus", "glGetGraphicsResetStatusARB"})
    if (const auto address = context->getProcAddress(name))
      return reinterpret_cast<unsigned (*)()>(address)() != 0;
  return false;
}
} // namespace

SceneDisplay::SceneDisplay(vtkGenericOpenGLRenderWindow& window, std::function<bool()> shown,
                           QObject* parent)
  : QObject(parent)
  , m_window(window)
  , m_shown(std::move(shown))
  , m_isLost(contextLost)
  , m_samples(rendering::kPixelSamples)
{
  m_window.SetMultiSamples(0);
  m_window.AddRenderer(m_renderer);
  m_picture.setContents({});
  m_picture.setProgressive(true);
  m_picture.attach(m_renderer);
  m_stereo = std::make_unique<rendering::StereoPicture>(m_picture);
  m_measures = std::make_unique<MeasureOverlay>(*m_renderer);
  m_handles = std::make_unique<MeasureOverlay>(*m_renderer);
  m_observers = {m_window.AddObserver(vtkCommand::StartEvent, this, &SceneDisplay::frameStarted),
                 m_window.AddObserver(vtkCommand::EndEvent, this, &SceneDisplay::frameEnded)};
  m_settle.setSingleShot(true);
  m_settle.setInterval(kSettle);
  connect(&m_settle, &QTimer::timeout, this,
          [this]
          {
            m_moving = false;
            m_picture.setInteractive(false);
            refineSoon();
          });
  m_refine.setSingleShot(true);
  connect(&m_refine, &QTimer::timeout, this, &SceneDisplay::refine);
  m_await.setSingleShot(true);
  m_await.setInterval(kAwait);
  connect(&m_await, &QTimer::timeout, this, [this] { redraw(); });
  m_rests.start();
  setRate();
}

SceneDisplay::~SceneDisplay() = default;

void SceneDisplay::release()
{
  m_settle.stop();
  m_refine.stop();
  m_await.stop();
  for (const unsigned long observer : m_observers)
    m_window.RemoveObserver(observer);
  m_shown = [] { return false; };
  m_measures.reset();
  m_handles.reset();
  m_touch.reset();
  m_ghostOverlay.reset();
  m_stereo.reset();
  m_picture.attach(nullptr);
}

void SceneDisplay::setLossQuery(std::function<bool()> isLost)
{
  m_isLost = isLost ? std::move(isLost) : contextLost;
}

// The frame time is divided between eyes and windows.
void SceneDisplay::setRate()
{
  const bool both = stereo() != rendering::StereoMode::None;
  const double rate = kRate * (both ? 2.0 : 1.0) * (m_leads || m_follows ? 2.0 : 1.0);
  if (rate == m_rate)
    return;
  m_rate = rate;
  m_picture.setInteractionRate(rate);
}

void SceneDisplay::setContents(const rendering::SceneContents& contents)
{
  rendering::SceneContents next = contents;
  next.light = m_light;
  next.background = m_background;
  next.tool = m_contents.tool;
  m_picture.setContents(next);
  m_contents = std::move(next);
  if (m_follower)
    m_follower->setContents(m_contents);
  redraw(true);
}

void SceneDisplay::setLight(const rendering::LightSettings& light)
{
  m_light = light;
  if (m_follower)
    m_follower->m_light = light; // setContents passes on the contents
  setContents(m_contents);
}

void SceneDisplay::setBackground(const rendering::BackgroundColor& color)
{
  m_background = color;
  if (m_follower)
    m_follower->m_background = color;
  setContents(m_contents);
}

void SceneDisplay::setTool(const std::optional<rendering::ToolPose>& tool)
{
  m_contents.tool = tool;
  m_picture.setTool(tool);
  if (m_follower)
    m_follower->setTool(tool);
  redraw(true);
}

void SceneDisplay::setTouch(const session::TickRecord& record, const rendering::ToolPose& form)
{
  if (m_follower)
    m_follower->setTouch(record, form);
  if (!m_touch || !m_touch->shows(form))
  {
    m_touch.reset(new TouchOverlay(*m_renderer, form));
    m_touch->setCovered(m_covered);
    m_touch->setWarning(bytes(m_warning));
  }
  if (!m_touch->update(record))
    return;
  m_contents.tool = m_touch->tool();
  m_picture.setTool(m_contents.tool);
  redraw(true);
}

void SceneDisplay::setReading(const QString& text)
{
  if (m_follower)
    m_follower->setReading(text);
  m_reading = text;
  if (m_touch && m_touch->setReading(bytes(text)))
    redraw(m_moving);
}

void SceneDisplay::setWarning(const QString& text)
{
  if (m_follower)
    m_follower->setWarning(text);
  m_warning = text;
  if (m_touch && m_touch->setWarning(bytes(text)))
    redraw(m_moving);
}

void SceneDisplay::setCovered(double share)
{
  if (share == m_covered)
    return;
  m_covered = share;
  if (!m_touch)
    return;
  m_touch->setCovered(share);
  redraw(m_moving);
}

void SceneDisplay::setMeasures(const std::vector<DrawnMeasure>& measures)
{
  if (m_follower)
    m_follower->setMeasures(measures);
  if (!m_measures)
    return;
  if (!m_measures->set(measures))
    return;
  if (m_handles) // what is dragged lies under no label
    m_handles->raise();
  redraw(m_moving);
}

void SceneDisplay::setHandles(const std::vector<DrawnMeasure>& handles)
{
  if (m_handles && m_handles->set(handles))
    redraw(m_moving);
}

void SceneDisplay::withoutHandles(const std::function<void()>& grab)
{
  if (!m_handles || m_handles->measures().empty())
    return grab();
  const std::vector<DrawnMeasure> handles = m_handles->measures();
  m_handles->set({});
  drawNow();
  grab();
  setHandles(handles);
}

void SceneDisplay::setGhost(const std::optional<rendering::ToolPose>& ghost)
{
  if (m_follower)
    m_follower->setGhost(ghost);
  if (!m_measures || (!ghost && !m_ghost)) // released, or nothing to do
    return;
  m_ghost = ghost;
  if (!ghost)
    m_ghostOverlay.reset();
  else if (!m_ghostOverlay)
    m_ghostOverlay = std::make_unique<GhostOverlay>(*m_renderer);
  if (ghost)
    m_ghostOverlay->set(*ghost);
  redraw(true);
}

std::optional<std::array<double, 2>> SceneDisplay::pixelOf(const Eigen::Vector3d& patient) const
{
  return m_measures ? m_measures->pixelOf(patient) : std::nullopt;
}

void SceneDisplay::endTouch()
{
  m_reading.clear();
  m_warning.clear();
  if (m_follower)
    m_follower->endTouch();
  if (!m_touch)
    return;
  m_touch.reset();
  m_contents.tool.reset();
  m_picture.setTool(std::nullopt);
  redraw(true);
}

void SceneDisplay::setCamera(const core::CameraPose& pose)
{
  m_picture.setCamera(pose);
  if (m_follower)
    m_follower->setCamera(pose);
  redraw(true);
}

void SceneDisplay::maskChanged(std::shared_ptr<const volume::CutMask> mask,
                               const core::IndexBox& box)
{
  m_contents.mask = mask;
  if (m_follower)
    m_follower->maskChanged(mask, box);
  m_picture.maskChanged(std::move(mask), box);
  redraw(true);
}

void SceneDisplay::setStereo(rendering::StereoMode mode, const rendering::StereoRig& rig)
{
  if (!m_stereo)
    return;
  m_stereo->show(mode, rig);
  setRate();
  redraw(true);
}

rendering::StereoMode SceneDisplay::stereo() const noexcept
{
  return m_stereo ? m_stereo->mode() : rendering::StereoMode::None;
}

void SceneDisplay::setFirstRow(int row)
{
  if (m_stereo)
    m_stereo->setFirstRow(row);
}

void SceneDisplay::setFollower(SceneDisplay* follower)
{
  m_follower = follower;
  m_leads = follower != nullptr;
  setRate();
  if (!follower)
    return;
  follower->m_follows = true;
  follower->setRate();
  follower->m_light = m_light;
  follower->m_background = m_background;
  follower->m_contents.tool = m_contents.tool;
  follower->m_warning = m_warning;
  if (m_measures)
    follower->setMeasures(m_measures->measures());
  follower->setGhost(m_ghost);
  follower->setContents(m_contents);
  follower->setCamera(m_picture.camera());
}

void SceneDisplay::redraw(bool moving)
{
  if (moving)
  {
    m_moving = true;
    m_picture.setInteractive(true);
    m_refine.stop(); // given up
    m_rests.start();
    m_settle.start();
  }
  if (m_pending)
    return;
  m_pending = true;
  QTimer::singleShot(0, this, &SceneDisplay::drawNow);
}

void SceneDisplay::drawNow()
{
  m_pending = false;
  if (!m_shown())
    return;
  emit aboutToDraw();
  m_window.Render();
}

void SceneDisplay::setSamples(int samples)
{
  m_samples = samples;
}

bool SceneDisplay::isFine() const
{
  return m_picture.restSamples() > 0;
}

// A part of the picture at rest, with time for events before the next one.
void SceneDisplay::refineSoon()
{
  const bool isMore = isFine(); // samples
  if (m_moving || !m_shown() || (isMore && m_refine.isActive()))
    return;
  const auto still = static_cast<int>(std::max<qint64>(kStill - m_rests.elapsed(), 0));
  const bool isSlow = m_picture.frameMilliseconds() > kSlow;
  m_refine.start(isMore ? std::max(still, isSlow ? static_cast<int>(kPart) : 0) : 0);
}

void SceneDisplay::refine()
{
  if (m_moving || m_failing || m_pending || !m_shown())
    return; // the next frame goes on with it
  using rendering::Refinement;
  const bool isMore = isFine() && m_rests.elapsed() >= kStill;
  switch (m_picture.refine(kPart, isMore ? m_samples : 1))
  {
  case Refinement::Better:
    return redraw();
  case Refinement::More:
    return refineSoon();
  case Refinement::Done:
    break;
  }
  if (!isMore && isFine() && m_samples > 1)
    refineSoon();
}

void SceneDisplay::frameStarted()
{
  if (m_measures)
    m_measures->place(m_contents.tool,
                      m_handles ? m_handles->handles() : std::vector<Eigen::Vector3d>());
  if (m_handles)
    m_handles->place();
  m_clock.start();
}

void SceneDisplay::frameEnded()
{
  // The longer of submitting commands and rendering, which overlap.
  const double milliseconds = isFine()
                                  ? m_picture.frameMilliseconds()
                                  : std::max(1e-6 * static_cast<double>(m_clock.nsecsElapsed()),
                                             m_picture.frameMilliseconds());
  QString why;
  try
  {
    m_picture.throwLastError();
    if (m_isLost())
      why = tr("the graphics driver was reset and lost the picture");
  }
  catch (const core::Error& error)
  {
    why = toString(error);
  }
  catch (const std::exception&) // messages of other libraries may contain patient data
  {
    why = tr("the picture could not be drawn");
  }
  const bool first = !why.isEmpty() && !m_failing;
  m_failing = !why.isEmpty();
  // Not during painting: the receiver may ask the user.
  if (first)
    QMetaObject::invokeMethod(
        this, [this, why] { emit failed(why); }, Qt::QueuedConnection);
  else if (!m_failing)
    emit drawn(milliseconds, m_picture.drawnScale(), !isFine());
  // A large undo is uploaded to the GPU over several frames.
  if (!m_failing && m_picture.statistics().pendingEdits > 0)
    QTimer::singleShot(0, this, [this] { redraw(m_moving); });
  if (!m_failing && m_picture.statistics().pendingShadow && !m_await.isActive())
    m_await.start();
  refineSoon();
}

QSurfaceFormat surfaceFormat(bool stereo)
{
  QSurfaceFormat format = QVTKOpenGLNativeWidget::defaultFormat(stereo);
  format.setOption(QSurfaceFormat::ResetNotification);
  return format;
}

bool quadBufferOffered()
{
  QOpenGLContext context;
  context.setFormat(surfaceFormat(true));
  return context.create() && context.format().stereo();
}

} // namespace petrous::workstation
