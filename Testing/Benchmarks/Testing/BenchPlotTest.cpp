#include <algorithm>
#include <cmath>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "BenchPlot.h"
#include "SvgParts.h"
#include "petrous/Core/NumberText.h"

using namespace petrous;
using namespace petrous::cli;

namespace
{

struct Label
{
  std::string words;
  double left, top, right, bottom;
};

// Labels of 10 pixels, with the digit width of common fonts.
std::vector<Label> labelsOf(const std::string& svg)
{
  const std::regex text("<text x=\"([-.0-9]+)\" y=\"([-.0-9]+)\" text-anchor=\"middle\" "
                        "font-size=\"10\">([^<]*)<");
  std::vector<Label> labels;
  for (std::sregex_iterator at(svg.begin(), svg.end(), text), end; at != end; ++at)
  {
    const double x = core::parseDouble((*at)[1].str()).value();
    const double y = core::parseDouble((*at)[2].str()).value();
    const double half = 0.5 * 6.36 * static_cast<double>((*at)[3].length());
    labels.push_back({(*at)[3], x - half, y - 7.3, x + half, y});
  }
  return labels;
}

bool overlap(const Label& a, const Label& b)
{
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

void expectApart(const std::vector<Label>& labels)
{
  for (std::size_t a = 0; a < labels.size(); ++a)
    for (std::size_t b = a + 1; b < labels.size(); ++b)
      EXPECT_FALSE(overlap(labels[a], labels[b])) << labels[a].words << " " << labels[b].words;
}

core::BenchmarkPoint point(const std::string& series, const std::string& value, double seconds,
                           double error)
{
  core::BenchmarkPoint result;
  result.scene = "scene";
  result.series = series;
  result.setting[series] = value;
  result.seconds = seconds;
  result.error = error;
  return result;
}

// Five settings at the same position, in the middle of the plot or near a corner.
core::BenchmarkReport crowd(double seconds, double error)
{
  core::BenchmarkReport report{"renderer", "title", {}};
  report.points = {point("step", "2", 0.21, 4.9), point("step", "0.125", 1.9, 0.52)};
  for (const char* value : {"64", "256", "512", "1024", "4096"})
    report.points.push_back(point("table_entries", value, seconds, error));
  report.points.back().isDefault = true;
  return report;
}

} // namespace

TEST(BenchPlot, KeepsTheLabelsOfSettingsThatLieTogetherApart)
{
  for (const auto& [seconds, error] :
       {std::pair{0.57, 1.0}, {0.21, 4.9}, {1.9, 4.9}, {0.21, 0.52}, {1.9, 0.52}})
  {
    const std::vector<Label> labels = labelsOf(seriesSvg(crowd(seconds, error)));
    EXPECT_EQ(labels.size(), 7U) << "room for all";
    expectApart(labels);
  }
}

TEST(BenchPlot, LeavesOutWhatHasNoRoomButTheDefault)
{
  core::BenchmarkReport report = crowd(0.57, 1.0);
  for (int n = 0; n < 200; ++n)
    report.points.push_back(point("table_entries", std::to_string(10000 + n), 0.57, 1.0));
  const std::vector<Label> labels = labelsOf(seriesSvg(report));
  expectApart(labels);
  EXPECT_GT(labels.size(), 20U);
  EXPECT_LT(labels.size(), 100U);
  EXPECT_EQ(std::count_if(labels.begin(), labels.end(),
                          [](const Label& label) { return label.words == "4096"; }),
            1);
}

TEST(LogAxis, RunsFromOneMarkToAnotherOverAllValues)
{
  const svg::LogAxis axis({0.03, 0.0, 4.0});
  EXPECT_EQ(axis.ticks().front().label, "0.02");
  EXPECT_EQ(axis.ticks().back().label, "5");
  EXPECT_NEAR(axis.share(1.0), std::log(1.0 / 0.02) / std::log(5.0 / 0.02), 1e-12);
  EXPECT_EQ(axis.share(0.0), 0.0);
}
