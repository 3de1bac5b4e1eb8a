#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Interaction/PickRay.h"
#include "petrous/Library/Library.h"
#include "petrous/Presenters/JournalThread.h"
#include "petrous/Presenters/NearbyStructures.h"
#include "petrous/Presenters/PointProbe.h"
#include "petrous/Presenters/SceneAssembly.h"
#include "petrous/Presenters/RemovedVolumeEstimator.h"
#include "petrous/Presenters/TouchSession.h"
#include "petrous/Presenters/WorkstationEvents.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// A case that was read from the library, in whatever thread.
struct ReadCase
{
  std::unique_ptr<scene::Case> value; ///< with its dissection
  std::vector<std::string> notices;   ///< Library::onNotice

  /// Throws as Library::open does, also where the CT is missing; CancelledError.
  static ReadCase from(const library::Library& library, const std::string& name,
                       const core::Progress& progress = {});
};

/// A copy of the open case on its way to the disk, see WorkstationModel::beginStore.
struct StoreTask
{
  library::Library library;
  scene::Case value; ///< without its dissection, in which another thread may write
  std::string from;  ///< the open case's name
  std::uint64_t changes = 0;
  std::optional<library::Library> source; ///< where the case moves from; the window works with
                                          ///< `library` then
  std::vector<std::string> notices = {};  ///< Library::onNotice

  /// Throws as Library::save; LibraryError (Damaged) also where a part that moves to another
  /// library is not what was stored in this one.
  void run(const core::Progress& progress = {});
};

/// What takes long of a case with many structures, for its picture and for tools: made in whatever
/// thread of a copy of the case, see WorkstationModel::preparation.
struct PreparedCase
{
  struct LeftOut
  {
    std::size_t part = 0; ///< of the case's labels, or of its meshes
    std::string why;      ///< one sentence
  };
  SceneAssembly assembly;
  std::optional<DrillSession> drill;   ///< of a copy that is gone: only to make another one like it
  std::vector<LeftOut> labels, meshes; ///< that are missing or damaged
  std::uint64_t parts = 0;             // of the model when it was copied
  std::uint64_t tissue = 0;            // likewise
};

/// The open case and what the window does with it. Without Qt, one thread.
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

  /// The case that was saved last; nothing in an empty library.
  std::optional<std::string> latestCase() const;

  /// Opens a case of the library; on an exception the present one stays.
  void open(const std::string& name);

  /// Before the open case is saved to make way for another one, or to be closed: puts the tool
  /// away, and none is taken up (what it drilled would be lost) until the case is another one, is
  /// closed, or `notOpened`.
  void beginLeave();

  /// The same with a thread that reads the case (ReadCase) between the two; then `opened` or
  /// `notOpened`. The tool is put away.
  void beginOpen(const std::string& name);
  void opened(ReadCase next);
  void notOpened();

  /// Shows a case made in memory, which is not saved yet.
  void adopt(scene::Case value);

  /// Takes over the parts that `with`, once a copy of the open case, has got beside those that this
  /// one has (see addParts). What was drilled and chosen since then stays.
  void takeParts(scene::Case with);

  /// No case is open any more. What is unsaved is lost.
  void close();

  /// Another number for each case that was opened or adopted: a case may get another name, and
  /// another case its name.
  std::uint64_t shownAs() const noexcept { return m_shown; }

  /// For a thread that saves: the case as it is now, and then `stored` or `notStored`. One at a
  /// time. What changes meanwhile is unsaved.
  StoreTask beginStore();
  StoreTask beginStoreAs(const std::string& name); ///< as a new case, which is then the open one
  /// Into another library, which the window then works with.
  StoreTask beginStoreElsewhere(const std::filesystem::path& folder, const std::string& name);
  void stored(const StoreTask& done); ///< names and revision are taken over
  void notStored();
  bool beingStored() const noexcept { return m_beingStored; }

  bool unsaved() const noexcept { return m_unsaved; }
  void setCamera(const core::CameraPose& camera); ///< kept with the next save
  void save();                                    ///< throws as Library::save does
  void saveAs(const std::string& name);           ///< a new case; on an exception nothing changed
  void saveElsewhere(const std::filesystem::path& folder, const std::string& name);

  /// What takes long is still to be done (Events::preparationWanted asks for it) until `prepared`:
  /// loaded   false after another case or parts came: pictures show the CT alone
  /// drawable false after a structure was shown or hidden, too: its label field is of before
  /// ready    false after a structure became tissue or none, too: no surface can be touched
  ///          yet; and while the CT of the library was not held against its hash
  bool loaded() const noexcept { return m_loaded; }
  bool drawable() const noexcept { return m_loaded && m_drawable; }
  bool ready() const noexcept { return m_loaded && m_feelable && m_checked; }
  /// Whether `preparation` would spare somebody a wait.
  bool preparationHelps() const noexcept
  {
    return m_case && (!ready() || !drawable() || !(m_session || m_scene));
  }
  /// What is to be done in another thread.
  std::function<PreparedCase(const core::Progress&)> preparation() const;
  /// False where the case is another one by now: nothing happened.
  bool prepared(PreparedCase done);
  void prepareNow() { prepared(preparation()({})); } ///< for who can wait
  /// What can be shown now: the case, or while it is not loaded the case without its structures.
  scene::Case presentable() const;

  /// What of the images that were read is not what was stored, one sentence each, as far as that is
  /// known by now; no tool is taken up then.
  std::vector<std::string> damage() const;
  /// Structures that are missing or damaged, one sentence each: they are neither shown nor felt,
  /// and the case keeps them as they are on the disk.
  std::vector<std::string> leftOut() const;

  bool canUndo() const noexcept;
  bool canRedo() const noexcept;
  /// While a tool is in the hand they are only asked for, and told some milliseconds later; see
  /// Events::stepped.
  void undo();
  void redo();

  /// Puts the tool away first. Throw as scene::goToBranch and scene::startBranch do.
  void goToBranch(const std::string& name);
  void startBranch(const std::string& name); ///< where the case stands

  void setIso(double hounsfield);
  void setLook(const std::string& structure, const appearance::StructureAppearance& look);
  void setBoneLook(const appearance::StructureAppearance& look);

  /// Changes how MRs lie on the CT (Scene/ApplyRegistration.h). Where that moves what was drawn on one, a tool
  /// that is held is put away. Nothing happens while it drills; what `change` throws goes on.
  void changeMr(const std::function<void(scene::Case&)>& change);

  /// What a picture of the case shows, only with a case; see SceneAssembly.
  rendering::SceneContents sceneContents();

  /// Colours bone by its thickness over a structure; empty: no longer. Takes about a second.
  /// Throws InvalidParameter, and nothing changes, where it cannot be measured.
  void showThickness(const std::string& structure);
  const std::string& thicknessOver() const noexcept { return m_assembly.thicknessOver(); }

  const Eigen::Vector3d& crosshair() const noexcept { return m_crosshair; }
  void setCrosshair(const Eigen::Vector3d& patient); ///< held within the CT

  std::optional<double> hounsfieldAt(const Eigen::Vector3d& patient) const;
  std::string structureAt(const Eigen::Vector3d& patient) const; ///< empty: none
  /// The same and more, as `petrous probe` says it, and the nearest structure; only with a case.
  /// The first reading of a case looks through its labels (some tenths of a second).
  PlaceReading readPlace(const Eigen::Vector3d& patient);
  static constexpr double kNear = 20.0; ///< mm; farther structures are nobody's concern
  /// Structures within kNear of a burr (patient LPS mm) and those that are injured, the nearest
  /// first. The first question of a case has them measured, in a thread of its own: nothing until
  /// that is done, and nothing without a case.
  std::optional<std::vector<NearbyStructure>> nearby(const Eigen::Vector3d& burr, double radius);
  /// What of it the surgeon must see now (warningsOf), and no more is measured than that asks for:
  /// cheap enough for every picture. Likewise nothing until the structures are measured.
  std::optional<std::string> warnings(const Eigen::Vector3d& burr, double radius);
  /// What the open stroke has taken so far, see RemovedVolumeEstimator; nothing while none is open.
  const dissection::RemovedVolume& strokeSoFar();
  bool measuresNearby() const noexcept { return m_nearby != nullptr; }
  void forgetNearby(); ///< nobody looks at it any more: gives its memory back

  /// Where the line meets tissue, mm from its origin.
  std::optional<double> tissueAlong(const interaction::PickRay& line);
  /// The same as a place, patient LPS mm.
  std::optional<Eigen::Vector3d> surfaceAt(const interaction::PickRay& line);

  /// Takes a tool into the hand; one that is held is put away first. Reads the CT at the first time
  /// (about a second for 512^3). The device must outlive the touch. Throws as TouchSession does.
  void startTouch(haptics::Device& device, const TouchSession::Setup& setup);
  bool touching() const noexcept { return m_touch != nullptr; }
  /// For what changes nothing in the tissue; null while nothing is in the hand. Another case,
  /// another threshold or other touchable structures put the tool away.
  TouchSession* touch() noexcept { return m_touch.get(); }
  bool drilling() const noexcept { return m_touch && m_touch->drilling(); }

  /// Once a picture: shows what was drilled since. The strokes are not saved yet.
  TouchSession::News advanceTouch();
  TouchSession::News stopTouch(); ///< see TouchSession; nothing happens without a touch

private:
  DrillSession& session();
  bool measureNearby(); ///< true when that is done
  void listen();
  void show(std::unique_ptr<scene::Case> next, bool unsaved);
  void waitForParts();
  void leaveOut(const PreparedCase& done);
  void forgetTissue();
  void notifyMask(const std::vector<std::size_t>& bricks);
  TouchSession::News hear(TouchSession::News news);
  void step(bool back);
  void followHistory();
  void setUnsaved(bool unsaved);
  /// `another`: under another name or in another library.
  void keepJournal(const library::SavedState& saved, bool another = false);
  void storeNow(StoreTask task);

  library::Library m_library;
  std::unique_ptr<scene::Case> m_case;
  SceneAssembly m_assembly;
  std::optional<DrillSession> m_session;      ///< made when first asked for, until there is m_scene
  std::shared_ptr<JournalThread> m_journal;   ///< shared with the thread that cuts
  std::optional<library::SavedState> m_saved; ///< nothing before the case is in the library
  std::unique_ptr<TouchScene> m_scene;
  std::unique_ptr<TouchSession> m_touch;      ///< after m_scene, which it uses
  std::unique_ptr<PointProbe> m_reader;      ///< when first asked for; likewise
  std::unique_ptr<NearbyStructures> m_nearby; ///< likewise; a cut changes nothing of them
  RemovedVolumeEstimator m_meter;
  Eigen::Vector3d m_crosshair = Eigen::Vector3d::Zero();
  bool m_unsaved = false;
  bool m_leaving = false; ///< from beginOpen on no tool is taken up: its strokes would be lost
  bool m_beingStored = false;
  std::uint64_t m_changes = 0; ///< of the case that is to be saved
  bool m_loaded = true;
  bool m_drawable = true;
  bool m_feelable = true;
  bool m_checked = true; ///< the CT was held against its hash
  /// A part that cannot be read is empty in m_case; this is what it was.
  template <class T>
  struct Unread
  {
    std::size_t part;
    std::string why;
    core::Lazy<T> whole;
  };
  std::vector<Unread<volume::LabelMap>> m_unreadLabels;
  std::vector<Unread<core::TriangleMesh>> m_unreadMeshes;
  std::uint64_t m_shown = 0;
  std::uint64_t m_parts = 0;  ///< which case, with which parts
  std::uint64_t m_tissue = 0; ///< and which of them are tissue
};

} // namespace petrous::presenters
