#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "SimulatedPairs.h"
#include "petrous/Imaging/ImageFile.h"
#include "petrous/Registration/Register.h"

namespace petrous::registration
{
namespace
{

namespace fs = std::filesystem;
using Eigen::Vector3d;

struct PublishedPair
{
  std::shared_ptr<const volume::IntensityVolume> fixed, moving;
  core::RigidTransform truth;
  std::vector<Vector3d> targets;

  double worst(const core::RigidTransform& found) const
  {
    double most = 0.0;
    for (const Vector3d& p : targets)
      most = std::max(most, (found * p - truth * p).norm());
    return most;
  }
};

fs::path folderOf(const std::string& name)
{
  const char* data = std::getenv("PETROUS_DATA");
  return fs::path(data ? data : "/nowhere") / "registration" / name;
}

std::optional<PublishedPair> published(const std::string& name)
{
  const fs::path folder = folderOf(name);
  if (!fs::exists(folder / "truth.json"))
    return std::nullopt;
  PublishedPair pair;
  pair.fixed = imaging::readImageFile(folder / "fixed.nii.gz").volume;
  pair.moving = imaging::readImageFile(folder / "moving.nii.gz").volume;
  std::ifstream file(folder / "truth.json");
  const auto json = nlohmann::json::parse(file);
  Eigen::Matrix4d matrix;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      matrix(row, column) = json["T"][row][column];
  pair.truth =
      core::RigidTransform(Eigen::Quaterniond(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>())),
                           matrix.topRightCorner<3, 1>());
  for (const auto& p : json["targets"])
    pair.targets.emplace_back(p[0], p[1], p[2]);
  return pair;
}

// elastix 5.0.1 has an error of 0.09 mm at the targets of the first, 0.92 of the second (whose
// truth is accurate to about that), and ends 1.16 mm from the nominal truth of the third.
TEST(RegistrationData, RealHeadAgainstAnMrSimulatedFromIt)
{
  const auto pair = published("ct_mr_sim");
  if (!pair)
    GTEST_SKIP() << "no registration/ct_mr_sim in PETROUS_DATA";
  const Registration result = registerRigid(*pair->fixed, *pair->moving, {}, pair->targets[0]);
  EXPECT_EQ(result.verdict, Verdict::Good) << result.text;
  EXPECT_LT(pair->worst(result.fit.mrFromCt), 0.15);
  EXPECT_GT(result.error.p95, 0.05);
  EXPECT_LT(result.error.p95, 0.6);
}

// A ball around the ear is displaced in the MR, which the fit of the whole head does not follow:
// the stated error must cover the ear. The same pairs without the displacement are good.
TEST(RegistrationData, AnEarThatLiesElsewhereThanTheHeadIsTold)
{
  const auto pair = published("ct_mr_sim");
  if (!pair)
    GTEST_SKIP() << "no registration/ct_mr_sim in PETROUS_DATA";
  SimulationBody body;
  body.name = "real head";
  body.ct = pair->fixed;
  body.ears = {pair->targets[0]};
  body.contrasts = {{"T1", std::make_shared<const volume::Volume<float>>(
                               mrContrastOf(*pair->fixed, MrContrast::T1, 1))}};
  struct Ear
  {
    double radius;
    Vector3d shift;
  };
  for (const Ear& ear : {Ear{15.0, {0.0, 0.0, 0.0}}, Ear{16.0, {1.5, -1.4, 1.0}},
                         Ear{20.0, {-2.0, 1.5, 2.6}}, Ear{15.5, {0.5, 5.8, -1.0}}})
  {
    PairRecipe recipe = usualRecipe(body, 0, 71);
    recipe.acquisition.local =
        LocalShift{body.ears[0] + Vector3d(1.0, -2.0, 1.5), ear.radius, ear.shift, 2.0};
    const RegistrationPair simulated = simulatePair(body, 0, recipe);
    const Registration found = registerRigid(*simulated.ct, *simulated.mr, {}, body.ears[0]);
    const double error = errorOf(simulated, found.fit.mrFromCt).target;
    if (ear.shift.isZero())
    {
      EXPECT_EQ(found.verdict, Verdict::Good) << found.text;
      EXPECT_LT(error, found.error.p95);
      EXPECT_LT(found.error.p95, 0.8);
      EXPECT_GT(found.error.max, 1.2 * found.error.p95);
      continue;
    }
    EXPECT_GT(error, 0.7 * ear.shift.norm()) << "the head's fit does not follow the ear";
    EXPECT_EQ(found.verdict, Verdict::Doubtful) << found.text;
    EXPECT_NE(found.text.find("beside the rest"), std::string::npos) << found.text;
    EXPECT_LE(error, found.error.p95);
    EXPECT_LT(found.error.p95, error + 1.5);
  }
}

// The lower part of the CT and the upper part of the MR.
TEST(RegistrationData, DoesNotPushTogetherWhatSharesAPartOfItsHeight)
{
  const auto pair = published("ct_mr_sim");
  if (!pair)
    GTEST_SKIP() << "no registration/ct_mr_sim in PETROUS_DATA";
  const auto part = [](const volume::IntensityVolume& image, const char* name, bool upper)
  {
    core::PatientBox box = image.geometry().patientBounds();
    const double away = 0.48 * box.sizes().z();
    (upper ? box.min() : box.max()).z() += upper ? away : -away;
    return imaging::readImageFile(folderOf("ct_mr_sim") / name, box).volume;
  };
  const auto ct = part(*pair->fixed, "fixed.nii.gz", false);
  const auto mr = part(*pair->moving, "moving.nii.gz", true);
  const Fit fit = fitRigid(*ct, *mr);
  EXPECT_LT(pair->worst(fit.mrFromCt), 0.5);
  EXPECT_LT(fit.overlap, 0.35);
}

TEST(RegistrationData, TiltedScanAgainstAStraightOne)
{
  const auto pair = published("ct_ct_tilt-18.5");
  if (!pair)
    GTEST_SKIP() << "no registration/ct_ct_tilt-18.5 in PETROUS_DATA";
  EXPECT_LT(pair->worst(fitRigid(*pair->fixed, *pair->moving).mrFromCt), 1.1);
}

TEST(RegistrationData, AverageHeads)
{
  const auto pair = published("ct_mr_template");
  if (!pair)
    GTEST_SKIP() << "no registration/ct_mr_template in PETROUS_DATA";
  const Registration result = registerRigid(*pair->fixed, *pair->moving, {}, pair->targets[0]);
  EXPECT_LT(pair->worst(result.fit.mrFromCt), 1.5);
  // Two different symmetric averages: needs review by a person.
  EXPECT_EQ(result.verdict, Verdict::Doubtful) << result.text;
}

} // namespace
} // namespace petrous::registration
