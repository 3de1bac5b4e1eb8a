#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Presenters/StillCamera.h"
#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::presenters
{

/// The video of the open case that is looked at: its bookmarks, the part that is repeated, and the
/// landmarks of the still that is seen, whose camera is sought. Every change of the case goes
/// through WorkstationModel::setVideoNotes and can be undone. Without Qt; not thread-safe.
class VideoEditor
{
public:
  /// Seeks the camera of a still, in any thread; what it returns is called in this one.
  using Work = std::function<std::function<void()>(const core::Progress&)>;

  explicit VideoEditor(WorkstationModel& model);
  VideoEditor(const VideoEditor&) = delete;
  VideoEditor& operator=(const VideoEditor&) = delete;

  std::function<void()> changed;     ///< anything that is shown
  std::function<void()> cameraFound; ///< and kept: to be saved, though there is no edit
  /// Runs a search; the latest counts. Unless set, searches run at once. None: drop the one before.
  std::function<void(Work)> inBackground;

  void refresh(); ///< call when the case or its attachments changed

  std::vector<std::string> videos() const;                      ///< attached, by name
  const std::string& video() const noexcept { return m_video; } ///< empty: none is looked at
  void choose(const std::string& name);                         ///< empty: none
  std::filesystem::path file() const;                           ///< throws InvalidParameter
  const scene::VideoNotes& notes() const;

  void showFrame(const std::array<int, 2>& size, std::int64_t time); ///< it is seen now
  void hideFrame();
  std::optional<std::int64_t> time() const noexcept { return m_time; } ///< of the frame

  // Bookmarks. All throw InvalidParameter, without effect.
  /// At the frame that is seen, tied to the case's present stroke. Empty: a name of its own.
  std::string addBookmark(const std::string& name = {});
  void renameBookmark(std::size_t bookmark, const std::string& name);
  void moveBookmark(std::size_t bookmark); ///< to the frame that is seen
  void tieBookmark(std::size_t bookmark);  ///< to the present stroke, or from any, if it is tied
  void removeBookmark(std::size_t bookmark);

  /// A state of the dissection.
  struct State
  {
    std::string branch;
    std::size_t stroke = 0;
  };
  /// That of a bookmark: on the present branch, if the stroke is on it. None: it is tied to none,
  /// or the stroke is gone.
  std::optional<State> stateOf(std::size_t bookmark) const;
  /// The bookmark that is tied to the stroke after which the case is.
  std::optional<std::size_t> bookmarkHere() const;
  /// The number of a bookmark's stroke, from 1, as lists have it; 0: none.
  std::size_t strokeOf(std::size_t bookmark) const;

  /// The part between two bookmarks, in either order; the same twice: none. Not saved.
  void setLoop(std::size_t first, std::size_t second);
  void clearLoop();
  std::optional<std::array<std::int64_t, 2>> loop() const noexcept { return m_loop; } ///< ns

  // The still: the frame that is seen, once it has a landmark.
  const scene::VideoNotes::Still* still() const;
  /// The next landmark in the still, pixels; completed by addPair.
  void markStill(const Eigen::Vector2d& pixel);
  std::optional<Eigen::Vector2d> mark() const noexcept { return m_mark; }
  void dropMark();
  void addPair(const Eigen::Vector3d& patient); ///< throws without a mark
  void removePair(std::size_t pair);
  void removeStill();
  void setViewAngle(std::optional<double> degrees); ///< nullopt: it is found
  void setOpacity(double opacity);

  /// Of the still that is seen; none while it is sought, or if there is none.
  const std::optional<StillFit>& fit() const noexcept { return m_fit; }
  const std::string& problem() const noexcept { return m_problem; } ///< why there is none
  bool isFitting() const noexcept { return m_isFitting; }

private:
  using Notes = scene::VideoNotes;

  void set(const Notes& notes, const std::string& what, const std::string& continues = {});
  void changeStill(const std::function<void(Notes::Still&)>& change, const std::string& what);
  std::string presentStroke() const;
  void seekCamera();
  void fitted(const Notes::Still& of, const std::optional<StillFit>& fit,
              const std::string& problem);
  void tell();
  void requireFrame() const;
  void checkBookmark(std::size_t bookmark) const;

  WorkstationModel& m_model;
  std::string m_video;
  std::uint64_t m_shown = 0; // the case
  std::array<int, 2> m_size{0, 0};
  std::optional<std::int64_t> m_time;
  std::optional<Eigen::Vector2d> m_mark;
  std::optional<std::array<std::int64_t, 2>> m_loop;
  std::optional<Notes::Still> m_fitOf; // what m_fit or m_problem is of
  std::optional<StillFit> m_fit;
  std::string m_problem;
  bool m_isFitting = false;
};

} // namespace petrous::presenters
