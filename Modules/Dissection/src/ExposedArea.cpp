#include "petrous/Dissection/ExposedArea.h"

#include <array>

#include "petrous/Volume/SurfaceArea.h"

namespace petrous::dissection
{

namespace
{

constexpr int kPlaces = 5; // before a point of the surface

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
    const bool cutItself = isCut(point);
    std::array<Eigen::Vector3d, kPlaces> places;
    std::array<bool, kPlaces> cut{};
    bool any = cutItself;
    for (std::size_t n = 0; n < kPlaces; ++n)
    {
      places[n] = point + kCover * static_cast<double>(n + 1) / kPlaces * outward;
      cut[n] = isCut(places[n]);
      any = any || cut[n];
    }
    if (!any)
      return false; // nothing was drilled here: no need to look at the tissue
    bool covered = false;
    for (std::size_t n = 0; n < kPlaces; ++n)
      if (m_tissue.uncut(places[n]) > 0.0)
      {
        covered = true;
        if (!cut[n] && !cutItself)
          return false;
      }
    return covered;
  }

private:
  bool isCut(const Eigen::Vector3d& patient) const
  {
    const Eigen::Vector3d voxel = m_mask.geometry().voxelFromPatient(patient);
    return m_mask.geometry().hullContains(voxel) && m_mask.sample(voxel) <= 0.5;
  }

  const volume::TissueField& m_tissue;
  const volume::CutMask& m_mask;
};

} // namespace

double exposedArea(const volume::TissueField& tissue, const volume::CutMask& mask,
                   const volume::Volume<float>& share, const core::Progress& progress)
{
  if (mask.untouched())
    return 0.0;
  const Cover cover(tissue, mask);
  return volume::surfaceArea(
      share,
      [&cover](const Eigen::Vector3d& point, const Eigen::Vector3d& outward)
      { return cover.laidOpen(point, outward); },
      progress);
}

} // namespace petrous::dissection
