#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "petrous/Core/AxesCorrection.h"
#include "petrous/Interaction/PickRay.h"
#include "petrous/Library/Library.h"
#include "petrous/Library/OpenMark.h"
#include "petrous/Presenters/EditHistory.h"
#include "petrous/Presenters/JournalThread.h"
#include "petrous/Presenters/LeftOut.h"
#include "petrous/Presenters/NearbyStructures.h"
#include "petrous/Presenters/PointProbe.h"
#include "petrous/Presenters/SceneAssembly.h"
#include "petrous/Presenters/WorkstationEvents.h"
#include "petrous/Scene/Case.h"
#include "petrous/Scene/ReferenceFrames.h"
#include "petrous/Session/RemovedVolumeEstimator.h"
#include "petrous/Session/TouchSession.h"

namespace petrous::presenters
{

/// A case read from the library, in any thread.
struct ReadCase
{
  std::unique_ptr<scene::Case> value; ///< with its dissection, as far as it is sound
  std::vector<std::string> notices;   ///< Library::onNotice
  std::vector<std::string> strokes;   ///< damage, see Library::loadSoundDissection
  std::size_t undone = 0;             ///< applied strokes that were undone for it

  /// Throws as Library::open does, also where the CT is missing; CancelledError.
  static ReadCase from(const library::Library& library, const std::string& name,
                       const core::Progress& progress = {});
};

/// A copy of the open case to be written to disk, see WorkstationModel::beginStore.
struct StoreTask
{
  library::Library library;
  scene::Case value; ///< its dissection is not loaded: strokes and history are stored
  std::string from;  ///< the open case's name
  std::uint64_t changes = 0;
  std::optional<library::Library> source; ///< library that the case moves from; the window then
                                          ///< works with `library`
  std::vector<std::string> notices = {};  ///< Library::onNotice

  /// Throws as Library::save; LibraryError (Damaged) also if a part that moves to another library
  /// differs from what was stored in this one.
  void run(const core::Progress& progress = {});
};

/// The slow part of preparing a case with many structures for rendering and tools: made in any
/// thread from a copy of the case, see WorkstationModel::preparation.
struct PreparedCase
{
  SceneAssembly assembly;
  std::optional<session::DrillSession>
      drill;                ///< of a copy that is gone: only a template for another one
  LeftOut leftOut;          ///< missing or damaged
  std::uint64_t parts = 0;  // of the model when it was copied
  std::uint64_t tissue = 0; // likewise
};

/// What a tool needs before it can be taken up at once: made in any thread from a copy of the case,
/// see WorkstationModel::toolPreparation.
struct PreparedTool
{
  std::optional<session::FeltTissue> felt;
  dissection::Burr burr;
  std::shared_ptr<const haptics::PointShell> shell; ///< nullptr: the tool needs none
  double voxel = 0.0;                               // mm, for which it was made
  std::uint64_t tissue = 0;                         // of the model when it was copied
};

/// The thickness of bone over a structure, measured in any thread from a copy of the case, see
/// WorkstationModel::thicknessMeasurement.
struct MeasuredThickness
{
  SceneAssembly assembly;
  std::uint64_t parts = 0; // of the model when it was copied
};

/// The appearance of a part: of bone, or tissue of an MR, under the name "ct"; of soft tissue under
/// scene::kSoftTissue.
struct PartLook
{
  std::string part;
  appearance::StructureAppearance look;
};

/// The open case and the window's operations on it. Without Qt; not thread-safe.
class WorkstationModel
{
public:
  using Events = WorkstationEvents;

  explicit WorkstationModel(library::Library library);
  WorkstationModel(const WorkstationModel&) = delete;
  WorkstationModel& operator=(const WorkstationModel&) = delete;

  Events events;

  const library::Library& library() const noexcept { return m_library; }
  bool hasCase() const noexcept { return m_case != nullptr; }
  const scene::Case& value() const noexcept ///< only with a case
  {
    return *m_case;
  }

  /// The case to begin with: the one with drilling that a program which was killed did not save,
  /// else `lastOpened` (Case::id), else the most recently saved one; none in an empty library.
  std::optional<std::string> latestCase(const std::string& lastOpened = {}) const;

  /// Opens a case of the library; on an exception the present one stays.
  void open(const std::string& name);

  /// Before the open case is saved to make way for another one, or closed: puts the tool away and
  /// refuses new ones (what they drilled would be lost) until another case is open, the case is
  /// closed, or `notOpened`.
  void beginLeave();

  /// As beginLeave, for reading the case (ReadCase) in another thread; then call `opened` or
  /// `notOpened`.
  void beginOpen(const std::string& name);
  void opened(ReadCase next);
  void notOpened();

  /// Opens a case made in memory, not yet saved.
  void adopt(scene::Case value);

  /// Takes over the parts that `with` has in addition to `before`, the copy of the open case to
  /// which they were added (see addParts). What was drilled, set and made since then stays; a part
  /// whose name is taken by now gets a number. Can be undone.
  void takeParts(const scene::Case& before, scene::Case with);

  /// Adds structures made in this program (addStructures), from these MRs and tubes; `doubts` are
  /// sentences about each of them, kept as notes. The one called
  /// `replaced`, if that is not empty, is removed and returned, and a new one of its name has its
  /// appearance. Ends the touch session. Throws as addStructures does, without effect.
  std::optional<scene::LabelPart> addStructure(volume::LabelMap labels,
                                               const std::string& replaced = {},
                                               const scene::MrReadings& readings = {},
                                               const scene::TracedTubes& tubes = {},
                                               const std::vector<std::string>& doubts = {});
  /// Removes a structure of a label map and returns it as a part of its own, for `putStructure`;
  /// none if there is none. Ends the touch session, as that does.
  std::optional<scene::LabelPart> takeStructure(const std::string& name);
  /// Measurements that followed it do so again, and those of `inPlaceOf`, the structure that was
  /// taken out for it, if that has its name. Throws InvalidParameter, without effect, if its name
  /// has been taken meanwhile.
  void putStructure(const scene::LabelPart& part, const scene::LabelPart* inPlaceOf = nullptr);
  // These four can be undone.
  /// Takes a structure, a mesh or an MR out of the case, and puts the tool away. Throws as
  /// scene::removePart does. No effect while drilling.
  void removePart(const std::string& name);
  /// The part that restorePart brings back: the last one removed since the case was opened; empty:
  /// none.
  std::string removedPart() const;
  /// Brings it back to its place. Throws InvalidParameter if its name was given to another part, or
  /// the MR on which it was drawn is gone.
  void restorePart();
  /// Gives a part another name, everywhere in the case. Throws InvalidParameter if it is not valid
  /// or taken, Error (Refused) if strokes record what was removed from the part.
  void renamePart(const std::string& name, const std::string& to);
  /// Corrects the axes of an MR, a structure's label map or a mesh as correctPart does, and puts
  /// the tool away. Throws as that does, and Error (Refused) for what could not be read. No effect
  /// while drilling.
  void correctAxes(const std::string& part, const core::AxesCorrection& axes);

  /// Closes the case. Unsaved changes are lost.
  void close();

  /// Changes with each case opened or adopted: names cannot identify a case, since they can be
  /// reassigned.
  std::uint64_t shownAs() const noexcept { return m_shown; }

  /// For saving in another thread: the current state of the case; then call `stored` or
  /// `notStored`. One at a time. Later changes count as unsaved.
  StoreTask beginStore();
  StoreTask beginStoreAs(const std::string& name); ///< as a new case, which then is the open one
  /// Into another library, which the window then works with.
  StoreTask beginStoreElsewhere(const std::filesystem::path& folder, const std::string& name);
  void stored(const StoreTask& done); ///< name and revision are taken over
  void notStored();
  bool beingStored() const noexcept { return m_beingStored; }

  bool unsaved() const noexcept { return m_unsaved; }
  void setCamera(const core::CameraPose& camera); ///< stored with the next save
  /// The view, without those of branches, which stay. Stored with the next save.
  void setView(const scene::ViewState& view);
  // These two can be undone.
  /// Keeps `camera` and `slices` under a name (scene::saveView), in place of what was kept under
  /// it. Throws InvalidParameter for a name that is not valid, and beyond ViewState::kMaxSaved.
  void saveView(const std::string& name, const core::CameraPose& camera,
                const scene::ViewState::Slices& slices);
  void removeView(const std::string& name); ///< unknown: no effect
  /// What is cut away from the picture; throws InvalidParameter (scene::checkView).
  void setClipping(const scene::ViewState::Clipping& clipping);
  /// Adds a file, under a free name, which is returned; its content is stored with the next save.
  std::string attach(scene::Attachment attachment);
  void setAttachmentNote(const std::string& name, const std::string& note);
  void removeAttachment(const std::string& name);
  /// Bookmarks and stills of an attached video; can be undone as `what`, unless that is empty.
  /// Throws InvalidParameter (scene::checkVideoNotes), without effect.
  void setVideoNotes(const std::string& name, const scene::VideoNotes& notes,
                     const std::string& what, const std::string& continues = {});
  /// Marks and measurements, all at once: what MeasurementEditor steps back and forth. Throws
  /// InvalidParameter (scene::checkMeasurements), without effect.
  void setMeasurements(std::vector<scene::Measurement> measurements);
  /// Which side is operated on; can be undone. No effect while drilling.
  void setSide(scene::Side side);
  void save();                          ///< throws as Library::save does
  void saveAs(const std::string& name); ///< a new case; strong exception guarantee
  void saveElsewhere(const std::filesystem::path& folder, const std::string& name);

  /// State of the preparation (requested by Events::preparationWanted) until `prepared`:
  /// loaded   false after another case or parts were added: only the CT is shown; removing a part
  ///          leaves the others as they are
  /// drawable also false after a structure was shown, hidden or removed: its label field is
  /// outdated ready    also false after a change of what is tissue: no surface can be touched yet;
  /// and while
  ///          the CT of the library was not checked against its hash
  bool loaded() const noexcept { return m_loaded; }
  bool drawable() const noexcept { return m_loaded && m_drawable; }
  bool ready() const noexcept { return m_loaded && m_feelable && m_checked; }
  /// Whether `preparation` would save a wait.
  bool preparationHelps() const noexcept
  {
    return m_case && (!ready() || !drawable() || !(m_session || m_scene));
  }
  /// The preparation, to be run in another thread.
  std::function<PreparedCase(const core::Progress&)> preparation() const;
  /// Returns false, without effect, if another case is open or its parts changed.
  bool prepared(PreparedCase done);
  void prepareNow() { prepared(preparation()({})); } ///< synchronously
  /// What can be shown now: the case, without its structures while they are not loaded.
  scene::Case presentable() const;

  /// Images read that differ from what was stored, one sentence each, as far as known; no tool can
  /// be taken up then.
  std::vector<std::string> damage() const;
  /// Structures that are missing or damaged, one sentence each: they are neither shown nor
  /// touchable, and the case keeps them as they are on disk.
  std::vector<std::string> leftOut() const;
  /// Strokes that are missing or damaged, one sentence each. Applied ones, and those after them,
  /// were undone when the case was opened; the case keeps them.
  const std::vector<std::string>& damagedStrokes() const noexcept { return m_damagedStrokes; }
  std::size_t undoneForDamage() const noexcept { return m_undoneForDamage; }

  bool canUndo() const noexcept;
  bool canRedo() const noexcept;
  /// What they would take on next: "colour of facial nerve", "stroke 3"; empty: nothing.
  std::string undoText() const;
  std::string redoText() const;
  /// Whether that adds, removes or renames parts or goes to another branch; then it puts the tool
  /// away.
  bool undoChangesParts() const noexcept;
  bool redoChangesParts() const noexcept;
  bool undoesStroke() const noexcept; ///< or closes and undoes an open one
  bool redoesStroke() const noexcept;
  /// The last change of appearance, threshold, parts or strokes, in the order in which they were
  /// made. Strokes during a touch session are only requested, and reported some milliseconds later;
  /// see Events::stepped. `redo` throws LibraryError if the stroke is damaged; nothing has changed
  /// then. Throws also what restorePart and renamePart do; that change is passed over then.
  void undo();
  void redo();
  /// For changes that belong together (EditHistory::hold), and for those made elsewhere.
  EditHistory& edits() noexcept { return m_edits; }
  /// Takes back the last change if it was made after `before` (EditHistory::last), and only tried,
  /// in the case that `of` (shownAs) is of. Throws what undo throws.
  void takeBackTried(std::uint64_t before, std::uint64_t of);

  // These put the tool away first; the view that a branch is left with is asked for and shown
  // (WorkstationEvents::viewWanted, viewChanged). Throw as the functions of scene do.
  void goToBranch(const std::string& name); ///< can be undone
  /// At the case's current state; going to it can be undone, and it is there nevertheless.
  void startBranch(const std::string& name);
  /// On the present branch it is as if the strokes had been undone or redone; else can be undone.
  void goToState(const std::string& branch, std::size_t state);
  // These two put the tool away and can be undone. They throw as scene::renameBranch and
  // scene::takeBranch do, without effect.
  void renameBranch(const std::string& from, const std::string& to);
  void removeBranch(const std::string& name); ///< its strokes stay in the case

  // These can be undone. Those that come quickly after one another and change the same property of
  // the same parts are one step (EditHistory::kPause), so that they may be called at any rate.
  void setIso(double hounsfield);
  void setLook(const std::string& structure, const appearance::StructureAppearance& look);
  void setBoneLook(const appearance::StructureAppearance& look);
  /// Several in one step and with one notification. Unknown parts are passed over. `what`: as undo
  /// calls it, if it is more than a change of a property; it is a step of its own then.
  void setLooks(const std::vector<PartLook>& looks, const std::string& what = {});
  /// nullptr: there is no such part. "ct" is bone, scene::kSoftTissue soft tissue.
  const appearance::StructureAppearance* lookOf(const std::string& part) const;

  /// Changes the registration of MRs (Scene/ApplyRegistration.h); can be undone as `what`, unless
  /// that is empty, but for sign-offs, which do not come back. Puts the tool away if that moves
  /// structures drawn on them. No effect while drilling; exceptions of `change` propagate.
  void changeMr(const std::function<void(scene::Case&)>& change, const std::string& what = {},
                const std::string& continues = {});
  /// The last of these changes, though others or strokes came after it: what `undo` would come to.
  /// Not beyond a change of the parts (EditHistory::nextOf), and not while drilling.
  bool canUndoMr() const noexcept;
  bool canRedoMr() const noexcept;
  std::string undoMrText() const; ///< empty: none
  std::string redoMrText() const;
  void undoMr();
  void redoMr();
  bool undoMovesMr() const noexcept; ///< `undo` would take one of these back
  bool redoMovesMr() const noexcept;

  /// The scene contents of the case; requires a case; see SceneAssembly.
  rendering::SceneContents sceneContents();

  /// Colours bone by its thickness over a structure; empty: off. Takes about a second. Throws
  /// InvalidParameter, without effect, if it cannot be measured.
  void showThickness(const std::string& structure);
  /// As above, to be measured in another thread, which throws what that throws.
  std::function<MeasuredThickness(const core::Progress&)>
  thicknessMeasurement(const std::string& structure) const;
  /// Returns false, without effect, if another case is open or its parts changed meanwhile.
  bool showThickness(const MeasuredThickness& measured);
  const std::string& thicknessOver() const noexcept { return m_assembly.thicknessOver(); }

  const Eigen::Vector3d& crosshair() const noexcept { return m_crosshair; }
  void setCrosshair(const Eigen::Vector3d& patient); ///< clamped to the CT

  std::optional<double> hounsfieldAt(const Eigen::Vector3d& patient) const;
  std::string structureAt(const Eigen::Vector3d& patient) const; ///< empty: none
  /// As `petrous probe` reports it, plus the nearest structure, whose distance fields the first
  /// reading of a case has computed in a separate thread; requires a case.
  PlaceReading readPlace(const Eigen::Vector3d& patient);
  /// Changes with the tissue, also by drilling.
  std::uint64_t tissueChanges() const noexcept { return m_tissueChanges; }
  static constexpr double kNear = 20.0; ///< mm; farther structures are not reported
  /// What is near a tool at X_PT, for all who show it: `isWide` all structures within kNear, and
  /// injured ones; else no more than warnings need (warningsOf), which is cheap enough for every
  /// frame. The first call for a case that needs them starts computing their distance fields in a
  /// separate thread. Does not throw.
  ToolSurroundings surroundings(const MeasuredTool& tool, const haptics::Pose& pose, bool isWide);
  /// What the open stroke has removed so far, see RemovedVolumeEstimator; empty while none is open.
  const dissection::RemovedVolume& strokeSoFar();
  bool measuresNearby() const noexcept { return m_nearby != nullptr; }
  void forgetNearby(); ///< releases the memory of the distance fields

  /// Tissue behind a place on its surface (patient LPS mm) along a unit direction, up to air or a
  /// structure on the CT's grid that is warned of: mm, at most kThickWall; nullopt if there is no
  /// surface within 0.5 mm. Requires a ready case.
  std::optional<double> wallBehind(const Eigen::Vector3d& surface,
                                   const Eigen::Vector3d& direction);
  static constexpr double kThickWall = 5.0; ///< mm

  /// Distance from the ray's origin to tissue, mm, also to what is cut away from the view: what a
  /// tool meets.
  std::optional<double> tissueAlong(const interaction::PickRay& line);
  /// What a click in the 3D view means without a tool, patient LPS mm: the first tissue that
  /// ViewState::clipping leaves, at a face that it cuts also soft tissue that is drawn there;
  /// nullopt where no such tissue is left. Whether structures are shown does not count.
  std::optional<Eigen::Vector3d> surfaceAt(const interaction::PickRay& line);
  /// There is tissue, and surfaceAt is none.
  bool isCutAway(const interaction::PickRay& line);

  /// Whether `startTouch` takes this tool up at once; otherwise it does what `toolPreparation` does
  /// first.
  bool toolReady(const session::TouchTool& tool) const;
  /// For another thread; the case must be ready.
  std::function<PreparedTool(const core::Progress&)>
  toolPreparation(const session::TouchTool& tool);
  /// Kept for `startTouch`, as far as the tissue is still the same.
  void toolPrepared(PreparedTool done);
  /// Starts a touch session, ending the present one first. The device must outlive the session.
  /// Throws as TouchSession does.
  void startTouch(haptics::Device& device, const session::TouchSession::Setup& setup);
  bool touching() const noexcept { return m_touch != nullptr; }
  /// For operations that do not change the tissue; nullptr without a session. Another case, another
  /// threshold or other touchable structures end the session.
  session::TouchSession* touch() noexcept { return m_touch.get(); }
  bool drilling() const noexcept { return m_touch && m_touch->drilling(); }

  /// Once per frame: shows what was drilled since. The strokes are not saved yet.
  session::TouchSession::News advanceTouch();
  session::TouchSession::News stopTouch(); ///< see TouchSession; no effect without a session

  /// Records the touch sessions to come in which something can be removed, for RecordingPlayer. A
  /// recording is of one session, hence of one burr: the first goes to `file`, replacing it, each
  /// further one to an unused name beside it. Until called with an empty path, another case is
  /// opened, or a file cannot be written; drilling goes on then. No effect on the session in
  /// progress, which stays recorded or not as it was begun.
  void record(const std::filesystem::path& file);
  /// The file that is being written, or that the next session is written to; empty: none.
  const std::filesystem::path& recording() const noexcept { return m_recording; }
  /// The last file to which a session of this case was recorded and ended; empty: none.
  const std::filesystem::path& lastRecording() const noexcept { return m_lastRecording; }

private:
  /// What was taken out under one name, with its place among the case's parts of its kind. A
  /// structure is a label part that holds it alone.
  struct RemovedPart
  {
    template <class T>
    struct At
    {
      std::size_t index = 0;
      T part;
    };
    std::string name;
    std::uint64_t id = 0; ///< identifies the removal
    std::optional<At<scene::ImagePart>> mr = {};
    std::optional<At<scene::LabelPart>> labels = {};
    std::optional<At<scene::MeshPart>> mesh = {};
    std::size_t structure = 0;              ///< place in its label part
    bool wasAlone = true;                   ///< the label part went with it
    std::vector<PartLook> readers = {};     ///< appearances that read the MR, as they did
    std::vector<std::string> measured = {}; ///< measurements that followed it
  };
  /// Where parts are whose axes are corrected, as copies that share what is read.
  struct PlacedParts
  {
    std::vector<scene::ImagePart> mr;
    std::vector<scene::LabelPart> labels;
    std::vector<scene::MeshPart> meshes;
    std::vector<scene::MrPlace> places; ///< of MRs whose registration that ends
  };
  /// What followed a structure that was taken out, until it is put back.
  struct TakenStructure
  {
    std::weak_ptr<const volume::LabelMap> labels;
    std::string name;
    std::vector<std::string> measured;
  };
  session::DrillSession& session();
  Eigen::Vector3d clampedToCt(const Eigen::Vector3d& patient) const;
  /// What of the structures is drawn until they are prepared.
  enum class Drawn
  {
    Nothing,       ///< they may have to be read first
    UntilPrepared, ///< as they were: the label field is outdated
    Still          ///< no label changed
  };
  void partsMoved(Drawn drawn = Drawn::Nothing);
  bool measureNearby(); ///< true when done
  void listen();
  void show(std::unique_ptr<scene::Case> next, bool unsaved);
  void waitForParts();
  std::optional<scene::LabelPart> removeLabels(const std::string& structure);
  void labelsChanged();
  void forgetTissue();
  void forgetReader();
  void changeBranch(const std::function<void()>& change);
  /// A branch that was gone to at another of its states.
  struct MovedBranch
  {
    std::size_t before = dissection::History::kStart; ///< its own state
    std::size_t to = dissection::History::kStart;
  };
  void recordBranch(const std::string& left, const std::optional<MovedBranch>& moved = {});
  void changeView(const std::string& name, const std::optional<scene::ViewState::Saved>& to,
                  const std::string& what);
  void putView(const std::string& name, const std::optional<scene::ViewState::Saved>& saved);
  void forgetStructure(const std::string& name, const scene::LabelPart& taken);
  void recallStructures(const scene::LabelPart& part, const scene::LabelPart* inPlaceOf);
  void notifyMask(const std::vector<std::size_t>& bricks);
  session::TouchSession::News hear(session::TouchSession::News news);
  void step(bool back);
  void stepEdit(const std::function<void()>& step);
  void recordEdit(EditHistory::Edit edit);
  void recordAddition(const std::vector<std::string>& names);
  void applyIso(double hounsfield);
  void applyLooks(const std::vector<PartLook>& looks);
  void takeOut(const std::string& name, std::uint64_t removal);
  void bringBack(std::uint64_t removal);
  void rename(const std::string& name, const std::string& to);
  void placeParts(const PlacedParts& from, const PlacedParts& to);
  void followHistory();
  void nameBranch(const std::string& from, const std::string& to);
  void setUnsaved(bool unsaved);
  void setRecording(const std::filesystem::path& file, const std::string& fault = {});
  /// `another`: under another name or in another library.
  void markOpen(const library::SavedState& saved);
  void keepJournal(const library::SavedState& saved, bool another = false);
  void storeNow(StoreTask task);

  library::Library m_library;
  std::unique_ptr<scene::Case> m_case;
  std::unique_ptr<library::OpenMark> m_mark; ///< of the case as it is in the library
  SceneAssembly m_assembly;
  std::optional<session::DrillSession> m_session; ///< made on demand, until there is m_scene
  std::shared_ptr<JournalThread> m_journal;       ///< shared with the removal thread
  std::optional<library::SavedState> m_saved;     ///< none before the case is in the library
  std::optional<session::FeltTissue> m_felt;      ///< for m_scene
  std::map<std::pair<double, double>, std::shared_ptr<const haptics::PointShell>>
      m_shells; ///< by diameter and voxel, mm
  std::unique_ptr<session::TouchScene> m_scene;
  std::unique_ptr<session::TouchSession> m_touch; ///< after m_scene, which it uses
  std::unique_ptr<PointProbe> m_reader;           ///< made on demand; likewise
  std::unique_ptr<NearbyStructures> m_nearby;     ///< likewise; unaffected by removal
  session::RemovedVolumeEstimator m_meter;
  std::filesystem::path m_lastRecording;
  std::filesystem::path m_recordedTo; ///< by the session in progress; empty: it is not recorded
  std::filesystem::path m_recording;
  std::filesystem::path m_recordingAs; ///< as chosen: that of the first session
  bool m_recordingBegun = false;       ///< there was a first session
  Eigen::Vector3d m_crosshair = Eigen::Vector3d::Zero();
  bool m_unsaved = false;
  bool m_leaving = false; ///< set by beginOpen: no tool can be taken up, its strokes would be lost
  bool m_beingStored = false;
  std::uint64_t m_changes = 0; ///< of the case to be saved
  bool m_loaded = true;
  bool m_drawable = true;
  bool m_feelable = true;
  bool m_checked = true;              ///< the CT was checked against its hash
  std::vector<LeftOut> m_leftOut;     ///< of m_case, by each preparation that found some
  std::vector<RemovedPart> m_removed; ///< latest last
  std::vector<TakenStructure> m_taken;
  std::uint64_t m_removals = 0; ///< ever made
  EditHistory m_edits;
  bool m_partsMoved = false; ///< since beginStore: the stored parts have other indices
  std::vector<std::string> m_damagedStrokes;
  std::size_t m_undoneForDamage = 0;
  std::uint64_t m_shown = 0;
  std::uint64_t m_parts = 0;  ///< of the case and its parts
  std::uint64_t m_tissue = 0; ///< of what is tissue
  std::uint64_t m_tissueChanges = 0;
};

} // namespace petrous::presenters
