#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "BenchmarkPatients.h"
#include "RendererAccuracy.h"
#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::cli
{

struct ParaViewOptions
{
  std::filesystem::path pvpython; ///< empty: as found in PATH
  std::filesystem::path work;     ///< for the volume and the pictures
  PictureSize picture;
  int frames = 3;       ///< at most, after the first
  double seconds = 5.0; ///< no further frame is begun after that many
};

/// The CT alone near the cavity, opaque, in volume shadows: ours, and those of ParaView's VTK 9.2
/// (vtkGPUVolumeRayCastMapper with GlobalIlluminationReach and VolumetricScatteringBlending), drawn
/// by pvpython in a process of its own, with the same camera, size, sampling distance, transfer
/// function and lamp; and both without shadows. extra of the peers: times_ours, and
/// difference_rms, 1/255 over all pixels, from our picture.
///
/// Without pvpython, or where it fails, `notes` says so and there is no peer.
std::vector<core::BenchmarkPoint> paraViewPoints(const BenchmarkPatient& patient,
                                                 const ParaViewOptions& options,
                                                 std::map<std::string, std::string>& notes,
                                                 const core::Progress& progress);

} // namespace petrous::cli
