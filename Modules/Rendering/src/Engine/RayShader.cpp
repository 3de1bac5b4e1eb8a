#include "RayShader.h"

#include <utility>

#include "OccupancyGrid.h"
#include "OpticalModel.h"
#include "PolygonShadowsShader.h"
#include "RayCastShader.h"
#include "RayClipShader.h"
#include "RayMarchShader.h"
#include "RayOpticsShader.h"
#include "RaySceneShader.h"
#include "RayShadowsShader.h"
#include "ToneCurveShader.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Rendering/ThicknessColor.h"
#include "petrous/Volume/LabelBorders.h"

namespace petrous::rendering
{

namespace
{

struct Part
{
  bool RayFeatures::*wanted;
  const char* define;
  const char* name;
};

constexpr Part kParts[] = {
    {&RayFeatures::bone, "PETROUS_BONE", "bone"},
    {&RayFeatures::labels, "PETROUS_LABELS", "labels"},
    {&RayFeatures::borders, "PETROUS_BORDERS", "borders"},
    {&RayFeatures::nested, "PETROUS_NESTED", "nested"},
    {&RayFeatures::mask, "PETROUS_MASK", "mask"},
    {&RayFeatures::second, "PETROUS_SECOND", "second"},
    {&RayFeatures::third, "PETROUS_THIRD", "third"},
    {&RayFeatures::interior, "PETROUS_INTERIOR", "interior"},
    {&RayFeatures::edges, "PETROUS_EDGES", "edges"},
    {&RayFeatures::exits, "PETROUS_EXITS", "exit surfaces"},
    {&RayFeatures::grain, "PETROUS_GRAIN", "grain"},
    {&RayFeatures::soft, "PETROUS_SOFT", "soft tissue"},
    {&RayFeatures::clip, "PETROUS_CLIP", "clipping"},
    {&RayFeatures::thickness, "PETROUS_THICKNESS", "thickness"},
    {&RayFeatures::shadows, "PETROUS_SHADOWS", "shadows"},
    {&RayFeatures::tool, "PETROUS_TOOL", "tool"},
    {&RayFeatures::instrument, "PETROUS_INSTRUMENT", "instrument"},
    {&RayFeatures::tone, "PETROUS_TONE", "tone"},
    {&RayFeatures::count, "PETROUS_COUNT", nullptr},
    {&RayFeatures::exact, "PETROUS_EXACT", nullptr},
    {&RayFeatures::rounded, "PETROUS_ROUNDED", nullptr},
};

std::string constantText(const char* name, double value)
{
  return std::string("const float ") + name + " = float(" + core::generalText(value, 9) + ");\n";
}

std::string constants()
{
  std::string text = "const int kMaxPlanes = " + std::to_string(kMaxPlanes) + ";\n";
  const std::pair<const char*, double> reals[] = {
      {"kInteriorFacing", optics::kInteriorFacing},
      {"kWetShininess", optics::kWetShininess},
      {"kOccupancyThreshold", optics::kOccupancyThreshold},
      {"kSmoothOpacity", optics::kSmoothOpacity},
      {"kLeastFacing", optics::kLeastFacing},
      {"kEdgeSlope", optics::kEdgeSlope},
      {"kCoarseCell", optics::kGrainCells[0]},
      {"kFineCell", optics::kGrainCells[1]},
      {"kCoarseShare", optics::kGrainShares[0]},
      {"kFineShare", optics::kGrainShares[1]},
      {"kGrainContrast", optics::kGrainContrast},
      {"kFineGrain", optics::kFineGrain},
      {"kCoarseGrain", optics::kCoarseGrain},
      {"kUnlike", optics::kUnlike},
      {"kAlike", optics::kAlike},
      {"kAsideSlope", optics::kAsideSlope},
      {"kMostAside", optics::kMostAside},
      {"kSoftInSection", optics::kSoftInSection},
      {"kMarginPerDepth", volume::kMarginPerDepth},
      {"kOcclusionReach", optics::kOcclusionReach},
      {"kShadowReach", optics::kShadowReach},
      {"kLampTangent", optics::kLampTangent},
      {"kSliceGrowth", kSliceGrowth}};
  for (const auto& [name, value] : reals)
    text += constantText(name, value);
  text += "const vec3 kThicknessColors[" + std::to_string(kThicknessColors.size()) + "] = vec3[](";
  for (std::size_t n = 0; n < kThicknessColors.size(); ++n)
  {
    text += n == 0 ? "vec3(" : ", vec3(";
    for (std::size_t c = 0; c < 3; ++c)
      text += (c == 0 ? "" : ", ") + core::generalText(kThicknessColors[n][c]);
    text += ")";
  }
  text += ");\n";
  const std::pair<const char*, unsigned> flags[] = {{"kMixed", OccupancyGrid::Mixed},
                                                    {"kLabels", OccupancyGrid::Labels},
                                                    {"kBorder", OccupancyGrid::Border},
                                                    {"kMeeting", volume::kMeeting},
                                                    {"kDeepest", volume::kDeepest}};
  for (const auto& [name, value] : flags)
    text += std::string("const uint ") + name + " = " + std::to_string(value) + "u;\n";
  return text;
}

} // namespace

unsigned RayFeatures::key() const noexcept
{
  unsigned key = 0;
  for (const Part& part : kParts)
    key = 2 * key + (this->*part.wanted ? 1 : 0);
  return key;
}

std::vector<std::string> RayFeatures::names() const
{
  std::vector<std::string> names{"ct"};
  for (const Part& part : kParts)
    if (this->*part.wanted && part.name)
      names.emplace_back(part.name);
  return names;
}

std::string toneCurveShader()
{
  return constantText("kToneStart", optics::kToneStart) +
         constantText("kToneDesaturation", optics::kToneDesaturation) +
         std::string(kToneCurveShader);
}

std::string polygonShadowsShader()
{
  return "#define PETROUS_SHADOWS\n#define PETROUS_CLIP\n#define PETROUS_TOOL\n#define "
         "PETROUS_INSTRUMENT\n"
         "#define COUNT(n)\n"
         "uniform vec3 boxLower, boxUpper;\n"
         "uniform mat3 voxelFromMm;\n"
         "uniform int planeCount;\n" +
         constants() + "uniform vec4 planes[kMaxPlanes];\n" + std::string(kRayShadowsShader) +
         std::string(kPolygonShadowsShader);
}

std::string rayFragmentShader(const RayFeatures& features)
{
  std::string text;
  for (const Part& part : kParts)
    if (features.*part.wanted)
      text += std::string("#define ") + part.define + "\n";
  text += constants();
  return text.append(kRaySceneShader)
      .append(kRayClipShader)
      .append(kRayShadowsShader)
      .append(features.tone ? toneCurveShader() : std::string())
      .append(kRayOpticsShader)
      .append(kRayMarchShader)
      .append(kRayCastShader);
}

} // namespace petrous::rendering
