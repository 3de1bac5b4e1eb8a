#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/CameraPose.h"
#include "petrous/Core/Progress.h"
#include "petrous/Rendering/SceneContents.h"

namespace petrous::cli
{

/// A patient to draw: CT, structures, and a cavity that a 4 mm burr opened in the mastoid.
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

/// The largest readable CT series below `data`; nothing where there is none. Its structures are
/// stand-ins (a nerve, a sinus, a ball, placed behind the cavity): the data have none.
std::optional<BenchmarkPatient> realPatient(const std::filesystem::path& data,
                                            const core::Progress& progress);

enum class BenchmarkLook
{
  Translucent, ///< bone's surface lets 65 % through; structures; cut
  Opaque,      ///< opaque bone; structures; cut
  CtAlone      ///< opaque bone as it was scanned
};
enum class BenchmarkView
{
  Head, ///< all of it, from the side
  Near  ///< the cavity, as through a microscope
};

std::string nameOf(BenchmarkLook look);
std::string nameOf(BenchmarkView view);
rendering::SceneContents contentsOf(const BenchmarkPatient& patient, BenchmarkLook look);
core::CameraPose cameraOf(const BenchmarkPatient& patient, BenchmarkView view);

} // namespace petrous::cli
