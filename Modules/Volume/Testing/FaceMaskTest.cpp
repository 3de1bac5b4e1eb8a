#include <cmath>
#include <limits>
#include <set>
#include <string>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "SyntheticHead.h"
#include "petrous/Volume/FaceMask.h"

using namespace petrous;
using namespace petrous::volume;
using namespace petrous::volume::test;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{

using Kind = FaceFinding::Kind;

IntensityVolume imageOf(const SyntheticHead& head, const core::GridGeometry& grid,
                        bool asMr = false)
{
  return IntensityVolume(scanned(head, grid, asMr));
}

Matrix3d axes(const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  Matrix3d m;
  m << a, b, c;
  return m;
}

// Depth at which each ray from the front meets tissue, relative to a plane; NaN where none.
std::vector<double> frontDepth(const IntensityVolume& image, double threshold,
                               const std::vector<Vector3d>& points)
{
  std::vector<double> depths;
  const core::PatientBox box = image.geometry().patientBounds();
  for (const Vector3d& point : points)
  {
    double found = std::numeric_limits<double>::quiet_NaN();
    for (double y = box.min().y(); y < box.max().y(); y += 0.5)
    {
      const Vector3d voxel = image.geometry().voxelFromPatient({point.x(), y, point.z()});
      if (image.geometry().hullContains(voxel) && image.sample(voxel) >= threshold)
      {
        found = y;
        break;
      }
    }
    depths.push_back(found);
  }
  return depths;
}

// What of the depths no surface of second order holds.
std::vector<double> relief(const std::vector<Vector3d>& points, const std::vector<double>& depths)
{
  using Row = Eigen::Matrix<double, 6, 1>;
  const auto row = [](const Vector3d& p)
  {
    const double x = p.x() / 50.0, z = p.z() / 50.0;
    Row r;
    r << 1.0, x, z, x * x, z * z, x * z;
    return r;
  };
  Eigen::Matrix<double, 6, 6> a = Eigen::Matrix<double, 6, 6>::Zero();
  Row b = Row::Zero();
  for (std::size_t n = 0; n < points.size(); ++n)
    if (std::isfinite(depths[n]))
    {
      a += row(points[n]) * row(points[n]).transpose();
      b += row(points[n]) * depths[n];
    }
  const Row q = a.ldlt().solve(b);
  std::vector<double> rest;
  for (std::size_t n = 0; n < points.size(); ++n)
    rest.push_back(depths[n] - row(points[n]).dot(q));
  return rest;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b)
{
  double n = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::isfinite(a[i]) && std::isfinite(b[i]))
    {
      n += 1;
      sa += a[i];
      sb += b[i];
      saa += a[i] * a[i];
      sbb += b[i] * b[i];
      sab += a[i] * b[i];
    }
  const double va = saa - sa * sa / n, vb = sbb - sb * sb / n;
  return (sab - sa * sb / n) / std::sqrt(va * vb);
}

// The front lies at least kFaceDepth behind the skin, and shows no relief of it.
void expectMasked(const IntensityVolume& before, const IntensityVolume& after,
                  const SkinScale& scale, const FaceFinding& found)
{
  const double voxel = after.geometry().spacing().maxCoeff();
  std::vector<Vector3d> inner;
  for (const Vector3d& point : found.skin)
    if (const double height = point.z() - found.region.front.z();
        height > found.region.lower + voxel && height < found.region.upper - voxel)
      inner.push_back(point);
  ASSERT_GT(inner.size(), 500u);
  const auto depths = frontDepth(after, scale.threshold, inner);
  std::size_t shallow = 0;
  for (std::size_t n = 0; n < inner.size(); ++n)
    shallow += depths[n] < inner[n].y() + kFaceDepth - voxel ? 1 : 0;
  EXPECT_EQ(shallow, 0u) << "of " << inner.size();

  // The front is the plane, but for cavities that it opens.
  std::vector<Vector3d> flat;
  for (std::size_t n = 0; n < inner.size(); ++n)
    if (found.region.inFront({inner[n].x(), depths[n], inner[n].z()}) > -2.0 * voxel)
      flat.push_back(inner[n]);
  EXPECT_GT(flat.size(), inner.size() / 2);
  const auto old = relief(flat, frontDepth(before, scale.threshold, flat));
  const auto now = relief(flat, frontDepth(after, scale.threshold, flat));
  EXPECT_LT(std::abs(correlation(old, now)), 0.2);
  EXPECT_GT(std::abs(correlation(old, old)), 0.99);
}

} // namespace

TEST(FaceMask, LeavesNoReliefInAnyOrientationAndSpacing)
{
  const SyntheticHead head;
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  const Matrix3d oblique =
      (Eigen::AngleAxisd(0.3, z) * Eigen::AngleAxisd(-0.2, x) * Eigen::AngleAxisd(0.15, y))
          .toRotationMatrix();
  const std::vector<std::pair<Matrix3d, Vector3d>> grids{
      {Matrix3d::Identity(), {1.5, 1.5, 2.0}},
      {axes(y, -z, x), {1.6, 1.6, 3.0}},  // sagittal
      {axes(x, -z, -y), {1.5, 1.5, 2.0}}, // coronal
      {oblique, {1.6, 1.4, 2.0}},
      {axes(-x, -y, z), {1.5, 1.8, 2.5}}};
  for (const auto& [direction, spacing] : grids)
  {
    SCOPED_TRACE(spacing.transpose());
    const IntensityVolume image = imageOf(head, gridOver(headBox(), spacing, direction));
    const SkinScale scale = skinScale(image, false);
    EXPECT_EQ(scale.threshold, -300.0);
    const FaceFinding found = findFace(image, scale);
    ASSERT_EQ(found.kind, Kind::Face) << found.text;
    EXPECT_NEAR(found.region.front.y(), head.noseTip().y(), 3.0);
    EXPECT_NEAR(found.region.front.z(), head.noseTip().z(), 12.0);
    const MaskedImage masked = maskFace(image, found.region, nullptr);
    EXPECT_GT(masked.changed, 0u);
    EXPECT_EQ(masked.kept, 0u);
    expectMasked(image, *masked.image, scale, found);

    // Idempotent.
    const FaceFinding again = findFace(*masked.image, scale);
    EXPECT_EQ(again.kind, Kind::Masked) << again.text;
    EXPECT_EQ(maskFace(*masked.image, found.region, nullptr).changed, 0u);
  }
}

// 15 mm in front of the temporal bone, which ends 38 mm in front of the ears' line.
TEST(FaceMask, LeavesTheTemporalBonesToTheBit)
{
  for (const double pitch : {-20.0, 0.0, 20.0})
  {
    SCOPED_TRACE(pitch);
    const SyntheticHead head(pitch);
    const core::GridGeometry grid = gridOver(headBox(), Vector3d(2, 2, 2));
    const IntensityVolume image = imageOf(head, grid);
    const SkinScale scale = skinScale(image, false);
    const FaceFinding found = findFace(image, scale);
    ASSERT_EQ(found.kind, Kind::Face) << found.text;
    const MaskedImage masked = maskFace(image, found.region, nullptr);
    expectMasked(image, *masked.image, scale, found);
    // Eyes and chin are out, however the head is held.
    for (const Vector3d& own : {Vector3d(32, -74, 30), Vector3d(-32, -74, 30),
                                Vector3d(0, -88, -68), Vector3d(30, -88, 50)})
      EXPECT_TRUE(found.region.covers(head.placed(own))) << own.transpose();
    const core::Index3 n = grid.dims();
    const Vector3d forward = head.placed(-Vector3d::UnitY());
    const Vector3d up = head.placed(Vector3d::UnitZ());
    std::size_t other = 0, compared = 0;
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i)
        {
          const Vector3d from = grid.patientFromVoxel(Vector3d(i, j, k)) - head.earLine();
          if (from.dot(forward) > 38.0 + 15.0 || std::abs(from.dot(up)) > 60.0)
            continue;
          ++compared;
          other += image.at(i, j, k) != masked.image->at(i, j, k) ? 1 : 0;
        }
    EXPECT_GT(compared, 100000u);
    EXPECT_EQ(other, 0u);
  }
}

// Turned on the pillow, laid on the shoulder, chin up and down.
TEST(FaceMask, FollowsTheHeadsTurn)
{
  struct Turn
  {
    double yaw, roll, pitch; // degrees
  };
  for (const Turn& turn : {Turn{15, 0, 0}, Turn{-30, 0, 0}, Turn{45, 0, 0}, Turn{60, 0, 0},
                           Turn{0, 30, 0}, Turn{0, 0, 45}, Turn{0, 0, -45}, Turn{30, 15, 20}})
  {
    SCOPED_TRACE(std::to_string(turn.yaw) + " " + std::to_string(turn.roll) + " " +
                 std::to_string(turn.pitch));
    constexpr double kDegree = 3.14159265358979 / 180.0;
    const SyntheticHead own;
    const SyntheticHead head(Matrix3d(Eigen::AngleAxisd(turn.yaw * kDegree, Vector3d::UnitZ()) *
                                      Eigen::AngleAxisd(turn.roll * kDegree, Vector3d::UnitY()) *
                                      Eigen::AngleAxisd(turn.pitch * kDegree, Vector3d::UnitX())));
    const core::PatientBox box(Vector3d(-150, -150, -130), Vector3d(150, 150, 160));
    const IntensityVolume image = imageOf(head, gridOver(box, Vector3d(2.5, 2.5, 2.5)));
    const FaceFinding found = findFace(image, {});
    ASSERT_EQ(found.kind, Kind::Face) << found.text;
    std::size_t skin = 0, left = 0;
    for (double z = -70.0; z <= 60.0; z += 4.0)
      for (double x = -40.0; x <= 40.0; x += 4.0)
      {
        Vector3d at(x, -130.0, z); // in the head's own axes
        while (at.y() < 0.0 && own.hounsfield(at) < -300.0)
          at.y() += 0.5;
        ++skin;
        left += found.region.covers(head.placed(at)) ? 0 : 1;
      }
    EXPECT_GT(skin, 600u);
    EXPECT_EQ(left, 0u);
    std::size_t masked = 0; // of the temporal bones
    for (const double side : {-1.0, 1.0})
      for (double y = -35.0; y <= 30.0; y += 5.0)
        for (double x = 35.0; x <= 65.0; x += 5.0)
          masked += found.region.covers(head.placed({side * x, y, 15.0})) ? 1 : 0;
    EXPECT_EQ(masked, 0u);
    EXPECT_EQ(findFace(*maskFace(image, found.region, nullptr).image, {}).kind, Kind::Masked);
  }
}

// Sagittal series, as of the pituitary.
TEST(FaceMask, MasksAProfileHoweverNarrow)
{
  const SyntheticHead head;
  for (const auto& [width, asMr] :
       {std::pair{58.0, false}, {58.0, true}, {40.0, false}, {30.0, false}})
  {
    SCOPED_TRACE(width);
    const core::PatientBox box(Vector3d(-0.5 * width, -135, -125), Vector3d(0.5 * width, 115, 150));
    const IntensityVolume image = imageOf(head, gridOver(box, Vector3d(3.0, 1.5, 1.5)), asMr);
    const FaceFinding found = findFace(image, skinScale(image, asMr));
    ASSERT_EQ(found.kind, Kind::Part) << found.text;
    EXPECT_NEAR(found.region.front.y(), head.noseTip().y(), 3.0);
    for (const double z : {-68.0, -32.0, 0.0, 28.0, 52.0})
      EXPECT_TRUE(found.region.covers({0.0, -74.0, z})) << z;
    EXPECT_FALSE(found.region.covers({10.0, -35.0, 15.0}));
  }
}

TEST(FaceMask, FindsNoFaceWhereTheFieldOfViewEndsBeforeIt)
{
  const SyntheticHead head;
  const core::PatientBox ear(Vector3d(62, -12, 0), Vector3d(90, 16, 28));
  const core::PatientBox wideEar(Vector3d(0, -55, -45), Vector3d(100, 65, 70));
  const core::PatientBox back(Vector3d(-100, -20, -60), Vector3d(100, 112, 140));
  for (const auto& [box, spacing] : {std::pair{ear, 0.15}, {wideEar, 1.2}, {back, 2.0}})
  {
    const IntensityVolume image = imageOf(head, gridOver(box, Vector3d::Constant(spacing)));
    const FaceFinding found = findFace(image, {});
    EXPECT_EQ(found.kind, Kind::None);
    EXPECT_NE(found.text.find("no face in this volume"), std::string::npos) << found.text;
  }
  const IntensityVolume air(
      std::make_shared<const Volume<std::int16_t>>(gridOver(ear, Vector3d::Constant(2.0)), -1000));
  EXPECT_EQ(findFace(air, {}).kind, Kind::None);
}

// An axial stack of the temporal bones with all of the head's width.
TEST(FaceMask, MasksTheBandOfAFaceInALowStack)
{
  const SyntheticHead head;
  const core::PatientBox box(Vector3d(-105, -135, -25), Vector3d(105, 115, 45));
  const IntensityVolume image = imageOf(head, gridOver(box, Vector3d(1.5, 1.5, 1.5)));
  const FaceFinding found = findFace(image, {});
  ASSERT_EQ(found.kind, Kind::Face) << found.text;
  expectMasked(image, *maskFace(image, found.region, nullptr).image, {}, found);
}

TEST(FaceMask, MasksAnMrWithItsBackground)
{
  const SyntheticHead head;
  const IntensityVolume image = imageOf(head, gridOver(headBox(), Vector3d(2, 2, 2)), true);
  const SkinScale scale = skinScale(image, true);
  EXPECT_GT(scale.threshold, 60.0);
  EXPECT_LT(scale.threshold, 330.0);
  const FaceFinding found = findFace(image, scale);
  ASSERT_EQ(found.kind, Kind::Face) << found.text;
  EXPECT_NEAR(found.region.air, 35.0, 10.0);
  expectMasked(image, *maskFace(image, found.region, nullptr).image, scale, found);
}

TEST(FaceMask, TakesTheAuriclesOnlyIfAsked)
{
  const SyntheticHead head;
  const core::GridGeometry grid = gridOver(headBox(), Vector3d(2, 2, 2));
  const IntensityVolume image = imageOf(head, grid);
  const Vector3d left(89, 8, 20), right(-89, 8, 20), canal(60, 0, 15);
  EXPECT_FALSE(findFace(image, {}).region.covers(left));
  const FaceFinding found = findFace(image, {}, true);
  EXPECT_TRUE(found.region.covers(left));
  EXPECT_TRUE(found.region.covers(right));
  EXPECT_FALSE(found.region.covers(canal));
}

TEST(FaceMask, NeverChangesWhatIsKept)
{
  const SyntheticHead head;
  const core::GridGeometry grid = gridOver(headBox(), Vector3d(2, 2, 2));
  const IntensityVolume image = imageOf(head, grid);
  const FaceFinding found = findFace(image, {});
  ASSERT_EQ(found.kind, Kind::Face);
  const Vector3d tip = head.noseTip();
  CellSet keep(grid.patientBounds(), 2.0);
  EXPECT_TRUE(keep.empty());
  keep.add(tip);
  keep.grow(5.0);
  const MaskedImage masked = maskFace(image, found.region, &keep);
  EXPECT_GT(masked.kept, 50u);
  const core::Index3 n = grid.dims();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
      {
        const bool isKept = (grid.patientFromVoxel(Vector3d(i, j, k)) - tip).norm() <= 5.0;
        ASSERT_TRUE(!isKept || image.at(i, j, k) == masked.image->at(i, j, k));
      }
}

TEST(FaceMask, OutsideOfARegionIsAir)
{
  const SyntheticHead head;
  const core::GridGeometry grid = gridOver(headBox(), Vector3d(3, 3, 3));
  const IntensityVolume image = imageOf(head, grid);
  const core::PatientBox box(Vector3d(20, -40, -30), Vector3d(90, 40, 50));
  const core::RigidTransform shift(Eigen::Quaterniond::Identity(), Vector3d(0, 0, 7));
  const MaskedImage masked = maskOutside(image, box, shift, -1000.0, nullptr);
  const core::Index3 n = grid.dims();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
      {
        const Vector3d at = shift * grid.patientFromVoxel(Vector3d(i, j, k));
        ASSERT_EQ(masked.image->at(i, j, k), box.contains(at) ? image.at(i, j, k) : -1000.0);
      }
}
