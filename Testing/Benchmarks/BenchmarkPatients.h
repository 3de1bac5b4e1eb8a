#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Appearance/Material.h"
#include "petrous/Core/Progress.h"
#include "petrous/Volume/CutMask.h"
#include "petrous/Volume/IntensityVolume.h"
#include "petrous/Volume/LabelField.h"

namespace petrous::cli
{

constexpr double kBenchmarkIso = 300.0; // HU

/// A patient to draw and to touch: CT, structures, and a cavity that a 4 mm burr opened in the
/// mastoid.
struct BenchmarkPatient
{
  std::string name; ///< without anything that says who it is
  std::shared_ptr<const volume::IntensityVolume> ct;
  std::shared_ptr<const volume::LabelField> labels;
  std::vector<appearance::Material> structures; ///< row i - 1: index i of the labels
  std::shared_ptr<volume::CutMask> mask;
  Eigen::Vector3d entry{0.0, 0.0, 0.0};   ///< on the cortex, amid the cavity; patient LPS mm
  Eigen::Vector3d lateral{1.0, 0.0, 0.0}; ///< unit, out of the head
};

/// The built-in phantom on edge^3 voxels, all of its structures, noise of 20 HU.
BenchmarkPatient phantomPatient(int edge, const core::Progress& progress);

/// The largest CT series below `data` whose geometry is ok; null where there is none.
std::shared_ptr<const volume::IntensityVolume> realCt(const std::filesystem::path& data,
                                                      const core::Progress& progress);

/// That CT as a patient; nothing where there is none. Its structures are
/// stand-ins (a nerve, a sinus, a ball, placed behind the cavity): the data have none.
std::optional<BenchmarkPatient> realPatient(const std::filesystem::path& data,
                                            const core::Progress& progress);

} // namespace petrous::cli
