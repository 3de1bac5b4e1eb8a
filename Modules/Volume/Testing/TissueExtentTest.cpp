#include <gtest/gtest.h>

#include "petrous/Volume/TissueExtent.h"

using namespace petrous;
using Eigen::Vector3d;

namespace
{

volume::IntensityVolume cubeWithSpeck(bool speck, std::int16_t bone)
{
  const core::GridGeometry grid({100, 100, 100}, Vector3d::Constant(0.5), Vector3d(10, 20, 30));
  auto v = std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{-1000});
  for (int k = 20; k <= 40; ++k)
    for (int j = 20; j <= 40; ++j)
      for (int i = 20; i <= 40; ++i)
        v->at(i, j, k) = bone;
  if (speck)
    v->at(98, 98, 98) = bone;
  return volume::IntensityVolume(std::shared_ptr<const volume::Volume<std::int16_t>>(v));
}

} // namespace

TEST(TissueExtent, FramesTheTissueAndNotASpeckFarOff)
{
  for (const bool speck : {false, true})
  {
    const auto extent = volume::tissueExtent(cubeWithSpeck(speck, 1000), 300);
    EXPECT_LT((extent.center - Vector3d(25, 35, 45)).norm(), 1.0);
    EXPECT_NEAR(extent.radius, 1.05 * std::sqrt(3.0) * 5.0, 1.0);
  }
}

TEST(TissueExtent, FramesTheWholeGridWhereThereIsNoTissue)
{
  const auto extent = volume::tissueExtent(cubeWithSpeck(false, 0), 300);
  EXPECT_LT((extent.center - Vector3d(34.75, 44.75, 54.75)).norm(), 1e-9);
}
