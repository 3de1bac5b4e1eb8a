#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <random>

#include <Eigen/Geometry>

#include "petrous/Core/Error.h"
#include "petrous/Presenters/PlaneSamples.h"
#include "petrous/Presenters/SlicePlanes.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/IntensityVolume.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;

namespace
{

constexpr SliceOrientation kSlices[] = {SliceOrientation::Axial, SliceOrientation::Coronal,
                                        SliceOrientation::Sagittal};

void expectOrthogonal(const SlicePlanes& planes)
{
  for (const SliceOrientation slice : kSlices)
  {
    const SliceAxes& axes = planes.axes(slice);
    const SliceAxes usual = axesOf(slice);
    for (const Vector3d& axis : {axes.right, axes.down, axes.next})
      EXPECT_NEAR(axis.norm(), 1.0, 1e-12);
    EXPECT_NEAR(axes.right.dot(axes.down), 0.0, 1e-12);
    EXPECT_NEAR(axes.right.cross(axes.down).dot(axes.next),
                usual.right.cross(usual.down).dot(usual.next), 1e-12);
    for (const SliceOrientation other : kSlices)
      if (other != slice)
      {
        EXPECT_NEAR(planes.axes(slice).next.dot(planes.axes(other).next), 0.0, 1e-9);
      }
  }
}

std::string letters(const SlicePlanes& planes, SliceOrientation slice)
{
  const auto l =
      SliceGeometry(slice, planes.axes(slice), Vector3d::Zero(), 1.0, 10, 10).edgeLetters();
  return l.left + ' ' + l.right + ' ' + l.top + ' ' + l.bottom;
}

bool isOneOf(const std::string& text, const std::string& one, const std::string& other)
{
  return text == one || text == other;
}

} // namespace

TEST(SlicePlanes, AreTheStandardSlicesAtFirst)
{
  const SlicePlanes planes;
  expectOrthogonal(planes);
  for (const SliceOrientation slice : kSlices)
  {
    EXPECT_EQ(planes.axes(slice).right, axesOf(slice).right);
    EXPECT_EQ(planes.name(slice), nameOf(slice));
    EXPECT_FALSE(planes.isTurned(slice));
  }
}

// The petrous pyramid points from the outside at the back to the middle at the front: in a left ear
// (x > 0) along (-1, -1, 0), in a right one along (1, -1, 0); LPS.
TEST(SlicePlanes, StenversContainsThePyramidAndPoeschlIsAcrossIt)
{
  for (const scene::Side side : {scene::Side::Left, scene::Side::Right})
  {
    const double left = side == scene::Side::Left ? 1.0 : -1.0;
    const Vector3d pyramid = Vector3d(-left, -1.0, 0.0).normalized();
    const Vector3d canal = Vector3d(left, -1.0, 0.0).normalized(); // anterolateral
    const SlicePlanes planes = SlicePlanes::petrous(side);
    expectOrthogonal(planes);
    const SliceAxes& stenvers = planes.axes(SliceOrientation::Coronal);
    const SliceAxes& poeschl = planes.axes(SliceOrientation::Sagittal);
    EXPECT_EQ(planes.name(SliceOrientation::Coronal), "Stenvers");
    EXPECT_NEAR(stenvers.next.dot(pyramid), 0.0, 1e-12);
    EXPECT_NEAR(stenvers.next.z(), 0.0, 1e-12); // upright
    EXPECT_NEAR(std::abs(poeschl.next.dot(pyramid)), 1.0, 1e-12);
    EXPECT_NEAR(poeschl.next.dot(canal), 0.0, 1e-12);
    EXPECT_LT((stenvers.down - Vector3d(0, 0, -1)).norm(), 1e-12);
    EXPECT_LT((poeschl.down - Vector3d(0, 0, -1)).norm(), 1e-12);
    EXPECT_GT(stenvers.right.x(), 0.0); // the patient's left on the picture's right
    EXPECT_GT(poeschl.right.y(), 0.0);  // the back on the picture's right
    EXPECT_EQ(planes.axes(SliceOrientation::Axial).right, Vector3d(1, 0, 0));
  }
  // Left ear: Stenvers from right and front to left and back; Poeschl from front and left to back
  // and right.
  const SlicePlanes planes = SlicePlanes::petrous(scene::Side::Left);
  const std::string stenvers = letters(planes, SliceOrientation::Coronal);
  EXPECT_TRUE(isOneOf(stenvers, "RA LP S I", "AR PL S I")) << stenvers;
  const std::string poeschl = letters(planes, SliceOrientation::Sagittal);
  EXPECT_TRUE(isOneOf(poeschl, "AL PR S I", "LA RP S I")) << poeschl;
}

TEST(SlicePlanes, OneIsAcrossTheToolAndTwoAreAlongIt)
{
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 200; ++round)
  {
    const Vector3d axis = Vector3d(normal(random), normal(random), normal(random)) * 3.0;
    const SlicePlanes planes = SlicePlanes::alongTool(axis, {});
    expectOrthogonal(planes);
    int across = 0;
    for (const SliceOrientation slice : kSlices)
    {
      const double share = std::abs(planes.axes(slice).next.dot(axis.normalized()));
      if (planes.name(slice) == "Across the tool")
      {
        ++across;
        EXPECT_NEAR(share, 1.0, 1e-9);
      }
      else
        EXPECT_NEAR(share, 0.0, 1e-9);
      // The smallest rotation: to the nearest of three axes it is 54.74 degrees at most.
      EXPECT_GT(planes.axes(slice).next.dot(axesOf(slice).next), 1.0 / std::sqrt(3.0) - 1e-9);
    }
    EXPECT_EQ(across, 1);
  }
}

TEST(SlicePlanes, AToolThatTurnsKeepsItsSliceUpTo60Degrees)
{
  const auto at = [](double degrees)
  {
    const double angle = degrees * 3.14159265358979323846 / 180.0;
    return Vector3d(std::sin(angle), 0.0, std::cos(angle)); // from superior to left
  };
  SlicePlanes planes = SlicePlanes::alongTool(at(0.0), {});
  for (double degrees = 0.0; degrees < 59.0; degrees += 1.0)
  {
    const SlicePlanes next = SlicePlanes::alongTool(at(degrees), planes);
    EXPECT_EQ(next.name(SliceOrientation::Axial), "Across the tool") << degrees;
    for (const SliceOrientation slice : kSlices) // without a jump
      EXPECT_LT((next.axes(slice).right - planes.axes(slice).right).norm(), 0.02);
    planes = next;
  }
  planes = SlicePlanes::alongTool(at(61.0), planes);
  EXPECT_EQ(planes.name(SliceOrientation::Sagittal), "Across the tool");
  const SlicePlanes same = SlicePlanes::alongTool(Vector3d::Zero(), planes);
  EXPECT_EQ(same.name(SliceOrientation::Sagittal), "Across the tool");
}

TEST(SlicePlanes, TurnAboutASliceLeavesItAndTurnsTheOthersClockwise)
{
  SlicePlanes planes;
  planes.turnOthers(SliceOrientation::Axial, 30.0);
  expectOrthogonal(planes);
  EXPECT_EQ(planes.kind(), SlicePlanes::Kind::Free);
  EXPECT_EQ(planes.axes(SliceOrientation::Axial).right, Vector3d(1, 0, 0));
  EXPECT_FALSE(planes.isTurned(SliceOrientation::Axial));
  // The coronal plane's line ran to the picture's right (x); clockwise it goes down (y).
  const Vector3d line = planes.axes(SliceOrientation::Coronal).right;
  EXPECT_NEAR(line.x(), std::cos(3.14159265358979323846 / 6.0), 1e-12);
  EXPECT_NEAR(line.y(), 0.5, 1e-12);
  EXPECT_EQ(planes.name(SliceOrientation::Coronal), "Coronal, turned 30\xc2\xb0");
  planes.turnOthers(SliceOrientation::Axial, -30.0);
  EXPECT_FALSE(planes.isTurned(SliceOrientation::Coronal));

  std::mt19937 random(5);
  std::uniform_real_distribution<double> degrees(-40.0, 40.0);
  for (int round = 0; round < 500; ++round)
  {
    planes.turnOthers(kSlices[round % 3], degrees(random));
    planes.tilt(kSlices[(round + 1) % 3], degrees(random), degrees(random));
  }
  expectOrthogonal(planes);
}

TEST(SlicePlanes, TiltBringsTheLowerEdgeTowardsTheViewer)
{
  SlicePlanes planes;
  planes.tilt(SliceOrientation::Axial, 0.0, 10.0);
  // An axial slice is seen from the feet: towards the viewer is inferior, its lower edge posterior.
  const Vector3d down = planes.axes(SliceOrientation::Axial).down;
  EXPECT_LT(down.z(), 0.0);
  EXPECT_GT(down.y(), 0.9);
  expectOrthogonal(planes);
}

// A linear field is sampled exactly by any plane: the pixel's value is that of its patient point.
TEST(SlicePlanes, PixelsAreTheFieldAtTheirPatientPoint)
{
  const core::GridGeometry grid({40, 36, 30}, Vector3d(0.5, 0.6, 0.7), Vector3d(-10, 5, 20));
  auto image = std::make_shared<volume::Volume<float>>(grid);
  const auto field = [](const Vector3d& p) { return 2.0 * p.x() - 3.0 * p.y() + 5.0 * p.z(); };
  for (int k = 0; k < 30; ++k)
    for (int j = 0; j < 36; ++j)
      for (int i = 0; i < 40; ++i)
        image->at(i, j, k) = static_cast<float>(field(grid.patientFromVoxel(Vector3d(i, j, k))));
  const volume::IntensityVolume ct{std::shared_ptr<const volume::Volume<float>>(image)};
  const ObliquePlane plane = planeWithNormal({1.0, 2.0, -3.0});
  const Vector3d through = grid.center() + Vector3d(1.0, 2.0, 3.0);
  const auto slice = SliceGeometry::fitting(plane.orientation, plane.axes, grid, through, 61, 53);
  EXPECT_NEAR(slice.axes().next.dot(slice.center() - through), 0.0, 1e-9);
  const PlaneSamples samples = samplePlane(ct, slice);
  int inside = 0;
  for (int row = 0; row < 53; ++row)
    for (int column = 0; column < 61; ++column)
    {
      const Vector3d patient = slice.patientFromPixel(column, row);
      EXPECT_NEAR(Vector3d(1, 2, -3).dot(patient - through), 0.0, 1e-9); // in the plane
      const Eigen::Vector2d back = slice.pixelFromPatient(patient);
      EXPECT_NEAR(back[0], column, 1e-9);
      EXPECT_NEAR(back[1], row, 1e-9);
      if (std::isnan(samples.at(column, row)))
        continue;
      ++inside;
      EXPECT_NEAR(samples.at(column, row), field(patient), 1e-3);
    }
  EXPECT_GT(inside, 500);
}

TEST(SlicePlanes, APlaneByItsNormal)
{
  EXPECT_EQ(planeWithNormal({0, 0, 5}).orientation, SliceOrientation::Axial);
  const ObliquePlane back = planeWithNormal({0, -2, 0.1});
  EXPECT_EQ(back.orientation, SliceOrientation::Coronal);
  EXPECT_NEAR(std::abs(back.axes.next.dot(Vector3d(0, -2, 0.1).normalized())), 1.0, 1e-12);
  EXPECT_GT(back.axes.next.y(), 0.9); // the same plane, not upside down
  EXPECT_THROW(planeWithNormal(Vector3d::Zero()), core::InvalidParameter);
  EXPECT_THROW(planeWithNormal({NAN, 0, 1}), core::InvalidParameter);
}

TEST(SlicePlanes, AreSavedAsTheyAre)
{
  std::vector<SlicePlanes> all{SlicePlanes(), SlicePlanes::petrous(scene::Side::Right),
                               SlicePlanes::alongTool({1, 2, 3}, {}),
                               SlicePlanes::alongTool({0, 2, 3}, {})};
  all.emplace_back();
  all.back().turnOthers(SliceOrientation::Sagittal, 12.5);
  for (const SlicePlanes& planes : all)
  {
    scene::ViewState view;
    view.slices.emplace();
    view.slices->width = 1.0;
    planes.store(*view.slices);
    EXPECT_NO_THROW(scene::checkView(view));
    const SlicePlanes again = SlicePlanes::from(*view.slices);
    EXPECT_EQ(again.kind(), planes.kind());
    for (const SliceOrientation slice : kSlices)
    {
      EXPECT_LT((again.axes(slice).right - planes.axes(slice).right).norm(), 1e-12);
      EXPECT_LT((again.axes(slice).next - planes.axes(slice).next).norm(), 1e-12);
      EXPECT_EQ(again.name(slice), planes.name(slice));
    }
  }
}

TEST(SlicePlanes, TheEarIsTheCasesElseWhereTheImageLies)
{
  scene::Case value;
  value.ct.geometry = core::GridGeometry({3, 3, 3}, Vector3d::Ones(), Vector3d(40, 0, 0));
  EXPECT_EQ(earOf(value), scene::Side::Left);
  value.description.side = scene::Side::Both;
  EXPECT_EQ(earOf(value), scene::Side::Left);
  value.description.side = scene::Side::Right;
  EXPECT_EQ(earOf(value), scene::Side::Right);
  value.description.side = scene::Side::Unknown;
  value.ct.geometry = core::GridGeometry({3, 3, 3}, Vector3d::Ones(), Vector3d(-40, 0, 0));
  EXPECT_EQ(earOf(value), scene::Side::Right);
}

// Of a solid block no side is open.
TEST(SlicePlanes, TheEarIsUnknownWhereNothingTellsIt)
{
  const auto solid = [](const Vector3d& origin)
  {
    scene::Case value;
    value.ct.geometry = core::GridGeometry({9, 9, 9}, Vector3d::Ones(), origin);
    value.ct.volume = std::make_shared<const volume::IntensityVolume>(
        std::make_shared<const volume::Volume<std::int16_t>>(value.ct.geometry,
                                                             std::int16_t{1000}));
    value.ct.range = {-1000.0, 1000.0};
    return value;
  };
  for (const double x : {40.0, -40.0})
  {
    scene::Case value = solid(Vector3d(x, 0, 0));
    EXPECT_EQ(earOf(value), x > 0.0 ? scene::Side::Left : scene::Side::Right);
    value.ct.provenance.assumedRas = true;
    EXPECT_FALSE(earOf(value)) << "its file left the side open";
    value.ct.provenance.assumedRas.reset();
    for (const char* const letters : {"RPS", "LPI"})
    {
      value.ct.provenance.axes = core::AxesCorrection::parse(letters);
      EXPECT_FALSE(earOf(value)) << letters;
    }
    value.description.side = scene::Side::Left;
    EXPECT_EQ(earOf(value), scene::Side::Left);
  }
  EXPECT_FALSE(earOf(solid(Vector3d::Zero()))) << "as exports without a header are placed";
}
