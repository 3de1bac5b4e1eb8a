#include "petrous/Scene/VideoNotes.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include "petrous/Core/Error.h"
#include "petrous/Scene/Case.h"

namespace petrous::scene
{

namespace
{

constexpr double kFarthestPoint = 1e5; // mm
constexpr double kFarthestPixel = 1e6;
constexpr std::int64_t kLongestVideo = std::int64_t{30} * 24 * 3600 * 1000000000; // ns

void requireOfVideo(bool holds, const std::string& what)
{
  if (!holds)
    throw core::InvalidParameter("video: " + what);
}

template <class Vector>
bool isWithin(const Vector& v, double limit)
{
  return v.allFinite() && v.cwiseAbs().maxCoeff() <= limit;
}

void checkStill(const VideoNotes::Still& still)
{
  requireOfVideo(still.time >= 0, "a still before the beginning");
  requireOfVideo(still.time <= kLongestVideo, "a still later than 30 days");
  for (const int side : still.size)
    requireOfVideo(side >= 1 && side <= VideoNotes::kLargestSide,
                   "a still has sides of 1 to " + std::to_string(VideoNotes::kLargestSide) +
                       " pixels");
  requireOfVideo(still.landmarks.size() <= VideoNotes::kMaxLandmarks,
                 "a still has at most " + std::to_string(VideoNotes::kMaxLandmarks) + " landmarks");
  for (const VideoNotes::Landmark& one : still.landmarks)
    requireOfVideo(isWithin(one.patient, kFarthestPoint) && isWithin(one.still, kFarthestPixel),
                   "a landmark has a coordinate that is not a number or out of range");
  requireOfVideo(!still.viewAngle || (*still.viewAngle >= 0.5 && *still.viewAngle <= 120.0),
                 "the angle of view must lie within 0.5 to 120 degrees");
  requireOfVideo(still.opacity >= 0.0 && still.opacity <= 1.0,
                 "the opacity must lie within 0 to 1");
  if (!still.camera)
    return;
  const core::CameraPose& camera = *still.camera;
  requireOfVideo(isWithin(camera.position, kFarthestPoint) &&
                     isWithin(camera.focalPoint, kFarthestPoint) && camera.viewUp.allFinite() &&
                     camera.viewUp.norm() > 0.0 && camera.position != camera.focalPoint &&
                     camera.viewAngle > 0.0 && camera.viewAngle < 180.0 && !camera.parallelScale,
                 "the camera of a still must be a perspective one, of finite numbers");
}

template <class T>
void sortByTime(std::vector<T>& all)
{
  std::vector<const T*> order;
  for (const T& one : all)
    order.push_back(&one);
  std::stable_sort(order.begin(), order.end(),
                   [](const T* a, const T* b) { return a->time < b->time; });
  std::vector<T> sorted;
  for (const T* one : order)
    sorted.push_back(*one);
  all = std::move(sorted);
}

auto poseTie(const core::CameraPose& c)
{
  return std::tie(c.position, c.focalPoint, c.viewUp, c.viewAngle);
}

} // namespace

bool operator==(const VideoNotes& a, const VideoNotes& b)
{
  const auto bookmarks = [](const VideoNotes::Bookmark& x, const VideoNotes::Bookmark& y)
  { return std::tie(x.name, x.time, x.stroke) == std::tie(y.name, y.time, y.stroke); };
  const auto landmarks = [](const VideoNotes::Landmark& x, const VideoNotes::Landmark& y)
  { return x.patient == y.patient && x.still == y.still; };
  const auto stills = [&landmarks](const VideoNotes::Still& x, const VideoNotes::Still& y)
  {
    return std::tie(x.time, x.size, x.viewAngle, x.opacity) ==
               std::tie(y.time, y.size, y.viewAngle, y.opacity) &&
           x.camera.has_value() == y.camera.has_value() &&
           (!x.camera || poseTie(*x.camera) == poseTie(*y.camera)) &&
           std::equal(x.landmarks.begin(), x.landmarks.end(), y.landmarks.begin(),
                      y.landmarks.end(), landmarks);
  };
  return std::equal(a.bookmarks.begin(), a.bookmarks.end(), b.bookmarks.begin(), b.bookmarks.end(),
                    bookmarks) &&
         std::equal(a.stills.begin(), a.stills.end(), b.stills.begin(), b.stills.end(), stills);
}

void checkVideoNotes(const VideoNotes& notes)
{
  requireOfVideo(notes.bookmarks.size() <= VideoNotes::kMaxBookmarks,
                 "one has at most " + std::to_string(VideoNotes::kMaxBookmarks) + " bookmarks");
  requireOfVideo(notes.stills.size() <= VideoNotes::kMaxStills,
                 "one has at most " + std::to_string(VideoNotes::kMaxStills) + " stills");
  std::set<std::string> names;
  for (const VideoNotes::Bookmark& one : notes.bookmarks)
  {
    try
    {
      checkViewName(one.name); // the rules are the same
    }
    catch (const core::InvalidParameter&)
    {
      requireOfVideo(false, "a bookmark's name has 1 to " +
                                std::to_string(VideoNotes::kLongestName) +
                                " bytes of UTF-8, without characters that are not seen and without "
                                "spaces around it");
    }
    requireOfVideo(names.insert(lowerCase(one.name)).second,
                   "two bookmarks have the name '" + one.name + "'");
    requireOfVideo(one.time >= 0, "bookmark '" + one.name + "' is before the beginning");
    requireOfVideo(one.time <= kLongestVideo, "bookmark '" + one.name + "' is later than 30 days");
  }
  std::set<std::int64_t> times;
  for (const VideoNotes::Still& one : notes.stills)
  {
    checkStill(one);
    requireOfVideo(times.insert(one.time).second, "two stills are of one frame");
  }
}

void sortVideoNotes(VideoNotes& notes)
{
  sortByTime(notes.bookmarks);
  sortByTime(notes.stills);
}

std::size_t findBookmark(const VideoNotes& notes, const std::string& name)
{
  std::string there;
  for (std::size_t n = 0; n < notes.bookmarks.size(); ++n)
  {
    if (lowerCase(notes.bookmarks[n].name) == lowerCase(name))
      return n;
    there += (there.empty() ? "; there are '" : ", '") + notes.bookmarks[n].name + "'";
  }
  throw core::InvalidParameter("the video has no bookmark '" + name + "'" +
                               (there.empty() ? "; it has none" : there));
}

std::string freeBookmarkName(const VideoNotes& notes, const std::string& name)
{
  const auto isTaken = [&notes](const std::string& text)
  {
    return std::any_of(notes.bookmarks.begin(), notes.bookmarks.end(),
                       [wanted = lowerCase(text)](const VideoNotes::Bookmark& one)
                       { return lowerCase(one.name) == wanted; });
  };
  std::string unused = name;
  for (int n = 2; isTaken(unused); ++n)
    unused = name + " " + std::to_string(n);
  return unused;
}

const VideoNotes::Still* findStill(const VideoNotes& notes, std::int64_t time)
{
  const auto at = std::find_if(notes.stills.begin(), notes.stills.end(),
                               [time](const VideoNotes::Still& one) { return one.time == time; });
  return at == notes.stills.end() ? nullptr : &*at;
}

std::optional<std::size_t> strokeWith(const Case& value, const std::string& object)
{
  const auto& strokes = value.dissection.strokes();
  for (std::size_t n = 0; n < strokes.size() && !object.empty(); ++n)
    if (strokes[n]->object == object)
      return n;
  return std::nullopt;
}

} // namespace petrous::scene
