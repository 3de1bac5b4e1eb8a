#include "RendererFeatures.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "PictureError.h"
#include "RendererBenchmarkScenes.h"
#include "TimedView.h"
#include "petrous/Rendering/ReferenceRayCaster.h"
#include "petrous/Rendering/ScenePicture.h"

namespace petrous::cli
{

namespace
{

using rendering::SceneContents;

struct Feature
{
  std::string name;
  SceneContents without;
  SceneContents with;
  rendering::RenderQuality quality = {}; // with it
  bool isShare = false;                  // the error is relative to white
};

constexpr double kWhite = 255.0;

// Of a light that is all ambient the picture is the sky that is seen, of one that is not at all,
// the lamp's part times the cosine.
SceneContents white(SceneContents contents, double ambient)
{
  for (appearance::Material& material : contents.materials)
  {
    material.transfer = appearance::TransferFunction::constant({1.0F, 1.0F, 1.0F}, 1.0F, 0.0F);
    material.lumen = false;
  }
  contents.light.shadows = true;
  contents.light.ambient = ambient;
  contents.light.specular = 0.0;
  return contents;
}

// A closed plate across the cavity's opening, which the burr went through, mm.
std::shared_ptr<const core::TriangleMesh> plateOver(const BenchmarkPatient& patient)
{
  auto mesh = std::make_shared<core::TriangleMesh>();
  const Eigen::Vector3d half(1.0, 7.0, 7.0);
  for (int corner = 0; corner < 8; ++corner)
  {
    const Eigen::Vector3d side((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0,
                               (corner & 4) != 0 ? 1.0 : -1.0);
    mesh->vertices.push_back(
        (patient.entry - 0.5 * patient.lateral + half.cwiseProduct(side)).cast<float>());
  }
  mesh->triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

rendering::ToolPose burrIn(const BenchmarkPatient& patient)
{
  rendering::ToolPose tool;
  tool.center = patient.entry - 2.0 * patient.lateral;
  tool.axisToHand = (patient.lateral + Eigen::Vector3d(0.0, 0.6, -0.4)).normalized();
  tool.radius = 2.0;
  return tool;
}

std::vector<Feature> featuresOf(const BenchmarkPatient& patient)
{
  const SceneContents opaque = contentsOf(patient, BenchmarkLook::Opaque);
  const SceneContents translucent = contentsOf(patient, BenchmarkLook::Translucent);
  std::vector<Feature> features;
  const auto add = [&](const std::string& name, const SceneContents& scene, const auto& change)
  {
    features.push_back({name, scene, scene});
    change(features.back().with);
    return &features.back();
  };
  const auto withShadows = [](SceneContents& scene) { scene.light.setShadows(true); };
  SceneContents shadowed = opaque;
  withShadows(shadowed);
  add("shadows, opaque", opaque, withShadows);
  add("shadows, translucent", translucent, withShadows);
  add("occlusion alone", opaque, [](SceneContents& scene) { scene = white(scene, 1.0); })->isShare =
      true;
  add("lamp's shadow alone", opaque, [](SceneContents& scene) { scene = white(scene, 0.0); })
      ->isShare = true;
  add("burr", opaque, [&](SceneContents& scene) { scene.tool = burrIn(patient); });
  add("burr with its shadow", shadowed,
      [&](SceneContents& scene) { scene.tool = burrIn(patient); });
  add("instrument with its shadow", shadowed,
      [&](SceneContents& scene)
      {
        scene.tool = burrIn(patient);
        auto blade = std::make_shared<core::TriangleMesh>(*plateOver(patient));
        for (Eigen::Vector3f& vertex : blade->vertices)
        {
          const Eigen::Vector3f side =
              vertex - (patient.entry - 0.5 * patient.lateral).cast<float>();
          vertex = {side.x(), side.y() / 7.0F, 15.0F + 15.0F * side.z() / 7.0F};
        }
        scene.tool->instrument = blade;
        scene.tool->rotation =
            Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), scene.tool->axisToHand);
      });
  add("edges", translucent, [](SceneContents& scene) { scene.light.edges = 1.0; });
  add("exit surfaces", translucent, [](SceneContents& scene) { scene.light.exitSurfaces = true; });
  add("grain", opaque, [](SceneContents& scene) { scene.light.grain = 1.0; });
  add("tone curve and exposure", opaque,
      [](SceneContents& scene)
      {
        scene.light.toneCurve = true;
        scene.light.exposure = 0.5;
      });
  add("water film and falloff", opaque,
      [](SceneContents& scene)
      {
        scene.light.wetness = 1.0;
        scene.light.falloff = 100.0;
      });
  const rendering::ClippingPlane plane{patient.entry - 4.0 * patient.lateral,
                                       Eigen::Vector3d(0.0, 0.4, -1.0).normalized()};
  SceneContents clipped = opaque;
  clipped.clipping = {plane};
  add("clipping plane", opaque, [&](SceneContents& scene) { scene.clipping = {plane}; });
  add("section in the CT's grey", clipped,
      [](SceneContents& scene) { scene.section = rendering::SectionWindow{}; });
  const auto soft = softTissueOf(patient).softTissue;
  add("soft tissue", opaque, [&](SceneContents& scene) { scene.softTissue = soft; });
  add("soft tissue by an MR", opaque,
      [&](SceneContents& scene)
      {
        // The CT's voxels stand for it, through a registration.
        scene.second = {patient.ct, core::RigidTransform(
                                        Eigen::Quaterniond(Eigen::AngleAxisd(
                                            0.05, Eigen::Vector3d(1.0, 2.0, -1.0).normalized())),
                                        Eigen::Vector3d(2.0, -1.0, 1.5))};
        scene.softTissue = soft;
        scene.softTissue->source = appearance::IntensitySource::Second;
      });
  add("drilled mesh", opaque,
      [&](SceneContents& scene)
      {
        rendering::MeshContents mesh;
        mesh.name = "plate";
        mesh.mesh = plateOver(patient);
        mesh.drilled = true;
        scene.meshes.push_back(std::move(mesh));
      });
  for (const bool isExact : {true, false})
    for (const SceneContents* scene : {&opaque, &translucent})
    {
      Feature* feature = add(std::string("weights of 8 bits, ") +
                                 (isExact ? "exact filter" : "samples as they are") +
                                 (scene == &opaque ? ", opaque" : ", translucent"),
                             *scene, [](SceneContents&) {});
      feature->quality.filterBits = 8;
      feature->quality.exactSamples = isExact;
    }
  return features;
}

double medianOf(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Rounds, so that background load affects both alike.
void timeInTurns(const Feature& feature, const core::CameraPose& camera, rendering::TimedView& view,
                 int frames, core::BenchmarkPoint& point)
{
  constexpr int kRounds = 3;
  rendering::ScenePicture scene;
  scene.setCamera(camera);
  view.show(scene);
  std::vector<double> seconds[2];
  double fetches[2] = {};
  for (int round = 0; round <= kRounds; ++round)
    for (const int isWith : {0, 1})
    {
      scene.setContents(isWith ? feature.with : feature.without);
      scene.setQuality(isWith ? feature.quality : rendering::RenderQuality{});
      scene.setCounting(round == kRounds);
      const double first = view.frame();
      if (round == kRounds)
      {
        const rendering::RenderStatistics& statistics = scene.statistics();
        fetches[isWith] = statistics.fetchesPerPixel;
        point.extra["samples_per_pixel"] = statistics.samplesPerPixel;
        std::string variant;
        for (const std::string& name : statistics.variant)
          variant += (variant.empty() ? "" : " ") + name;
        point.setting["variant"] = variant;
        continue;
      }
      if (round == 0 && isWith)
        point.extra["first_frame_ms"] = 1e3 * first;
      for (int n = 0; n < std::max(frames / kRounds, 1); ++n)
        seconds[isWith].push_back(view.frame());
    }
  point.seconds = medianOf(seconds[1]);
  point.extra["frames"] = static_cast<double>(seconds[1].size());
  point.extra["without_ms"] = 1e3 * medianOf(seconds[0]);
  point.extra["share_percent"] = 100.0 * (1.0 - 1e-3 * point.extra["without_ms"] / point.seconds);
  point.extra["fetches_per_pixel"] = fetches[1];
  point.extra["fetches_per_pixel_without"] = fetches[0];
}

void enterFeatureError(const Feature& feature, const core::CameraPose& camera,
                       rendering::TimedView& view, const PictureSize& size,
                       const core::Progress& progress, core::BenchmarkPoint& point)
{
  const auto truth =
      rendering::ReferenceRayCaster(feature.with).render(camera, size.width, size.height, progress);
  rendering::ScenePicture scene;
  scene.setContents(feature.with);
  scene.setCamera(camera);
  scene.setQuality(feature.quality);
  view.show(scene);
  view.frame();
  const rendering::Picture picture = view.picture();
  const auto error = rendering::comparePictures(picture, scene.depth(), truth.rgb, truth.depth,
                                                feature.with.ct->geometry().minSpacing());
  point.error = feature.isShare ? error.rms / kWhite : error.rms;
  point.errorUnit =
      feature.isShare ? "RMS of full occlusion, against 256 rays" : "1/255, RMS of colour";
  point.extra["mismatch_percent"] = error.mismatchPercent();
  point.extra["compared_pixels"] = static_cast<double>(error.agreeing);
  point.extra["depth_median_voxels"] = error.depthMedian;
  point.extra["depth_p95_voxels"] = error.depthP95;
}

} // namespace

std::vector<core::BenchmarkPoint> featurePoints(const BenchmarkPatient& patient,
                                                const FeatureExtent& extent,
                                                const core::Progress& progress)
{
  const core::CameraPose camera = cameraOf(patient, BenchmarkView::Near);
  const std::vector<Feature> features = featuresOf(patient);
  rendering::TimedView view(extent.picture.width, extent.picture.height);
  rendering::TimedView small(extent.errorPicture.width, extent.errorPicture.height);
  std::vector<core::BenchmarkPoint> points;
  for (const Feature& feature : features)
  {
    const double count = static_cast<double>(features.size());
    const double done = static_cast<double>(points.size());
    const auto part = progress.part(done / count, (done + 1.0) / count);
    core::BenchmarkPoint point;
    point.scene = patient.name + ", near, feature: " + feature.name;
    part.report(0.0, point.scene);
    point.isDefault = feature.quality.filterBits == 0;
    point.setting["picture"] = shown(extent.picture);
    point.setting["error_picture"] = shown(extent.errorPicture);
    timeInTurns(feature, camera, view, extent.frames, point);
    enterFeatureError(feature, camera, small, extent.errorPicture, part.part(0.3, 1.0), point);
    points.push_back(std::move(point));
  }
  return points;
}

} // namespace petrous::cli
