#pragma once

#include <optional>
#include <string>
#include <vector>

#include "petrous/Scene/Case.h"

namespace petrous::scene
{

/// Creates a branch (an approach) and switches to it: at the current state, or at the state after
/// the first `after` strokes of the current branch, including undone ones. Throws InvalidParameter
/// if the name is taken or invalid, or if the branch has fewer strokes, and what
/// Dissection::follow throws, as the functions below.
void startBranch(Case& value, const std::string& name,
                 std::optional<std::size_t> after = std::nullopt);

/// Switches to a branch, in the state in which it was left, and to the view that it was left with
/// (ViewState::branches); without a camera in that, to the one of its last applied stroke, else
/// none other. Throws InvalidParameter.
void goToBranch(Case& value, const std::string& name);

/// Goes to a state of a branch, between the start and its tip, as goToBranch does if that is
/// another one; the strokes after it can be redone. Throws InvalidParameter if the state is not on
/// the branch.
void goToState(Case& value, const std::string& branch, std::size_t state);

/// Replaces the automatic name of a branch, created by drilling after an undo, by a chosen one.
/// Throws InvalidParameter.
void renameBranch(Case& value, const std::string& from, const std::string& to);

/// Removes a branch other than the current one, with the strokes that are on no other branch; these
/// are lost. Returns their number. Throws InvalidParameter.
std::size_t removeBranch(Case& value, const std::string& name);

/// The case's dissection in any state: the start, or after a stroke and those before it; the case
/// stays. Throws InvalidParameter if there is no such stroke, and as Dissection::follow.
dissection::Dissection dissectionAt(const Case& value, std::size_t state);

/// A branch that was taken out, for putBranch.
struct TakenBranch
{
  dissection::History::Branch branch;
  std::size_t index = 0; ///< its place among the branches
  std::optional<ViewState::Saved> view;
};

/// Takes out a branch other than the current one. Its strokes stay in the case, numbered as they
/// are, until removeBranch removes what no branch leads to. Throws InvalidParameter.
TakenBranch takeBranch(Case& value, const std::string& name);

/// Brings it back, under another name if its own has been given away since (freeName); returns the
/// name. Throws InvalidParameter if its strokes are gone.
std::string putBranch(Case& value, TakenBranch taken);

/// What the strokes up to a state removed.
struct StateSummary
{
  std::size_t strokes = 0;
  double removed = 0.0;                                 ///< mm^3
  double duration = 0.0;                                ///< s
  std::vector<dissection::TouchedStructure> structures; ///< sorted by name
};
StateSummary summaryOf(const Case& value, std::size_t state);

/// Throws InvalidParameter unless the name is valid for a branch: 1 to 100 bytes of UTF-8, no
/// control characters, no leading dash.
void checkBranchName(const std::string& name);

} // namespace petrous::scene
