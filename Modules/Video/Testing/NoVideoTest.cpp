#include <gtest/gtest.h>

#include "petrous/Video/VideoFile.h"

namespace petrous::video
{
namespace
{

TEST(NoVideo, IsSaidWhereAVideoIsOpened)
{
  EXPECT_FALSE(isSupported());
  try
  {
    VideoFile("film.mp4");
    FAIL() << "it was opened";
  }
  catch (const VideoError& error)
  {
    EXPECT_EQ(error.reason, VideoError::Reason::NotBuilt);
    EXPECT_NE(std::string(error.what()).find("not built"), std::string::npos);
  }
}

} // namespace
} // namespace petrous::video
