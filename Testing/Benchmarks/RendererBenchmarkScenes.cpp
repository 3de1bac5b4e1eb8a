#include "RendererBenchmarkScenes.h"

#include "petrous/Rendering/StandardViews.h"
#include "petrous/Volume/TissueExtent.h"

namespace petrous::cli
{

std::string nameOf(BenchmarkLook look)
{
  switch (look)
  {
  case BenchmarkLook::Translucent:
    return "translucent bone, labels, cut";
  case BenchmarkLook::Opaque:
    return "opaque bone, labels, cut";
  case BenchmarkLook::CtAlone:
    break;
  }
  return "CT alone, opaque";
}

std::string nameOf(BenchmarkView view)
{
  return view == BenchmarkView::Head ? "head" : "near";
}

rendering::SceneContents contentsOf(const BenchmarkPatient& patient, BenchmarkLook look)
{
  rendering::SceneContents contents;
  contents.ct = patient.ct;
  contents.iso = kBenchmarkIso;
  appearance::Material bone;
  // Defined here, not a preset: figures of different versions refer to the same scene.
  bone.transfer = appearance::TransferFunction({{300.0, {0.86F, 0.70F, 0.52F}, 0.02F, 0.4F},
                                                {900.0, {0.93F, 0.86F, 0.72F}, 0.08F, 0.7F},
                                                {1600.0, {0.97F, 0.94F, 0.86F}, 0.25F, 1.0F}});
  if (look == BenchmarkLook::Translucent)
    bone.surfaceOpacity = 0.35F;
  contents.materials = {bone};
  if (look == BenchmarkLook::CtAlone)
    return contents;
  contents.materials.insert(contents.materials.end(), patient.structures.begin(),
                            patient.structures.end());
  contents.labels = patient.labels;
  contents.mask = patient.mask;
  return contents;
}

rendering::SceneContents softTissueOf(const BenchmarkPatient& patient, bool isLit)
{
  rendering::SceneContents contents;
  contents.ct = patient.ct;
  contents.boneShown = false;
  contents.iso = 1e5; // beyond all of it: what is bone is no soft tissue
  contents.softTissue =
      appearance::Material{appearance::TransferFunction({{-700.0, {0.90F, 0.72F, 0.60F}, 0.0F},
                                                         {-400.0, {0.90F, 0.72F, 0.60F}, 0.10F},
                                                         {-150.0, {0.95F, 0.85F, 0.55F}, 0.012F},
                                                         {-50.0, {0.95F, 0.85F, 0.55F}, 0.012F},
                                                         {20.0, {0.62F, 0.24F, 0.20F}, 0.03F},
                                                         {100.0, {0.62F, 0.24F, 0.20F}, 0.05F},
                                                         {300.0, {0.90F, 0.85F, 0.75F}, 0.15F},
                                                         {1200.0, {0.97F, 0.95F, 0.88F}, 0.6F}})};
  if (!isLit)
    contents.light.ambient = 1.0;
  return contents;
}

core::CameraPose cameraOf(const BenchmarkPatient& patient, BenchmarkView view)
{
  if (view == BenchmarkView::Head)
  {
    const auto extent = volume::tissueExtent(*patient.ct, kBenchmarkIso);
    return rendering::standardCamera(patient.lateral.x() > 0.0 ? rendering::StandardView::Left
                                                               : rendering::StandardView::Right,
                                     patient.ct->geometry(), extent.center, extent.radius);
  }
  constexpr double distance = 60.0; // mm: 32 mm of visible height
  core::CameraPose pose;
  pose.focalPoint = patient.entry - 4.0 * patient.lateral;
  pose.position = pose.focalPoint +
                  distance * (patient.lateral + Eigen::Vector3d(0.0, 0.35, 0.25)).normalized();
  return pose;
}

} // namespace petrous::cli
