#pragma once

#include <optional>
#include <string>
#include <vector>

#include "petrous/Scene/Case.h"

namespace petrous::scene
{

/// Goes to the state of `next` in the list, and in the voxels where they are loaded. Throws as
/// Dissection::follow does; nothing has changed then.
void follow(Case& value, dissection::History next);

/// Makes a branch (an approach) and goes on it: at the present state, or at that after the first
/// `after` strokes of the present branch, also of those that are undone. Throws InvalidParameter
/// where the name is taken or unfit, or the branch has not so many strokes.
void startBranch(Case& value, const std::string& name,
                 std::optional<std::size_t> after = std::nullopt);

/// Goes to a branch, to the state in which it was left. Throws InvalidParameter.
void goToBranch(Case& value, const std::string& name);

/// A name that drilling after an undo gave becomes one that somebody chose. Throws
/// InvalidParameter.
void renameBranch(Case& value, const std::string& from, const std::string& to);

/// Removes a branch that is not the present one, with the strokes that are on no other: these are
/// lost. Their count. Throws InvalidParameter.
std::size_t removeBranch(Case& value, const std::string& name);

/// What the strokes up to a state took.
struct StateSummary
{
  std::size_t strokes = 0;
  double removed = 0.0;                                 ///< mm^3
  std::vector<dissection::TouchedStructure> structures; ///< by name
};
StateSummary summaryOf(const Case& value, std::size_t state);

/// Throws InvalidParameter unless a branch can go by this name: 1 to 100 bytes of UTF-8, no control
/// characters, not a leading dash.
void checkBranchName(const std::string& name);

} // namespace petrous::scene
