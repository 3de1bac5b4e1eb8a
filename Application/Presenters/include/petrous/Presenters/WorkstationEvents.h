#pragma once

#include <functional>
#include <string>

#include "petrous/Core/GridGeometry.h"

namespace petrous::presenters
{

/// What the window hears of the open case; each may be empty. Called after the change.
struct WorkstationEvents
{
  std::function<void()> caseChanged;       ///< another case
  std::function<void()> caseClosed;        ///< none is open any more
  std::function<void()> preparationWanted; ///< see WorkstationModel::preparation
  std::function<void()> partsChanged;      ///< images, structures or meshes came to the case
  std::function<void()> appearanceChanged; ///< threshold, or how a structure is shown
  std::function<void(const core::IndexBox&)> maskChanged; ///< in a box of CT voxels
  std::function<void()> crosshairMoved;
  std::function<void()> mrMoved;     ///< how an MR lies on the CT, or who signed that
  std::function<void()> toolPutAway; ///< since what was drawn on an MR moved; before mrMoved
  /// One stroke back (true) or forth, on request; the case's list is there already.
  std::function<void(bool back)> stepped;
  /// What the user should know of what was drilled and is not saved, or came back from a journal
  /// (Library::onNotice); one sentence.
  std::function<void(const std::string&)> noticed;
  std::function<void()> stateChanged; ///< name, saved or not, what can be undone
};

} // namespace petrous::presenters
