#include <algorithm>
#include <atomic>
#include <clocale>
#include <cstring>
#include <initializer_list>
#include <mutex>
#include <utility>

#include <gst/app/gstappsink.h>
#include <gst/gst.h>
#include <gst/pbutils/pbutils.h>
#include <gst/video/video.h>

#include "petrous/Core/InputFile.h"
#include "petrous/Video/VideoFile.h"

namespace petrous::video
{

namespace
{

using Reason = VideoError::Reason;

constexpr GstClockTime kPatience = 20 * GST_SECOND; // for one frame
constexpr Time kLeastBack{200'000'000};             // see seek

struct Unref
{
  void operator()(gpointer object) const { gst_object_unref(object); }
  void operator()(GstMessage* message) const { gst_message_unref(message); }
  void operator()(GstSample* sample) const { gst_sample_unref(sample); }
  void operator()(GstCaps* caps) const { gst_caps_unref(caps); }
  void operator()(GError* error) const { g_error_free(error); }
  void operator()(gchar* text) const { g_free(text); }
};
template <class T>
using Owned = std::unique_ptr<T, Unref>;

// GStreamer is started with the first video, and keeps the program's locale.
void startGStreamer()
{
  static std::once_flag once;
  std::call_once(once,
                 []
                 {
                   const std::string locale = std::setlocale(LC_ALL, nullptr);
                   GError* error = nullptr;
                   const bool isUp = gst_init_check(nullptr, nullptr, &error) != FALSE;
                   std::setlocale(LC_ALL, locale.c_str());
                   const Owned<GError> owned(error);
                   if (!isUp)
                     throw VideoError(Reason::Stalled,
                                      std::string("GStreamer cannot be started") +
                                          (error ? std::string(": ") + error->message : ""));
                   gst_pb_utils_init();
                 });
}

GstElement* make(const char* factory, const char* package)
{
  if (GstElement* element = gst_element_factory_make(factory, nullptr))
    return element;
  throw VideoError(Reason::MissingCodec, std::string("GStreamer's element '") + factory +
                                             "' is missing; install Debian's package " + package);
}

const char* mediaOf(const GstCaps* caps)
{
  return caps && gst_caps_get_size(caps) > 0
             ? gst_structure_get_name(gst_caps_get_structure(caps, 0))
             : "";
}

bool isAny(const GstCaps* caps, std::initializer_list<const char*> media)
{
  return std::any_of(media.begin(), media.end(),
                     [of = mediaOf(caps)](const char* one)
                     { return std::strncmp(of, one, std::strlen(one)) == 0; });
}

} // namespace

class VideoFile::Implementation
{
public:
  Implementation(const std::filesystem::path& file, std::string name)
    : m_name(std::move(name))
  {
    checkReadable(file);
    startGStreamer();
    build(file);
    // The sink takes frames as fast as they come and holds a few: playing is the caller's.
    if (gst_element_set_state(m_pipeline.get(), GST_STATE_PLAYING) == GST_STATE_CHANGE_FAILURE)
      fail();
    const auto first = pull();
    if (!first)
      fail();
    m_frame = *first;
    m_first = first->time;
    m_ahead = pull();
    gint64 duration = 0;
    if (gst_element_query_duration(m_pipeline.get(), GST_FORMAT_TIME, &duration) != FALSE)
      info.duration = Time(std::max<gint64>(duration, 0));
    info.width = m_frame.width;
    info.height = m_frame.height;
    info.hasSound = m_hasSound;
  }

  ~Implementation() = default;
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  const Frame& frame() const noexcept { return m_frame; }
  std::optional<Time> nextTime() const noexcept
  {
    return m_ahead ? std::optional<Time>(m_ahead->time) : std::nullopt;
  }

  bool next()
  {
    if (!m_ahead)
      return false;
    m_frame = std::move(*m_ahead);
    m_ahead = pull();
    return true;
  }

  bool previous()
  {
    if (m_frame.time <= m_first)
      return false;
    seek(m_frame.time - Time(1));
    return true;
  }

  // A decoder clips the first frame after a seek: it then begins where the seek went, and not where
  // it does. So a seek goes some frames back, and frames are counted from there.
  void seek(Time time)
  {
    if (info.duration > Time(0))
      time = std::min(time, info.duration);
    time = std::max(time, m_first);
    if (!m_isLost && time >= m_frame.time && (!m_ahead || time < m_ahead->time))
      return;
    // Not far ahead it is quicker to go on than to decode anew from a key frame.
    if (m_ahead && time >= m_ahead->time && time < m_ahead->time + kLeastBack)
      return advance(time);
    for (Time back = kLeastBack;; back *= 4)
    {
      const Time from = time > back ? time - back : Time(0);
      const bool isStart = from == Time(0);
      if (jump(from))
      {
        const Time landed = m_frame.time;
        advance(time);
        if (m_frame.time > landed || isStart)
          return;
      }
      else if (isStart)
        throw VideoError(Reason::Damaged, m_name + ": it cannot be read any more");
    }
  }

  VideoInfo info;

private:
  void checkReadable(const std::filesystem::path& file) const
  {
    try
    {
      if (core::InputFile(file).size() == 0) // of a regular file
        throw VideoError(Reason::NotAVideo, m_name + ": the file is empty");
    }
    catch (const core::InputFileError& error)
    {
      throw VideoError(Reason::NotReadable, m_name + ": " + error.problem);
    }
  }

  void build(const std::filesystem::path& file)
  {
    m_pipeline.reset(GST_ELEMENT(gst_object_ref_sink(gst_pipeline_new(nullptr))));
    GstElement* source = add(make("filesrc", "libgstreamer1.0-0"));
    GstElement* decoder = add(make("decodebin", "gstreamer1.0-plugins-base"));
    g_object_set(source, "location", file.c_str(), nullptr);
    gst_element_link(source, decoder);

    m_convert = add(make("videoconvert", "gstreamer1.0-plugins-base"));
    GstElement* latest = m_convert;
    const auto append = [this, &latest](GstElement* next)
    {
      gst_element_link(latest, add(next));
      latest = next;
    };
    if (GstElement* flip = gst_element_factory_make("videoflip", nullptr)) // of plugins-good
    {
      gst_util_set_object_arg(G_OBJECT(flip), "video-direction", "auto"); // as a phone was held
      append(flip);
    }
    append(make("videoscale", "gstreamer1.0-plugins-base")); // to square pixels
    m_sink = make("appsink", "gstreamer1.0-plugins-base");
    const Owned<GstCaps> caps(
        gst_caps_from_string("video/x-raw, format=RGB, pixel-aspect-ratio=1/1"));
    g_object_set(m_sink, "caps", caps.get(), "sync", FALSE, "max-buffers", 3U, nullptr);
    append(m_sink);

    g_signal_connect(decoder, "element-added", G_CALLBACK(&Implementation::elementAdded), this);
    g_signal_connect(decoder, "autoplug-continue", G_CALLBACK(&Implementation::continues), this);
    g_signal_connect(decoder, "pad-added", G_CALLBACK(&Implementation::padAdded), this);
    g_signal_connect(decoder, "no-more-pads", G_CALLBACK(&Implementation::allPads), this);
  }

  GstElement* add(GstElement* element)
  {
    gst_bin_add(GST_BIN(m_pipeline.get()), element);
    return element;
  }

  // Sound and subtitles are left as they are: their decoders need not be installed.
  static gboolean continues(GstElement* /*bin*/, GstPad* /*pad*/, GstCaps* caps, gpointer /*self*/)
  {
    return isAny(caps, {"audio/", "text/", "subpicture/", "closedcaption/",
                        "application/x-subtitle", "application/x-ssa", "application/x-ass"})
               ? FALSE
               : TRUE;
  }

  // The first picture is shown. In a thread of GStreamer.
  static void padAdded(GstElement* /*bin*/, GstPad* pad, gpointer self)
  {
    auto* me = static_cast<Implementation*>(self);
    Owned<GstCaps> caps(gst_pad_get_current_caps(pad));
    if (!caps)
      caps.reset(gst_pad_query_caps(pad, nullptr));
    const Owned<GstPad> into(gst_element_get_static_pad(me->m_convert, "sink"));
    if (isAny(caps.get(), {"video/x-raw"}) && !gst_pad_is_linked(into.get()))
    {
      me->m_hasPicture = true;
      gst_pad_link(pad, into.get());
      return;
    }
    if (isAny(caps.get(), {"audio/"}))
      me->m_hasSound = true;
    GstElement* drain = gst_element_factory_make("fakesink", nullptr);
    g_object_set(drain, "sync", FALSE, "async", FALSE, nullptr);
    me->add(drain);
    const Owned<GstPad> sink(gst_element_get_static_pad(drain, "sink"));
    gst_pad_link(pad, sink.get());
    gst_element_sync_state_with_parent(drain);
  }

  // decodebin may lose the error of a demultiplexer that finds no stream.
  static void elementAdded(GstBin* /*bin*/, GstElement* element, gpointer self)
  {
    g_signal_connect(element, "no-more-pads", G_CALLBACK(&Implementation::partsKnown), self);
  }

  static void partsKnown(GstElement* element, gpointer self)
  {
    GST_OBJECT_LOCK(element);
    const bool isEmpty = element->numsrcpads == 0;
    GST_OBJECT_UNLOCK(element);
    if (isEmpty)
      static_cast<Implementation*>(self)->m_isEmpty = true;
  }

  static void allPads(GstElement* /*bin*/, gpointer self)
  {
    static_cast<Implementation*>(self)->m_allPads = true;
  }

  // Decoding errors, and decoders that are missing. Tags are dropped unread.
  void hear()
  {
    const Owned<GstBus> bus(gst_element_get_bus(m_pipeline.get()));
    while (const Owned<GstMessage> message{gst_bus_pop(bus.get())})
    {
      if (gst_is_missing_plugin_message(message.get()))
      {
        const Owned<gchar> what(gst_missing_plugin_message_get_description(message.get()));
        if (what)
          m_missing = what.get();
      }
      if (GST_MESSAGE_TYPE(message.get()) != GST_MESSAGE_ERROR)
        continue;
      GError* error = nullptr;
      gst_message_parse_error(message.get(), &error, nullptr);
      const Owned<GError> owned(error);
      m_isBroken = true;
      m_isForeign = m_isForeign ||
                    g_error_matches(error, GST_STREAM_ERROR, GST_STREAM_ERROR_TYPE_NOT_FOUND) ||
                    g_error_matches(error, GST_STREAM_ERROR, GST_STREAM_ERROR_WRONG_TYPE);
    }
  }

  // Why there is no first frame.
  [[noreturn]] void fail()
  {
    hear();
    if (!m_missing.empty() && !m_hasPicture)
      throw VideoError(Reason::MissingCodec,
                       m_name + ": no decoder for it is installed (" + m_missing +
                           "); install Debian's packages gstreamer1.0-plugins-good and "
                           "gstreamer1.0-libav");
    if (m_isForeign)
      throw VideoError(Reason::NotAVideo, m_name + ": not a video that can be read; a file such as "
                                                   "MP4, MOV, MKV, WebM or AVI is wanted");
    if (m_hasSound && !m_hasPicture)
      throw VideoError(Reason::NoPicture, m_name + ": it has sound only, and no picture");
    throw VideoError(Reason::Damaged,
                     m_name +
                         ": damaged, or not whole: no frame of it can be decoded; copy it anew");
  }

  // None at the end, or where it cannot be decoded any more.
  std::optional<Frame> pull()
  {
    constexpr GstClockTime kTurn = 20 * GST_MSECOND;
    for (GstClockTime waited = 0; waited < kPatience; waited += kTurn)
    {
      const Owned<GstSample> sample(gst_app_sink_try_pull_sample(GST_APP_SINK(m_sink), kTurn));
      if (sample)
      {
        auto frame = frameOf(*sample);
        if (!frame || (m_latest && frame->time <= *m_latest))
        {
          waited = 0;
          continue;
        }
        m_latest = frame->time;
        return frame;
      }
      hear();
      if (m_isBroken || m_isEmpty || (m_allPads && !m_hasPicture) ||
          gst_app_sink_is_eos(GST_APP_SINK(m_sink)) != FALSE)
        return std::nullopt;
    }
    throw VideoError(Reason::Stalled, m_name + ": the decoder does not answer; open it again");
  }

  std::optional<Frame> frameOf(GstSample& sample)
  {
    GstVideoInfo layout;
    GstVideoFrame mapped;
    GstBuffer* buffer = gst_sample_get_buffer(&sample);
    if (!buffer || gst_video_info_from_caps(&layout, gst_sample_get_caps(&sample)) == FALSE ||
        gst_video_frame_map(&mapped, &layout, buffer, GST_MAP_READ) == FALSE)
      return std::nullopt;
    Frame frame;
    frame.width = GST_VIDEO_FRAME_WIDTH(&mapped);
    frame.height = GST_VIDEO_FRAME_HEIGHT(&mapped);
    const auto row = 3 * static_cast<std::size_t>(frame.width);
    auto pixels = std::make_shared<std::vector<std::uint8_t>>(row * frame.height);
    const auto* from = static_cast<const std::uint8_t*>(GST_VIDEO_FRAME_PLANE_DATA(&mapped, 0));
    const auto stride = static_cast<std::size_t>(GST_VIDEO_FRAME_PLANE_STRIDE(&mapped, 0));
    for (std::size_t y = 0; y < static_cast<std::size_t>(frame.height); ++y)
      std::memcpy(pixels->data() + y * row, from + y * stride, row);
    gst_video_frame_unmap(&mapped);
    frame.pixels = std::move(pixels);
    info.frameRate = layout.fps_n > 0 && layout.fps_d > 0
                         ? static_cast<double>(layout.fps_n) / layout.fps_d
                         : 0.0;
    const GstClockTime stamp = gst_segment_to_stream_time(gst_sample_get_segment(&sample),
                                                          GST_FORMAT_TIME, GST_BUFFER_PTS(buffer));
    if (GST_BUFFER_PTS_IS_VALID(buffer) && GST_CLOCK_TIME_IS_VALID(stamp))
      frame.time = Time(static_cast<Time::rep>(stamp));
    else if (m_latest) // by the rate, where the file gives no times
      frame.time =
          *m_latest +
          Time(static_cast<Time::rep>(1e9 / (info.frameRate > 0.0 ? info.frameRate : 25.0)));
    return frame;
  }

  void advance(Time time)
  {
    while (m_ahead && m_ahead->time <= time)
      next();
  }

  // False where no frame comes any more.
  bool jump(Time from)
  {
    if (m_isBroken) // an error stops the source
    {
      gst_element_set_state(m_pipeline.get(), GST_STATE_READY);
      m_isBroken = false;
      gst_element_set_state(m_pipeline.get(), GST_STATE_PAUSED);
      gst_element_get_state(m_pipeline.get(), nullptr, nullptr, kPatience);
      gst_element_set_state(m_pipeline.get(), GST_STATE_PLAYING);
    }
    m_latest.reset();
    m_ahead.reset();
    m_isLost = true;
    if (gst_element_seek_simple(
            m_pipeline.get(), GST_FORMAT_TIME,
            static_cast<GstSeekFlags>(GST_SEEK_FLAG_FLUSH | GST_SEEK_FLAG_ACCURATE),
            from.count()) == FALSE)
      return false;
    auto frame = pull();
    if (!frame)
      return false;
    m_frame = std::move(*frame);
    m_ahead = pull();
    m_isLost = false;
    return true;
  }

  struct Stopped // also where a constructor throws
  {
    void operator()(GstElement* pipeline) const
    {
      gst_element_set_state(pipeline, GST_STATE_NULL);
      gst_object_unref(pipeline);
    }
  };

  std::string m_name; // in messages
  std::unique_ptr<GstElement, Stopped> m_pipeline;
  GstElement* m_convert = nullptr; // these two are the pipeline's
  GstElement* m_sink = nullptr;
  Frame m_frame;
  std::optional<Frame> m_ahead; // the one after it
  std::optional<Time> m_latest; // of what was pulled since the last jump
  Time m_first{0};
  std::string m_missing; // decoder
  bool m_isBroken = false;
  bool m_isLost = false; // a jump led nowhere
  bool m_isForeign = false;
  std::atomic<bool> m_hasPicture{false}, m_hasSound{false}, m_allPads{false}, m_isEmpty{false};
};

bool isSupported() noexcept
{
  return true;
}

VideoFile::VideoFile(const std::filesystem::path& file, const std::string& name)
  : m_implementation(
        std::make_unique<Implementation>(file, name.empty() ? file.filename().string() : name))
{
}

VideoFile::~VideoFile() = default;
VideoFile::VideoFile(VideoFile&& other) noexcept = default;
VideoFile& VideoFile::operator=(VideoFile&& other) noexcept = default;

const VideoInfo& VideoFile::info() const noexcept
{
  return m_implementation->info;
}

const Frame& VideoFile::current() const noexcept
{
  return m_implementation->frame();
}

std::optional<Time> VideoFile::nextTime() const noexcept
{
  return m_implementation->nextTime();
}

const Frame& VideoFile::seek(Time time)
{
  m_implementation->seek(time);
  return current();
}

bool VideoFile::next()
{
  return m_implementation->next();
}

bool VideoFile::previous()
{
  return m_implementation->previous();
}

} // namespace petrous::video
