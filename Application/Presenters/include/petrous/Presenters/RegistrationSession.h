#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Presenters/CaseRegistration.h"
#include "petrous/Presenters/LandmarkList.h"
#include "petrous/Presenters/MrMotion.h"
#include "petrous/Presenters/SliceOverlay.h"
#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::presenters
{

/// Settings of a registration.
struct RegistrationAim
{
  enum class Start
  {
    Header,  ///< as in the image headers
    Centres, ///< image centres aligned
    Present  ///< the MR's current registration
  };
  enum class Place
  {
    MiddleEar, ///< see defaultPlace
    Crosshair,
    Structure ///< `structure`
  };
  Start start = Start::Header;
  Place place = Place::MiddleEar; ///< where the error is estimated
  std::string structure;
  double box = 0.0; ///< mm, edge of the box about the crosshair to fit in; 0: the whole CT
  std::string onto; ///< another MR; empty: the CT
};

/// A structure or mesh at whose middle a registration's error can be stated.
struct PlaceChoice
{
  std::string name;
  bool isMesh = false;
  std::string drawnOn = {}; ///< the MR; empty: the primary image
  double volume = 0.0;      ///< mm^3, of a structure
  /// Whether its name and that of another differ by a number at the end only, as of what was added
  /// under a name that was taken.
  bool isAlike = false;
};

/// Registers one MR of the open case to its CT in every available way. Changes take effect in the
/// case at once, are saved with it, and are steps of WorkstationModel::undo, manual motions that
/// come quickly after one another a single one. Without Qt; not thread-safe.
class RegistrationSession
{
public:
  /// The model must outlive this.
  explicit RegistrationSession(WorkstationModel& model);

  void caseChanged(); ///< resets everything; selects the first MR
  /// Other parts of the same case. True if the MR that was chosen is still there, also under
  /// another name: it stays chosen, with its landmarks, which stay on their voxels where its axes
  /// were corrected. Else as caseChanged.
  bool partsChanged();

  void choose(const std::string& mr); ///< clears the landmarks
  /// Chooses the MR that was added last of those that are not registered, unless the present one is
  /// none of these or has landmarks. Whether it did.
  bool preferUnregistered();
  const std::string& mr() const noexcept { return m_name; }
  std::vector<std::string> mrNames() const; ///< of the case
  const scene::ImagePart* part() const;     ///< nullptr if the case has no MR
  bool hasCase() const noexcept { return m_model.hasCase(); }
  std::string primary() const;   ///< "CT", or "primary MR": what MRs are registered to
  std::string stateText() const; ///< "not registered", or how, how well, signed by

  /// Manual motion of the MR overlay on the CT, rotation about the crosshair; the user interface
  /// has steps of 0.1 and 1 mm or degree. Recorded as "by hand, not judged".
  void shift(const Eigen::Vector3d& millimetres);
  void turn(const Eigen::Vector3d& axis, double degrees);
  void bringMiddleHere(); ///< moves the MR's centre to the crosshair, for images far apart
  /// How far the MR moved at the crosshair since the last fit (or since the MR was chosen).
  MrDifference movedByHand() const;

  LandmarkList& landmarks() noexcept { return m_landmarks; }
  void addLandmark(); ///< at the crosshair: alternately in the CT and in the MR

  /// Settings that are not, or no longer, available are reset.
  const RegistrationAim& aim() const noexcept { return m_aim; }
  void setAim(const RegistrationAim& aim);
  std::vector<std::string> ontoNames() const;    ///< MRs that may be RegistrationAim::onto
  std::vector<std::string> placeNames() const;   ///< what may be RegistrationAim::structure
  std::vector<PlaceChoice> placeChoices() const; ///< these, in the same order

  /// Why the error is not stated at the middle ear although the aim says so, where instead, and
  /// what to do; empty otherwise.
  std::string placeNote() const;

  enum class Way
  {
    Register, ///< as set by the aim, with a search
    Refine,   ///< from the current registration
    Landmarks ///< from the landmark pairs, without a fit
  };
  /// For registerMr; requires an MR.
  RegistrationRequest request(Way way) const;
  /// Applies the outcome. No effect if it failed or while drilling. Returns whether it was applied.
  /// Throws Error (Refused) if the axes of one of its MRs were corrected since it began.
  bool take(const RegistrationOutcome& outcome);
  /// Applies the result so far of an aborted registration: not judged.
  void keep(const core::RigidTransform& best);

  bool lies(const core::RigidTransform& mrFromCt) const; ///< is the current registration

  void unregister();
  /// Throws InvalidParameter for an empty name or an MR that is not registered.
  void signOff(const std::string& who, const std::string& when);

  /// WorkstationModel::undoMr; a sign-off is not restored.
  bool canUndo() const noexcept { return m_model.canUndoMr(); }
  bool canRedo() const noexcept { return m_model.canRedoMr(); }
  void undo() { m_model.undoMr(); }
  void redo() { m_model.redoMr(); }
  std::string undoText() const { return m_model.undoMrText(); } ///< empty: nothing
  std::string redoText() const { return m_model.redoMrText(); }

private:
  void checkAim();
  void followGrid();
  void moveByHand(const core::RigidTransform& mrFromCt);

  WorkstationModel& m_model;
  std::string m_name;
  std::vector<std::string> m_mrs;           // known
  std::optional<core::GridGeometry> m_grid; // of the chosen MR, in which the landmarks lie
  LandmarkList m_landmarks;
  core::RigidTransform m_fitted; // the last one not set by hand
  RegistrationAim m_aim;
};

} // namespace petrous::presenters
