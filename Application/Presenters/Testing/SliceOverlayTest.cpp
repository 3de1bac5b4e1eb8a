#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "petrous/Presenters/PlaneSamples.h"
#include "petrous/Presenters/SlicePresenter.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;

namespace
{

constexpr double kPi = 3.14159265358979323846;

template <class Value>
PlaneSamples samplesOf(int width, int height, const Value& value)
{
  PlaneSamples samples{width, height, {}};
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      samples.values.push_back(static_cast<float>(value(column, row)));
  return samples;
}

template <class Value>
std::shared_ptr<const volume::IntensityVolume> imageOf(const core::GridGeometry& grid,
                                                       const Value& value)
{
  auto voxels = std::make_shared<volume::Volume<float>>(grid);
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
        voxels->at(i, j, k) = static_cast<float>(value(grid.patientFromVoxel(Vector3d(i, j, k))));
  return std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<float>>(voxels));
}

double ctAt(const Vector3d& patient)
{
  return patient.dot(Vector3d(2, 3, 5));
}

double mrAt(const Vector3d& patient) // in the MR's own frame
{
  return 500.0 + patient.dot(Vector3d(-4, 1, 2));
}

// A CT with a linear HU ramp, and an MR with another ramp, rotated and translated.
struct Pair
{
  core::GridGeometry grid{{40, 40, 20}, Vector3d(0.5, 0.5, 1.0), Vector3d(-10, -10, -10)};
  core::RigidTransform mrFromCt{
      Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Vector3d(1, -2, 2).normalized())),
      Vector3d(12, -7, 30)};
  scene::Case value;
  SliceOverlay overlay;

  Pair()
  {
    value.ct.geometry = grid;
    value.ct.volume = imageOf(grid, ctAt);
    overlay.mr = imageOf(core::GridGeometry({80, 80, 80}, Vector3d::Constant(0.75),
                                            mrFromCt * grid.center() - Vector3d::Constant(30)),
                         mrAt);
    overlay.mrFromCt = mrFromCt;
    overlay.registered = true;
    overlay.window = {400.0, mrAt(mrFromCt * grid.center())};
  }
};

constexpr GreyWindow kCtWindow{200.0, 0.0};

double grey(double value, const GreyWindow& window)
{
  return std::clamp(255.0 * ((value - window.level) / window.width + 0.5), 0.0, 255.0);
}

} // namespace

TEST(Contours, OfADiscLieOnItsCircleWithinAFiftiethOfAPixel)
{
  const Eigen::Vector2f center(30.3F, 24.7F);
  const auto segments =
      contours(samplesOf(60, 50,
                         [&](int column, int row)
                         {
                           return std::hypot(static_cast<float>(column) - center[0],
                                             static_cast<float>(row) - center[1]);
                         }),
               17.4F, 0.1F);
  double length = 0.0;
  for (const auto& segment : segments)
  {
    EXPECT_NEAR((segment.a - center).norm(), 17.4, 0.02);
    EXPECT_NEAR((segment.b - center).norm(), 17.4, 0.02);
    length += static_cast<double>((segment.b - segment.a).norm());
  }
  EXPECT_NEAR(length, 2.0 * kPi * 17.4, 0.05);
}

TEST(Contours, AreNotDrawnWhereTheImageEndsOrHardlyChanges)
{
  const auto step = [](int column, int) { return column < 10 ? 0.0 : 1000.0; };
  EXPECT_EQ(contours(samplesOf(20, 5, step), 300.0F, 100.0F).size(), 4U);
  EXPECT_TRUE(contours(samplesOf(20, 5, step), 300.0F, 1001.0F).empty());
  for (const float nothing :
       {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()})
    EXPECT_TRUE(
        contours(samplesOf(20, 5, [&](int column, int) { return column < 10 ? nothing : 1000.0F; }),
                 300.0F, 100.0F)
            .empty());
}

TEST(Contours, JoinTheCornersOfASaddleThatItsMiddleJoins)
{
  // Two high corners; the bilinear surface is 0.6 in the middle: they are one region at 0.5.
  const auto joined =
      contours(samplesOf(2, 2, [](int c, int r) { return c == r ? 1.0 : 0.2; }), 0.5F, 0.0F);
  ASSERT_EQ(joined.size(), 2U);
  for (const auto& segment : joined) // each cuts off a low corner: (1, 0) or (0, 1)
  {
    const Eigen::Vector2f middle = 0.5F * (segment.a + segment.b);
    EXPECT_GT(std::abs(middle[0] - middle[1]), 0.5F);
  }
  const auto apart =
      contours(samplesOf(2, 2, [](int c, int r) { return c == r ? 0.8 : 0.0; }), 0.5F, 0.0F);
  ASSERT_EQ(apart.size(), 2U);
  for (const auto& segment : apart)
  {
    const Eigen::Vector2f middle = 0.5F * (segment.a + segment.b);
    EXPECT_LT(std::abs(middle[0] - middle[1]), 0.1F);
  }
}

TEST(Contours, AreDrawnAsWideAsAskedForWhereverTheyLieBetweenPixels)
{
  for (const float at : {10.0F, 10.25F, 10.5F, 10.9F})
  {
    const auto covered = coverage({{{-5.0F, at}, {40.0F, at}}}, 30, 20, 1.3F);
    double sum = 0.0;
    double moment = 0.0;
    for (std::size_t row = 0; row < 20; ++row)
    {
      sum += static_cast<double>(covered[row * 30 + 15]);
      moment += static_cast<double>(row) * static_cast<double>(covered[row * 30 + 15]);
    }
    EXPECT_NEAR(sum, 1.3, 1e-5);
    EXPECT_NEAR(moment / sum, static_cast<double>(at), 0.1);
  }
}

TEST(SliceOverlay, BlendShowsTheMrWhereItsTransformPutsIt)
{
  Pair pair;
  const SlicePresenter presenter(pair.value);
  for (const auto orientation :
       {SliceOrientation::Axial, SliceOrientation::Coronal, SliceOrientation::Sagittal})
    for (const double opacity : {0.0, 0.5, 1.0})
    {
      pair.overlay.opacity = opacity;
      const SliceGeometry slice(orientation, pair.grid.center(), 0.4, 31, 31);
      const SlicePixels pixels = presenter.draw(slice, kCtWindow, &pair.overlay);
      for (const auto& [column, row] : {std::pair(15, 15), std::pair(3, 20), std::pair(25, 9)})
      {
        const Vector3d patient = slice.patientFromPixel(column, row);
        const double ct = grey(ctAt(patient), kCtWindow);
        const double mr = grey(mrAt(pair.mrFromCt * patient), pair.overlay.window);
        // The tint leaves red unchanged.
        EXPECT_NEAR(pixels.at(column, row)[0], (1.0 - opacity) * ct + opacity * mr, 1.6);
        if (opacity == 0.5)
          EXPECT_LT(pixels.at(column, row)[2], pixels.at(column, row)[0]);
        else
          EXPECT_EQ(pixels.at(column, row)[2], pixels.at(column, row)[0]);
      }
    }
}

TEST(SliceOverlay, BoardShowsCtAndMrByTurnsAndLiesStillInThePatient)
{
  Pair pair;
  pair.overlay.mode = OverlayMode::Checker;
  pair.overlay.window.level += 300.0; // darker, so that the two differ
  const SlicePresenter presenter(pair.value);
  const auto isMr = [&](const SliceGeometry& slice, int column, int row)
  {
    const Vector3d patient = slice.patientFromPixel(column, row);
    const auto shown = presenter.draw(slice, kCtWindow, &pair.overlay).at(column, row)[0];
    const bool ct = std::abs(shown - grey(ctAt(patient), kCtWindow)) < 1.1;
    const bool mr =
        std::abs(shown - grey(mrAt(pair.mrFromCt * patient), pair.overlay.window)) < 1.1;
    EXPECT_NE(ct, mr) << column << ' ' << row;
    return mr;
  };
  const double side = checkerSide(0.1);
  EXPECT_DOUBLE_EQ(side, 5.0);
  const SliceGeometry slice(SliceOrientation::Axial, pair.grid.center(), 0.1, 121, 121);
  const auto steps = static_cast<int>(std::lround(side / slice.mmPerPixel()));
  EXPECT_NE(isMr(slice, 20, 20), isMr(slice, 20 + steps, 20));
  EXPECT_NE(isMr(slice, 20, 20), isMr(slice, 20, 20 + steps));
  EXPECT_EQ(isMr(slice, 20, 20), isMr(slice, 20 + steps, 20 + steps));
  const SliceGeometry moved(SliceOrientation::Axial, pair.grid.center() + Vector3d(1, 0.5, 0), 0.1,
                            121, 121);
  EXPECT_EQ(isMr(slice, 20, 20), isMr(moved, 10, 15));
}

TEST(SliceOverlay, EdgesOfTheCtLieOverTheMrAlone)
{
  Pair pair;
  // A sphere of bone in air.
  const Vector3d center = pair.grid.center();
  pair.value.ct.volume = imageOf(pair.grid, [&](const Vector3d& p)
                                 { return 300.0 - 1000.0 * ((p - center).norm() - 6.0); });
  pair.overlay.mode = OverlayMode::Edges;
  const SliceGeometry slice(SliceOrientation::Axial, center, 0.1, 161, 161);
  const SlicePixels pixels = SlicePresenter(pair.value).draw(slice, kCtWindow, &pair.overlay);
  const auto nearer = [](const std::array<std::uint8_t, 3>& pixel, double mr,
                         const std::array<std::uint8_t, 3>& edge)
  { return std::abs(pixel[2] - edge[2]) < std::abs(pixel[2] - mr); };
  int bone = 0;
  for (int row = 0; row < 161; ++row)
    for (int column = 0; column < 161; ++column)
    {
      const Vector3d patient = slice.patientFromPixel(column, row);
      const double radius = (patient - center).norm();
      const double mr = grey(mrAt(pair.mrFromCt * patient), pair.overlay.window);
      const auto pixel = pixels.at(column, row);
      // Bone at 6 mm, skin (-400 HU) 0.7 mm further out; half a line and its casing beside them.
      if (std::abs(radius - 6.0) > 0.22 && std::abs(radius - 6.7) > 0.22)
      {
        ASSERT_NEAR(pixel[1], mr, 0.51) << column << ' ' << row;
      }
      else if (std::abs(radius - 6.0) < 0.01)
      {
        ++bone;
        EXPECT_TRUE(nearer(pixel, 255.0, kBoneEdge)) << column << ' ' << row;
      }
      else if (std::abs(radius - 6.7) < 0.01)
      {
        EXPECT_NEAR(pixel[1], kSkinEdge[1], 40) << column << ' ' << row;
      }
    }
  EXPECT_GT(bone, 20);
}

TEST(SliceOverlay, LeavesWhatLiesOutsideTheMrToTheCtOrDark)
{
  Pair pair;
  pair.overlay.mrFromCt = {Eigen::Quaterniond::Identity(), Vector3d(1e4, 0, 0)};
  const SlicePresenter presenter(pair.value);
  const SliceGeometry slice(SliceOrientation::Axial, pair.grid.center(), 0.2, 41, 41);
  const auto alone = presenter.draw(slice, kCtWindow);
  EXPECT_EQ(presenter.draw(slice, kCtWindow, &pair.overlay).rgb, alone.rgb);
  pair.overlay.mode = OverlayMode::Edges;
  EXPECT_LT(presenter.draw(slice, kCtWindow, &pair.overlay).at(5, 5)[0], 40);
}

TEST(SliceOverlay, ShowsAnMrOfASingleSliceWithinItsOwnThickness)
{
  Pair pair;
  pair.overlay.mr =
      imageOf({{40, 40, 1}, {0.5, 0.5, 4.0}, {-10, -10, 0}}, [](const Vector3d&) { return 1.0; });
  pair.overlay.mrFromCt = {};
  pair.overlay.mode = OverlayMode::Edges;
  pair.overlay.window = {1.0, 0.5};
  const SlicePresenter presenter(pair.value);
  const auto at = [&](double z)
  {
    return presenter.draw({SliceOrientation::Axial, {0, 0, z}, 0.5, 9, 9}, kCtWindow, &pair.overlay)
        .at(4, 4)[0];
  };
  EXPECT_EQ(at(1.9), 255);
  EXPECT_LT(at(2.1), 40);
}

TEST(MrWindow, ShowsTheHeadAndNotTheBackground)
{
  // Three quarters noise near zero, the rest evenly from 200 to 1000, in any unit.
  for (const double unit : {1.0, 1e-3})
  {
    const core::GridGeometry grid({100, 100, 4}, Vector3d::Ones(), Vector3d::Zero());
    const auto image = imageOf(grid,
                               [&](const Vector3d& p)
                               {
                                 return unit * (p[2] < 3.0 ? std::fmod(7.0 * p[0] + p[1], 20.0)
                                                           : 200.0 + 0.08 * (100.0 * p[0] + p[1]));
                               });
    const GreyWindow window = suggestMrWindow(volume::IntensityHistogram(*image));
    EXPECT_NEAR(window.level + 0.5 * window.width, 996.0 * unit, 10.0 * unit);
    EXPECT_GT(window.level - 0.5 * window.width, 10.0 * unit);
    EXPECT_LT(window.level - 0.5 * window.width, 220.0 * unit);
  }
}

TEST(MrWindow, IsUsableForAConstantImage)
{
  const auto image =
      imageOf({{4, 4, 4}, Vector3d::Ones(), Vector3d::Zero()}, [](const Vector3d&) { return 7.0; });
  EXPECT_GT(suggestMrWindow(volume::IntensityHistogram(*image)).width, 0.0);
}
