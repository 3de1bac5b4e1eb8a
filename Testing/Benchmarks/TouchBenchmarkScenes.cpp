#include "TouchBenchmarkScenes.h"

#include "BenchmarkPatients.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::cli
{

namespace
{

constexpr double kAbove = 8.0; // mm, of the burr's centre above the cortex at the cavity

haptics::TouchScene touchSceneOf(const BenchmarkPatient& patient)
{
  const volume::TissueField tissue(patient.ct, {patient.labels->occupancy}, nullptr,
                                   {kBenchmarkIso, 1000.0});
  haptics::TouchScene scene;
  scene.name = patient.name + ", structures, cavity";
  scene.field = std::make_shared<const haptics::HapticField>(
      tissue, std::make_shared<volume::PublishedMask>(*patient.mask));
  const Eigen::Vector3d back = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  struct Place
  {
    double behind, above;    // mm, from the cavity's centre
    double tiltBack, tiltUp; // of the direction to the tissue
  };
  for (const Place& place :
       {Place{0.0, 0.0, 0.0, 0.0}, Place{2.5, 2.0, 0.3, 0.1}, Place{-3.0, -2.0, -0.2, -0.3},
        Place{5.0, 0.0, 0.1, 0.0}, Place{0.0, 8.0, 0.0, 0.2}, Place{-8.0, 5.0, -0.2, 0.1}})
    scene.starts.push_back(
        {patient.entry + kAbove * patient.lateral + place.behind * back + place.above * up,
         (-patient.lateral + place.tiltBack * back + place.tiltUp * up).normalized()});
  return scene;
}

} // namespace

std::vector<haptics::TouchScene> touchBenchmarkScenes(bool quick, const std::filesystem::path& data,
                                                      const core::Progress& progress)
{
  std::vector<haptics::TouchScene> scenes;
  scenes.push_back(touchSceneOf(phantomPatient(quick ? 96 : 256, progress.part(0.0, 0.5))));
  if (const auto patient = realPatient(data, progress.part(0.5, 1.0)))
    scenes.push_back(touchSceneOf(*patient));
  return scenes;
}

} // namespace petrous::cli
