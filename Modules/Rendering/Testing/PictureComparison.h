#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "OpticalModel.h"
#include "SyntheticScenes.h"
#include "petrous/Rendering/OffscreenView.h"
#include "petrous/Rendering/ReferenceRayCaster.h"

namespace petrous::rendering::synthetic
{

constexpr int kWidth = 200;
constexpr int kHeight = 150;

struct Shot
{
  Picture picture;
  DepthImage depth;
  RenderStatistics statistics;
};

/// Draws another frame of a scene.
inline Shot shoot(OffscreenView& view, ScenePicture& scene)
{
  Shot shot;
  shot.picture = view.render(scene);
  shot.depth = scene.depth();
  shot.statistics = scene.statistics();
  return shot;
}

/// Draws a scene from scratch.
inline Shot shoot(const SceneContents& contents, const core::CameraPose& pose,
                  const RenderQuality& quality = {}, int width = kWidth, int height = kHeight)
{
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(pose);
  scene.setQuality(quality);
  OffscreenView view(width, height);
  return shoot(view, scene);
}

inline Picture draw(const SceneContents& contents, const core::CameraPose& pose,
                    const RenderQuality& quality = {})
{
  return shoot(contents, pose, quality).picture;
}

inline ReferencePicture truthOf(const SceneContents& contents, const core::CameraPose& pose,
                                int width = kWidth, int height = kHeight)
{
  return ReferenceRayCaster(contents).render(pose, width, height);
}

inline core::CameraPose slanting(double distance = 60.0)
{
  core::CameraPose pose;
  pose.position = distance * Eigen::Vector3d(0.5, -0.8, 0.35).normalized();
  pose.focalPoint = {0.0, 0.0, 0.0};
  return pose;
}

struct Agreement
{
  double rms = 0.0;      // of colour, 1/255, where the first hits agree within half a voxel
  double others = 0.0;   // % of all pixels: hit/miss mismatches, or first hits further apart
  double median = 0.0;   // |difference of first hits|, voxels, where both hit
  double farthest = 0.0; // the largest of those that agree
  int hits = 0;          // pixels that agree
  int background = 0;    // largest channel difference where neither hits, of 255
};

inline Agreement compare(const Shot& shot, const ReferencePicture& truth, double voxel)
{
  Agreement result;
  std::vector<double> apart;
  double squares = 0.0;
  int others = 0;
  const std::size_t pixels = truth.depth.millimetres.size();
  EXPECT_EQ(shot.depth.millimetres.size(), pixels);
  for (std::size_t p = 0; p < pixels; ++p)
  {
    const auto drawn = static_cast<double>(shot.depth.millimetres[p]);
    const auto wanted = static_cast<double>(truth.depth.millimetres[p]);
    const auto color = [&](std::size_t c)
    { return shot.picture.rgb[3 * p + c] - 255.0 * static_cast<double>(truth.rgb[3 * p + c]); };
    if (std::isnan(drawn) && std::isnan(wanted))
    {
      for (std::size_t c = 0; c < 3; ++c)
        result.background =
            std::max(result.background, static_cast<int>(std::lround(std::abs(color(c)))));
      continue;
    }
    const double difference = std::abs(drawn - wanted) / voxel;
    if (!std::isnan(difference))
      apart.push_back(difference);
    if (!(difference <= 0.5))
    {
      ++others;
      continue;
    }
    ++result.hits;
    result.farthest = std::max(result.farthest, difference);
    for (std::size_t c = 0; c < 3; ++c)
      squares += color(c) * color(c);
  }
  result.others = 100.0 * others / static_cast<double>(pixels);
  result.rms = std::sqrt(squares / std::max(3 * result.hits, 1));
  if (!apart.empty())
  {
    const auto middle = apart.begin() + static_cast<std::ptrdiff_t>(apart.size() / 2);
    std::nth_element(apart.begin(), middle, apart.end());
    result.median = *middle;
  }
  return result;
}

/// Accuracy at default quality: colour within 1/255 RMS (rounding to 8 bits alone gives 0.29), 0.2
/// % of other pixels, first hits within 0.05 voxel in the median.
inline void expectAgreement(const Agreement& agreement)
{
  EXPECT_LE(agreement.rms, 1.0);
  EXPECT_LE(agreement.others, 0.2);
  EXPECT_LE(agreement.median, 0.05);
  EXPECT_LE(agreement.background, 1);
}

inline bool isBackground(const std::uint8_t* pixel)
{
  for (std::size_t c = 0; c < 3; ++c)
    if (std::abs(pixel[c] - 255.0 * optics::kBackground[c]) > 1.0)
      return false;
  return true;
}

inline bool isBlue(const std::uint8_t* pixel)
{
  return pixel[2] > pixel[0] + 60 && pixel[2] > pixel[1] + 60;
}

inline int countBlue(const Picture& picture)
{
  int blue = 0;
  for (int row = 0; row < picture.height; ++row)
    for (int column = 0; column < picture.width; ++column)
      blue += isBlue(picture.pixel(column, row));
  return blue;
}

} // namespace petrous::rendering::synthetic
