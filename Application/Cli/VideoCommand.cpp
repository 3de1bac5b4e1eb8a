#include <algorithm>
#include <cmath>

#include "CaseJson.h"
#include "Commands.h"
#include "Numbers.h"
#include "ViewOptions.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Dissection/StrokeNumber.h"
#include "petrous/Library/Attachments.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Presenters/LabelledPicture.h"
#include "petrous/Presenters/StillCamera.h"
#include "petrous/Rendering/OffscreenView.h"
#include "petrous/Scene/VideoNotes.h"
#include "petrous/Video/VideoFile.h"

namespace petrous::cli
{

namespace
{

using scene::VideoNotes;

constexpr double kLongest = 1e6; // s

struct VideoCommandOptions
{
  std::string caseName, video, bookmark, pairs, frame, overlay, size = "800x600";
  std::vector<std::string> removed;
  std::optional<double> at, viewAngle, opacity;
  std::optional<std::uint64_t> stroke;
  bool removeStill = false;

  bool isOfFrame() const
  {
    return !bookmark.empty() || !pairs.empty() || !frame.empty() || !overlay.empty() ||
           removeStill || opacity;
  }
};

double seconds(std::int64_t nanoseconds)
{
  return static_cast<double>(nanoseconds) / 1e9;
}

scene::Attachment& videoOf(scene::Case& value, const std::string& name)
{
  using Kind = scene::Attachment::Kind;
  if (!name.empty())
  {
    scene::Attachment& found = scene::findAttachment(value, name);
    if (found.kind != Kind::Video)
      throw core::InvalidParameter("'" + found.name + "' is a " + nameOf(found.kind) +
                                   ", not a video");
    return found;
  }
  std::string names;
  scene::Attachment* only = nullptr;
  int count = 0;
  for (scene::Attachment& one : value.attachments)
    if (one.kind == Kind::Video)
    {
      names += (names.empty() ? "'" : ", '") + one.name + "'";
      only = &one;
      ++count;
    }
  if (count == 1)
    return *only;
  throw core::InvalidParameter("case '" + value.name + "' has " +
                               (count == 0
                                    ? "no video; 'petrous attach' adds one"
                                    : "several videos: " + names + "; say which with --video"));
}

// What landmarks and bookmarks were set in, to its last byte.
video::VideoFile openVideo(const Context& context, const library::Library& library,
                           const scene::Attachment& one)
{
  if (const auto problem = library::attachmentChange(library, one, context.progress());
      !problem.empty())
    throw core::InvalidParameter("attachment '" + one.name + "': its file is " + problem);
  return video::VideoFile(library::attachmentFile(library, one), one.name);
}

nlohmann::json fitJson(const presenters::StillFit& fit)
{
  nlohmann::json bad = nlohmann::json::array();
  for (const std::size_t n : fit.bad)
    bad.push_back(n + 1);
  return {{"residuals_px", fit.pose.residuals},
          {"rms_px", fit.pose.rms},
          {"rms_mm", fit.pose.rmsAtLandmarks},
          {"rotation_sigma_deg", fit.pose.rotationSigma},
          {"position_sigma_mm", fit.pose.positionSigma},
          {"view_angle_sigma_deg", fit.pose.viewAngleSigma},
          {"ambiguous", fit.pose.ambiguous},
          {"poor", fit.isPoor},
          {"bad_landmarks", bad}};
}

nlohmann::json stillJson(const VideoNotes::Still& still)
{
  nlohmann::json landmarks = nlohmann::json::array();
  for (const auto& one : still.landmarks)
    landmarks.push_back(
        {{"patient_mm", vectorJson(one.patient)}, {"still_px", {one.still.x(), one.still.y()}}});
  return {{"time_s", seconds(still.time)},
          {"size", still.size},
          {"view_angle_deg",
           still.viewAngle ? nlohmann::json(*still.viewAngle) : nlohmann::json(nullptr)},
          {"opacity", still.opacity},
          {"landmarks", landmarks},
          {"camera", still.camera ? cameraJson(*still.camera) : nlohmann::json(nullptr)}};
}

// Its bookmarks and stills, and what the file says of itself; of its tags nothing.
nlohmann::json videoJson(const Context& context, const library::Library& library,
                         const scene::Case& value, const scene::Attachment& one)
{
  const VideoNotes notes = one.video ? *one.video : VideoNotes();
  nlohmann::json bookmarks = nlohmann::json::array();
  context.print("  " + one.name);
  nlohmann::json file = nullptr;
  nlohmann::json problem = nullptr;
  try
  {
    const video::VideoFile opened = openVideo(context, library, one);
    const video::VideoInfo& info = opened.info();
    file = {{"width", info.width},
            {"height", info.height},
            {"duration_s", seconds(info.duration.count())},
            {"frame_rate_hz",
             info.frameRate > 0.0 ? nlohmann::json(info.frameRate) : nlohmann::json(nullptr)},
            {"sound", info.hasSound}};
    context.print("    " + std::to_string(info.width) + " x " + std::to_string(info.height) + ", " +
                  fixed(seconds(info.duration.count()), 2) + " s" +
                  (info.frameRate > 0.0 ? ", " + fixed(info.frameRate, 2) + " frames a second"
                                        : ", frames at varying times"));
  }
  catch (const core::Error& error)
  {
    problem = error.what();
    context.print("    cannot be shown: " + std::string(error.what()));
  }
  for (const auto& bookmark : notes.bookmarks)
  {
    const auto stroke = scene::strokeWith(value, bookmark.stroke);
    bookmarks.push_back({{"name", bookmark.name},
                         {"time_s", seconds(bookmark.time)},
                         {"stroke", stroke ? nlohmann::json(dissection::strokeNumber(*stroke))
                                           : nlohmann::json(nullptr)}});
    context.print(
        "    " + presenters::timeText(bookmark.time) + "  " + bookmark.name +
        (stroke ? ", after stroke " + std::to_string(dissection::strokeNumber(*stroke)) : ""));
  }
  nlohmann::json stills = nlohmann::json::array();
  for (const auto& still : notes.stills)
  {
    stills.push_back(stillJson(still));
    context.print("    " + presenters::timeText(still.time) + "  still with " +
                  std::to_string(still.landmarks.size()) + " landmarks" +
                  (still.camera ? "" : ", without a camera"));
  }
  return {{"name", one.name},
          {"file", file},
          {"problem", problem},
          {"bookmarks", bookmarks},
          {"stills", stills}};
}

void setBookmark(VideoNotes& notes, const scene::Case& value, const VideoCommandOptions& options,
                 std::int64_t time)
{
  std::string stroke;
  if (options.stroke)
  {
    const auto& strokes = value.dissection.strokes();
    if (*options.stroke > strokes.size())
      throw core::InvalidParameter("case '" + value.name + "' has " +
                                   std::to_string(strokes.size()) + " strokes, not " +
                                   std::to_string(*options.stroke));
    stroke = strokes[*options.stroke - 1]->object;
  }
  const auto found = std::find_if(notes.bookmarks.begin(), notes.bookmarks.end(),
                                  [wanted = scene::lowerCase(options.bookmark)](const auto& one)
                                  { return scene::lowerCase(one.name) == wanted; });
  if (found == notes.bookmarks.end())
    notes.bookmarks.push_back({options.bookmark, time, stroke});
  else
    *found = {options.bookmark, time, options.stroke ? stroke : found->stroke};
}

presenters::StillFit setStill(const Context& context, VideoNotes& notes,
                              const VideoCommandOptions& options, const video::Frame& frame)
{
  VideoNotes::Still still;
  if (const auto* there = scene::findStill(notes, frame.time.count()))
    still.opacity = there->opacity;
  still.time = frame.time.count();
  still.size = {frame.width, frame.height};
  still.viewAngle = options.viewAngle;
  auto csv = core::openInput(options.pairs);
  still.landmarks = presenters::landmarksFromCsv(csv, options.pairs);
  const presenters::StillFit fit = presenters::fitStill(still, context.progress());
  still.camera = fit.pose.camera;
  notes.stills.erase(std::remove_if(notes.stills.begin(), notes.stills.end(),
                                    [&still](const auto& one) { return one.time == still.time; }),
                     notes.stills.end());
  notes.stills.push_back(still);
  context.print("camera of the still: residual " + fixed(fit.pose.rms, 1) + " px, " +
                fixed(fit.pose.rmsAtLandmarks, 2) + " mm at the landmarks; uncertainty " +
                fixed(fit.pose.rotationSigma, 2) + " degrees, " + fixed(fit.pose.positionSigma, 1) +
                " mm");
  for (const std::size_t n : fit.bad)
    context.warn("landmark " + std::to_string(n + 1) + " does not fit the others and is left out");
  if (fit.isPoor)
    context.warn("the landmarks do not fit each other; add some to tell which is wrong");
  if (fit.pose.ambiguous)
    context.warn(
        "another view explains the landmarks nearly as well; add landmarks of other depth");
  return fit;
}

void writeOverlay(const scene::Case& value, const VideoNotes::Still& still,
                  const VideoCommandOptions& options, const video::Frame& frame)
{
  const auto [width, height] = parseSize(options.size);
  rendering::ScenePicture picture;
  auto contents = presenters::sceneContents(value);
  presenters::clip(contents, value.view.clipping, value.ct.geometry);
  picture.setContents(contents);
  picture.setCamera(*still.camera);
  rendering::OffscreenView view(width, height);
  rendering::Picture drawn =
      presenters::overlaid(view.render(picture), frame, options.opacity.value_or(still.opacity));
  presenters::addLines(drawn, presenters::pictureNotes(value));
  rendering::writePng(options.overlay, drawn);
}

void run(const Context& context, const VideoCommandOptions& options)
{
  if (options.isOfFrame() && !options.at)
    throw UsageError("video: --at SECONDS says which frame");
  if (options.stroke && options.bookmark.empty())
    throw UsageError("--stroke goes with --bookmark");
  if (options.viewAngle && options.pairs.empty())
    throw UsageError("--view-angle goes with --pairs");
  parseSize(options.size);
  context.refuseOverwriting({options.frame, options.overlay}, {options.pairs});
  library::Library library = context.openLibrary();
  scene::Case value = library.open(options.caseName);
  const bool isChange = options.isOfFrame() || !options.removed.empty();
  nlohmann::json answer{{"case", value.name}, {"changed", false}};
  if (isChange)
  {
    scene::Attachment& one = videoOf(value, options.video);
    const VideoNotes before = one.video ? *one.video : VideoNotes();
    VideoNotes notes = before;
    for (const std::string& name : options.removed)
      notes.bookmarks.erase(notes.bookmarks.begin() +
                            static_cast<std::ptrdiff_t>(scene::findBookmark(notes, name)));
    if (options.isOfFrame())
    {
      video::VideoFile file = openVideo(context, library, one);
      const video::Frame frame =
          file.seek(video::Time(static_cast<std::int64_t>(std::llround(1e9 * *options.at))));
      answer["frame_time_s"] = seconds(frame.time.count());
      if (!options.bookmark.empty())
        setBookmark(notes, value, options, frame.time.count());
      if (options.removeStill)
        notes.stills.erase(std::remove_if(notes.stills.begin(), notes.stills.end(),
                                          [&frame](const auto& still)
                                          { return still.time == frame.time.count(); }),
                           notes.stills.end());
      if (!options.pairs.empty())
        answer["fit"] = fitJson(setStill(context, notes, options, frame));
      auto still =
          std::find_if(notes.stills.begin(), notes.stills.end(),
                       [&frame](const auto& each) { return each.time == frame.time.count(); });
      if ((options.opacity || !options.overlay.empty()) &&
          (still == notes.stills.end() || !still->camera))
        throw core::InvalidParameter("the frame at " + presenters::timeText(frame.time.count()) +
                                     " has no camera; give pairs of points with --pairs");
      if (options.opacity)
        still->opacity = *options.opacity;
      if (!options.frame.empty())
        rendering::writePng(options.frame, presenters::pictureOf(frame));
      if (!options.overlay.empty())
        writeOverlay(value, *still, options, frame);
    }
    scene::sortVideoNotes(notes);
    scene::checkVideoNotes(notes);
    if (notes != before)
    {
      one.video = std::make_shared<const VideoNotes>(notes);
      library.save(value, context.progress());
      answer["changed"] = true;
    }
  }
  context.print("case '" + value.name + "'");
  nlohmann::json videos = nlohmann::json::array();
  for (const scene::Attachment& one : value.attachments)
    if (one.kind == scene::Attachment::Kind::Video &&
        (options.video.empty() || scene::lowerCase(one.name) == scene::lowerCase(options.video)))
      videos.push_back(videoJson(context, library, value, one));
  if (videos.empty())
    context.print("  has no video; 'petrous attach' adds one");
  answer["videos"] = std::move(videos);
  context.printJson(answer);
}

} // namespace

void addVideoCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<VideoCommandOptions>();
  CLI::App* command = context.addCommand(
      app, "video", "Videos of a case: bookmarks tied to strokes, frames, and the view of a still",
      [options, &context] { run(context, *options); });
  command->add_option("CASE", options->caseName, "Name of the case")->required();
  command->add_option("--video", options->video, "The attachment (the only video)")
      ->type_name("NAME");
  command
      ->add_option("--at", options->at,
                   "The frame that is shown at this time of the video; for all that follows")
      ->type_name("SECONDS")
      ->check(within({0.0, kLongest, "s"}));
  command
      ->add_option("--bookmark", options->bookmark,
                   "Set a bookmark there; one of the same name is moved")
      ->type_name("NAME");
  command->add_option("--stroke", options->stroke, "The stroke to which it is tied, see history")
      ->type_name("N")
      ->transform(wholeNumber(1, 1000000000));
  command->add_option("--remove", options->removed, "Bookmark to remove, first of all")
      ->allow_extra_args(false)
      ->type_name("NAME");
  command
      ->add_option(
          "--pairs", options->pairs,
          "Find the camera of the frame from pairs of points: columns x_mm, y_mm, z_mm "
          "(patient LPS) and u_px, v_px (from the frame's upper left corner); six, or four "
          "with --view-angle")
      ->type_name("F.csv");
  command
      ->add_option("--view-angle", options->viewAngle,
                   "Vertical angle of view of the frame, if it is known")
      ->type_name("DEGREES")
      ->check(within({0.5, 120.0, "degrees"}));
  command->add_flag("--remove-still", options->removeStill,
                    "Forget landmarks and camera of the frame");
  command->add_option("--frame", options->frame, "Write the frame as a picture")
      ->type_name("F.png")
      ->check(endsIn({".png"}));
  command
      ->add_option("--overlay", options->overlay,
                   "Write the scene from the frame's camera with the frame over it")
      ->type_name("F.png")
      ->check(endsIn({".png"}));
  command->add_option("--size", options->size, "Pixels of the overlay (800x600)")->type_name("WxH");
  command->add_option("--opacity", options->opacity, "Of the frame over the scene; kept")
      ->check(within({0.0, 1.0}));
}

} // namespace petrous::cli
