#include <algorithm>
#include <atomic>
#include <clocale>
#include <cstring>
#include <initializer_list>
#include <mutex>
#include <set>
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
constexpr GstClockTime kTurn = 20 * GST_MSECOND;    // between questions whether to stop
constexpr Time kLeastBack{200'000'000};             // see seek
constexpr Time kLeastGap{100'000'000};              // the first step over a damaged part
constexpr Time kEndsEarly{1'000'000'000};           // before the duration that is stated
constexpr Time kLongest = std::chrono::hours(10'000);

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

GstElement* make(const std::string& name, const char* factory, const char* package)
{
  if (GstElement* element = gst_element_factory_make(factory, nullptr))
    return element;
  throw VideoError(Reason::MissingCodec, name + ": GStreamer's element '" + factory +
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

bool isInstalled(const char* factory)
{
  GstElementFactory* found = gst_element_factory_find(factory);
  if (found)
    gst_object_unref(found);
  return found != nullptr;
}

// The media type, told apart where that matters for what reads it.
std::string kindOf(const GstCaps* caps)
{
  std::string kind = mediaOf(caps);
  if (kind.empty())
    return kind;
  const GstStructure* of = gst_caps_get_structure(caps, 0);
  gint version = 0;
  gboolean isSystem = FALSE;
  if (kind == "video/mpeg" && gst_structure_get_boolean(of, "systemstream", &isSystem) != FALSE &&
      isSystem != FALSE)
    return "video/mpeg-system";
  if (kind == "video/mpeg" && gst_structure_get_int(of, "mpegversion", &version) != FALSE &&
      version == 4)
    return "video/mpeg-4";
  return kind;
}

// Which of Debian's packages has what is missing for streams of that kind.
std::string packagesFor(const GstCaps* caps, bool isAvi)
{
  struct Need
  {
    const char* kind;
    const char* element;
    const char* package;
  };
  constexpr const char* kBad = "gstreamer1.0-plugins-bad";
  constexpr const char* kUgly = "gstreamer1.0-plugins-ugly";
  constexpr const char* kLibav = "gstreamer1.0-libav";
  const Need needs[] = {{"video/mpegts", "tsdemux", kBad},
                        {"video/mpegts", "h264parse", kBad},
                        {"video/mpegts", "avdec_h264", kLibav},
                        {"video/mpeg-system", "mpegpsdemux", kBad},
                        {"video/mpeg-system", "mpegvideoparse", kBad},
                        {"video/mpeg-system", "avdec_mpeg2video", kLibav},
                        {"video/mpeg", "mpegvideoparse", kBad},
                        {"video/mpeg", "avdec_mpeg2video", kLibav},
                        {"video/mpeg-4", "avdec_mpeg4", kLibav},
                        {"video/x-h264", "avdec_h264", kLibav},
                        {"video/x-h264-avi", "h264parse", kBad},
                        {"video/x-h264-avi", "avdec_h264", kLibav},
                        {"video/x-h265", "avdec_h265", kLibav},
                        {"video/x-h265-avi", "h265parse", kBad},
                        {"video/x-h265-avi", "avdec_h265", kLibav},
                        {"video/x-ms-asf", "asfdemux", kUgly},
                        {"video/x-ms-asf", "avdec_wmv3", kLibav},
                        {"video/x-wmv", "avdec_wmv3", kLibav},
                        {"application/mxf", "mxfdemux", kBad},
                        {"video/x-av1", "av1dec", kBad}};
  const std::string kind = kindOf(caps) + (isAvi && isAny(caps, {"video/x-h26"}) ? "-avi" : "");
  std::set<std::string> packages;
  for (const Need& need : needs)
    if (kind == need.kind && !isInstalled(need.element))
      packages.insert(need.package);
  if (packages.empty())
    packages = {kLibav, "gstreamer1.0-plugins-good"};
  std::string text;
  for (const std::string& one : packages)
    text += (text.empty() ? "" : " and ") + one;
  return (packages.size() > 1 ? "packages " : "package ") + text;
}

enum class Coding
{
  Mpeg2,
  Mpeg4,
  H264
};

// Whether the first picture of a packet may be shown before the one that was stored before it, from
// its coding type [ISO 13818-2, 6.3.9; ISO 14496-2, 6.2.5; ITU-T H.264, 7.3.3].
bool isBidirectional(const std::uint8_t* data, std::size_t size, Coding coding)
{
  for (std::size_t n = 0; n + 5 < size; ++n)
  {
    if (data[n] != 0 || data[n + 1] != 0 || data[n + 2] != 1)
      continue;
    const std::uint8_t code = data[n + 3];
    if (coding == Coding::Mpeg2 && code == 0)
      return (data[n + 5] >> 3 & 7) == 3;
    if (coding == Coding::Mpeg4 && code == 0xb6)
      return data[n + 4] >> 6 == 2;
    if (coding != Coding::H264 || ((code & 0x1f) != 1 && (code & 0x1f) != 5))
      continue;
    std::size_t bit = 8 * (n + 4);
    const auto take = [&]
    {
      const unsigned one = bit < 8 * size ? data[bit / 8] >> (7 - bit % 8) & 1U : 1U;
      ++bit;
      return one;
    };
    const auto number = [&] // Exp-Golomb
    {
      int zeros = 0;
      while (take() == 0 && zeros < 31)
        ++zeros;
      unsigned value = 1;
      for (int k = 0; k < zeros; ++k)
        value = 2 * value + take();
      return value - 1;
    };
    number(); // first_mb_in_slice
    return number() % 5 == 1;
  }
  return false;
}

} // namespace

class VideoFile::Implementation
{
public:
  Implementation(const std::filesystem::path& file, std::string name,
                 std::function<bool()> isStopped)
    : m_name(std::move(name))
    , m_isStopped(std::move(isStopped))
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
    gint64 duration = 0;
    if (gst_element_query_duration(m_pipeline.get(), GST_FORMAT_TIME, &duration) != FALSE)
      info.duration = Time(std::max<gint64>(duration, 0));
    lookAhead();
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

  std::optional<Gap> gap() const noexcept
  {
    if (!m_hasGap)
      return std::nullopt;
    return Gap{m_frame.time, nextTime()};
  }

  bool next()
  {
    if (!m_ahead)
      return false;
    m_frame = std::move(*m_ahead);
    lookAhead();
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
  // it does. So a seek goes some frames back, and frames are counted from there. Beyond the end
  // that the file states it is read on, as that may be wrong.
  void seek(Time time)
  {
    time = std::clamp(time, m_first, std::max(m_first, kLongest));
    if (!m_isLost && time >= m_frame.time && isKnownUpTo(time))
      return;
    // Not far ahead it is quicker to go on than to decode anew from a key frame.
    if (m_ahead && !m_hasGap && time >= m_ahead->time && time < m_ahead->time + kLeastBack)
    {
      advance(time);
      if (isKnownUpTo(time))
        return;
    }
    const Time near = info.duration > Time(0) ? std::min(time, info.duration) : time;
    for (Time back = kLeastBack;; back *= 4)
    {
      const Time from = near > back ? near - back : Time(0);
      const bool isStart = from == Time(0);
      if (jump(from))
      {
        const Time landed = m_frame.time;
        advance(time);
        if ((m_frame.time > landed && m_frame.time <= time) || isStart)
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
    GstElement* source = add(make(m_name, "filesrc", "libgstreamer1.0-0"));
    GstElement* decoder = add(make(m_name, "decodebin", "gstreamer1.0-plugins-base"));
    g_object_set(source, "location", file.c_str(), nullptr);
    gst_element_link(source, decoder);

    m_convert = add(make(m_name, "videoconvert", "gstreamer1.0-plugins-base"));
    GstElement* latest = m_convert;
    const auto append = [this, &latest](GstElement* next)
    {
      gst_element_link(latest, add(next));
      latest = next;
    };
    GstElement* flip = make(m_name, "videoflip", "gstreamer1.0-plugins-good");
    gst_util_set_object_arg(G_OBJECT(flip), "video-direction", "auto"); // as a phone was held
    append(flip);
    append(make(m_name, "videoscale", "gstreamer1.0-plugins-base")); // to square pixels
    m_sink = make(m_name, "appsink", "gstreamer1.0-plugins-base");
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

  // Sound and subtitles are left as they are: their decoders need not be installed. Nothing but
  // containers and pictures is opened: playlists and descriptions of streams lead into networks.
  static gboolean continues(GstElement* /*bin*/, GstPad* /*pad*/, GstCaps* caps, gpointer self)
  {
    if (isAny(caps, {"video/", "image/", "application/ogg", "application/mxf"}))
      return TRUE;
    if (!isAny(caps, {"audio/", "text/", "subpicture/", "closedcaption/"}))
      static_cast<Implementation*>(self)->m_isRefused = true;
    return FALSE;
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
    const GstElementFactory* factory = gst_element_get_factory(element);
    if (factory && std::strcmp(GST_OBJECT_NAME(factory), "avidemux") == 0)
    {
      static_cast<Implementation*>(self)->m_isAvi = true;
      g_signal_connect(element, "pad-added", G_CALLBACK(&Implementation::partOfAvi), self);
    }
  }

  // AVI has no times of its frames: they follow from their places. avidemux gives key frames those
  // of the order in which they are stored, which leads the decoder astray. Without, it hands them
  // out by their order. Frames that are stored after a key frame and shown before it cannot be
  // decoded after a seek: it counts too few by them.
  static void partOfAvi(GstElement* /*demultiplexer*/, GstPad* pad, gpointer self)
  {
    const Owned<GstCaps> caps(gst_pad_get_current_caps(pad));
    auto* me = static_cast<Implementation*>(self);
    const std::string kind = kindOf(caps.get());
    const bool isMpeg4 =
        isAny(caps.get(), {"video/x-divx", "video/x-xvid"}) || kind == "video/mpeg-4";
    const bool isH264 = isAny(caps.get(), {"video/x-h264"});
    me->m_coding = isMpeg4 ? Coding::Mpeg4 : isH264 ? Coding::H264 : Coding::Mpeg2;
    if (isMpeg4 || isH264 || kind == "video/mpeg")
      gst_pad_add_probe(
          pad,
          static_cast<GstPadProbeType>(GST_PAD_PROBE_TYPE_BUFFER | GST_PAD_PROBE_TYPE_EVENT_FLUSH),
          &Implementation::packetOfAvi, self, nullptr);
  }

  static GstPadProbeReturn packetOfAvi(GstPad* /*pad*/, GstPadProbeInfo* info, gpointer self)
  {
    auto* me = static_cast<Implementation*>(self);
    if (!(GST_PAD_PROBE_INFO_TYPE(info) & GST_PAD_PROBE_TYPE_BUFFER))
    {
      me->m_references = 0;
      me->m_leading = 0;
      return GST_PAD_PROBE_OK;
    }
    GstBuffer* buffer = gst_buffer_make_writable(GST_PAD_PROBE_INFO_BUFFER(info));
    GST_PAD_PROBE_INFO_DATA(info) = buffer;
    if (GST_BUFFER_DTS_IS_VALID(buffer))
      GST_BUFFER_PTS(buffer) = GST_CLOCK_TIME_NONE;
    GstMapInfo bytes;
    if (gst_buffer_map(buffer, &bytes, GST_MAP_READ) == FALSE)
      return GST_PAD_PROBE_OK;
    const bool isB = isBidirectional(bytes.data, bytes.size, me->m_coding);
    gst_buffer_unmap(buffer, &bytes);
    if (!isB)
      ++me->m_references;
    else if (me->m_coding == Coding::H264)
      me->m_isReordered = true;
    else if (me->m_references == 1 && GST_BUFFER_DURATION_IS_VALID(buffer))
      me->m_leading += static_cast<Time::rep>(GST_BUFFER_DURATION(buffer));
    return GST_PAD_PROBE_OK;
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
        GstCaps* caps = nullptr;
        gst_structure_get(gst_message_get_structure(message.get()), "detail", GST_TYPE_CAPS, &caps,
                          nullptr);
        const Owned<GstCaps> owned(caps);
        if (what)
          m_missing = what.get();
        m_remedy = packagesFor(caps, m_isAvi);
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
      throw VideoError(Reason::MissingCodec, m_name + ": no decoder for it is installed (" +
                                                 m_missing + "); install Debian's " + m_remedy);
    if (m_isForeign || (m_isRefused && !m_hasPicture && !m_hasSound))
      throw VideoError(Reason::NotAVideo, m_name + ": not a video that can be read; a file such as "
                                                   "MP4, MOV, MKV, WebM or AVI is wanted");
    if (m_hasSound && !m_hasPicture)
      throw VideoError(Reason::NoPicture, m_name + ": it has sound only, and no picture");
    throw VideoError(Reason::Damaged,
                     m_name +
                         ": damaged, or not whole: no frame of it can be decoded; copy it anew");
  }

  void checkStopped() const
  {
    if (m_isStopped && m_isStopped())
      throw VideoError(Reason::Interrupted, m_name + ": interrupted");
  }

  // None at the end, or where it cannot be decoded any more (m_isBroken).
  std::optional<Frame> pull()
  {
    for (GstClockTime waited = 0; waited < kPatience; waited += kTurn)
    {
      checkStopped();
      const Owned<GstSample> sample(gst_app_sink_try_pull_sample(GST_APP_SINK(m_sink), kTurn));
      if (m_isReordered)
        throw VideoError(Reason::NotExact,
                         m_name + ": AVI does not tell when the frames of such an H.264 video are "
                                  "shown; convert it to MP4 (ffmpeg -i video.avi video.mp4)");
      if (sample)
      {
        auto frame = frameOf(*sample);
        if (!frame || (m_latest && frame->time <= *m_latest))
        {
          waited = 0;
          continue;
        }
        m_latest = frame->time;
        const GstClockTime lasts = GST_BUFFER_DURATION(gst_sample_get_buffer(sample.get()));
        m_latestEnd =
            frame->time + Time(GST_CLOCK_TIME_IS_VALID(lasts) ? static_cast<Time::rep>(lasts) : 0);
        if (info.duration > Time(0)) // which may be stated too short
          info.duration = std::max(info.duration, m_latestEnd);
        return frame;
      }
      hear();
      if (m_isBroken || m_isEmpty || (m_allPads && !m_hasPicture) ||
          gst_app_sink_is_eos(GST_APP_SINK(m_sink)) != FALSE)
        return std::nullopt;
    }
    throw VideoError(Reason::Stalled, m_name + ": the decoder does not answer; open it again");
  }

  // Whether m_frame is the one of that time, or any before the next.
  bool isKnownUpTo(Time time) const
  {
    return m_ahead ? time < m_ahead->time && !m_hasGap : m_isAtEnd;
  }

  // The frame after m_frame. Damage ends what comes from the source, with an error or without: then
  // it is gone on beyond.
  void lookAhead()
  {
    m_ahead.reset();
    m_hasGap = m_isAtEnd = false;
    m_ahead = pull();
    if (m_ahead)
      return;
    m_hasGap = m_isBroken || info.duration > m_latestEnd + kEndsEarly;
    m_isAtEnd = !m_hasGap;
    if (m_isAtEnd)
      return;
    for (Time over = kLeastGap; m_frame.time + over < info.duration; over *= 2)
    {
      m_latest.reset();
      // The first frame after a seek is clipped.
      if (!go(m_frame.time + over) || !pull())
        continue;
      m_latest = std::max(*m_latest, m_frame.time);
      m_ahead = pull();
      if (m_ahead)
        return;
    }
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
      frame.time = Time(static_cast<Time::rep>(stamp) + m_leading);
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

  // False where it cannot be gone to.
  bool go(Time to)
  {
    if (m_isBroken) // an error stops the source
    {
      gst_element_set_state(m_pipeline.get(), GST_STATE_READY);
      hear();
      m_isBroken = false;
      gst_element_set_state(m_pipeline.get(), GST_STATE_PAUSED);
      for (GstClockTime waited = 0; waited < kPatience; waited += kTurn)
      {
        checkStopped();
        if (gst_element_get_state(m_pipeline.get(), nullptr, nullptr, kTurn) !=
            GST_STATE_CHANGE_ASYNC)
          break;
      }
      gst_element_set_state(m_pipeline.get(), GST_STATE_PLAYING);
    }
    // In AVI frames are counted from the key frame on, so that none may be clipped.
    const int how = m_isAvi ? GST_SEEK_FLAG_KEY_UNIT | GST_SEEK_FLAG_SNAP_BEFORE
                            : static_cast<int>(GST_SEEK_FLAG_ACCURATE);
    return gst_element_seek_simple(m_pipeline.get(), GST_FORMAT_TIME,
                                   static_cast<GstSeekFlags>(GST_SEEK_FLAG_FLUSH | how),
                                   to.count()) != FALSE;
  }

  // False where no frame comes any more.
  bool jump(Time from)
  {
    m_latest.reset();
    m_ahead.reset();
    m_hasGap = m_isAtEnd = false;
    m_isLost = true;
    if (!go(from))
      return false;
    auto frame = pull();
    if (!frame)
      return false;
    m_frame = std::move(*frame);
    lookAhead();
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
  std::function<bool()> m_isStopped;
  std::unique_ptr<GstElement, Stopped> m_pipeline;
  GstElement* m_convert = nullptr; // these two are the pipeline's
  GstElement* m_sink = nullptr;
  Frame m_frame;
  std::optional<Frame> m_ahead; // the one after it
  std::optional<Time> m_latest; // of what was pulled since the last jump
  Time m_latestEnd{0};
  Time m_first{0};
  std::string m_missing; // decoder
  std::string m_remedy;  // packages
  bool m_isBroken = false;
  bool m_isAtEnd = false; // m_frame is the last one, and nothing is missing
  bool m_hasGap = false;  // after m_frame
  bool m_isLost = false;  // a jump led nowhere
  bool m_isForeign = false;
  std::atomic<bool> m_hasPicture{false}, m_hasSound{false}, m_allPads{false}, m_isEmpty{false};
  std::atomic<bool> m_isRefused{false}; // a part of it, or all
  std::atomic<bool> m_isAvi{false}, m_isReordered{false};
  std::atomic<Coding> m_coding{Coding::Mpeg4}; // in AVI
  std::atomic<int> m_references{0};            // pictures that others refer to, since the last seek
  std::atomic<Time::rep> m_leading{0};         // of the first of them, in AVI
};

bool isSupported() noexcept
{
  return true;
}

VideoFile::VideoFile(const std::filesystem::path& file, const std::string& name,
                     std::function<bool()> isStopped)
  : m_implementation(std::make_unique<Implementation>(
        file, name.empty() ? file.filename().string() : name, std::move(isStopped)))
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

std::optional<Gap> VideoFile::gap() const noexcept
{
  return m_implementation->gap();
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
