// What clipping planes and crop boxes leave of a ball, compared with analytic intersections of
// half-spaces and a sphere, for both engines.

#include <random>
#include <sstream>

#include "PictureComparison.h"
#include "PictureScenes.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

constexpr double kSpacing = 0.5; // mm
constexpr double kRadius = 9.0;  // mm
constexpr int kSamples = 48;     // the hull reaches 11.75 mm from the centre
constexpr int kColumns = 72;
constexpr int kRows = 54;

SceneContents ballScene(const Eigen::Matrix3d& direction)
{
  return boneScene(ball<float>(cube(kSamples, kSpacing, direction), kRadius));
}

// Segment of a ray in the remaining ball, with every face offset outwards by `grown` mm; first >
// last: none.
struct Span
{
  double first = 0.0;
  double last = 1e30;
  bool sphere = false; // enters through the ball's surface

  void keep(const Vector& inwards, const Vector& point, double grown, const PixelRay& ray)
  {
    const Vector unit = inwards.normalized();
    const double height = unit.dot(ray.origin - point) + grown;
    const double slope = unit.dot(ray.direction);
    const double t = -height / slope;
    if (slope < 0.0)
      last = std::min(last, t);
    else if (slope > 0.0 && t > first)
    {
      first = t;
      sphere = false;
    }
    else if (slope == 0.0 && height < 0.0)
      last = -1e30;
  }
};

Span spanOf(const SceneContents& contents, const PixelRay& ray, double grown)
{
  Span span;
  const double radius = kRadius + grown;
  const double middle = -ray.origin.dot(ray.direction);
  const double half = radius * radius - (ray.origin.squaredNorm() - middle * middle);
  if (half <= 0.0)
    return {1.0, 0.0, true};
  if (middle - std::sqrt(half) > 0.0)
  {
    span.first = middle - std::sqrt(half);
    span.sphere = true;
  }
  span.last = middle + std::sqrt(half);
  const core::GridGeometry& grid = contents.ct->geometry();
  const core::IndexBox box =
      contents.crop ? contents.crop->intersected(grid.fullBox()) : grid.fullBox();
  for (std::size_t a = 0; a < 3; ++a)
  {
    const Vector axis = grid.direction().col(static_cast<Eigen::Index>(a));
    const auto at = [&](int index)
    {
      Vector voxel = Vector::Zero();
      voxel[static_cast<Eigen::Index>(a)] = index;
      return grid.patientFromVoxel(voxel);
    };
    span.keep(axis, at(box.lower[a]), grown, ray);
    span.keep(-axis, at(box.upper[a] - 1), grown, ray);
  }
  for (const ClippingPlane& plane : contents.clipping)
    span.keep(plane.normal, plane.point, grown, ray);
  return span;
}

struct Tally
{
  int seen = 0;
  int empty = 0;
  int wrong = 0;
};

// Rays that miss a face by less than a tenth of a voxel are inconclusive.
Tally judge(const SceneContents& contents, const core::CameraPose& pose, const DepthImage& depth)
{
  constexpr double sure = 0.1 * kSpacing;
  Tally tally;
  const PixelRays rays(pose, kColumns, kRows);
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
    {
      const PixelRay ray = rays.through(column, row);
      const Span less = spanOf(contents, ray, -sure);
      const Span more = spanOf(contents, ray, sure);
      const double drawn = depth.at(column, row);
      if (less.last > less.first)
      {
        // The ball's surface is within 0.02 voxel, seen at an angle; faces are exact.
        const Span truth = spanOf(contents, ray, 0.0);
        const double slack = less.first - truth.first + 1e-3;
        ++tally.seen;
        const bool sphere = truth.sphere || less.sphere || more.sphere;
        tally.wrong += !(std::abs(drawn - truth.first) <= (sphere ? slack : 2e-3));
      }
      else if (!(more.last > more.first))
      {
        ++tally.empty;
        tally.wrong += !std::isnan(drawn);
      }
    }
  return tally;
}

Tally judgeBoth(const SceneContents& contents, const core::CameraPose& pose,
                const std::string& what)
{
  const Tally reference = judge(contents, pose, truthOf(contents, pose, kColumns, kRows).depth);
  EXPECT_EQ(reference.wrong, 0) << "reference, " << what;
  const Tally drawn = judge(contents, pose, shoot(contents, pose, {}, kColumns, kRows).depth);
  EXPECT_EQ(drawn.wrong, 0) << "graphics card, " << what;
  return drawn;
}

} // namespace

TEST(ClippedRegion, IsNothingWhereClippingPlanesLeaveNothing)
{
  SceneContents contents = ballScene(oblique());
  for (const double gap : {0.0, 1e-4, 0.1, 5.0, 40.0})
    for (const Vector& normal : {Vector(0.1, 1.0, 0.03), Vector(-0.4, 0.2, 1.0)})
    {
      const Vector unit = normal.normalized();
      // Not exactly opposite, within the ball's extent.
      const Vector back = -(unit + (gap >= 5.0 ? 0.05 : 0.0) * unit.unitOrthogonal()).normalized();
      contents.clipping = {{0.5 * gap * unit, unit}, {-0.5 * gap * unit, back}};
      for (const float opacity : {1.0F, 0.35F})
      {
        contents.materials = {boneMaterial(opacity)};
        const ReferencePicture truth = truthOf(contents, slanting(), kColumns, kRows);
        const Shot shot = shoot(contents, slanting(), {}, kColumns, kRows);
        for (std::size_t p = 0; p < truth.depth.millimetres.size(); ++p)
        {
          ASSERT_TRUE(std::isnan(truth.depth.millimetres[p])) << "reference, gap " << gap;
          ASSERT_TRUE(std::isnan(shot.depth.millimetres[p])) << "graphics card, gap " << gap;
          ASSERT_TRUE(isBackground(&shot.picture.rgb[3 * p])) << gap;
          for (std::size_t c = 0; c < 3; ++c)
            ASSERT_NEAR(truth.rgb[3 * p + c], optics::kBackground[c], 1e-6) << gap;
        }
      }
    }
}

TEST(ClippedRegion, IsWhatRandomPlanesAndBoxesLeaveOfABall)
{
  std::mt19937 random(5);
  const auto between = [&random](double low, double high)
  { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto direction = [&between]
  {
    Vector v;
    do
      v = Vector(between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0));
    while (v.norm() > 1.0 || v.norm() < 0.1);
    return v.normalized();
  };
  Tally all;
  for (int scene = 0; scene < 40; ++scene)
  {
    SceneContents contents = ballScene(scene % 2 == 0 ? oblique() : obliqueMirrored());
    const auto planes = static_cast<int>(between(0.0, 6.999));
    std::ostringstream what;
    what << "scene " << scene << ", " << planes << " planes";
    for (int n = 0; n < planes; ++n)
    {
      const Vector normal = direction();
      contents.clipping.push_back({between(-10.0, 4.0) * normal, between(0.1, 3.0) * normal});
    }
    if (scene % 3 != 0)
    {
      core::IndexBox box;
      for (std::size_t a = 0; a < 3; ++a)
      {
        box.lower[a] = static_cast<int>(between(-5.0, 28.0));
        box.upper[a] = static_cast<int>(between(20.0, 55.0));
      }
      contents.crop = box;
      what << ", a crop box";
    }
    // From far away, near the ball and inside it.
    core::CameraPose pose;
    pose.position = (scene % 4 == 0 ? 6.0 : scene % 4 == 1 ? 14.0 : 60.0) * direction();
    pose.focalPoint = 2.0 * direction();
    pose.viewUp = (pose.focalPoint - pose.position).unitOrthogonal();
    if (scene % 4 == 3)
      pose.parallelScale = 11.0;
    else
      pose.viewAngle = scene % 4 == 2 ? 24.0 : 80.0;
    const Tally tally = judgeBoth(contents, pose, what.str());
    all.seen += tally.seen;
    all.empty += tally.empty;
  }
  EXPECT_GT(all.seen, 10000);
  EXPECT_GT(all.empty, 40000);
}
