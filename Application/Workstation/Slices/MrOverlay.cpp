#include "MrOverlay.h"

#include <chrono>
#include <future>
#include <utility>

#include "SliceColumn.h"
#include "SliceView.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Presenters/ProvenanceText.h"

namespace petrous::workstation
{

using presenters::OverlayMode;

namespace
{
// One that is read within this time is shown at once, without a picture that lacks it.
constexpr std::chrono::milliseconds kSoon{80};
} // namespace

MrOverlay::MrOverlay(presenters::RegistrationSession& session, SliceColumn& slices, QObject* parent)
  : QObject(parent)
  , m_session(session)
  , m_slices(slices)
{
  connect(&m_slices, &SliceColumn::overlayWindowAsked, this, &MrOverlay::setWindow);
  connect(&m_reading, &BackgroundWork::failed, this, &MrOverlay::failed);
}

void MrOverlay::reset()
{
  forget();
  m_best.reset();
  set(std::nullopt, m_opacity);
}

void MrOverlay::set(const Mode& mode, double opacity)
{
  m_mode = mode;
  m_opacity = opacity;
  m_alone.reset();
  emit changed();
  refresh();
}

void MrOverlay::flick()
{
  if (m_session.part())
    showAlone(!(m_alone && *m_alone == 1.0));
}

void MrOverlay::showAlone(bool mr)
{
  m_alone = mr ? 1.0 : 0.0;
  refresh();
}

void MrOverlay::next()
{
  if (!m_session.part())
    return;
  if (m_alone)
    set(m_mode, m_opacity); // back from one image alone
  else if (!m_mode)
    set(OverlayMode::Blend, m_opacity);
  else if (*m_mode == OverlayMode::Checker)
    set(std::nullopt, m_opacity);
  else
    set(static_cast<OverlayMode>(static_cast<int>(*m_mode) + 1), m_opacity);
}

void MrOverlay::setUnderWay(const std::optional<core::RigidTransform>& best)
{
  m_best = best;
  if (seen())
    refresh();
}

bool MrOverlay::load(const scene::ImagePart& part)
{
  if (m_overlay && m_overlayOf == part.name)
    return true;
  if (m_readingOf == part.name)
    return false;
  m_overlay.reset();
  m_readingOf = part.name;
  const bool beginsAtOnce = !m_reading.busy();
  std::promise<presenters::SliceOverlay> made;
  auto soon = made.get_future();
  m_reading.replace(
      [this, part,
       made = std::make_shared<std::promise<presenters::SliceOverlay>>(std::move(made))](
          const core::Progress&) -> BackgroundWork::Reply
      {
        const presenters::SliceOverlay overlay = presenters::overlayOf(part);
        made->set_value(overlay);
        return [this, overlay, name = part.name]
        {
          m_readingOf.clear();
          m_overlay = overlay;
          m_overlayOf = name;
          refresh();
        };
      });
  if (!beginsAtOnce || soon.wait_for(kSoon) != std::future_status::ready)
    return false;
  try
  {
    m_overlay = soon.get();
  }
  catch (const std::future_error&) // it could not be read, which is told next
  {
    return false;
  }
  m_reading.wait();
  m_overlayOf = std::exchange(m_readingOf, {});
  return true;
}

void MrOverlay::failed(const QString& why)
{
  forget();
  m_slices.setOverlay(nullptr, {});
  m_slices.setNotice({});
  emit statusMessage(why);
}

void MrOverlay::forget()
{
  m_overlay.reset();
  m_readingOf.clear();
  m_reading.abandon();
}

void MrOverlay::refresh()
{
  draw();
  emit drawn();
}

presenters::ShownImages MrOverlay::shown() const
{
  const scene::ImagePart* part = m_session.part();
  if (!part || !seen() || !m_overlay)
    return {};
  if (!m_alone && m_mode == OverlayMode::Checker)
    return {true, part->name};
  const double opacity = m_alone.value_or(m_mode == OverlayMode::Blend ? m_opacity : 1.0);
  const bool isCtSeen = opacity < 1.0;
  const bool isMrSeen = opacity > 0.0;
  return {isCtSeen, isMrSeen ? part->name : std::string()};
}

void MrOverlay::setWindow(const presenters::GreyWindow& window)
{
  if (!m_overlay)
    return;
  m_overlay->window = window;
  draw();
}

void MrOverlay::draw()
{
  const scene::ImagePart* part = m_session.part();
  const bool ctAlone = m_alone && *m_alone == 0.0;
  if (!seen())
    forget(); // frees the MR
  if (!part || ctAlone || !seen())
  {
    m_slices.setOverlay(nullptr, {});
    m_slices.setNotice(part && ctAlone ? tr("%1 alone (V)").arg(words(m_session.primary()))
                                       : QString());
    return;
  }
  if (!load(*part))
  {
    m_slices.setOverlay(nullptr, {});
    m_slices.setNotice(tr("%1: being read…").arg(words(part->name)));
    return;
  }
  presenters::SliceOverlay overlay = *m_overlay;
  overlay.mrFromCt = m_best.value_or(part->mrFromCt);
  overlay.registered = part->registered;
  overlay.mode = m_alone ? OverlayMode::Blend : *m_mode;
  overlay.opacity = m_alone.value_or(m_opacity);
  m_slices.setOverlay(std::make_shared<const presenters::SliceOverlay>(std::move(overlay)),
                      shown());
  QString notice = words(part->name);
  if (m_alone)
    notice = tr("%1 alone (V)").arg(notice);
  if (m_best)
    notice += tr(": being registered");
  else if (!part->registered)
    notice += tr(": not registered");
  if (const std::string guessed = presenters::interpolatedText(*part); !guessed.empty())
    notice += tr(": %1").arg(phrase(guessed));
  m_slices.setNotice(notice);
}

} // namespace petrous::workstation
