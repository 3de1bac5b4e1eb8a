#include "petrous/Volume/IntensityScale.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

using namespace petrous;
using volume::IntensityHistogram;
using volume::IntensityScale;

namespace
{

using Random = std::mt19937;

struct Tissue
{
  double share;
  double low; // uniform from low to high, then blurred by noise
  double high;
};

// Typical CT of a head, in Hounsfield units: partial volume between the tissues, and bone from
// marrow to the otic capsule.
const std::vector<Tissue> kHead = {{0.42, -1000, -1000}, {0.03, -1000, 40}, {0.06, -110, -90},
                                   {0.33, 20, 60},       {0.06, 60, 700},   {0.07, 400, 1300},
                                   {0.03, 1300, 1900}};

std::vector<double> draw(const std::vector<Tissue>& tissues, double noise, Random& random)
{
  std::vector<double> values;
  for (const Tissue& tissue : tissues)
    for (int n = 0; n < static_cast<int>(200000 * tissue.share); ++n)
      values.push_back(std::uniform_real_distribution<double>(tissue.low, tissue.high)(random) +
                       std::normal_distribution<double>(0.0, noise)(random));
  return values;
}

template <class T>
IntensityScale scaleOf(const std::vector<double>& values, double gain = 1.0, double offset = 0.0,
                       double least = std::numeric_limits<T>::lowest(),
                       double most = std::numeric_limits<T>::max())
{
  const core::GridGeometry grid({static_cast<int>(values.size()), 1, 1}, Eigen::Vector3d::Ones(),
                                Eigen::Vector3d::Zero());
  auto v = std::make_shared<volume::Volume<T>>(grid);
  std::transform(values.begin(), values.end(), v->data(),
                 [&](double value)
                 {
                   const double scaled = std::clamp(gain * value + offset, least, most);
                   return static_cast<T>(std::is_integral_v<T> ? std::round(scaled) : scaled);
                 });
  return volume::suggestScale(
      IntensityHistogram(volume::IntensityVolume(std::shared_ptr<const volume::Volume<T>>(v))));
}

// A head with this share of air.
std::vector<Tissue> headWith(double air)
{
  const double rest = 1.0 - air;
  return {{air, -1000, -1000},      {air > 0.0 ? 0.03 : 0.0, -1000, 40},
          {0.06 * rest, -110, -90}, {0.61 * rest, 20, 60},
          {0.12 * rest, 60, 700},   {0.14 * rest, 400, 1300},
          {0.05 * rest, 1300, 1900}};
}

// A cone beam's values from 0 to 56,000, of which 14 are a HU and 0 is -1000 HU; `inverse`: of
// which air is the brightest.
IntensityScale coneBeam(const std::vector<Tissue>& tissues, double noise, Random& random,
                        bool inverse = false)
{
  std::vector<double> values = draw(tissues, noise, random);
  if (inverse)
    for (double& value : values)
      value = 1000.0 - value;
  return scaleOf<std::uint16_t>(values, 14.0, 14000.0, 0.0, 56000.0);
}

double hounsfieldOf(double value)
{
  return (value - 14000.0) / 14.0;
}

// Magnitude images of a head: air and cortical bone have no signal, so that their noise is Rayleigh
// distributed; muscle or brain lies at the patient's surface, the rest is fluid, fat and lesions.
struct MrHead
{
  const char* sequence;
  double noise;
  double emptyShare;
  Tissue tissue;
  std::vector<Tissue> rest;
};

std::vector<double> drawMagnitude(const std::vector<Tissue>& tissues, double noise, Random& random)
{
  std::vector<double> values = draw(tissues, noise, random);
  std::normal_distribution<double> imaginary(0.0, noise);
  for (double& value : values)
    value = std::hypot(value, imaginary(random));
  return values;
}

void expectHounsfield(const IntensityScale& scale)
{
  EXPECT_TRUE(scale.calibrated);
  EXPECT_EQ(scale.iso, 300.0);
  EXPECT_EQ(scale.dense, 1800.0);
}

} // namespace

TEST(IntensityScale, LeavesHounsfieldUnitsAsTheyAre)
{
  Random random(1);
  for (const double noise : {10.0, 40.0, 90.0})
    expectHounsfield(scaleOf<std::int16_t>(draw(kHead, noise, random), 1, 0, -1024, 3071));
  // A region inside the head, and a dry skull.
  expectHounsfield(
      scaleOf<std::int16_t>(draw({{0.1, -110, -90}, {0.5, 20, 60}, {0.4, 60, 1800}}, 20, random)));
  expectHounsfield(scaleOf<float>(draw({{0.8, -1000, -1000}, {0.2, -900, 1700}}, 20, random)));
  std::vector<double> lonely(2000, -1000.0);
  expectHounsfield(scaleOf<std::int16_t>(lonely));
  lonely.front() = 1200.0;
  expectHounsfield(scaleOf<std::int16_t>(lonely));
  expectHounsfield(scaleOf<float>(lonely));
}

// Parts of a head as they are cut out: of a petrous bone with and without its air cells, whose
// walls are blurred, and of soft tissue about bone as dense as the otic capsule, which is a peak.
TEST(IntensityScale, KnowsHounsfieldUnitsInAPartOfAHead)
{
  Random random(12);
  const std::vector<std::vector<Tissue>> parts = {
      {{0.01, -1000, -1000}, {0.20, -900, -840}, {0.35, 20, 60}, {0.44, 300, 1700}},
      {{0.02, -40, -20}, {0.70, 20, 60}, {0.08, 60, 1200}, {0.20, 1200, 1500}},
      {{0.002, -1000, -900}, {0.80, 20, 60}, {0.10, 600, 900}, {0.098, 1300, 1600}}};
  for (const std::vector<Tissue>& part : parts)
    for (const double noise : {8.0, 12.0})
      expectHounsfield(scaleOf<std::int16_t>(draw(part, noise, random), 1, 0, -1024, 3071));
}

TEST(IntensityScale, TakesNoPartInOtherUnitsForHounsfield)
{
  Random random(13);
  const std::vector<Tissue> withAir = {
      {0.10, -1000, -1000}, {0.04, -1000, 40}, {0.46, 20, 60}, {0.40, 300, 1700}};
  const std::vector<Tissue> without = {
      {0.02, -110, -90}, {0.78, 20, 60}, {0.05, 60, 1200}, {0.15, 1200, 1500}};
  struct Unit
  {
    double gain;
    double offset;
  };
  // Of scanners that begin at zero, or cone beams whose air or whose soft tissue is elsewhere.
  for (const auto& [gain, offset] :
       {Unit{1.0, 1000.0}, {1.0, 1024.0}, {0.5, 500.0}, {1.0, -300.0}, {0.7, -300.0}})
  {
    EXPECT_FALSE(scaleOf<std::int16_t>(draw(withAir, 15.0, random), gain, offset).calibrated)
        << gain << " " << offset;
    EXPECT_FALSE(scaleOf<std::int16_t>(draw(without, 15.0, random), gain, offset).calibrated)
        << gain << " " << offset;
  }
  // Soft tissue at 40, and air not at -1000.
  EXPECT_FALSE(scaleOf<std::int16_t>(draw(withAir, 15.0, random), 0.7, 12.0).calibrated);
}

TEST(IntensityScale, FindsTheBoneOfAHeadUnderAnyGainAndOffset)
{
  Random random(2);
  for (int n = 0; n < 40; ++n)
  {
    const double noise = std::uniform_real_distribution<double>(10.0, 70.0)(random);
    const double gain = std::exp(std::uniform_real_distribution<double>(-7.0, 3.0)(random));
    const double offset = gain * std::uniform_real_distribution<double>(1300.0, 9000.0)(random);
    const auto values = draw(kHead, noise, random);
    const auto check = [&](const IntensityScale& scale, double g, double o)
    {
      EXPECT_FALSE(scale.calibrated);
      // 3 % of the range from air to dense bone.
      EXPECT_NEAR((scale.iso - o) / g, 300.0, 0.03 * 2800.0) << n << ' ' << g << ' ' << o;
      EXPECT_NEAR((scale.dense - o) / g, 1800.0, 0.1 * 2800.0);
    };
    check(scaleOf<float>(values, gain, offset), gain, offset);
    const double wide = std::uniform_real_distribution<double>(0.05, 10.0)(random);
    check(scaleOf<std::uint16_t>(values, wide, 1400.0 * wide), wide, 1400.0 * wide);
  }
}

TEST(IntensityScale, TakesNoFrameAroundTheScannedFieldForAir)
{
  Random random(3);
  auto values = draw(kHead, 40.0, random);
  values.insert(values.end(), 60000, -3000.0);
  const auto scale = scaleOf<std::uint16_t>(values, 2.0, 6000.0);
  EXPECT_NEAR((scale.iso - 6000.0) / 2.0, 300.0, 0.03 * 2800.0);
}

TEST(IntensityScale, KeepsSoftTissueOutWhereAirIsCutOff)
{
  Random random(4);
  // 8 bits from -400 to 2200 HU: the value of air is unknown.
  const double gain = 255.0 / 2600.0;
  const auto scale = scaleOf<std::uint16_t>(draw(kHead, 30, random), gain, 400 * gain, 0, 255);
  EXPECT_FALSE(scale.calibrated);
  EXPECT_GT(scale.iso / gain - 400.0, 130.0); // above soft tissue by three times the noise
  EXPECT_LT(scale.iso / gain - 400.0, 600.0);
}

TEST(IntensityScale, HalvesTheWayBetweenAirAndBoneOfADrySpecimen)
{
  Random random(5);
  for (const double bone : {0.1, 0.3, 0.7})
    for (const double noise : {3.0, 12.0})
    {
      const auto values =
          draw({{0.95 - bone, 30, 30}, {0.05, 30, 180}, {bone, 175, 185}}, noise, random);
      EXPECT_NEAR(scaleOf<std::uint16_t>(values, 1, 0, 0, 255).iso, 105.0, 0.05 * 150.0);
      EXPECT_NEAR(scaleOf<std::uint16_t>(values, 200, 5000).iso, 26000.0, 0.05 * 30000.0);
      EXPECT_NEAR(scaleOf<float>(values, 1e-3, 0.2).iso, 0.305, 0.05 * 0.15);
    }
  std::vector<double> drawn(10000, 8000.0); // without noise and partial volume
  std::fill_n(drawn.begin(), 1500, 42000.0);
  EXPECT_NEAR(scaleOf<std::uint16_t>(drawn).iso, 25000.0, 0.03 * 34000.0);
}

TEST(IntensityScale, PartsFluidFromBoneInMicroCt)
{
  Random random(6);
  // Peaks of an 8-bit scan in formalin; with air in the cells, and without.
  for (const double air : {0.3, 0.0})
    for (const double noise : {4.0, 9.0})
    {
      const auto values = draw(
          {{air, 20, 20}, {0.6 - air, 62, 62}, {0.05, 62, 190}, {0.35, 180, 200}}, noise, random);
      const auto scale = scaleOf<std::uint16_t>(values, 1, 0, 0, 255);
      EXPECT_GT(scale.iso, 62.0 + 2.0 * noise);
      EXPECT_LT(scale.iso, 190.0 - 4.0 * noise);
      EXPECT_NEAR(scale.dense, 205.0, 25.0);
    }
}

TEST(IntensityScale, FindsWhereAirEndsInAConeBeam)
{
  Random random(21);
  for (const double noise : {10.0, 40.0, 70.0, 120.0})
    for (const double air : {0.42, 0.2, 0.1, 0.05})
    {
      const IntensityScale scale = coneBeam(headWith(air), noise, random);
      ASSERT_TRUE(scale.soft) << air << ' ' << noise;
      const double foot = hounsfieldOf(scale.soft->foot);
      EXPECT_GT(foot, std::max(-715.0, -1000.0 + 2.3 * noise)) << air << ' ' << noise;
      EXPECT_LT(foot, -600.0) << air << ' ' << noise;
      EXPECT_NEAR(hounsfieldOf(scale.soft->peak), 40.0, 30.0) << air << ' ' << noise;
    }
  // Noise of air reaches beyond -700 HU.
  const IntensityScale noisy = coneBeam(headWith(0.42), 180.0, random);
  ASSERT_TRUE(noisy.soft);
  EXPECT_GT(hounsfieldOf(noisy.soft->foot), -1000.0 + 2.3 * 180.0);
  EXPECT_LT(hounsfieldOf(noisy.soft->foot), -400.0);
  // Metal moves dense bone, and neither air nor soft tissue.
  auto metal = headWith(0.42);
  metal.push_back({0.01, 2950.0, 3050.0});
  const IntensityScale shining = coneBeam(metal, 40.0, random);
  ASSERT_TRUE(shining.soft);
  EXPECT_GT(hounsfieldOf(shining.dense), 2500.0);
  EXPECT_NEAR(hounsfieldOf(shining.soft->foot), -700.0, 20.0);
}

TEST(IntensityScale, InventsNoEndOfAir)
{
  Random random(22);
  const std::vector<Tissue> boneApart = {
      {0.5, 20, 60}, {0.1, 60, 900}, {0.3, 900, 1100}, {0.1, 1300, 1900}};
  const std::vector<Tissue> narrow = {
      {0.42, -1000, -1000}, {0.03, -1000, 40}, {0.35, 20, 60}, {0.2, 1000, 1600}};
  const std::vector<Tissue> muchFat = {{0.3, -110, -90}, {0.4, 20, 60}, {0.3, 60, 1800}};
  auto metal = headWith(0.0);
  metal.push_back({0.015, 2990.0, 3010.0});
  for (const double noise : {10.0, 40.0, 70.0, 120.0})
  {
    EXPECT_FALSE(coneBeam(headWith(0.0), noise, random).soft) << "cropped, " << noise;
    EXPECT_FALSE(coneBeam(muchFat, noise, random).soft) << "fat and muscle, " << noise;
    EXPECT_FALSE(coneBeam(boneApart, noise, random).soft) << "muscle and bone, " << noise;
    EXPECT_FALSE(coneBeam(metal, noise, random).soft) << "metal and no air, " << noise;
    EXPECT_FALSE(coneBeam(headWith(0.42), noise, random, true).soft) << "inverse, " << noise;
    EXPECT_FALSE(coneBeam(narrow, noise, random, true).soft) << "inverse, bone apart, " << noise;
    // 8 bits from -400 HU: what is darkest is not air.
    const double gain = 255.0 / 2600.0;
    EXPECT_FALSE(scaleOf<std::uint16_t>(draw(kHead, noise, random), gain, 400 * gain, 0, 255).soft);
  }
  EXPECT_FALSE(scaleOf<std::int16_t>(draw(kHead, 40.0, random), 1, 0, -1024, 3071).soft)
      << "Hounsfield units";
}

TEST(IntensityScale, GoesThroughAirsEndAndSoftTissue)
{
  // 14 units are a HU, and water is 14,000.
  const IntensityScale scale = volume::scaleThrough({14.0 * -700.0 + 14000.0, 14560.0});
  EXPECT_FALSE(scale.calibrated);
  EXPECT_NEAR(scale.iso, 18200.0, 1e-6);
  EXPECT_NEAR(scale.dense, 39200.0, 1e-6);
}

TEST(IntensityScale, StaysSaneWhereThereIsNoBone)
{
  Random random(7);
  for (const double mean : {-5000.0, 0.0, 1e-6, 30000.0})
  {
    const auto values = draw({{1.0, mean, mean}}, 0.1 * std::abs(mean) + 1e-9, random);
    const auto scale = scaleOf<float>(values);
    EXPECT_TRUE(scale.iso > *std::min_element(values.begin(), values.end()) - 1e-3);
    EXPECT_TRUE(scale.iso < *std::max_element(values.begin(), values.end()) + 1e-3 ||
                scale.calibrated);
    EXPECT_GT(scale.dense, scale.iso);
    EXPECT_TRUE(std::isfinite(scale.dense));
  }
  for (const double value : {0.0, 7.0, 3000.0, -3e38, 3e38})
  {
    const auto scale = scaleOf<float>(std::vector<double>(50, value));
    EXPECT_NEAR(scale.iso, value, 1e-6 * std::abs(value));
    EXPECT_GT(scale.dense, scale.iso);
    EXPECT_TRUE(std::isfinite(scale.dense));
  }
  expectHounsfield(scaleOf<float>({std::nan(""), std::nan("")}));
}

TEST(IntensityScale, PartsThePatientFromAirInAnyMrContrast)
{
  // In scanner units, with the order of signals that each sequence gives.
  const std::vector<MrHead> heads = {
      {"T1, bright fat", 8, 0.55, {0.25, 170, 260}, {{0.10, 60, 90}, {0.10, 500, 700}}},
      {"T1 with contrast agent", 8, 0.60, {0.33, 170, 260}, {{0.05, 60, 90}, {0.02, 900, 1300}}},
      {"T2", 10, 0.50, {0.35, 120, 220}, {{0.05, 300, 420}, {0.10, 650, 900}}},
      {"FIESTA, bright fluid", 12, 0.60, {0.33, 130, 220}, {{0.07, 800, 1100}}},
      {"FIESTA of a region, little air", 12, 0.22, {0.68, 130, 220}, {{0.10, 800, 1100}}},
      {"DWI, bright cholesteatoma", 15, 0.70, {0.297, 110, 190}, {{0.003, 500, 700}}},
      {"proton density", 6, 0.45, {0.55, 280, 420}, {}},
      {"FLAIR, dark fluid", 8, 0.55, {0.36, 180, 300}, {{0.04, 20, 50}, {0.05, 350, 450}}},
  };
  Random random(11);
  for (const MrHead& head : heads)
    for (const double gain : {0.02, 1.0, 30.0})
    {
      const auto empty = drawMagnitude({{head.emptyShare, 0, 0}}, head.noise, random);
      const auto tissue = drawMagnitude({head.tissue}, head.noise, random);
      const auto rest = drawMagnitude(head.rest, head.noise, random);
      std::vector<float> values;
      for (const auto* part : {&empty, &tissue, &rest})
        for (const double value : *part)
          values.push_back(static_cast<float>(gain * value));
      const core::GridGeometry grid({static_cast<int>(values.size()), 1, 1},
                                    Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero());
      auto v = std::make_shared<volume::Volume<float>>(grid);
      std::copy(values.begin(), values.end(), v->data());
      const IntensityScale scale = volume::suggestMrScale(IntensityHistogram(
          volume::IntensityVolume(std::shared_ptr<const volume::Volume<float>>(v))));
      const auto above = [&](const std::vector<double>& part)
      {
        return static_cast<double>(std::count_if(part.begin(), part.end(),
                                                 [&](double value)
                                                 { return gain * value >= scale.iso; })) /
               static_cast<double>(part.size());
      };
      EXPECT_FALSE(scale.calibrated);
      EXPECT_LT(above(empty), 0.002) << head.sequence << ", gain " << gain << ", iso " << scale.iso;
      EXPECT_GT(above(tissue), 0.98) << head.sequence << ", gain " << gain << ", iso " << scale.iso;
      // A blurred edge is where it was at half of the signal beside it.
      const double signal = gain * 0.5 * (head.tissue.low + head.tissue.high);
      EXPECT_NEAR(scale.iso, 0.5 * signal, 0.2 * signal) << head.sequence << ", gain " << gain;
      EXPECT_GT(scale.dense, scale.iso) << head.sequence;
    }
}

// Few very bright voxels take two of Otsu's three classes, and muscle is in that of air.
TEST(MrScale, BeginsBelowTheDarkestTissueWhateverIsBright)
{
  Random random(5);
  for (const double gain : {0.02, 1.0, 30.0})
  {
    const double noise = 12.0;
    const auto empty = drawMagnitude({{0.5, 0, 0}}, noise, random);
    const auto muscle = drawMagnitude({{0.35, 150, 190}}, noise, random);
    const auto bright = drawMagnitude({{0.08, 700, 900}, {0.07, 1500, 1700}}, noise, random);
    std::vector<float> values;
    for (const auto* part : {&empty, &muscle, &bright})
      for (const double value : *part)
        values.push_back(static_cast<float>(gain * value));
    const core::GridGeometry grid({static_cast<int>(values.size()), 1, 1}, Eigen::Vector3d::Ones(),
                                  Eigen::Vector3d::Zero());
    auto v = std::make_shared<volume::Volume<float>>(grid);
    std::copy(values.begin(), values.end(), v->data());
    const IntensityHistogram histogram{
        volume::IntensityVolume(std::shared_ptr<const volume::Volume<float>>(v))};
    const auto above = [gain](const std::vector<double>& part, double limit)
    {
      return static_cast<double>(std::count_if(
                 part.begin(), part.end(), [&](double value) { return gain * value >= limit; })) /
             static_cast<double>(part.size());
    };
    for (const double limit :
         {volume::mrNoiseCeiling(histogram), volume::suggestMrScale(histogram).iso})
    {
      EXPECT_LT(above(empty, limit), 0.005) << "gain " << gain << ", from " << limit;
      EXPECT_GT(above(muscle, limit), 0.98) << "gain " << gain << ", from " << limit;
    }
  }
}
