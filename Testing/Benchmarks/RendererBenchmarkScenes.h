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
core::CameraPose cameraOf(const BenchmarkPatient& patient, BenchmarkView view);

} // namespace petrous::cli
