#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::cli
{

struct RendererBenchmarkOptions
{
  bool quick = false;     ///< 96^3, small pictures, few frames
  std::vector<int> edges; ///< edge lengths of the phantom, voxels, 16 to 1024; empty: 256 and 512
  std::filesystem::path data;     ///< folder with a real CT; empty: phantom only
  std::set<std::string> parts;    ///< of rendererParts(); empty: all
  std::filesystem::path paraview; ///< pvpython; empty: as found in PATH
  std::filesystem::path work;     ///< folder for what pvpython reads and writes
};

const std::vector<std::string>& rendererParts();

/// The volume renderer and VTK's mappers in the same window, on the phantom (256^3, 512^3) and on a
/// real CT: frames of 640 x 480, error against the reference ray caster at 320 x 240, a sweep of
/// every setting of RenderQuality, first hits on a plane and a ball, stereo of 2 x 1920 x 1080, and
/// mask edits. Each frame is waited for; those of 640 x 480 are read back.
///
/// error: RMS of the colour, 1/255, over pixels whose first hits agree within half a voxel; the
/// others are in extra["mismatch_percent"]. NaN for peers, whose optical models differ.
///
/// Soft tissue alone, at the largest size, is emission and absorption in all programs: there the
/// error is over all pixels of the same 640 x 480, of peers too, at rest and of a frame as it is
/// drawn while the camera moves.
///
/// Features, at the smallest size: see featurePoints. ParaView's volume shadows, at the
/// largest: see paraViewPoints.
core::BenchmarkReport runRendererBenchmark(const RendererBenchmarkOptions& options,
                                           const core::Progress& progress);

} // namespace petrous::cli
