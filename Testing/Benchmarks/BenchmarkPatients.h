#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Appearance/Material.h"
#include "petrous/Core/Progress.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/CutMask.h"
#include "petrous/Volume/IntensityVolume.h"
#include "petrous/Volume/LabelField.h"
#include "petrous/Volume/LabelMap.h"

namespace petrous::cli
{

constexpr double kBenchmarkIso = 300.0; // HU

/// A patient for drawing and touch: CT, structures, and a cavity drilled into the mastoid with a 4
/// mm burr.
struct BenchmarkPatient
{
  std::string name; ///< anonymous
  std::shared_ptr<const volume::IntensityVolume> ct;
  std::shared_ptr<const volume::LabelMap> labelMap;
  std::shared_ptr<const volume::LabelField> labels; ///< of labelMap
  std::vector<appearance::Material> structures;     ///< row i - 1: index i of the labels
  std::shared_ptr<volume::CutMask> mask;
  Eigen::Vector3d entry{0.0, 0.0, 0.0};   ///< on the cortex, at the cavity's centre; patient LPS mm
  Eigen::Vector3d lateral{1.0, 0.0, 0.0}; ///< unit, out of the head
};

/// The built-in phantom on edge^3 voxels, with all of its structures and noise of 20 HU.
BenchmarkPatient phantomPatient(int edge, const core::Progress& progress);

/// The largest CT series below `data` with valid geometry; null if there is none.
std::shared_ptr<const volume::IntensityVolume> realCt(const std::filesystem::path& data,
                                                      const core::Progress& progress);

/// The CT of realCt as a patient; nullopt if there is none. The data have no structures, so
/// placeholders are put behind the cavity (a nerve, a sinus, a ball).
std::optional<BenchmarkPatient> realPatient(const std::filesystem::path& data,
                                            const core::Progress& progress);

/// A case to be touched and drilled, in which structures without a lumen are solid.
scene::Case touchCaseOf(const BenchmarkPatient& patient);

} // namespace petrous::cli
