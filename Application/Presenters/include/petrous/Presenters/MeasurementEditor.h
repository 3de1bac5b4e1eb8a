#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Presenters/StructureShape.h"
#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::presenters
{

/// Measuring in the open case: a tool that takes points, and changes of what is there, each with
/// undo. Without Qt; not thread-safe.
///
/// Every change goes through WorkstationModel::setMeasurements with all measurements, so a history
/// for all of a case needs to keep no more than these lists.
///
/// Centre lines and walls take long: they are computed by `inBackground`, and what comes of them
/// later. Whatever is set, taken or changed meanwhile gives them up; a handle that is dragged on
/// follows when they are there.
class MeasurementEditor
{
public:
  enum class Tool
  {
    None,
    Mark,
    Distance,
    Along, ///< along a structure's centre line, or along the points if they are in none
    Angle,
    Area,
    Thickness
  };
  struct Events
  {
    std::function<void()> changed; ///< tool, points, measurements, choice, or what can be undone
    std::function<void()> hovered; ///< the draft alone
  };

  using Apply = std::function<void()>; ///< in this thread, while the editor lives
  /// In any thread. Throws CancelledError, and InvalidParameter for what cannot be measured.
  using Work = std::function<Apply(const core::Progress&)>;

  explicit MeasurementEditor(WorkstationModel& model);

  Events events;

  /// The name that a new measurement gets, "distance", in the user's language; unset: in English.
  std::function<std::string(const std::string&)> inLanguage;

  /// Does a Work elsewhere in place of the one before, which is given up; an empty one: of none.
  /// Without it, at once.
  std::function<void(Work)> inBackground;
  void workEnded(); ///< without an Apply: it failed or was cancelled
  bool isComputing() const noexcept { return m_computing; }

  void caseChanged();  ///< or closed: forgets points, choice and undo
  void partsChanged(); ///< structures came, went or moved

  Tool tool() const noexcept { return m_tool; }
  void setTool(Tool tool); ///< drops the points that were set
  /// The MR over which points are set, or dragged, from now on; empty: the CT.
  void setImage(const std::string& mr) { m_image = mr; }

  /// Sets a point, patient LPS mm; the last one makes the measurement, at once or when it is
  /// computed. Throws InvalidParameter where nothing can be measured there; the points before it
  /// stay.
  void set(const Eigen::Vector3d& patient);
  /// A line along points and a polygon end with the points that are there, if they suffice.
  void finish();
  bool canFinish() const;
  /// Where the next point would be; none: nowhere.
  void hover(const std::optional<Eigen::Vector3d>& patient);
  void drop(); ///< the points that were set
  const std::vector<Eigen::Vector3d>& points() const noexcept { return m_points; }
  /// With the place under the pointer as the next point; none without points.
  std::optional<scene::Measurement> draft() const;
  std::string hint() const; ///< what the tool takes next, one sentence

  const std::vector<scene::Measurement>& all() const;

  /// Moves a point of a measurement: takes it, drags it, and lets it go, which is one step. Of a
  /// line along a structure the ends, which stay on its centre line; of a thickness the place where
  /// it is measured anew.
  void take(std::size_t measurement, std::size_t point);
  void drag(const Eigen::Vector3d& patient);
  void release();
  bool dragging() const noexcept { return m_dragged.has_value(); }
  /// Whether a point is a handle: of a line along a structure only the ends are, of a thickness the
  /// first.
  static bool isHandle(const scene::Measurement& measurement, std::size_t point);

  void rename(std::size_t measurement, const std::string& name); ///< throws InvalidParameter
  void remove(std::size_t measurement);
  void setShown(std::size_t measurement, bool shown);
  void setAllShown(bool shown);

  std::optional<std::size_t> chosen() const noexcept { return m_chosen; }
  void choose(std::optional<std::size_t> measurement);

  /// By another than this, as by undo. What is chosen stays so while it is there, also under
  /// another name.
  void measurementsChanged();

  /// A point that was set, or the last change of the case: changes of measurements stand in its
  /// order with all others (WorkstationModel::edits).
  bool canUndo() const { return !m_points.empty() || m_model.canUndo(); }
  bool canRedo() const { return m_points.empty() && m_model.canRedo(); }
  std::string undoText() const; ///< "distance 'distance 2'"; empty: nothing
  std::string redoText() const;
  void undo();
  void redo();

private:
  struct Drag
  {
    std::size_t measurement, point;
    std::vector<scene::Measurement> before;
    std::optional<Eigen::Vector3d> wanted = {}; ///< where it goes when the place before is computed
    bool isReleased = false;                    ///< likewise
  };
  struct Line
  {
    std::optional<CentreLine> line;
    std::string image; ///< the MR on which the structure was drawn
    std::string why;   ///< there is no line
  };
  struct Wall;

  void change(const std::string& text, std::vector<scene::Measurement> next);
  void add(scene::Measurement measurement);
  void store(std::vector<scene::Measurement> next);
  void record(const std::string& text, std::vector<scene::Measurement> before);
  void tell() const;
  void hearNames();
  scene::Measurement pointsAs(scene::Measurement::Kind kind) const; ///< those that are set
  void forgetPoints();
  void run(Work work);
  void giveUp();
  /// Of a wall: `apply` gets it.
  Work wallWork(const Eigen::Vector3d& patient,
                std::function<void(const scene::Measurement&)> apply);
  Work lineWork(const std::string& structure, std::function<void()> apply);
  void measureAlong(const std::string& structure); ///< if it is a tube, else the points stay
  void follow(const Eigen::Vector3d& patient);     ///< of a drag
  void dragOn();                                   ///< what was computed is there
  void endDrag();

  WorkstationModel& m_model;
  Tool m_tool = Tool::None;
  std::string m_image;
  std::vector<Eigen::Vector3d> m_points;
  std::vector<std::string> m_images; // of each
  std::optional<Eigen::Vector3d> m_hover;
  std::optional<std::size_t> m_chosen;
  std::vector<std::string> m_names; // of all(), as it was heard of last
  std::optional<Drag> m_dragged;
  bool m_storing = false;
  bool m_computing = false;
  std::string m_noLine; // why there is none along what the points are in
  std::map<std::string, Line> m_lines;
  std::shared_ptr<Wall> m_wall; // as the tissue was at m_wallOf
  std::uint64_t m_wallOf = 0;
};

const char* nameOf(MeasurementEditor::Tool tool) noexcept; ///< "Distance", ...

} // namespace petrous::presenters
