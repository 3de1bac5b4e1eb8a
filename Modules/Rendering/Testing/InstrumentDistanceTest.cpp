#include "InstrumentDistance.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "petrous/Core/CameraPose.h"
#include "petrous/Core/Error.h"

#include "PictureScenes.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

// Of a box about the z axis, from `lower` to `upper` on it.
double boxDistance(const Vector& at, double x, double y, double lower, double upper)
{
  const Vector beyond(std::abs(at.x()) - x, std::abs(at.y()) - y,
                      std::max(lower - at.z(), at.z() - upper));
  return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0);
}

Vector placeOf(const InstrumentDistance& field, int i, int j, int k)
{
  return field.lower + field.edge * Vector(i, j, k);
}

} // namespace

TEST(InstrumentDistance, IsThatOfABoxAtEverySample)
{
  const auto field = InstrumentDistance::of(*boxMesh({-1.0, -2.0, 0.0}, {1.0, 2.0, 30.0}));
  EXPECT_NEAR(field.edge, 0.25, 0.1);
  ASSERT_EQ(field.distances.size(), static_cast<std::size_t>(field.dims[0]) *
                                        static_cast<std::size_t>(field.dims[1]) *
                                        static_cast<std::size_t>(field.dims[2]));
  EXPECT_LE(field.lower.z(), -2.9);
  EXPECT_GE(field.upper().z(), 32.9);
  std::size_t n = 0;
  int inside = 0;
  for (int k = 0; k < field.dims[2]; ++k)
    for (int j = 0; j < field.dims[1]; ++j)
      for (int i = 0; i < field.dims[0]; ++i, ++n)
      {
        const double wanted = boxDistance(placeOf(field, i, j, k), 1.0, 2.0, 0.0, 30.0);
        inside += wanted < 0.0 ? 1 : 0;
        ASSERT_NEAR(static_cast<double>(field.distances[n]), wanted, 1e-4);
      }
  EXPECT_GT(inside, 1000);
}

TEST(InstrumentDistance, HoldsThePartNearTheTipAndNoMoreThanItsSamples)
{
  const auto field = InstrumentDistance::of(*boxMesh({-8.0, -8.0, 0.0}, {8.0, 8.0, 200.0}));
  EXPECT_LE(field.upper().z(), InstrumentDistance::kPart + field.edge);
  EXPECT_LE(static_cast<double>(field.distances.size()), 1.2 * InstrumentDistance::kMostSamples);
  EXPECT_GT(field.edge, InstrumentDistance::kFinest);
  EXPECT_TRUE(
      InstrumentDistance::of(*boxMesh({-1.0, -1.0, 90.0}, {1.0, 1.0, 95.0})).distances.empty());
  EXPECT_TRUE(InstrumentDistance::of({}).distances.empty());
}

TEST(InstrumentDistance, OfAnOpenSurfaceIsNowhereNegative)
{
  core::TriangleMesh open = *boxMesh({-1.0, -2.0, 0.0}, {1.0, 2.0, 10.0});
  open.triangles.pop_back();
  const auto field = InstrumentDistance::of(open);
  ASSERT_FALSE(field.distances.empty());
  EXPECT_GE(*std::min_element(field.distances.begin(), field.distances.end()), 0.0F);
}

TEST(InstrumentDistance, IsTheSameInTheBackground)
{
  const auto box = boxMesh({-1.0, -2.0, 0.0}, {1.0, 2.0, 30.0});
  const InstrumentMeasurement measurement(box);
  EXPECT_EQ(measurement.instrument(), box);
  const InstrumentDistance& measured = measurement.result();
  EXPECT_TRUE(measurement.isDone());
  const auto wanted = InstrumentDistance::of(*box);
  EXPECT_EQ(measured.dims, wanted.dims);
  EXPECT_EQ(measured.lower, wanted.lower);
  EXPECT_EQ(measured.edge, wanted.edge);
  EXPECT_EQ(measured.distances, wanted.distances);
}

TEST(InstrumentDistance, IsCancelled)
{
  const auto box = boxMesh({-1.0, -2.0, 0.0}, {1.0, 2.0, 30.0});
  const auto token = std::make_shared<core::CancelToken>();
  token->cancel();
  EXPECT_THROW(InstrumentDistance::of(*box, core::Progress(nullptr, token)), core::CancelledError);
}

TEST(InstrumentDistance, TellsEachTimeWhatFailedInTheBackground)
{
  auto broken = std::make_shared<core::TriangleMesh>(*boxMesh({-1.0, -1.0, 0.0}, {1.0, 1.0, 9.0}));
  broken->triangles.front()[0] = static_cast<std::uint32_t>(broken->vertices.size());
  const InstrumentMeasurement measurement(broken);
  EXPECT_THROW(measurement.result(), core::InvalidParameter);
  EXPECT_THROW(measurement.result(), core::InvalidParameter);
}
