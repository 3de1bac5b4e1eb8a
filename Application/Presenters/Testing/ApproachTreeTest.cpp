#include "petrous/Presenters/ApproachTree.h"

#include <map>

#include <gtest/gtest.h>

using namespace petrous;
using namespace petrous::presenters;
using dissection::History;
using Kind = ApproachNode::Kind;

namespace
{

// "main(- 1 2*(deep(3)) 4)": rows in order, - the untouched bone, * applied.
std::string textOf(const std::vector<ApproachNode>& rows)
{
  std::string text;
  for (const ApproachNode& row : rows)
  {
    text += text.empty() ? "" : " ";
    text += row.kind == Kind::Approach ? row.approach
            : row.kind == Kind::Start  ? "-"
                                       : std::to_string(row.state + 1);
    if (row.applied && row.kind == Kind::Stroke)
      text += "*";
    if (!row.children.empty())
      text += "(" + textOf(row.children) + ")";
  }
  return text;
}

} // namespace

TEST(ApproachTree, OfNoStrokesHasTheUntouchedBone)
{
  EXPECT_EQ(textOf(approachTree(History())), "main(-)");
}

TEST(ApproachTree, ForksWhereTheApproachesLeaveOneAnother)
{
  History history;
  history.add();
  history.add();
  history.undo();
  history.add(); // 3 after 1; 2 is set aside
  EXPECT_EQ(textOf(approachTree(history)), "main(- 1*(main~1(2)) 3*)");
  history.start("above", 0);
  history.add();
  history.add();
  history.undo();
  EXPECT_EQ(textOf(approachTree(history)), "main(- 1*(main~1(2) above(4* 5)) 3)");
  history.start("deeper", 3); // of 4, without strokes of its own
  history.start("other side", History::kStart);
  EXPECT_EQ(textOf(approachTree(history)),
            "main(- 1(main~1(2) above(4(deeper) 5)) 3) other side(-)");
  history.add();
  const auto rows = approachTree(history);
  ASSERT_EQ(rows.size(), 2u);
  ASSERT_EQ(rows[1].children.size(), 2u);
  EXPECT_EQ(rows[1].state, 5u) << "the state in which it is";
  EXPECT_EQ(rows[1].children[1].state, 5u);
}

TEST(ApproachTree, PicturesAreOfTheStateThatIsAskedFor)
{
  const core::GridGeometry grid({24, 24, 24}, Eigen::Vector3d::Constant(0.5),
                                Eigen::Vector3d::Zero());
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{-1000});
  for (int k = 4; k < 20; ++k)
    for (int j = 4; j < 20; ++j)
      for (int i = 4; i < 20; ++i)
        voxels->at(i, j, k) = 1500;
  scene::Case value;
  value.ct.geometry = grid;
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(voxels));
  value.dissection = dissection::Dissection(grid);
  value.dissection.beginStroke({});
  value.dissection.cut({{6, 6, 10}, {6, 6, 10}, 3.0});
  value.dissection.endStroke();
  value.dissection.undo();

  rendering::SceneContents contents;
  contents.ct = value.ct.volume.get();
  core::CameraPose camera;
  camera.position = {6, 6, 40};
  camera.focalPoint = {6, 6, 6};
  camera.viewUp = {0, 1, 0};
  std::map<std::size_t, rendering::Picture> pictures;
  drawStates(value, contents, camera, {History::kStart, 0}, 40, 30,
             [&pictures](std::size_t state, const rendering::Picture& picture)
             { pictures[state] = picture; });
  ASSERT_EQ(pictures.size(), 2u);
  const auto& untouched = pictures[History::kStart];
  EXPECT_EQ(untouched.width, 40);
  EXPECT_EQ(untouched.height, 30);
  // The hole is in the middle; around the block nothing changes.
  EXPECT_GT(rendering::countDifferentPixels(untouched, pictures[0]), 10u);
  EXPECT_EQ(untouched.pixel(1, 1)[0], pictures[0].pixel(1, 1)[0]);
  EXPECT_EQ(value.applied(), 0u) << "the case stays";
}
