#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "petrous/Segmentation/TubeTrace.h"

using namespace petrous;
using namespace petrous::segmentation;
using Eigen::Vector3d;

namespace
{

constexpr double kPi = 3.14159265358979323846;

using Curve = std::function<Vector3d(double t)>; ///< 0 to 1

/// Bone of 1200 with a canal of 50 along a curve, blurred across about a voxel, in noise.
struct Scan
{
  core::GridGeometry grid;
  Curve curve;
  double radius = 0.8; ///< mm
  double noise = 50.0;
  double inside = 50.0, outside = 1200.0;

  std::vector<Vector3d> dense() const
  {
    std::vector<Vector3d> points;
    for (int n = 0; n <= 2000; ++n)
      points.push_back(curve(n / 2000.0));
    return points;
  }

  volume::IntensityVolume image(std::uint32_t seed = 1) const
  {
    const auto line = dense();
    auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid);
    // Only voxels near the curve are compared with it.
    std::vector<float> nearest(voxels->size(), 1e6F);
    const double reach = radius + 2.5;
    for (const Vector3d& p : line)
    {
      const Vector3d v = grid.voxelFromPatient(p);
      core::IndexBox box;
      for (int a = 0; a < 3; ++a)
      {
        const double r = reach / grid.spacing()[a];
        box.lower[static_cast<std::size_t>(a)] = static_cast<int>(std::floor(v[a] - r));
        box.upper[static_cast<std::size_t>(a)] = static_cast<int>(std::ceil(v[a] + r)) + 1;
      }
      box = box.intersected(grid.fullBox());
      for (int k = box.lower[2]; k < box.upper[2]; ++k)
        for (int j = box.lower[1]; j < box.upper[1]; ++j)
          for (int i = box.lower[0]; i < box.upper[0]; ++i)
          {
            float& best = nearest[grid.linearIndex(i, j, k)];
            best = std::min(
                best, static_cast<float>((grid.patientFromVoxel(Vector3d(i, j, k)) - p).norm()));
          }
    }
    std::mt19937 random(seed);
    std::normal_distribution<double> gauss(0.0, noise > 0.0 ? noise : 1.0);
    const double blur = 0.7 * grid.spacing().mean();
    for (std::size_t n = 0; n < voxels->size(); ++n)
    {
      const double share =
          0.5 * std::erfc((static_cast<double>(nearest[n]) - radius) / (std::sqrt(2.0) * blur));
      voxels->data()[n] = static_cast<std::int16_t>(
          std::lround(outside + (inside - outside) * share + (noise > 0.0 ? gauss(random) : 0.0)));
    }
    return volume::IntensityVolume(std::shared_ptr<const volume::Volume<std::int16_t>>(voxels));
  }

  std::vector<Vector3d> clicks(int count, double jitter, std::uint32_t seed = 2) const
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> off(-1.0, 1.0);
    std::vector<Vector3d> points;
    for (int n = 0; n < count; ++n)
    {
      Vector3d d(off(random), off(random), off(random));
      points.push_back(curve(0.03 + 0.94 * n / (count - 1)) + jitter * d.normalized());
    }
    return points;
  }

  /// Mean and largest distance of the tube's line from the curve, its ends left out, mm.
  std::pair<double, double> errors(const Tube& tube) const
  {
    const auto line = dense();
    double sum = 0.0;
    double most = 0.0;
    std::size_t count = 0;
    for (std::size_t n = tube.line.size() / 20; n < tube.line.size() - tube.line.size() / 20; ++n)
    {
      double best = 1e9;
      for (const Vector3d& p : line)
        best = std::min(best, (tube.line[n] - p).norm());
      sum += best;
      most = std::max(most, best);
      ++count;
    }
    return {sum / static_cast<double>(count), most};
  }
};

core::GridGeometry cube(double spacing, const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity())
{
  const int n = static_cast<int>(std::lround(26.0 / spacing));
  return {{n, n, n}, Vector3d::Constant(spacing), Vector3d(-3.0, 4.0, 5.0), axes};
}

/// Like the facial nerve: straight, a bend of a centimetre, straight on.
Curve bend(const core::GridGeometry& grid)
{
  return [grid](double t)
  {
    const double angle = kPi * t;
    const Vector3d local(13.0 + 7.5 * std::cos(angle), 9.0 + 8.0 * std::sin(angle),
                         13.0 + 2.0 * std::sin(2.0 * angle));
    return Vector3d(grid.origin() + grid.direction() * local);
  };
}

} // namespace

TEST(TubeTrace, FollowsABendInNoiseBelowAVoxel)
{
  for (const double spacing : {0.25, 0.4, 0.6})
  {
    const auto grid = cube(spacing);
    const Scan scan{grid, bend(grid)};
    const Tube tube = traceTube(scan.image(), scan.clicks(5, 0.5));
    const auto [mean, most] = scan.errors(tube);
    EXPECT_LE(mean, 0.15) << spacing;
    EXPECT_LE(most, 0.44) << spacing;
    EXPECT_NEAR(tube.radius, 0.8, 0.2) << spacing;
    EXPECT_GE(tube.smallestRadius, 0.3) << spacing << ": nowhere thin as a thread";
    ASSERT_EQ(tube.pointDistances.size(), 5U);
    for (const double distance : tube.pointDistances)
      EXPECT_LT(distance, 0.8);
  }
}

TEST(TubeTrace, PointsOutOfTheirOrderAreNoticed)
{
  // A helix of two turns, closer along its axis than along the line.
  std::vector<Vector3d> helix;
  for (int n = 0; n < 8; ++n)
    helix.emplace_back(4.0 * std::cos(0.7 * n), 4.0 * std::sin(0.7 * n), 1.5 * n);
  EXPECT_TRUE(segmentation::likelyOrder(helix).empty());
  EXPECT_TRUE(segmentation::likelyOrder({helix.rbegin(), helix.rend()}).empty());
  const std::vector<std::size_t> shuffle{3, 0, 6, 1, 7, 4, 2, 5};
  std::vector<Vector3d> points;
  for (const std::size_t n : shuffle)
    points.push_back(helix[n]);
  const auto order = segmentation::likelyOrder(points);
  ASSERT_EQ(order.size(), helix.size());
  const bool isForth = shuffle[order.front()] == 0;
  for (std::size_t n = 0; n < order.size(); ++n)
    EXPECT_EQ(shuffle[order[n]], isForth ? n : 7 - n);
  EXPECT_LT(order.front(), order.back());
  // The sharp bend at the geniculate ganglion is no reason.
  EXPECT_TRUE(segmentation::likelyOrder({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {-4, 3, 0}}).empty());
  EXPECT_TRUE(segmentation::likelyOrder({{0, 0, 0}, {1, 0, 0}}).empty());
}

TEST(TubeTrace, ANewPointGoesOnFromTheNearerEndUnlessItLiesBetweenTwo)
{
  // Points alone: in order along any of these, each next one goes to the end.
  const std::vector<std::vector<Vector3d>> curves{
      {{0, 0, 0}, {8, 0, 0}, {6.5, 2.6, 0}, {5, 5.2, 0}}, // turns back by 120 degrees
      {{0, 0, 0}, {4, 0, 0}, {1, 3, 0}, {-4, 6, 0}},      // a short first leg
      {{0, 0, 0}, {5, 1, 0}, {8, 5, 0}, {8, 10, 0}, {4, 14, 0}, {-1, 15, 0}, {-5, 11, 0}}};
  for (const auto& curve : curves)
    for (std::size_t n = 1; n < curve.size(); ++n)
    {
      Tube tube;
      tube.points.assign(curve.begin(), curve.begin() + static_cast<std::ptrdiff_t>(n));
      EXPECT_EQ(insertionIndex(tube, curve[n]), n);
    }
  Tube tube;
  tube.points = {{0, 0, 0}, {10, 0, 0}, {20, 4, 0}};
  EXPECT_EQ(insertionIndex(tube, {-5, 1, 0}), 0U);
  EXPECT_EQ(insertionIndex(tube, {5, 1.5, 0}), 1U);
  EXPECT_EQ(insertionIndex(tube, {15, 1, 1}), 2U);
  EXPECT_EQ(insertionIndex(tube, {24, 9, 0}), 3U);
  // With its line: the middle of a bend lies far from the chord.
  const auto grid = cube(0.4);
  const Scan scan{grid, bend(grid)};
  const auto image = scan.image();
  const auto all = scan.clicks(6, 0.3);
  for (std::size_t n = 2; n < all.size(); ++n)
    EXPECT_EQ(
        insertionIndex(
            traceTube(image, {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n)}), all[n]),
        n);
  EXPECT_EQ(insertionIndex(traceTube(image, {all[0], all[3]}), all[2]), 1U);
  EXPECT_EQ(insertionIndex(traceTube(image, {all[1], all[2], all[3]}), all[0]), 0U);
}

/// The same image, stored the other way along some axes.
volume::IntensityVolume storedOtherwise(const volume::IntensityVolume& image,
                                        const std::array<bool, 3>& isTurned)
{
  const core::GridGeometry& grid = image.geometry();
  Eigen::Matrix3d axes = grid.direction();
  Vector3d first = Vector3d::Zero();
  for (int a = 0; a < 3; ++a)
    if (isTurned[static_cast<std::size_t>(a)])
    {
      axes.col(a) *= -1.0;
      first[a] = grid.dims()[static_cast<std::size_t>(a)] - 1;
    }
  const core::Index3& n = grid.dims();
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(
      core::GridGeometry(n, grid.spacing(), grid.patientFromVoxel(first), axes));
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        voxels->at(i, j, k) = static_cast<std::int16_t>(image.at(isTurned[0] ? n[0] - 1 - i : i,
                                                                 isTurned[1] ? n[1] - 1 - j : j,
                                                                 isTurned[2] ? n[2] - 1 - k : k));
  return volume::IntensityVolume(std::shared_ptr<const volume::Volume<std::int16_t>>(voxels));
}

TEST(TubeTrace, DoesNotDependOnTheOrderOfTheVoxels)
{
  // Noise that grows across the image, as beside the petrous bone, so that it matters where it is
  // measured; the tube is hardly wider than a voxel.
  Scan scan;
  scan.grid = core::GridGeometry({71, 58, 47}, Vector3d(0.5, 0.5, 0.6), Vector3d(-17, -14, -13));
  scan.curve = [](double t) { return Vector3d(-9.0 + 18.0 * t, 3.0 * std::sin(kPi * t), 2.0 * t); };
  scan.radius = 0.6;
  scan.noise = 0.0;
  scan.outside = 500.0;
  const auto plain = scan.image();
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(scan.grid);
  std::mt19937 random(7);
  std::normal_distribution<double> gauss(0.0, 1.0);
  for (int k = 0; k < 47; ++k)
    for (int j = 0; j < 58; ++j)
      for (int i = 0; i < 71; ++i)
        voxels->at(i, j, k) = static_cast<std::int16_t>(
            std::lround(plain.at(i, j, k) + (20.0 + 2.0 * i + 1.5 * j) * gauss(random)));
  const volume::IntensityVolume image(std::shared_ptr<const volume::Volume<std::int16_t>>{voxels});
  const auto points = scan.clicks(4, 0.5);
  const Tube own = traceTube(image, points);
  for (const std::array<bool, 3>& isTurned :
       {std::array<bool, 3>{true, false, false}, std::array<bool, 3>{false, true, true},
        std::array<bool, 3>{true, true, true}})
  {
    const volume::IntensityVolume other = storedOtherwise(image, isTurned);
    const Tube tube = traceTube(other, points);
    EXPECT_NEAR(tube.noise, own.noise, 1e-6 * own.noise);
    EXPECT_TRUE(tube.model == own.model);
    EXPECT_NEAR(tube.length, own.length, 0.05);
    EXPECT_NEAR(tube.radius, own.radius, 0.02);
    double farthest = 0.0;
    for (const Vector3d& p : tube.line)
    {
      double best = 1e9;
      for (std::size_t n = 0; n + 1 < own.line.size(); ++n)
      {
        const Vector3d run = own.line[n + 1] - own.line[n];
        const double t = std::clamp((p - own.line[n]).dot(run) / run.squaredNorm(), 0.0, 1.0);
        best = std::min(best, (p - own.line[n] - t * run).norm());
      }
      farthest = std::max(farthest, best);
    }
    EXPECT_LT(farthest, 0.05);
  }
}

TEST(TubeTrace, APointOutsideOfTheTubeIsKnown)
{
  const auto grid = cube(0.4);
  const Scan scan{grid, bend(grid)}; // radius 0.8 mm
  auto points = scan.clicks(5, 0.3);
  EXPECT_EQ(traceTube(scan.image(), points).outsideAtPoint, std::vector<std::uint8_t>(5, 0));
  points[2] = scan.curve(0.5) + Vector3d(0, 0, 1.4);
  EXPECT_EQ(traceTube(scan.image(), points).outsideAtPoint,
            (std::vector<std::uint8_t>{0, 0, 1, 0, 0}));
}

TEST(TubeTrace, FollowsATurnedAnisotropicGrid)
{
  const Eigen::Matrix3d axes =
      (Eigen::AngleAxisd(0.6, Vector3d::UnitX()) * Eigen::AngleAxisd(-0.4, Vector3d::UnitY()))
          .toRotationMatrix();
  const core::GridGeometry grid({87, 87, 44}, Vector3d(0.3, 0.3, 0.6), Vector3d(10, -20, 30), axes);
  const Scan scan{grid, bend(grid)};
  const Tube tube = traceTube(scan.image(), scan.clicks(6, 0.4));
  const auto [mean, most] = scan.errors(tube);
  EXPECT_LE(mean, 0.15);
  EXPECT_LE(most, 0.44);
}

TEST(TubeTrace, FindsABrightVesselAsWell)
{
  const auto grid = cube(0.4);
  Scan scan{grid, bend(grid)};
  scan.inside = 900.0;
  scan.outside = 100.0;
  scan.radius = 1.5;
  const Tube tube = traceTube(scan.image(), scan.clicks(5, 0.5));
  EXPECT_TRUE(tube.model.isBright);
  const auto [mean, most] = scan.errors(tube);
  EXPECT_LE(mean, 0.15);
  EXPECT_LE(most, 0.44);
  EXPECT_NEAR(tube.radius, 1.5, 0.25);
}

// The tympanic segment: 0.4 mm of bone between the canal and the tympanic cavity.
TEST(TubeTrace, IsNotDrawnIntoACavityBehindAThinWall)
{
  for (const double spacing : {0.3, 0.4})
  {
    const auto grid = cube(spacing);
    const Scan scan{grid, bend(grid), 0.9, 30.0};
    const auto line = scan.dense();
    auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid);
    std::mt19937 random(5);
    std::normal_distribution<double> gauss(0.0, scan.noise);
    const auto tissue = [&](const Vector3d& p)
    {
      double nearest = 1e9;
      for (std::size_t n = 0; n < line.size(); n += 20)
        nearest = std::min(nearest, (p - line[n]).norm());
      if (nearest < 0.9)
        return 50.0;
      return nearest > 1.3 && p.z() > 13.0 + grid.origin().z() + 0.3 ? -1000.0 : 1500.0;
    };
    for (int k = 0; k < grid.dims()[2]; ++k)
      for (int j = 0; j < grid.dims()[1]; ++j)
        for (int i = 0; i < grid.dims()[0]; ++i)
        {
          double sum = 0.0; // a voxel is the mean of what it covers
          for (int part = 0; part < 8; ++part)
            sum += tissue(grid.patientFromVoxel(Vector3d(i + 0.5 * (part & 1) - 0.25,
                                                         j + 0.5 * (part >> 1 & 1) - 0.25,
                                                         k + 0.5 * (part >> 2) - 0.25)));
          voxels->at(i, j, k) = static_cast<std::int16_t>(std::lround(sum / 8.0 + gauss(random)));
        }
    const volume::IntensityVolume image(
        std::shared_ptr<const volume::Volume<std::int16_t>>(std::move(voxels)));
    const auto [mean, most] = scan.errors(traceTube(image, scan.clicks(6, 0.6)));
    EXPECT_LE(mean, 0.15) << spacing;
    EXPECT_LE(most, 0.44) << spacing;
  }
}

TEST(TubeTrace, AnyVoxelTypeAndItsPaddingGiveTheSameLine)
{
  const auto grid = cube(0.4);
  const Scan scan{grid, bend(grid)};
  const auto image = scan.image();
  const auto points = scan.clicks(5, 0.4);
  const Tube tube = traceTube(image, points);

  auto unsigned16 = std::make_shared<volume::Volume<std::uint16_t>>(grid);
  auto real = std::make_shared<volume::Volume<float>>(grid);
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
      {
        const double value = image.at(i, j, k);
        const bool outside = k < 2; // far from the canal
        unsigned16->at(i, j, k) = static_cast<std::uint16_t>(outside ? 65535 : value + 2000.0);
        real->at(i, j, k) = outside ? NAN : static_cast<float>(0.001 * value);
      }
  const volume::IntensityVolume images[] = {
      volume::IntensityVolume(std::shared_ptr<const volume::Volume<std::uint16_t>>(unsigned16),
                              65535.0),
      volume::IntensityVolume(std::shared_ptr<const volume::Volume<float>>(real))};
  for (const auto& other : images)
  {
    const Tube same = traceTube(other, points);
    EXPECT_FALSE(same.model.isBright);
    EXPECT_NEAR(same.radius, tube.radius, 0.03);
    const auto [mean, most] = scan.errors(same);
    EXPECT_LE(mean, 0.15);
    EXPECT_LE(most, 0.44);
  }
}

TEST(TubeTrace, AFarPointKeepsTheLine)
{
  const auto grid = cube(0.4);
  const Scan scan{grid, bend(grid)};
  auto points = scan.clicks(5, 0.0);
  points[2] += Vector3d(0.0, 3.0, 0.0); // in solid bone, 3 mm from the canal
  const Tube tube = traceTube(scan.image(), points);
  EXPECT_EQ(tube.heldAtPoint[2], 1);
  EXPECT_LT(tube.pointDistances[2], 0.3);
  EXPECT_EQ(tube.heldAtPoint[1], 0);
  EXPECT_LT(tube.pointDistances[1], 0.2);
}

TEST(TubeTrace, SaysWhereTheImageShowsNothing)
{
  const auto grid = cube(0.4);
  Scan scan{grid, bend(grid)};
  scan.inside = scan.outside; // noise alone
  const Tube tube = traceTube(scan.image(), scan.clicks(5, 0.0));
  EXPECT_LT(tube.resolvedLength, 0.2 * tube.length);
  EXPECT_GE(tube.smallestRadius, 0.2);
}

// A nerve in a fluid or a muscle that looks like it: what is measured there is noise.
TEST(TubeTrace, WhereNothingIsSeenTheRadiusIsTheUsualOne)
{
  const auto grid = cube(0.4);
  Scan scan{grid, bend(grid)};
  const auto points = scan.clicks(5, 0.0);
  TubeOptions options;
  options.usual = usualFor("facial_nerve");
  EXPECT_NEAR(traceTube(scan.image(), points, options).radius, 0.8, 0.2) << "what is seen counts";
  scan.inside = scan.outside;
  const Tube tube = traceTube(scan.image(), points, options);
  EXPECT_EQ(tube.smallestRadius, 0.6);
  EXPECT_EQ(tube.largestRadius, 0.6);
  EXPECT_TRUE(hasUsualRadius(tube, options));
  TubeOptions given = options;
  given.radius = 0.6;
  EXPECT_FALSE(hasUsualRadius(tube, given)) << "it is the user's";
  EXPECT_EQ(usualFor("Chorda tympani"), 0.2);
  EXPECT_FALSE(usualFor("sigmoid sinus"));
  for (const char* name : {"facial_nerve",
                           "FacialNerve left",
                           "N. facialis",
                           "Nervus facialis",
                           "facial left",
                           "Fazialis",
                           "Fazialis links",
                           "N. fazialis",
                           "Fazialiskanal",
                           "Gesichtsnerv",
                           "CN VII",
                           "cn_7",
                           "N. VII",
                           "fallopian canal",
                           "facial nerve, tympanic segment",
                           "facial nerve IAC",
                           "facial nerve, internal auditory canal",
                           "facial nerve in the middle ear",
                           "facial nerve antrum",
                           "facial_nerve_lumen",
                           "facial_nerve_ear_canal",
                           "facial_mastoid",
                           "facial mastoid segment",
                           "MastoidFacial",
                           "Facialis mastoidal",
                           "Facialisverlauf",
                           "facial_labyrinthine",
                           "facial_genu",
                           "facial_meatal",
                           "facial cisternal",
                           "facial parotid",
                           "facial trunk",
                           "facial planned",
                           "facial_preop",
                           "CN VII mastoid",
                           "N. VII meatus",
                           "facial nerve, temporal bone",
                           "facial nerve to stapedius",
                           "Fazialis Nervenaustritt"})
  {
    EXPECT_EQ(usualFor(name), 0.6) << name;
    EXPECT_EQ(widestFor(name), 1.3) << name;
    EXPECT_TRUE(lumenFor(name)) << name;
  }
  for (const char* name : {"Paukensaite", "chorda in the middle ear", "chorda tympani, mastoid"})
  {
    EXPECT_EQ(usualFor(name), 0.2) << name;
    EXPECT_EQ(widestFor(name), 0.5) << name;
    EXPECT_TRUE(lumenFor(name)) << name;
  }
  for (const char* name :
       {"vestibular nerve", "CN VIII", "N. VIII", "H\u00f6rnerv", "Nervenverlauf", "Nervenende",
        "cochlear nerve", "nerve IAC", "Nervus stapedius"})
  {
    EXPECT_TRUE(lumenFor(name)) << name;
    EXPECT_FALSE(usualFor(name)) << name;
    EXPECT_EQ(widestFor(name), TubeOptions{}.widest) << name;
  }
  for (const char* other : {"facial recess",
                            "Facial_Ridge",
                            "facial vein",
                            "Arteria facialis",
                            "facial bones",
                            "midfacial",
                            "facial skeleton",
                            "facial muscle",
                            "facial colliculus",
                            "A. facialis",
                            "V. facialis",
                            "innervation",
                            "facial artery",
                            "FacialArteryAntrum",
                            "facial schwannoma",
                            "facial nerve schwannoma",
                            "facial nerve tumour",
                            "Fazialisneurinom",
                            "Fazialisvene",
                            "Gesichtsvene",
                            "facial sinus",
                            "facial nerve implant",
                            "facial left bones",
                            "facial fat",
                            "mastoid",
                            "antrum"})
  {
    EXPECT_FALSE(usualFor(other)) << other;
    EXPECT_FALSE(lumenFor(other)) << other;
    EXPECT_EQ(widestFor(other), TubeOptions{}.widest) << other;
  }
  options.usual = 0.0;
  EXPECT_THROW(traceTube(scan.image(), points, options), core::InvalidParameter);
}

namespace
{

/// An image of `tissue`, each voxel the mean of eight places in it, with noise.
volume::IntensityVolume imageOf(const core::GridGeometry& grid,
                                const std::function<double(const Vector3d&)>& tissue, double noise)
{
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid);
  std::mt19937 random(11);
  std::normal_distribution<double> gauss(0.0, noise);
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
      {
        double sum = 0.0;
        for (int part = 0; part < 8; ++part)
          sum += tissue(grid.patientFromVoxel(Vector3d(i + 0.5 * (part & 1) - 0.25,
                                                       j + 0.5 * (part >> 1 & 1) - 0.25,
                                                       k + 0.5 * (part >> 2) - 0.25)));
        voxels->at(i, j, k) = static_cast<std::int16_t>(std::lround(sum / 8.0 + gauss(random)));
      }
  return volume::IntensityVolume(std::shared_ptr<const volume::Volume<std::int16_t>>(voxels));
}

double unresolvedShare(const Tube& tube)
{
  double length = 0.0;
  for (const TubeStretch& stretch : unresolvedStretches(tube))
    length += stretch.to - stretch.from;
  return length / tube.length;
}

} // namespace

// Contrast alone does not make a tube: a plate of bone has as much.
TEST(TubeTrace, APlateIsNoTube)
{
  const auto grid = cube(0.4);
  const Vector3d middle = grid.origin() + Vector3d(13.0, 13.0, 13.0);
  const volume::IntensityVolume image = imageOf(
      grid, [&](const Vector3d& p) { return std::abs(p.y() - middle.y()) < 0.9 ? 1400.0 : 40.0; },
      30.0);
  std::vector<Vector3d> points;
  for (const double x : {-8.0, -4.0, 0.5, 4.0, 8.0})
    points.push_back(middle + Vector3d(x, 0.2, 0.1 * x));
  const Tube tube = traceTube(image, points);
  EXPECT_EQ(tube.resolvedLength, 0.0);
  EXPECT_NEAR(unresolvedShare(tube), 1.0, 1e-9);
}

// Four places that have nothing in common, in tissue whose texture is far above the noise.
TEST(TubeTrace, UnrelatedPlacesOfATextureAreNoNerve)
{
  const auto grid = cube(0.5);
  const auto texture = [](const Vector3d& p)
  {
    return 1100.0 +
           350.0 * (std::sin(1.9 * p.x() + 0.7 * p.y()) +
                    std::sin(1.7 * p.y() + 1.3 * p.z()) * std::sin(2.1 * p.z() - 0.9 * p.x()));
  };
  const volume::IntensityVolume image = imageOf(grid, texture, 10.0);
  TubeOptions options;
  options.widest = widestFor("facial_nerve");
  options.lumen = lumenFor("facial_nerve");
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto some = [&]
  {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    return Vector3d(x, y, z);
  };
  double resolved = 0.0, all = 0.0;
  for (int trial = 0; trial < 8; ++trial)
  {
    std::vector<Vector3d> points{grid.origin() + Vector3d(13.0, 13.0, 13.0) + 4.0 * some()};
    while (points.size() < 4)
    {
      const Vector3d next = points.back() + 5.0 * some();
      const Vector3d within = next - grid.origin();
      if ((next - points.back()).norm() > 3.0 && within.minCoeff() > 4.0 &&
          within.maxCoeff() < 22.0)
        points.push_back(next);
    }
    const Tube tube = traceTube(image, points, options);
    resolved += tube.resolvedLength;
    all += tube.length;
  }
  EXPECT_LT(resolved, 0.05 * all);
}

TEST(TubeTrace, AnAirCellIsNoNerve)
{
  const auto grid = cube(0.4);
  Scan scan{grid, bend(grid)};
  scan.inside = -900.0;
  const auto image = scan.image();
  const auto points = scan.clicks(5, 0.3);
  EXPECT_GT(traceTube(image, points).resolvedLength, 20.0) << "a tube it is";
  TubeOptions options;
  options.lumen = lumenFor("facial nerve");
  const Tube tube = traceTube(image, points, options);
  EXPECT_EQ(tube.resolvedLength, 0.0);
  const auto stretches = unresolvedStretches(tube);
  ASSERT_EQ(stretches.size(), 1U);
  EXPECT_EQ(stretches[0].doubt, TubeDoubt::Foreign);
  EXPECT_FALSE(lumenFor("sigmoid sinus"));
  EXPECT_TRUE(lumenFor("Nervus facialis"));
}

TEST(TubeTrace, SaysWhereACanalEnds)
{
  const auto grid = cube(0.4);
  const Scan scan{grid, bend(grid)};
  const auto line = scan.dense();
  const volume::IntensityVolume image = imageOf(
      grid,
      [&](const Vector3d& p)
      {
        double nearest = 1e9;
        for (std::size_t n = 0; n < 1300; n += 20) // of 2001: the first 65 %
          nearest = std::min(nearest, (p - line[n]).norm());
        return nearest < scan.radius ? 50.0 : 1200.0;
      },
      30.0);
  const Tube tube = traceTube(image, scan.clicks(6, 0.0));
  const auto stretches = unresolvedStretches(tube);
  ASSERT_FALSE(stretches.empty());
  EXPECT_NEAR(stretches.back().to, tube.length, 1e-9);
  const double end = stretches.back().from;
  std::size_t vertex = 0;
  double along = 0.0;
  while (along < end && vertex + 1 < tube.line.size())
  {
    along += (tube.line[vertex + 1] - tube.line[vertex]).norm();
    ++vertex;
  }
  EXPECT_LT((tube.line[vertex] - line[1300]).norm(), 1.6);
}

TEST(TubeTrace, ALongDetourIsDoubted)
{
  const auto grid = cube(0.4);
  const auto winding = [&grid](double t)
  {
    return Vector3d(grid.origin() +
                    Vector3d(4.0 + 18.0 * t, 13.0 + 3.0 * std::sin(5.0 * kPi * t), 13.0));
  };
  const Scan scan{grid, winding};
  const auto image = scan.image();
  EXPECT_LT(unresolvedShare(traceTube(image, scan.clicks(11, 0.1))), 0.02);
  const Tube tube = traceTube(image, scan.clicks(2, 0.0));
  ASSERT_GT(tube.length, 25.0) << "it follows the canal";
  const auto stretches = unresolvedStretches(tube);
  ASSERT_EQ(stretches.size(), 1U);
  EXPECT_EQ(stretches[0].doubt, TubeDoubt::Stray);
  EXPECT_EQ(tube.resolvedLength, 0.0);
}

TEST(TubeTrace, WhatIsWiderThanTheStructureCanBeDoesNotResolveIt)
{
  const auto grid = cube(0.4);
  const Scan scan{grid, bend(grid)};
  TubeOptions options;
  options.widest = 0.5; // the canal has 0.8
  const Tube tube = traceTube(scan.image(), scan.clicks(5, 0.3), options);
  EXPECT_LE(tube.largestRadius, 0.5);
  EXPECT_EQ(tube.resolvedLength, 0.0);
  EXPECT_EQ(widestFor("Chorda tympani left"), 0.5);
  EXPECT_EQ(widestFor("facial_nerve"), 1.3);
  EXPECT_EQ(widestFor("sigmoid sinus"), TubeOptions{}.widest);
}

TEST(TubeTrace, AGivenRadiusIsTakenAndLabelled)
{
  const auto grid = cube(0.4);
  const Scan scan{grid, bend(grid)};
  TubeOptions options;
  options.radius = 0.6;
  const Tube tube = traceTube(scan.image(), scan.clicks(5, 0.3), options);
  EXPECT_EQ(tube.smallestRadius, 0.6);
  EXPECT_EQ(tube.largestRadius, 0.6);
  const TubeLabel label = labelTube(tube, grid, {"nerve", 3, {}, 0});
  EXPECT_EQ(label.bridging, 0u);
  const volume::LabelMap& labels = label.map;
  const double volume = kPi * 0.36 * tube.length + 4.0 / 3.0 * kPi * 0.216;
  EXPECT_NEAR(labels.volume(labels.segments.front()), volume, 0.08 * volume);
}

// Thinner than the voxels, anywhere between them: a chain through faces that holds both ends, and
// no voxel away from the line.
TEST(TubeTrace, AThinTubeIsLabelledWithoutAGap)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto place = [&](const Vector3d& size) {
    return (Vector3d(uniform(random), uniform(random), uniform(random)).cwiseProduct(size)).eval();
  };
  std::size_t bridged = 0;
  for (const Vector3d& spacing : {Vector3d(1.0, 1.0, 1.0), Vector3d(0.3, 0.4, 1.2)})
    for (const double radius : {0.05, 0.2, 0.4, 0.6, 1.5})
      for (int trial = 0; trial < 6; ++trial)
      {
        const core::GridGeometry grid({40, 36, 30}, spacing, Vector3d(-3.0, 2.0, 5.0));
        const Vector3d size = grid.spacing().cwiseProduct(Vector3d(39, 35, 29));
        Tube tube;
        const Vector3d knots[] = {place(size), place(size), place(size)};
        for (int n = 0; n <= 200; ++n) // a parabola within the grid
        {
          const double t = n / 200.0;
          tube.line.push_back(grid.origin() + (1.0 - t) * (1.0 - t) * knots[0] +
                              2.0 * t * (1.0 - t) * knots[1] + t * t * knots[2]);
          tube.radii.push_back(radius);
        }
        const TubeLabel label = labelTube(tube, grid, {"nerve", 3, {}, 0});
        bridged += label.bridging > 0;
        const volume::Volume<std::uint16_t>& voxels = *label.map.voxels;
        const auto cellOf = [&](const Vector3d& p)
        {
          const Vector3d voxel = grid.voxelFromPatient(p);
          return core::Index3{static_cast<int>(std::lround(voxel[0])),
                              static_cast<int>(std::lround(voxel[1])),
                              static_cast<int>(std::lround(voxel[2]))};
        };
        std::set<core::Index3> all, reached;
        for (int k = 0; k < 30; ++k)
          for (int j = 0; j < 36; ++j)
            for (int i = 0; i < 40; ++i)
              if (voxels.at(i, j, k) == 3)
                all.insert({i, j, k});
        ASSERT_EQ(all.size(), label.map.segments.front().voxels);
        std::vector<core::Index3> open{cellOf(tube.line.front())};
        while (!open.empty())
        {
          const core::Index3 cell = open.back();
          open.pop_back();
          if (all.count(cell) == 0 || !reached.insert(cell).second)
            continue;
          for (std::size_t axis = 0; axis < 3; ++axis)
            for (const int side : {-1, 1})
            {
              core::Index3 beside = cell;
              beside[axis] += side;
              open.push_back(beside);
            }
        }
        ASSERT_EQ(reached.count(cellOf(tube.line.back())), 1u)
            << radius << " mm in voxels of " << spacing.transpose() << ", trial " << trial;
        for (const core::Index3& cell : all)
        {
          double nearest = 1e9;
          const Vector3d center = grid.patientFromVoxel(Vector3d(cell[0], cell[1], cell[2]));
          for (const Vector3d& p : tube.line)
            nearest = std::min(nearest, (p - center).norm());
          ASSERT_LE(nearest, radius + 0.5 * spacing.norm() + 0.3);
        }
        if (radius > spacing.norm())
        {
          EXPECT_EQ(label.bridging, 0u);
        }
      }
  EXPECT_GT(bridged, 20u);
}

TEST(TubeTrace, IsTheSameWhetherAPointWasMovedOrAllWereGiven)
{
  const auto grid = cube(0.4);
  const Scan scan{grid, bend(grid)};
  const auto image = scan.image();
  auto points = scan.clicks(5, 0.3);
  const Tube before = traceTube(image, points);
  points[2] += Vector3d(0.2, 0.1, 0.0);
  const Tube moved = traceTube(image, points, {}, {}, &before);
  const Tube anew = traceTube(image, points);
  ASSERT_EQ(moved.line.size(), anew.line.size());
  for (std::size_t n = 0; n < anew.line.size(); ++n)
    EXPECT_EQ(moved.line[n], anew.line[n]);
  EXPECT_EQ(insertionIndex(anew, scan.curve(0.5 * (0.03 + 0.265))), 1U);
}

TEST(TubeTrace, RefusesPointsThatMakeNoTube)
{
  const auto grid = cube(0.6);
  const Scan scan{grid, bend(grid)};
  const auto image = scan.image();
  const Vector3d a = scan.curve(0.1);
  const Vector3d b = scan.curve(0.4);
  const auto refuses = [&](const std::vector<Vector3d>& points)
  {
    try
    {
      traceTube(image, points);
      return std::string();
    }
    catch (const core::InvalidParameter& error)
    {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(refuses({a, b}), "");
  EXPECT_NE(refuses({}), "");
  EXPECT_NE(refuses({a}), "");
  EXPECT_NE(refuses({a, a}), "");
  EXPECT_NE(refuses({a, Vector3d(NAN, 0, 0)}), "");
  EXPECT_NE(refuses({a, a + Vector3d(500, 0, 0)}), "");
  EXPECT_NE(refuses({a, Vector3d(1e300, 0, 0)}), "");

  const volume::IntensityVolume flat(std::shared_ptr<const volume::Volume<std::int16_t>>(
      std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{7})));
  EXPECT_THROW(traceTube(flat, {a, b}), core::InvalidParameter);
  const volume::IntensityVolume padded(
      std::shared_ptr<const volume::Volume<std::int16_t>>(
          std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{-2000})),
      -2000.0);
  EXPECT_THROW(traceTube(padded, {a, b}), core::InvalidParameter);
  auto token = std::make_shared<core::CancelToken>();
  token->cancel();
  EXPECT_THROW(
      traceTube(image, {a, b}, {}, core::Progress([](double, const std::string&) {}, token)),
      core::CancelledError);
}
