#include "petrous/Dissection/ExposedArea.h"

#include <cmath>

#include "petrous/Volume/SurfaceArea.h"

namespace petrous::dissection
{

namespace
{

constexpr double kStep = 0.1;   // mm, sampling step along the normal
constexpr double kAir = -300.0; // HU: no soft tissue below it

class Cover
{
public:
  Cover(const volume::TissueField& tissue, const volume::CutMask& mask)
    : m_tissue(tissue)
    , m_mask(mask)
  {
  }

  bool laidOpen(const Eigen::Vector3d& point, const Eigen::Vector3d& outward) const
  {
    const int last = static_cast<int>(std::lround((kLayer + kCover) / kStep));
    if (!drilledNear(point, point + last * kStep * outward))
      return false;
    const bool cutItself = isCut(point);
    bool air = false;
    int first = 0; // first sample in the cover, from 1
    for (int n = 1; n <= last; ++n)
    {
      const Eigen::Vector3d place = point + n * kStep * outward;
      if (!(m_tissue.uncut(place) > 0.0))
      {
        air = air || isAir(place);
        if (first == 0 && n * kStep > kLayer - 0.5 * kStep)
          return false;
        continue;
      }
      if (first == 0)
        first = n;
      const double from = n * kStep;
      if (first == n && air && from > kCover + 0.5 * kStep)
        return false; // it was open to an air cell
      // Exposed means free up to kCover from the structure or its soft-tissue layer.
      const double begin = first * kStep <= kCover + 0.5 * kStep ? 0.0 : (first - 1) * kStep;
      if (from - begin > kCover + 0.5 * kStep)
        break;
      if (!cutItself && !isCut(place))
        return false;
    }
    return first > 0;
  }

private:
  bool drilledNear(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const
  {
    return !m_mask.untouched(m_mask.geometry().boxCovering(a.cwiseMin(b), a.cwiseMax(b)));
  }

  bool isCut(const Eigen::Vector3d& patient) const
  {
    const Eigen::Vector3d voxel = m_mask.geometry().voxelFromPatient(patient);
    return m_mask.geometry().hullContains(voxel) && m_mask.sample(voxel) <= 0.5;
  }

  bool isAir(const Eigen::Vector3d& patient) const
  {
    const Eigen::Vector3d voxel = m_tissue.geometry().voxelFromPatient(patient);
    return !m_tissue.geometry().hullContains(voxel) || m_tissue.ct()->sample(voxel) < kAir;
  }

  const volume::TissueField& m_tissue;
  const volume::CutMask& m_mask;
};

} // namespace

double exposedArea(const volume::TissueField& tissue, const volume::CutMask& mask,
                   const volume::Volume<float>& occupancy, const core::Progress& progress)
{
  if (mask.untouched())
    return 0.0;
  const Cover cover(tissue, mask);
  return volume::surfaceArea(
      occupancy,
      [&cover](const Eigen::Vector3d& point, const Eigen::Vector3d& outward)
      { return cover.laidOpen(point, outward); },
      progress);
}

} // namespace petrous::dissection
