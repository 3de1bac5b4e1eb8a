#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace petrous::dissection
{

/// The tree of a dissection: which stroke follows which, the named branches (approaches) in it, and
/// where one is. Strokes are numbers from 0 on, in the order in which they were made; what is known
/// of them and their voxels lie elsewhere, in the same order.
///
/// A state is named by the stroke that was done last; kStart is the untouched bone. One is always
/// on a branch, at a state on the line to its tip: what lies between is undone and can be redone.
///
/// Nothing is lost by drilling after an undo: the branch goes on with the new stroke, and strokes
/// that no branch would lead to any more get one of their own, with an automatic name.
class History
{
public:
  static constexpr std::size_t kStart = static_cast<std::size_t>(-1);
  static constexpr const char* kMain = "main";

  struct Branch
  {
    std::string name;
    std::size_t tip = kStart;      ///< its last stroke
    std::size_t position = kStart; ///< where one is on it, or was when one left it
    bool setAside = false; ///< came to be by drilling after an undo, and was not named since
  };

  /// One branch, without strokes.
  History();

  /// What was saved: the parent of each stroke, the branches, and the number of the present one.
  /// Throws InvalidParameter saying what contradicts what.
  History(std::vector<std::size_t> parents, std::vector<Branch> branches, std::size_t present);

  /// One branch with `strokes` strokes one after the other, of which `applied` are done.
  static History line(std::size_t strokes, std::size_t applied);

  std::size_t size() const noexcept { return m_parents.size(); } ///< all strokes
  std::size_t parent(std::size_t stroke) const { return m_parents.at(stroke); }

  const std::vector<Branch>& branches() const noexcept { return m_branches; }
  const Branch& branch() const noexcept { return m_branches[m_present]; } ///< the present one
  const Branch* find(const std::string& name) const noexcept;             ///< null: none

  std::size_t position() const noexcept { return branch().position; }
  std::size_t applied() const { return depth(position()); }             ///< strokes that are done
  std::size_t ahead() const { return depth(branch().tip) - applied(); } ///< that can be redone
  std::size_t next() const; ///< the stroke that redo brings; kStart: none

  /// Strokes that lead to a state, the first one first.
  std::vector<std::size_t> lineTo(std::size_t state) const;

  /// How one gets from a state to another over their common ancestor: strokes to take back, the
  /// last one first, then strokes to do.
  struct Path
  {
    std::vector<std::size_t> undone;
    std::vector<std::size_t> redone;
  };
  Path path(std::size_t from, std::size_t to) const;

  bool undo() noexcept; ///< one stroke along the branch; false at its start
  bool redo();          ///< false at its tip

  /// A new stroke at the present state, which is then done; its number.
  std::size_t add();

  /// Makes a branch at a state and goes on it. The name must be free and not empty, the state one
  /// of this tree; throws InvalidParameter otherwise.
  void start(const std::string& name, std::size_t state);

  /// Goes to a branch, to the state in which it was left. Throws InvalidParameter naming those that
  /// there are.
  void goTo(const std::string& name);

  /// Throws InvalidParameter where `from` is not there or `to` is taken.
  void rename(const std::string& from, const std::string& to);

  /// Removes a branch, not the present one, and the strokes that no other one leads to. The numbers
  /// of those that stay, in their new order. Throws InvalidParameter.
  std::vector<std::size_t> remove(const std::string& name);

private:
  std::size_t depth(std::size_t state) const noexcept
  {
    return state == kStart ? 0 : m_depths[state];
  }
  void append(std::size_t parent);
  bool leads(std::size_t tip, std::size_t state) const; ///< the state lies on the line to the tip
  std::size_t indexOf(const std::string& name) const;
  void checkFree(const std::string& name) const;

  std::vector<std::size_t> m_parents;
  std::vector<std::size_t> m_depths; ///< strokes up to each one, itself included
  std::vector<Branch> m_branches;
  std::size_t m_present = 0;
};

} // namespace petrous::dissection
