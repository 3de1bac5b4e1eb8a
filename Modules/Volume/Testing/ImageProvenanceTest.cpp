#include <algorithm>

#include <gtest/gtest.h>

#include "petrous/Volume/ImageProvenance.h"

namespace petrous::volume
{
namespace
{

TEST(ImageProvenance, CountsAndFindsSlicesOfRanges)
{
  const std::vector<SliceRange> ranges{{0, 0}, {4, 6}, {9, 9}};
  EXPECT_EQ(sliceCount(ranges), 5);
  EXPECT_EQ(sliceCount({}), 0);
  const std::vector<int> in{0, 4, 5, 6, 9};
  for (int slice = -1; slice < 12; ++slice)
    EXPECT_EQ(contains(ranges, slice), std::count(in.begin(), in.end(), slice) == 1) << slice;
}

TEST(ImageProvenance, NamesSlicesFromOneAndCountsThoseThatItDoesNotName)
{
  const std::vector<SliceRange> ranges{{2, 2}, {6, 8}, {11, 12}};
  EXPECT_EQ(toString({}), "");
  EXPECT_EQ(toString(ranges), "3, 7-9, 12-13");
  EXPECT_EQ(toString(ranges, 3), "3, 7-9, 12-13");
  EXPECT_EQ(toString(ranges, 2), "3, 7-9 and 2 others");
  EXPECT_EQ(toString({{2, 2}, {6, 6}}, 1), "3 and 1 other");
}

} // namespace
} // namespace petrous::volume
