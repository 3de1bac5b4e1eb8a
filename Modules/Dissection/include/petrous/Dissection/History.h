#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace petrous::dissection
{

/// Tree of a dissection's strokes, with named branches (approaches) and the current state. Strokes
/// are numbered from 0 in order of creation; their data and voxels are stored elsewhere, in the
/// same order.
///
/// A state is identified by the last stroke applied; kStart is the untouched bone. The current
/// state always lies on a branch, between root and tip; the strokes from there to the tip can be
/// redone.
///
/// Drilling after an undo loses nothing: the branch continues with the new stroke, and strokes that
/// would no longer be reachable from any branch get a branch of their own with an automatic name.
class History
{
public:
  static constexpr std::size_t kStart = static_cast<std::size_t>(-1);
  static constexpr const char* kMain = "main";

  struct Branch
  {
    std::string name;
    std::size_t tip = kStart;      ///< its last stroke
    std::size_t position = kStart; ///< current state on it, or the state when it was left
    bool setAside = false;         ///< created by drilling after an undo, and not renamed
  };

  /// One branch, without strokes.
  History();

  /// Restores a saved tree: the parent of each stroke, the branches, and the index of the current
  /// one. Throws InvalidParameter naming the inconsistency.
  History(std::vector<std::size_t> parents, std::vector<Branch> branches, std::size_t present);

  /// One branch of `strokes` consecutive strokes, `applied` of which are applied.
  static History line(std::size_t strokes, std::size_t applied);

  std::size_t size() const noexcept { return m_parents.size(); } ///< all strokes
  std::size_t parent(std::size_t stroke) const { return m_parents.at(stroke); }

  const std::vector<Branch>& branches() const noexcept { return m_branches; }
  const Branch& branch() const noexcept { return m_branches[m_present]; } ///< the current one
  const Branch* find(const std::string& name) const noexcept;             ///< nullptr: none

  std::size_t position() const noexcept { return branch().position; }
  std::size_t applied() const { return depth(position()); }             ///< strokes applied
  std::size_t ahead() const { return depth(branch().tip) - applied(); } ///< redoable strokes
  std::size_t next() const; ///< stroke that redo would apply; kStart: none

  /// Strokes from the start to a state, in order.
  std::vector<std::size_t> lineTo(std::size_t state) const;

  /// Path between two states via their common ancestor: strokes to undo, last one first, then
  /// strokes to redo.
  struct Path
  {
    std::vector<std::size_t> undone;
    std::vector<std::size_t> redone;
  };
  Path path(std::size_t from, std::size_t to) const;

  bool undo() noexcept; ///< one stroke along the branch; false at its start
  bool redo();          ///< false at its tip

  /// Adds and applies a new stroke at the current state; returns its number.
  std::size_t add();

  /// Creates a branch at a state and switches to it. Throws InvalidParameter if the name is empty
  /// or in use, or the state is not in this tree.
  void start(const std::string& name, std::size_t state);

  /// Switches to a branch, at the state in which it was left. Throws InvalidParameter listing the
  /// branches.
  void goTo(const std::string& name);

  /// Throws InvalidParameter if `from` does not exist or `to` is in use.
  void rename(const std::string& from, const std::string& to);

  /// Removes a branch other than the current one, and the strokes reachable from no other branch.
  /// Returns the old numbers of the remaining strokes, in their new order. Throws InvalidParameter.
  std::vector<std::size_t> remove(const std::string& name);

private:
  std::size_t depth(std::size_t state) const noexcept
  {
    return state == kStart ? 0 : m_depths[state];
  }
  void append(std::size_t parent);
  bool leads(std::size_t tip, std::size_t state) const; ///< state is on the line to the tip
  std::size_t indexOf(const std::string& name) const;
  void checkFree(const std::string& name) const;

  std::vector<std::size_t> m_parents;
  std::vector<std::size_t> m_depths; ///< number of strokes up to and including each one
  std::vector<Branch> m_branches;
  std::size_t m_present = 0;
};

} // namespace petrous::dissection
