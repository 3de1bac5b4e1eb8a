#pragma once

#include "LawScene.h"
#include "petrous/Core/TickTimes.h"

namespace petrous::simulation
{

/// What a burr that is pressed on a block of bone for a while has taken, mm^3.
struct RemovalRun
{
  double predicted = 0.0; ///< the law, summed over the ticks with thrust
  double measured = 0.0;  ///< gone, supersampled from the mask, 512 points a cell
  double told = 0.0;      ///< gone, as the drill's own balance says
  double owed = 0.0;
  double forfeited = 0.0;
  double contact = 0.0;  ///< s
  core::TickTimes times; ///< of the steps that took something

  double error() const ///< % of what is predicted, signed
  {
    return 100.0 * ((measured + owed + forfeited) / predicted - 1.0);
  }
  double balance() const { return told + owed + forfeited; }
  double taken() const { return measured + owed; }
};

/// mm^3/s that the law gives for the set thrust at the set elevation.
double lawRate(const testing::LawScene::Setting& setting);

/// By the laws, for `seconds` of contact.
RemovalRun runByLaw(const testing::LawScene::Setting& setting, double seconds);

/// By the rule of the volumetric_drilling simulator [Munawar et al. 2021]: a tick with contact
/// deletes whole voxels, at most 1, 3, 6, 10 of them for burrs of 1, 2, 4, 6 mm (between them: of
/// the next smaller), whatever the force: the nearest of those that the burr overlaps. It ends
/// early, when `most` mm^3 are gone, so that the burr stays in the block.
///
/// As the tool is held on the 1/2 level between the voxels, it counts as overlapped what lies
/// within half a voxel of the burr.
RemovalRun runByDeletion(const testing::LawScene::Setting& setting, double seconds, double most);

/// The most whole voxels that a tick deletes.
int deletedPerTick(double diameter);

} // namespace petrous::simulation
