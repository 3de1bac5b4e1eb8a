#include <cstdlib>

#include <gtest/gtest.h>

#include <unistd.h>

#include "petrous/Presenters/SourceContent.h"

using namespace petrous;
using presenters::Content;

// dcmqi's three slices of a liver, and segmentations of them.
TEST(SourceContentData, SegmentationsAreFoundInAFolder)
{
  const char* data = std::getenv("PETROUS_DATA");
  const auto from =
      std::filesystem::path(data ? data : "") / "seg_rt" / "dcmqi" / "data" / "segmentations";
  if (!data || !std::filesystem::exists(from / "liver.dcm"))
    GTEST_SKIP() << "no seg_rt in PETROUS_DATA";
  const auto folder =
      std::filesystem::temp_directory_path() / ("petrous-found-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder / "export" / "seg");
  std::filesystem::copy(from / "liver.dcm", folder / "export" / "seg");
  const auto alone = presenters::lookAt(folder / "export", {});
  EXPECT_EQ(alone.content, Content::Labels);
  EXPECT_EQ(alone.path, folder / "export" / "seg" / "liver.dcm");
  std::filesystem::copy(from / "ct-3slice", folder / "export" / "ct");
  const auto both = presenters::lookAt(folder / "export", {});
  ASSERT_EQ(both.series.size(), 2u);
  EXPECT_EQ(both.series[0].content, Content::Ct);
  EXPECT_EQ(both.series[0].slices, 3u);
  EXPECT_EQ(both.series[1].content, Content::Labels);
  EXPECT_EQ(both.series[1].files.at(0), folder / "export" / "seg" / "liver.dcm");
  std::filesystem::remove_all(folder);
}
