#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "petrous/Dissection/RemovedVolume.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::session
{

/// A case as seen by the drill: tissue field, protected tissue, and what a stroke removed.
///
/// The case must have its dissection loaded and outlive the session; a change of its structures or
/// surface threshold requires a new session. Not thread-safe.
class DrillSession
{
public:
  /// regional: protected tissue is computed only around the cuts (scene::protectedTissue): for
  /// little drilling in a single thread. Throws CancelledError.
  explicit DrillSession(scene::Case& value, const core::Progress& progress = {},
                        bool regional = false);

  /// A session for a case with the same structures as that of `like` (a copy of it, which may be
  /// gone), whatever its threshold and cut mask; what was derived from the structures is shared.
  DrillSession(scene::Case& value, const DrillSession& like);

  /// The current field; follows the cut mask.
  const volume::TissueField& field() const noexcept { return m_field; }

  /// Tissue that the drill must not remove.
  const dissection::ProtectedTissue& protectedTissue() const noexcept { return m_keep; }

  /// Drill off: measures what the open stroke removed and adds it to the case's history. Returns
  /// nullptr if none is open or it changed nothing.
  std::shared_ptr<const dissection::Stroke> end();

  /// What the open stroke of a dissection of this case, or of a copy, has removed so far. Reads no
  /// member that drilling changes, so other threads may call it.
  dissection::RemovedVolume measure(const dissection::Dissection& work) const;

  /// `measure` as a function object that may outlive this.
  std::function<dissection::RemovedVolume(const dissection::Dissection&)> measurer() const;

private:
  scene::Case& m_case;
  volume::TissueField m_field;
  dissection::ProtectedTissue m_keep;
  std::vector<dissection::NamedStructure> m_structures;
};

/// Now, UTC, ISO 8601 with seconds.
std::string utcNow();

} // namespace petrous::session
