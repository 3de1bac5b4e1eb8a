#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Core/TriangleMesh.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/SliceGeometry.h"
#include "petrous/Presenters/SlicePresenter.h"
#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::segmentation
{
struct TubeOptions;
}

namespace petrous::presenters
{

/// What the segment tools are set to. One set for all, so that a range of intensities chosen for
/// the threshold also limits the brush.
struct SegmentValues
{
  enum class Combine
  {
    Replace, ///< the draft becomes the result
    Add,
    Intersect ///< only what is in both stays
  };
  double lower = 0.0;     ///< of the source image, in its unit
  double upper = 0.0;     ///< likewise, inclusive
  bool connected = false; ///< threshold: only what hangs together with a clicked point
  Combine combine = Combine::Replace;
  double brush = 1.5;     ///< mm, radius
  bool ball = true;       ///< false: a disk in the slice that is painted
  bool within = false;    ///< paint only voxels from lower to upper
  bool largest = true;    ///< islands: keep the largest; false: those of at least `smallest`
  double smallest = 10.0; ///< mm^3
  double margin = 0.5;    ///< mm; negative: shrink
  double smoothing = 0.5; ///< mm
  bool inside = true;     ///< strokes to grow from: of the structure; false: of what is beside it
  std::optional<double> tubeRadius; ///< mm; none: estimated along the path
};

/// Makes a structure, or edits one of the case: a draft on the CT's grid, tools that change it with
/// undo, and the structure that it becomes. Without Qt; not thread-safe.
///
/// What takes long is handed out as a Work for another thread, one at a time. While it is a step,
/// the draft does not change until its Apply is called, or `workEnded`.
class SegmentEditor
{
public:
  enum class Tool
  {
    None,
    Threshold,
    Paint,
    Erase,
    Islands,
    Margin,
    Smooth,
    Fill,
    Grow,
    Nerve
  };
  using Apply = std::function<void()>; ///< in this thread, while the editor lives
  /// In any thread. Throws CancelledError, and what the tool refuses.
  using Work = std::function<Apply(const core::Progress&)>;

  struct Events
  {
    std::function<void()> changed;                            ///< anything that a panel shows
    std::function<void(const core::IndexBox&)> voxelsChanged; ///< of the draft, CT voxels
    std::function<void(const std::string& name)> created;     ///< and no draft is left
  };

  /// Of the strokes to grow from, 0 to 255: orange inside and blue beside, which all colour vision
  /// tells apart [Okabe and Ito 2008]; those beside are hatched, too.
  static constexpr std::array<float, 3> kInsideStroke{240.0F, 164.0F, 0.0F};
  static constexpr std::array<float, 3> kBesideStroke{40.0F, 120.0F, 255.0F};
  static constexpr double kGrip = 1.0; ///< mm about a nerve point within which a press grips it

  /// The model must outlive this.
  explicit SegmentEditor(WorkstationModel& model);
  ~SegmentEditor();
  SegmentEditor(const SegmentEditor&) = delete;
  SegmentEditor& operator=(const SegmentEditor&) = delete;

  Events events;

  void caseChanged();  ///< another case, or none: drops the draft
  void partsChanged(); ///< the case's images or structures are others
  void mrMoved();      ///< the registration of an MR changed

  bool hasDraft() const;  ///< something is begun: voxels, strokes, points
  bool isUnsaved() const; ///< and would be lost; what a tool proposed by itself is not
  const std::string& name() const noexcept;
  void setName(const std::string& name);
  /// Why the draft cannot become a structure now, one sentence; empty: it can.
  std::string whyNotCreate() const;
  /// The structure of the case that is edited; empty: a new one.
  const std::string& edited() const noexcept;
  std::vector<std::string> editable() const; ///< labels of the case with a place on the CT
  /// A step that takes a structure of the case as the draft. Throws InvalidParameter if there is a
  /// draft already, or for a name that is not `editable`.
  Work edit(const std::string& structure);

  Tool tool() const noexcept { return m_tool; }
  void setTool(Tool tool); ///< no effect without a case; the draft stays

  /// The image that threshold, range, growing and tracing read: "ct" or an MR's name.
  const std::string& source() const noexcept { return m_source; }
  struct Source
  {
    std::string name;
    std::string why; ///< it cannot be used; empty: it can
  };
  std::vector<Source> sources() const;
  /// What the user calls it: "CT", "MR" for a primary image that is one, an MR's name.
  std::string sourceName(const std::string& source) const;
  void setSource(const std::string& name); ///< throws InvalidParameter with Source::why
  /// What the slices show. Without a tool and a draft the source follows: it becomes the only image
  /// that is shown, if that can be used.
  void setShown(const ShownImages& shown);
  /// Where the slices do not show the source: that, and what they show, one sentence; clicks of
  /// tools that read the source are refused then. Else empty.
  std::string notShown() const;
  /// The shown image that could be the source instead; empty: none.
  std::string shownInstead() const;
  IntensityDisplay display() const; ///< unit, decimals and range of the source's intensities

  const SegmentValues& values() const noexcept { return m_values; }
  void setValues(const SegmentValues& values);
  /// Lower and upper, around the clicked point if one counts, else from the source's histogram, and
  /// on an MR without a draft its brightest region; with the next preview. A click outside limits
  /// that were not entered does the same.
  void proposeRange();

  /// The left button in a slice; patient, LPS mm.
  void press(const Eigen::Vector3d& patient, SliceOrientation plane);
  /// In a slice of this normal, of length 1.
  void press(const Eigen::Vector3d& patient, const Eigen::Vector3d& normal);
  void drag(const Eigen::Vector3d& patient);
  void release();

  struct TubePoint
  {
    Eigen::Vector3d patient;        ///< LPS mm
    std::optional<double> distance; ///< mm from the path; none while there is none
    std::string problem;            ///< what the scan does not show here, in words; usually empty
    bool isOutside = false;         ///< it lies beside the tube, and `problem` says so
  };
  std::vector<TubePoint> tubePoints() const;
  // Each can be undone; without effect for an index that there is not.
  void removeTubePoint(std::size_t index);
  void moveTubePoint(std::size_t index, const Eigen::Vector3d& patient);
  void reorderTubePoint(std::size_t from, std::size_t to);    ///< its place along the nerve
  const std::vector<Eigen::Vector3d>& path() const noexcept;  ///< LPS mm
  const std::vector<Eigen::Vector3d>& seeds() const noexcept; ///< of the connected threshold
  /// Median radius of the tube that is previewed, mm, estimated or given; none without a tube.
  std::optional<double> shownRadius() const;
  /// Length and radius of the tube, or what is to be done next; a sentence or two, or empty.
  const std::string& note() const noexcept { return m_note; }
  /// What is wrong with the tool's result, in words; usually empty.
  std::string warning() const;

  /// Work that is due: a preview to be brought up to date, or a step begun by a click. None if
  /// there is none, or while a step is under way.
  std::optional<Work> dueWork();
  /// The tool's step on the draft, with the preview. None where `whyNotStep` says why.
  std::optional<Work> stepWork();
  std::string whyNotStep() const;
  void workEnded();                        ///< it was cancelled: the draft is as before
  void workFailed(const std::string& why); ///< likewise, and a preview's tool has no result
  void workDropped();                      ///< nobody waits for it any more; a preview is due again
  bool stepping() const noexcept { return m_stepping; }

  bool canUndo() const;
  bool canRedo() const;
  /// Of the draft's own steps alone: creations are also steps of WorkstationModel::undo, which
  /// needs this editor as long as it is of the same case.
  bool canUndoStep() const { return canUndo() && hasSteps(); }
  bool canRedoStep() const { return canRedo() && hasUndoneSteps(); }
  /// What undo or redo would take on next: "threshold", "create sigmoid sinus"; empty: nothing.
  std::string undoText() const;
  std::string redoText() const;
  /// A step, or the structure just created: it is taken out of the case and is the draft again,
  /// under the name that it has by then. True in the latter case. Throws InvalidParameter where
  /// that structure is gone, or where the one that it replaced cannot come back.
  bool undo();
  /// A step, or the structure whose creation was undone, as long as the draft is unchanged. Throws
  /// InvalidParameter where its name has been taken.
  void redo();

  /// The preview is outdated: a Work for it is due or under way.
  bool previewPending() const noexcept { return m_previewDue || m_previewRunning; }

  /// The draft, with the preview, becomes a structure of the case. Throws InvalidParameter with
  /// `whyNotCreate`.
  Work createWork();
  void create(); ///< at once
  void discard();

  bool hasStrokes() const; ///< to grow from
  /// What of the draft hangs together with its largest part by no face; after the step that left
  /// it, until the next change.
  struct Pieces
  {
    std::size_t count = 1; ///< with the largest
    double outside = 0.0;  ///< mm^3, of all but the largest
  };
  std::optional<Pieces> pieces() const;
  /// A step, due at once. No effect without `pieces`.
  void keepLargest();
  std::uint64_t voxels() const; ///< of what would be created
  double volume() const;        ///< mm^3, likewise
  const std::array<float, 3>& color() const noexcept { return m_color; } ///< 0 to 1
  /// Of draft, preview and strokes; without indexAt: none. Valid until the next change.
  DraftLayer layer() const;

  /// Computes the surface of what would be created, for the 3D view: see `surface`.
  Work surfaceWork();
  /// Above it the surface is that of larger cells, see `surfaceStep`.
  static constexpr std::uint64_t kMostSurfaceVoxels = 8'000'000;
  /// nullptr: none.
  const std::shared_ptr<const core::TriangleMesh>& surface() const noexcept { return m_surface; }
  /// The same half a voxel farther out, so that it is seen where it lies on the surface of bone.
  const std::shared_ptr<const core::TriangleMesh>& raisedSurface() const noexcept
  {
    return m_raised;
  }
  /// Edge of the surface's cells in voxels; 1: it is that of the voxels.
  int surfaceStep() const noexcept { return m_surfaceStep; }

private:
  struct Draft;
  struct Created;
  struct SourceImage;
  struct Origin;
  struct Preview;
  using Points = std::vector<Eigen::Vector3d>;
  // The MRs that a step read, and whether it makes all voxels anew.
  struct Reads
  {
    scene::MrReadings readings;
    bool afresh = false;
  };
  using Computed = std::function<Preview(const core::Progress&)>;

  segmentation::TubeOptions tubeOptionsFor(const std::string& name) const;
  static Origin originOf(const scene::Case& value, const scene::LabelPart& part,
                         const scene::StructurePart& structure);
  bool hasSteps() const;
  bool hasUndoneSteps() const;
  SourceImage& image();
  Computed computed() const;
  std::optional<Work> previewWork();
  Work replacing(const char* what, std::function<Preview(const core::Progress&)> compute,
                 bool endsTool, const Reads& reads);
  Reads readsOfTool();
  scene::MrReadings readingsOfStroke();
  scene::MrReadings readingsOfDraft() const;
  void followNames();
  void show(const Preview& preview);
  void beginStep();
  void endStep();
  void followEdited();
  void followSource();
  void nameDraft(const std::string& name);
  void outdate();
  void forgetImage();
  bool needsPreview() const;
  void undoCreated(const std::shared_ptr<Created>& made);
  void keepReplaced(Created& created, std::optional<scene::LabelPart> part);
  bool canCreateAgain() const;
  bool isDraftOf(const Created& created) const;
  const scene::LabelPart* partOf(const Created& created) const;
  void createAgain(Created& created);
  void checkFree(const std::string& name) const;
  std::function<void()> step(Draft& draft, bool back);
  Work stepping(bool back);
  void dropPreview();
  void changePoints(const char* what, Points points);
  void dab(const Eigen::Vector3d& from, const Eigen::Vector3d& to);
  void refuse(const std::string& why);
  bool checkWithin(const Eigen::Vector3d& patient);
  bool isProposal() const;
  void dropProposal();
  bool readsSource() const;
  void followShown();
  void takeSource(const std::string& name);
  std::optional<double> surfaceIntensity() const;
  bool isSourceMr() const;
  void chooseColor();
  std::array<float, 3> colorNow() const;
  void reset();
  void touched(); // something that a panel shows has changed

  WorkstationModel& m_model;
  Tool m_tool = Tool::None;
  std::string m_source = "ct";
  ShownImages m_shown;
  std::unique_ptr<SourceImage> m_image; // made on demand
  SegmentValues m_values;
  std::shared_ptr<Draft> m_draft;     // never null
  std::shared_ptr<Created> m_created; // the last one; also in WorkstationModel::edits
  std::unique_ptr<Preview> m_preview; // none: the draft alone
  std::unique_ptr<Preview> m_frozen;  // what is shown while a step is under way
  std::string m_note, m_warning;
  std::string m_refused; ///< why the tool has no result
  std::array<float, 3> m_color{};
  bool m_proposeDue = false;
  bool m_proposesAgain = false; ///< the threshold, as it left with what it had proposed
  bool m_isOwnRange = false;    ///< the limits were entered, not proposed
  bool m_previewDue = false;
  std::uint64_t m_inputs = 0;    // of previews: changes when one that is under way is outdated
  std::uint64_t m_previewOf = 0; // the inputs of the one that is under way
  std::uint64_t m_images = 0;    // changes when m_image is another
  std::size_t m_sourceOf = 0;    // place of the source among the MRs, while there are
  std::size_t m_imagesThen = 0;  // so many
  std::vector<std::string> m_mrNames;
  bool m_previewRunning = false;
  bool m_stepping = false;
  std::optional<Work> m_stepDue; // begun by a click
  std::shared_ptr<const core::TriangleMesh> m_surface;
  std::shared_ptr<const core::TriangleMesh> m_raised;
  int m_surfaceStep = 1;
};

} // namespace petrous::presenters
