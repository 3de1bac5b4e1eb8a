#pragma once

#include <optional>
#include <string>
#include <vector>

#include "petrous/Presenters/LandmarkList.h"
#include "petrous/Presenters/MrMotion.h"
#include "petrous/Presenters/SliceOverlay.h"
#include "petrous/Presenters/WorkstationModel.h"
#include "petrous/Registration/Register.h"

namespace petrous::presenters
{

/// Lays one MR of the open case on its CT by every way there is, and back again. The case has each
/// change at once; it is saved with the case. Without Qt, one thread.
class RegistrationSession
{
public:
  /// The model must outlive this.
  explicit RegistrationSession(WorkstationModel& model);

  void caseChanged(); ///< forgets all; the first MR is chosen

  void choose(const std::string& mr); ///< landmarks go; undo goes on
  const std::string& mr() const noexcept { return m_name; }
  std::vector<std::string> mrNames() const; ///< of the case
  const scene::ImagePart* part() const;     ///< null where the case has no MR
  std::string stateInWords() const;         ///< "not registered", or how, how well, and who signed

  /// Moves by hand, of the picture over the CT, about the crosshair; steps of 0.1 and 1 mm or
  /// degree are the user's. The record says "by hand, not judged".
  void shift(const Eigen::Vector3d& millimetres);
  void turn(const Eigen::Vector3d& axis, double degrees);
  void bringMiddleHere(); ///< the MR's middle to the crosshair, for images far apart
  /// How far the crosshair's point moved since the last fit (or since the MR was chosen).
  MrDifference movedByHand() const;

  LandmarkList& landmarks() noexcept { return m_landmarks; }
  void addLandmark(); ///< at the crosshair: in the CT, and then in the MR
  /// Throws InvalidParameter where the pairs do not tell a place.
  void fitLandmarks();

  /// What a registration from here begins with; `search`: over 40 mm and 40 degrees.
  registration::FitOptions fitOptions(bool search) const;
  /// Takes over a result, with the place where its error is stated in words. A failed one changes
  /// nothing. Returns whether it was taken.
  bool take(const registration::Registration& result, const std::string& place);
  /// Where a registration had come when it was stopped: not judged.
  void keep(const core::RigidTransform& best);

  void unregister();
  /// Throws InvalidParameter for no name, or an MR that is not registered.
  void signOff(const std::string& who, const std::string& when);

  bool canUndo() const noexcept { return !m_undo.empty(); }
  bool canRedo() const noexcept { return !m_redo.empty(); }
  void undo(); ///< one change of how MRs lie; a sign-off does not come back
  void redo();

private:
  struct Lie // of one MR
  {
    std::string name;
    core::RigidTransform mrFromCt;
    bool registered = false;
    std::optional<scene::Registration> registration;
  };
  using Lies = std::vector<Lie>;

  Lies lies() const;
  void restore(const Lies& lies);
  void change(const std::function<void(scene::Case&)>& what);
  void lay(const core::RigidTransform& mrFromCt, const scene::Registration& how);
  void moveByHand(const core::RigidTransform& mrFromCt);

  WorkstationModel& m_model;
  std::string m_name;
  LandmarkList m_landmarks;
  core::RigidTransform m_fitted; // the last that was not by hand
  std::vector<Lies> m_undo;
  std::vector<Lies> m_redo;
};

} // namespace petrous::presenters
