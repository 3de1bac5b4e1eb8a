#pragma once

#include <string>

#include "BenchmarkPatients.h"
#include "petrous/Core/CameraPose.h"
#include "petrous/Rendering/SceneContents.h"

namespace petrous::cli
{

enum class BenchmarkLook
{
  Translucent, ///< bone surface with a transmittance of 65 %; structures; cut
  Opaque,      ///< opaque bone; structures; cut
  CtAlone      ///< opaque bone as scanned
};
enum class BenchmarkView
{
  Head, ///< whole head, from the side
  Near  ///< the cavity, as through a microscope
};

std::string nameOf(BenchmarkLook look);
std::string nameOf(BenchmarkView view);
rendering::SceneContents contentsOf(const BenchmarkPatient& patient, BenchmarkLook look);
/// All of the CT as soft tissue, skin, fat, muscle and bone by one transfer function, in light that
/// has no direction: emission and absorption alone, which other programs draw, too. `isLit`: in the
/// light of a new case instead, by the tissue's gradient.
rendering::SceneContents softTissueOf(const BenchmarkPatient& patient, bool isLit = false);
core::CameraPose cameraOf(const BenchmarkPatient& patient, BenchmarkView view);

} // namespace petrous::cli
