#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace petrous::presenters
{

/// The order in which a case was changed, so that one undo goes back through all of it. Edits are
/// taken back here; strokes have only their places here, as their own history
/// (dissection::History) holds them. Holds what changed, not the case. Not thread-safe.
class EditHistory
{
public:
  using Clock = std::chrono::steady_clock;

  struct Edit
  {
    std::string what; ///< "colour of facial nerve", for the menu
    /// An edit that comes right after one with the same text continues it: both are one step, as
    /// those of a slider that moves. Empty: never.
    std::string continues = {};
    std::function<void()> undo, redo; ///< throw core::Error without effect
    bool changesParts = false;        ///< parts come, go or get another name
    std::string group = {}; ///< its edits can also be taken back apart from others; empty: none
  };

  /// An edit continues one that is at most this old.
  static constexpr std::chrono::milliseconds kPause{1000};
  /// Earlier ones cannot be taken back.
  static constexpr std::size_t kMaxSteps = 1000;

  explicit EditHistory(std::function<Clock::time_point()> now = [] { return Clock::now(); });

  /// After the edit was made. What was undone before it cannot be redone any more. The number
  /// identifies the step.
  std::uint64_t did(Edit edit);
  void strokeMade();             ///< likewise
  void strokeStepped(bool back); ///< undone or redone

  /// The next edit does not continue the last one.
  void close() noexcept { m_open = false; }
  /// While there is one, edits continue one with the same text however old it is, as while a mouse
  /// button is down or a dialog is open. The history must outlive it; `clear` ends it.
  class Hold
  {
  public:
    explicit Hold(EditHistory& history);
    ~Hold();
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;
    void release(); ///< earlier than it dies

  private:
    EditHistory* m_history;
    std::uint64_t m_generation;
  };

  /// The step that was taken back or made again by other means, wherever it is.
  void undone(std::uint64_t step);
  void redone(std::uint64_t step);

  /// What undo would take back; nullptr: a stroke, if any is applied. `strokes`: how many are.
  const Edit* next(std::size_t strokes) const noexcept;
  /// What redo would make again; likewise. `strokes`: how many can be redone.
  const Edit* nextRedo(std::size_t strokes) const noexcept;
  /// Takes that edit back; false: it is a stroke, or nothing. A step that cannot be taken back
  /// (core::Error propagates) is dropped: it must not bar the way to those before it.
  bool undo(std::size_t strokes);
  bool redo(std::size_t strokes);
  /// The last edit of a group, though others or strokes came after it; nullptr: there is none, or
  /// parts came, went or got another name since, so that only all of it can be taken back in order.
  const Edit* nextOf(const std::string& group) const noexcept;
  const Edit* nextRedoOf(const std::string& group) const noexcept; ///< likewise
  /// Takes that one back, as `undo` does; false: there is none.
  bool undoOf(const std::string& group);
  bool redoOf(const std::string& group);
  /// Takes back the last step, if it has this number and nothing came after it, and drops it: it
  /// was only tried. What could be redone before it can be again, if the Hold is still there in
  /// which it was tried.
  void takeBack(std::uint64_t step);
  /// Of the last step; 0: there is none.
  std::uint64_t last() const noexcept;

  void clear();

private:
  struct Step
  {
    std::uint64_t id = 0;
    std::optional<Edit> edit; ///< none: a stroke
  };
  using Steps = std::vector<Step>;
  static Steps::iterator find(Steps& steps, std::uint64_t id);
  template <class AllSteps>
  static auto* nextIn(AllSteps& steps, std::size_t strokes) noexcept;
  template <class AllSteps>
  static auto* nextIn(AllSteps& steps, const std::string& group) noexcept;
  static bool step(Steps& from, Steps& to, Step* found, bool back);
  void push(Step step);
  void trim();
  void letGo(); // of a Hold

  std::function<Clock::time_point()> m_now;
  Steps m_done, m_undone; // latest last
  Steps m_displaced;      // m_undone before the step that is being tried
  std::uint64_t m_displacedBy = 0;
  std::uint64_t m_generation = 0; // of holds
  std::uint64_t m_ids = 0;
  bool m_open = false; // the last edit can be continued
  int m_held = 0;
  Clock::time_point m_latest{};
};

} // namespace petrous::presenters
