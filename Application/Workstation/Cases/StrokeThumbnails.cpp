#include "StrokeThumbnails.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "petrous/Core/Error.h"
#include "petrous/Presenters/ApproachTree.h"

namespace petrous::workstation
{

namespace
{

constexpr int kLookEvery = 100; // ms

QImage imageOf(const rendering::Picture& picture)
{
  return QImage(picture.rgb.data(), picture.width, picture.height, 3 * picture.width,
                QImage::Format_RGB888)
      .copy();
}

} // namespace

StrokeThumbnails::StrokeThumbnails(presenters::WorkstationModel& model, int delay, QObject* parent)
  : QObject(parent)
  , m_model(model)
  , m_delay(delay)
{
  m_timer.setInterval(kLookEvery);
  connect(&m_timer, &QTimer::timeout, this, &StrokeThumbnails::look);
  // What cannot be drawn is left without a picture until it looks different.
  connect(&m_work, &BackgroundWork::failed, this, [this] { m_wanted.clear(); });
}

QImage StrokeThumbnails::of(std::size_t state) const
{
  const auto found = m_images.find(state);
  return found == m_images.end() ? QImage() : found->second;
}

void StrokeThumbnails::want(std::vector<std::size_t> states)
{
  states.erase(std::remove_if(states.begin(), states.end(),
                              [this](std::size_t state) { return m_images.count(state) > 0; }),
               states.end());
  if (m_delay < 0 || states == m_wanted)
    return;
  m_wanted = std::move(states);
  m_waited = 0;
  if (m_wanted.empty())
    return m_work.abandon();
  m_timer.start();
}

void StrokeThumbnails::clear()
{
  m_images.clear();
  m_wanted.clear();
  m_work.abandon();
}

void StrokeThumbnails::look()
{
  const bool idle = m_model.hasCase() && m_model.drawable() && (!isIdle || isIdle());
  m_waited = idle ? m_waited + kLookEvery : 0;
  if (m_work.busy())
  {
    if (!idle)
      m_work.cancel();
  }
  else if (m_wanted.empty())
    m_timer.stop();
  else if (m_waited >= m_delay && idle)
    draw();
}

void StrokeThumbnails::draw()
{
  rendering::SceneContents drawable;
  try
  {
    drawable = m_model.sceneContents();
  }
  catch (const core::Error&) // told where the scene is shown
  {
    return m_wanted.clear();
  }
  m_work.start(
      [this, value = scene::Case(m_model.value()), contents = std::move(drawable),
       seen = camera ? camera() : core::CameraPose(),
       states = m_wanted](const core::Progress& progress) -> BackgroundWork::Reply
      {
        presenters::drawStates(
            value, contents, seen, states, kWidth, kHeight,
            [this](std::size_t state, const rendering::Picture& picture)
            {
              m_work.post(
                  [this, state, image = imageOf(picture)]
                  {
                    m_images[state] = image;
                    m_wanted.erase(std::remove(m_wanted.begin(), m_wanted.end(), state),
                                   m_wanted.end());
                    emit drawn(state);
                  });
            },
            progress);
        return [] {};
      });
}

} // namespace petrous::workstation
