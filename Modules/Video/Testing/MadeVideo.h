#pragma once

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <gst/app/gstappsrc.h>
#include <gst/gst.h>
#include <gtest/gtest.h>

#include "petrous/Video/VideoFile.h"

// Videos whose frames carry their number in their pixels, made by GStreamer.
namespace petrous::video::made
{

constexpr int kColumns = 8, kRows = 2; // of blocks, one a bit

struct Kind
{
  const char* name;
  const char* encoder; ///< elements up to the muxer
  const char* muxer;
};
constexpr Kind kRawAvi{"raw.avi", "video/x-raw,format=I420", "avimux"};
constexpr Kind kRawMatroska{"raw.mkv", "video/x-raw,format=I420", "matroskamux"};
constexpr Kind kFfv1{"ffv1.mkv", "avenc_ffv1", "matroskamux"};
// Key frames far apart.
constexpr Kind kVp8{"vp8.webm", "vp8enc deadline=1 keyframe-max-dist=80", "webmmux"};
constexpr Kind kVp8Keys{"keys.webm", "vp8enc deadline=1 keyframe-max-dist=10", "webmmux"};
// AVI has no times, and stores frames in another order than they are shown.
constexpr Kind kMpeg4Avi{"mpeg4.avi", "avenc_mpeg4 max-bframes=2 gop-size=12 bitrate=2000000",
                         "avimux"};
constexpr Kind kTheora{"theora.ogg", "theoraenc keyframe-auto=false keyframe-force=64", "oggmux"};
// As cameras write it: frames are stored in another order than they are shown. By ffmpeg, as
// GStreamer's encoder is in a package of its own.
constexpr Kind kH264{"h264.mp4", "ffmpeg", ""};

inline bool has(const char* factory)
{
  gst_init(nullptr, nullptr);
  GstElementFactory* found = gst_element_factory_find(factory);
  if (found)
    gst_object_unref(found);
  return found != nullptr;
}

inline bool hasFfmpeg()
{
  return std::system("ffmpeg -version >/dev/null 2>&1") == 0;
}

inline bool canMake(const Kind& kind)
{
  const std::string encoder(kind.encoder);
  if (encoder == "ffmpeg")
    return hasFfmpeg() && has("avdec_h264");
  return has(kind.muxer) &&
         (encoder.rfind("video/", 0) == 0 || has(encoder.substr(0, encoder.find(' ')).c_str()));
}

inline std::vector<std::uint8_t> pixelsOf(int number, int width, int height)
{
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(3 * width * height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
    {
      const int bit = x * kColumns / width + kColumns * (y * kRows / height);
      std::memset(&pixels[static_cast<std::size_t>(3 * (y * width + x))],
                  number >> bit & 1 ? 235 : 20, 3);
    }
  return pixels;
}

/// -1: there is no frame.
inline int numberOf(const Frame& frame)
{
  if (!frame.pixels)
    return -1;
  int number = 0;
  for (int bit = 0; bit < kColumns * kRows; ++bit)
  {
    const int x = (2 * (bit % kColumns) + 1) * frame.width / (2 * kColumns);
    const int y = (2 * (bit / kColumns) + 1) * frame.height / (2 * kRows);
    if ((*frame.pixels)[static_cast<std::size_t>(3 * (y * frame.width + x))] > 128)
      number |= 1 << bit;
  }
  return number;
}

struct Options
{
  int frames = 100;
  int width = 128, height = 64;
  std::function<std::int64_t(int)> millisecond = [](int n) { return 40 * n; };
  std::string caps = "framerate=25/1";
  std::string more;  ///< elements before the encoder
  std::string sound; ///< elements into the muxer "m."
};

inline void writeByFfmpeg(const std::string& file, const Options& options,
                          const std::string& encoder = "-c:v libx264 -bf 3 -g 60 -pix_fmt yuv420p")
{
  std::ofstream raw(file + ".raw", std::ios::binary);
  for (int n = 0; n < options.frames; ++n)
  {
    const auto pixels = pixelsOf(n, options.width, options.height);
    raw.write(reinterpret_cast<const char*>(pixels.data()),
              static_cast<std::streamsize>(pixels.size()));
  }
  raw.close();
  const std::string line = "ffmpeg -loglevel error -y -f rawvideo -pix_fmt rgb24 -s " +
                           std::to_string(options.width) + "x" + std::to_string(options.height) +
                           " -r 25 -i '" + file + ".raw' " + encoder + " '" + file + "' </dev/null";
  ASSERT_EQ(std::system(line.c_str()), 0) << line;
}

inline void write(const std::string& file, const Kind& kind, const Options& options = {})
{
  gst_init(nullptr, nullptr);
  if (std::string(kind.encoder) == "ffmpeg")
    return writeByFfmpeg(file, options);
  const std::string size =
      "width=" + std::to_string(options.width) + ",height=" + std::to_string(options.height);
  const std::string line = "appsrc name=s format=time block=true caps=video/x-raw,format=RGB," +
                           size + "," + options.caps + " ! " + options.more + " videoconvert ! " +
                           kind.encoder + " ! " + kind.muxer + " name=m ! filesink location=\"" +
                           file + "\" " + options.sound;
  GError* error = nullptr;
  GstElement* pipeline = gst_parse_launch(line.c_str(), &error);
  ASSERT_EQ(error, nullptr) << error->message << ": " << line;
  gst_element_set_state(pipeline, GST_STATE_PLAYING);
  GstElement* source = gst_bin_get_by_name(GST_BIN(pipeline), "s");
  for (int n = 0; n < options.frames; ++n)
  {
    const auto pixels = pixelsOf(n, options.width, options.height);
    GstBuffer* buffer = gst_buffer_new_allocate(nullptr, pixels.size(), nullptr);
    gst_buffer_fill(buffer, 0, pixels.data(), pixels.size());
    GST_BUFFER_PTS(buffer) = static_cast<GstClockTime>(options.millisecond(n)) * GST_MSECOND;
    GST_BUFFER_DURATION(buffer) =
        static_cast<GstClockTime>(options.millisecond(n + 1) - options.millisecond(n)) *
        GST_MSECOND;
    gst_app_src_push_buffer(GST_APP_SRC(source), buffer);
  }
  gst_app_src_end_of_stream(GST_APP_SRC(source));
  gst_object_unref(source);
  GstBus* bus = gst_element_get_bus(pipeline);
  GstMessage* message = gst_bus_timed_pop_filtered(
      bus, 30 * GST_SECOND, static_cast<GstMessageType>(GST_MESSAGE_EOS | GST_MESSAGE_ERROR));
  ASSERT_NE(message, nullptr) << "not written: " << line;
  EXPECT_EQ(GST_MESSAGE_TYPE(message), GST_MESSAGE_EOS) << line;
  gst_message_unref(message);
  gst_object_unref(bus);
  gst_element_set_state(pipeline, GST_STATE_NULL);
  gst_object_unref(pipeline);
}

} // namespace petrous::video::made
