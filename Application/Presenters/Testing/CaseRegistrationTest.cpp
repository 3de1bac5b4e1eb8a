#include "petrous/Presenters/CaseRegistration.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>

#include "petrous/Phantom/Phantom.h"
#include "petrous/Scene/ApplyRegistration.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;
using From = RegistrationRequest::From;

namespace
{

core::GridGeometry around(const Vector3d& center, int count, double spacing)
{
  return {{count, count, count},
          Vector3d::Constant(spacing),
          center - Vector3d::Constant(0.5 * spacing * (count - 1))};
}

core::RigidTransform turned(double degrees, const Vector3d& shift)
{
  const double half = 0.5 * degrees * 3.14159265358979323846 / 180.0;
  return {Eigen::Quaterniond(std::cos(half), 0.6 * std::sin(half), 0.0, 0.8 * std::sin(half)),
          shift};
}

// A CT of the phantom, its T2, and a second MR in the T2's frame of reference, aligned with it up
// to `moved`.
class CaseRegistration : public ::testing::Test
{
protected:
  static scene::ImagePart scan(const std::string& name, const core::RigidTransform& mrFromCt,
                               double spacing, phantom::Phantom::Modality modality)
  {
    phantom::ScanSettings settings;
    settings.modality = modality;
    settings.noise = 10.0;
    settings.seed = name.size();
    settings.patientFromScan = mrFromCt.inverse();
    const auto grid = around(mrFromCt * phantom::Phantom::center(),
                             static_cast<int>(std::lround(56.0 / spacing)), spacing);
    scene::ImagePart part;
    part.name = name;
    part.geometry = grid;
    part.volume = std::make_shared<const volume::IntensityVolume>(
        std::make_shared<const volume::Volume<std::int16_t>>(
            phantom::samplePhantom(phantom::Phantom(), grid, settings)));
    part.range = part.volume.get()->range();
    return part;
  }

  static scene::Case makeCase(const core::RigidTransform& moved)
  {
    scene::Case value;
    value.name = "ear";
    value.ct = scan("ct", {}, 0.7, phantom::Phantom::Modality::Ct);
    value.mr.push_back(scan("T2", motion(), 0.8, phantom::Phantom::Modality::Mr));
    value.mr.push_back(scan("DWI", moved * motion(), 1.4, phantom::Phantom::Modality::Mr));
    value.mr[0].frameOfReference = value.mr[1].frameOfReference = std::string(64, 'f');
    return value;
  }

  static core::RigidTransform motion() { return phantom::Phantom().mrFromCt(); }

  static double off(const core::RigidTransform& found, const core::RigidTransform& truth)
  {
    const Vector3d center = phantom::Phantom::center();
    return (found * center - truth * center).norm();
  }

  static scene::Registration known()
  {
    scene::Registration how;
    how.verdict = scene::Registration::Verdict::Good;
    how.error = scene::RegistrationError{phantom::Phantom::center(), "the ear", 0.1, 0.3, 0.4};
    return how;
  }

  static void addStructure(scene::Case& value, const std::string& name, const core::Index3& voxel)
  {
    auto voxels =
        std::make_shared<volume::Volume<std::uint16_t>>(value.ct.geometry, std::uint16_t{0});
    voxels->at(voxel[0], voxel[1], voxel[2]) = 1;
    scene::LabelPart part;
    part.labels = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(voxels, {}));
    part.drawnOn = "";
    scene::StructurePart structure;
    structure.name = name;
    structure.index = 1;
    part.structures = {structure};
    value.labels.push_back(part);
  }
};

} // namespace

TEST_F(CaseRegistration, StatesItsErrorAtTheMiddleEar)
{
  scene::Case value = makeCase({});
  RegistrationRequest request;
  request.mr = "T2";
  request.from = From::Given;
  request.given = motion();
  RegistrationPlace place = defaultPlace(value, request);
  EXPECT_EQ(place.words, "the centre of what both images show");
  EXPECT_LT((place.point - phantom::Phantom::center()).norm(), 1.0);
  request.region = {phantom::Phantom::center(), phantom::Phantom::center() + Vector3d::Constant(9)};
  place = defaultPlace(value, request);
  EXPECT_LT((place.point - phantom::Phantom::center() - Vector3d::Constant(4.5)).norm(), 1e-6);
  request.given = {Eigen::Quaterniond::Identity(), Vector3d::Constant(900)};
  EXPECT_EQ(defaultPlace(value, request).words, "the centre of the CT");

  addStructure(value, "sigmoid sinus", {3, 3, 3});
  EXPECT_EQ(defaultPlace(value, request).words, "the centre of the CT") << "is no ear";
  EXPECT_TRUE(earNames(value).empty());
  addStructure(value, "lateral semicircular canal", {4, 3, 3});
  EXPECT_EQ(defaultPlace(value, request).words, "the middle of 'lateral semicircular canal'");
  addStructure(value, "Cochlea", {5, 3, 3});
  EXPECT_EQ(defaultPlace(value, request).words, "the middle of 'Cochlea'");
  addStructure(value, "tympanic_cavity", {6, 3, 3});
  EXPECT_EQ(defaultPlace(value, request).words, "the middle of 'tympanic_cavity'");
  addStructure(value, "incus", {7, 8, 9});
  place = defaultPlace(value, request);
  EXPECT_EQ(place.words, "the middle of 'incus'");
  EXPECT_LT((place.point - value.ct.geometry.patientFromVoxel({7.0, 8.0, 9.0})).norm(), 1e-9);

  value.labels.back().drawnOn = "T2"; // which is not placed yet
  EXPECT_EQ(defaultPlace(value, request).words, "the middle of 'tympanic_cavity'");
  EXPECT_EQ(earNames(value),
            (std::vector<std::string>{"tympanic_cavity", "Cochlea", "lateral semicircular canal"}));
  EXPECT_THROW(placeOf(value, "incus"), core::InvalidParameter);
  EXPECT_THROW(placeOf(value, "zebra"), core::InvalidParameter);
}

// The first may be turned about the x axis 100 mm from the point: 1 mm there along z, and of a
// normal distribution half lie within 0.674 deviations, 95 % within 1.960, 99.9 % within 3.291.
TEST(ChainedError, IsOfTheFirstWhereTheSecondIs)
{
  const Vector3d ear(1.0, 2.0, 3.0);
  scene::RegistrationError first{ear + Vector3d(0.0, 100.0, 0.0), "the vertex", 0.01, 0.02, 0.03};
  const scene::RegistrationError second{ear, "the ear", 0.1, 0.3, 0.4};
  const scene::RegistrationError as = chained(second, first, {});
  EXPECT_NEAR(as.p95, std::hypot(0.3, 0.02), 1e-12) << "no more is known";
  first.spread = core::RigidSpread{first.point};
  first.spread->moments(3, 3) = 0.01 * 0.01;
  scene::RegistrationError both = chained(second, first, {});
  EXPECT_FALSE(both.spread);
  EXPECT_EQ(both.point, ear);
  EXPECT_EQ(both.place, "the ear");
  EXPECT_NEAR(both.median, std::hypot(0.1, 0.674), 0.02);
  EXPECT_NEAR(both.p95, std::hypot(0.3, 1.960), 0.03);
  EXPECT_NEAR(both.max, 0.4 + 3.291, 0.07);
  // The same as of a second with a spread that is zero.
  scene::RegistrationError still{ear, "the ear", 0.0, 0.0, 0.0};
  both = chained(still, first, {});
  still.spread = core::RigidSpread{ear};
  EXPECT_NEAR(both.p95, chained(still, first, {}).p95, 1e-9);
  EXPECT_NEAR(both.median, chained(still, first, {}).median, 1e-9);
}

// The T2 is held 100 mm from the ear and may be turned about the x axis there: 1.96 deviations of
// 100 mm x 0.01 rad at the ear, not the 0.3 mm of the place where it was estimated.
TEST_F(CaseRegistration, AddsTheErrorOfBothWaysAtTheEar)
{
  scene::Case value = makeCase({});
  scene::Registration first = known();
  first.error->point += Vector3d(0.0, 100.0, 0.0);
  first.error->spread = core::RigidSpread{first.error->point};
  first.error->spread->moments(3, 3) = 0.01 * 0.01;
  scene::applyRegistration(value, "T2", motion(), first);
  RegistrationRequest request;
  request.mr = "DWI";
  request.onto = "T2";
  request.at = RegistrationPlace{phantom::Phantom::center(), "the ear"};
  const RegistrationOutcome outcome = registerMr(value, request);
  ASSERT_FALSE(outcome.failed) << outcome.how.text;
  ASSERT_TRUE(outcome.how.error);
  const scene::RegistrationError& error = *outcome.how.error;
  ASSERT_TRUE(error.spread);
  EXPECT_EQ(error.spread->about, phantom::Phantom::center());
  EXPECT_GT(error.p95, 1.9);
  EXPECT_LT(error.p95, 2.6);
  EXPECT_GT(error.max, 3.2);
  EXPECT_GE(error.spread->moments(2, 2), 0.999) << "turned about x, the ear rises";
  EXPECT_LT(error.spread->moments(1, 1), 0.3);
}

TEST_F(CaseRegistration, GoesToTheCtThroughAnotherMr)
{
  const core::RigidTransform moved = turned(0.3, {0.3, -0.2, 0.25});
  scene::Case value = makeCase(moved);
  RegistrationRequest request;
  request.mr = "DWI";
  request.onto = "T2";
  request.at = RegistrationPlace{phantom::Phantom::center(), "the ear"};
  try
  {
    registerMr(value, request);
    FAIL() << "T2 is nowhere";
  }
  catch (const core::InvalidParameter& error)
  {
    EXPECT_NE(std::string(error.what()).find("register it first"), std::string::npos);
  }
  scene::applyRegistration(value, "T2", motion(), known());
  int heard = 0;
  const RegistrationOutcome outcome =
      registerMr(value, request, {},
                 [&heard](const registration::MetricSample&, const core::RigidTransform& best)
                 {
                   ++heard;
                   EXPECT_LT(off(best, motion()), 20.0) << "poses are those from the CT";
                 });
  ASSERT_FALSE(outcome.failed) << outcome.how.text;
  EXPECT_GT(heard, 0);
  EXPECT_LT(off(outcome.mrFromCt, moved * motion()), 0.4);
  EXPECT_EQ(outcome.how.method, scene::Registration::Method::FrameOfReference);
  EXPECT_TRUE(outcome.how.refined);
  EXPECT_EQ(outcome.how.through, "T2");
  ASSERT_TRUE(outcome.how.error);
  EXPECT_GE(outcome.how.error->p95, 0.3) << "both ways together";
  EXPECT_FALSE(outcome.how.error->spread) << "the T2's is not known";
  EXPECT_EQ(outcome.how.error->place, "the ear");
  EXPECT_NE(outcome.how.text.find("from where the common frame of reference puts it"),
            std::string::npos)
      << outcome.how.text;
  EXPECT_FALSE(value.mr[1].registered) << "the case stays as it is";
  accept(value, "DWI", outcome);
  EXPECT_TRUE(value.mr[1].registered);

  value.mr[0].registration->error.reset();
  request.asIs = true;
  const RegistrationOutcome asIs = registerMr(value, request);
  EXPECT_LT(off(asIs.mrFromCt, motion()), 1e-9) << "as the scanner says";
  EXPECT_FALSE(asIs.how.refined);
  EXPECT_FALSE(asIs.how.error);
}

TEST_F(CaseRegistration, SaysWhereTheFrameOfReferenceIsContradicted)
{
  const core::RigidTransform moved = turned(1.0, {5.0, 1.0, -2.0});
  scene::Case value = makeCase(moved);
  scene::applyRegistration(value, "T2", motion(), known());
  RegistrationRequest request;
  request.mr = "DWI";
  request.onto = "T2";
  request.at = RegistrationPlace{phantom::Phantom::center(), "the ear"};
  const RegistrationOutcome outcome = registerMr(value, request);
  ASSERT_FALSE(outcome.failed) << outcome.how.text;
  EXPECT_LT(off(outcome.mrFromCt, moved * motion()), 0.5);
  EXPECT_EQ(outcome.how.verdict, scene::Registration::Verdict::Doubtful);
  EXPECT_NE(outcome.how.text.find("the patient moved between the two images"), std::string::npos)
      << outcome.how.text;
}

TEST_F(CaseRegistration, LaysWhereLandmarksPutItAndGoesFromThere)
{
  scene::Case value = makeCase({});
  RegistrationRequest request;
  request.mr = "T2";
  request.from = From::Landmarks;
  const core::RigidTransform shaken = turned(1.0, {0.8, -0.5, 0.4}) * motion();
  for (const Vector3d& step :
       {Vector3d(12, 0, 0), Vector3d(0, 10, 0), Vector3d(0, 0, 11), Vector3d(-9, -3, 2)})
    request.landmarks.push_back(
        {phantom::Phantom::center() + step, shaken * (phantom::Phantom::center() + step)});
  request.asIs = true;
  RegistrationOutcome outcome = registerMr(value, request);
  EXPECT_LT(off(outcome.mrFromCt, shaken), 1e-9);
  EXPECT_EQ(outcome.how.verdict, scene::Registration::Verdict::Doubtful);
  EXPECT_FALSE(outcome.how.error);
  EXPECT_TRUE(outcome.how.metric);
  EXPECT_NE(outcome.how.text.find("The 4 landmarks agree to 0.00 mm"), std::string::npos)
      << outcome.how.text;

  request.asIs = false;
  outcome = registerMr(value, request);
  ASSERT_FALSE(outcome.failed) << outcome.how.text;
  EXPECT_LT(off(outcome.mrFromCt, motion()), 0.3);
  EXPECT_TRUE(outcome.how.refined);
  EXPECT_EQ(outcome.how.method, scene::Registration::Method::Landmarks);
  EXPECT_NE(outcome.how.text.find("from where the landmarks put it"), std::string::npos);

  request.landmarks.resize(2);
  EXPECT_THROW(registerMr(value, request), core::InvalidParameter);
}

TEST_F(CaseRegistration, AFailureLeavesTheCase)
{
  scene::Case value = makeCase({});
  const auto& grid = value.mr[0].geometry;
  value.mr[0].volume = std::make_shared<const volume::IntensityVolume>(
      std::make_shared<const volume::Volume<float>>(grid, std::numeric_limits<float>::quiet_NaN()));
  RegistrationRequest request;
  request.mr = "T2";
  const RegistrationOutcome outcome = registerMr(value, request);
  EXPECT_TRUE(outcome.failed);
  EXPECT_NE(outcome.how.text, "");
  accept(value, "T2", outcome);
  EXPECT_FALSE(value.mr[0].registered);

  request.from = From::Given; // manual registration still works
  request.given = motion();
  request.asIs = true;
  const RegistrationOutcome manual = registerMr(value, request);
  EXPECT_FALSE(manual.how.metric);
  accept(value, "T2", manual);
  EXPECT_TRUE(value.mr[0].registered);
}

TEST_F(CaseRegistration, StopsWhenAskedTo)
{
  const scene::Case value = makeCase({});
  const auto stop = std::make_shared<core::CancelToken>();
  RegistrationRequest request;
  request.mr = "T2";
  std::optional<core::RigidTransform> last;
  EXPECT_THROW(registerMr(value, request, core::Progress(nullptr, stop),
                          [&](const registration::MetricSample&, const core::RigidTransform& best)
                          {
                            last = best;
                            stop->cancel();
                          }),
               core::CancelledError);
  EXPECT_TRUE(last) << "the last good state";
}

// Many fits then run concurrently, each multithreaded.
TEST_F(CaseRegistration, StopsWhileItEstimatesTheErrorToo)
{
  const scene::Case value = makeCase({});
  RegistrationRequest request;
  request.mr = "T2";
  request.from = From::Given;
  request.given = motion();
  int stopped = 0;
  for (const int delay : {5, 60, 150, 300, 600})
  {
    const auto stop = std::make_shared<core::CancelToken>();
    std::thread later;
    std::once_flag once;
    const core::Progress progress(
        [&](double, const std::string& text)
        {
          if (text.find("fit") != std::string::npos)
            std::call_once(once,
                           [&]
                           {
                             later = std::thread(
                                 [stop, delay]
                                 {
                                   std::this_thread::sleep_for(std::chrono::milliseconds(delay));
                                   stop->cancel();
                                 });
                           });
        },
        stop);
    try
    {
      registerMr(value, request, progress);
    }
    catch (const core::CancelledError&)
    {
      ++stopped;
    }
    if (later.joinable())
      later.join();
  }
  EXPECT_GT(stopped, 0);
}

TEST_F(CaseRegistration, GoesOnFromWhereTheMrLiesAndSaysHowItCameThere)
{
  scene::Case value = makeCase({});
  RegistrationRequest request;
  request.mr = "T2";
  request.from = From::Given;
  request.given = {Eigen::Quaterniond::Identity(), Vector3d(1.0, 0.5, -0.5)};
  request.given = request.given * motion();
  scene::Registration points = known();
  points.method = scene::Registration::Method::Landmarks;
  points.refined = false;
  request.givenBy = points;
  RegistrationOutcome outcome = registerMr(value, request);
  ASSERT_FALSE(outcome.failed) << outcome.how.text;
  EXPECT_LT(off(outcome.mrFromCt, motion()), 0.3);
  EXPECT_EQ(outcome.how.method, scene::Registration::Method::Landmarks);
  EXPECT_TRUE(outcome.how.refined);
  EXPECT_NE(outcome.how.text.find("from where the landmarks put it"), std::string::npos)
      << outcome.how.text;

  // The result is not a placement by landmarks.
  request.given = outcome.mrFromCt;
  request.givenBy = outcome.how;
  request.asIs = true;
  EXPECT_NO_THROW(registerMr(value, request));
  request.asIs = false;
  outcome = registerMr(value, request);
  EXPECT_TRUE(outcome.how.refined);
  EXPECT_EQ(outcome.how.text.find("from where the landmarks put it"), std::string::npos)
      << outcome.how.text;
}

TEST_F(CaseRegistration, LooksAroundAPlaceThatAHandGave)
{
  scene::Case value = makeCase({});
  RegistrationRequest request;
  request.mr = "T2";
  request.from = From::Given;
  request.given = turned(30.0, {15.0, -10.0, 5.0}) * motion();
  request.lookAround = true;
  const RegistrationOutcome outcome = registerMr(value, request);
  ASSERT_FALSE(outcome.failed) << outcome.how.text;
  EXPECT_LT(off(outcome.mrFromCt, motion()), 0.3);
  EXPECT_EQ(outcome.how.method, scene::Registration::Method::MutualInformation);
  EXPECT_FALSE(outcome.how.refined);
}

TEST_F(CaseRegistration, APlaceIsAPointOfTheCtInItsCoordinates)
{
  const scene::Case value = makeCase({});
  const RegistrationPlace place =
      placeAt(value, phantom::Phantom::center() + Vector3d(0.0, 0.0, -0.04));
  EXPECT_EQ(place.words.front(), '(');
  EXPECT_EQ(place.words.find("-0.0"), std::string::npos) << place.words;
  EXPECT_THROW(placeAt(value, {0.0, 0.0, 900.0}), core::InvalidParameter);
}
