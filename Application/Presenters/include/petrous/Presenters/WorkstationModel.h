#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "petrous/Library/Library.h"
#include "petrous/Presenters/PointerDrill.h"
#include "petrous/Presenters/SceneAssembly.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// The open case and what the window does with it. Without Qt, one thread.
class WorkstationModel
{
public:
  /// What the window hears; each may be empty. Called after the change.
  struct Events
  {
    std::function<void()> caseChanged;       ///< another case
    std::function<void()> appearanceChanged; ///< threshold, or how a structure is shown
    std::function<void(const core::IndexBox&)> maskChanged; ///< in a box of CT voxels
    std::function<void()> crosshairMoved;
    std::function<void()> stateChanged; ///< name, saved or not, what can be undone
  };

  explicit WorkstationModel(library::Library library);

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

  /// Shows a case made in memory, which somebody else saves now; `stored` tells how that ended.
  void adopt(scene::Case value);
  void stored(const scene::Case& saved); ///< names and revision are taken over
  void notStored();
  bool beingStored() const noexcept { return m_beingStored; }

  bool unsaved() const noexcept { return m_unsaved; }
  void setCamera(const core::CameraPose& camera); ///< kept with the next save
  void save();                                    ///< throws as Library::save does
  void saveAs(const std::string& name);           ///< a new case; on an exception nothing changed
  /// Into another library, which the window then works with.
  void saveElsewhere(const std::filesystem::path& folder, const std::string& name);

  bool canUndo() const noexcept;
  bool canRedo() const noexcept;
  void undo();
  void redo();

  void setIso(double hounsfield);
  void setLook(const std::string& structure, const appearance::StructureLook& look);
  void setBoneLook(const appearance::StructureLook& look);

  /// What a picture of the case shows, only with a case; see SceneAssembly.
  rendering::SceneContents sceneContents() { return m_assembly.contents(*m_case); }

  const Eigen::Vector3d& crosshair() const noexcept { return m_crosshair; }
  void setCrosshair(const Eigen::Vector3d& patient); ///< held within the CT

  std::optional<double> hounsfieldAt(const Eigen::Vector3d& patient) const;
  std::string structureAt(const Eigen::Vector3d& patient) const; ///< empty: none
  /// Where the line meets tissue, patient LPS mm.
  std::optional<Eigen::Vector3d> surfaceAt(const SightLine& line);
  /// Where a burr laid on the surface has its centre.
  std::optional<Eigen::Vector3d> burrAt(const SightLine& line, double radius);

  void beginStroke(const SightLine& line, const dissection::Burr& burr, double feed, double seconds,
                   const core::CameraPose& camera);
  bool drilling() const noexcept { return m_drill.has_value(); }
  /// The burr's centre; nothing in the air.
  std::optional<Eigen::Vector3d> drill(const SightLine& line, double seconds);
  std::shared_ptr<const dissection::Stroke> endStroke(); ///< not saved yet

private:
  DrillSession& session();
  void show(std::unique_ptr<scene::Case> next, bool unsaved);
  void tellMask();
  void setUnsaved(bool unsaved);

  library::Library m_library;
  std::unique_ptr<scene::Case> m_case;
  SceneAssembly m_assembly;
  std::optional<DrillSession> m_session; ///< made when first asked for
  std::optional<PointerDrill> m_drill;
  Eigen::Vector3d m_crosshair = Eigen::Vector3d::Zero();
  bool m_unsaved = false;
  bool m_beingStored = false;
};

} // namespace petrous::presenters
