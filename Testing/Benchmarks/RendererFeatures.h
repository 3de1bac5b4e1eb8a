#pragma once

#include <vector>

#include "BenchmarkPatients.h"
#include "RendererAccuracy.h"
#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::cli
{

/// How much of the features is measured.
struct FeatureExtent
{
  PictureSize picture;      ///< timed
  PictureSize errorPicture; ///< compared with the reference
  int frames = 9;           ///< at least, with the feature and without
};

/// A frame near the cavity with each feature of the picture and without it, in turns in one window:
/// shadows (and with them occlusion and the lamp alone), edges, grain, exits, light, sections, soft
/// tissue of the CT and of an MR, tools, a drilled mesh, and a card that rounds the weights of its
/// filter.
///
/// seconds: with the feature. extra: without_ms, share_percent of the frame, fetches_per_pixel and
/// fetches_per_pixel_without. error: against the reference with the feature, as in
/// runRendererBenchmark; of occlusion and lamp alone, RMS relative to full occlusion.
std::vector<core::BenchmarkPoint> featurePoints(const BenchmarkPatient& patient,
                                                const FeatureExtent& extent,
                                                const core::Progress& progress);

} // namespace petrous::cli
