#include "ThumbnailDrawer.h"

#include <algorithm>
#include <utility>

#include "Theme.h"
#include "petrous/Library/ThumbnailAge.h"
#include "petrous/Presenters/CasePicture.h"

namespace petrous::workstation
{

namespace
{
constexpr int kLook = 100; // ms
} // namespace

ThumbnailDrawer::ThumbnailDrawer(std::function<library::Library()> library, int delay,
                                 QObject* parent)
  : QObject(parent)
  , m_library(std::move(library))
  , m_delay(delay)
{
  m_timer.setInterval(kLook);
  connect(&m_timer, &QTimer::timeout, this, &ThumbnailDrawer::look);
  connect(&m_work, &BackgroundWork::failed, this, [this] { m_current.clear(); });
  connect(&m_work, &BackgroundWork::cancelled, this,
          [this]
          {
            if (m_enabled && !m_current.empty())
              ask(std::exchange(m_current, {}), true);
          });
}

void ThumbnailDrawer::setEnabled(bool enabled)
{
  m_enabled = enabled;
  m_seen.clear(); // when it is on again, all are looked at
  if (enabled)
    return;
  m_wanted.clear();
  m_listed.clear();
  m_work.cancel();
}

void ThumbnailDrawer::caseSaved(const std::string& name)
{
  ask(name, true);
}

void ThumbnailDrawer::caseSeen(const library::CaseSummary& summary)
{
  if (!m_enabled || m_delay < 0 || !m_seen.insert(summary.id + summary.modified).second)
    return;
  m_listed.push_back(summary);
  m_timer.start();
}

void ThumbnailDrawer::ask(const std::string& name, bool first)
{
  if (!m_enabled || m_delay < 0 || name.empty())
    return;
  const auto known = std::find(m_wanted.begin(), m_wanted.end(), name);
  if (first && known != m_wanted.end())
    m_wanted.erase(known);
  if (first || known == m_wanted.end())
    m_wanted.insert(first ? m_wanted.begin() : m_wanted.end(), name);
  m_asked.start();
  m_timer.start();
}

void ThumbnailDrawer::look()
{
  const bool idle = !isIdle || isIdle();
  if (m_work.busy())
  {
    if (!idle)
      m_work.cancel();
  }
  else if (!m_listed.empty())
    examine();
  else if (m_wanted.empty())
    m_timer.stop();
  else if (!idle)
    m_asked.start();
  else if (m_asked.elapsed() >= m_delay)
    draw();
}

// Which of the listed cases need one.
void ThumbnailDrawer::examine()
{
  m_work.start(
      [this, library = m_library(),
       listed = std::exchange(m_listed, {})](const core::Progress&) -> BackgroundWork::Reply
      {
        std::vector<std::string> names;
        for (const library::CaseSummary& one : listed)
          if (library::needsThumbnail(library, one))
            names.push_back(one.name);
        return [this, names]
        {
          for (const std::string& name : names)
            ask(name, false);
        };
      });
}

void ThumbnailDrawer::draw()
{
  m_current = m_wanted.front();
  m_wanted.erase(m_wanted.begin());
  m_work.start(
      [this, library = m_library(),
       name = m_current](const core::Progress& progress) mutable -> BackgroundWork::Reply
      {
        scene::Case value = library.open(name);
        presenters::storeThumbnail(library, value, progress);
        return [this, id = value.id]
        {
          m_current.clear();
          emit drawn(words(id));
        };
      });
}

} // namespace petrous::workstation
