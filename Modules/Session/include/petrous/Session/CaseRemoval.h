#pragma once

#include "petrous/Scene/CaseMaterials.h"
#include "petrous/Session/BurrRemovalModel.h"

namespace petrous::session
{

/// The removal model of a burr in a case: tissue resistance and removal depth by the removal laws.
struct CaseRemoval
{
  /// tissue  of the case, evaluated before masking; must outlive this
  /// keep    structures that are not drilled
  /// Throws InvalidParameter naming the bad value.
  CaseRemoval(const scene::Case& value, const volume::TissueField& tissue,
              const dissection::ProtectedTissue& keep, const dissection::Burr& burr,
              const dissection::Catalogues& catalogues)
    : resistance(scene::tissueResistance(value, catalogues, burr))
    , search(tissue, resistance, keep, 0.5 * burr.diameter)
    , removalModel(search, burr, tissue.geometry().minSpacing())
  {
  }
  CaseRemoval(const CaseRemoval&) = delete;
  CaseRemoval& operator=(const CaseRemoval&) = delete;

  const dissection::TissueResistance resistance;
  dissection::RemovalDepthSolver search;
  BurrRemovalModel removalModel;
};

} // namespace petrous::session
