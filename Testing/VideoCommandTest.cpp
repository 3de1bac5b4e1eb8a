#include <cmath>

#include <Eigen/Geometry>

#include "CommandRunner.h"
#include "MadeVideo.h"

using Json = nlohmann::json;
using Eigen::Vector3d;
using petrous::testing::CommandLine;
using petrous::testing::quoted;
using petrous::testing::textOf;
namespace made = petrous::video::made;

namespace
{

constexpr int kWidth = 320, kHeight = 200;

class VideoCommand : public CommandLine
{
protected:
  void SetUp() override
  {
    CommandLine::SetUp();
    makeSample(m_folder / "s", "--dims 32,32,32 --spacing 1.5");
    ASSERT_EQ(run("new ear --ct " + (m_folder / "s/ct").string()).code, 0);
    made::Options options;
    options.frames = 20;
    options.width = kWidth;
    options.height = kHeight;
    options.more = "taginject tags=title=DOE_JOHN !";
    made::write(m_folder / "film.mkv", made::kRawMatroska, options);
    json("attach ear --link --name theatre.mkv " + quoted(m_folder / "film.mkv"));
  }

  std::string write(const std::string& name, const std::string& text) const
  {
    std::ofstream(m_folder / name) << text;
    return quoted(m_folder / name);
  }
};

// By the definition of a perspective picture.
std::array<double, 2> seen(const Vector3d& position, const Vector3d& focus, const Vector3d& up,
                           double angle, const Vector3d& p)
{
  const Vector3d into = (focus - position).normalized();
  const Vector3d right = into.cross(up).normalized();
  const Vector3d q = p - position;
  const double scale =
      0.5 * kHeight / (std::tan(0.5 * angle * 3.14159265358979323846 / 180.0) * q.dot(into));
  return {0.5 * kWidth + scale * q.dot(right), 0.5 * kHeight - scale * q.dot(right.cross(into))};
}

Vector3d vectorOf(const Json& j)
{
  return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()};
}

} // namespace

TEST_F(VideoCommand, SetsMovesAndRemovesBookmarks)
{
  const Json listed = json("video ear").at("videos")[0];
  EXPECT_EQ(listed.at("name"), "theatre.mkv");
  EXPECT_EQ(listed.at("file").at("width"), kWidth);
  EXPECT_NEAR(listed.at("file").at("duration_s"), 0.8, 0.05);
  EXPECT_EQ(listed.at("file").at("frame_rate_hz"), 25.0);
  const Json set = json("video ear --at 0.21 --bookmark antrum");
  EXPECT_TRUE(set.at("changed"));
  EXPECT_EQ(set.at("frame_time_s"), 0.2) << "that of the frame";
  json("video ear --at 0.4 --bookmark incus");
  json("video ear --at 0.6 --bookmark ANTRUM");
  const Json bookmarks = json("video ear").at("videos")[0].at("bookmarks");
  ASSERT_EQ(bookmarks.size(), 2U);
  EXPECT_EQ(bookmarks[0].at("name"), "incus");
  EXPECT_EQ(bookmarks[1].at("time_s"), 0.6);
  EXPECT_TRUE(bookmarks[1].at("stroke").is_null());
  EXPECT_FALSE(json("video ear").at("changed"));
  EXPECT_EQ(json("video ear --remove incus").at("videos")[0].at("bookmarks").size(), 1U);
  expectRefused("video ear --remove stapes", 3, "no bookmark 'stapes'; there are 'ANTRUM'");
  expectRefused("video ear --bookmark x", 2, "--at");
  expectRefused("video ear --at 0 --bookmark x --stroke 2", 3, "0 strokes, not 2");
  expectRefused("video ear --video nothing --at 0 --bookmark x", 3, "theatre.mkv");
  // What the file says of the patient is not repeated.
  const auto all = run("video ear");
  EXPECT_EQ((all.out + all.err + json("video ear").dump()).find("DOE"), std::string::npos);
}

TEST_F(VideoCommand, FindsTheCameraOfAStillAndDrawsItOverTheScene)
{
  const Vector3d focus =
      vectorOf(json("view ear --view lateral").at("camera").at("focal_point_mm"));
  const Vector3d position = focus + Vector3d(-120.0, -30.0, 40.0);
  const Vector3d up(0.1, 0.2, 1.0);
  std::string csv = "x_mm,y_mm,z_mm,u_px,v_px\n";
  const auto add = [&](const Vector3d& offset, double miss = 0.0)
  {
    const Vector3d p = focus + offset;
    const auto [u, v] = seen(position, focus, up, 25.0, p);
    for (const double value : {p.x(), p.y(), p.z(), u + miss})
      csv += std::to_string(value) + ",";
    csv += std::to_string(v - miss) + "\n";
  };
  for (const Vector3d& one : {Vector3d(0, 0, 0), Vector3d(-9, 12, 8), Vector3d(10, -14, -5),
                              Vector3d(-6, 3, -14), Vector3d(12, 6, 10), Vector3d(2, -11, 7)})
    add(one);
  const std::string pairs = write("pairs.csv", csv);
  const Json fitted = json("video ear --at 0.25 --pairs " + pairs);
  EXPECT_LT(fitted.at("fit").at("rms_px"), 0.01);
  EXPECT_TRUE(fitted.at("fit").at("bad_landmarks").empty());
  EXPECT_GT(fitted.at("fit").at("view_angle_sigma_deg"), 0.0);
  const Json still = json("video ear").at("videos")[0].at("stills")[0];
  EXPECT_EQ(still.at("time_s"), 0.24);
  EXPECT_EQ(still.at("landmarks").size(), 6U);
  EXPECT_NEAR(still.at("camera").at("view_angle_deg"), 25.0, 0.05);
  EXPECT_LT((vectorOf(still.at("camera").at("position_mm")) - position).norm(), 0.5);

  const auto file = [this](const std::string& name) { return quoted(m_folder / name); };
  const std::string size = " --size " + std::to_string(kWidth) + "x" + std::to_string(kHeight);
  // Without the still it is the scene from there, with nothing else the frame.
  json("video ear --at 0.25 --opacity 0 --overlay " + file("scene.png") + size);
  const std::string camera = write("camera.json", still.at("camera").dump());
  json("render ear --camera " + camera + " --out " + file("drawn.png") + size);
  EXPECT_EQ(textOf(m_folder / "scene.png"), textOf(m_folder / "drawn.png"));
  json("video ear --at 0.25 --opacity 1 --overlay " + file("still.png") + size);
  json("video ear --at 0.25 --frame " + file("frame.png"));
  EXPECT_EQ(textOf(m_folder / "still.png"), textOf(m_folder / "frame.png"));
  json("video ear --at 0.3 --frame " + file("other.png"));
  EXPECT_NE(textOf(m_folder / "other.png"), textOf(m_folder / "frame.png"));

  add({5, 9, -8});
  add({-12, -4, 3}, 25.0);
  const auto with = run("video ear --at 0.25 --view-angle 25 --pairs " + write("more.csv", csv));
  EXPECT_EQ(with.code, 0) << with.err;
  EXPECT_NE(with.err.find("landmark 8 does not fit"), std::string::npos) << with.err;
  EXPECT_TRUE(json("video ear --at 0.25 --remove-still").at("videos")[0].at("stills").empty());
  expectRefused("video ear --at 0.25 --overlay " + file("none.png"), 3, "has no camera");
  expectRefused("video ear --at 0.25 --pairs " +
                    write("few.csv", "x_mm,y_mm,z_mm,u_px,v_px\n1,2,3,4\n"),
                3, "few.csv, line 2");
  EXPECT_EQ(run("library verify").code, 0);
}

// Bookmarks and landmarks belong to the film in which they were set.
TEST_F(VideoCommand, NamesAFileOfTheSameSizeThatIsAnother)
{
  EXPECT_TRUE(json("video ear")["videos"][0]["problem"].is_null());
  std::string bytes = textOf(m_folder / "film.mkv");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  std::ofstream(m_folder / "film.mkv", std::ios::binary) << bytes;
  EXPECT_NE(json("video ear")["videos"][0]["problem"].dump().find("its file is changed"),
            std::string::npos);
  expectRefused("video ear --at 0.2 --bookmark x", 3, "its file is changed");
}

TEST_F(VideoCommand, NamesAFileThatIsGoneOrNone)
{
  std::filesystem::remove(m_folder / "film.mkv");
  expectRefused("video ear --at 0 --bookmark x", 3, "its file is missing");
  EXPECT_NE(json("video ear").at("videos")[0].at("problem").dump().find("missing"),
            std::string::npos);
  write("fake.mp4", std::string("\0\0\0\x18", 4) + "ftypmp42 of the theatre");
  json("attach ear --name fake.mp4 " + quoted(m_folder / "fake.mp4"));
  expectRefused("video ear --at 0 --bookmark x", 3, "several videos");
  expectRefused("video ear --video fake.mp4 --at 0 --bookmark x", 3, "fake.mp4: ");
}
