#pragma once

#include <functional>
#include <string>

#include "petrous/Core/GridGeometry.h"

namespace petrous::presenters
{

/// Events of the open case for the window; each may be empty. Called after the change.
struct WorkstationEvents
{
  std::function<void()> caseChanged;       ///< another case
  std::function<void()> caseClosed;        ///< none is open any more
  std::function<void()> preparationWanted; ///< see WorkstationModel::preparation
  std::function<void()> partsChanged;      ///< images, structures or meshes were added to the case
  /// A part has another name, also by undo or redo; before partsChanged. What is selected by name
  /// goes along.
  std::function<void(const std::string& from, const std::string& to)> partRenamed;
  std::function<void()> appearanceChanged; ///< threshold, or a structure's appearance
  std::function<void(const core::IndexBox&)> maskChanged; ///< within a box of CT voxels
  std::function<void()> crosshairMoved;
  std::function<void()> attachmentsChanged;
  std::function<void()> measurementsChanged;
  std::function<void()> savedViewsChanged; ///< kept, removed, or that undone
  /// Before a branch is left: what is seen is to be given to the case (setCamera, setView), as the
  /// view that the branch is left with.
  std::function<void()> viewWanted;
  std::function<void()> viewChanged; ///< to another branch's: camera and slices of the case
  std::function<void()> mrMoved;     ///< an MR's registration or its sign-off changed
  std::function<void()> toolPutAway; ///< since a structure drawn on an MR moved; before mrMoved
  /// One stroke undone (true) or redone, on request; the case's history is already updated.
  std::function<void(bool back)> stepped;
  /// What the user should know about unsaved removal, or about what was recovered from a journal
  /// (Library::onNotice); one sentence.
  std::function<void(const std::string&)> noticed;
  std::function<void()> stateChanged; ///< name, saved or not, what can be undone
  /// WorkstationModel::recording changed; why, one sentence, if it ended unasked, else empty.
  std::function<void(const std::string& fault)> recordingChanged;
};

} // namespace petrous::presenters
