#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "petrous/Volume/IntensityVolume.h"
#include "petrous/Volume/LabelMap.h"

namespace petrous::dissection
{

/// Energy per unit volume that one burr needs, as a function of position: the removal law's
/// resistance w, N/mm^2 = N mm / mm^3 (RemovalLaw.h).
///
/// A voxel of a structure has that structure's resistance; elsewhere it depends on the intensity,
/// linear between two values. Immutable; queries are thread-safe.
class TissueResistance
{
public:
  struct Structure
  {
    std::shared_ptr<const volume::LabelMap> labels;
    std::uint16_t index = 0; ///< its voxel value in `labels`
    double resistance = 0.0; ///< N/mm^2, > 0
  };

  struct Ramp
  {
    double low = 300.0; ///< intensity, HU in a calibrated CT
    double high = 1800.0;
    double atLow = 0.0; ///< N/mm^2, > 0, at `low` and below
    double atHigh = 0.0;
  };

  /// Where structures overlap, the first one counts. Throws InvalidParameter if a resistance is not
  /// above 0 or the ramp does not increase in intensity.
  TissueResistance(std::shared_ptr<const volume::IntensityVolume> ct, const Ramp& ramp,
                   std::vector<Structure> structures);

  /// At a patient point, LPS mm.
  double at(const Eigen::Vector3d& patient) const;

private:
  struct Map
  {
    std::shared_ptr<const volume::LabelMap> labels;
    std::vector<std::uint32_t> order; // structure of each voxel value, or kNone
  };
  static constexpr std::uint32_t kNone = 0xffffffff;

  std::shared_ptr<const volume::IntensityVolume> m_ct;
  Ramp m_ramp;
  std::vector<Structure> m_structures;
  std::vector<Map> m_maps; // each label map once
};

} // namespace petrous::dissection
