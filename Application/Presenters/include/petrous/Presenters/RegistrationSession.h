#pragma once

#include <optional>
#include <string>
#include <vector>

#include "petrous/Presenters/CaseRegistration.h"
#include "petrous/Presenters/LandmarkList.h"
#include "petrous/Presenters/MrMotion.h"
#include "petrous/Presenters/SliceOverlay.h"
#include "petrous/Presenters/WorkstationModel.h"
#include "petrous/Scene/ReferenceFrames.h"

namespace petrous::presenters
{

/// What the surgeon wants of a registration, before it begins.
struct RegistrationAim
{
  enum class Start
  {
    Header,  ///< as the files say
    Centres, ///< the images' middles on each other
    Present  ///< where the MR lies now
  };
  enum class Place
  {
    MiddleEar, ///< see defaultPlace
    Crosshair,
    Structure ///< `structure`
  };
  Start start = Start::Header;
  Place place = Place::MiddleEar; ///< where the error is stated
  std::string structure;
  double box = 0.0; ///< mm, edge of the box about the crosshair that counts; 0: the whole CT
  std::string onto; ///< another MR; empty: the CT
};

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

  /// What cannot be chosen (any longer) is as if it had not been.
  const RegistrationAim& aim() const noexcept { return m_aim; }
  void setAim(const RegistrationAim& aim);
  std::vector<std::string> ontoNames() const;  ///< MRs that may be RegistrationAim::onto
  std::vector<std::string> placeNames() const; ///< what may be RegistrationAim::structure

  enum class Way
  {
    Register, ///< as the aim says, looking around
    Refine,   ///< from where the MR lies
    Landmarks ///< where the pairs of points put it, without a fit
  };
  /// For registerMr; only where the case has an MR.
  RegistrationRequest request(Way way) const;
  /// Takes over what came of that. A failed one changes nothing, and nothing is taken while the
  /// drill runs. Returns whether it was taken.
  bool take(const RegistrationOutcome& outcome);
  /// Where a registration had come when it was stopped: not judged.
  void keep(const core::RigidTransform& best);

  bool lies(const core::RigidTransform& mrFromCt) const; ///< whether it is registered so now

  void unregister();
  /// Throws InvalidParameter for no name, or an MR that is not registered.
  void signOff(const std::string& who, const std::string& when);

  bool canUndo() const noexcept { return !m_undo.empty(); }
  bool canRedo() const noexcept { return !m_redo.empty(); }
  void undo(); ///< one change of how MRs lie; a sign-off does not come back
  void redo();

private:
  using Places = std::vector<scene::MrPlace>;

  void checkAim();
  void restore(const Places& places);
  void change(const std::function<void(scene::Case&)>& what);
  void lay(const core::RigidTransform& mrFromCt, const scene::Registration& how);
  void moveByHand(const core::RigidTransform& mrFromCt);

  WorkstationModel& m_model;
  std::string m_name;
  LandmarkList m_landmarks;
  core::RigidTransform m_fitted; // the last that was not by hand
  RegistrationAim m_aim;
  std::vector<Places> m_undo;
  std::vector<Places> m_redo;
};

} // namespace petrous::presenters
