#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "RegistrationPlots.h"

using namespace petrous;
using namespace petrous::cli;

namespace
{

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

core::BenchmarkPoint trial(const std::string& kind, const std::string& verdict, double error,
                           bool wrong)
{
  core::BenchmarkPoint point;
  point.scene = "stress: " + kind;
  point.setting = {{"trial", "one"},
                   {"verdict", verdict},
                   {"outcome", wrong ? "confidently wrong" : "not trusted"},
                   {"text", "words"},
                   {"truth", "known"}};
  point.error = error;
  point.extra = {{"wrong", wrong ? 1.0 : 0.0}, {"p95_mm", 0.5}, {"max_mm", 0.75}};
  return point;
}

core::BenchmarkPoint calibrated(double stated, double error)
{
  core::BenchmarkPoint point;
  point.scene = "calibration";
  point.setting = {{"pair", "1"}, {"images", "phantom"}, {"verdict", "good"}};
  point.error = error;
  point.extra = {{"p95_mm", stated}, {"covered", error <= stated ? 1.0 : 0.0}};
  return point;
}

} // namespace

TEST(RegistrationPlots, CountsStressTrialsByKindAndNamesEachWrongOne)
{
  core::BenchmarkReport report{"registration", "title", {}};
  report.points = {trial("noise", "failed", kNone, false), trial("noise", "good", kNone, true),
                   trial("turned", "good", 0.25, false), trial("turned", "refused", kNone, false),
                   trial("turned", "good", 3.5, true)};
  const auto plots = registrationPlots(report);
  ASSERT_EQ(plots.size(), 2U);
  const std::string& table = plots.at("-stress.md");
  EXPECT_NE(table.find("| noise | 2 | 1 | 0 | 1 | 0 |  | 1 |"), std::string::npos) << table;
  EXPECT_NE(table.find("| turned | 3 | 2 | 0 | 0 | 1 | 3.50 | 1 |"), std::string::npos) << table;
  EXPECT_NE(table.find("| **all** | 5 | 3 | 0 | 1 | 1 | 3.50 | 2 |"), std::string::npos) << table;
  EXPECT_NE(table.find("noise (one): no truth exists"), std::string::npos) << table;
  EXPECT_NE(table.find("turned (one): true error 3.50 mm, stated p95 0.50"), std::string::npos);
  const auto json = nlohmann::json::parse(plots.at("-stress.json"));
  EXPECT_EQ(json.at("trials"), 5);
  EXPECT_EQ(json.at("confidently_wrong"), 2);
  EXPECT_FALSE(json.at("list").at(0).contains("true_error_mm"));
  EXPECT_EQ(json.at("list").at(4).at("true_error_mm"), 3.5);
}

TEST(RegistrationPlots, SaysHowManyErrorsTheStatedOnesCover)
{
  core::BenchmarkReport report{"registration", "title", {}};
  report.points = {calibrated(1.0, 0.5), calibrated(1.0, 0.9), calibrated(1.0, 1.1),
                   calibrated(0.2, 0.1)};
  const auto plots = registrationPlots(report);
  ASSERT_EQ(plots.size(), 1U);
  EXPECT_NE(plots.at("-calibration").find("good: 3 of 4 within, 75.0 %"), std::string::npos);
}
