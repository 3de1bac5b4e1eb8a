#include "petrous/Video/VideoFile.h"

#include <clocale>
#include <fstream>
#include <random>

#include <gtest/gtest.h>
#include <unistd.h>

#include "MadeVideo.h"

namespace petrous::video
{
namespace
{

namespace fs = std::filesystem;
using made::Kind;
using made::numberOf;
using std::chrono::milliseconds;

class VideoFiles : public testing::Test
{
protected:
  VideoFiles()
    : m_folder(fs::temp_directory_path() / ("petrous-video-" + std::to_string(getpid())))
  {
    fs::create_directories(m_folder);
  }
  ~VideoFiles() override { fs::remove_all(m_folder); }

  std::string path(const std::string& name) const { return m_folder / name; }

  std::string written(const Kind& kind, const made::Options& options = {})
  {
    made::write(path(kind.name), kind, options);
    return path(kind.name);
  }

  std::string withBytes(const std::string& name, const std::string& bytes)
  {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }

  static std::string bytesOf(const std::string& file)
  {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  // The message of why it cannot be opened, whose reason must be this.
  static std::string refusal(const std::string& file, VideoError::Reason reason)
  {
    try
    {
      VideoFile(file, "theatre");
    }
    catch (const VideoError& error)
    {
      EXPECT_EQ(error.reason, reason) << error.what();
      EXPECT_NE(std::string(error.what()).find("theatre"), std::string::npos) << error.what();
      return error.what();
    }
    ADD_FAILURE() << file << " was opened";
    return {};
  }

  fs::path m_folder;
};

class EveryKind : public VideoFiles, public testing::WithParamInterface<Kind>
{
protected:
  void SetUp() override
  {
    if (!made::canMake(GetParam()))
      GTEST_SKIP() << GetParam().encoder << " or " << GetParam().muxer << " is not installed";
  }
};

INSTANTIATE_TEST_SUITE_P(All, EveryKind,
                         testing::Values(made::kRawAvi, made::kRawMatroska, made::kFfv1, made::kVp8,
                                         made::kTheora, made::kMpeg4Avi, made::kH264),
                         [](const auto& kind)
                         {
                           std::string name = kind.param.name;
                           name.erase(name.find('.'), 1);
                           return name;
                         });

TEST_P(EveryKind, IsExactToTheFrame)
{
  VideoFile video(written(GetParam()));
  EXPECT_EQ(video.info().width, 128);
  EXPECT_EQ(video.info().height, 64);
  EXPECT_NEAR(video.info().frameRate, 25.0, 0.01);
  EXPECT_NEAR(static_cast<double>(video.info().duration.count()), 4e9, 0.05e9);
  EXPECT_FALSE(video.info().hasSound);

  std::vector<Time> times; // exact ones, from the first frame to the last
  do
  {
    EXPECT_EQ(numberOf(video.current()), static_cast<int>(times.size()));
    EXPECT_LE(std::abs((video.current().time - milliseconds(40 * times.size())).count()), 1'000'000)
        << times.size();
    times.push_back(video.current().time);
  } while (video.next());
  ASSERT_EQ(times.size(), 100U);
  EXPECT_FALSE(video.nextTime());

  std::mt19937 random(5);
  for (int round = 0; round < 25; ++round)
  {
    const int n = static_cast<int>(random() % 100);
    const Time offset[] = {Time(0), milliseconds(17), milliseconds(38)};
    const Frame& frame = video.seek(times[static_cast<std::size_t>(n)] + offset[round % 3]);
    EXPECT_EQ(numberOf(frame), n);
    EXPECT_EQ(frame.time, times[static_cast<std::size_t>(n)]);
    if (n > 0)
    {
      EXPECT_EQ(numberOf(video.seek(frame.time - Time(1))), n - 1);
      EXPECT_EQ(video.current().time, times[static_cast<std::size_t>(n) - 1]);
      EXPECT_TRUE(video.next());
      EXPECT_EQ(numberOf(video.current()), n);
    }
  }
}

TEST_P(EveryKind, StepsBackThroughAll)
{
  made::Options options;
  options.frames = 30;
  VideoFile video(written(GetParam(), options));
  EXPECT_EQ(numberOf(video.seek(milliseconds(10000))), 29); // beyond the end
  EXPECT_FALSE(video.next());
  for (int n = 28; n >= 0; --n)
  {
    ASSERT_TRUE(video.previous());
    EXPECT_EQ(numberOf(video.current()), n);
  }
  EXPECT_FALSE(video.previous());
  EXPECT_EQ(numberOf(video.seek(Time(-5))), 0);
}

// As screen recorders and phones write them: from 0.3 to 2 s between frames.
TEST_F(VideoFiles, OfVariableRateIsExact)
{
  const std::vector<std::int64_t> times{0, 33, 133, 150, 900, 1000, 3000, 3010, 5000};
  made::Options options;
  options.frames = static_cast<int>(times.size());
  options.caps = "framerate=0/1";
  options.millisecond = [&times](int n)
  { return n < static_cast<int>(times.size()) ? times[static_cast<std::size_t>(n)] : 6000; };
  VideoFile video(written(made::kRawMatroska, options));
  EXPECT_EQ(video.info().frameRate, 0.0);
  for (const int n : {8, 2, 5, 6, 0, 7, 1, 4, 3})
  {
    const auto at = static_cast<std::size_t>(n);
    EXPECT_EQ(numberOf(video.seek(milliseconds(times[at]))), n);
    EXPECT_EQ(video.current().time, milliseconds(times[at]));
    if (n < 8)
    {
      EXPECT_EQ(numberOf(video.seek(milliseconds(times[at + 1]) - Time(1))), n);
      EXPECT_EQ(video.nextTime(), Time(milliseconds(times[at + 1])));
    }
    if (n > 0)
    {
      EXPECT_TRUE(video.previous());
      EXPECT_EQ(numberOf(video.current()), n - 1);
    }
  }
}

TEST_F(VideoFiles, IsShownUprightWithSquarePixels)
{
  made::Options options;
  options.frames = 3;
  options.width = 64;
  options.height = 128; // portrait
  {
    VideoFile video(written(made::kRawMatroska, options));
    EXPECT_EQ(video.info().width, 64);
    EXPECT_EQ(video.info().height, 128);
    EXPECT_EQ(numberOf(video.seek(milliseconds(50))), 1);
  }
  options = {};
  options.frames = 3;
  options.caps = "framerate=25/1,pixel-aspect-ratio=2/1";
  {
    VideoFile video(written(made::kRawMatroska, options));
    EXPECT_EQ(video.info().width * 64, video.info().height * 256);
    EXPECT_EQ(numberOf(video.seek(milliseconds(50))), 1);
  }
  // A phone that was held upright, by the matrix of the track [ISO 14496-12, 8.3.2].
  options = {};
  options.frames = 3;
  std::string bytes = bytesOf(written({"phone.mov", "jpegenc", "qtmux"}, options));
  std::string quarterTurn(36, '\0');
  quarterTurn.replace(4, 4, std::string("\0\1\0\0", 4));      // b = 1
  quarterTurn.replace(12, 4, std::string("\xff\xff\0\0", 4)); // c = -1
  quarterTurn.replace(32, 4, std::string("\x40\0\0\0", 4));   // w = 1
  bytes.replace(bytes.find("tkhd") + 44, quarterTurn.size(), quarterTurn);
  VideoFile video(withBytes("phone.mov", bytes));
  EXPECT_EQ(video.info().width, 64);
  EXPECT_EQ(video.info().height, 128);
}

TEST_F(VideoFiles, OfSoundIsLeftAlone)
{
  if (!made::has("vorbisenc"))
    GTEST_SKIP() << "vorbisenc is not installed";
  made::Options options;
  options.frames = 50;
  options.sound = "audiotestsrc num-buffers=90 ! audioconvert ! vorbisenc ! m.";
  VideoFile video(written(made::kRawMatroska, options));
  EXPECT_TRUE(video.info().hasSound);
  EXPECT_EQ(numberOf(video.seek(milliseconds(1200))), 30);
  EXPECT_TRUE(video.previous());
  EXPECT_EQ(numberOf(video.current()), 29);

  GstElement* only = gst_parse_launch(("audiotestsrc num-buffers=20 ! audioconvert ! vorbisenc ! "
                                       "oggmux ! filesink location=\"" +
                                       path("only.ogg") + "\"")
                                          .c_str(),
                                      nullptr);
  gst_element_set_state(only, GST_STATE_PLAYING);
  GstBus* bus = gst_element_get_bus(only);
  gst_message_unref(gst_bus_timed_pop_filtered(bus, 10 * GST_SECOND, GST_MESSAGE_EOS));
  gst_object_unref(bus);
  gst_element_set_state(only, GST_STATE_NULL);
  gst_object_unref(only);
  EXPECT_NE(refusal(path("only.ogg"), VideoError::Reason::NoPicture).find("sound only"),
            std::string::npos);
}

TEST_F(VideoFiles, ThatIsNoneIsNamed)
{
  EXPECT_NE(refusal(withBytes("empty.mp4", ""), VideoError::Reason::NotAVideo).find("empty"),
            std::string::npos);
  refusal(withBytes("notes.mp4", "Not a video, but a text of some length."),
          VideoError::Reason::NotAVideo);
  std::string noise(20000, ' ');
  std::mt19937 random(3);
  for (char& one : noise)
    one = static_cast<char>(random());
  refusal(withBytes("noise.mp4", noise), VideoError::Reason::NotAVideo);
  refusal(path("none.mp4"), VideoError::Reason::NotReadable);
  refusal(m_folder, VideoError::Reason::NotReadable);
}

// A camera that was switched off, a copy that broke off.
TEST_F(VideoFiles, ThatBreaksOffIsShownUpToThere)
{
  if (!made::canMake(made::kVp8))
    GTEST_SKIP() << "vp8enc is not installed";
  const std::string whole = bytesOf(written(made::kVp8));
  VideoFile video(withBytes("cut.webm", whole.substr(0, whole.size() * 6 / 10)));
  int last = 0;
  while (video.next())
    EXPECT_EQ(numberOf(video.current()), ++last);
  EXPECT_GT(last, 20);
  EXPECT_LT(last, 90);
  ASSERT_TRUE(video.gap()) << "it ends before its time";
  EXPECT_EQ(video.gap()->begin, video.current().time);
  EXPECT_FALSE(video.gap()->end);
  EXPECT_EQ(numberOf(video.seek(milliseconds(3900))), last);
  EXPECT_EQ(numberOf(video.seek(milliseconds(405))), 10);
  EXPECT_TRUE(video.previous());
  EXPECT_EQ(numberOf(video.current()), 9);
  refusal(withBytes("stump.webm", whole.substr(0, 300)), VideoError::Reason::Damaged);
}

// Whatever was played before.
TEST_F(VideoFiles, GoesOnBeyondADamagedPart)
{
  if (!made::canMake(made::kVp8Keys))
    GTEST_SKIP() << "vp8enc is not installed";
  made::Options options;
  options.frames = 200;
  std::string bytes = bytesOf(written(made::kVp8Keys, options));
  bytes.replace(bytes.size() * 4 / 10, bytes.size() / 10, bytes.size() / 10, '\xff');
  const std::string hole = withBytes("hole.webm", bytes);
  VideoFile video(hole);
  std::vector<Gap> gaps;
  std::vector<Time> times{video.current().time};
  do
  {
    if (const auto gap = video.gap())
      gaps.push_back(*gap);
    EXPECT_GE(video.current().time, times.back());
    EXPECT_EQ(numberOf(video.current()),
              (video.current().time + milliseconds(1)) / milliseconds(40));
    times.push_back(video.current().time);
  } while (video.next());
  EXPECT_EQ(numberOf(video.current()), 199);
  ASSERT_EQ(gaps.size(), 1U);
  ASSERT_TRUE(gaps[0].end);
  EXPECT_GT(*gaps[0].end, gaps[0].begin + milliseconds(100));
  for (int at = 200; at < 8000; at += 650)
  {
    VideoFile fresh(hole);
    fresh.seek(milliseconds(at));
    video.seek(gaps[0].begin);
    EXPECT_EQ(video.seek(milliseconds(at)).time, fresh.current().time) << at;
    video.seek(Time(0));
    while (video.nextTime() && *video.nextTime() <= milliseconds(at))
      video.next();
    EXPECT_EQ(numberOf(video.seek(milliseconds(at))), numberOf(fresh.current())) << at;
  }
}

// As recordings have it that were not closed. A demultiplexer itself may stop seeks at the end that
// is stated, until it was passed.
TEST_F(VideoFiles, LongerThanTheyStateAreReadToTheirEnd)
{
  std::string bytes = bytesOf(written(made::kRawMatroska));
  const std::size_t at = bytes.find("\x44\x89\x88");
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at + 3, 8, std::string("\x40\x8f\x40\0\0\0\0\0", 8)); // 1000 ms
  VideoFile video(withBytes("short.mkv", bytes));
  EXPECT_EQ(video.info().duration, milliseconds(1000));
  int last = 0;
  while (video.next())
    last = numberOf(video.current());
  EXPECT_EQ(last, 99);
  EXPECT_EQ(numberOf(video.seek(Time(0))), 0);
  EXPECT_EQ(numberOf(video.seek(milliseconds(3500))), 87);
  EXPECT_EQ(numberOf(video.seek(Time::max())), 99);
  EXPECT_FALSE(video.gap());
  EXPECT_EQ(numberOf(video.seek(milliseconds(900))), 22);
}

TEST_F(VideoFiles, AreGivenUpWhereThatIsAsked)
{
  const std::string file = written(made::kRawMatroska);
  bool isStopped = false;
  VideoFile video(file, {}, [&isStopped] { return isStopped; });
  isStopped = true;
  try
  {
    video.seek(milliseconds(2000));
    FAIL() << "it went on";
  }
  catch (const VideoError& error)
  {
    EXPECT_EQ(error.reason, VideoError::Reason::Interrupted);
  }
  isStopped = false;
  EXPECT_EQ(numberOf(video.seek(milliseconds(2000))), 50);
}

TEST_F(VideoFiles, ThatReferToOtherPlacesAreRefused)
{
  const std::string list = "#EXTM3U\n#EXT-X-VERSION:3\n#EXT-X-TARGETDURATION:10\n"
                           "#EXT-X-MEDIA-SEQUENCE:0\n#EXTINF:9.0,\nhttp://127.0.0.1:9/a.ts\n"
                           "#EXT-X-ENDLIST\n";
  refusal(withBytes("list.mp4", list), VideoError::Reason::NotAVideo);
  refusal(withBytes("dash.mp4", "<?xml version=\"1.0\"?>\n<MPD "
                                "xmlns=\"urn:mpeg:dash:schema:mpd:2011\" type=\"static\"></MPD>"),
          VideoError::Reason::NotAVideo);
  refusal(withBytes("session.mp4", "v=0\r\no=- 1 1 IN IP4 127.0.0.1\r\ns=a\r\nt=0 0\r\n"
                                   "m=video 9 RTP/AVP 96\r\na=rtpmap:96 H264/90000\r\n"),
          VideoError::Reason::NotAVideo);
}

// Elements of a package that is not installed, whatever of it is.
class Hidden
{
public:
  explicit Hidden(std::initializer_list<const char*> names)
  {
    gst_init(nullptr, nullptr); // without it the registry is empty
    for (const char* name : names)
      if (GstPluginFeature* one = gst_registry_lookup_feature(gst_registry_get(), name))
      {
        m_removed.push_back(one);
        gst_registry_remove_feature(gst_registry_get(), one);
      }
  }
  ~Hidden()
  {
    for (GstPluginFeature* one : m_removed)
    {
      gst_registry_add_feature(gst_registry_get(), one);
      gst_object_unref(one);
    }
  }

private:
  std::vector<GstPluginFeature*> m_removed;
};

TEST_F(VideoFiles, NameThePackageThatTheyNeed)
{
  {
    const Hidden hidden({"videoflip"}); // a phone's would be shown lying
    const std::string why = refusal(written(made::kRawMatroska), VideoError::Reason::MissingCodec);
    EXPECT_NE(why.find("gstreamer1.0-plugins-good"), std::string::npos) << why;
  }
  if (!made::hasFfmpeg())
    GTEST_SKIP() << "ffmpeg is not installed";
  made::Options options;
  options.frames = 10;
  const struct
  {
    const char* name;
    const char* encoder;
    const char* package;
  } kinds[] = {{"a.mts", "-c:v libx264 -f mpegts", "gstreamer1.0-plugins-bad"},
               {"b.mpg", "-c:v mpeg2video", "gstreamer1.0-plugins-bad"},
               {"c.wmv", "-c:v wmv2", "gstreamer1.0-plugins-ugly"},
               {"d.avi", "-c:v libx264", "gstreamer1.0-plugins-bad"}};
  const Hidden hidden(
      {"tsdemux", "mpegpsdemux", "asfdemux", "h264parse", "avdec_h264", "mpegvideoparse"});
  for (const auto& kind : kinds)
  {
    made::writeByFfmpeg(path(kind.name), options, kind.encoder);
    const std::string why = refusal(path(kind.name), VideoError::Reason::MissingCodec);
    EXPECT_NE(why.find(kind.package), std::string::npos) << why;
    EXPECT_EQ(why.find("plugins-good"), std::string::npos) << why;
  }
}

TEST_F(VideoFiles, NamesTheDecoderThatIsMissing)
{
  if (!made::canMake(made::kVp8))
    GTEST_SKIP() << "vp8enc is not installed";
  const std::string file = written(made::kVp8);
  std::vector<GstPluginFeature*> removed;
  for (const char* name : {"vp8dec", "avdec_vp8", "vp8alphadecodebin"})
    if (GstPluginFeature* one = gst_registry_lookup_feature(gst_registry_get(), name))
    {
      removed.push_back(one);
      gst_registry_remove_feature(gst_registry_get(), one);
    }
  const std::string why = refusal(file, VideoError::Reason::MissingCodec);
  for (GstPluginFeature* one : removed)
  {
    gst_registry_add_feature(gst_registry_get(), one);
    gst_object_unref(one);
  }
  EXPECT_NE(why.find("VP8"), std::string::npos) << why;
  EXPECT_EQ(numberOf(VideoFile(file).current()), 0); // with it again
}

// GStreamer sets the locale of the environment when it starts.
TEST_F(VideoFiles, LeavesTheLocaleAlone)
{
  const std::string before = std::setlocale(LC_ALL, nullptr);
  VideoFile video(written(made::kRawAvi));
  EXPECT_EQ(std::setlocale(LC_ALL, nullptr), before);
}

} // namespace
} // namespace petrous::video
