#pragma once

#include "LawScene.h"
#include "petrous/Core/TickTimes.h"

namespace petrous::session
{

/// Volumes removed by a burr pressed on a block of bone for some time, mm^3.
struct RemovalRun
{
  double predicted = 0.0; ///< by the law, summed over the ticks with thrust
  double measured = 0.0;  ///< removed, supersampled from the mask, 512 points per cell
  double told = 0.0;      ///< removed, according to the drill's own balance
  double owed = 0.0;
  double forfeited = 0.0;
  double contact = 0.0;  ///< s
  core::TickTimes times; ///< of the steps that removed something

  double error() const ///< % of `predicted`, signed
  {
    return 100.0 * ((measured + owed + forfeited) / predicted - 1.0);
  }
  double balance() const { return told + owed + forfeited; }
  double taken() const { return measured + owed; }
};

/// Rate of the law for the set thrust and elevation, mm^3/s.
double lawRate(const testing::LawScene::Setting& setting);

/// Removal by the laws, for `seconds` of contact.
RemovalRun runByLaw(const testing::LawScene::Setting& setting, double seconds);

/// Removal as in the volumetric_drilling simulator [Munawar et al. 2021]: a tick with contact
/// deletes whole voxels, at most 1, 3, 6, 10 of them for burrs of 1, 2, 4, 6 mm (in between: as for
/// the next smaller), regardless of the force: the nearest ones overlapping the burr. It ends early
/// when `most` mm^3 are removed, so that the burr stays in the block.
///
/// Because the tool is held at the 1/2 level between the voxels, voxels within half a voxel of the
/// burr count as overlapping.
RemovalRun runByDeletion(const testing::LawScene::Setting& setting, double seconds, double most);

/// Maximum number of voxels deleted per tick.
int deletedPerTick(double diameter);

} // namespace petrous::session
