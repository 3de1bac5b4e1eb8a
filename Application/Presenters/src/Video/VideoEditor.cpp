#include "petrous/Presenters/VideoEditor.h"

#include <algorithm>
#include <utility>

#include "petrous/Dissection/StrokeNumber.h"
#include "petrous/Library/Attachments.h"

namespace petrous::presenters
{

namespace
{

using core::InvalidParameter;
using dissection::History;

constexpr double kApart = 1e-3; // mm, two landmarks

// What the camera is found from.
bool isAlike(const scene::VideoNotes::Still& a, const scene::VideoNotes::Still& b)
{
  return a.time == b.time && a.size == b.size && a.viewAngle == b.viewAngle &&
         std::equal(a.landmarks.begin(), a.landmarks.end(), b.landmarks.begin(), b.landmarks.end(),
                    [](const auto& x, const auto& y)
                    { return x.patient == y.patient && x.still == y.still; });
}

} // namespace

VideoEditor::VideoEditor(WorkstationModel& model)
  : m_model(model)
{
}

void VideoEditor::tell()
{
  if (changed)
    changed();
}

std::vector<std::string> VideoEditor::videos() const
{
  std::vector<std::string> names;
  if (m_model.hasCase())
    for (const scene::Attachment& one : m_model.value().attachments)
      if (one.kind == scene::Attachment::Kind::Video)
        names.push_back(one.name);
  return names;
}

void VideoEditor::refresh()
{
  const std::vector<std::string> names = videos();
  const bool isOther = m_shown != m_model.shownAs();
  m_shown = m_model.shownAs();
  if (isOther || std::find(names.begin(), names.end(), m_video) == names.end())
    choose({});
  else
    seekCamera();
  tell();
}

void VideoEditor::choose(const std::string& name)
{
  if (!name.empty())
    scene::findAttachment(m_model.value(), name);
  m_video = name;
  m_loop.reset();
  hideFrame();
}

std::filesystem::path VideoEditor::file() const
{
  return library::attachmentFile(m_model.library(),
                                 scene::findAttachment(m_model.value(), m_video));
}

const scene::VideoNotes& VideoEditor::notes() const
{
  static const Notes kNone;
  if (!m_model.hasCase() || m_video.empty())
    return kNone;
  for (const scene::Attachment& one : m_model.value().attachments)
    if (one.name == m_video && one.video)
      return *one.video;
  return kNone;
}

void VideoEditor::showFrame(const std::array<int, 2>& size, std::int64_t time)
{
  if (m_time != time)
    m_mark.reset();
  m_size = size;
  m_time = time;
  seekCamera();
  tell();
}

void VideoEditor::hideFrame()
{
  m_time.reset();
  m_mark.reset();
  seekCamera();
  tell();
}

void VideoEditor::requireFrame() const
{
  if (!m_time || m_video.empty())
    throw InvalidParameter("open a video first");
}

void VideoEditor::checkBookmark(std::size_t bookmark) const
{
  if (bookmark >= notes().bookmarks.size())
    throw InvalidParameter("there is no such bookmark");
}

void VideoEditor::set(const Notes& next, const std::string& what, const std::string& continues)
{
  m_model.setVideoNotes(m_video, next, what, continues); // which refreshes
}

std::string VideoEditor::presentStroke() const
{
  const std::size_t position = m_model.value().dissection.history().position();
  const auto& strokes = m_model.value().dissection.strokes();
  return position < strokes.size() ? strokes[position]->object : std::string();
}

std::string VideoEditor::addBookmark(const std::string& name)
{
  requireFrame();
  Notes next = notes();
  const std::string free =
      name.empty()
          ? scene::freeBookmarkName(next, "bookmark " + std::to_string(next.bookmarks.size() + 1))
          : name;
  next.bookmarks.push_back({free, *m_time, presentStroke()});
  set(next, "bookmark '" + free + "'");
  return free;
}

void VideoEditor::renameBookmark(std::size_t bookmark, const std::string& name)
{
  checkBookmark(bookmark);
  Notes next = notes();
  next.bookmarks[bookmark].name = name;
  set(next, "name of bookmark '" + name + "'");
}

void VideoEditor::moveBookmark(std::size_t bookmark)
{
  requireFrame();
  checkBookmark(bookmark);
  Notes next = notes();
  next.bookmarks[bookmark].time = *m_time;
  set(next, "place of bookmark '" + next.bookmarks[bookmark].name + "'");
}

void VideoEditor::tieBookmark(std::size_t bookmark)
{
  checkBookmark(bookmark);
  Notes next = notes();
  Notes::Bookmark& one = next.bookmarks[bookmark];
  const std::string stroke = presentStroke();
  if (one.stroke.empty() && stroke.empty())
    throw InvalidParameter("nothing is drilled yet, or the stroke is not saved yet");
  one.stroke = one.stroke.empty() ? stroke : std::string();
  set(next, (one.stroke.empty() ? "untie bookmark '" : "tie bookmark '") + one.name + "'");
}

void VideoEditor::removeBookmark(std::size_t bookmark)
{
  checkBookmark(bookmark);
  Notes next = notes();
  const std::string name = next.bookmarks[bookmark].name;
  next.bookmarks.erase(next.bookmarks.begin() + static_cast<std::ptrdiff_t>(bookmark));
  set(next, "removal of bookmark '" + name + "'");
}

std::optional<VideoEditor::State> VideoEditor::stateOf(std::size_t bookmark) const
{
  if (bookmark >= notes().bookmarks.size())
    return std::nullopt;
  const auto stroke = scene::strokeWith(m_model.value(), notes().bookmarks[bookmark].stroke);
  if (!stroke)
    return std::nullopt;
  const History& history = m_model.value().dissection.history();
  const auto isOn = [&](const History::Branch& branch)
  {
    if (branch.tip == History::kStart)
      return false;
    const auto line = history.lineTo(branch.tip);
    return std::find(line.begin(), line.end(), *stroke) != line.end();
  };
  if (isOn(history.branch()))
    return State{history.branch().name, *stroke};
  const auto found = std::find_if(history.branches().begin(), history.branches().end(), isOn);
  if (found == history.branches().end())
    return std::nullopt;
  return State{found->name, *stroke};
}

std::optional<std::size_t> VideoEditor::bookmarkHere() const
{
  if (!m_model.hasCase())
    return std::nullopt;
  const std::string stroke = presentStroke();
  const auto& all = notes().bookmarks;
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&stroke](const Notes::Bookmark& one)
                                  { return !stroke.empty() && one.stroke == stroke; });
  return found == all.end()
             ? std::nullopt
             : std::optional<std::size_t>(static_cast<std::size_t>(found - all.begin()));
}

std::size_t VideoEditor::strokeOf(std::size_t bookmark) const
{
  if (bookmark >= notes().bookmarks.size())
    return 0;
  const auto stroke = scene::strokeWith(m_model.value(), notes().bookmarks[bookmark].stroke);
  return stroke ? dissection::strokeNumber(*stroke) : 0;
}

void VideoEditor::setLoop(std::size_t first, std::size_t second)
{
  checkBookmark(first);
  checkBookmark(second);
  const auto& all = notes().bookmarks;
  const auto [begin, end] = std::minmax(all[first].time, all[second].time);
  m_loop = begin < end ? std::optional(std::array<std::int64_t, 2>{begin, end}) : std::nullopt;
  tell();
}

void VideoEditor::clearLoop()
{
  m_loop.reset();
  tell();
}

const scene::VideoNotes::Still* VideoEditor::still() const
{
  return m_time ? scene::findStill(notes(), *m_time) : nullptr;
}

void VideoEditor::markStill(const Eigen::Vector2d& pixel)
{
  requireFrame();
  m_mark = pixel;
  tell();
}

void VideoEditor::dropMark()
{
  m_mark.reset();
  tell();
}

// A still that has neither landmarks nor a known angle is none.
void VideoEditor::changeStill(const std::function<void(Notes::Still&)>& change,
                              const std::string& what)
{
  requireFrame();
  Notes next = notes();
  auto at = std::find_if(next.stills.begin(), next.stills.end(),
                         [this](const Notes::Still& one) { return one.time == *m_time; });
  if (at == next.stills.end())
  {
    next.stills.emplace_back();
    at = next.stills.end() - 1;
    at->time = *m_time;
    at->size = m_size;
  }
  const Notes::Still before = *at;
  change(*at);
  if (!isAlike(before, *at))
    at->camera.reset();
  if (at->landmarks.empty() && !at->viewAngle)
    next.stills.erase(at);
  set(next, what);
}

void VideoEditor::addPair(const Eigen::Vector3d& patient)
{
  if (!m_mark)
    throw InvalidParameter("click the point in the still first");
  if (const auto* const one = still();
      one && std::any_of(one->landmarks.begin(), one->landmarks.end(),
                         [&patient](const Notes::Landmark& other)
                         { return (other.patient - patient).norm() < kApart; }))
    throw InvalidParameter("the crosshair is still at another landmark of this still; click the "
                           "point of the patient in the 3D view or a slice first");
  const Notes::Landmark pair{patient, *m_mark};
  m_mark.reset();
  changeStill([&pair](Notes::Still& one) { one.landmarks.push_back(pair); }, "landmark of a still");
}

void VideoEditor::removePair(std::size_t pair)
{
  const auto* const one = still();
  if (!one || pair >= one->landmarks.size())
    throw InvalidParameter("the still has no such landmark");
  changeStill([pair](Notes::Still& of)
              { of.landmarks.erase(of.landmarks.begin() + static_cast<std::ptrdiff_t>(pair)); },
              "removal of a landmark");
}

void VideoEditor::removeStill()
{
  if (still())
    changeStill(
        [](Notes::Still& one)
        {
          one.landmarks.clear();
          one.viewAngle.reset();
        },
        "removal of a still's landmarks");
}

void VideoEditor::setViewAngle(std::optional<double> degrees)
{
  if (still() ? still()->viewAngle == degrees : !degrees)
    return;
  changeStill([degrees](Notes::Still& one) { one.viewAngle = degrees; }, "angle of view");
}

void VideoEditor::setOpacity(double opacity)
{
  const auto* const one = still();
  if (!one || one->opacity == opacity)
    return;
  Notes next = notes();
  for (Notes::Still& each : next.stills)
    if (each.time == *m_time)
      each.opacity = opacity;
  set(next, "opacity of a still", "opacity of a still");
}

void VideoEditor::seekCamera()
{
  const auto* const one = still();
  if (one && m_fitOf && isAlike(*one, *m_fitOf) && (one->camera || !m_problem.empty()))
    return; // known
  if (m_isFitting && inBackground)
    inBackground({});
  m_isFitting = false;
  m_fitOf.reset();
  m_fit.reset();
  m_problem.clear();
  if (!one || one->landmarks.size() < landmarksNeeded(*one))
    return;
  m_isFitting = true;
  Work work = [this, of = *one](const core::Progress& progress) -> std::function<void()>
  {
    try
    {
      const StillFit fit = fitStill(of, progress);
      return [this, of, fit] { fitted(of, fit, {}); };
    }
    catch (const InvalidParameter& error)
    {
      return [this, of, why = std::string(error.what())] { fitted(of, std::nullopt, why); };
    }
  };
  if (inBackground)
    inBackground(std::move(work));
  else
    work({})();
}

void VideoEditor::fitted(const Notes::Still& of, const std::optional<StillFit>& fit,
                         const std::string& problem)
{
  const auto* const one = still();
  if (!one || !isAlike(of, *one))
    return;
  m_isFitting = false;
  m_fitOf = of;
  m_fit = fit;
  m_problem = problem;
  if (!fit || one->camera)
    return tell();
  Notes next = notes();
  for (Notes::Still& each : next.stills)
    if (each.time == of.time)
      each.camera = fit->pose.camera;
  set(next, {}); // which follows from the landmarks: no step of its own
  if (cameraFound)
    cameraFound();
}

} // namespace petrous::presenters
