#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "petrous/Dissection/RemovedVolume.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::presenters
{

/// A case as the drill knows it: its field, what is left alone, and what a stroke removed.
///
/// The case must have its dissection loaded and outlive the session; a change of its structures or
/// surface threshold asks for a new session. One thread.
class DrillSession
{
public:
  /// regional: what is left alone is worked out round the cuts (scene::protectedTissue): for who
  /// drills little, in one thread. Throws CancelledError.
  explicit DrillSession(scene::Case& value, const core::Progress& progress = {},
                        bool regional = false);

  /// One for a case with the same structures as that of `like` (a copy of it, which may be gone),
  /// whatever its threshold and its cut; what was made of the structures is shared.
  DrillSession(scene::Case& value, const DrillSession& like);

  /// The field as it stands now; follows the cut.
  const volume::TissueField& field() const noexcept { return m_field; }

  /// What the drill must leave.
  const dissection::ProtectedTissue& protectedTissue() const noexcept { return m_keep; }

  /// Drill off: measures what the open stroke removed and lists it in the case. Null when there is
  /// none, or it changed nothing.
  std::shared_ptr<const dissection::Stroke> end();

  /// What the open stroke of a dissection of this case, or of a copy, has removed so far. Pure: of
  /// what this holds it reads nothing that drilling changes, so that another thread may ask.
  dissection::RemovedVolume measure(const dissection::Dissection& work) const;

  /// The same by itself, also when this is gone.
  std::function<dissection::RemovedVolume(const dissection::Dissection&)> measurer() const;

private:
  scene::Case& m_case;
  volume::TissueField m_field;
  dissection::ProtectedTissue m_keep;
  std::vector<dissection::NamedStructure> m_structures;
};

/// Now, UTC, ISO 8601 with seconds.
std::string utcNow();

} // namespace petrous::presenters
