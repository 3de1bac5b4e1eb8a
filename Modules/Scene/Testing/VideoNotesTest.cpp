#include "petrous/Scene/VideoNotes.h"

#include <functional>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "petrous/Core/Error.h"
#include "petrous/Scene/Manifest.h"

namespace petrous::scene
{
namespace
{

VideoNotes notes()
{
  VideoNotes notes;
  notes.bookmarks = {{"facial recess", 1'234'567'890, "aa.stroke"}, {"incus", 5'000'000'000, ""}};
  VideoNotes::Still still;
  still.time = 1'200'000'000;
  still.size = {1920, 1080};
  still.landmarks = {{{-40.1, 5.0 / 3.0, 3.0}, {960.5, 540.25}}, {{-44.0, 12.0, 9.0}, {1.5, 2.5}}};
  still.viewAngle = 12.0;
  still.camera.emplace();
  still.camera->position = {-240.0, 1.0, 2.0};
  still.camera->focalPoint = {-40.0, 5.0, 3.0};
  still.camera->viewUp = {0.0, 0.1, 1.0};
  still.camera->viewAngle = 12.0;
  still.opacity = 0.25;
  notes.stills = {still};
  return notes;
}

Case withVideo()
{
  Case value;
  value.name = "ear";
  Attachment film;
  film.kind = Attachment::Kind::Video;
  film.name = "film.mp4";
  film.object = std::string(64, 'a') + ".file";
  film.bytes = 7;
  value.attachments = {film};
  return value;
}

int formatOf(const Case& value)
{
  return nlohmann::json::parse(toManifest(value)).at("petrous_case").get<int>();
}

TEST(VideoNotes, GoWithTheManifest)
{
  Case value = withVideo();
  EXPECT_EQ(formatOf(value), 6); // as before it had any
  value.attachments[0].video = std::make_shared<VideoNotes>();
  EXPECT_EQ(formatOf(value), 6);
  value.attachments[0].video = std::make_shared<VideoNotes>(notes());
  EXPECT_EQ(formatOf(value), 8);
  const std::string text = toManifest(value);
  const Case back = fromManifest(text, "m.json");
  ASSERT_TRUE(back.attachments[0].video);
  EXPECT_TRUE(*back.attachments[0].video == notes());
  EXPECT_EQ(toManifest(back), text);
}

TEST(VideoNotes, DifferInEachValue)
{
  const VideoNotes same = notes();
  const auto differs = [&same](const std::function<void(VideoNotes&)>& change)
  {
    VideoNotes other = notes();
    change(other);
    return other != same;
  };
  EXPECT_FALSE(differs([](VideoNotes&) {}));
  EXPECT_TRUE(differs([](VideoNotes& n) { n.bookmarks[0].name += "2"; }));
  EXPECT_TRUE(differs([](VideoNotes& n) { n.bookmarks[1].time++; }));
  EXPECT_TRUE(differs([](VideoNotes& n) { n.bookmarks[1].stroke = "b"; }));
  EXPECT_TRUE(differs([](VideoNotes& n) { n.bookmarks.pop_back(); }));
  EXPECT_TRUE(differs([](VideoNotes& n) { n.stills[0].time++; }));
  EXPECT_TRUE(differs([](VideoNotes& n) { n.stills[0].size[1]++; }));
  EXPECT_TRUE(differs([](VideoNotes& n) { n.stills[0].viewAngle.reset(); }));
  EXPECT_TRUE(differs([](VideoNotes& n) { n.stills[0].opacity = 1.0; }));
  EXPECT_TRUE(differs([](VideoNotes& n) { n.stills[0].camera->viewAngle = 13.0; }));
  EXPECT_TRUE(differs([](VideoNotes& n) { n.stills[0].camera.reset(); }));
  EXPECT_TRUE(differs([](VideoNotes& n) { n.stills[0].landmarks[1].still.x() += 1.0; }));
  EXPECT_TRUE(differs([](VideoNotes& n) { n.stills[0].landmarks[0].patient.z() += 1.0; }));
}

TEST(VideoNotes, AreCheckedWhereTheyComeIn)
{
  using Change = std::function<void(VideoNotes&)>;
  const Change changes[] = {
      [](VideoNotes& n) { n.bookmarks[0].name.clear(); },
      [](VideoNotes& n) { n.bookmarks[0].name = "two\nlines"; },
      [](VideoNotes& n) { n.bookmarks[0].name = std::string(101, 'a'); },
      [](VideoNotes& n) { n.bookmarks[0].name = "INCUS"; },
      [](VideoNotes& n) { n.bookmarks[0].time = -1; },
      [](VideoNotes& n) { n.bookmarks[0].time = std::numeric_limits<std::int64_t>::max(); },
      [](VideoNotes& n) { n.stills[0].time = 2592000000000001; }, // 30 days and 1 ns
      [](VideoNotes& n) { n.bookmarks.resize(1001, n.bookmarks[0]); },
      [](VideoNotes& n) { n.stills.push_back(n.stills[0]); },
      [](VideoNotes& n) { n.stills[0].time = -1; },
      [](VideoNotes& n) {
        n.stills[0].size = {0, 5};
      },
      [](VideoNotes& n) {
        n.stills[0].size = {5, 40000};
      },
      [](VideoNotes& n) { n.stills[0].opacity = 1.1; },
      [](VideoNotes& n) { n.stills[0].viewAngle = 0.1; },
      [](VideoNotes& n) { n.stills[0].landmarks.resize(201); },
      [](VideoNotes& n) { n.stills[0].landmarks[0].patient.x() = 2e5; },
      [](VideoNotes& n) { n.stills[0].landmarks[0].still.x() = -2e6; },
      [](VideoNotes& n) { n.stills[0].camera->position = n.stills[0].camera->focalPoint; },
      [](VideoNotes& n) { n.stills[0].camera->parallelScale = 5.0; },
  };
  int number = 0;
  for (const Change& change : changes)
  {
    VideoNotes broken = notes();
    change(broken);
    EXPECT_THROW(checkVideoNotes(broken), core::InvalidParameter) << number;
    Case value = withVideo();
    value.attachments[0].video = std::make_shared<VideoNotes>(broken);
    EXPECT_THROW(toManifest(value), core::InvalidParameter) << number;
    ++number;
  }
  Case document = withVideo();
  document.attachments[0].kind = Attachment::Kind::Document;
  document.attachments[0].video = std::make_shared<VideoNotes>(notes());
  EXPECT_THROW(toManifest(document), core::InvalidParameter);

  Case value = withVideo();
  value.attachments[0].video = std::make_shared<VideoNotes>(notes());
  auto j = nlohmann::json::parse(toManifest(value));
  j["attachments"][0]["video"]["bookmarks"][0]["time_ns"] = -5;
  EXPECT_THROW(fromManifest(j.dump(), "m"), ManifestError);
  j["attachments"][0]["video"]["bookmarks"][0]["time_ns"] = 5;
  EXPECT_NO_THROW(fromManifest(j.dump(), "m"));
  for (const std::int64_t side : {std::int64_t{4294967297}, std::int64_t{-4294967295}})
  {
    j["attachments"][0]["video"]["stills"][0]["size"][0] = side; // 1 in 32 bits
    EXPECT_THROW(fromManifest(j.dump(), "m"), ManifestError) << side;
  }
  j["attachments"][0]["video"] = 7;
  EXPECT_THROW(fromManifest(j.dump(), "m"), ManifestError);
}

TEST(VideoNotes, FindsBookmarksByNameAndStillsByFrame)
{
  const VideoNotes some = notes();
  EXPECT_EQ(findBookmark(some, "Incus"), 1U);
  try
  {
    findBookmark(some, "stapes");
    FAIL();
  }
  catch (const core::InvalidParameter& error)
  {
    EXPECT_NE(std::string(error.what()).find("'facial recess', 'incus'"), std::string::npos);
  }
  EXPECT_EQ(freeBookmarkName(some, "stapes"), "stapes");
  EXPECT_EQ(freeBookmarkName(some, "incus"), "incus 2");
  EXPECT_EQ(findStill(some, 1'200'000'000), some.stills.data());
  EXPECT_EQ(findStill(some, 1'200'000'001), nullptr);
}

} // namespace
} // namespace petrous::scene
