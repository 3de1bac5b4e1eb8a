#include <gtest/gtest.h>

#include <cmath>

#include "petrous/Appearance/TransferFunction.h"
#include "petrous/Core/Error.h"

using namespace petrous::appearance;
using petrous::core::InvalidParameter;

namespace
{

TransferFunction ramp()
{
  return TransferFunction(
      {{100.0, {0.2F, 0.4F, 0.6F}, 0.0F, 0.1F}, {300.0, {0.4F, 0.8F, 1.0F}, 0.5F, 0.9F}});
}

std::string refusal(const std::string& json)
{
  try
  {
    TransferFunction::fromJson(json);
  }
  catch (const InvalidParameter& error)
  {
    return error.what();
  }
  return "accepted";
}

} // namespace

TEST(TransferFunction, IsLinearBetweenItsPointsAndConstantBeyond)
{
  const auto middle = ramp().at(250.0);
  EXPECT_NEAR(middle.color[1], 0.7, 1e-6);
  EXPECT_NEAR(middle.specular, 0.7, 1e-6);
  EXPECT_EQ(ramp().at(-5000.0).color[0], ramp().at(100.0).color[0]);
  EXPECT_EQ(ramp().at(5000.0).extinction, ramp().at(300.0).extinction);
  EXPECT_EQ(ramp().at(std::nan("")).specular, ramp().at(100.0).specular);
}

TEST(TransferFunction, OpacityIsThatOfOneMillimetre)
{
  const double extinction = ramp().at(200.0).extinction; // opacity 0.25
  EXPECT_NEAR(std::exp(-extinction * 1.0), 0.75, 1e-7);
  EXPECT_NEAR(std::exp(-extinction * 0.5) * std::exp(-extinction * 0.5), 0.75, 1e-7);
  EXPECT_TRUE(std::isfinite(TransferFunction::constant({}, 1.0F).at(0.0).extinction));
}

TEST(TransferFunction, JsonGoesThereAndBackToTheLastBit)
{
  const TransferFunction transfer({{-1024.0, {0.1F, 1.0F / 3.0F, 0.0F}, 0.0F, 1.0F},
                                   {1e-7, {1.0F, 0.7F, std::nextafter(0.7F, 1.0F)}, 0.9F, 0.35F},
                                   {3071.123456789012, {0.5F, 0.5F, 0.5F}, 1.0F, 0.0F}});
  EXPECT_EQ(TransferFunction::fromJson(transfer.toJson()), transfer);
  EXPECT_NE(transfer.toJson().find("\"specular\":0.35,"), std::string::npos) << transfer.toJson();
}

TEST(TransferFunction, SpecularMayBeLeftOut)
{
  const auto transfer =
      TransferFunction::fromJson(R"({"points":[{"value":1,"color":[1,0,0],"opacity":0.5}]})");
  EXPECT_EQ(transfer.points().at(0).specular, 1.0F);
}

TEST(TransferFunction, JsonRefusalsNameThePointAndTheKey)
{
  const auto point = [](const std::string& keys) { return R"({"points":[{)" + keys + "}]}"; };
  EXPECT_NE(refusal("{\"points\": [").find("not JSON"), std::string::npos);
  EXPECT_NE(refusal("[1, 2]").find("\"points\""), std::string::npos);
  EXPECT_NE(refusal(R"({"points":[]})").find("at least one point"), std::string::npos);
  EXPECT_NE(refusal(R"({"points":[3]})").find("point 1"), std::string::npos);
  EXPECT_NE(refusal(point(R"("color":[1,0,0],"opacity":0.5)")).find("'value' is missing"),
            std::string::npos);
  EXPECT_NE(refusal(point(R"("value":"x","color":[1,0,0],"opacity":0.5)")).find("a number"),
            std::string::npos);
  EXPECT_NE(refusal(point(R"("value":1,"color":[1,0],"opacity":0.5)")).find("'color'"),
            std::string::npos);
  EXPECT_NE(refusal(point(R"("value":1,"color":[1,0,9],"opacity":0.5)")).find("colour"),
            std::string::npos);
  EXPECT_NE(refusal(point(R"("value":1,"color":[1,0,0],"opacity":2)")).find("opacity"),
            std::string::npos);
  EXPECT_NE(refusal(point(R"("value":1,"colour":[1,0,0],"opacity":1)")).find("'colour'"),
            std::string::npos);
  EXPECT_NE(refusal(point(R"("value":1e999,"color":[1,0,0],"opacity":1)")), "accepted");
  EXPECT_NE(refusal(R"({"points":[{"value":5,"color":[1,0,0],"opacity":1},
                                  {"value":5,"color":[1,0,0],"opacity":1}]})")
                .find("point 2"),
            std::string::npos);
}

TEST(TransferFunction, RefusesMorePointsThanARendererWants)
{
  std::string json = R"({"points":[)";
  for (int n = 0; n < 2000; ++n)
    json += (n > 0 ? "," : "") + (R"({"value":)" + std::to_string(n)) +
            R"(,"color":[1,1,1],"opacity":1})";
  EXPECT_NE(refusal(json + "]}").find("2000 points"), std::string::npos);
}
