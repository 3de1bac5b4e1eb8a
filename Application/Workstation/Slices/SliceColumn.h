#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <QWidget>

#include "BackgroundWork.h"
#include "petrous/Presenters/BoxHandles.h"
#include "petrous/Presenters/ClippingHandles.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/SlicePlanes.h"
#include "petrous/Presenters/SlicePresenter.h"
#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::workstation
{

class SliceView;
struct DrawnMeasure;
struct SliceBox;
struct SliceCut;
struct SliceDrawing;
struct SliceMark;
struct SliceTool;

/// The axial, coronal and sagittal view, with one crosshair and grey window. Where they stand is
/// the ViewArea's.
class SliceColumn : public QWidget
{
  Q_OBJECT
public:
  explicit SliceColumn(presenters::WorkstationModel& model, QWidget* parent = nullptr);
  ~SliceColumn() override;

  /// What the slices begin with is being looked for.
  bool isFraming() const noexcept { return m_framing.busy(); }

  const std::array<SliceView*, 3>& views() const noexcept { return m_views; }

  void caseChanged();
  void clear(); ///< no case is open
  void appearanceChanged();
  void crosshairMoved();
  void maskChanged(const core::IndexBox& box); ///< of CT voxels

  void boneWindow();     ///< width 4000, level 700 HU, or equivalent
  void softWindow();     ///< width 400, level 40 HU
  void temporalWindow(); ///< width 2800, level 600 HU
  void fit();
  void showWhole();    ///< fits for a while
  void showAsBefore(); ///< as before showWhole, each slice that was not zoomed since
  void keepAsSeen();   ///< what was before showWhole does not come back; also by fit and setShown

  const presenters::SlicePlanes& planes() const noexcept { return m_planes; }
  void setPlanes(const presenters::SlicePlanes& planes);
  const presenters::Slab& slab() const noexcept { return m_slab; }
  void setSlab(const presenters::Slab& slab);
  /// A slice that is zoomed takes the others along, to the same millimetres a pixel: at once the
  /// one that has the keyboard focus, or was zoomed last.
  void setZoomTogether(bool together);
  void setScale(double mmPerPixel); ///< of all slices

  /// Of the image that is seen: the primary one, or an MR alone.
  const presenters::GreyWindow& seenWindow() const;
  void setSeenWindow(const presenters::GreyWindow& window);
  std::vector<presenters::NamedWindow> seenWindows() const; ///< those offered
  presenters::IntensityDisplay seenDisplay() const;
  bool seesMr() const; ///< seen, or primary

  /// Crosshair, grey window, zoom and offsets; the MR over them is the RegistrationController's.
  void setShown(const scene::ViewState::Slices& slices);
  scene::ViewState::Slices shown() const;
  scene::ViewState::Slices lasting() const; ///< with the zooms of before showWhole

  /// nullptr: the CT alone. `shown`: the images that are seen so.
  void setOverlay(const std::shared_ptr<const presenters::SliceOverlay>& overlay,
                  const presenters::ShownImages& shown);
  /// Of the images that are seen, at a patient point (LPS mm).
  QString valuesAt(const Eigen::Vector3d& patient) const;
  void setNotice(const QString& text);
  void setRegion(double edge); ///< as SliceView
  void setMarks(const std::vector<SliceMark>& marks);
  /// As SliceView, and the next three. Of segmenting, which comes before measuring.
  void setTool(const std::optional<SliceTool>& tool);
  void setMeasuring(bool on); ///< the left button sets points
  void setDrawing(const SliceDrawing& drawing);
  void setMeasures(const std::vector<DrawnMeasure>& measures);
  void setBox(const std::optional<SliceBox>& box);
  void setCuts(const std::vector<SliceCut>& cuts);
  void setDraft(const std::shared_ptr<const presenters::DraftLayer>& draft);
  /// A structure that is not shown, as its draft is; empty: none.
  void setHidden(const std::string& structure);
  void draftChanged(const core::PatientBox& box);
  void setDifference(const std::shared_ptr<const presenters::DraftLayer>& difference);
  /// What an image shows alone: an MR; empty: the CT is seen, too.
  std::string mrAlone() const { return m_shown.ct ? std::string() : m_shown.mr; }
  double mmPerPixel(presenters::SliceOrientation plane) const;

signals:
  void enlargeAsked(petrous::presenters::SliceOrientation slice); ///< or back
  void menuAsked(const QPoint& global);
  void planesChanged();
  void slabChanged();
  void windowChanged(); ///< grey window, or the image that is seen
  void pointed(const Eigen::Vector3d& patient);
  /// For the MR, where it alone is seen.
  void overlayWindowAsked(const petrous::presenters::GreyWindow& window);
  void moveAsked(const Eigen::Vector3d& millimetres); ///< of the MR over the CT
  void turnAsked(const Eigen::Vector3d& axis, double degrees);
  void toolPressed(const Eigen::Vector3d& patient, petrous::presenters::SliceOrientation plane);
  void toolDragged(const Eigen::Vector3d& patient);
  void toolReleased();
  void toolDoubleClicked();
  void handleTaken(std::size_t measurement, std::size_t point);
  void handleDragged(const Eigen::Vector3d& patient);
  void handleReleased();
  void boxTaken(const petrous::presenters::BoxFaces& faces, const Eigen::Vector3d& patient);
  void boxDragged(const Eigen::Vector3d& patient);
  void boxReleased();
  void boxResetAsked();
  void cutTaken(std::size_t plane, petrous::presenters::CutPart part,
                const Eigen::Vector3d& patient, petrous::presenters::SliceOrientation slice);
  void cutDragged(const Eigen::Vector3d& patient);
  void cutReleased();

private:
  void frameTissue();
  void zoomTogether();
  bool isStillWhole(std::size_t slice) const;
  void setGreyWindow(const presenters::GreyWindow& window);
  void showReadout();
  void passTool();
  const scene::ImagePart* seenMr() const; ///< an MR alone

  presenters::WorkstationModel& m_model;
  std::array<SliceView*, 3> m_views;
  std::shared_ptr<const presenters::SlicePresenter> m_presenter; // of the views
  presenters::GreyWindow m_window;
  std::shared_ptr<const presenters::SliceOverlay> m_overlay;
  presenters::ShownImages m_shown;
  std::string m_hidden;
  std::unique_ptr<const SliceTool> m_tool; ///< of segmenting
  bool m_measuring = false;
  presenters::SlicePlanes m_planes;
  presenters::Slab m_slab;
  /// Before showWhole, of each slice.
  std::array<std::optional<scene::ViewState::Slices::Plane>, 3> m_before;
  bool m_isZoomTogether = false;
  const SliceView* m_zoomed = nullptr; ///< whose scale the others take
  std::string m_suggestedOf;           ///< the MR of which m_suggested is the window at first
  presenters::GreyWindow m_suggested;
  BackgroundWork m_framing;
};

} // namespace petrous::workstation
