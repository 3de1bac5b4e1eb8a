#include "PhantomPairs.h"

#include <cmath>

#include "petrous/Phantom/Phantom.h"

namespace petrous::cli
{

namespace
{

using phantom::Phantom;
using registration::Vector3d;

constexpr double kMargin = 10.0;   // mm of MR beyond the ear
constexpr double kMrUnit = 1000.0; // scale of the phantom's MR, for a contrast of about 1

core::GridGeometry around(const Vector3d& center, const Vector3d& extent, const Vector3d& spacing)
{
  core::Index3 dims{};
  Vector3d origin = center;
  for (Eigen::Index a = 0; a < 3; ++a)
  {
    const int n = static_cast<int>(std::ceil(extent[a] / spacing[a]));
    dims[static_cast<std::size_t>(a)] = n;
    origin[a] -= 0.5 * spacing[a] * (n - 1);
  }
  return {dims, spacing, origin};
}

std::shared_ptr<const volume::Volume<std::int16_t>>
scanned(const Phantom& phantom, const core::GridGeometry& grid, Phantom::Modality modality,
        double noise, const core::RigidTransform& patientFromScan, const core::Progress& progress)
{
  phantom::ScanSettings settings;
  settings.modality = modality;
  settings.noise = noise;
  settings.seed = phantom.recipe().seed;
  settings.patientFromScan = patientFromScan;
  return std::make_shared<const volume::Volume<std::int16_t>>(
      phantom::samplePhantom(phantom, grid, settings, progress));
}

} // namespace

registration::SimulationBody phantomBody(bool quick, const core::Progress& progress)
{
  const Phantom phantom;
  const double spacing = quick ? 1.0 : 0.5;
  registration::SimulationBody body;
  body.name = "phantom";
  body.ears = {Phantom::center()};
  body.ct = std::make_shared<const volume::IntensityVolume>(
      scanned(phantom, around(Phantom::center(), Phantom::extent(), Vector3d::Constant(spacing)),
              Phantom::Modality::Ct, 20.0, {}, progress.part(0.0, 0.3)));
  // Larger than the CT: an MR with other axes extends beyond it.
  const core::GridGeometry wide = around(
      Phantom::center(), Phantom::extent() + Vector3d::Constant(40.0), Vector3d::Constant(spacing));
  const auto mr = scanned(phantom, wide, Phantom::Modality::Mr, 0.0, {}, progress.part(0.3, 0.6));
  auto t2 = std::make_shared<volume::Volume<float>>(wide);
  for (std::size_t n = 0; n < t2->size(); ++n)
    t2->data()[n] = static_cast<float>(mr->data()[n] / kMrUnit);
  body.contrasts.push_back({"T2", t2});
  const volume::IntensityVolume still(
      scanned(phantom, wide, Phantom::Modality::Ct, 0.0, {}, progress.part(0.6, 0.9)));
  body.contrasts.push_back(
      {"T1", std::make_shared<const volume::Volume<float>>(
                 registration::mrContrastOf(still, registration::MrContrast::T1, 1))});
  return body;
}

registration::RegistrationPair phantomPair(std::uint64_t seed, bool quick,
                                           const core::Progress& progress)
{
  const Phantom phantom(phantom::PhantomRecipe{seed, true});
  const core::RigidTransform motion = phantom.mrFromCt();
  const Vector3d center = Phantom::center();
  const double coarse = quick ? 2.0 : 1.0;
  registration::RegistrationPair pair;
  pair.name = "phantom patient " + std::to_string(seed);
  pair.ct = std::make_shared<const volume::IntensityVolume>(
      scanned(phantom, around(center, Phantom::extent(), Vector3d::Constant(0.4 * coarse)),
              Phantom::Modality::Ct, 20.0, {}, progress));
  pair.mr = std::make_shared<const volume::IntensityVolume>(
      scanned(phantom,
              around(motion * center, Phantom::extent() + Vector3d::Constant(kMargin),
                     coarse * Vector3d(0.6, 0.6, 0.8)),
              Phantom::Modality::Mr, 12.0, motion.inverse(), progress));
  pair.truth = [motion](const Vector3d& p) { return motion * p; };
  pair.targets = {center};
  return pair;
}

} // namespace petrous::cli
