#include "petrous/Presenters/IntensityDisplay.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "petrous/Presenters/SlicePresenter.h"

using namespace petrous;
using namespace petrous::presenters;

namespace
{

// An image whose air is 0, bone `iso` and dense bone `dense`.
scene::Case caseOf(double iso, double dense, double least, double most)
{
  scene::Case value;
  value.iso = iso;
  value.denseBone = dense;
  value.ct.range = {least, most};
  return value;
}

// The darkest and the brightest value that a window distinguishes.
std::pair<double, double> ends(const GreyWindow& window)
{
  return {window.level - 0.5 * window.width, window.level + 0.5 * window.width};
}

} // namespace

TEST(IntensityDisplay, IsInHounsfieldUnitsWhereTheImageIsCalibrated)
{
  const IntensityDisplay display = displayOf(caseOf(300.0, 1800.0, -1024.0, 3071.0));
  EXPECT_TRUE(display.hounsfield);
  EXPECT_EQ(ends(display.bone), std::pair(-1300.0, 2700.0));
  EXPECT_EQ(ends(display.soft), std::pair(-160.0, 240.0));
  EXPECT_EQ(display.text(299.6), "300 HU");
  EXPECT_EQ(display.text(-0.2), "0 HU");
  EXPECT_EQ(display.least, -500.0);
  EXPECT_EQ(display.most, 2500.0);
  EXPECT_EQ(display.step, 1.0);
  // Another threshold does not change the grey window.
  const IntensityDisplay high = displayOf(caseOf(2800.0, 1800.0, -1024.0, 3071.0));
  EXPECT_EQ(ends(high.bone), std::pair(-1300.0, 2700.0));
  EXPECT_EQ(high.most, 2800.0);
}

TEST(IntensityDisplay, FollowsAConeBeamImageThatCountsFromZero)
{
  // 1 HU is 14 units: bone at 18,200, dense bone at 39,200, water at 14,000.
  const IntensityDisplay display = displayOf(caseOf(18200.0, 39200.0, 0.0, 56000.0));
  EXPECT_FALSE(display.hounsfield);
  EXPECT_NEAR(display.unit, 14.0, 1e-9);
  EXPECT_EQ(display.text(18200.0), "18200");
  EXPECT_NEAR(ends(display.bone).first, 0.0, 1e-6) << "-1300 HU would lie below the image";
  EXPECT_NEAR(ends(display.bone).second, 14.0 * 2700.0 + 14000.0, 1e-6);
  EXPECT_NEAR(ends(display.soft).first, 14.0 * -160.0 + 14000.0, 1e-6);
  EXPECT_NEAR(ends(display.soft).second, 14.0 * 240.0 + 14000.0, 1e-6);
  EXPECT_EQ(display.least, 0.0);
  EXPECT_EQ(display.most, 56000.0);
  EXPECT_EQ(display.step, 50.0);
}

TEST(IntensityDisplay, TellsSmallNumbersApart)
{
  // Attenuation per millimetre.
  const IntensityDisplay display = displayOf(caseOf(0.026, 0.056, 0.0, 0.08));
  EXPECT_EQ(display.text(0.026), "0.02600");
  EXPECT_NEAR(display.step, 5e-5, 1e-12);
  EXPECT_EQ(display.least, 0.0);
  EXPECT_EQ(display.most, 0.08);
  EXPECT_EQ(display.text(-1e-9), "0.00000");
}

TEST(IntensityDisplay, ShowsAnImageWhoseThresholdLiesAboveDenseBone)
{
  const IntensityDisplay display = displayOf(caseOf(50000.0, 39200.0, 0.0, 56000.0));
  EXPECT_NEAR(display.unit, 14.0, 1e-9);
  EXPECT_NEAR(ends(display.bone).first, 0.0, 1e-6);
  EXPECT_NEAR(ends(display.bone).second, 51800.0, 1e-6);
  // A constant image has no range.
  EXPECT_GT(displayOf(caseOf(7.0, 8.0, 7.0, 7.0)).bone.width, 0.0);
}

TEST(IntensityDisplay, SlicesOfSmallNumbersAreGrey)
{
  const core::GridGeometry grid({16, 16, 16}, {1.0, 1.0, 1.0}, {0.0, 0.0, 0.0});
  auto voxels = std::make_shared<volume::Volume<float>>(grid);
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 16; ++j)
      for (int i = 0; i < 16; ++i)
        voxels->at(i, j, k) = 0.08F * static_cast<float>(i) / 15.0F;
  scene::Case value = caseOf(0.026, 0.056, 0.0, 0.08);
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<float>>(std::move(voxels)));
  value.ct.geometry = grid;
  const auto slice = SliceGeometry::fitting(SliceOrientation::Axial, grid, {7.5, 7.5, 7.5}, 60, 60);
  const IntensityDisplay display = displayOf(value);
  const SlicePixels pixels = SlicePresenter(value).draw(slice, display.bone);
  const auto [black, white] = ends(display.bone);
  int told = 0;
  for (int column = 0; column < 60; ++column)
  {
    const double x = slice.patientFromPixel(column, 30).x();
    if (x < 0.1 || x > 14.9)
      continue;
    const double grey = 255.0 * std::clamp((0.08 * x / 15.0 - black) / (white - black), 0.0, 1.0);
    EXPECT_NEAR(pixels.at(column, 30)[0], grey, 1.0) << x;
    told += grey > 5.0 && grey < 250.0;
  }
  EXPECT_GT(told, 25);
}

TEST(IntensityDisplay, NamesTheValuesWhereMoreThanTheCtIsSeen)
{
  const auto image = [](std::int16_t first, double spacing)
  {
    scene::ImagePart part;
    part.geometry = core::GridGeometry({4, 4, 4}, Eigen::Vector3d::Constant(spacing), {0, 0, 0});
    auto voxels = std::make_shared<volume::Volume<std::int16_t>>(part.geometry);
    for (std::size_t n = 0; n < voxels->size(); ++n)
      voxels->data()[n] = static_cast<std::int16_t>(first + static_cast<int>(n));
    part.volume = std::make_shared<const volume::IntensityVolume>(
        std::shared_ptr<const volume::Volume<std::int16_t>>(voxels));
    part.range = {double(first), first + 2000.0};
    return part;
  };
  scene::Case value;
  value.ct = image(300, 1.0);
  value.mr = {image(400, 1.0)};
  value.mr[0].name = "T2";
  SliceOverlay overlay;
  overlay.mr = value.mr[0].volume.get();
  overlay.mrFromCt = core::RigidTransform(Eigen::Quaterniond::Identity(), {1.0, 0.0, 0.0});
  const Eigen::Vector3d at(2.0, 0.0, 0.0);
  EXPECT_EQ(shownValues(value, {}, nullptr, at), "302 HU");
  EXPECT_EQ(shownValues(value, {false, "T2"}, &overlay, at), "T2 403");
  EXPECT_EQ(shownValues(value, {true, "T2"}, &overlay, at), "CT 302 HU  T2 403");
  EXPECT_EQ(shownValues(value, {true, "T2"}, &overlay, {3.0, 0.0, 0.0}), "CT 303 HU  T2 –");
  EXPECT_EQ(shownValues(value, {}, nullptr, {9.0, 0.0, 0.0}), "");
  EXPECT_EQ(shownValues(value, {false, "gone"}, nullptr, at), "302 HU") << "the CT is seen then";
  value.ct.modality = scene::Modality::Mr;
  EXPECT_EQ(shownValues(value, {}, nullptr, at), "302");
  EXPECT_EQ(shownValues(value, {true, "T2"}, &overlay, at), "MR 302  T2 403");
  value.mr[0].range = {0.0, 1.0};
  EXPECT_EQ(displayOf(value.mr[0]).text(0.25), "0.250");
}

TEST(IntensityDisplay, SaysOfSoftTissueWhatIsEstimated)
{
  EXPECT_EQ(softTissueEstimate(caseOf(300.0, 1800.0, -1024.0, 3071.0)), "");
  // Metal: 1 HU seems to be 40 units, and -700 HU to lie below the image.
  scene::Case value = caseOf(18200.0, 78200.0, 0.0, 56000.0);
  EXPECT_EQ(softTissueScale(value).dense, 78200.0);
  EXPECT_NE(softTissueEstimate(value).find("not known where the values of air end"),
            std::string::npos);
  value.softTissueValues = {4200.0, 14560.0};
  EXPECT_NEAR(softTissueScale(value).iso, 18200.0, 1e-6);
  EXPECT_NEAR(softTissueScale(value).dense, 39200.0, 1e-6);
  EXPECT_EQ(softTissueEstimate(value), "Estimated from the image's histogram: air ends at 4200, "
                                       "and most of soft tissue is at 14560");
  value.softTissue.relative = false; // values of its own
  EXPECT_EQ(softTissueEstimate(value), "");
  value.softTissue.relative = true;
  value.ct.modality = scene::Modality::Mr;
  EXPECT_EQ(softTissueEstimate(value), "");
  // Of a manifest that was written by hand.
  value.ct.modality = scene::Modality::Ct;
  value.softTissueValues = {14560.0, 4200.0};
  EXPECT_EQ(softTissueScale(value).dense, 78200.0);
}
