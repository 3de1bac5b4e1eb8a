#pragma once

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "SyntheticScenes.h"
#include "petrous/Rendering/OffscreenView.h"
#include "petrous/Rendering/ReferenceRayCaster.h"

namespace petrous::rendering::synthetic
{

constexpr int kWidth = 200;
constexpr int kHeight = 150;

inline Picture draw(const SceneContents& contents, const core::CameraPose& pose)
{
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(pose);
  OffscreenView view(kWidth, kHeight);
  return view.render(scene);
}

inline bool isBackground(const std::uint8_t* pixel)
{
  return pixel[0] < 40 && pixel[1] < 40 && pixel[2] < 45;
}

inline bool isBlue(const std::uint8_t* pixel)
{
  return pixel[2] > pixel[0] + 60 && pixel[2] > pixel[1] + 60;
}

inline core::CameraPose slanting(double distance = 60.0)
{
  core::CameraPose pose;
  pose.position = distance * Eigen::Vector3d(0.5, -0.8, 0.35).normalized();
  pose.focalPoint = {0.0, 0.0, 0.0};
  return pose;
}

/// A ball with a hollow: bone whose picture tells its sides apart.
inline SceneContents hollowBall(const Eigen::Matrix3d& direction, double spacing = 0.5)
{
  SceneContents contents;
  const Eigen::Vector3d bite(4.0, -6.0, 3.0);
  contents.ct = synthetic::ct<std::int16_t>(
      synthetic::cube(static_cast<int>(24.0 / spacing), spacing, direction),
      [&](const Eigen::Vector3d& p) { return std::min(9.0 - p.norm(), (p - bite).norm() - 4.0); });
  contents.materials = {
      {appearance::TransferFunction({{kIso, {0.80F, 0.60F, 0.42F}, 1.0F, 1.0F},
                                     {kIso + 1100.0, {0.95F, 0.91F, 0.80F}, 1.0F, 1.0F}})}};
  return contents;
}

struct Agreement
{
  double silhouette = 0.0; // share of pixels that both hit or both miss
  double color = 0.0;      // mean difference over pixels that both hit, of 255
};

inline ReferencePicture truthOf(const SceneContents& contents, const core::CameraPose& pose)
{
  return ReferenceRayCaster(contents).render(pose, kWidth, kHeight);
}

inline Agreement compare(const SceneContents& contents, const core::CameraPose& pose)
{
  const Picture gpu = draw(contents, pose);
  const ReferencePicture truth = truthOf(contents, pose);
  int agree = 0;
  int hits = 0;
  double difference = 0.0;
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column)
    {
      const bool gpuHit = !isBackground(gpu.pixel(column, row));
      const bool hit = !std::isnan(truth.depth.at(column, row));
      agree += gpuHit == hit;
      if (!gpuHit || !hit)
        continue;
      ++hits;
      for (int channel = 0; channel < 3; ++channel)
        difference +=
            std::abs(gpu.pixel(column, row)[channel] - truth.picture.pixel(column, row)[channel]) /
            3.0;
    }
  EXPECT_GT(hits, 1000);
  return {static_cast<double>(agree) / (kWidth * kHeight), difference / std::max(hits, 1)};
}

inline void expectAgreement(const SceneContents& contents, const core::CameraPose& pose)
{
  const Agreement agreement = compare(contents, pose);
  EXPECT_GE(agreement.silhouette, 0.99);
  EXPECT_LE(agreement.color, 4.0);
}

inline StructureContents blueMarker(const std::shared_ptr<const volume::LabelMap>& labels)
{
  StructureContents marker{"marker", labels, 1, {}};
  marker.look.color = {0.1F, 0.15F, 0.9F};
  return marker;
}

inline int countBlue(const Picture& picture)
{
  int blue = 0;
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column)
      blue += isBlue(picture.pixel(column, row));
  return blue;
}

} // namespace petrous::rendering::synthetic
