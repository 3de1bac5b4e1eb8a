#include <cmath>

#include <gtest/gtest.h>

#include "petrous/Volume/IntensityVolume.h"

using namespace petrous;

namespace
{

const core::GridGeometry kGrid({2, 2, 1}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero());

template <class T>
volume::IntensityVolume image(std::array<T, 4> values, std::optional<double> padding = {})
{
  auto v = std::make_shared<volume::Volume<T>>(kGrid);
  std::copy(values.begin(), values.end(), v->data());
  return volume::IntensityVolume(std::shared_ptr<const volume::Volume<T>>(v), padding);
}

} // namespace

TEST(IntensityVolume, KeepsTheTypeOfItsFile)
{
  EXPECT_EQ(image<std::int16_t>({-1, 2, 3, 4}).bytes(), 8u);
  EXPECT_EQ(image<float>({-1, 2, 3, 4}).bytes(), 16u);
  EXPECT_DOUBLE_EQ(image<std::uint16_t>({0, 65535, 0, 0}).at(1, 0, 0), 65535.0);
}

TEST(IntensityVolume, RangeLeavesPaddingAndNanOut)
{
  const auto padded = image<std::int16_t>({-2000, -1000, 700, -2000}, -2000.0).range();
  EXPECT_DOUBLE_EQ(padded.min, -1000.0);
  EXPECT_DOUBLE_EQ(padded.max, 700.0);
  const auto holes = image<float>({NAN, 1.5F, -2.5F, INFINITY}).range();
  EXPECT_DOUBLE_EQ(holes.min, -2.5);
  EXPECT_DOUBLE_EQ(holes.max, 1.5);
  const auto nothing = image<float>({NAN, NAN, NAN, NAN}).range();
  EXPECT_DOUBLE_EQ(nothing.min, 0.0);
  EXPECT_DOUBLE_EQ(nothing.max, 0.0);
}

TEST(IntensityVolume, RefusesNoVoxels)
{
  EXPECT_THROW(volume::IntensityVolume(std::shared_ptr<const volume::Volume<float>>()),
               core::InvalidParameter);
}
