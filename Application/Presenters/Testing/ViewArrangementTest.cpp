#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "petrous/Presenters/ViewArrangement.h"

using namespace petrous::presenters;

namespace
{

constexpr ViewLayout kLayouts[] = {ViewLayout::Beside, ViewLayout::FourUp, ViewLayout::ThreeD,
                                   ViewLayout::OneSlice, ViewLayout::Slices};
constexpr int kWidth = 211;
constexpr int kHeight = 157;

int shown(const ViewArrangement& arrangement)
{
  int count = 0;
  for (const auto& pane : arrangement.panes(kWidth, kHeight))
    count += pane ? 1 : 0;
  return count;
}

// Each pixel belongs to one view or to a divider, none to two views.
void expectTiles(const ViewArrangement& arrangement)
{
  std::vector<int> owners(static_cast<std::size_t>(kWidth) * kHeight, 0);
  const auto fill = [&](const ViewRect& rect, int owner)
  {
    ASSERT_GE(rect.left, 0);
    ASSERT_GE(rect.top, 0);
    ASSERT_LE(rect.left + rect.width, kWidth);
    ASSERT_LE(rect.top + rect.height, kHeight);
    for (int y = rect.top; y < rect.top + rect.height; ++y)
      for (int x = rect.left; x < rect.left + rect.width; ++x)
      {
        int& at = owners[static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x)];
        ASSERT_TRUE(at == 0 || (owner < 0 && at < 0)) << x << ' ' << y;
        at = owner;
      }
  };
  int owner = 0;
  for (const auto& pane : arrangement.panes(kWidth, kHeight))
    if (pane)
      fill(*pane, ++owner);
  for (const auto& divider : arrangement.dividers(kWidth, kHeight))
    fill(divider.gap, -1);
  EXPECT_EQ(std::count(owners.begin(), owners.end(), 0), 0);
}

} // namespace

TEST(ViewArrangement, ViewsAndDividersTileTheArea)
{
  for (const ViewLayout layout : kLayouts)
  {
    SCOPED_TRACE(nameOf(layout));
    ViewArrangement arrangement;
    arrangement.setLayout(layout);
    expectTiles(arrangement);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> fraction(-0.2, 1.2);
    for (int round = 0; round < 20; ++round)
    {
      for (std::size_t split = 0; split < arrangement.splits().size(); ++split)
        arrangement.moveSplit(split, fraction(random));
      expectTiles(arrangement);
    }
  }
}

TEST(ViewArrangement, ShowsTheViewsOfItsLayout)
{
  const int counts[] = {4, 4, 1, 4, 3};
  for (const ViewLayout layout : kLayouts)
  {
    ViewArrangement arrangement;
    arrangement.setLayout(layout);
    EXPECT_EQ(shown(arrangement), counts[static_cast<std::size_t>(layout)]);
    EXPECT_EQ(parseViewLayout(nameOf(layout)), layout);
  }
  EXPECT_FALSE(parseViewLayout("six-up"));
}

TEST(ViewArrangement, AnEnlargedViewFillsTheAreaUntilToggledAgain)
{
  for (const ViewLayout layout : kLayouts)
    for (const ViewPane pane : {ViewPane::ThreeD, ViewPane::Axial, ViewPane::Sagittal})
    {
      ViewArrangement arrangement;
      arrangement.setLayout(layout);
      const auto before = arrangement.panes(kWidth, kHeight);
      arrangement.toggleEnlarged(pane);
      EXPECT_EQ(shown(arrangement), 1);
      const auto rect = arrangement.panes(kWidth, kHeight)[static_cast<std::size_t>(pane)];
      ASSERT_TRUE(rect);
      EXPECT_EQ(rect->width, kWidth);
      EXPECT_EQ(rect->height, kHeight);
      EXPECT_TRUE(arrangement.dividers(kWidth, kHeight).empty());
      arrangement.toggleEnlarged(pane);
      const auto after = arrangement.panes(kWidth, kHeight);
      for (std::size_t n = 0; n < after.size(); ++n)
      {
        ASSERT_EQ(after[n].has_value(), before[n].has_value());
        if (after[n])
        {
          EXPECT_EQ(after[n]->width, before[n]->width);
        }
      }
    }
}

TEST(ViewArrangement, ALargeSliceIsLargerThanAllOthersTogether)
{
  ViewArrangement arrangement;
  arrangement.setLayout(ViewLayout::OneSlice);
  arrangement.setLarge(ViewPane::Coronal);
  arrangement.setLarge(ViewPane::ThreeD); // no slice
  const auto panes = arrangement.panes(kWidth, kHeight);
  const auto area = [](const ViewRect& rect) { return rect.width * rect.height; };
  int others = 0;
  for (const ViewPane pane : {ViewPane::ThreeD, ViewPane::Axial, ViewPane::Sagittal})
    others += area(*panes[static_cast<std::size_t>(pane)]);
  EXPECT_GT(area(*panes[static_cast<std::size_t>(ViewPane::Coronal)]), others);
}

TEST(ViewArrangement, DividersStayWhereTheyArePutAndLeaveRoom)
{
  ViewArrangement arrangement;
  arrangement.moveSplit(0, 0.5);
  EXPECT_EQ(arrangement.panes(1000, 600)[0]->width, 500 - ViewArrangement::kGap / 2);
  arrangement.moveSplit(0, 5.0);
  EXPECT_DOUBLE_EQ(arrangement.splits()[0], 0.9);
  arrangement.moveSplit(1, 0.95);
  EXPECT_NEAR(arrangement.splits()[1], arrangement.splits()[2] - 0.1, 1e-12);
  arrangement.setLayout(ViewLayout::FourUp); // has its own
  EXPECT_DOUBLE_EQ(arrangement.splits()[0], 0.5);
  arrangement.setLayout(ViewLayout::Beside);
  EXPECT_DOUBLE_EQ(arrangement.splits()[0], 0.9);
  arrangement.resetSplits();
  EXPECT_DOUBLE_EQ(arrangement.splits()[0], 0.65);
}
